moved_scan <- function(scan, turn, shift) {
  mesh <- scan$mesh
  mesh$vb[1:3, ] <- turn %*% mesh$vb[1:3, ] + shift
  specimen(mesh, t(turn %*% t(scan$landmarks) + shift), "moved", outward = "keep")
}

repeated <- function(noise, correlation, seed, spacing = 0.05, b = 1) {
  lapply(seed + c(0, 1000), function(s)
    simulate_ridge(0.25, b, spacing, noise, s, jitter = 0.3, correlation = correlation))
}

# Two scans with smooth noise, and what is measured of them, for several tests.
smooth <- new.env()
delayedAssign("scans", repeated(0.01, 2, 7), assign.env = smooth)
delayedAssign("noise", scan_noise(smooth$scans[[1]], smooth$scans[[2]]), assign.env = smooth)

test_that("the noise of two simulated scans comes back: its size, and how far it is correlated", {
  measured <- function(correlation, spacing = 0.05, seeds = c(2, 4)) {
    found <- vapply(seeds, function(seed) {
      # nearly level: the noise is along z
      scans <- repeated(0.01, correlation, seed, spacing, b = 0.05)
      unlist(scan_noise(scans[[1]], scans[[2]])[c("independent", "smooth", "range", "sd")])
    }, numeric(4))
    rowMeans(found)
  }
  alone <- measured(0)
  expect_equal(alone[["independent"]], 0.01, tolerance = 0.2)
  expect_lt(alone[["smooth"]], 0.0045)
  for (steps in 1:3) {
    spacing <- if (steps == 3) 0.033 else 0.05 # a square of enough ranges
    found <- measured(steps, spacing)
    expect_equal(found[["sd"]], 0.01, tolerance = 0.2)
    # White noise under a Gaussian kernel of so many steps has correlation exp(-d^2 / (4 steps^2)).
    expect_equal(found[["range"]], sqrt(2) * steps * spacing, tolerance = 0.2)
  }
})

test_that("noise that is rough beside the mesh's edges is not measured too small", {
  # Closest places lie on bumps, and normals of single triangles lean: 0.6 of it without this.
  for (share in c(0.2, 0.4)) {
    scans <- repeated(0.05 * share, 0, 1, b = 0.05)
    found <- scan_noise(scans[[1]], scans[[2]])
    expect_equal(found$sd, 0.05 * share, tolerance = 0.06)
    expect_lt(found$smooth, 0.4 * found$sd)
  }
})

test_that("registration finds the second scan where it was moved to", {
  scans <- smooth$scans
  there <- smooth$noise
  expect_true(there$converged)
  turn <- rotation_about(c(0.02, -0.03, 0.05))
  moved <- scans[[2]]$mesh
  moved$vb[1:3, ] <- turn %*% moved$vb[1:3, ] + c(0.03, -0.02, 0.04)
  found <- scan_noise(scans[[1]], moved)
  expect_true(found$converged)
  expect_equal(found$sd, there$sd, tolerance = 0.02)
  expect_equal(found$range, there$range, tolerance = 0.05)
  marked <- lapply(scans, function(scan) {
    corner <- matrix(scan$mesh$vb[1:3, 1], 1, dimnames = list("corner", NULL))
    specimen(scan$mesh, rbind(scan$landmarks, corner), "marked", outward = "keep")
  })
  far <- moved_scan(marked[[2]], rotation_about(c(1, 2, 0.5)), c(10, 5, 3))
  expect_equal(scan_noise(marked[[1]], far, near = marked[[1]]$landmarks[1:2, ])$sd, there$sd,
               tolerance = 0.01)
  expect_crestline_error(scan_noise(scans[[1]],
                                    moved_scan(scans[[2]], rotation_about(c(1, 2, 0.5)),
                                               c(10, 5, 3))), "not registered")
})

test_that("the unit and the numbering do not matter", {
  scans <- smooth$scans
  own <- scan_noise(scans[[1]]$mesh, scans[[2]]$mesh)
  larger <- lapply(scans, function(scan) {
    scan$mesh$vb[1:3, ] <- 1000 * scan$mesh$vb[1:3, ]
    scan$mesh
  })
  times <- scan_noise(larger[[1]], larger[[2]])
  expect_equal(times$sd / 1000, own$sd, tolerance = 1e-4)
  expect_equal(times$range / 1000, own$range, tolerance = 1e-3)
  order <- with_seed(1, sample(ncol(scans[[1]]$mesh$vb)))
  mesh <- scans[[1]]$mesh
  mixed <- structure(list(vb = mesh$vb[, order], it = matrix(match(mesh$it, order), 3)),
                     class = "mesh3d")
  expect_equal(scan_noise(mixed, scans[[2]]$mesh)$sd, own$sd, tolerance = 1e-4)
})

