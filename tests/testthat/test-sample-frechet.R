ball <- ball_mesh(4)
frame_at <- function(seed) qr.Q(qr(with_seed(seed, matrix(stats::rnorm(9), 3))))
angle_to <- function(found, aim) {
  at <- unlist(found[c("x", "y", "z")])
  acos(min(1, sum(at * aim) / sqrt(sum(at^2))))
}
# Mean distance of neighbours on the ball, rad.
edge <- sqrt(4 * pi / ncol(ball$vb))

test_that("the mean of two points divides their arc by the weights", {
  for (seed in 1:12) {
    q <- frame_at(seed)
    span <- with_seed(seed, stats::runif(1, 0.3, 2.2))
    weights <- with_seed(seed + 50, stats::runif(2, 0.2, 1))
    on_arc <- function(angle) cos(angle) * q[, 1] + sin(angle) * q[, 2]
    found <- frechet_mean(ball, rbind(on_arc(0), on_arc(span)), weights)
    expect_lte(angle_to(found, on_arc(span * weights[2] / sum(weights))), 0.1 * edge)
    least <- span^2 * prod(weights) / sum(weights)^2
    expect_equal(found$variance, least, tolerance = 0.02)
    expect_on_mesh(found, ball)
  }
})

test_that("the mean of a regular polygon on the ball is its pole", {
  for (seed in 1:6) {
    q <- frame_at(seed)
    turn <- 2 * pi * seq_len(seed + 2) / (seed + 2)
    corners <- t(cos(0.8) * q[, 3] + sin(0.8) * (q[, 1] %o% cos(turn) + q[, 2] %o% sin(turn)))
    expect_lte(angle_to(frechet_mean(ball, corners), q[, 3]), 0.1 * edge)
  }
})

test_that("on a plane it is the weighted mean, exactly", {
  sheet <- grid_mesh(12)
  points <- rbind(c(2.3, 3.1, 0), c(8.2, 4.4, 0), c(5.5, 8.9, 0))
  found <- frechet_mean(sheet, points, c(1, 2, 3))
  expect_equal(unlist(found[c("x", "y", "z")], use.names = FALSE),
               as.vector(c(1, 2, 3) %*% points) / 6, tolerance = 1e-8)
})

test_that("unit and number of the same point change nothing; one point is its own mean", {
  points <- rbind(c(1, 0, 0), c(0, 1, 0), c(0, 0, 1))
  large <- ball
  large$vb[1:3, ] <- 1000 * large$vb[1:3, ]
  found <- frechet_mean(ball, points, c(2, 1, 1))
  scaled <- frechet_mean(large, 1000 * points, c(2, 1, 1))
  expect_equal(unlist(scaled[1:3]), 1000 * unlist(found[1:3]), tolerance = 1e-6)
  expect_equal(scaled$variance, 1e6 * found$variance)
  expect_equal(frechet_mean(ball, points[c(1, 1, 2, 3), ]), found)
  expect_equal(frechet_mean(ball, points, c(2, 1, 1) / 7), found)
  expect_lte(angle_to(frechet_mean(ball, points[1, , drop = FALSE]), points[1, ]), 0.1 * edge)
})

test_that("what has no mean is refused", {
  expect_crestline_error(frechet_mean(ball, 1:3), "k x 3")
  expect_crestline_error(frechet_mean(ball, diag(3), c(1, -1, 1)), "weights")
  expect_crestline_error(frechet_mean(ball, diag(3), 1:2), "3 numbers")
  expect_crestline_error(frechet_mean(ball, diag(3), rings = 0), "rings")
  apart <- ball
  apart$vb <- cbind(ball$vb, ball$vb + c(5, 0, 0, 0))
  apart$it <- cbind(ball$it, ball$it + ncol(ball$vb))
  expect_crestline_error(frechet_mean(apart, rbind(c(1, 0, 0), c(6, 0, 0))), "separate pieces")
})
