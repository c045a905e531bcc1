# One way to draw on three engines: a surface makes a scene, lines, points and bands are added to
# it.

#' Draw a surface, and lines, points and bands on it
#'
#' `draw_surface()` draws a mesh and returns a scene. The other functions add lines, points and
#' bands on the surface to the scene; hidden parts are not drawn. The engine "picture" draws on the
#' current graphics device with base graphics (orthographic, smoothly shaded, no display needed).
#' The engine "widget" makes a scene for the browser or the viewer of RStudio, that turns without a
#' display or X11 (rgl's WebGL). The engine "rgl" draws in the current rgl scene or a new one. With
#' `options(rgl.useNULL = TRUE)` it uses rgl's null device. The package sets this option when it is
#' loaded without a display.
#'
#' A widget is shown when it is printed, as at the prompt or in a document of knitr. A pointer that
#' rests on a point or a line shows its name. A click prints the name and the place below the scene.
#' Ticks below it hide its layers.
#'
#' `drawing_engine()` is the engine that is used if none is given. It is that of
#' `options(crestline.engine = )`. If the option is not set it is "widget" in interactive sessions
#' and "picture" elsewhere.
#'
#' @param mesh A `mesh3d` with triangles, or a `specimen`.
#' @param colour One colour, or one for each vertex.
#' @param view Direction of view, in one of three forms. A name: "front" (from +z, with y up),
#'   "left" and "right" (the subject's own), "three-quarter" (from the subject's left and a little
#'   above), "below", "above", "back". Two angles in radians: of the viewer towards the subject's
#'   left, and upwards. A 3 x 3 rotation matrix that turns the mesh so that x points right, y up and
#'   z to the viewer; `diag(3)` is the mesh as it lies.
#'
#'   In `draw_surface()` names and angles refer to the axes of the mesh. In `plot()` they refer to
#'   the object's own front, if at least four of its landmarks have typical places (columns `x`, `y`
#'   and `z` of the scheme's landmarks, see [curve_scheme()]). These are the places of
#'   [face_scheme()] for a specimen, an alignment and the results of an analysis, and of its own
#'   scheme for a shape. The landmarks are laid on these places first. So a face with landmarks is
#'   shown from the front, in whatever pose it was scanned.
#' @param engine "widget", "picture" or "rgl".
#' @param ... For "picture", the arguments of [picture_settings()]; for "widget", those of
#'   [widget_settings()]; for "rgl", properties of [rgl::material3d()] and `zoom`, as in
#'   [rgl::par3d()]. Settings of another of these engines have no effect.
#' @return `draw_surface()`: a scene. For the engine "picture" it is a list of class
#'   `picture_scene`. It has `rotation` (3 x 3), `pixel` (size of a pixel, in the unit of the mesh),
#'   `depth` (matrix, by pixel), and the map from pixels to the plot. For "rgl" a list of class
#'   `rgl_scene`: `ids` of the rgl objects, `diagonal` of the mesh's bounding box. For "widget" a
#'   list of class `widget_scene`: `drawn`, what is drawn (an environment), and `diagonal`.
#'   `draw_lines()`, `draw_points()`, `draw_band()`: the scene, with added rgl `ids` for "rgl";
#'   invisibly, if it is not a widget. `drawing_engine()`: the name of an engine.
#'   `visible_points()`: a logical value for each point of `x`, TRUE if it is visible.
#' @template glossary
#' @template experimental
#' @examples
#' ball <- Rvcg::vcgSphere(3)
#' scene <- draw_surface(ball, "wheat", view = c(0.4, 0.3), engine = "picture")
#' turn <- seq(0, 2 * pi, length.out = 200)
#' draw_lines(scene, cbind(cos(turn), 0, sin(turn)), "navy", width = 3)
#' @export
draw_surface <- function(mesh, colour = "#D8C3B0", view = "front",
                         engine = drawing_engine(), ...) {
  check_given()
  check_surface(mesh, "mesh")
  engine <- check_engine(engine)
  mesh <- with_normals(as_mesh(mesh))
  colour <- check_colours(colour, ncol(mesh$vb))
  rotation <- view_rotation(view)
  switch(engine,
         picture = picture_surface(mesh, colour, rotation, settings_of(engine, ...)),
         widget = widget_surface(mesh, colour, rotation, settings_of(engine, ...)),
         rgl = do.call(rgl_surface, c(list(mesh, colour, rotation), settings_of(engine, ...)),
                       quote = TRUE))
}

