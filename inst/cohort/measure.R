# Measures one part of a folder of scans. Any scheduler can run it: Slurm (measure.sh), SGE, make,
# Snakemake, Nextflow, or a loop of the shell.
#
#   Rscript measure.R SCANS RESULTS PART PARTS
#
# SCANS is a folder of meshes, each with a landmark file of its name; PART a number from 1 to PARTS.
# Exit status: 0 if every scan of the part is measured or is a failure of its own (read_batch() and
# failures() list them); 3 if results could not be written or a worker died: run it again.
library(crestline)
given <- commandArgs(TRUE)
stopifnot(length(given) == 4)

# What to measure: a folder of write_scheme() in CRESTLINE_SCHEME, or the whole face.
scheme <- Sys.getenv("CRESTLINE_SCHEME")
scheme <- if (nzchar(scheme)) read_scheme(scheme) else face_scheme()

shapes <- fit_shapes(given[1], scheme, dir = given[2], part = as.numeric(given[3:4]))
print(shapes)
machine <- failures(shapes)$stage %in% c("keeping", "worker")
quit(status = if (any(machine)) 3 else 0)
