# Pictures of two visits.

test_that("errors alone do not fill the scale of colours", {
  skip_if_not_installed("htmlwidgets")
  cohort <- simulate_cohort(1, data = data.frame(age = 10, sex = "female"), visits = 2,
                            template = small_template(), seed = 4)
  found <- compare_visits(cohort$sample[[1]], cohort$second[[1]], table = ball_measurements())
  own <- found$points$level == "surface"
  found$points$score[own] <- found$points$score[own] / 100
  found$points$change[own] <- found$points$change[own] / 100
  last <- function(...) max(as.numeric(plot(found, ..., engine = "widget")$drawn$bar$labels))
  expect_gt(last("score"), 1)
  expect_lte(last("score"), found$limit)
  least <- found$limit * stats::median(found$points$se[own])
  expect_gt(last("change"), least / 2)
  expect_lte(last("change"), least)
  expect_lt(last("score", limits = c(-0.1, 0.1)), 0.11)
})
