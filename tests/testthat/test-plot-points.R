test_that("an alignment is drawn over its mean, and its farthest specimens are named", {
  x <- posed_sample(sd = 0.05)
  x[, , 4] <- posed_sample(sd = 0.05, seed = 9)[, , 1]
  aligned <- suppressWarnings(align(x))
  far <- draw_quietly(plot(aligned, most = 2, engine = "picture"))
  expect_equal(nrow(far), 2)
  expect_equal(far$id[1], "4")
  expect_equal(far$distance, sort(as.data.frame(aligned)$distance, decreasing = TRUE)[1:2])
  flat <- align(posed_sample(dim = 2))
  expect_equal(nrow(draw_quietly(plot(flat, most = 99, engine = "picture"))), 15)
  expect_crestline_error(plot(aligned, most = 0), "`most`")
  expect_crestline_error(plot(aligned, colour = "no such"), "`colour`")
})

test_that("configurations are seen from where one looks", {
  corner <- diag(3)
  seen <- seen_configurations(list(corner), "left")[[1]]
  expect_equal(seen, corner %*% t(view_rotation("left")))
  expect_equal(seen_configurations(list(corner[, 1:2]), "left")[[1]], corner[, 1:2])
})

test_that("an alignment is a scene of all specimens, the mean and the farthest by name", {
  aligned <- suppressWarnings(align(posed_sample(sd = 0.05)))
  scene <- plot(aligned, most = 2, engine = "widget")
  table <- as.data.frame(aligned)
  far <- order(table$distance, decreasing = TRUE)[1:2]
  expect_identical(drawn_layers(scene$drawn), c("specimens", "mean", table$id[far]))
  k <- nrow(aligned$mean)
  expect_identical(vapply(scene$drawn$points, function(one) nrow(one$xyz), 0L),
                   c(k * length(aligned), k, k, k))
  expect_equal(unname(scene$drawn$points[[3]]$xyz), unname(aligned[[far[1]]]))
  expect_identical(names(scene$drawn$key)[1], "mean")
  flat <- plot(align(posed_sample(dim = 2)), engine = "widget")
  expect_equal(unname(flat$drawn$points[[2]]$xyz[, 3]), rep(0, nrow(flat$drawn$points[[2]]$xyz)))
  skip_if_not_installed("htmlwidgets")
  expect_match(as.character(widget_html(scene)), "specimens")
})

test_that("of too many points a scene shows some specimens, and says so", {
  x <- array(0, c(500, 3, 150)) + as.vector(with_seed(1, matrix(rnorm(1500), 500)))
  x <- x + with_seed(2, rnorm(length(x), sd = 0.01))
  scene <- suppressWarnings(plot(align(x), engine = "widget"))
  expect_match(scene$drawn$notes, "100 of the 150 specimens")
  expect_identical(nrow(scene$drawn$points[[1]]$xyz), 50000L)
})
