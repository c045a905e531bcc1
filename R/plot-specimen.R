# A specimen in its own colours, plain, or by curvature.

#' Plot a specimen
#'
#' Draws the surface in its natural colours, plain, or coloured by shape index or curvature, with
#' its landmarks.
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
#' @param labels Whether to write their names too.
#' @param legend Whether to draw the scale of colours ("picture" only).
#' @param main Title.
#' @param ... Passed to [draw_surface()].
#' @return The scene of [draw_surface()], invisibly, for [draw_lines()] and its like.
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' face <- specimen(humface, id = "humface")
#' plot(face, "shape index", radius = 10, engine = "picture")
#' }
#' @export
plot.specimen <- function(x, colour = c("natural", "shape index", "curvature", "plain"),
                          curvature = NULL, radius = mesh_diagonal(x$mesh) / 25,
                          engine = if (interactive()) "rgl" else "picture", view = "front",
                          landmarks = TRUE, labels = FALSE, legend = TRUE, main = NULL, ...) {
  check_class(x, "specimen", "x", "specimen() or read_specimen()")
  if (!is.null(curvature)) check_curvature_on(curvature, x)
  check_flags(landmarks, labels, legend)
  main <- check_text(main, "main", null = TRUE)
  colour <- check_choice(colour, surface_choices, "colour")
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
