# The scan for lesions: its weights, statistics and scales.

test_that("the scan's statistic has variance 1, and does not see pose and scale", {
  field <- flat_field(c(0.2, -0.1))
  field$partner <- c(2:1, 4:3, 5, NA, 7:30)
  weights <- scan_weights(field, c(12, 20))
  expect_equal(scan_bumps(field, c(12, 20)),
               data.frame(radius = c(12, 20, 12, 20), both = c(FALSE, FALSE, TRUE, TRUE)))
  u <- with_seed(3, matrix(stats::rnorm(180), 90))
  scale <- scan_scale(field, c(12, 20))
  short <- scan_statistics(field, u, c(12, 20), scale, invert_field(field))
  for (q in 1:4) {
    w <- weights[[q]]
    variance <- colSums(w * (dense_correlation(field) %*% w))
    expect_equal(unname(variance), rep(1, 30), tolerance = 1e-6)
    expect_lt(max(abs(crossprod(w, pose_directions(field)))), 1e-3)
    expect_equal(short[[q]], crossprod(u, w), ignore_attr = TRUE)
  }
  w <- weights[[1]]
  # Points without a partner, or that are their own, have the bump of one side.
  expect_equal(weights[[3]][, 5:6], w[, 5:6])
  expect_equal(weights[[3]][, 1], weights[[3]][, 2])
  # No other test of that bump has a greater expectation.
  distance <- as.matrix(stats::dist(field$points))
  for (case in list(list(w[, 7], 7), list(weights[[3]][, 1], 1:2))) {
    lesion <- rowSums(bump(distance[, case[[2]], drop = FALSE], 12))
    lesion <- c(0 * lesion, 0 * lesion, lesion) / field$sd
    other <- with_seed(1, case[[1]] + 0.05 * stats::rnorm(90))
    spread <- sqrt(sum(other * (dense_correlation(field) %*% other)))
    expect_gt(sum(case[[1]] * lesion), abs(sum(other * lesion)) / spread)
  }
})

test_that("what is found at a point without another as its partner is on one side", {
  norms <- small_norms()
  norms$cache <- new.env()
  # Whatever the limits say, both bumps are the same there
  norms$surface$scan$s[, norms$surface$scan$both] <- 0.01
  alone <- which(norms$surface$partner == seq_along(norms$surface$partner))
  lost <- c(7, norms$surface$partner[7])
  norms$surface$partner[lost] <- norms$points$partner[lost] <- NA
  field <- prepared_field(norms, "surface")
  for (at in c(alone, 7L, 3L)) {
    found <- list(u = rowSums(field$weights[[1]][, at, drop = FALSE]), excess = numeric(105))
    but <- replace(rep(TRUE, 35), at, FALSE)
    scan <- scanned_face(field, found, 10, "female", but)
    expect_identical(scan$at, at)
    expect_identical(scan$both, at == 3)
    found$spread <- rep(1, 105)
    healed <- heal_face(field, found, 10, "female", rep(FALSE, 35), 1)
    expect_true(all(is.finite(healed$u)) && all(healed$found$at %in% seq_len(35)))
  }
})
