test_that("a plane through the expected places counts whole, one aside by a long tail", {
  ends <- list(exact = matrix(c(0, 10, 0, 0, 0, 0), 2), axis = c(1, 0, 0), across = c(0, 1, 0))
  track <- list(xyz = cbind(c(3, 5, 7), 2, 0), across = cbind(0, c(0, 0, 0), 1),
                spread = rep(0.5, 3))
  weight <- plane_weight(track, ends)
  # The plane at angle pi / 2 contains y, at 0 z: the places are 2, four spreads, from it.
  expect_equal(weight(c(pi / 2, 0)), c(1, 2 / 3), tolerance = 1e-6)
  expect_identical(plane_weight(NULL, ends)(0), 1)
  # A long tail: at ten times the distance a hundredth, and not exp(-50).
  far <- within_list(track, spread = rep(0.05, 3))
  expect_equal(plane_weight(far, ends)(0), 1 / (1 + 100 / 2), tolerance = 1e-6)
  # What no plane can reach does not count.
  bent <- track
  bent$xyz[2, 3] <- 1.5
  expect_equal(max(plane_weight(bent, ends)(pi * (1:180) / 180)), 1)
})

test_that("offsets are those along `across`, with their sign, and end where a path is cut off", {
  line <- cbind(seq(0, 10, by = 0.5), 1, 0)
  track <- list(xyz = cbind(c(2, 5, 12), 0, c(0, 3, 0)), across = cbind(0, rep(1, 3), 0),
                spread = rep(1, 3))
  expect_equal(track_offsets(track, line), c(1, 1, 1))
  track$xyz[1, 1] <- -1
  expect_equal(track_offsets(track, line, open = TRUE), c(NA, 1, 1))
})
