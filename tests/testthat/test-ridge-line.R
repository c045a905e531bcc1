# A surface of strength over (s, d), fitted on a dense grid with df to spare.
surface_of <- function(nu, length = 10, width = 3, df = 60, scale = 1) {
  at <- expand.grid(s = seq(0, length, length.out = 61), d = seq(-width, width, length.out = 61))
  window <- structure(data.frame(vertex = seq_len(nrow(at)), s = scale * at$s, d = scale * at$d,
                                 inside = TRUE),
                      length = scale * length, width = scale * width,
                      class = c("path_coordinates", "data.frame"))
  curvature_surface(window, nu(at$s, at$d) / scale, ridge_settings(df = df, anisotropy = 1))
}
bow <- function(s) 0.8 * sin(pi * s / 10)
bowed <- function(s, d) 1 - (d - bow(s))^2 / 9
wavy <- function(s, d) exp(-(d - sin(s / 2))^2) + 0.4 * exp(-(d + 1.8)^2)

test_that("the ridge of a strength whose ridge is known comes back", {
  line <- ridge_line(surface_of(bowed), scale = 1, radius = 2, ridge_settings(lambda = 1e-8))
  expect_lt(max(abs(line$alpha - bow(line$s))), 0.01)
  expect_true(line$converged)
  expect_false(line$at_bound)
  expect_identical(line$s[c(1, 41)], c(0, 10))
  expect_identical(line$alpha[c(1, 41)], c(0, 0))
})

test_that("a heavy penalty gives the straight path, lambda in between in between", {
  reach <- function(lambda) {
    max(ridge_line(surface_of(bowed), 1, 2, ridge_settings(lambda = lambda))$alpha)
  }
  expect_lt(reach(1e6), 1e-3)
  expect_gt(reach(1e-8), 0.75)
  expect_lt(reach(1e-2), reach(1e-4))
})

test_that("gradient and Hessian are those of finite differences", {
  problem <- ridge_problem(surface_of(wavy), 0.8, 2, ridge_settings())
  alpha <- with_seed(1, 0.5 * stats::rnorm(39))
  h <- 1e-5
  numeric_gradient <- vapply(seq_along(alpha), function(i) {
    step <- replace(numeric(39), i, h)
    (ridge_criterion(problem, alpha + step) - ridge_criterion(problem, alpha - step)) / (2 * h)
  }, 0)
  gradient <- ridge_gradient(problem, alpha)
  expect_lt(max(abs(gradient - numeric_gradient)), 1e-6 * max(abs(gradient)))
  numeric_hessian <- vapply(seq_along(alpha), function(i) {
    step <- replace(numeric(39), i, h)
    (ridge_gradient(problem, alpha + step) - ridge_gradient(problem, alpha - step)) / (2 * h)
  }, alpha)
  hessian <- ridge_hessian(problem, ridge_bend(problem, alpha))
  expect_lt(max(abs(hessian - numeric_hessian)), 1e-6 * max(abs(hessian)))
})

test_that("splines across, and their derivatives, are those of the package splines", {
  margin <- spline_margin(10, -1, 1)
  at <- c(-1, -0.999, seq(-0.9, 0.9, by = 0.13), margin$knots[6:8], 1)
  for (derivative in 0:3) {
    expect_equal(cpp_spline_design(margin$knots, at, 0, derivative),
                 splines::splineDesign(margin$knots, at, 4, rep(derivative, length(at))),
                 tolerance = 1e-12)
  }
})

test_that("under a kernel splines are their integrals, derivatives those of differences", {
  surface <- surface_of(wavy)
  width <- 3
  alpha <- c(-2.9, -1.2, 0, 0.31, 2.2)
  for (kernel in c(0.05, 0.6, 2.5)) {
    problem <- ridge_problem(surface, 0.8, 2, ridge_settings(), kernel)
    exact <- across_design(problem, alpha, 0)
    biweight <- function(d, at) 15 / 16 / kernel * pmax(1 - ((d - at) / kernel)^2, 0)^2
    for (i in seq_along(alpha)) {
      knots <- sort(c(problem$across$knots[4:11] * width, alpha[i] + c(-1, 1) * kernel))
      knots <- knots[abs(knots) <= 1.01 * width]
      for (j in c(1, 4, 10)) {
        spline <- function(d) margin_design(problem$across, d / width)[, j] * biweight(d, alpha[i])
        pieces <- vapply(seq_along(knots[-1]), function(k)
          stats::integrate(spline, knots[k], knots[k + 1], rel.tol = 1e-10)$value, 0)
        expect_equal(exact[i, j], sum(pieces), tolerance = 1e-7)
      }
    }
    h <- 1e-5
    expect_equal(across_design(problem, alpha, 1),
                 (across_design(problem, alpha + h, 0) - across_design(problem, alpha - h, 0)) /
                 (2 * h), tolerance = 1e-6)
    expect_equal(across_design(problem, alpha, 2),
                 (across_design(problem, alpha + h, 1) - across_design(problem, alpha - h, 1)) /
                 (2 * h), tolerance = 1e-5)
  }
})

