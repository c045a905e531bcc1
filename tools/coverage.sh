#!/usr/bin/env bash
# Lines of R and of C++ that the tests run, file by file. Fails where either share is under $COVERAGE_MIN per cent.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

work=$(mktemp -d "${TMPDIR:-/tmp}/crestline-coverage-XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir "$work/tree"
copy_tree "$work/tree"
export NOT_CRAN=true CRESTLINE_INSTRUMENTED=coverage
step "the tests with counters in R and C++" \
  env -u MAKELEVEL -u MFLAGS MAKEFLAGS="-j$(cores)" Rscript tools/coverage.R "$work/tree" "$work/coverage.txt"
cat "$work/coverage.txt"
! grep -q '^UNDER' "$work/coverage.txt"
