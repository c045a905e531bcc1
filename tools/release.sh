#!/usr/bin/env bash
# What CRAN's machines try beyond `make check`: the tarball's size, a check without any suggested package, one with LC_ALL=C in a
# folder whose name has spaces, and the examples under valgrind. Each says passed or FAILED.
#   tools/release.sh [size] [nosuggests] [spaces] [valgrind]   (all of them when none is named)
set -uo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh
here=$PWD

work=$(mktemp -d "${TMPDIR:-/tmp}/crestline release-XXXXXX")
trap 'rm -rf "$work"' EXIT
unset CRESTLINE_SHARED NOT_CRAN MAKELEVEL MFLAGS
export MAKEFLAGS="-j$(cores)" OMP_THREAD_LIMIT=2 _R_CHECK_CRAN_INCOMING_REMOTE_=FALSE _R_CHECK_SYSTEM_CLOCK_=0

build() { mkdir "$work/tree" && copy_tree "$work/tree" && cd "$work" && R CMD build tree; }

# As in tools/check.sh: no debugging symbols. The log is shown where something was found.
check() {
  printf '%s = -g0 -O2\n' CXXFLAGS CXX17FLAGS > "$work/Makevars"
  mkdir -p "$work/$1" && cd "$work/$1"
  R_MAKEVARS_USER="$work/Makevars" R CMD check --no-manual "${@:2}" ../crestline_*.tar.gz
  Rscript "$here/tools/check-log.R" crestline.Rcheck/00check.log || { cat crestline.Rcheck/00check.log; return 1; }
}

size() {
  local bytes
  bytes=$(stat -c %s "$work"/crestline_*.tar.gz)
  echo "    tarball: $bytes bytes"
  [ "$bytes" -lt 5000000 ]
}

nosuggests() { _R_CHECK_DEPENDS_ONLY_=true _R_CHECK_FORCE_SUGGESTS_=false check nosuggests --ignore-vignettes; }

spaces() { LC_ALL=C _R_CHECK_FORCE_SUGGESTS_=false check "a folder with spaces"; }

# Faults with a line of our C++ in them; R's and its libraries' own are left out.
valgrind() {
  check valgrind --use-valgrind --no-tests --ignore-vignettes
  local out=crestline.Rcheck/crestline-Ex.Rout
  grep "ERROR SUMMARY" "$out" && ! grep -E '^==[0-9]+== .*(crestline\.so|\.cpp:)' "$out"
}

step "R CMD build with vignettes" build || exit 1
status=0
for part in ${@:-size nosuggests spaces valgrind}; do
  if "$part" > "$work/$part.log" 2>&1; then say "    $part: passed"; continue; fi
  status=1
  cat "$work/$part.log"
  say "    $part: FAILED"
done
exit "$status"
