# A small window on a bent ridge with everything that ridge_curve() works out.
fitted_window <- function(settings = ridge_settings(), radius = 4) {
  bent <- bent_ridge(noise = 0.05, half = c(17, 12), spacing = 1.25)
  curve <- suppressWarnings(ridge_curve(bent, "a", "b", "ridge", radius = radius, width = 5, n = 9,
                                        settings = settings))
  list(specimen = bent, curve = curve, settings = settings, radius = radius,
       curvature = curvature(bent, radius, order = settings$order),
       problem = ridge_problem(curve$surface, curve$scale, radius, settings))
}

# Variance of linear functions of normal curvatures, a row of `jacobian` each.
curvature_variance <- function(vb, it, targets, directions, jacobian, sigma, settings, smooth = 0,
                               range = 0) {
  margins <- list(along = t(jacobian), across = matrix(1, ncol(jacobian)))
  diag(cpp_curvature_covariance(cpp_mesh_graph(vb, it), targets, directions, margins,
                                seq_along(targets),
                                seq_along(sigma), sigma, 0, c(smooth, range), settings)$matrix)
}

# Normal curvature along `direction` at vertex `at` when vertex `moved` is lifted by h along the
# fit's normal there.
curvature_when <- function(mesh, at, direction, moved, h, normal, ...) {
  mesh$vb[1:3, moved] <- mesh$vb[1:3, moved] + h * normal
  # The mesh is small beside the radius.
  curved <- suppressWarnings(curvature(mesh, vertices = at, ...), classes = "crestline_wide_radius")
  shape <- curved$k1[at] * tcrossprod(curved$direction1[at, ]) + curved$k2[at] *
    tcrossprod(curved$direction2[at, ])
  sum(direction * (shape %*% direction))
}

test_that("a normal curvature's variance is that of its derivatives by vertices' heights", {
  # Nearly level, so that the frame that the derivative holds fixed stays where it is.
  form <- list(x = quote(u), y = quote(v), z = quote((u^2 + 0.5 * v^2) / 200), u = c(-6, 6),
               v = c(-6, 6))
  mesh <- closed_form_mesh(form, spacing = 1)$mesh
  at <- which.min(colSums(mesh$vb[1:2, ]^2))
  radius <- 4.3
  for (order in c("quadratic", "cubic", "quartic")) {
    curved <- suppressWarnings(curvature(mesh, radius, order, vertices = at),
                               classes = "crestline_wide_radius")
    normal <- curved$normal[at, ]
    for (direction in list(curved$direction1[at, ],
                           (curved$direction1[at, ] + curved$direction2[at, ]) / sqrt(2))) {
      near <- which(colSums((mesh$vb[1:3, ] - mesh$vb[1:3, at])^2) <= radius^2)
      h <- 1e-4
      slope <- vapply(near, function(v) {
        up <- curvature_when(mesh, at, direction, v, h, normal, radius = radius, order = order)
        down <- curvature_when(mesh, at, direction, v, -h, normal, radius = radius, order = order)
        (up - down) / (2 * h)
      }, 0)
      sigma <- with_seed(4, stats::runif(ncol(mesh$vb), 0.1, 1))
      variance <- curvature_variance(mesh$vb[1:3, ], mesh$it, at, matrix(direction),
                                     matrix(1), sigma, kernel_settings(radius, order))
      expect_equal(sqrt(variance), sqrt(sum((slope * sigma[near])^2)), tolerance = 0.02)
    }
  }
})

test_that("a quadratic fit's variance is the one that least squares gives", {
  mesh <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-6, 6),
                                v = c(-6, 6)))$mesh
  at <- which.min(colSums(mesh$vb[1:2, ]^2))
  near <- which(colSums((mesh$vb[1:2, ] - mesh$vb[1:2, at])^2) <= 4.3^2)
  x <- mesh$vb[1, near] - mesh$vb[1, at]
  y <- mesh$vb[2, near] - mesh$vb[2, at]
  covariance <- solve(crossprod(cbind(1, x, y, x^2, x * y, y^2)))
  variance <- curvature_variance(mesh$vb[1:3, ], mesh$it, at, matrix(c(1, 0, 0)), matrix(1),
                                 rep(0.3, ncol(mesh$vb)), kernel_settings(4.3, "quadratic"))
  expect_equal(variance, 0.3^2 * 4 * covariance[4, 4], tolerance = 1e-8)
})

