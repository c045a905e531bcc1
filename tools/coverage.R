# Rscript tools/coverage.R TREE REPORT: runs the tests of TREE under covr and writes shares of lines
# run to REPORT.
library(covr)

# covr compiles at -O0; the tests would take several times as long.
options(covr.flags = sub("-O0", "-O1", getOption("covr.flags")))

share <- function(lines) 100 * mean(lines$value > 0)

file_rows <- function(lines) {
  by_file <- split(lines, lines$filename)
  sprintf("    %6.1f %%  %5d lines  %s", vapply(by_file, share, 0), vapply(by_file, nrow, 0L),
          names(by_file))
}

# One line a language; UNDER marks what coverage.sh fails on.
verdict <- function(name, lines, least) {
  if (nrow(lines) == 0) return(sprintf("UNDER %g %%: %s has no lines that could be counted", least,
                                       name))
  sprintf("%s %g %%: %s %.1f %% of %d lines", if (share(lines) < least) "UNDER" else "at least",
          least, name, share(lines), nrow(lines))
}

argument <- commandArgs(TRUE)
least <- as.numeric(Sys.getenv("COVERAGE_MIN", "90"))
# The log that the error names goes with this process: what failed in it is shown first.
show_failed <- function(problem) {
  file <- regmatches(conditionMessage(problem), regexpr("[^`]+testthat[.]Rout[.]fail",
                                                        conditionMessage(problem)))
  if (!length(file) || !file.exists(file)) return(invisible())
  log <- readLines(file, warn = FALSE)
  at <- grep("^(\u2500\u2500|--) (Failure|Error)", log)
  for (i in at) writeLines(log[i:min(i + 12, length(log))])
}
covered <- withCallingHandlers(package_coverage(argument[1], type = "tests", quiet = FALSE),
                               error = show_failed)
lines <- tally_coverage(covered, by = "line")
is_r <- grepl("^R/", lines$filename)
writeLines(
  c(file_rows(lines), verdict("R", lines[is_r, ], least), verdict("C++", lines[!is_r, ], least)),
  argument[2]
)
