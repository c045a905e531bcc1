# The script of array jobs: which part each job measures.

test_that("every job of an array measures its part, and some parts alone are asked how many", {
  skip_on_os("windows")
  script <- system.file("cohort", "measure.sh", package = "crestline")
  skip_if_not(nzchar(script), "not installed")
  # In place of R: says what it was called with.
  bin <- tempfile("bin-")
  dir.create(bin)
  on.exit(unlink(bin, recursive = TRUE))
  writeLines(c("#!/bin/sh", "[ \"$1\" = -e ] || echo \"$2 $3 $4 $5\""), file.path(bin, "Rscript"))
  Sys.chmod(file.path(bin, "Rscript"), "755")
  job <- function(id, array, parts = "") {
    slurm <- sprintf("SLURM_ARRAY_TASK_%s=%s", c("ID", "MIN", "MAX", "COUNT"),
                     c(id, min(array), max(array), length(array)))
    path <- paste0("PATH=", bin, ":", Sys.getenv("PATH"))
    suppressWarnings(system2("env", c(path, slurm, paste0("PARTS=", parts), "bash",
                                      shQuote(script), "scans", "results"),
                             stdout = TRUE, stderr = FALSE))
  }
  expect_identical(as.character(job(3, 1:8)), "scans results 3 8")
  expect_identical(as.character(job(3, 3, "8")), "scans results 3 8")
  for (array in list(3, 2:3, c(1, 3))) expect_identical(attr(job(3, array), "status"), 2L)
})
