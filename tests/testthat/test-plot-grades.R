test_that("a shape is seen from its front, upright, its left on the viewer's right, in any pose", {
  pairs <- data.frame(level = c("landmarks", "landmarks", "curves"),
                      left = c("b", "c", "right"), right = c("a", "d", "left"))
  shape <- quad_shape(quad_scheme(function(tables) {
    tables$patches$first_column <- NULL
    c(tables, list(pairs = pairs))
  }))
  turn <- rbind(c(0, -1, 0), c(0.6, 0, -0.8), c(0.8, 0, 0.6))
  turned <- shape
  turned$points[c("x", "y", "z")] <- as.matrix(shape$points[c("x", "y", "z")]) %*% t(turn)
  for (one in list(shape, turned)) {
    view <- shape_view(one)
    expect_equal(tcrossprod(view), diag(3))
    expect_equal(det(view), 1)
    seen <- coords(one, "landmarks") %*% t(view)
    expect_gt(min(seen[c("b", "c"), 1]), max(seen[c("a", "d"), 1]))
    expect_gt(min(seen[, 3]), 0)
    expect_equal(unname(seen), unname(coords(shape, "landmarks")), tolerance = 0.02)
  }
})

test_that("without pairs the longest way is up, without surface the plane faces the viewer", {
  shape <- quad_shape(quad_scheme(function(tables) tables[1:2]))
  view <- shape_view(shape)
  expect_equal(tcrossprod(view), diag(3))
  expect_equal(det(view), 1)
  spread <- apply(as.matrix(shape$points[c("x", "y", "z")]) %*% t(view), 2,
                  function(v) diff(range(v)))
  expect_true(spread[2] > spread[1] && spread[1] > spread[3])
  expect_gt(view[3, 3], 0)
})

test_that("a turned view goes round to the left and keeps what is up", {
  turned <- turned_view(diag(3), pi / 2)
  expect_equal(turned %*% c(1, 0, 0), cbind(c(0, 0, 1)))
  expect_equal(turned %*% c(0, 1, 0), cbind(c(0, 1, 0)))
})

test_that("kinds, grades and states stay apart for eyes without red or green cones", {
  # Black and white are 100 apart in lightness.
  expect_equal(unname(least_difference(c("black", "white"))), rep(100, 3), tolerance = 1e-3)
  for (colours in list(kind_colours, grade_colours, unlist(review_colours()$state),
                       shape_scale(check_shape_palette(NULL))$colour,
                       eval(formals(plot.group_comparison)$colour))) {
    expect_gt(min(least_difference(colours)), 25)
  }
})
