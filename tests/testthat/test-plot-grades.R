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

# Least distance (CIE 1976, Lab) of any two colours as seen with normal vision, without red and
# without green cones: Machado, Oliveira and Fernandes (2009), severity 1, in linear light.
least_difference <- function(colours) {
  vision <- list(
    normal = diag(3),
    protan = rbind(c(0.152286, 1.052583, -0.204868), c(0.114503, 0.786281, 0.099216),
                   c(-0.003882, -0.048116, 1.051998)),
    deutan = rbind(c(0.367322, 0.860646, -0.227968), c(0.280085, 0.672501, 0.047413),
                   c(-0.011820, 0.042940, 0.968881))
  )
  light <- t(linear(grDevices::col2rgb(colours)))
  vapply(vision, function(m) {
    seen <- pmin(pmax(light %*% t(m), 0), 1)
    shown <- ifelse(seen <= 0.0031308, 12.92 * seen, 1.055 * seen^(1 / 2.4) - 0.055)
    min(stats::dist(grDevices::convertColor(shown, "sRGB", "Lab")))
  }, 0)
}

test_that("kinds, grades and states stay apart for eyes without red or green cones", {
  # Black and white are 100 apart in lightness.
  expect_equal(unname(least_difference(c("black", "white"))), rep(100, 3), tolerance = 1e-3)
  for (colours in list(kind_colours, grade_colours, unlist(review_colours()$state),
                       shape_scale(check_shape_palette(NULL))$colour,
                       eval(formals(plot.group_comparison)$colour))) {
    expect_gt(min(least_difference(colours)), 25)
  }
})
