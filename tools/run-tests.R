# Runs all tests against the installed crestline: a line a file, then what failed and was skipped,
# then N passed, N failed, N skipped counted in test_that() blocks. An error counts as failed, one
# outside a block too; no test at all is a failure.
suppressMessages(library(testthat))
Sys.setenv(NOT_CRAN = "true")

outcome <- function(block) {
  kinds <- vapply(block$results, function(result) class(result)[[1]], "")
  if (any(kinds %in% c("expectation_failure", "expectation_error"))) return("failed")
  if ("expectation_skip" %in% kinds || length(kinds) == 0) "skipped" else "passed"
}

describe <- function(block, kinds) {
  chosen <- Filter(function(result) inherits(result, kinds), block$results)
  name <- if (is.na(block$test)) "outside any test_that()" else block$test
  vapply(chosen, function(result) {
    line <- if (is.null(result$srcref)) "" else paste0(":", result$srcref[[1]])
    paste0(block$file, line, " - ", name, "\n    ", gsub("\n", "\n    ", conditionMessage(result)))
  }, "")
}

unreadable <- function(file, problem) {
  result <- structure(list(message = conditionMessage(problem)),
                      class = c("expectation_error", "condition"))
  list(list(file = basename(file), test = NA_character_, results = list(result)))
}

run_file <- function(file) {
  begun <- proc.time()[["elapsed"]]
  blocks <- tryCatch(
    test_file(file, reporter = "silent", package = "crestline", load_package = "installed"),
    error = function(problem) unreadable(file, problem)
  )
  count <- tally(blocks)
  cat(sprintf("  %-42s %4d passed %4d failed %4d skipped %7.1f s\n", basename(file),
              count[["passed"]], count[["failed"]], count[["skipped"]],
              proc.time()[["elapsed"]] - begun))
  blocks
}

tally <- function(blocks) {
  table(factor(vapply(blocks, outcome, ""), c("passed", "failed", "skipped")))
}

print_section <- function(title, lines) {
  if (length(lines)) cat("", title, paste0("  ", lines), sep = "\n")
}

files <- list.files("tests/testthat", "^test-.*\\.[rR]$", full.names = TRUE)
# The sanitizers look at C++, and slow it five times. These files reach no kernel that others do
# not.
if (identical(Sys.getenv("CRESTLINE_INSTRUMENTED"), "sanitizers")) {
  r_only <- paste0("^test-(app|command|help|layers|messages|norms|plot|portable|print|report|",
                   "sample|study)|^test-placing-(build|check|desk|kept|page|review|suggest)")
  files <- files[!grepl(r_only, basename(files))]
}
blocks <- unlist(lapply(files, run_file), recursive = FALSE)
about <- function(kinds) unlist(lapply(blocks, describe, kinds = kinds))
print_section("Skipped:", about("expectation_skip"))
print_section("Warnings:", about("expectation_warning"))
print_section("Failed:", about(c("expectation_failure", "expectation_error")))
count <- tally(blocks)
if (sum(count) == 0) cat("\nNo test was run: that is a failure.\n")
cat(sprintf("\n%d passed, %d failed, %d skipped\n", count[["passed"]], count[["failed"]],
count[["skipped"]]))
quit(status = as.integer(count[["failed"]] > 0 || count[["passed"]] == 0))
