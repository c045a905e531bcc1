test_that("with the scheme's numbers a patch is the model's, to the last digit", {
  shape <- quad_shape()
  mesh <- patch_mesh(shape, quad_specimen(), "quad")
  expect_identical(unname(t(mesh$vb[1:3, ])), unname(coords(shape, "surface")))
  expect_equal(dim(mesh$it), dim(shape_mesh(shape)$it))
})

test_that("any number of columns and rows lies on the mesh, columns at equal chords", {
  shape <- quad_shape()
  specimen <- quad_specimen()
  mesh <- patch_mesh(shape, specimen, "quad", columns = 10, rows = 4)
  points <- attr(mesh, "points")
  expect_equal(c(ncol(mesh$vb), ncol(mesh$it)), c(40, 2 * 9 * 3))
  expect_on_mesh(points, specimen$mesh)
  expect_equal(points[c("column", "row")],
               data.frame(column = rep(1:10, each = 4), row = rep(1:4, 10)))
  chord <- function(rows) sqrt(rowSums(diff(as.matrix(points[rows, c("x", "y", "z")]))^2))
  spread <- function(x) max(x) / min(x) - 1
  for (k in 1:10) expect_lte(spread(chord(points$column == k)), 1e-8)
  for (row in c(1, 4)) expect_lte(spread(chord(points$row == row)), 1e-8)
  corner <- unname(as.matrix(points[c(1, 37, 40, 4), c("x", "y", "z")]))
  expect_equal(corner, unname(coords(shape, "landmarks")), tolerance = tolerances$rounding)
  on_left <- arc_lengths_on(shape$paths$left, as.matrix(points[1:4, c("x", "y", "z")]), 1e-9)
  expect_false(anyNA(on_left))
  xyz <- t(mesh$vb[1:3, ])
  expect_length(flipped_triangles(xyz, mesh$it, xyz), 0)
})

test_that("where bounding curves meet, a column is one vertex", {
  scheme <- quad_scheme(function(tables) {
    tables$patches <- data.frame(patch = "fan", n = 5, columns = "2", rows = 5, rows_kept = "1:5",
                                 curve_a = "bottom[1:5]", curve_b = "left[1:5]",
                                 outward = "columns")
    tables
  })
  mesh <- patch_mesh(quad_shape(scheme), quad_specimen(), "fan", columns = 5, rows = 5)
  expect_equal(attr(mesh, "points")$vertex[1:6], c(1, 1, 1, 1, 1, 2))
  expect_equal(ncol(mesh$vb), 21)
  expect_equal(ncol(mesh$it), 2 * 16 - 4)
})

test_that("patches that are not there, rows of points and missing curves are refused by name", {
  shape <- quad_shape()
  specimen <- quad_specimen()
  expect_crestline_error(patch_mesh(shape, specimen, "quat"), c("quat", "quad"), id = "quad")
  expect_crestline_error(patch_mesh(shape, specimen, "quad", rows = 1), "rows")
  expect_crestline_error(patch_mesh(shape, specimen, "quad", block = 2), "no such block")
  lost <- quad_shape(landmarks = quad_corners()[c("a", "b", "d"), ])
  expect_crestline_error(patch_mesh(lost, specimen, "quad"), "top is missing")
  blocks <- quad_scheme(function(tables) {
    tables$patches <- rbind(cbind(tables$patches, block = 1), cbind(tables$patches, block = 2))
    tables
  })
  expect_crestline_error(patch_mesh(quad_shape(blocks), specimen, "quad"),
                         c("several blocks", "block = 1 or 2"))
  expect_s3_class(patch_mesh(quad_shape(blocks), specimen, "quad", block = 2), "mesh3d")
})
