test_that("curves that were measured by another radius, window or kind are told of by name", {
  shapes <- list(a = paired_shape(id = "a"), b = paired_shape(id = "b"))
  expect_no_warning(warn_curve_tables(shapes))
  other <- shapes
  change <- function(shape, column, value) {
    shape$scheme <- tampered(shape$scheme, function(x) {
      x$curves[[column]][7] <- value
      x
    })
    shape
  }
  other$b <- change(other$b, "kind", "ridge")
  expect_warning(warn_curve_tables(other), "kind of middle (b)", fixed = TRUE,
                 class = "crestline_other_radius")
  other <- lapply(other, change, "radius", 5)
  other$b <- change(other$b, "kind", "plane")
  expect_no_warning(warn_curve_tables(other))
  other$b <- change(other$b, "radius", 5 * (1 + 1e-9))
  expect_no_warning(warn_curve_tables(other))
  other$b <- change(other$b, "radius", 7)
  expect_warning(warn_curve_tables(other), "radius of middle (b)", fixed = TRUE)
})
