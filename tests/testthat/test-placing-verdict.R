test_that("a template agrees with itself, not with its negative", {
  settings <- scaled_settings(find_settings(), 1)
  own <- with_seed(1, list(k1 = stats::rnorm(100, 0, 0.05), k2 = stats::rnorm(100, 0, 0.05)))
  plain <- list(index = seq_len(100))
  expect_equal(agreement(own, own, plain, settings), 1)
  expect_equal(agreement(own, lapply(own, `-`), plain, settings), -1)
  # Without matches, or on a sphere, nothing speaks for it.
  expect_equal(agreement(own, own, list(index = rep(NA, 100)), settings), 0)
  expect_equal(agreement(own, list(k1 = rep(0.1, 100), k2 = rep(0.1, 100)), plain, settings), 0)
  # Curvature of the same pattern at half the strength speaks half as much; at double, no more.
  expect_equal(agreement(own, lapply(own, `/`, 2), plain, list(fewest = 1, clip = Inf)), 0.5)
  expect_equal(agreement(own, lapply(own, `*`, 2), plain, list(fewest = 1, clip = Inf)), 1)
  # One curvature beyond the clip counts as the clip.
  far <- own
  far$k1[3] <- far$k2[3] <- 100
  near <- own
  near$k1[3] <- near$k2[3] <- settings$clip
  expect_equal(agreement(own, far, plain, settings), agreement(own, near, plain, settings))
})

test_that("the verdict is by the two limits", {
  said <- vapply(c(-0.1, 0.29, 0.3, 0.44, 0.45, 1), verdict_of, "", limits = c(0.3, 0.45))
  expect_equal(said, c("none", "none", "perhaps", "perhaps", "face", "face"))
})

test_that("confidence is bounded where the verdict is in doubt", {
  settings <- find_settings()
  none <- c(0, 0, 0)
  of <- function(verdict, score = 0) {
    placing_confidence(none, none, none, list(verdict = verdict, score = score), settings)
  }
  expect_equal(of("face", 0.7), c(1, 1, 1))
  expect_equal(of("perhaps"), rep(settings$unsure, 3))
  expect_equal(of(NA_character_, 0.775), rep(0.5, 3))
})
