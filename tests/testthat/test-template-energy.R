points <- function(k, seed = 1) with_seed(seed, matrix(stats::rnorm(3 * k), k))

test_that("B is the corner of the inverse of the spline's system", {
  x <- points(12)
  nugget <- with_seed(2, stats::runif(12))
  system <- rbind(cbind(-as.matrix(stats::dist(x)) + diag(nugget), 1, x),
                  cbind(rbind(1, t(x)), matrix(0, 4, 4)))
  b <- attr(bending_energy(x, nugget), "matrix")
  expect_equal(unname(b), unname(solve(system)[1:12, 1:12]), tolerance = 1e-10)
  expect_equal(attr(bending_energy(x), "affine"), 4)
})

test_that("the energy is that of the interpolating spline: weights times kernel times weights", {
  x <- points(9)
  y <- points(9, 2)
  kernel <- -as.matrix(stats::dist(x))
  system <- rbind(cbind(kernel, 1, x), cbind(rbind(1, t(x)), matrix(0, 4, 4)))
  weight <- solve(system, rbind(y, matrix(0, 4, 3)))[1:9, ]
  expect_equal(bending_energy(x)(y), sum(weight * (kernel %*% weight)), tolerance = 1e-10)
})

test_that("affine images bend nothing, in space, on a plane and on a line", {
  flat <- cbind(points(10)[, 1:2], 0)
  line <- outer(points(10)[, 1], c(1, 2, 3))
  turn <- points(3, 5)
  for (x in list(points(10), flat, flat %*% turn, line)) {
    energy <- bending_energy(x)
    expect_lte(abs(energy(sweep(x %*% turn, 2, 1:3, `+`))), 1e-10)
    expect_gt(energy(points(10, 7)), 1e-3)
  }
  expect_equal(attr(bending_energy(flat %*% turn), "affine"), 3)
  expect_equal(attr(bending_energy(line), "affine"), 2)
  expect_equal(attr(bending_energy(flat), "affine"), 3)
  matrix_of <- function(x) attr(bending_energy(x), "matrix")
  expect_lte(max(abs(matrix_of(flat) - matrix_of(flat + 1e-9 * points(10, 3)))), 1e-6)
})

test_that("a turn changes nothing, the unit of both only the energy's unit", {
  x <- points(10)
  y <- points(10, 2)
  turn <- qr.Q(qr(points(3, 4)))
  expect_equal(bending_energy(x)(y %*% turn), bending_energy(x)(y))
  expect_equal(bending_energy(x %*% turn)(y), bending_energy(x)(y))
  expect_equal(bending_energy(1000 * x, 300)(1000 * y), 1000 * bending_energy(x, 0.3)(y))
})

test_that("four points or fewer have no energy, and missing ones are left out", {
  expect_equal(bending_energy(points(4))(points(4, 2)), 0)
  expect_equal(bending_energy(points(1))(points(1, 2)), 0)
  x <- points(10)
  y <- points(10, 2)
  gone <- c(3, 8)
  without <- bending_energy(x[-gone, ])(y[-gone, ])
  expect_equal(bending_energy(x)(replace(y, cbind(rep(gone, 3), rep(1:3, each = 2)), NA)), without)
  expect_equal(bending_energy(replace(x, cbind(rep(gone, 3), rep(1:3, each = 2)), NA))(y), without)
})

test_that("a shape counts coinciding points once", {
  shape <- paired_shape()
  energy <- bending_energy(shape)
  expect_equal(sum(diag(attr(energy, "matrix")) != 0), 34 + 6)
  expect_lte(abs(energy(shape)), 1e-10)
  expect_gt(energy(paired_shape(c(1, 1, 1.3))), 0)
  expect_output(print(energy), "40 points, 4 affine")
})

test_that("what is no template is refused", {
  expect_crestline_error(bending_energy(points(5)[, 1:2]), "k x 3")
  expect_crestline_error(bending_energy(points(5), nugget = -1), "nugget")
  expect_crestline_error(bending_energy(points(5)[c(1:5, 5, 1, 2), ]), "coincide")
  expect_silent(bending_energy(points(5)[c(1:5, 5, 1, 2), ], nugget = 1))
  expect_crestline_error(bending_energy(points(5))(points(6)), c("6 points", "5"))
})
