test_that("the panel shows the smoothed strength within the data's reach", {
  panel <- draw_quietly(plot(equator_curve(), what = "panel", grid = c(30, 21)), 500, 300)
  expect_equal(dim(panel$strength), c(30, 21))
  expect_equal(range(panel$d), c(-0.3, 0.3))
  expect_equal(panel$strength[15, ], exp(-panel$d^2))
})

test_that("it is empty beyond the data", {
  curve <- equator_curve()
  far <- curve$coordinates$s > 1 & curve$coordinates$d > 0
  curve$coordinates <- structure(curve$coordinates[!far, ], length = pi / 2, width = 0.3)
  panel <- panel_grid(curve, c(30, 21))
  expect_true(all(is.na(panel$strength[panel$s > 1.2, panel$d > 0.05])))
  expect_false(anyNA(panel$strength[panel$s < 0.8, ]))
})

test_that("a curve without standard errors has a panel too, anything else has none", {
  curve <- equator_curve()
  curve$line$se <- NULL
  expect_type(draw_quietly(plot(curve, what = "panel", points = FALSE, main = "bare")), "list")
  curve$line <- NULL
  expect_error(plot(curve, what = "panel"), "east to front", class = "crestline_error")
  expect_error(plot.curve(list(), what = "panel"), class = "crestline_error")
})