test_that("under smooth noise it is the quadratic form of the weights in its covariance", {
  mesh <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-6, 6),
                                v = c(-6, 6)))$mesh
  at <- which.min(colSums(mesh$vb[1:2, ]^2))
  near <- which(colSums((mesh$vb[1:2, ] - mesh$vb[1:2, at])^2) <= 4.3^2)
  x <- mesh$vb[1, near] - mesh$vb[1, at]
  y <- mesh$vb[2, near] - mesh$vb[2, at]
  design <- cbind(1, x, y, x^2, x * y, y^2)
  weight <- 2 * solve(crossprod(design), t(design))[4, ]
  squares <- outer(x, x, `-`)^2 + outer(y, y, `-`)^2
  variance <- function(sigma, smooth, range) {
    curvature_variance(mesh$vb[1:3, ], mesh$it, at, matrix(c(1, 0, 0)), matrix(1),
                       rep(sigma, ncol(mesh$vb)), kernel_settings(4.3, "quadratic"), smooth, range)
  }
  for (range in c(0.7, 1.5, 3)) {
    smooth <- sum(weight * (0.2^2 * exp(-squares / (2 * range^2)) %*% weight))
    # correlations beyond four ranges are left out
    expect_equal(variance(0, 0.2, range), smooth, tolerance = 1e-3)
    expect_equal(variance(0.1, 0.2, range), smooth + 0.1^2 * sum(weight^2), tolerance = 1e-3)
  }
  expect_equal(variance(0, 0.2, 1e-3), 0.2^2 * sum(weight^2))
  expect_lt(variance(0, 0.2, 1e4), 1e-6 * variance(0.2, 0, 0)) # all heights moved alike
})

test_that("the noise factor compares with what the strengths' whole covariance gives", {
  curve <- fitted_window(ridge_settings("one pass"))$curve
  bent <- bent_ridge(noise = 0.05, half = c(17, 12), spacing = 1.25)
  scan <- walkable(bent)
  settings <- ridge_settings("one pass")
  job <- curve_job(located_ends(bent, scan, "a", "b"), "ridge", 9, settings, radius = 4, width = 5,
                   source = known_curvature(NULL, bent, 4, 1L, "adaptive cubic"))
  window <- ridge_window(scan, curve$reference, job)
  surface <- window$surface
  live <- which(surface$strength > 0 & surface$strength < window$strengths$cap)
  rows <- surface$rows[live]
  sigma <- rep(stats::median(window$strengths$sigma, na.rm = TRUE), ncol(bent$mesh$vb))
  known <- !is.na(window$strengths$sigma)
  sigma[window$coordinates$vertex[known]] <- window$strengths$sigma[known]
  all <- cpp_curvature_covariance(mesh_graph(scan), window$coordinates$vertex[rows],
                                  t(window$strengths$direction[rows, ]),
                                  list(along = diag(length(rows)),
                                       across = matrix(1, length(rows))),
                                  seq_along(rows), seq_along(sigma), sigma, 0, c(0, 0),
                                  kernel_settings(4, "adaptive cubic"))$matrix
  design <- mgcv::tensor.prod.model.matrix(surface$design)[live, ]
  rest <- diag(length(live)) - design %*% chol2inv(surface$factor) %*% t(design)
  residual <- surface$strength[live] - design %*% as.vector(surface$coefficients)
  expected <- sum(diag(rest %*% all %*% t(rest)))
  expect_equal(moment_noise(scan, window, 4, settings)$factor, max(1, sum(residual^2) / expected))
})

