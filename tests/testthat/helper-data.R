# Real scans that are not part of the package: tests that use them skip where they are absent.
# CRESTLINE_SHARED names the folder; `make test` sets it when ../shared/data is there.
shared_data <- function(...) {
  root <- Sys.getenv("CRESTLINE_SHARED", "")
  path <- file.path(root, ...)
  if (!nzchar(root) || !file.exists(path)) testthat::skip("shared data not here (CRESTLINE_SHARED)")
  path
}
