fit_of <- function(settings = ridge_settings(), passes = NULL, noise = 0) {
  settings["passes"] <- list(passes)
  suppressWarnings(ridge_curve(bent_ridge(noise = noise), "a", "b", "ridge", radius = 4,
                               width = 5, n = 9, settings = settings))
}

test_that("one pass is the setting of that name, and is what `passes = 1` gives without a kernel", {
  once <- fit_of(ridge_settings("one pass"))
  expect_identical(once$line$alpha, fit_of(ridge_settings("one pass"), passes = 1)$line$alpha)
  expect_identical(once$line$alpha, fit_of(ridge_settings(kernel = 0), passes = 1)$line$alpha)
  expect_identical(once$share, 0)
  expect_identical(once$line$kernel, 0)
})

test_that("a share of the second pass is taken: its offsets times it, about the first", {
  settings <- ridge_settings(kernel = 0, lambda = 1e-3)
  whole <- fit_of(settings, passes = 2)
  part <- fit_of(settings)
  expect_gt(part$share, 0)
  expect_lt(part$share, 1)
  expect_equal(part$line$alpha, part$share * whole$line$alpha)
  expect_equal(part$reference$x, whole$reference$x)
  flat <- fit_of(ridge_settings(kernel = 0, lambda = 1e-3, second_gain = 1e6))
  expect_equal(flat$share, 0.5, tolerance = 1e-4)
  expect_gt(part$share, 0.5) # the second curve is stronger
})

test_that("the kernel is a dozen standard errors wide, within limits, none on a clean mesh", {
  expect_identical(fit_of()$line$kernel, 0)
  noisy <- fit_of(ridge_settings(kernel = 12), noise = 0.2)
  expect_gt(noisy$line$kernel, 0.15 * 4)
  expect_lte(noisy$line$kernel, 1.4 * 4)
  double <- fit_of(ridge_settings(kernel = 6), noise = 0.2)
  if (noisy$line$kernel < 1.4 * 4) expect_equal(noisy$line$kernel, 2 * double$line$kernel)
  expect_identical(fit_of(ridge_settings(kernel = 1e9), noise = 0.2)$line$kernel, 1.4 * 4)
  expect_identical(fit_of(ridge_settings(kernel = 1e9), noise = 0.2)$share, 1)
})

job_of <- function(bent, settings) {
  curve_job(located_ends(bent, walkable(bent), "a", "b"), "ridge", 9, settings,
            radius = 4, width = 5, source = known_curvature(NULL, bent, 4, 1L, "adaptive cubic"))
}

test_that("the standard error of a first line alone sets the kernel", {
  bent <- bent_ridge(noise = 0.2)
  settings <- ridge_settings()
  path <- reference_path(bent, "a", "b", "ridge", 4)
  window <- ridge_window(walkable(bent), path, job_of(bent, settings))
  window$line <- ridge_line(window$surface, window$scale, 4, settings)
  scan <- walkable(bent)
  se <- function(...) {
    noise <- moment_noise(scan, window, 4, settings, ...)
    sqrt(linear_variance(line_slope(window, 4, settings), noise$matrix))
  }
  all <- ridge_settings(kernel_most = 1e9, kernel_vertices = Inf)
  expect_equal(kernel_width(scan, window, 4, all), 12 * stats::median(se()))
  # Of 170 vertices one stands for each of 80 cells.
  expect_gt(sum(window$surface$strength > 0), 160)
  expect_equal(se(80), se(), tolerance = 0.1)
})

test_that("mixing in principal curvature is off by default and whole under a wide kernel", {
  bent <- bent_ridge(noise = 0.2)
  path <- reference_path(bent, "a", "b", "ridge", 4)
  strengths <- function(share, ...) {
    ridge_window(walkable(bent), path, job_of(bent, ridge_settings(...)), share)$strengths
  }
  expect_identical(strengths(0)$value, strengths(0, mix = 0.6)$value)
  expect_equal(strengths(1)$value, strengths(0, strength = "principal")$value)
  expect_equal(strengths(0.25)$value, 0.75 * strengths(0)$value + 0.25 * strengths(1)$value)
  mixed <- fit_of(ridge_settings(mix = 0.6), noise = 0.2)
  plain <- fit_of(noise = 0.2)
  expect_gt(max(abs(mixed$line$alpha - plain$line$alpha)), 1e-6)
})

test_that("what is known of the reference path stays with a later pass", {
  once <- attributes(fit_of(passes = 1)$reference)
  twice <- attributes(fit_of(passes = 2)$reference)
  half <- attributes(fit_of()$reference)
  for (name in c("type", "criterion", "optima", "competing")) {
    expect_identical(twice[[name]], once[[name]])
    expect_identical(half[[name]], once[[name]])
  }
})
