# Coordinates of n places in a window 10 long and 2 x 3 wide, with a strength and noise.
window_of <- function(n = 400, length = 10, width = 3, seed = 1) {
  with_seed(seed, structure(
    data.frame(vertex = seq_len(n), s = stats::runif(n, 0, length),
               d = stats::runif(n, -width, width), inside = TRUE),
    length = length, width = width, class = c("path_coordinates", "data.frame")))
}
bumps <- function(window, noise = 0.1) {
  with_seed(2, exp(-(window$d - sin(window$s / 2))^2) + noise * stats::rnorm(nrow(window)))
}

test_that("the fit is mgcv's own with the same basis, penalties and smoothing parameter", {
  window <- window_of()
  data <- data.frame(y = bumps(window), u = window$s / 10, v = window$d / 3)
  settings <- ridge_settings(anisotropy = 7)
  smooth <- curvature_surface(window, data$y, settings)
  terms <- mgcv::te(u, v, bs = "ps", k = c(10, 10), m = c(2, 2), np = FALSE)
  theirs <- mgcv::smoothCon(terms, data, knots = list(u = c(0, 1), v = c(-1, 1)),
                            scale.penalty = FALSE)[[1]]
  # mgcv scales each margin's penalty by its largest eigenvalue.
  largest <- max(eigen(spline_margin(10, 0, 1)$S[[1]], symmetric = TRUE)$values)
  S <- largest * (theirs$S[[1]] + 7 * theirs$S[[2]])
  beta <- solve(crossprod(theirs$X) + smooth$penalty * S, crossprod(theirs$X, data$y))
  expect_equal(predict(smooth, window$s, window$d), as.vector(theirs$X %*% beta), tolerance = 1e-6)
})

test_that("mgcv::gam at the same smoothing has the same fitted values and degrees of freedom", {
  window <- window_of(900)
  data <- data.frame(y = bumps(window), u = window$s / 10, v = window$d / 3)
  smooth <- curvature_surface(window, data$y)
  X <- mgcv::tensor.prod.model.matrix(smooth$design)
  S <- tensor_penalty(smooth$margins, 10)
  fit <- mgcv::gam(y ~ X - 1, data = list(y = data$y, X = X),
                   paraPen = list(X = list(S, sp = smooth$penalty)))
  expect_equal(predict(smooth, window$s, window$d), unname(stats::fitted(fit)), tolerance = 1e-6)
  expect_equal(sum(fit$edf), smooth$df, tolerance = 1e-6)
})

test_that("the degrees of freedom are the trace of the hat matrix", {
  window <- window_of()
  for (df in c(6, 12, 20, 45)) {
    smooth <- curvature_surface(window, bumps(window), ridge_settings(df = df))
    hat <- crossprod(backsolve(smooth$factor, t(mgcv::tensor.prod.model.matrix(smooth$design)),
                               transpose = TRUE))
    expect_equal(sum(diag(hat)), df, tolerance = 1e-6)
    expect_equal(smooth$df, df, tolerance = 1e-6)
    expect_true(smooth$converged)
    expect_equal(as.vector(hat %*% smooth$strength), predict(smooth, window$s, window$d),
                 tolerance = 1e-8)
  }
})

test_that("what no penalty touches comes back exactly: bilinear strength, whatever the df", {
  window <- window_of()
  bilinear <- 2 - 0.3 * window$s + 0.5 * window$d + 0.1 * window$s * window$d
  smooth <- curvature_surface(window, bilinear, ridge_settings(df = 6))
  expect_equal(predict(smooth, window$s, window$d), bilinear, tolerance = 1e-5)
  expect_equal(predict(smooth, c(0, 5, 10), 1), 2.5 - 0.2 * c(0, 5, 10), tolerance = 1e-5)
})

test_that("anisotropy smooths across more than along", {
  window <- window_of(900)
  across <- function(anisotropy) {
    fit <- curvature_surface(window, bumps(window, 0), ridge_settings(anisotropy = anisotropy))
    stats::sd(predict(fit, 5, seq(-2.9, 2.9, by = 0.1)))
  }
  expect_lt(across(1000), across(10))
  expect_lt(across(10), across(0.1))
})

test_that("derivatives by d are those of finite differences", {
  window <- window_of()
  smooth <- curvature_surface(window, bumps(window))
  s <- c(0.4, 3, 7.7)
  d <- c(-2.2, 0.1, 1.7)
  h <- 1e-4
  slope <- (predict(smooth, s, d + h) - predict(smooth, s, d - h)) / (2 * h)
  expect_equal(predict(smooth, s, d, derivative = 1), slope, tolerance = 1e-6)
  bend <- (predict(smooth, s, d + h, 1) - predict(smooth, s, d - h, 1)) / (2 * h)
  expect_equal(predict(smooth, s, d, derivative = 2), bend, tolerance = 1e-6)
})

test_that("predict() recycles s and d", {
  smooth <- curvature_surface(window_of(), bumps(window_of()))
  expect_equal(predict(smooth, 3, c(-1, 0, 1)),
               c(predict(smooth, 3, -1), predict(smooth, 3, 0), predict(smooth, 3, 1)))
  expect_equal(predict(smooth, c(1, 2, 3), 0), vapply(1:3, function(s) predict(smooth, s, 0), 0))
})

test_that("places past the ends and left-out vertices take no part", {
  window <- window_of()
  strength <- bumps(window)
  window$inside[1:50] <- FALSE
  strength[51:90] <- NA
  smooth <- curvature_surface(window, strength)
  expect_identical(smooth$rows, 91:400)
  strength[1:50] <- 1e6
  expect_identical(curvature_surface(window, strength)$coefficients, smooth$coefficients)
})

test_that("too few vertices are an error, more df than there is room for are told", {
  window <- window_of(40)
  expect_crestline_error(curvature_surface(window, replace(bumps(window), 1:25, NA)),
                         c("only 15 vertices", "20", "`width`"))
  expect_crestline_error(curvature_surface(data.frame(), 1), "path_coordinates")
  crowded <- window_of(30)
  crowded$s <- rep(c(2, 8), 15)
  crowded$d <- rep(c(-1, 1, 0), 10)
  tight <- curvature_surface(crowded, bumps(crowded))
  expect_false(tight$converged)
  expect_output(print(tight), "df not reached")
})

test_that("a surface prints its size and df", {
  expect_output(print(curvature_surface(window_of(), bumps(window_of()))),
                "10 x 6 .*400 vertices, 20.0 df")
})

test_that("vertices on a line determine no surface: an error, not a crash", {
  window <- window_of()
  window$d <- 0
  expect_crestline_error(curvature_surface(window, bumps(window)), c("on a line", "`width`"))
})

test_that("moments of the tensor product are those of mgcv's own design", {
  with_seed(1, {
    u <- runif(200)
    v <- runif(200, -1, 1)
    y <- rnorm(200)
  })
  design <- list(along = margin_design(spline_margin(7, 0, 1), u),
                 across = margin_design(spline_margin(5, -1, 1), v))
  found <- cpp_tensor_moments(design$along, design$across, y)
  dense <- mgcv::tensor.prod.model.matrix(design)
  expect_equal(found$matrix, crossprod(dense), tolerance = 1e-12)
  expect_equal(found$right, as.vector(crossprod(dense, y)), tolerance = 1e-12)
})
