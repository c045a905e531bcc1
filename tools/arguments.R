# Every exported function with a wrong value for every argument: each call must give a value or a
# crestline_error that names the argument.
#
#   Rscript tools/arguments.R [function ...]
#
# Uses the installed crestline. Each function runs in a process of its own, so that a crash of R is
# caught and counted; ends with status 1 if anything but a value or a refusal came out. The table is
# in tests/testthat/helper-arguments.R.

options(rgl.useNULL = TRUE)
suppressPackageStartupMessages(library(crestline))
arguments <- commandArgs(TRUE)
script <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
# As the tests have it: with what the package does not export.
table <- new.env(parent = asNamespace("crestline"))
sys.source(file.path(dirname(script), "..", "tests", "testthat", "helper-arguments.R"), table)
for (name in c("argument_calls", "try_arguments", "leaks_of")) assign(name, table[[name]])

# The child's work, on a file.
if (identical(arguments[1], "--child")) {
  calls <- readRDS(arguments[3])
  grDevices::pdf(NULL)
  tried <- try_arguments(calls, arguments[2])
  saveRDS(tried, arguments[4])
  quit(status = 0)
}

try_function <- function(fn, calls) {
  file <- tempfile()
  status <- system2("Rscript",
                    c("--vanilla", shQuote(script), "--child", fn, shQuote(calls), shQuote(file)),
                    stdout = FALSE,
                    stderr = FALSE)
  if (status == 0) return(readRDS(file))
  data.frame(fn = fn, argument = "", value = "", outcome = sprintf("CRASHED: status %d", status),
             must = FALSE)
}

calls <- suppressWarnings(argument_calls())
file <- tempfile(fileext = ".rds")
saveRDS(calls, file)
functions <- names(Filter(function(one) length(one$kinds) > 0,
                          if (length(arguments)) calls[arguments] else calls))
tried <- do.call(rbind, lapply(functions, function(fn) {
  rows <- try_function(fn, file)
  bad <- leaks_of(rows)
  cat(sprintf("%-20s %4d calls, %d wrong\n", fn, nrow(rows), nrow(bad)))
  for (i in seq_len(nrow(bad))) {
    cat("   ", bad$argument[i], "=", bad$value[i], "->",
        substr(gsub("\\s+", " ", bad$outcome[i]), 1, 110), "\n")
  }
  rows
}))
crashed <- startsWith(tried$outcome, "CRASHED")
without <- startsWith(tried$outcome, "refused without")
unnamed <- without & tried$must
leaked <- !tried$outcome %in% c("returned", "refused") & !crashed & !without
silent <- tried$outcome == "returned" & tried$must
cat(sprintf(paste("%d calls: %d returned, %d refused, %d refused without the argument's name,",
                  "%d returned what they must refuse, "),
            nrow(tried), sum(tried$outcome == "returned"),
            sum(tried$outcome == "refused" | without & !tried$must), sum(unnamed), sum(silent)))
cat(sprintf("%d errors of R, %d crashes\n", sum(leaked), sum(crashed)))
quit(status = if (any(leaked | crashed | unnamed | silent)) 1 else 0)
