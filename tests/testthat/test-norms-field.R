# The correlation of a face's points: its inverse, its kernel, the scan's weights.

flat_field <- function(k = 30, seed = 1) {
  with_seed(seed, {
    points <- cbind(stats::runif(k, 0, 40), stats::runif(k, 0, 40), stats::runif(k, 0, 10))
    list(points = points, normal = matrix(rep(c(0, 0, 1), each = k), k),
         sd = stats::runif(3 * k, 0.5, 2),
         vectors = qr.Q(qr(matrix(stats::rnorm(6 * k), ncol = 2))),
         values = c(20, 5), kernel = c(0.1, 0.3, 0.4), ranges = c(3, 12))
  })
}

# The whole correlation, written out.
dense_correlation <- function(field, extra = 0, free = 1e6) {
  distance <- as.matrix(stats::dist(field$points))
  kernel <- field$kernel[2] * exp(-distance^2 / 18) + field$kernel[3] * exp(-distance^2 / 288) +
    diag(field$kernel[1] + 1e-6, nrow(distance))
  pose <- pose_directions(field)
  field$vectors %*% (field$values * t(field$vectors)) + kronecker(diag(3), kernel) +
    free * tcrossprod(pose) + diag(rep_len(extra, 3 * nrow(distance)))
}

test_that("the inverse is that of the whole matrix", {
  field <- flat_field()
  x <- cbind(seq_len(90), rep(1, 90))
  for (extra in list(0, rep(c(0, 5, 0), c(10, 5, 75)))) {
    own <- apply_inverse(invert_field(field, extra), x)
    expect_equal(own, solve(dense_correlation(field, extra), x), tolerance = 1e-6)
  }
})

test_that("the scan's statistic has variance 1, and does not see pose and scale", {
  field <- flat_field()
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

test_that("the kernel's weights are found again from draws", {
  field <- flat_field(60)
  kernel <- kronecker(diag(3), kernel_between(field) + diag(0.1, 60))
  u <- with_seed(2, matrix(stats::rnorm(180 * 4000), 4000)) %*% chol(kernel)
  plan <- list(ranges = c(3, 12), bins = c(0, 0.01, 2, 4, 6, 9, 12, 16, 20, 26, 34, 44),
               nugget = 0.003)
  expect_equal(fit_kernel(u, field$points, plan), field$kernel, tolerance = 0.1)
})

test_that("least squares without negative coefficients", {
  x <- with_seed(1, matrix(stats::rnorm(60), 20))
  expect_equal(non_negative(x, x %*% c(1, 2, 0.5)), c(1, 2, 0.5))
  found <- non_negative(x, x %*% c(1, -2, 0.5))
  expect_equal(found[2], 0)
  gradient <- crossprod(x, x %*% (found - c(1, -2, 0.5)))
  expect_true(all(gradient[found == 0] > 0) && all(abs(gradient[found > 0]) < 1e-10))
})
