points <- rbind(c(3, 0, 0), c(-3, 0, 0), c(0, 2, 0), c(0, -2, 0), c(0, 0, 1), c(0, 0, -1))
turn <- function(angle) {
  rbind(c(cos(angle), -sin(angle), 0), c(sin(angle), cos(angle), 0), c(0, 0, 1))
}

test_that("a rotation is found again, and singular values are those of the cross-product", {
  by <- turn(0.7) %*% t(turn(0.2))[c(3, 1, 2), c(3, 1, 2)]
  found <- nearest_rotation(points, points %*% by)
  expect_equal(found$rotation, by, tolerance = 1e-12)
  expect_equal(found$d, 2 * c(9, 4, 1), tolerance = 1e-12)
})

test_that("onto a mirror image it is a rotation: the half turn nearest to the reflection", {
  found <- nearest_rotation(points, points %*% diag(c(-1, 1, 1)))
  expect_equal(det(found$rotation), 1, tolerance = 1e-12)
  expect_equal(found$rotation, diag(c(-1, 1, -1)), tolerance = 1e-12)
  expect_equal(found$d, c(18, 8, -2), tolerance = 1e-12)
})