test_that("the noise factor sees noise that is smooth along the mesh, and known noise needs none", {
  factor_of <- function(correlation, ...) {
    surface <- simulate_ridge(0.25, 1, noise = 0.02, seed = 3, correlation = correlation)
    curve <- suppressWarnings(ridge_curve(surface, "from", "to", "ridge", 0.25, 0.4, 9,
                                          settings = ridge_settings(...)))
    curve$noise_factor
  }
  expect_gt(factor_of(2), 10 * factor_of(0))
  expect_lt(factor_of(0), 4)
  expect_identical(factor_of(2, noise = c(0, 0.02, 0.14)), 1)
})

test_that("shared vertices count as shared: a curvature less itself has no variance", {
  mesh <- closed_form_mesh(closed_forms()$bumpy)$mesh
  at <- 1800:1801
  direction <- rbind(c(1, 1), c(0, 0), c(0, 0))
  sigma <- rep(1, ncol(mesh$vb))
  variance <- function(targets, jacobian) {
    curvature_variance(mesh$vb[1:3, ], mesh$it, targets, direction, jacobian, sigma,
                       kernel_settings(5, "quadratic"))
  }
  expect_lt(variance(c(1800L, 1800L), matrix(c(1, -1), 1)), 1e-20)
  single <- variance(at, rbind(c(1, 0), c(0, 1)))
  # neighbours: most points in common
  expect_lt(variance(at, matrix(c(1, -1), 1)), 0.5 * sum(single))
  expect_gt(variance(at, matrix(c(1, 1), 1)), 1.5 * sum(single))
  expect_equal(variance(at, rbind(c(2, 0))), 4 * single[1], tolerance = 1e-12)
})

check_slope <- function(kernel) {
  window <- fitted_window(ridge_settings("one pass"))
  curve <- window$curve
  tight <- ridge_settings(tolerance = 1e-13)
  line <- ridge_line(curve$surface, curve$scale, window$radius, tight, kernel)
  alpha <- line$alpha[2:40]
  problem <- ridge_problem(curve$surface, curve$scale, window$radius, window$settings, kernel)
  slope <- tcrossprod(offset_slope(problem, curve$surface, alpha),
                      mgcv::tensor.prod.model.matrix(curve$surface$design))
  expect_identical(dim(slope), c(39L, length(curve$surface$rows)))
  refit <- function(strength) {
    surface <- curve$surface
    right <- crossprod(mgcv::tensor.prod.model.matrix(surface$design), strength)
    beta <- backsolve(surface$factor, backsolve(surface$factor, right, transpose = TRUE))
    surface$coefficients <- matrix(beta, nrow(surface$coefficients))
    ridge_line(surface, curve$scale, window$radius, tight, kernel)$alpha[2:40]
  }
  scale <- max(abs(slope))
  for (vertex in order(-colSums(slope^2))[c(1, 5, 50)]) {
    h <- replace(numeric(length(curve$surface$strength)), vertex, 1e-5)
    numeric_slope <- (refit(curve$surface$strength + h) - refit(curve$surface$strength - h)) / 2e-5
    expect_lt(max(abs(slope[, vertex] - numeric_slope)), 1e-3 * scale)
  }
}

test_that("offset_slope() gives the derivative of the ridge line by the strength of each vertex", {
  for (kernel in c(0, 1.5)) check_slope(kernel)
})

test_that("the standard error is about the spread over meshes scanned again", {
  lines <- vapply(1:30, function(seed) {
    bent <- straight_ridge(noise = 0.1, seed = seed, half = c(17, 12), spacing = 1.25)
    curve <- suppressWarnings(ridge_curve(bent, "a", "b", "ridge", radius = 4, width = 5, n = 9),
                              classes = "crestline_rival_path")
    crest <- curve$points$y # of the curve; its truth is 0
    c(crest[5], curve$points$se[5])
  }, numeric(2))
  ratio <- stats::median(lines[2, ]) / sqrt(mean(lines[1, ]^2))
  expect_gt(ratio, 0.8)
  expect_lt(ratio, 2.5) # inflated by 1.5
})

