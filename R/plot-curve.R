# Curves on their specimen, each with its band of two standard errors.

#' Plot curves on their specimen
#'
#' The estimated curve is drawn as a line, its points as dots, and a band of two standard errors to each side. The band lies
#' across the curve, in the direction normal x tangent at every point.
#'
#' @param x A `curve`, as [ridge_curve()] returns it.
#' @param curves A list of curves, or one curve.
#' @param specimen The `specimen` it lies on.
#' @param surface What the colours of the surface show, as `colour` of [plot.specimen()].
#' @param colour The colour of the curves, one for all or one for each; NULL for one a type: ridges dark red, valleys dark blue, plane curves black.
#' @param band Whether to draw the band.
#' @param points Whether to draw the curve's points.
#' @param width Line width.
#' @param landmarks Whether to draw the specimen's landmarks.
#' @param legend Whether to draw the scale of colours and the key of the curves ("picture" only).
#' @param engine,... As in [plot.specimen()], which the rest is passed to: `view`, `curvature`, `radius`, `main`, and the
#'   settings of the picture: `around = x$path` shows the curve from near.
#' @return The scene of [draw_surface()], invisibly.
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' corners <- rbind(chR = Rvcg::humface.lm[6, ], chL = Rvcg::humface.lm[7, ])
#' face <- specimen(humface, corners, id = "humface")
#' curve <- ridge_curve(face, "chR", "chL", "valley", radius = 5, width = 15, n = 11)
#' plot(curve, face, "plain", engine = "picture")
#' }
#' @export
plot.curve <- function(x, specimen, ...) plot_curves(list(x), specimen, ...)

#' @rdname plot.curve
#' @export
plot_curves <- function(curves, specimen, surface = "shape index", colour = NULL, band = TRUE,
                        points = TRUE, width = 2.5, landmarks = FALSE,
                        engine = if (interactive()) "rgl" else "picture", legend = TRUE, ...) {
  curves <- check_curves(curves)
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  scene <- plot(specimen, surface, engine = engine, landmarks = landmarks, legend = legend, ...)
  key <- curve_key(curves, colour)
  for (i in seq_along(curves)[band]) scene <- draw_curve_band(scene, curves[[i]], specimen$mesh, key$colours[i])
  if (engine == "picture") for (curve in curves) draw_lines(scene, curve$path, "white", 2.2 * width)
  for (i in seq_along(curves)) scene <- draw_lines(scene, curves[[i]]$path, key$colours[i], width)
  for (i in seq_along(curves)[points]) {
    scene <- draw_points(scene, curves[[i]]$points, key$colours[i], size = 0.28 * width, halo = "white")
  }
  if (legend && engine == "picture" && length(key$names)) {
    on_scene(scene, graphics::legend("bottomleft", names(key$names), col = key$names, lwd = width, bty = "n", cex = 0.8))
  }
  invisible(scene)
}

# The colour of each curve, and what the legend says of them: colours named by type, or by curve where the user chose them.
curve_key <- function(curves, colour, ridge = "#A0002A", valley = "#16218C", plane = "#202020") {
  if (!is.null(colour)) {
    colours <- rep_len(colour, length(curves))
    return(list(colours = colours, names = stats::setNames(colours, names(curves))[!is.null(names(curves))]))
  }
  of_type <- c(ridge = ridge, valley = valley, plane = plane)
  type <- vapply(curves, function(curve) curve$type, "", USE.NAMES = FALSE)
  list(colours = unname(of_type[type]), names = of_type[names(of_type) %in% type])
}

draw_curve_band <- function(scene, curve, mesh, colour) {
  sides <- band_sides(curve, mesh)
  if (nrow(sides$left) < 2) return(scene)
  draw_band(scene, sides$left, sides$right, colour)
}

# The two sides of the band along the path: `multiple` standard errors across it, along the surface.
band_sides <- function(curve, mesh, multiple = 2) {
  xyz <- point_matrix(curve$path)
  se <- se_along_path(curve)
  keep <- is.finite(se)
  across <- cross_rows(point_normals(mesh, curve$path), path_tangents(xyz))
  shift <- multiple * se * across / sqrt(rowSums(across^2))
  keep <- keep & is.finite(rowSums(shift))
  list(left = (xyz + shift)[keep, , drop = FALSE], right = (xyz - shift)[keep, , drop = FALSE])
}

# The standard error at every place of the path, linear between the curve's points: each stands at its nearest place of the path.
se_along_path <- function(curve) {
  xyz <- t(point_matrix(curve$path))
  at <- apply(point_matrix(curve$points), 1, function(p) which.min(colSums((xyz - p)^2)))
  known <- is.finite(curve$points$se)
  if (sum(known) < 2) return(rep(NA_real_, ncol(xyz)))
  stats::approx(curve$path$s[at][known], curve$points$se[known], curve$path$s, rule = 2, ties = mean)$y
}

# Tangents by central differences, zero where neighbours coincide.
path_tangents <- function(xyz) {
  n <- nrow(xyz)
  xyz[c(2:n, n), , drop = FALSE] - xyz[c(1, 1:(n - 1)), , drop = FALSE]
}

# Unit normals at points of the mesh, from its vertices' normals.
point_normals <- function(mesh, points) {
  normals <- with_normals(mesh)$normals[1:3, , drop = FALSE]
  corners <- mesh$it[, points$face, drop = FALSE]
  at <- t(normals[, corners[1, ], drop = FALSE]) * points$w1 + t(normals[, corners[2, ], drop = FALSE]) * points$w2 +
    t(normals[, corners[3, ], drop = FALSE]) * points$w3
  at / sqrt(rowSums(at^2))
}

cross_rows <- function(a, b) {
  cbind(a[, 2] * b[, 3] - a[, 3] * b[, 2], a[, 3] * b[, 1] - a[, 1] * b[, 3], a[, 1] * b[, 2] - a[, 2] * b[, 1])
}

check_curves <- function(curves, call = rlang::caller_env()) {
  if (inherits(curves, "curve")) curves <- list(curves)
  for (curve in curves) check_class(curve, "curve", "curves", "ridge_curve()", call)
  curves
}
