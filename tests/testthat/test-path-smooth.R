test_that("a wave of the given length keeps half its height, closed and open", {
  u <- seq(0, 2 * pi, length.out = 1201)[-1201]
  for (waves in c(20, 40)) {
    r <- 10 + 0.1 * cos(waves * u)
    x <- smooth_places(cbind(r * cos(u), r * sin(u), 0), 0.02, 2 * pi * 10 / waves, TRUE)
    out <- sqrt(rowSums(x^2))
    expect_equal(diff(range(out)) / 0.2, 0.5, tolerance = 0.1)
  }
  s <- seq(0, 100, 0.1)
  x <- smooth_places(cbind(s, 0.01 * sin(2 * pi * s / 10), 0), 0.2, 10, FALSE)
  inner <- x[x[, 1] > 30 & x[, 1] < 70, 2]
  expect_equal(max(inner) / 0.01, 0.5, tolerance = 0.05)
  expect_equal(unname(x[c(1, nrow(x)), 1]), c(0, 100))
})

test_that("a straight line stays, and so do its ends", {
  x <- smooth_places(cbind(0:10, 2 * (0:10), 1), 0.3, 20, FALSE)
  expect_equal(unname(x[, 2]), 2 * unname(x[, 1]))
  expect_equal(unname(x[1, ]), c(0, 0, 1))
})

test_that("places are put on the sheet that is joined to the path", {
  two <- graph_specimen(quote(0 * u), two_ends(), half = c(16, 6))
  scan <- walkable(two)
  below <- two$mesh
  below$vb[3, ] <- -0.2
  both <- Morpho::mergeMeshes(two$mesh, below)
  both <- suppressWarnings(specimen(both, two$landmarks, id = "sheets", outward = "keep",
                                    tolerance = 0.25))
  scan <- walkable(both)
  path <- plane_path(both, "a", "b")
  placed <- placed_beside(scan, cbind(seq(-10, 10, 2), 0, -0.15), columns_of(path), 2)
  expect_equal(unname(placed[, "z"]), rep(0, 11))
})

test_that("a path that cannot be smoothed on the mesh says so", {
  ring <- ring_specimen()
  scan <- walkable(ring)
  rough <- reference_path(ring, "a", "c", "ridge", radius = ring_radius, path = "crest")
  expect_null(attr(rough, "smoothed"))
  # Smoothed to its chord, the way is farther from the rough one than the mesh beside it reaches.
  far <- smooth_path(scan, columns_of(rough), 0.4, path_settings(smoothing = 1000))
  expect_true(isFALSE(attr(far, "smoothed")) || attr(far, "length") < attr(rough, "length"))
})
