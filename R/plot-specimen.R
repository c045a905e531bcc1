# A specimen in its own colours, plain, or by curvature.

#' Plot a specimen
#'
#' Draws the surface in its natural colours, plain, or coloured by shape index or curvature, with
#' its landmarks. With `what` it draws other pictures of the same specimen.
#'
#' @param x A [specimen()].
#' @param colour Quantity that the colours show. "natural": the colours of the scan; plain if it has
#'   none. "shape index": see [plot_shape_scale()]. "curvature": the principal curvature with the
#'   greater absolute value; valleys are blue, ridges red, with full colour at the 95 % quantile of
#'   its absolute value. "plain": one colour.
#' @param radius Radius of the curvature for "shape index" and "curvature", in the unit of the mesh.
#'   The default, 1/25 of the diagonal of the mesh's bounding box, is about 10 mm on a face. Or the
#'   [curvature()] of the specimen's mesh, if you have it (also as `curvature`).
#' @param engine "widget" for a scene that turns in the browser, "picture" for base graphics on the
#'   current device, "rgl" for rgl's window. See [draw_surface()].
#' @param view Direction of view, see [draw_surface()]: from the front of the face, if it has face
#'   landmarks.
#' @param landmarks Whether to draw the landmarks.
#' @param legend Whether to draw the scale of colours (not by "rgl").
#' @param main Title.
#' @param ... `labels`: whether to write the names of the landmarks (TRUE by default for
#'   "refinement" only). `palette`: for "shape index" as in [shape_colours()], for "curvature"
#'   colours from valley to ridge. Arguments of [draw_surface()], and further arguments of "placing"
#'   and "cuts", see below.
#' @param what Kind of picture, see below.
#' @section Pictures:
#'   * `"surface"`: the surface with its landmarks.
#'   * `"placing"`: the landmarks of [find_landmarks()], seen from several sides. Found and placed
#'     ones are green, doubtful ones red, and predicted ones blue. Predicted landmarks off the scan
#'     are not drawn. Further argument `least`: the least confidence of a landmark that is not
#'     doubtful (0 to 1, 0.5 by default). Further argument `views`: directions of view, as angles in
#'     radians towards the subject's left (`c(-0.7, 0, 0.7)` by default; a widget is one scene, from
#'     the front). Of the arguments above
#'     only those of [draw_surface()] have an effect.
#'   * `"refinement"`: the landmarks of [refine_landmarks()]. Given ones are black, their defined
#'     places orange, with lines between. Of the arguments above `view`, `labels` and `main` have an
#'     effect.
#'   * `"cuts"`: paths that planes through two landmarks cut from the surface, one path for each
#'     plane (Fig. 2 of the paper). [reference_path()] chooses among such paths. Further arguments
#'     are `from` and `to`, the names of the two landmarks, `colours`, one for each cut, and `width`
#'     of the lines. `angles` are those of the planes about the axis, in radians, as in
#'     [plane_path()]. The default of `angles` is `c(-pi / 6, 0, pi / 6)`. `colour` is "plain" by
#'     default.
#' @return The scene of [draw_surface()], for [draw_lines()] and similar functions; invisibly, if it
#'   is not a widget. With another engine than "widget": for "placing" the specimen, for "cuts" a
#'   list with a `mesh_path` for each angle that has a path.
#' @section Errors: of class `crestline_error`: the landmarks were not found by [find_landmarks()]
#'   ("placing") or not refined ("refinement"); no cut joins the two landmarks ("cuts").
#' @section Warnings: of class `crestline_warning`: some cuts end at a border of the mesh, and are
#'   left out.
#' @template glossary
#' @templateVar where Fig. 2
#' @template paper
#' @seealso [check_placing()], [refine_landmarks()], [reference_path()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' plot(face, "shape index", radius = 10, engine = "picture")
#' mouth <- face$landmarks[c("chL", "chR", "sn"), ]
#' plot(face, what = "cuts", from = "chL", to = "chR", around = mouth, engine = "picture")
#' }
#' @export
plot.specimen <- function(x, colour = c("natural", "shape index", "curvature", "plain"),
                          radius = mesh_diagonal(x$mesh) / 25,
                          engine = drawing_engine(), view = "front",
                          landmarks = TRUE, legend = TRUE, main = NULL, ...,
                          what = c("surface", "placing", "refinement", "cuts")) {
  check_class(x, "specimen", "x", "specimen() or read_specimen()")
  what <- check_choice(what, c("surface", "placing", "refinement", "cuts"), "what")
  given <- list(...)
  labels <- if (is.null(given[["labels"]])) what == "refinement" else given[["labels"]]
  curvature <- if (inherits(radius, "curvature")) radius else given[["curvature"]]
  more <- given[!names(given) %in% c("labels", "curvature", "palette")]
  with_more <- function(f, ...) do.call(f, c(list(...), more), quote = TRUE)
  if (what == "placing") return(with_more(draw_placing, x, engine = engine))
  if (what == "refinement") {
    return(with_more(draw_refinement, x, view, labels, main, engine = engine))
  }
  if (missing(colour) && what == "cuts") colour <- "plain"
  colour <- check_choice(colour, surface_choices, "colour")
  if (what == "cuts") {
    return(with_more(draw_cuts, x, surface = colour, curvature = curvature, radius = radius,
                     engine = engine, view = view, labels = labels, legend = legend, main = main))
  }
  check_flags(landmarks, labels, legend)
  main <- check_text(main, "main", null = TRUE)
  engine <- check_engine(engine)
  scale <- specimen_scale(x, colour, shown_curvature(x, colour, curvature, radius),
                          given[["palette"]])
  legend <- legend && !is.null(scale$ramp)
  if (engine == "picture") {
    old <- graphics::par(mar = c(0.5, 0.5, if (is.null(main)) 0.5 else 2, if (legend) 7 else 0.5))
    on.exit(graphics::par(old))
  }
  scene <- with_more(draw_surface, x$mesh, scale$colours, posed_view(view, x$landmarks), engine)
  if (landmarks) scene <- draw_landmarks(scene, x$landmarks, labels)
  draw_title(scene, main)
  if (legend) draw_bar(scene, scale$ramp, scale$at, scale$labels, scale$title)
  shown(scene)
}

draw_landmarks <- function(scene, landmarks, labels) {
  placed <- landmarks[stats::complete.cases(landmarks), , drop = FALSE]
  if (!nrow(placed)) return(scene)
  draw_points(in_layer(scene, "landmarks"), placed, "black", halo = "white",
              labels = if (labels) rownames(placed), name = rownames(placed))
}

#' The curvature that colours show: the given one, after a check, or computed
#' @noRd
shown_curvature <- function(x, colour, given, radius) {
  if (!is.null(given)) check_curvature_on(given, x)
  if (!is.null(given) || !colour %in% c("shape index", "curvature")) return(given)
  curvature(x$mesh, check_number(radius, "radius", 0, open = TRUE))
}