test_that("a narrow kernel changes nothing, a wide one leads from the mode to the centroid", {
  # Strength with its mode at 0.5 and more of it on the other side.
  skew <- function(s, d) exp(-2 * (d - 0.5)^2) + 0.6 * exp(-0.5 * (d + 0.7)^2)
  surface <- surface_of(skew, df = 90)
  middle <- function(kernel) {
    line <- ridge_line(surface, 1, 2, ridge_settings(lambda = 1e-9), kernel)
    expect_true(line$converged)
    line$alpha[21]
  }
  nu <- function(d) predict(surface, 5, d)
  mode <- stats::optimize(function(d) -nu(d), c(0, 1), tol = 1e-9)$minimum
  expect_equal(middle(0), mode, tolerance = 0.01)
  expect_equal(middle(1e-3), middle(0), tolerance = 1e-5)
  under <- function(kernel) {
    stats::optimize(function(at)
      -stats::integrate(function(d) nu(d) * pmax(1 - ((d - at) / kernel)^2, 0)^2, -3, 3)$value,
                    c(-1, 1))$minimum
  }
  expect_equal(middle(2), under(2), tolerance = 0.01)
  expect_lt(middle(2), middle(0) - 0.1)
})

test_that("the criterion is the integral that is written down", {
  surface <- surface_of(wavy)
  problem <- ridge_problem(surface, 0.8, 2, ridge_settings())
  alpha <- 0.5 * sin(pi * problem$u)
  nu <- predict(surface, problem$u * 10, alpha) / 0.8
  bend <- diff(alpha / 2, differences = 2) * 40^2
  expect_equal(problem$lambda, 1e-4 / (0.8 * 2))
  expected <- (sum(nu) - sum(nu[c(1, 41)]) / 2) / 40 - problem$lambda * sum(bend^2) / 40
  expect_equal(ridge_criterion(problem, alpha[-c(1, 41)]), expected, tolerance = 1e-9)
})

test_that("the paper's lambda is its own sum over second differences", {
  surface <- surface_of(wavy)
  problem <- ridge_problem(surface, 0.8, 2, ridge_settings("paper"))
  alpha <- 0.3 * sin(2 * pi * problem$u)
  plain <- ridge_problem(surface, 0.8, 2, ridge_settings("paper", lambda = 1e-12))
  difference <- ridge_criterion(plain, alpha[-c(1, 41)]) -
    ridge_criterion(problem, alpha[-c(1, 41)])
  # Times nu0 and the number of steps: sum of strengths - 0.5 sum of squared second differences.
  expect_equal(difference * 0.8 * 40, 0.5 * sum(diff(alpha, differences = 2)^2) * 40,
               tolerance = 1e-6)
})

test_that("steps never lower the criterion, also where whole Newton steps would", {
  narrow <- function(s, d) exp(-16 * (d - 0.3 * sin(pi * s / 10))^2)
  surface <- surface_of(narrow, df = 90)
  criterion <- function(k) {
    ridge_line(surface, 1, 2, ridge_settings(lambda = 1e-7, iterations = k))$criterion
  }
  start <- ridge_criterion(ridge_problem(surface, 1, 2, ridge_settings()), numeric(39))
  expect_false(is.unsorted(c(start, vapply(1:12, criterion, 0))))
})

