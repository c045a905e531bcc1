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

test_that("README and the package's page name every vignette", {
  files <- list.files(testthat::test_path("..", "..", "vignettes"), "[.]Rmd$")
  readme <- testthat::test_path("..", "..", "README.md")
  testthat::skip_if(!length(files) || !file.exists(readme), "sources not here")
  names <- paste0("`", sub("[.]Rmd$", "", files), "`")
  page <- gsub("\\code{", "`", gsub("}", "`", help_pages()[["crestline-package.Rd"]]), fixed = TRUE)
  said <- paste(readLines(readme, encoding = "UTF-8"), collapse = "\n")
  listed <- function(text) names[!vapply(names, grepl, NA, text, fixed = TRUE)]
  expect_identical(listed(said), character())
  expect_identical(listed(page), character())
})

test_that("the package's page names every function that is exported", {
  page <- help_pages()[["crestline-package.Rd"]]
  names <- setdiff(getNamespaceExports("crestline"),
                   c("plot_cuts", "plot_panel", "plot_placing", "plot_refinement"))
  named <- vapply(paste0(names, "()"), grepl, NA, page, fixed = TRUE)
  expect_identical(sort(names[!named]), character())
})
