#!/usr/bin/env bash
# The site, by pkgdown, into site/ (or the folder named), and a look at every page of it in headless Chromium where that is
# here. Needs no network once pkgdown is installed.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

target=${1:-site}
has_pkgdown() { Rscript -e 'quit(status = !requireNamespace("pkgdown", quietly = TRUE))' >/dev/null 2>&1; }

install_pkgdown() {
  if command -v apt-get >/dev/null && [ "$(id -u)" -eq 0 ]; then
    apt-get update
    DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends r-cran-pkgdown
  else
    Rscript -e 'install.packages("pkgdown")'
  fi
  has_pkgdown
}

has_pkgdown || step "pkgdown" install_pkgdown
rm -rf "$target"
step "pkgdown into $target" Rscript tools/site.R "$target"
if command -v chromium >/dev/null; then
  Rscript tools/site-check.R "$target"
else
  say "    note: Chromium is not here; the pages were not opened"
fi
