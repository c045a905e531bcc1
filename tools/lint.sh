#!/usr/bin/env bash
# lintr over the R sources and the tools by the rules of .lintr; fails on any lint. Folders: LINT="R tools".
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

has_lintr() { Rscript -e 'quit(status = !requireNamespace("lintr", quietly = TRUE))' >/dev/null 2>&1; }

install_lintr() {
  if command -v apt-get >/dev/null && [ "$(id -u)" -eq 0 ]; then
    apt-get update
    DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends r-cran-lintr
  else
    Rscript -e 'install.packages("lintr")'
  fi
  has_lintr
}

has_lintr || step "lintr" install_lintr
Rscript tools/lint.R ${LINT:-R tools}
