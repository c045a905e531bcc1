# The quad of helper-shape.R is its own mirror image: left and right are partners, bottom and top their own.
paired_shape <- function() {
  pairs <- data.frame(level = c("landmarks", "landmarks", "curves"),
                      left = c("a", "d", "left"), right = c("b", "c", "right"))
  quad_shape(quad_scheme(function(tables) c(tables[1:2], list(pairs = pairs))))
}

test_that("a symmetric shape has no asymmetry, wherever it lies", {
  shape <- paired_shape()
  expect_lte(max(curve_asymmetry(shape)), 0.05)
  straight <- shape
  turn <- rbind(c(0, -1, 0), c(0.6, 0, -0.8), c(0.8, 0, 0.6))
  straight$points[c("x", "y", "z")] <- as.matrix(shape$points[c("x", "y", "z")]) %*% t(turn) + 7
  expect_equal(curve_asymmetry(straight), curve_asymmetry(shape), tolerance = 1e-8)
})

test_that("a curve that bows out is off its partner's image by the bow, both sides alike", {
  shape <- paired_shape()
  for (part in c("left", "right", "bottom", "top")) {
    own <- shape$points$part == part & shape$points$level == "curves"
    ends <- as.matrix(shape$points[own, c("x", "y", "z")])[c(1, sum(own)), ]
    share <- seq(0, 1, length.out = sum(own))
    shape$points[own, c("x", "y", "z")] <- outer(1 - share, ends[1, ]) + outer(share, ends[2, ])
  }
  rows <- which(shape$points$part == "left" & shape$points$level == "curves")
  shape$points$z[rows[3]] <- shape$points$z[rows[3]] + 4
  found <- curve_asymmetry(shape)
  expect_equal(unname(found[c("left", "right")]), c(4, 4), tolerance = 1e-4)
  expect_lte(max(found[c("bottom", "top")]), 1e-3)
  shape$points$z[rows[5]] <- NA
  expect_true(all(is.na(curve_asymmetry(shape)[c("left", "right")])))
})

test_that("without pairs, or with landmarks that do not fix the image, it is NA", {
  expect_true(all(is.na(curve_asymmetry(quad_shape()))))
  shape <- paired_shape()
  line <- shape
  line$points[line$points$level == "landmarks", c("y", "z")] <- 0
  expect_true(all(is.na(curve_asymmetry(line))))
  shape$points$x[3:4] <- NA
  expect_true(all(is.na(curve_asymmetry(shape))))
})
