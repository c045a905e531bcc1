# A specimen in its own colours, plain, or by curvature.

#' Plot a specimen
#'
#' Draws the surface in its natural colours, plain, or coloured by shape index or curvature, with
#' its landmarks. With `what` it draws other pictures of the same specimen.
#'
#' @param x A `specimen`.
#' @param colour What the colours show: "natural" (the colours of the scan, plain where it has
#'   none), "shape index" (see [plot_shape_scale()]), "curvature" (the principal curvature greater
#'   in size: valleys blue, ridges red, in full at the 95 % quantile of its size) or "plain".
#' @param curvature The `curvature` of the specimen's mesh, for "shape index" and "curvature"; NULL
#'   to compute it.
#' @param radius Where curvature is computed: the radius of its neighbourhood, in the mesh's unit.
#'   The default, 1/25 of the diagonal of the mesh's box, is about 10 mm on a face.
#' @param engine "rgl" to turn it by hand, "picture" for base graphics on the current device. See
#'   [draw_surface()].
#' @param view Where to look from, see [draw_surface()].
#' @param landmarks Whether to draw the landmarks.
#' @param labels Whether to write their names too. TRUE by default for "refinement".
#' @param legend Whether to draw the scale of colours ("picture" only).
#' @param main Title.
#' @param ... Passed to [draw_surface()]. Further arguments of "placing" and "cuts" are given here
#'   too, see below.
#' @param what Which picture, see below.
#' @section Pictures:
#'   * `"surface"`: the surface with its landmarks.
#'   * `"placing"`: the landmarks of [find_landmarks()], seen from several sides. Found and placed
#'     ones are green, doubtful ones red, and predicted ones blue, where they lie on the scan.
#'     Further arguments: `least`, the least confidence of a landmark that is not doubtful (from 0
#'     to 1, 0.5 by default); `views`, the directions to look from, as angles in radians by which
#'     the viewer goes round to the subject's left (`c(-0.7, 0, 0.7)` by default). Of the arguments
#'     above only those of [draw_surface()] have an effect.
#'   * `"refinement"`: the landmarks of [refine_landmarks()]. Given ones are black, their defined
#'     places orange, with lines between. Of the arguments above `view`, `labels` and `main` have an
#'     effect.
#'   * `"cuts"`: the paths that planes through two landmarks cut from the surface, one a plane (Fig.
#'     2 of the paper). [reference_path()] chooses among such paths. Further arguments: `from` and
#'     `to`, the names of the two landmarks; `angles`, of the planes about the axis between them, in
#'     radians, as in [plane_path()] (`c(-pi / 6, 0, pi / 6)` by default); `colours`, one for each
#'     cut; `width` of the lines. `colour` is "plain" by default.
#' @return The scene of [draw_surface()], invisibly, for [draw_lines()] and its like. "placing": the
#'   specimen. "cuts": a list with a `mesh_path` for each angle at which there is a path.
#' @section Errors: of class `crestline_error`: the landmarks were not found ("placing") or not
#'   refined ("refinement"); no cut comes from one landmark to the other ("cuts").
#' @section Warnings: of class `crestline_warning`, if some cuts are left out because they come to a
#'   border of the mesh.
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
                          curvature = NULL, radius = mesh_diagonal(x$mesh) / 25,
                          engine = if (interactive()) "rgl" else "picture", view = "front",
                          landmarks = TRUE, labels = what == "refinement", legend = TRUE,
                          main = NULL, ..., what = c("surface", "placing", "refinement", "cuts")) {
  check_class(x, "specimen", "x", "specimen() or read_specimen()")
  what <- check_choice(what, c("surface", "placing", "refinement", "cuts"), "what")
  if (what == "placing") return(draw_placing(x, ...))
  if (what == "refinement") return(draw_refinement(x, view, labels, main, ...))
  if (missing(colour) && what == "cuts") colour <- "plain"
  colour <- check_choice(colour, surface_choices, "colour")
  if (what == "cuts") {
    return(draw_cuts(x, ..., surface = colour, curvature = curvature, radius = radius,
                     engine = engine, view = view, labels = labels, legend = legend, main = main))
  }
  if (!is.null(curvature)) check_curvature_on(curvature, x)
  check_flags(landmarks, labels, legend)
  main <- check_text(main, "main", null = TRUE)
  engine <- check_choice(engine, c("rgl", "picture"), "engine")
  if (colour %in% c("shape index", "curvature") && is.null(curvature)) {
    curvature <- curvature(x$mesh, check_number(radius, "radius", 0, open = TRUE))
  }
  scale <- specimen_scale(x, colour, curvature)
  legend <- legend && !is.null(scale$ramp)
  if (engine == "picture") {
    old <- graphics::par(mar = c(0.5, 0.5, if (is.null(main)) 0.5 else 2, if (legend) 7 else 0.5))
    on.exit(graphics::par(old))
  }
  scene <- draw_surface(x$mesh, scale$colours, view, engine, ...)
  placed <- x$landmarks[stats::complete.cases(x$landmarks), , drop = FALSE]
  if (landmarks && nrow(placed) > 0) {
    scene <- draw_points(scene, placed, "black", halo = "white",
                         labels = if (labels) rownames(placed))
  }
  if (engine == "picture") {
    graphics::title(main)
    if (legend) colour_bar(scale$ramp, scale$at, scale$labels, title = scale$title)
  }
  invisible(scene)
}

# An upright bar of colours in the right margin, from the first at the bottom; labels at shares `at`
# of its height; what they are above it.
colour_bar <- function(ramp, at, labels, share = 0.6, width = 0.8, title = NULL) {
  line <- diff(graphics::grconvertX(0:1, "lines", "user"))
  usr <- graphics::par("usr")
  left <- usr[2] + 0.3 * line
  middle <- mean(usr[3:4])
  half <- share * (usr[4] - usr[3]) / 2
  old <- graphics::par(xpd = NA)
  on.exit(graphics::par(old))
  graphics::rasterImage(as.matrix(rev(ramp)), left, middle - half, left + width * line,
                        middle + half)
  graphics::rect(left, middle - half, left + width * line, middle + half, border = "grey40",
                 lwd = 0.5)
  graphics::text(left + width * line, middle - half + 2 * half * at, labels, pos = 4, offset = 0.3,
                 cex = 0.75)
  if (!is.null(title)) {
    graphics::text(left, middle + half + 0.4 * line, paste(strwrap(title, 12), collapse = "\n"),
                   adj = c(0, 0), cex = 0.75)
  }
}
