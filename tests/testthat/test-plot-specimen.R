test_that("a specimen is drawn in each kind of colour", {
  bent <- ball_curvature()
  for (colour in c("natural", "shape index", "curvature", "plain")) {
    scene <- draw_quietly(plot(ball_specimen(), colour, bent, engine = "picture", labels = TRUE,
                               main = "a ball"))
    expect_s3_class(scene, "picture_scene")
  }
})

test_that("the colours are those of the shape index, the scan, or none", {
  ball <- ball_specimen()
  expect_setequal(specimen_scale(ball, "shape index", ball_curvature())$colours, shape_colours(1))
  expect_length(specimen_scale(ball, "natural", NULL)$colours, 1)
  ball$mesh$material$color <- rep("#102030", ncol(ball$mesh$vb))
  expect_setequal(specimen_scale(ball, "natural", NULL)$colours, "#102030")
  expect_length(specimen_scale(ball, "plain", NULL)$colours, 1)
})

test_that("the scale of curvature is signed: valleys to ridges, missing grey", {
  bent <- structure(list(k1 = c(1, 0, 0, 0.1, NA), k2 = c(0, -1, 0, -0.2, NA)), class = "curvature")
  colours <- curvature_legend(bent, quantile = 1,
                              palette = c("#0000FF", "#FFFFFF", "#FF0000"))$colours
  expect_equal(colours[c(1:3, 5)], c("#0000FF", "#FF0000", "#FFFFFF", "#BEBEBE"))
  expect_equal(colours[4], "#FFCCCC")
})

test_that("curvature is computed at the radius asked for when none is given", {
  scene <- draw_quietly(plot(ball_specimen(), "shape index", radius = 0.4, engine = "picture"))
  expect_s3_class(scene, "picture_scene")
  expect_error(draw_quietly(plot(ball_specimen(), "shape index", radius = -1, engine = "picture")),
               class = "crestline_error")
})

test_that("the curvature of another mesh is refused, with the specimen's name", {
  expect_error(draw_quietly(plot(ball_specimen(), "shape index", ball_curvature(10),
                                 engine = "picture")),
               "specimen ball", class = "crestline_error")
  expect_error(draw_quietly(plot(ball_specimen(), "rainbow", engine = "picture")),
               class = "crestline_error")
})

test_that("margins are put back", {
  margins <- draw_quietly({
    before <- graphics::par("mar")
    plot(ball_specimen(), "plain", engine = "picture")
    rbind(before, graphics::par("mar"))
  })
  expect_equal(margins[1, ], margins[2, ])
})

test_that("a real scan is drawn within seconds", {
  mesh <- Rvcg::vcgImport(shared_data("scan_a", "surface.ply"), readcolor = FALSE, silent = TRUE)
  scan <- specimen(mesh, id = "scan_a")
  seconds <-
    system.time(scene <- draw_quietly(plot(scan, "plain", engine = "picture")))[["elapsed"]]
  expect_lt(seconds, 15)
  expect_gt(mean(is.finite(scene$depth)), 0.3)
})
