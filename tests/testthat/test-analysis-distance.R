line <- function(n, y = 0, slope = 0) {
  cbind(x = seq(0, 1, length.out = n), y = y + slope * seq(0, 1, length.out = n), z = 0)
}

test_that("distances of points are those of closed forms", {
  a <- list(shifted = line(5), tilted = line(5))
  b <- list(shifted = sweep(line(5), 2, c(3, 4, 12), `+`), tilted = line(5, slope = 2))
  found <- curve_distance(a, b)
  expect_equal(found$part, c("shifted", "tilted"))
  expect_equal(found$rms, c(13, sqrt(mean((2 * seq(0, 1, 0.25))^2))))
  expect_equal(found$mean, c(13, 1))
  expect_equal(found$max, c(13, 2))
  expect_equal(attr(found, "all")$rms, sqrt((5 * 13^2 + 4 * sum(seq(0, 1, 0.25)^2)) / 10))
  expect_equal(attr(found, "all")$points, 10)
})

test_that("matching undoes rotation and shift, and size if wanted", {
  set.seed(1)
  a <- list(one = matrix(rnorm(30), 10), two = matrix(rnorm(12), 4))
  turn <- qr.Q(qr(matrix(rnorm(9), 3)))
  turn <- turn * det(turn)
  moved <- lapply(a, function(x) sweep(x %*% turn, 2, c(5, -2, 9), `+`))
  expect_lt(max(curve_distance(a, moved, match = "procrustes")$max), 1e-12)
  larger <- lapply(moved, function(x) 3 * x)
  expect_lt(max(curve_distance(a, larger, match = "procrustes", scale = TRUE)$max), 1e-12)
  both <- do.call(rbind, a)
  spread <- sqrt(mean(rowSums(sweep(both, 2, colMeans(both))^2)))
  expect_equal(attr(curve_distance(a, larger, match = "procrustes"), "all")$rms, 2 * spread)
  # A reflection is no rotation.
  expect_gt(attr(curve_distance(a, lapply(a, function(x) -x), match = "procrustes"), "all")$rms,
            0.1)
})

test_that("between curves, numbers of points and their spacing do not count", {
  a <- list(edge = line(5))
  expect_equal(curve_distance(a, list(edge = line(17, y = 0.25)), between = "curves")$rms, 0.25)
  expect_equal(curve_distance(a, list(edge = line(2)^2), between = "curves")$max, 0)
  # Past its end the nearest place is the end.
  beyond <- curve_distance(list(edge = line(2)), list(edge = cbind(c(0, 4), 0, 0)),
                           between = "curves")
  expect_equal(beyond$max, 3)
  expect_equal(beyond$mean, 3 / 4)
})

test_that("shapes, matrices and lists say the same; missing parts and points are left out", {
  m <- rbind(line(3), line(2, y = 1))
  rownames(m) <- c(paste("lower lip left", 1:3), paste("brow", 1:2))
  b <- list("lower lip left" = line(3, y = 2), brow = line(2, y = 1), chin = line(2))
  b$brow[2, ] <- NA
  found <- curve_distance(m, b)
  expect_equal(found$part, c("lower lip left", "brow", "chin"))
  expect_equal(found$points, c(3, 1, 0))
  expect_equal(found$rms, c(2, 0, NA))
  expect_output(print(found), "<curve_distance> 2 parts, points of the same number")
  expect_equal(curve_distance(m, m, match = "procrustes")$rms, c(0, 0))
})

test_that("what cannot be compared is said", {
  expect_crestline_error(curve_distance(list(a = line(3)), list(b = line(3))), "in common")
  expect_crestline_error(curve_distance(list(a = line(3)), list(a = line(4))),
                         c("a has 3 points", "curves"))
  expect_crestline_error(curve_distance(line(3)[, 1:2], list(a = line(4))), "`a`")
  expect_crestline_error(curve_distance(list(a = line(3)), list(line(4))), "`b`")
})

test_that("print fits a screen", {
  many <- stats::setNames(lapply(1:40, function(i) line(3, y = i)),
                          paste("a curve with a long name", 1:40))
  shown <- capture.output(print(curve_distance(many, lapply(many, function(x) x + pi))))
  expect_lte(length(shown), 24)
  expect_lte(max(nchar(shown)), 80)
  expect_identical(class(as.data.frame(curve_distance(many, many))), "data.frame")
})

test_that("points of a matrix go by their numbers, not by their rows", {
  a <- matrix(1:33 + 0, 11, dimnames = list(paste("arc", 1:11), NULL))
  expect_equal(curve_distance(a, a[order(rownames(a)), ])$max, 0)
})
