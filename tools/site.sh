#!/usr/bin/env bash
# The site, by pkgdown, into site/ (or the folder named), and a look at every page of it in headless Chromium where that is
# here. Needs no network once pkgdown is installed.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

target=${1:-site}
if ! Rscript -e 'quit(status = !requireNamespace("pkgdown", quietly = TRUE))' >/dev/null 2>&1; then
  step "from CRAN: pkgdown" Rscript -e 'install.packages("pkgdown")'
fi
rm -rf "$target"
step "pkgdown into $target" Rscript tools/site.R "$target"
if command -v chromium >/dev/null; then
  Rscript tools/site-check.R "$target"
else
  say "    note: Chromium is not here; the pages were not opened"
fi