test_that("where the criterion is not concave the Hessian has a stand-in that goes up", {
  dip <- function(s, d) d^2 / 4 + 0.1 * d
  problem <- ridge_problem(surface_of(dip), 1, 2, ridge_settings(lambda = 1e-8))
  bend <- ridge_bend(problem, numeric(39))
  expect_error(chol(-ridge_hessian(problem, bend)))
  factor <- ascent_factor(problem, bend)
  gradient <- ridge_gradient(problem, numeric(39))
  step <- backsolve(factor, backsolve(factor, gradient, transpose = TRUE))
  expect_gt(sum(step * gradient), 0)
  expect_lt(max(ridge_line(surface_of(dip), 1, 2)$alpha), 0.98 * 3 + 1e-12)
})

test_that("a line that converged has no slope left and is a maximum", {
  for (nu in list(bowed, wavy)) {
    surface <- surface_of(nu)
    line <- ridge_line(surface, 1, 2)
    expect_true(line$converged)
    expect_lt(line$gradient, 1e-7)
    expect_lt(line$iterations, 30)
    problem <- ridge_problem(surface, 1, 2, ridge_settings())
    near <- vapply(1:20, function(seed) {
      with_seed(seed, ridge_criterion(problem, line$alpha[2:40] + 1e-3 * stats::rnorm(39)))
    }, 0)
    expect_true(all(near < line$criterion))
  }
})

test_that("too few iterations: not converged, and said so", {
  line <- ridge_line(surface_of(wavy), 1, 2, ridge_settings(iterations = 1))
  expect_false(line$converged)
  expect_output(print(line), "NOT converged after 1 step")
})

test_that("a ridge outside the window stays at its bound, and says so", {
  line <- ridge_line(surface_of(function(s, d) 1 + d), 1, 2, ridge_settings(lambda = 1e-9))
  expect_true(line$at_bound)
  expect_lte(max(abs(line$alpha)), 0.98 * 3 + 1e-12)
  expect_output(print(line), "along the edge of the window")
})

test_that("the ridge by the path is taken, not the higher one far off", {
  two <- function(s, d) exp(-4 * (d - 0.2)^2) + 2 * exp(-4 * (d - 2.3)^2)
  line <- ridge_line(surface_of(two, df = 80), 1, 2)
  expect_lt(max(line$alpha), 0.8)
})

test_that("no unit: lengths times a factor give the line times that factor", {
  once <- ridge_line(surface_of(wavy), scale = 0.8, radius = 2)
  for (factor in c(1e-3, 1e3)) {
    scaled <- ridge_line(surface_of(wavy, scale = factor), scale = 0.8 / factor,
                         radius = 2 * factor)
    expect_equal(scaled$alpha / factor, once$alpha, tolerance = 1e-6)
    expect_equal(scaled$criterion, once$criterion, tolerance = 1e-9)
    expect_equal(scaled$iterations, once$iterations)
  }
})

test_that("the grid hardly matters", {
  coarse <- ridge_line(surface_of(bowed), 1, 2, ridge_settings(grid = 21))
  fine <- ridge_line(surface_of(bowed), 1, 2, ridge_settings(grid = 161))
  expect_equal(fine$alpha[seq(1, 161, by = 8)], coarse$alpha, tolerance = 0.01)
})

test_that("arguments are checked", {
  expect_crestline_error(ridge_line(list(), 1, 2), "curvature_surface")
  expect_crestline_error(ridge_line(surface_of(bowed), 0, 2), "`scale`")
  expect_crestline_error(ridge_line(surface_of(bowed), 1, 2, kernel = -1), "`kernel`")
})

test_that("the last steps are taken, though their rise is lost in rounding", {
  # A criterion of size 1 whose values tell places apart to about the root of the rounding only
  s <- seq(0.05, 9.95, 0.1)
  at <- expand.grid(s = s, d = seq(-2, 2, 0.1))
  columns <- c(list(vertex = seq_len(nrow(at))), as.list(at), list(inside = rep(TRUE, nrow(at))))
  window <- new_path_coordinates(columns, 10, 2, list(key = NULL, id = NULL))
  for (shift in c(0.1, 0.3, 0.5)) {
    strength <- exp(-(at$d - shift * sin(at$s / 2))^2)
    line <- ridge_line(curvature_surface(window, strength), scale = 0.5, radius = 2)
    expect_true(line$converged)
    expect_lt(line$gradient, 1e-9)
    again <- ridge_line(curvature_surface(window, strength * (1 + 1e-15)), scale = 0.5, radius = 2)
    expect_lt(max(abs(line$alpha - again$alpha)), 1e-12)
  }
})
