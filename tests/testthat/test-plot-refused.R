test_that("every class that prints plots too, or names what to plot instead", {
  namespace <- readLines(system.file("NAMESPACE", package = "crestline"))
  classes <- function(generic) {
    found <- grep(sprintf("^S3method[(]%s,", generic), namespace, value = TRUE)
    sub("^S3method[(][a-z]+, *([a-z_]+).*", "\\1", found)
  }
  # A kept shape is plotted as the shape that it is read as.
  expect_equal(setdiff(classes("print"), c(classes("plot"), "kept_shape")), character())
  refused <- names(plotted_instead)
  expect_true(all(refused %in% classes("plot")))
  for (class in refused) {
    error <- expect_error(plot(structure(list(), class = class)), class = "crestline_error")
    expect_match(conditionMessage(error), plotted_instead[[class]], fixed = TRUE)
  }
})
