# Rscript tools/lint.R R tools: every lint of the files in these folders, then their number by
# linter; in the other folders of R code, and in the vignettes, the lines that are too long.
# Status 1 where there is any. Files are shared out among the cores.

lint_file <- function(file) as.data.frame(lintr::lint(file, parse_settings = TRUE))

files <- list.files(commandArgs(TRUE), "[.]R$", full.names = TRUE)
found <- parallel::mclapply(files, lint_file, mc.cores = parallel::detectCores(),
                            mc.preschedule = FALSE)
failed <- vapply(found, inherits, NA, "try-error")
if (any(failed)) stop(files[failed][1], ": ", found[failed][[1]])
found <- do.call(rbind, found)
# Rows of tables in roxygen may be longer.
table_row <- found$linter == "line_length_linter" & grepl("^#' [|]", found$line)
found <- found[!table_row, ]
if (nrow(found) > 0) {
  cat(sprintf("%s:%d: %s [%s]", found$filename, found$line_number, found$message, found$linter),
      sep = "\n")
  count <- sort(table(found$linter), decreasing = TRUE)
  cat(sprintf("%6d %s", count, names(count)), sep = "\n")
}
cat(length(files), "files,", nrow(found), "lints\n")

# Of tests, benches and vignettes the lines' length alone: lintr would take minutes. Rows of tables
# may be longer.
widest <- 100
others <- list.files(c("tests", "bench", "data-raw", "vignettes"), "[.](R|Rmd)$", full.names = TRUE,
                     recursive = TRUE)
long <- unlist(lapply(others, function(file) {
  lines <- readLines(file, encoding = "UTF-8", warn = FALSE)
  at <- which(nchar(lines) > widest & !startsWith(lines, "|"))
  if (length(at)) sprintf("%s:%d: %d characters", file, at, nchar(lines[at]))
}))
if (length(long)) cat(long, sep = "\n")
cat(sprintf("%d files of tests, benches and vignettes, %d lines over %d characters\n",
            length(others), length(long), widest))
quit(status = as.integer(nrow(found) > 0 || length(long) > 0))
