#!/usr/bin/env bash
# lintr over the R sources and the tools by the rules of .lintr, and the length of lines in tests,
# benches and vignettes; fails on any lint. Folders of lintr: LINT="R tools".
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

has_lintr() { Rscript -e 'quit(status = !requireNamespace("lintr", quietly = TRUE))' >/dev/null 2>&1; }

# As Debian's built package where R is Debian's, else from CRAN.
install_lintr() {
  local root=
  [ "$(id -u)" -eq 0 ] || root="sudo -n"
  if [ "$(dpkg-query -W -f '${db:Status-Status}' r-base-core 2>/dev/null)" = installed ] && $root true 2>/dev/null; then
    $root apt-get -o DPkg::Lock::Timeout=600 update
    $root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y --no-install-recommends -o DPkg::Lock::Timeout=600 r-cran-lintr
  else
    Rscript -e 'lib <- path.expand(c(.libPaths()[file.access(.libPaths(), 2) == 0], Sys.getenv("R_LIBS_USER"))[1])
                dir.create(lib, recursive = TRUE, showWarnings = FALSE)
                install.packages("lintr", lib, repos = "https://cloud.r-project.org")'
  fi
  has_lintr
}

has_lintr || step "lintr" install_lintr
echo "==> lint: ${LINT:-R tools}"
Rscript tools/lint.R ${LINT:-R tools}
