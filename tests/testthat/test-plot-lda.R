test_that("scores on discriminants are drawn, and who was assigned wrongly is ringed", {
  data <- grouped_sample(c(8, 13), 0.2, seed = 2)
  two <- suppressMessages(shape_lda(data$x, data$group, 1:3))
  three <- suppressMessages(shape_lda(data$x, rep(c("a", "b", "c"), c(8, 7, 6)), 3))
  expect_equal(draw_quietly(plot(two, labels = TRUE)), predict(two)$x)
  expect_equal(draw_quietly(plot(three, ellipse = 0.9)), predict(three)$x[, 1:2])
  expect_equal(draw_quietly(plot(three, 2)), predict(three)$x[, 2, drop = FALSE])
  expect_crestline_error(plot(two, 2), "`component`")
  # Rings are black, as axes are: more rings, more dark pixels.
  black <- function(x) sum(apply(drawn_pixels(plot(x, main = ""), 300, 300), 1:2, max) < 0.5)
  right <- two
  right$specimens$correct[] <- TRUE
  wrong <- two
  wrong$specimens$correct[] <- FALSE
  expect_gt(black(wrong), black(right) + 50)
})
