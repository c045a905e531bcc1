#!/usr/bin/env bash
# Writes what is generated: src/RcppExports.cpp, R/RcppExports.R, NAMESPACE and man/.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh
for package in roxygen2 pkgbuild; do
  Rscript -e "quit(status = !requireNamespace('$package', quietly = TRUE))" >/dev/null 2>&1 ||
    die "$package is not here: install it first (apt-get install r-cran-$package, or from CRAN)"
done
Rscript --vanilla -e 'Rcpp::compileAttributes("."); roxygen2::roxygenise(".")'
# Its objects are without optimisation: none may be left for an installation to find.
rm -f src/*.o src/*.so
