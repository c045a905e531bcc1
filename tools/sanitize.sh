#!/usr/bin/env bash
# The tests under gcc's address and undefined-behaviour sanitizers: any fault in the C++ code ends them.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

work=$(mktemp -d "${TMPDIR:-/tmp}/crestline-sanitize-XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir "$work/tree" "$work/library"
copy_tree "$work/tree"

# vptr is left out: it needs type information of R's own libraries, which are built without.
SANITIZERS="-fsanitize=address,undefined -fno-sanitize=vptr -fno-omit-frame-pointer"
printf '%s = -g1 -O1 '"$SANITIZERS"'\n' CFLAGS CXXFLAGS CXX14FLAGS CXX17FLAGS > "$work/flags"
printf 'LDFLAGS = %s\n' "$SANITIZERS" >> "$work/flags"

install_instrumented() {
  env -u MAKELEVEL -u MFLAGS MAKEFLAGS="-j$(cores)" R_MAKEVARS_USER="$work/flags" \
    R CMD INSTALL --preclean --no-test-load --no-docs --library="$work/library" "$work/tree"
}

# R's own frames are left out of what is shown. Leaks are not looked for: R itself holds its memory until the end.
run_instrumented() {
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
  export CRESTLINE_INSTRUMENTED=sanitizers R_LIBS="$work/library:${R_LIBS:-}"
  LD_PRELOAD="$(gcc -print-file-name=libasan.so):$(gcc -print-file-name=libubsan.so)" \
    Rscript tools/run-tests.R 2>&1
}

step "build with the sanitizers" install_instrumented
say "==> the tests with the sanitizers"
status=0
run_instrumented | tee "$work/tests.log" | grep -v 'libR\.so' || status=$?
if grep -qE 'AddressSanitizer|runtime error:' "$work/tests.log"; then
  say "    the sanitizers found a fault (above)"
  status=1
fi
exit "$status"
