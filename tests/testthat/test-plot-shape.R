test_that("a shape is drawn on its specimen and as a surface", {
  shape <- quad_shape()
  scene <- draw_quietly(plot(shape, quad_specimen(), "model", surface = "plain",
                             engine = "picture"))
  expect_s3_class(scene, "picture_scene")
  expect_s3_class(draw_quietly(plot(shape, engine = "picture")), "picture_scene")
})

test_that("the picture of a shape's own surface holds its curves, which rise above it", {
  shape <- quad_shape()
  scene <- draw_quietly(plot(shape, engine = "picture", margin = 0))
  paths <- do.call(rbind, lapply(shape$paths, columns_of, c("x", "y", "z")))
  seen <- paths %*% t(scene$rotation)
  expect_true(all(seen[, 1] >= scene$usr[1] - 1e-9 & seen[, 1] <= scene$usr[2] + 1e-9))
  expect_true(all(seen[, 2] >= scene$usr[3] - 1e-9 & seen[, 2] <= scene$usr[4] + 1e-9))
  expect_gt(max(seen[, 2]), max((t(shape_mesh(shape)$vb[1:3, ]) %*% t(scene$rotation))[, 2]))
})

test_that("curves have the colour of their kind, edges their own", {
  count <- function(pixels, colour) {
    rgb <- grDevices::col2rgb(colour)[, 1] / 255
    sum(rowSums(abs(matrix(pixels, ncol = 3) - rep(rgb, each = length(pixels) / 3))) < 0.1)
  }
  shape <- quad_shape()
  with_curves <- drawn_pixels(plot(shape, quad_specimen(), surface = "plain",
                                   colour = c(ridge = "red", valley = "blue", plane = "#00FF00"),
                                   width = 6, points = FALSE, engine = "picture"))
  expect_gt(count(with_curves, "#00FF00"), 50)
  expect_lt(count(with_curves, "red"), count(with_curves, "#00FF00"))
  edged <- drawn_pixels(plot(shape, edges = "black", engine = "picture"))
  bare <- drawn_pixels(plot(shape, edges = NA, engine = "picture"))
  expect_lt(sum(edged), sum(bare) - 50)
})

test_that("a shape is drawn in rgl", {
  shape <- quad_shape()
  with_null_rgl({
    expect_s3_class(plot(shape, quad_specimen(), surface = "plain", engine = "rgl"), "rgl_scene")
    expect_s3_class(plot(shape, engine = "rgl"), "rgl_scene")
  })
})

test_that("the surface takes a value for each surface point, as write_mesh() does", {
  shape <- quad_shape()
  values <- seq_len(nrow(coords(shape, "surface")))
  expect_s3_class(draw_quietly(plot(shape, surface = grDevices::rainbow(length(values)),
                                    engine = "picture")), "picture_scene")
})
