test_that("an alignment is drawn over its mean, and its farthest specimens are named", {
  x <- posed_sample(sd = 0.05)
  x[, , 4] <- posed_sample(sd = 0.05, seed = 9)[, , 1]
  aligned <- suppressWarnings(align(x))
  far <- draw_quietly(plot(aligned, most = 2))
  expect_equal(nrow(far), 2)
  expect_equal(far$id[1], "4")
  expect_equal(far$distance, sort(as.data.frame(aligned)$distance, decreasing = TRUE)[1:2])
  flat <- align(posed_sample(dim = 2))
  expect_equal(nrow(draw_quietly(plot(flat, most = 99))), 15)
  expect_crestline_error(plot(aligned, most = 0), "`most`")
  expect_crestline_error(plot(aligned, colour = "no such"), "`colour`")
})

test_that("configurations are seen from where one looks", {
  corner <- diag(3)
  seen <- seen_configurations(list(corner), "left")[[1]]
  expect_equal(seen, corner %*% t(view_rotation("left")))
  expect_equal(seen_configurations(list(corner[, 1:2]), "left")[[1]], corner[, 1:2])
})
