# Specimens by variables: the plain formulas in R.

rows_sample <- function(n = 70, k = 5) {
  x <- with_seed(1, array(stats::rnorm(3 * k), c(k, 3, n)) + stats::rnorm(3 * k * n, sd = 0.1))
  align(x, weights = c(2, 1, 1, 1, 3))
}

test_that("rows are centred columns times a factor, all dimensions or one", {
  aligned <- rows_sample()
  flat <- t(matrix(aligned$coords, 15))
  centred <- sweep(flat, 2, colMeans(flat))
  expect_equal(shape_rows(aligned, 1), centred)
  expect_equal(shape_rows(aligned), centred %*% diag(sqrt(rep(aligned$weights, 3))))
  expect_equal(shape_rows(aligned, 1:5, 2), centred[, 6:10] %*% diag(1:5))
  expect_true(all(is.na(shape_rows(aligned, c(NA, 1:4), 3)[, 1])))
  # Far from the origin no digit is lost that the numbers have.
  far <- aligned
  far$coords <- aligned$coords + 1e6
  expect_lt(max(abs(colMeans(shape_rows(far, 1)))), 2e-10)
  expect_equal(shape_rows(far, 1), centred, tolerance = 1e-7)
})

test_that("squares are about the mean of all, or of the row's group", {
  y <- shape_rows(rows_sample())
  code <- rep(1:3, c(30, 25, 15))
  means <- rowsum(y, code) / tabulate(code)
  expect_equal(squares_by_row(y), rowSums(y^2))
  expect_equal(squares_by_row(y, code), unname(rowSums((y - means[code, ])^2)))
})

test_that("a mean of some specimens is the mean of their co-ordinates", {
  aligned <- rows_sample()
  some <- seq_len(70) %in% c(3, 8, 50)
  expect_equal(mean_shape_of(aligned, some), apply(aligned$coords[, , some], 1:2, mean))
  off <- with_seed(2, stats::rnorm(70))
  expect_equal(as.vector(weighted_shape(aligned, off)), drop(matrix(aligned$coords, 15) %*% off))
})
