#!/bin/bash
# Measures a folder of scans by an array of Slurm jobs. Every job measures its own part, results go
# into one folder. Copy this file and add what your cluster needs (partition, modules).
#
#   sbatch --array=1-8 measure.sh SCANS RESULTS
#
# To run one part of eight again: PARTS=8 sbatch --array=3 measure.sh SCANS RESULTS
#
# It may be submitted again at any time: what is measured is not measured again. If R is killed (by
# want of memory, by hand), the job starts it again, at most five times. If the node fails, Slurm
# puts the job back into the queue (--requeue).
#SBATCH --job-name=crestline
#SBATCH --array=1-8
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=2G
#SBATCH --time=24:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=measure-%A_%a.log

export OMP_NUM_THREADS=1 RGL_USE_NULL=TRUE
parts=${PARTS:-$SLURM_ARRAY_TASK_COUNT}
if [ -z "$PARTS" ] && [ "$SLURM_ARRAY_TASK_MIN-$SLURM_ARRAY_TASK_MAX" != "1-$parts" ]; then
  echo "the array is not 1 to $parts: say of how many parts these are some, PARTS=8 sbatch ..." >&2
  exit 2
fi
measure=$(Rscript -e 'cat(system.file("cohort", "measure.R", package = "crestline"))')
for try in 1 2 3 4 5; do
  Rscript "$measure" "$1" "$2" "$SLURM_ARRAY_TASK_ID" "$parts"
  code=$?
  # 128 and more: R was killed by a signal.
  [ "$code" -lt 128 ] && exit "$code"
  echo "R was killed (exit status $code), try $try: again"
done
exit "$code"
