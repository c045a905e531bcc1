# The same drawing for a browser: what is drawn is gathered, and joined into few objects at the end.

#' Settings of widgets
#'
#' Settings of the engine "widget". Every function that draws a surface takes them by name in its
#' `...`.
#'
#' @param size Greatest width and height of the scene, two numbers, in pixels of the browser.
#' @param triangles Greatest number of triangles of a surface. A finer mesh is thinned out for the
#'   scene only (quadric edge collapse), and the page says so.
#' @param balls Greatest number of points of a layer that are drawn as balls. More points are round
#'   dots.
#' @param points Greatest number of points of the specimens of an alignment, see [plot.aligned()].
#' @param zoom As in [rgl::par3d()]: smaller values show the object larger.
#' @param alpha Opacity of the surface, 0 to 1.
#' @return A list of these settings.
#' @template glossary
#' @template experimental
#' @examples
#' str(widget_settings(zoom = 0.6))
#' @export
widget_settings <- function(size = c(900, 700), triangles = 50000, balls = 200, points = 50000,
                            zoom = 0.75, alpha = 1) {
  list(size = check_size(size), triangles = check_count(triangles, "triangles"),
       balls = check_count(balls, "balls", lower = 0), points = check_count(points, "points"),
       zoom = check_number(zoom, "zoom", 0, open = TRUE),
       alpha = check_number(alpha, "alpha", 0, 1))
}

#' @rdname draw_surface
#' @export
drawing_engine <- function() {
  getOption("crestline.engine", if (interactive()) "widget" else "picture")
}

#' The names of the engines
#' @noRd
engines <- c("widget", "rgl", "picture")

#' An engine that was asked for, or that the option names
#' @noRd
check_engine <- function(engine) {
  check_choice(engine, engines, "engine")
}

#' The dots of `draw_surface()` that this engine knows
#'
#' Settings of the other engines are left out, so that one call draws with all of them.
#' @noRd
settings_of <- function(engine, ...) {
  given <- list(...)
  names <- list(picture = names(formals(picture_settings)),
                widget = names(formals(widget_settings)))
  if (engine == "rgl") return(given[!names(given) %in% setdiff(unlist(names), "alpha")])
  check_dots(..., known = c(names$picture, names$widget))
  do.call(if (engine == "picture") picture_settings else widget_settings,
          given[names(given) %in% names[[engine]]], quote = TRUE)
}

#' A scene that gathers what is drawn
#'
#' It is an environment below, as a device is: what is added stays added.
#' @noRd
new_widget_scene <- function(frame, rotation, settings) {
  drawn <- list2env(list(frame = frame, rotation = rotation, settings = settings, layer = "surface",
                         surfaces = list(), lines = list(), points = list(), bands = list(),
                         title = NULL, key = NULL, bar = NULL, moves = NULL,
                         notes = character()),
                    parent = emptyenv())
  structure(list(drawn = drawn, diagonal = 200 / frame$scale), class = "widget_scene")
}

widget_surface <- function(mesh, colour, rotation, settings) {
  scene <- new_widget_scene(scene_frame(mesh), rotation, settings)
  add_surface(scene, mesh, colour, settings$alpha)
}

#' A surface of a scene, thinned out where it has too many triangles
#' @noRd
add_surface <- function(scene, mesh, colour, alpha = 1) {
  most <- scene$drawn$settings$triangles
  colour <- rep_len(colour, ncol(mesh$vb))
  if (ncol(mesh$it) > most) {
    add_to(scene, "notes", sprintf("The surface is shown with about %d of its %d triangles.", most,
                                   ncol(mesh$it)))
    coarse <- Rvcg::vcgQEdecim(structure(mesh[c("vb", "it", "normals")], class = "mesh3d"),
                               tarface = most, silent = TRUE)
    coarse <- with_normals(coarse)
    colour <- colour[as.vector(Rvcg::vcgKDtree(mesh, coarse, k = 1)$index)]
    mesh <- coarse
  }
  one <- list(xyz = t(mesh$vb[1:3, , drop = FALSE]), it = mesh$it, colour = colour, alpha = alpha,
              normals = t(mesh$normals[1:3, , drop = FALSE]), layer = scene$drawn$layer)
  add_to(scene, "surfaces", list(one))
}

add_to <- function(scene, field, what) {
  assign(field, c(scene$drawn[[field]], what), envir = scene$drawn)
  shown(scene)
}

#' A scene as the value of a function: a widget is printed, what is drawn already is not
#' @noRd
shown <- function(scene) if (inherits(scene, "widget_scene")) scene else invisible(scene)

#' What is drawn now belongs to a layer of a name, which a widget can hide
#' @noRd
in_layer <- function(scene, layer) {
  if (inherits(scene, "widget_scene")) assign("layer", layer, envir = scene$drawn)
  scene
}

#' @export
draw_lines.widget_scene <- function(scene, x, colour = "black", width = 2, halo = NA, name = NULL) {
  x <- with_depth(point_matrix(x))
  add_to(scene, "lines", list(list(xyz = x, colour = colour, width = width, name = name,
                                   layer = scene$drawn$layer)))
}

#' @export
draw_points.widget_scene <- function(scene, x, colour = "black", size = 1, halo = NA, labels = NULL,
                                     name = NULL) {
  x <- with_depth(point_matrix(x))
  if (is.null(name)) name <- if (is.null(labels)) rownames(x) else labels
  add_to(scene, "points", list(list(xyz = x, colour = rep_len(colour, nrow(x)), size = size,
                                    labels = labels, name = name, layer = scene$drawn$layer)))
}

#' @export
draw_band.widget_scene <- function(scene, left, right, colour = "black", opacity = 0.4) {
  add_to(scene, "bands", list(list(left = point_matrix(left), right = point_matrix(right),
                                   colour = colour, opacity = opacity,
                                   layer = scene$drawn$layer)))
}

with_depth <- function(x) if (ncol(x) == 2) cbind(x, 0) else x

#' @export
print.widget_scene <- function(x, ...) {
  check_method_dots(...)
  if (interactive()) {
    print(htmltools::browsable(widget_html(x)))
  } else {
    n <- vapply(c("surfaces", "lines", "points"), function(kind) length(x$drawn[[kind]]), 0L)
    cat("<widget_scene> ", amount(n[[1]], "surface"), ", ", amount(n[[2]], "line"), ", ",
        amount(n[[3]], "set"), " of points; shown in an interactive session\n", sep = "")
  }
  invisible(x)
}

#' A scene in a document of knitr
#' @exportS3Method knitr::knit_print
#' @noRd
knit_print.widget_scene <- function(x, ...) knitr::knit_print(widget_html(x), ...)
