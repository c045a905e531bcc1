cloud <- function(k = 20, seed = 1) with_seed(seed, matrix(stats::rnorm(3 * k), k))
turned <- function(x, seed, scale = 1) {
  turn <- qr.Q(qr(cloud(3, seed)))
  sweep(scale * x %*% (turn * det(turn)), 2, 1:3, `+`)
}

test_that("a configuration is laid onto a moved copy of itself exactly", {
  x <- cloud()
  y <- turned(x, 2, 3)
  expect_equal(laid_onto(x, y, TRUE), y)
  expect_equal(laid_onto(turned(x, 3), x, FALSE), x)
  mirrored <- x %*% diag(c(-1, 1, 1))
  expect_gt(max(abs(laid_onto(mirrored, x, FALSE) - x)), 0.1)
})

test_that("the mean of moved copies is the shape, at their mean size", {
  x <- cloud()
  mean <- procrustes_mean(list(turned(x, 2, 0.5), turned(x, 3, 2), turned(x, 4)), x)
  expect_equal(mean, x, tolerance = 1e-9)
})

test_that("the mean is that of geomorph's generalised Procrustes analysis", {
  skip_if_not_installed("geomorph")
  each <- lapply(1:5, function(i) cloud() + 0.1 * cloud(seed = i + 10))
  theirs <- geomorph::gpagen(simplify2array(each), print.progress = FALSE)$consensus
  ours <- procrustes_mean(each, each[[1]])
  expect_equal(unname(laid_onto(ours, unname(theirs), TRUE)), unname(theirs), tolerance = 1e-5,
               ignore_attr = TRUE)
})

test_that("missing points take no part, and are averaged over those that have them", {
  x <- cloud()
  holes <- lapply(1:4, function(i) replace(turned(x, i, i), cbind(i, 1:3), NA))
  expect_equal(laid_onto(procrustes_mean(holes, x), x, TRUE), x, tolerance = 1e-9)
  none <- lapply(holes, function(x) replace(x, cbind(9, 1:3), NA))
  mean <- procrustes_mean(none, x)
  expect_true(all(is.na(mean[9, ])))
  expect_equal(laid_onto(mean, x, TRUE)[-9, ], x[-9, ], tolerance = 1e-9)
})
