# Rscript tools/lint.R R tools: every lint of these folders, then their number by linter. Status 1 where there is any.

lint_folder <- function(folder) {
  found <- as.data.frame(lintr::lint_dir(folder, relative_path = FALSE))
  found$filename <- file.path(folder, basename(found$filename))
  found
}

found <- do.call(rbind, lapply(commandArgs(TRUE), lint_folder))
if (nrow(found) > 0) {
  cat(sprintf("%s:%d: %s [%s]", found$filename, found$line_number, found$message, found$linter), sep = "\n")
  count <- sort(table(found$linter), decreasing = TRUE)
  cat(sprintf("%6d %s", count, names(count)), sep = "\n")
}
cat(nrow(found), "lints\n")
quit(status = as.integer(nrow(found) > 0))
