test_that("curves that were measured by another radius, window or kind are told of by name", {
  shapes <- list(a = paired_shape(id = "a"), b = paired_shape(id = "b"))
  expect_no_warning(warn_curve_tables(shapes))
  other <- shapes
  other$b$scheme$curves$kind[7] <- "ridge"
  expect_warning(warn_curve_tables(other), "kind of middle (b)", fixed = TRUE,
                 class = "crestline_other_radius")
  for (one in names(other)) other[[one]]$scheme$curves$radius[7] <- 5
  other$b$scheme$curves$kind[7] <- "plane"
  expect_no_warning(warn_curve_tables(other))
  other$b$scheme$curves$radius[7] <- 5 * (1 + 1e-9)
  expect_no_warning(warn_curve_tables(other))
  other$b$scheme$curves$radius[7] <- 7
  expect_warning(warn_curve_tables(other), "radius of middle (b)", fixed = TRUE)
})
