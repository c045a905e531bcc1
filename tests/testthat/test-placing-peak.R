scatter <- function(n, seed) with_seed(seed, matrix(stats::runif(2 * n, -3, 3), n))

test_that("a parabola's top is found exactly from any start, whichever way the plane stands", {
  uv <- scatter(400, 1)
  turn <- some_rotation(2)
  at <- cbind(uv, 0) %*% t(turn)
  top <- drop(turn %*% c(0.3, -0.2, 0))
  field <- list(at = at, value = 5 - (uv[, 1] - 0.3)^2 - 2 * (uv[, 2] + 0.2)^2 - uv[, 1] * uv[, 2] /
                           2, dimensions = 2)
  exact <- solve(rbind(c(2, 0.5), c(0.5, 4)), c(0.6, -0.8))
  for (start in list(c(0, 0), c(1, -1), c(-1, 0.5))) {
    peak <- strongest_peak(field, drop(turn %*% c(start, 0)), 3, 0.5, 1.2, 0)
    expect_equal(peak$at, drop(turn %*% c(exact, 0)), tolerance = 1e-6)
  }
})

test_that("on a curve the top is found along it, and lies on it", {
  angle <- sort(with_seed(3, stats::runif(200, -1, 1)))
  at <- 10 * cbind(sin(angle), cos(angle), 0)
  field <- list(at = at, value = 2 - (angle - 0.1)^2, dimensions = 1)
  peak <- strongest_peak(field, at[50, ], 12, 1, 2, 0)
  expect_equal(peak$at, 10 * c(sin(0.1), cos(0.1), 0), tolerance = 2e-3)
})

test_that("the strongest within reach is taken, and none where there is none", {
  uv <- scatter(1500, 4)
  bump <- function(u, v, height) height * exp(-((uv[, 1] - u)^2 + (uv[, 2] - v)^2) / 0.5)
  field <- list(at = cbind(uv, 0), value = bump(-1, 0, 1) + bump(1.5, 0, 2), dimensions = 2)
  expect_equal(strongest_peak(field, c(0, 0, 0), 2, 0.3, 0.5, 0)$at, c(1.5, 0, 0), tolerance = 0.02)
  expect_equal(strongest_peak(field, c(-1, 0.3, 0), 1, 0.3, 0.5, 0)$at, c(-1, 0, 0),
               tolerance = 0.02)
  expect_null(strongest_peak(field, c(0, 0, 0), 2, 0.3, 0.5, 5))
  expect_null(strongest_peak(field, c(0, -2.5, 0), 0.4, 0.3, 0.5, 0))
  # A slope has no peak: its highest place is where the search ends.
  field$value <- uv[, 1]
  expect_null(strongest_peak(field, c(0, 0, 0), 1, 0.3, 0.5, -10))
})
