# A window of strength 2 within 0.5 of the line, `beside` farther off.
striped_curve <- function(beside, offset = 0) {
  window <- expand.grid(s = seq(0, 10, by = 0.5), d = seq(-3, 3, by = 0.25))
  structure(
    list(line = list(s = c(0, 10), alpha = c(offset, offset)), points = data.frame(d = rep(offset, 3)), coordinates = window,
         surface = list(rows = seq_len(nrow(window)), strength = ifelse(abs(window$d - offset) <= 0.5, 2, beside)),
         settings = ridge_settings(core = 0.5), radius = 1, strength = 2, type = "ridge"),
    class = "curve"
  )
}

test_that("contrast is the strength along the curve over that beside it", {
  expect_equal(curve_contrast(striped_curve(0.4)), 5)
  expect_equal(curve_contrast(striped_curve(0.4, offset = 1)), 5)
  expect_equal(curve_contrast(striped_curve(2)), 1)
  expect_equal(curve_contrast(striped_curve(0)), Inf)
})

test_that("plane curves, and those that stayed on the reference path, have none", {
  curve <- striped_curve(1)
  curve$points$d <- NA_real_
  expect_true(is.na(curve_contrast(curve)))
  plane <- ridge_curve(quad_specimen(), "a", "b", "plane", n = 5)
  expect_true(is.na(curve_contrast(plane)))
})

test_that("a sharp ridge stands out more than a blunt one", {
  contrast <- function(b) {
    curve_contrast(suppressWarnings(ridge_curve(simulate_ridge(a = 0, b = b, seed = 1), "from", "to", "ridge", 0.25, 0.4, 9)))
  }
  expect_gt(contrast(2), contrast(0.5))
})
