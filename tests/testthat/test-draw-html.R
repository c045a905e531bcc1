html_of <- function(scene) {
  testthat::skip_if_not_installed("htmltools")
  testthat::skip_if_not_installed("htmlwidgets")
  as.character(widget_html(scene, "here"))
}

test_that("title, key, scale, layers and notes stand around the scene", {
  scene <- draw_surface(unit_ball(), "wheat", engine = "widget", triangles = 500)
  draw_lines(in_layer(scene, "curves"), cbind(0, 0, 1:2), name = "axis")
  draw_title(scene, "One < two")
  draw_key(scene, c(ridge = "#C8102E", ridge = "#C8102E"))
  draw_bar(scene, c("red", "blue"), 0:1, c("low", "high"), "millifurlong")
  html <- html_of(scene)
  for (text in c("One &lt; two", "#C8102E", "millifurlong", ">high<", "data-layer=\"curves\"",
                 "data-layer=\"surface\"", "rest on a point", "of its 5120 triangles")) {
    expect_true(grepl(text, html, fixed = TRUE), label = text)
  }
  expect_length(gregexpr("#C8102E", html, fixed = TRUE)[[1]], 1)
  expect_false(grepl("data-layer=\"|rest on a point",
                     html_of(draw_surface(unit_ball(), engine = "widget"))))
})

test_that("the user's rgl device is left as it was, and none is left open", {
  before <- rgl::rgl.dev.list()
  html_of(draw_surface(unit_ball(), engine = "widget"))
  expect_identical(rgl::rgl.dev.list(), before)
  with_null_rgl({
    own <- rgl::cur3d()
    html_of(draw_surface(unit_ball(), engine = "widget"))
    expect_identical(rgl::cur3d(), own)
  })
})

test_that("lines, points and bands of a look are one object", {
  scene <- draw_surface(unit_ball(), "wheat", engine = "widget")
  in_layer(scene, "curves")
  for (i in 1:5) draw_lines(scene, cbind(i, 0, c(1, 2, NA, 4, 5)), c("red", "blue")[1 + i %% 2])
  for (i in 1:5) draw_points(scene, cbind(i, 0, 1:3), "red", 0.5)
  for (i in 1:5) draw_band(scene, cbind(0:2, i, 1), cbind(0:2, i + 1, 1))
  with_null_rgl({
    ids <- joined_objects(scene$drawn)
    shown <- rgl::ids3d()
    kind <- stats::setNames(as.character(shown$type), shown$id)
    expect_equal(sort(unname(kind[as.character(ids$curves)])),
                 sort(c("triangles", "lines", "triangles")))
    segments <- rgl::rgl.attrib(ids$curves[kind[as.character(ids$curves)] == "lines"], "vertices")
    # Two segments a line: the gap has none.
    expect_equal(nrow(segments), 5 * 2 * 2)
    back <- from_scene(segments, scene$drawn$frame)
    expect_equal(back[1:4, ], cbind(1, 0, c(1, 2, 4, 5)), tolerance = 1e-5, ignore_attr = TRUE)
  })
})

test_that("few points are balls, many are dots", {
  kinds <- function(n) with_null_rgl({
    scene <- draw_surface(unit_ball(), engine = "widget", balls = 10)
    draw_points(in_layer(scene, "points"), matrix(stats::runif(3 * n), n), labels = NULL)
    id <- joined_objects(scene$drawn)$points
    shown <- rgl::ids3d()
    as.character(shown$type[match(id, shown$id)])
  })
  expect_equal(kinds(10), "triangles")
  expect_equal(kinds(11), "points")
})

test_that("names know their place, the way out, and their layer", {
  scene <- draw_surface(unit_ball(), "wheat", engine = "widget")
  draw_points(in_layer(scene, "landmarks"), rbind(top = c(0, 0, 1), gone = NA, east = c(1, 0, 0)))
  draw_lines(in_layer(scene, "curves"), cbind(cos(1:500 / 500), sin(1:500 / 500), 0), name = "arc")
  found <- scene_names(scene$drawn, most = 40)
  expect_equal(unlist(found$names), c("top", "east", "arc"))
  expect_equal(unlist(found$within), c("landmarks", "landmarks", "curves"))
  expect_equal(tabulate(unlist(found$of) + 1), c(1, 1, 40))
  at <- from_scene(matrix(unlist(found$at), ncol = 3, byrow = TRUE), scene$drawn$frame)
  expect_equal(at[1:2, ], rbind(c(0, 0, 1), c(1, 0, 0)), tolerance = 1e-5)
  out <- matrix(unlist(found$out), ncol = 3, byrow = TRUE)
  expect_equal(out, at, tolerance = 0.1)
})

test_that("a scene far from the origin and in metres is drawn in a frame near the origin", {
  mesh <- unit_ball()
  mesh$vb[1:3, ] <- 0.001 * mesh$vb[1:3, ] + c(1e4, -2e4, 5)
  scene <- draw_surface(mesh, engine = "widget")
  xyz <- into_scene(scene$drawn$surfaces[[1]]$xyz, scene$drawn$frame)
  expect_equal(sqrt(sum(apply(xyz, 2, function(v) diff(range(v)))^2)), 200, tolerance = 1e-6)
  expect_lt(max(abs(xyz)), 101)
})