#' @rdname draw_surface
#' @param scene Value of `draw_surface()`.
#' @param x Points: a matrix with three columns, or a data frame with columns `x`, `y` and `z`, such
#'   as a `mesh_path`; in the unit of the mesh. In lines a row of NA makes a gap.
#' @param width Line width, as `lwd` of [graphics::par()]; pixels for "widget".
#' @param name Name that a widget shows. One for a line; for points one, or one for each. NULL:
#'   `labels` or the row names of points, none for a line.
#' @param halo Colour of a wider line below the line, or of a ring about the points ("picture"
#'   only). NA: none.
#' @export
draw_lines <- function(scene, x, colour = "black", width = 2, halo = NA, name = NULL) {
  check_given()
  check_scene(scene)
  point_matrix(x)
  check_drawn(colour, halo)
  check_number(width, "width", lower = 0)
  check_names(name, "name", null = TRUE)
  UseMethod("draw_lines")
}

#' A scene of one engine or the other
#' @noRd
check_scene <- function(scene) {
  if (inherits(scene, c("rgl_scene", "widget_scene"))) return(invisible(scene))
  check_class(scene, "picture_scene", "scene", "draw_surface()")
}

#' Colours and rings of what is drawn
#' @noRd
check_drawn <- function(colour, halo = NA) {
  check_colour(colour, "colour")
  check_colour(halo, "halo", none = TRUE)
}

#' @rdname draw_surface
#' @param size Diameter of points, as `cex` of [graphics::par()]. "rgl" and "widget" draw balls; at
#'   size 1 their diameter is 1/200 of the diagonal of the mesh's bounding box.
#' @param labels Names to write beside the points, or NULL.
#' @export
draw_points <- function(scene, x, colour = "black", size = 1, halo = NA, labels = NULL,
                        name = NULL) {
  check_given()
  check_scene(scene)
  point_matrix(x)
  check_drawn(colour, halo)
  check_number(size, "size", lower = 0)
  check_names(labels, "labels", null = TRUE)
  check_names(name, "name", null = TRUE)
  UseMethod("draw_points")
}

#' @rdname draw_surface
#' @param left,right The two sides of a band: points as `x`, the same number on both sides.
#' @param opacity Opacity of the band, 0 to 1.
#' @export
draw_band <- function(scene, left, right, colour = "black", opacity = 0.4) {
  check_given()
  check_scene(scene)
  sides <- list(point_matrix(left, name = "left"), point_matrix(right, name = "right"))
  if (nrow(sides[[1]]) != nrow(sides[[2]])) {
    crestline_abort(sprintf("`left` has %d points, `right` %d.", nrow(sides[[1]]),
                            nrow(sides[[2]])),
                    "Give as many on either side.", stage = "picture")
  }
  check_drawn(colour)
  check_number(opacity, "opacity", 0, 1)
  UseMethod("draw_band")
}

view_rotation <- function(view) {
  if (is.matrix(view) && is.numeric(view)) {
    proper <- identical(dim(view), c(3L, 3L)) && all(is.finite(view)) &&
      max(abs(crossprod(view) - diag(3))) < 1e-6 && det(view) > 0
    if (!proper) {
      crestline_abort("`view` is a matrix but not a 3 x 3 rotation.",
                      "Its rows must be orthonormal and its determinant 1.", stage = "picture")
    }
    return(unname(view))
  }
  angles <- list("front" = c(0, 0), "left" = c(pi / 2, 0), "right" = c(-pi / 2, 0),
                 "three-quarter" = c(pi / 5, pi / 18), "below" = c(0, -pi / 2),
                 "above" = c(0, pi / 2), "back" = c(pi, 0))
  if (is.character(view)) view <- angles[[check_choice(view, names(angles), "view")]]
  if (!is.numeric(view) || length(view) != 2 || any(!is.finite(view))) {
    crestline_abort("`view` is neither a name, nor two angles, nor a 3 x 3 rotation.",
                    "Give \"front\", or c(round, up) in radians.", stage = "picture")
  }
  round <- view[[1]]
  up <- view[[2]]
  rbind(c(cos(round), 0, -sin(round)),
        c(-sin(round) * sin(up), cos(up), -cos(round) * sin(up)),
        c(sin(round) * cos(up), sin(up), cos(round) * cos(up)))
}
