# The correlation of a face's points: its inverse, its kernel, the scan's weights.

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
