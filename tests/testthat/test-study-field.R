test_that("values of a random field have the stated variance and covariance, for few waves too", {
  # 4,000 draws: the standard error of a covariance is at most sd^2 sqrt(3 / 4000) = 0.027 sd^2,
  # four of them 0.11.
  at <- rbind(c(0, 0, 0), c(10, 0, 0), c(0, 14, 14), c(60, 0, 0))
  for (waves in c(3, 100)) {
    draw <- function(i) random_field(range = 20, sd = 2, columns = 1, waves = waves)(at)
    drawn <- with_seed(1, vapply(1:4000, draw, at[, 1]))
    expected <- 4 * exp(-as.matrix(dist(at))^2 / (2 * 20^2))
    expect_lt(max(abs(tcrossprod(drawn) / 4000 - expected)), 0.11 * 4)
    expect_lt(max(abs(rowMeans(drawn))), 4 * 2 / sqrt(4000))
  }
})

test_that("fields add up by variance; without a row there is none", {
  at <- rbind(c(1, 2, 3))
  both <- data.frame(range = c(20, 5), sd = c(3, 4))
  drawn <- with_seed(2, vapply(1:4000, function(i) random_fields(both, 50)(at)[1], 0))
  expect_lt(abs(var(drawn) - 25), 4 * 25 * sqrt(2 / 4000))
  expect_equal(random_fields(both[0, ], 50)(at), matrix(0, 1, 3))
})

test_that("a bump is 1 in its centre, 27 / 64 half way, and ends smoothly", {
  expect_equal(bump(c(0, 12, 24, 30), 24), c(1, 27 / 64, 0, 0))
  step <- 1e-3
  expect_lt(bump(24 - step, 24) / step^2, 1e-5)
})

test_that("bumps move points along their directions, by their shares, and add up", {
  places <- data.frame(x = c(0, 1), y = 0, z = 0, radius = 2, share = c(3, -1), dx = 0,
                       dy = c(0, 1), dz = c(1, 0))
  field <- bump_field(places)
  expect_equal(field(rbind(c(0, 0, 0), c(9, 0, 0))), rbind(c(0, -27 / 64, 3), 0))
  expect_equal(bump_field(places[0, ])(diag(3)), matrix(0, 3, 3))
})
