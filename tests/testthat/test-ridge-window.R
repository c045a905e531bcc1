of_bent <- function(specimen, settings) {
  curve_of(specimen, "a", "b", "ridge", radius = 4, width = 5, n = 9, settings = settings)
}

test_that("of a dense window the vertex nearest a cell's centre stands for it; curves stay", {
  window <- structure(data.frame(s = c(0.1, 0.5, 0.9, 1.6, 1.5, 9),
                                 d = c(0.1, 0.6, 0.4, -0.9, -0.5, 0),
                                 inside = c(rep(TRUE, 5), FALSE)), length = 2, width = 1)
  thinned <- thinned_rows(window, 4)
  expect_setequal(thinned$rows, c(2, 5))
  expect_identical(thinned$rows[thinned$cell], c(2L, 2L, 2L, 5L, 5L, NA))
  expect_identical(thinned_rows(window, 5)$rows, 1:5)
  dense <- bent_ridge(spacing = 0.4)
  whole <- of_bent(dense, ridge_settings("one pass", vertices = Inf))
  some <- of_bent(dense, ridge_settings("one pass", vertices = 500))
  expect_gt(length(whole$surface$rows), 1500)
  expect_lte(length(some$surface$rows), 550)
  expect_lt(max(distance_from_line(xyz_of(some$path), xyz_of(whole$path))), 0.02)
  expect_equal(some$strength, whole$strength, tolerance = 0.01)
})