test_that("known noise takes the noise factor's place, and widens the kernel if smooth", {
  scans <- smooth$scans
  noise <- smooth$noise
  fit <- function(settings) {
    suppressWarnings(ridge_curve(scans[[1]], "from", "to", "ridge", 0.25, 0.4, 21,
                                 settings = settings))
  }
  known <- fit(ridge_settings(noise = noise))
  blind <- fit(ridge_settings())
  expect_identical(known$noise_factor, 1)
  expect_gt(blind$noise_factor, 10)
  expect_gt(known$line$kernel, blind$line$kernel)
  expect_identical(structure(known$settings$noise, spread = NULL),
                   c(independent = noise$independent, smooth = noise$smooth, range = noise$range))
  # The same noise, but exactly known: the band is narrower.
  exact <- fit(ridge_settings(noise = structure(known$settings$noise, spread = NULL)))
  wider <- known$se / exact$se
  former <- noise
  former$spread <- NULL
  expect_crestline_error(ridge_settings(noise = former), c("`spread`", "former version"))
  expect_gt(wider, 1.01)
  expect_lt(wider, 1.2)
})

test_that("a variance under measured noise is widened by Student's quantile of its own spread", {
  # v = 3 x + 2 y at x = 1, y = 2; sd of v by the spread of x and y: sqrt(9 * 0.5 + 4 * 0.25)
  noise <- list(factor = 1, matrix = matrix(7), doubt = list(
    slopes = list(matrix(3), matrix(2), matrix(0)), spread = diag(c(0.5, 0.25, 9))
  ))
  df <- 2 * 49 / 5.5
  expect_equal(noise_variance(matrix(1), noise), 7 * (stats::qt(stats::pnorm(2), df) / 2)^2)
  expect_identical(noise_variance(matrix(0), noise), 0)
  # No spread of what was measured: nothing is widened.
  noise$doubt$spread <- diag(0, 3)
  expect_equal(noise_variance(matrix(1), noise), 7)
})

test_that("the spread of what is measured is that of repeated scans", {
  found <- vapply(1:5, function(seed) {
    scans <- repeated(0.01, 2, 50 + seed, b = 1)
    noise <- scan_noise(scans[[1]], scans[[2]], reach = 0.2, direction = c(0, 0, 1),
                        near = attr(scans[[1]], "truth")[1:20 * 20, ])
    c(noise$smooth^2, log(noise$range), sqrt(diag(noise$spread))[2:3], noise$smooth, noise$range)
  }, numeric(6))
  # Standard deviations of five, between the 0.1 % points of chi-squared with 4 degrees of freedom
  for (i in 1:2) {
    expect_gt(stats::sd(found[i, ]), 0.15 * mean(found[i + 2, ]))
    expect_lt(stats::sd(found[i, ]), 2.15 * mean(found[i + 2, ]))
  }
  expect_equal(mean(found[5, ]), 0.01, tolerance = 0.2)
  expect_equal(mean(found[6, ]), sqrt(2) * 2 * 0.05, tolerance = 0.2)
})

test_that("errors along a direction are smaller along the normals of slopes, and reach further", {
  # A tilted plane: errors along z are cos(tilt) of them along its normal, and their correlation in
  # the slope's direction is longer by 1 / cos(tilt).
  tilted <- function(seed) {
    flat <- simulate_ridge(0, 1e-9, noise = 0, seed = 1)$mesh
    rough <- simulate_ridge(0, 1e-9, noise = 0.01, correlation = 2, seed = seed)$mesh
    flat$vb[3, ] <- flat$vb[1, ] + rough$vb[3, ]
    flat
  }
  scans <- lapply(c(7, 8), tilted)
  along <- scan_noise(scans[[1]], scans[[2]], direction = c(0, 0, 2))
  across <- scan_noise(scans[[1]], scans[[2]])
  expect_identical(along$direction, c(0, 0, 1))
  for (size in c(1e-200, 1e200)) expect_equal(check_direction(c(3, 0, 4) * size), c(0.6, 0, 0.8))
  expect_equal(across$sd / along$sd, sqrt(1 / 2), tolerance = 0.1)
  expect_gt(across$range, along$range)
  # And so the same errors are propagated less on slopes.
  curve <- function(noise) {
    suppressWarnings(ridge_curve(repeated(0, 0, 1)[[1]], "from", "to", "ridge", 0.25, 0.4, 21,
                                 settings = ridge_settings(noise = noise)))$se
  }
  noise <- c(0.004, 0.01, 0.1)
  expect_lt(curve(structure(noise, direction = c(0, 0, 1))), curve(noise))
  expect_crestline_error(scan_noise(scans[[1]], scans[[2]], direction = c(0, 0, 0)), "`direction`")
})

test_that("scans that cannot be compared are refused", {
  scans <- repeated(0.01, 0, 1, spacing = 0.1)
  expect_crestline_error(scan_noise(scans[[1]], scans[[2]], near = rbind(c(0, 0, 0)), reach = 0.1),
                         "can be compared")
  expect_crestline_error(scan_noise(scans[[1]], 3), "`second`")
  expect_crestline_error(ridge_settings(noise = c(1, 2)), "`noise`")
  expect_crestline_error(ridge_settings(noise = c(1, -2, 0)), "scan_noise()")
})

test_that("noise prints its parts", {
  expect_output(print(smooth$noise),
                "standard deviation .*independent .*correlated over .*converged")
})
