# The correlation of a face's points: its inverse, its kernel, the scan's weights.

flat_field <- function(mirrored = c(0, 0), k = 30, seed = 1) {
  with_seed(seed, {
    points <- cbind(stats::runif(k, 0, 40), stats::runif(k, 0, 40), stats::runif(k, 0, 10))
    list(points = points, normal = matrix(rep(c(0, 0, 1), each = k), k),
         sd = stats::runif(3 * k, 0.5, 2),
         vectors = qr.Q(qr(matrix(stats::rnorm(6 * k), ncol = 2))),
         values = c(20, 5), kernel = c(0.1, 0.3, 0.4), mirrored = mirrored, ranges = c(3, 12))
  })
}

# The whole correlation, written out.
dense_correlation <- function(field, extra = 0, free = 1e6) {
  distance <- as.matrix(stats::dist(field$points))
  k <- nrow(distance)
  whole <- field$vectors %*% (field$values * t(field$vectors)) +
    free * tcrossprod(pose_directions(field)) + diag(rep_len(extra, 3 * k) + 1e-6)
  for (axis in 1:3) {
    own <- field$kernel[2] * exp(-distance^2 / 18) + field$kernel[3] * exp(-distance^2 / 288) +
      diag(field$kernel[1], k)
    for (i in seq_len(k)) for (j in seq_len(k)) {
      squares <- sum((field$points[i, ] - c(-1, 1, 1) * field$points[j, ])^2)
      own[i, j] <- own[i, j] + (if (axis == 1) -1 else 1) *
        sum(field$mirrored * exp(-squares / (2 * c(3, 12)^2)))
    }
    rows <- (axis - 1) * k + seq_len(k)
    whole[rows, rows] <- whole[rows, rows] + 0.8 * cov2cor(own)
  }
  whole
}

test_that("the inverse is that of the whole matrix", {
  x <- cbind(seq_len(90), rep(1, 90))
  for (field in list(flat_field(), flat_field(c(0.2, -0.1)))) {
    for (extra in list(0, rep(c(0, 5, 0), c(10, 5, 75)))) {
      own <- apply_inverse(invert_field(field, extra), x)
      whole <- solve(dense_correlation(field, extra))
      expect_equal(own, whole %*% x, tolerance = 1e-6)
      expect_equal(inverse_diagonal(invert_field(field, extra)), diag(whole), tolerance = 1e-6)
    }
  }
})

test_that("the scan's statistic has variance 1, and does not see pose and scale", {
  field <- flat_field(c(0.2, -0.1))
  w <- scan_weights(field, 12)[[1]]
  variance <- colSums(w * (dense_correlation(field) %*% w))
  expect_equal(unname(variance), rep(1, 30), tolerance = 1e-6)
  pose <- pose_directions(field)
  expect_lt(max(abs(crossprod(w, pose))), 1e-3)
  u <- with_seed(3, matrix(stats::rnorm(180), 90))
  scale <- scan_scale(field, 12)
  short <- scan_statistics(field, u, 12, scale, invert_field(field))[[1]]
  expect_equal(short, crossprod(u, w), ignore_attr = TRUE)
  # No other test of that bump has a greater expectation.
  lesion <- bump(as.matrix(stats::dist(field$points))[, 7], 12)
  lesion <- c(0 * lesion, 0 * lesion, lesion) / field$sd
  best <- sum(w[, 7] * lesion)
  other <- with_seed(1, w[, 7] + 0.05 * stats::rnorm(90))
  spread <- sqrt(sum(other * (dense_correlation(field) %*% other)))
  expect_gt(best, abs(sum(other * lesion)) / spread)
})
