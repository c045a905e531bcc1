# The kernel of a norm: by distance, and by the distance to the mirror image.

# Points on both sides of x = 0, and what a norm has of them.
two_sided <- function(own = c(0.1, 0.3, 0.4), mirrored = c(0.2, 0.1), k = 40) {
  half <- with_seed(1, cbind(stats::runif(k, 8, 40), stats::runif(k, 0, 40),
                             stats::runif(k, 0, 10)))
  list(points = rbind(half, across_plane(half)), kernel = own, mirrored = mirrored,
       ranges = c(3, 12))
}
plan <- list(ranges = c(3, 12), bins = c(0, 0.01, 2, 4, 6, 9, 12, 16, 20, 26, 34, 44),
             nugget = 0.003)
drawn <- function(field, n) {
  k <- nrow(field$points)
  do.call(cbind, lapply(1:3, function(axis) {
    with_seed(axis, matrix(stats::rnorm(k * n), n)) %*% chol(axis_kernels(field)[[axis]])
  }))
}

test_that("the kernel's weights are found again from draws", {
  for (mirrored in list(c(0.2, 0.1), c(0.25, -0.3), c(0, 0))) {
    field <- two_sided(mirrored = mirrored)
    found <- fit_kernel(drawn(field, 4000), field$points, plan, mirrored = TRUE)
    expect_lt(max(abs(found$own - field$kernel)), 0.05)
    expect_lt(max(abs(found$mirrored - mirrored)), 0.05)
    expect_true(is_kernel(c(field["ranges"], list(kernel = found$own, mirrored = found$mirrored))))
  }
  field <- two_sided(mirrored = c(0, 0))
  plain <- fit_kernel(drawn(field, 4000), field$points, plan, mirrored = FALSE)
  expect_lt(max(abs(plain$own - field$kernel)), 0.05)
  expect_equal(plain$mirrored, c(0, 0))
})

test_that("a kernel is a correlation, also of points on the plane, and the other side counts", {
  field <- two_sided(mirrored = c(0.3, -0.4))
  field$points <- rbind(field$points, c(0, 10, 5), c(0.5, 30, 0))
  kernels <- axis_kernels(field)
  for (kernel in kernels) {
    expect_equal(diag(kernel), rep(0.8, 82))
    expect_gt(min(eigen(kernel, symmetric = TRUE, only.values = TRUE)$values), 0.01)
  }
  # Partners far from the plane: x is turned round.
  far <- which.max(field$points[1:40, 1])
  expect_equal(c(kernels[[1]][far, 40 + far], kernels[[2]][far, 40 + far]), c(0.1, -0.1),
               tolerance = 0.02)
  expect_identical(kernels[[2]], kernels[[3]])
  turned <- field
  turned$points <- across_plane(turned$points)
  expect_equal(axis_kernels(turned), kernels)
})

test_that("weights that are none are told", {
  field <- two_sided()
  expect_true(is_kernel(field))
  for (bad in list(c(0.31, 0), c(0, -0.5), c(NA, 0), 0.1, NULL)) {
    field["mirrored"] <- list(bad)
    expect_false(is_kernel(field))
  }
  expect_false(is_kernel(utils::modifyList(two_sided(), list(kernel = c(-0.1, 0.3, 0.4)))))
})

test_that("least squares without negative coefficients", {
  x <- with_seed(1, matrix(stats::rnorm(60), 20))
  expect_equal(non_negative(x, x %*% c(1, 2, 0.5)), c(1, 2, 0.5))
  found <- non_negative(x, x %*% c(1, -2, 0.5))
  expect_equal(found[2], 0)
  gradient <- crossprod(x, x %*% (found - c(1, -2, 0.5)))
  expect_true(all(gradient[found == 0] > 0) && all(abs(gradient[found > 0]) < 1e-10))
})
