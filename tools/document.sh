#!/usr/bin/env bash
# Writes what is generated: src/RcppExports.cpp, R/RcppExports.R, NAMESPACE and man/.
set -euo pipefail
cd "$(dirname "$0")/.."
Rscript --vanilla -e 'Rcpp::compileAttributes("."); roxygen2::roxygenise(".")'
# Its objects are without optimisation: none may be left for an installation to find.
rm -f src/*.o src/*.so
