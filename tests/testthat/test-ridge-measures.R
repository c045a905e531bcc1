test_that("the length's rate is what the length changes by when the curve moves across itself", {
  flat <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-12, 12),
                                v = c(-8, 8)))$mesh
  path <- plane_path(flat, c(-10, 0, 0), c(10, 0, 0))
  window <- path_coordinates(flat, path, width = 5)
  s <- seq(0, attr(path, "length"), length.out = 41)
  bow <- 2 * sin(pi * s / 20) + 0.5 * sin(2 * pi * s / 20)
  curve <- lift(flat, window, path, s, bow)
  length_of <- function(alpha) attr(lift(flat, window, path, s, alpha), "length")
  share <- seq(0, 1, length.out = 201)
  rate <- length_rate(walkable(flat), curve, share)
  at <- place_along(walkable(flat), curve, share * attr(curve, "length"))$x[2:200] + 10
  # A move along d is one across the curve times the cosine of the angle between them.
  cosine <- 1 / sqrt(1 + (2 * pi / 20 * cos(pi * at / 20) + pi / 20 * cos(2 * pi * at / 20))^2)
  for (wave in 1:2) {
    move <- function(x) sin(wave * pi * x / 20)
    change <- (length_of(bow + 0.05 * move(s)) - length_of(bow - 0.05 * move(s))) / 0.1
    expect_equal(sum(rate * move(at) * cosine), change, tolerance = 0.02)
  }
  expect_lt(max(abs(length_rate(walkable(flat), path, share))), 1e-4)
})

test_that("strengths along a line change with those of the vertices by their derivatives", {
  bent <- bent_ridge(noise = 0.05, half = c(17, 12), spacing = 1.25)
  tight <- ridge_settings("one pass", tolerance = 1e-13)
  curve <- suppressWarnings(ridge_curve(bent, "a", "b", "ridge", radius = 4, width = 5, n = 9,
                                        settings = tight))
  window <- curve[c("surface", "scale", "line")]
  strength <- strength_along(curve$surface, curve$line, line_slope(window, 4, tight))
  expect_equal(strength$value, curve$line$strength)
  expect_equal(strength$value, predict(curve$surface, curve$line$s, curve$line$alpha))
  design <- mgcv::tensor.prod.model.matrix(curve$surface$design)
  again <- function(change) {
    surface <- curve$surface
    right <- crossprod(design, surface$strength + change)
    beta <- backsolve(surface$factor, backsolve(surface$factor, right, transpose = TRUE))
    surface$coefficients <- matrix(beta, nrow(surface$coefficients))
    line <- ridge_line(surface, curve$scale, 4, tight)
    predict(surface, line$s, line$alpha)
  }
  for (vertex in order(-rowSums(design^2))[c(1, 40)]) {
    h <- replace(numeric(nrow(design)), vertex, 1e-5)
    expect_equal(as.vector(strength$rows %*% design[vertex, ]), (again(h) - again(-h)) / 2e-5,
                 tolerance = 1e-3)
  }
})

test_that("errors of length and strength are about their spread over meshes scanned again", {
  each <- vapply(1:20, function(seed) {
    surface <- simulate_ridge(0.5, 1, noise = 0.01, correlation = 2, seed = seed)
    known <- ridge_settings(noise = c(0, 0.01, 0.14))
    curve <- suppressWarnings(ridge_curve(surface, "from", "to", "ridge", 0.25, 0.4, 9,
                                          settings = known))
    c(curve$length, curve$length_se, curve$line$strength[21], curve$line$strength_se[21],
      curve$strength, curve$strength_se)
  }, numeric(6))
  spread <- apply(each[c(1, 3, 5), ], 1, stats::sd)
  ratio <- apply(each[c(2, 4, 6), ], 1, stats::median) / spread
  expect_true(all(ratio > 0.5 & ratio < 2.5))
})

test_that("a plane curve has neither error, nor has a curve without errors", {
  bent <- bent_ridge(half = c(17, 12), spacing = 1.25)
  plane <- ridge_curve(bent, "a", "b", "plane", n = 5)
  expect_true(is.na(plane$length_se) && is.na(plane$strength_se))
  without <- suppressWarnings(ridge_curve(bent, "a", "b", "ridge", radius = 4, width = 5, n = 9,
                                          settings = ridge_settings(error = FALSE)))
  expect_true(is.na(without$length_se) && is.na(without$strength_se))
  expect_null(without$line$strength)
  expect_false(any(grepl("of the length", capture.output(summary(without)))))
})
