#!/usr/bin/env bash
# Builds and installs crestline, unless what is installed was made from these very files by this very R.
# Goes to the first library that can be written ($CRESTLINE_LIB comes first under make).
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

source_key() {
  Rscript -e 'there <- Filter(file.exists, c("DESCRIPTION", "NAMESPACE", "R", "src", "man", "inst", "exec", "data"))
              files <- c(there[!dir.exists(there)], list.files(there[dir.exists(there)], recursive = TRUE, full.names = TRUE))
              files <- sort(files[!grepl("[.](o|so|dll)$", files)], method = "radix")
              key <- tempfile()
              writeLines(c(R.version.string, files, tools::md5sum(files)), key)
              cat(tools::md5sum(key))'
}

target_library() {
  Rscript -e 'lib <- c(.libPaths()[file.access(.libPaths(), 2) == 0], Sys.getenv("R_LIBS_USER"))[[1]]
              dir.create(lib, recursive = TRUE, showWarnings = FALSE); cat(path.expand(lib))'
}

build_and_install() {
  work=$(mktemp -d "${TMPDIR:-/tmp}/crestline-build-XXXXXX")
  trap 'rm -rf "$work"' EXIT
  mkdir "$work/tree"
  copy_tree "$work/tree"
  (cd "$work" && R CMD build --no-build-vignettes --no-manual tree)
  env -u MAKELEVEL -u MFLAGS MAKEFLAGS="-j$(cores)" R CMD INSTALL --library="$1" "$work"/crestline_*.tar.gz
}

library_path=$(target_library)
key=$(source_key)
if [ "$(cat "$library_path/crestline/source-key" 2>/dev/null)" = "$key" ]; then
  say "==> crestline in $library_path is up to date"
else
  step "build and install crestline into $library_path" build_and_install "$library_path"
  echo "$key" > "$library_path/crestline/source-key"
fi
