# What every help page must have: they are read in the sources.

help_pages <- function() {
  files <- list.files(testthat::test_path("..", "..", "man"), "[.]Rd$", full.names = TRUE)
  testthat::skip_if(!length(files), "sources not here")
  pages <- vapply(files, function(file) paste(readLines(file, encoding = "UTF-8"), collapse = "\n"),
                  "")
  stats::setNames(pages, basename(files))
}

test_that("a page that says \"the paper\" says which", {
  pages <- help_pages()
  said <- grepl("the paper", pages, ignore.case = TRUE)
  named <- grepl("10.1214/19-AOAS1267", pages, fixed = TRUE)
  expect_identical(names(pages)[said & !named], character())
})

test_that("every page leads to the glossary", {
  pages <- help_pages()
  own <- c("crestline-package.Rd", "crestline-deprecated.Rd")
  led <- grepl("glossary", pages, fixed = TRUE) & grepl("crestline-package", pages, fixed = TRUE)
  expect_identical(setdiff(names(pages)[!led], own), character())
})

test_that("no page points at a file that is not in the package", {
  pages <- help_pages()
  outside <- grepl("bench/|tools/|data-raw/|CONTRIBUTING|[.][.]/", gsub("man/figures/", "", pages))
  expect_identical(names(pages)[outside], character())
})
