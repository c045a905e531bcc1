test_that("the score is the share's distance from the others' median in their MAD, the specimen's size taken off", {
  wobble <- 0.01 * c(-2, -1, 0, 1, 2)
  share <- cbind(0, wobble, -wobble, 0, 0, c(0.3, 0, 0, 0, 0))
  share <- unname(rbind(share, 0))
  lengths <- exp(share) * rep(c(20, 30, 50, 10, 5, 80), each = 6)
  found <- length_scores(lengths, others = 5, spread = 1e-9)
  expect_equal(found[4, 2], (0.01 - 0) / stats::mad(c(wobble[-4], 0)))
  expect_equal(found[1, 6], 0.3 / 1e-9)
  expect_equal(length_scores(lengths * c(1, 2, 5, 0.1, 1, 3), 5, 1e-9), found)
})

test_that("few others give NA, and equal lengths are measured by the least spread", {
  lengths <- matrix(10, 6, 3)
  expect_true(all(is.na(length_scores(lengths, others = 6, spread = 0.01))))
  lengths[1, 2] <- 10 * exp(0.05)
  expect_equal(length_scores(lengths, 5, 0.01)[1, 2], 5)
  lengths[2:3, 3] <- NA
  expect_true(all(is.na(length_scores(lengths, 5, 0.01)[, 3])))
})
