test_that("the shape index of the nine shapes is what Koenderink and van Doorn say", {
  quarter <- tan(pi / 8)
  k1 <- c(1, 1, 1, 1, 1, quarter, 0, -quarter, -1)
  k2 <- c(1, quarter, 0, -quarter, -1, -1, -1, -1, -1)
  expect_equal(shape_index(k1, k2), seq(-1, 1, by = 0.25))
  expect_equal(as.character(shape_category(shape_index(k1, k2))),
               c("spherical cup", "trough", "rut", "saddle rut", "saddle", "saddle ridge",
                 "ridge", "dome", "spherical cap"))
})

test_that("it is the formula of the documentation away from umbilics", {
  k1 <- c(3, 1, 0.2, -0.1)
  k2 <- c(1, -2, 0, -4)
  expect_equal(shape_index(k1, k2), 2 / pi * atan((k1 + k2) / (k2 - k1)))
  expect_equal(shape_index(k2, k1), shape_index(k1, k2))
  expect_equal(shape_index(1e8 * k1, 1e8 * k2), shape_index(k1, k2))
  expect_equal(shape_index(-k1, -k2), -shape_index(k1, k2))
})

test_that("planes and missing curvatures have no shape index, but planes have curvedness 0", {
  expect_identical(shape_index(c(0, NA, 1), c(0, 1, NA)), rep(NA_real_, 3))
  expect_identical(curvedness(c(0, NA), c(0, 1)), c(0, NA))
})

test_that("curvedness is the root mean square", {
  expect_equal(curvedness(c(3, 1), c(4, -1)), c(sqrt(12.5), 1))
})

test_that("a curvature is taken as it is", {
  bent <- structure(list(k1 = c(1, 0), k2 = c(0, -1)), class = "curvature")
  expect_equal(shape_index(bent), c(-0.5, 0.5))
  expect_equal(curvedness(bent), rep(sqrt(0.5), 2))
})

test_that("categories are a quarter wide, half of that at the ends", {
  limits <- seq(-7, 7, by = 2) / 8
  below <- shape_category(limits - 1e-9)
  expect_equal(as.integer(below), 1:8)
  expect_equal(as.integer(shape_category(limits)), 2:9)
  expect_equal(as.integer(shape_category(c(-1, 1))), c(1, 9))
  expect_identical(as.character(shape_category(NA_real_)), NA_character_)
})

test_that("colours are the categories' own at their centres", {
  expect_equal(shape_colours(c(-1, -0.5, 0, 0.5, 1)),
               c("#00153F", "#3E7BFF", "#FFFFFF", "#E8B400", "#4A1F00"))
  expect_equal(shape_colours(c(NA, 0), missing = "#123456"), c("#123456", "#FFFFFF"))
  expect_equal(shape_colours(0.125), "#FFF6C5")
})

test_that("other palettes are a name, colours, or the option's", {
  expect_equal(shape_colours(c(-1, -0.5, 0, 0.5, 1), palette = "paper"),
               c("#00C800", "#3C50FF", "#FFFFFF", "#FFE600", "#E60000"))
  expect_equal(shape_colours(c(-1, 0, 1), palette = c("black", "white")),
               c("#000000", "#7F7F7F", "#FFFFFF"))
  old <- options(crestline.palette = "paper")
  on.exit(options(old))
  expect_equal(shape_colours(-1), "#00C800")
  expect_crestline_error(shape_colours(0, palette = "loud"), c("`palette`", "safe"))
  expect_crestline_error(shape_colours(0, palette = 1), "`palette`")
})

test_that("what is no shape index is refused", {
  expect_error(shape_index(1:3), class = "crestline_error")
  expect_error(shape_index(1:3, 1:2), class = "crestline_error")
  expect_error(shape_colours(1.5), class = "crestline_error")
  expect_error(shape_category("ridge"), class = "crestline_error")
})
