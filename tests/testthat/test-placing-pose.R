

# Similarities, and the frames of template and scan.

test_that("similarities are found exactly", {
  from <- with_seed(1, matrix(stats::rnorm(15), 5))
  turn <- some_rotation(2)
  to <- 1.7 * from %*% t(turn) + rep(c(3, 4, 5), each = 5)
  by <- similarity(from, to)
  expect_equal(by$rotation, turn)
  expect_equal(by$scale, 1.7)
  expect_equal(apply_similarity(from, by), to)
})

test_that("a frame and back is where one began", {
  laid <- list(pose = c(some_rotation(3), 4, -2, 30, 1.2), unit = 1000)
  at <- with_seed(2, matrix(stats::rnorm(15), 5))
  expect_equal(into_frame(from_frame(at, laid), laid), at)
})
