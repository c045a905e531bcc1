# Parabolic ridges: the surface z = -b (x - a y^3)^2 is known everywhere.

test_that("the simulated surface is the one of the paper, with its ridge", {
  surface <- simulate_ridge(a = 0.25, b = 1.5, seed = 1)
  v <- surface$mesh$vb
  expect_equal(ncol(v), 41^2)
  expect_equal(v[3, ], -1.5 * (v[1, ] - 0.25 * v[2, ]^3)^2)
  expect_equal(unname(surface$landmarks["to", 1:2]), c(0.25 * 0.95^3, 0.95))
  # A chord of the mesh lies below the crest by at most b spacing^2 / 4.
  expect_lte(abs(surface$landmarks["to", 3]), 1.5 * 0.05^2 / 4 * 1.1)
  truth <- attr(surface, "truth")
  expect_equal(truth[, "x"], 0.25 * truth[, "y"]^3)
  expect_equal(range(truth[, "y"]), c(-0.95, 0.95))
})

test_that("triangles tile the square once and face up", {
  mesh <- simulate_ridge(0, 1e-9, spacing = 0.1, seed = 2, jitter = 0.3)$mesh
  corner <- function(i) mesh$vb[1:2, mesh$it[i, ]]
  area <- ((corner(2) - corner(1))[1, ] * (corner(3) - corner(1))[2, ] -
             (corner(2) - corner(1))[2, ] * (corner(3) - corner(1))[1, ]) / 2
  expect_true(all(area > 0))
  fixed <- simulate_ridge(0, 1e-9, spacing = 0.1, seed = 2)$mesh
  expect_equal(ncol(fixed$it), 2 * 20^2)
})

test_that("noise has the size and the correlation that were asked for", {
  height <- function(...)
    simulate_ridge(0, 1, spacing = 0.02, noise = 0.03, seed = 3, ...)$mesh$vb[3, ] -
    simulate_ridge(0, 1, spacing = 0.02, seed = 3)$mesh$vb[3, ]
  along <- function(z, lag) {
    z <- matrix(z, 101)
    stats::cor(as.vector(z[seq_len(101 - lag), ]), as.vector(z[-seq_len(lag), ]))
  }
  white <- height()
  expect_equal(stats::sd(white), 0.03, tolerance = 0.03)
  expect_lt(abs(along(white, 1)), 0.05)
  smooth <- height(correlation = 3)
  expect_equal(stats::sd(smooth), 0.03, tolerance = 0.15)
  # A Gaussian kernel of sd 3 correlates neighbours at distance h by exp(-h^2 / 36).
  expect_equal(along(smooth, 3), exp(-9 / 36), tolerance = 0.1)
})

test_that("landmarks are moved by the distance that was asked for", {
  exact <- simulate_ridge(0.5, 1, seed = 4, end = 0.7)$landmarks
  moved <- simulate_ridge(0.5, 1, seed = 4, end = 0.7, landmark_error = 0.1)$landmarks
  expect_equal(unname(sqrt(rowSums((moved - exact)[, 1:2]^2))), c(0.1, 0.1))
})

test_that("a seed repeats the surface and leaves the user's random stream alone", {
  set.seed(7)
  before <- .Random.seed
  first <- simulate_ridge(0, 1, noise = 0.1, seed = 5)
  expect_identical(.Random.seed, before)
  expect_identical(simulate_ridge(0, 1, noise = 0.1, seed = 5)$mesh, first$mesh)
  expect_false(identical(simulate_ridge(0, 1, noise = 0.1, seed = 6)$mesh$vb, first$mesh$vb))
  other <- simulate_ridge(0, 1, noise = 0.1)
  expect_false(identical(.Random.seed, before))
})

test_that("a seed means the same surface whatever generator the user has chosen", {
  kind <- RNGkind()
  on.exit(do.call(RNGkind, as.list(kind)))
  mine <- simulate_ridge(0, 1, noise = 0.1, seed = 5)$mesh
  RNGkind("L'Ecuyer-CMRG", "Ahrens-Dieter")
  expect_identical(simulate_ridge(0, 1, noise = 0.1, seed = 5)$mesh, mine)
  expect_equal(RNGkind()[1:2], c("L'Ecuyer-CMRG", "Ahrens-Dieter"))
})

test_that("arguments out of range are refused with a remedy", {
  expect_error(simulate_ridge(0, 0), "`b`", class = "crestline_error")
  expect_error(simulate_ridge(0, 1, noise = -1), "`noise`", class = "crestline_error")
  expect_error(simulate_ridge(0, 1, end = 1.2), "`end`", class = "crestline_error")
})

test_that("signed distances from a known ridge are positive on its left", {
  truth <- cbind(x = 0, y = c(-1, 0, 1), z = 0)
  points <- cbind(x = c(-0.2, 0.3), y = c(0.1, 0.5), z = c(5, -5))
  expect_equal(ridge_offset(points, truth), c(0.2, -0.3))
})

test_that("the band of two standard errors holds most of the error on a sharp ridge", {
  covered <- vapply(1:4, function(seed) {
    surface <- simulate_ridge(0.25, 2, noise = 0.01, seed = seed)
    curve <- ridge_curve(surface, "from", "to", "ridge", radius = 0.25, width = 0.4, n = 21)
    points <- curve$points[2:20, ]
    mean(abs(ridge_offset(points, attr(surface, "truth"))) <= 2 * points$se)
  }, 0)
  expect_gt(mean(covered), 0.8)
})
