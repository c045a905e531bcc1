ball_scene <- function(...) draw_surface(unit_ball(), "wheat", engine = "widget", ...)

test_that("what is drawn is gathered, and stays where its value is dropped", {
  scene <- ball_scene()
  draw_lines(scene, cbind(0, 0, c(1, NA, 2)), name = "axis")
  draw_points(scene, rbind(top = c(0, 0, 1)), "red")
  draw_band(scene, cbind(0:1, 0, 1), cbind(0:1, 1, 1))
  expect_length(scene$drawn$lines, 1)
  expect_equal(scene$drawn$points[[1]]$name, "top")
  expect_length(scene$drawn$bands, 1)
  expect_output(print(scene), "<widget_scene> 1 surface, 1 line, 1 set of points")
  expect_visible(ball_scene())
  expect_visible(draw_points(scene, cbind(0, 0, 1)))
})

test_that("the option names the engine, and a wrong one is refused by name", {
  old <- options(crestline.engine = "widget")
  on.exit(options(old))
  expect_s3_class(draw_surface(unit_ball()), "widget_scene")
  expect_s3_class(plot(ball_specimen(), "plain"), "widget_scene")
  options(crestline.engine = "paper")
  expect_error(draw_surface(unit_ball()), "`engine`", class = "crestline_error")
  options(crestline.engine = NULL)
  expect_equal(drawing_engine(), if (interactive()) "widget" else "picture")
})

test_that("settings of the engines do not get in each other's way, misspelt ones are told of", {
  expect_s3_class(ball_scene(gloss = 0, zoom = 0.5), "widget_scene")
  expect_error(ball_scene(zom = 1), "no argument `zom`", class = "crestline_error")
  expect_error(widget_settings(alpha = 2), class = "crestline_error")
  draw_quietly(expect_s3_class(draw_surface(unit_ball(), engine = "picture", zoom = 0.5),
                               "picture_scene"))
  with_null_rgl(expect_s3_class(draw_surface(unit_ball(), engine = "rgl", gloss = 0), "rgl_scene"))
})

test_that("a fine surface is thinned out for the scene, and that is said", {
  mesh <- unit_ball()
  height <- mesh$vb[3, ]
  colour <- ifelse(height > 0, "#FF0000", "#0000FF")
  scene <- draw_surface(mesh, colour, engine = "widget", triangles = 500)
  one <- scene$drawn$surfaces[[1]]
  expect_lte(ncol(one$it), 520)
  expect_match(scene$drawn$notes, "about 500 of its 5120 triangles")
  far <- abs(one$xyz[, 3]) > 0.1
  expect_equal(one$colour[far], ifelse(one$xyz[far, 3] > 0, "#FF0000", "#0000FF"))
  expect_length(ball_scene()$drawn$notes, 0)
})

test_that("every picture with an engine is drawn as a widget", {
  x <- ball_specimen()
  is_widget <- function(scene) {
    expect_s3_class(scene, "widget_scene")
    scene$drawn
  }
  placed <- is_widget(plot(x, "shape index", ball_curvature(), engine = "widget", main = "A ball"))
  expect_equal(placed$title, "A ball")
  expect_match(placed$bar$title, "radius 0.3")
  expect_equal(placed$points[[1]]$name, c("east", "front", "west"))
  curve <- is_widget(plot(equator_curve(), x, "plain", engine = "widget"))
  expect_equal(curve$lines[[1]]$name, "east to front")
  expect_named(curve$key, "ridge")
  expect_visible(plot(equator_curve(), x, "plain", engine = "widget"))
  is_widget(suppressWarnings(plot(x, what = "cuts", from = "east", to = "front",
                                  engine = "widget")))
  shape <- quad_shape()
  is_widget(plot(shape, quad_specimen(), surface = "plain", engine = "widget"))
  model <- is_widget(plot(shape, engine = "widget"))
  expect_true("triangles" %in% drawn_layers(model))
})
