test_that("the cuts are great circles of a ball, at the angles asked for", {
  ball <- specimen(Rvcg::vcgSphere(4), rbind(east = c(1, 0, 0), front = c(0, 0, 1)), id = "ball")
  angles <- c(-0.5, 0, 0.5)
  paths <- draw_quietly(plot(ball, what = "cuts", from = "east", to = "front", angles = angles,
                             engine = "picture"))
  expect_equal(vapply(paths, attr, 0, "angle"), angles)
  expect_equal(attr(paths[[2]], "length"), pi / 2, tolerance = 0.01)
  expect_error(plot(ball, what = "cuts", from = "east", to = "nowhere", engine = "picture"),
               class = "crestline_error")
})

test_that("rgl draws them too", {
  ball <- specimen(Rvcg::vcgSphere(4), rbind(east = c(1, 0, 0), front = c(0, 0, 1)), id = "ball")
  with_null_rgl({
    plot(ball, what = "cuts", from = "east", to = "front", angles = c(0, 0.5), engine = "rgl")
    expect_equal(as.character(rgl::ids3d()$type),
                 c("triangles", "linestrip", "linestrip", "spheres", "text"))
  })
})

test_that("cuts that meet a border are left out with a warning, and refused when none is left", {
  ball <- specimen(Rvcg::vcgSphere(4), rbind(east = c(1, 0, 0), front = c(0, 0, 1)), id = "ball")
  failure <- tryCatch(crestline_abort("a hole.", "Fill it.", "path",
                                      class = "crestline_path_error"), error = identity)
  path <- plane_path(ball, "east", "front", 0)
  expect_warning(kept <- arrived_cuts(list(failure, path), "ball"), "1 of 2 cuts",
                 class = "crestline_warning")
  expect_identical(kept, list(path))
  expect_error(arrived_cuts(list(failure, failure), "ball"), "a hole",
               class = "crestline_path_error")
})
