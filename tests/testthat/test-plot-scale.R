test_that("the little surfaces have the shape index they stand for", {
  h <- 2 / 32
  for (index in seq(-1, 1, by = 0.25)) {
    z <- matrix(shape_patch(index, 0.45)$vertices[, 3], 33)
    k1 <- (z[18, 17] - 2 * z[17, 17] + z[16, 17]) / h^2
    k2 <- (z[17, 18] - 2 * z[17, 17] + z[17, 16]) / h^2
    expect_equal(shape_index(k1, k2), index)
    expect_equal(curvedness(k1, k2), 0.45)
  }
})

test_that("their triangles face the viewer and cover the square", {
  patch <- shape_patch(0, 0)
  a <- patch$vertices[patch$it[1, ], ]
  b <- patch$vertices[patch$it[2, ], ]
  c <- patch$vertices[patch$it[3, ], ]
  area <- cross_rows(b - a, c - a)[, 3] / 2
  expect_gt(min(area), 0)
  expect_equal(sum(area), 4)
})

test_that("the scale is drawn", {
  scale <- draw_quietly(plot_shape_scale(), 900, 250)
  expect_equal(scale$index, seq(-1, 1, by = 0.25))
})
