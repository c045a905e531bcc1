#!/usr/bin/env bash
# R CMD build with vignettes, then R CMD check --as-cran on the tarball, as a user's machine would see it: without
# the shared scans. CHECK_ARGS: further arguments of R CMD check. Fails on any error, warning or note that tools/check-log.R does not know as the machine's.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh
here=$PWD

work=$(mktemp -d "${TMPDIR:-/tmp}/crestline-check-XXXXXX")
trap 'rm -rf "$work"' EXIT
unset CRESTLINE_SHARED NOT_CRAN MAKELEVEL MFLAGS
export MAKEFLAGS="-j$(cores)" OMP_THREAD_LIMIT=2

build() { cd "$work" && R CMD build tree; }

# geomorph and RRPP are offered from R 4.4 on; below, their absence must not stop the check, and the orphan check
# of --as-cran, which crashes over an absent package without CRAN's web pages, reads an empty table instead.
allow_absent_suggests() {
  export _R_CHECK_FORCE_SUGGESTS_=false
  mkdir -p "$work/cran/web/packages"
  Rscript -e 'saveRDS(cbind(Package = character(), Maintainer = character()), commandArgs(TRUE))' \
    "$work/cran/web/packages/packages.rds"
  export R_CRAN_WEB=file://$work/cran
}

check() {
  cd "$work"
  if Rscript -e 'quit(status = getRversion() >= "4.4.0")'; then allow_absent_suggests; fi
  # Without debugging symbols, which alone are 3 MB of the 5 that an installed package may have without a note;
  # not stripped, or the check finds no registered routines.
  printf '%s = -g0 -O2\n' CXXFLAGS CXX17FLAGS > "$work/Makevars"
  R_MAKEVARS_USER="$work/Makevars" _R_CHECK_CRAN_INCOMING_REMOTE_=FALSE _R_CHECK_SYSTEM_CLOCK_=0 \
    R CMD check --as-cran --no-manual ${CHECK_ARGS:-} crestline_*.tar.gz || true
  [ -s crestline.Rcheck/00check.log ]
}

show() { [ ! -s "$1" ] || { say "---- ${1##*/}"; cat "$1"; }; }

mkdir "$work/tree"
copy_tree "$work/tree"
step "R CMD build with vignettes" build
step "R CMD check --as-cran $(cd "$work" && ls crestline_*.tar.gz)" check
status=0
Rscript "$here/tools/check-log.R" "$work/crestline.Rcheck/00check.log" || status=$?
if [ "$status" -ne 0 ]; then
  show "$work/crestline.Rcheck/00check.log"
  show "$work/crestline.Rcheck/00install.out"
  show "$work/crestline.Rcheck/tests/testthat.Rout.fail"
fi
exit "$status"
