crest_curve <- function() curve_of(bent_ridge(), "a", "b", "ridge", radius = 4, width = 5, n = 9)

test_that("intervals of a curve are its distance and normal quantiles of its error", {
  curve <- crest_curve()
  bounds <- confint(curve)
  expect_identical(dimnames(bounds), list(as.character(curve$points$point), c("2.5 %", "97.5 %")))
  expect_equal(unname(bounds[, 2] - bounds[, 1]), 2 * 1.959964 * curve$points$se, tolerance = 1e-6)
  expect_equal(unname(rowMeans(bounds)), curve$points$d)
  expect_equal(unname(bounds[1, ]), c(0, 0))
  half <- confint(curve, 3:4, level = 0.5)
  expect_identical(dimnames(half), list(c("3", "4"), c("25 %", "75 %")))
  expect_equal(unname(half[, 2] - half[, 1]), 2 * 0.6744898 * curve$points$se[3:4],
               tolerance = 1e-6)
  expect_crestline_error(confint(curve, 99), "parm")
  expect_crestline_error(confint(curve, level = 1), "level")
})

test_that("tidy tables of a curve have broom's names", {
  skip_if_not_installed("generics")
  curve <- crest_curve()
  tidied <- generics::tidy(curve, conf.int = TRUE)
  expect_named(tidied, c("term", "s", "estimate", "std.error", "conf.low", "conf.high"))
  expect_equal(tidied$conf.low, unname(confint(curve)[, 1]))
  vertices <- generics::augment(curve)
  expect_named(vertices, c("vertex", "s", "d", "strength", ".fitted", ".resid"))
  expect_equal(vertices$.fitted + vertices$.resid, vertices$strength)
  expect_equal(vertices$.fitted, predict(curve$surface, vertices$s, vertices$d))
  glanced <- generics::glance(curve)
  expect_equal(nrow(vertices), glanced$nobs)
  expect_equal(glanced$sigma, sqrt(sum(vertices$.resid^2) / (glanced$nobs - glanced$df)))
  expect_true(glanced$converged)
})

test_that("a plane curve has a row, and nothing to augment", {
  skip_if_not_installed("generics")
  plane <- ridge_curve(bent_ridge(), "a", "b", "plane", n = 5)
  expect_true(is.na(generics::glance(plane)$nobs))
  expect_true(all(is.na(confint(plane))))
  expect_crestline_error(generics::augment(plane), "not found by curvature")
})

test_that("a summary has the lines of print, the errors' range, and the settings", {
  curve <- crest_curve()
  shown <- capture.output(print(summary(curve)))
  expect_identical(shown[1:3], capture.output(print(curve)))
  expect_match(shown[5], "standard error 0 to ")
  expect_true(any(grepl("settings: ridge", shown)))
  expect_identical(summary(curve)$provenance$mesh$key, curve$key)
})