test_that("the error grows in proportion to the noise, ends have none, and inflation multiplies", {
  at_noise <- function(sd, ...) {
    bent <- straight_ridge(noise = sd, half = c(17, 12), spacing = 1.25)
    ridge_curve(bent, "a", "b", "ridge", radius = 4, width = 5, n = 9,
                settings = ridge_settings(...))
  }
  known <- at_noise(0.02, noise = c(0.02, 0, 0))
  expect_gt(at_noise(0.1, noise = c(0.1, 0, 0))$se, 2 * known$se)
  little <- at_noise(0.02)
  expect_identical(little$points$se[c(1, 9)], c(0, 0))
  expect_true(all(little$points$se[2:8] > 0))
  doubled <- at_noise(0.02, inflation = 3)
  expect_lte(max(doubled$line$se / little$line$se, na.rm = TRUE), 2 + 1e-9)
  loose <- ridge_line(little$surface, little$scale, 4, loosen(little$settings), little$line$kernel)
  bias <- abs(little$line$alpha - loose$alpha)
  expect_true(all(little$line$se >= bias - 1e-12))
})

test_that("loosen() divides lambda only", {
  settings <- ridge_settings()
  expect_equal(loosen(settings)$lambda, settings$lambda / 10)
  expect_identical(loosen(settings)[names(settings) != "lambda"],
                   settings[names(settings) != "lambda"])
})

test_that("near an end, which is fixed, the error is no larger than the way from there", {
  wild <- suppressWarnings(fitted_window(ridge_settings(inflation = 1e4)))$curve$line
  way <- pmin(wild$s - wild$s[1], wild$s[length(wild$s)] - wild$s)
  expect_equal(wild$se, way)
  plain <- fitted_window()$curve$line
  expect_true(all(plain$se <= way))
  expect_lt(max(plain$se), max(way))
})

test_that("where balls are widened, the variance is that of the wider fits", {
  mesh <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-6, 6),
                                v = c(-6, 6)))$mesh
  at <- which.min(colSums(mesh$vb[1:2, ]^2))
  variance <- function(radius, ...) {
    curvature_variance(mesh$vb[1:3, ], mesh$it, at, matrix(c(1, 0, 0)), matrix(1),
                       rep(0.3, ncol(mesh$vb)), kernel_settings(radius, "quadratic", ...))
  }
  wide <- suppressWarnings(curvature(mesh, 4.3, "quadratic", vertices = at),
                           classes = "crestline_wide_radius")$neighbours[at]
  expect_equal(variance(4.3 / 1.5, points_per_term = wide / 6), variance(4.3), tolerance = 1e-10)
  expect_equal(variance(4.3 / 1.5, points_per_term = wide / 6, widen = 1.4), 0)
})

test_that("on a coarse mesh the standard error is not below the spread", {
  ridge <- function(seed) simulate_ridge(0.25, 1, spacing = 0.2, noise = 0.01, seed = seed)
  curves <- lapply(1:20, function(seed) {
    one <- ridge(seed)
    ends <- rownames(one$landmarks)
    suppressWarnings(ridge_curve(one, ends[1], ends[2], "ridge", radius = 0.25, width = 0.4, n = 5))
  })
  spread <- stats::sd(vapply(curves, function(curve) curve$points$d[3], 0))
  said <- stats::median(vapply(curves, function(curve) curve$points$se[3], 0))
  expect_gt(said / spread, 1)
  expect_lt(said / spread, 5)
})

test_that("where no strength depends on the heights, the noise is not known, and this is said", {
  none <- list(along = matrix(0, 0, 1), across = matrix(0, 0, 1))
  surface <- list(coefficients = matrix(1), strength = 1, factor = matrix(1))
  expect_identical(noise_factor(surface, integer(), none, list(trace = 0, matrix = matrix(0))),
                   NA_real_)
  job <- list(type = "ridge", route = "plane", radius = 1, settings = ridge_settings(),
              ends = list(span = 9))
  fit <- list(found = TRUE, scale = 1, path = structure(matrix(0, 2, 3), length = 9),
              line = list(se = rep(NA_real_, 5), at_bound = FALSE))
  judged <- judge_curve(job, fit)
  expect_false(judged$determined)
  expect_match(judged$reason, "standard error")
})
