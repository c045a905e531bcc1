test_that("the band lies two standard errors to each side, across the curve on the surface", {
  sides <- band_sides(equator_curve(), unit_ball())
  expect_equal(sqrt(rowSums((sides$left - sides$right)^2)), rep(0.2, 101), tolerance = 1e-6)
  across <- (sides$left - sides$right) / 0.2
  expect_gt(min(abs(across[, 2])), 0.99)
  expect_true(length(unique(sign(across[, 2]))) == 1)
})

test_that("standard errors are linear between points and absent where no point has one", {
  curve <- equator_curve()
  curve$points$se <- seq(0, 0.1, length.out = 11)
  expect_equal(se_along_path(curve), 0.1 * curve$path$s / max(curve$path$s), tolerance = 0.02)
  curve$points$se <- NA
  expect_true(all(is.na(se_along_path(curve))))
  expect_equal(nrow(band_sides(curve, unit_ball())$left), 0)
})

test_that("curves are drawn where they are seen", {
  count <- function(view) {
    pixels <- drawn_pixels(plot(equator_curve(), ball_specimen(), "plain", view = view,
                                colour = "#00FF00", width = 4, points = FALSE, band = FALSE,
                                legend = FALSE, engine = "picture"), 300, 300)
    sum(pixels[, , 2] > 0.9 & pixels[, , 1] < 0.1)
  }
  expect_gt(count("front"), 200)
  expect_lt(count("back"), 20)
})

test_that("colours are named by kind, or by curve where they were chosen", {
  curves <- list(a = equator_curve("ridge"), b = equator_curve("valley"),
                 c = equator_curve("ridge"))
  key <- curve_key(curves, NULL)
  expect_equal(key$colours[1], key$colours[3])
  expect_named(key$names, c("ridge", "valley"))
  expect_equal(curve_key(curves, c("red", "blue", "green"))$names,
               c(a = "red", b = "blue", c = "green"))
  expect_length(curve_key(unname(curves), "red")$names, 0)
})

test_that("a list of curves, one without a standard error, is drawn with its legend", {
  bare <- equator_curve("plane")
  bare$points$se <- NA
  scene <- draw_quietly(plot_curves(list(equator_curve(), bare), ball_specimen(),
                                    curvature = ball_curvature(), landmarks = TRUE,
                                    engine = "picture"))
  expect_s3_class(scene, "picture_scene")
  expect_error(plot_curves(list(1), ball_specimen()), class = "crestline_error")
  expect_error(plot_curves(list(bare), unit_ball()), class = "crestline_error")
})
