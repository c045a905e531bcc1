# Curves on their specimen, each with its band of two standard errors.

#' Plot curves on their specimen
#'
#' Draws the estimated curve as a line, its points as dots, and a band of two standard errors on
#' each side. The band lies across the curve, in the direction normal x tangent at every point.
#' `plot(x, what = "panel")` draws the smoothed strength in which the curve was found.
#'
#' @param x A `curve`, as [ridge_curve()] returns it.
#' @param curves A list of curves, or one curve.
#' @param specimen The [specimen()] of the curves. Not needed for the panel.
#' @param surface Quantity that the colours of the surface show, as `colour` of [plot.specimen()].
#' @param colour Colour of the curves, one for all or one for each. NULL: ridges dark red, valleys
#'   dark blue, plane curves black.
#' @param band Whether to draw the band.
#' @param points Whether to draw the curve's points.
#' @param width Line width.
#' @param legend Whether to draw the scale of colours and the key of the curves (not by "rgl").
#' @param engine,... Arguments of [plot.specimen()]: `view`, `curvature`, `radius`, `main`,
#'   `landmarks` (FALSE here), and the settings of the picture. `around = x$path` shows the curve
#'   enlarged. `plot()` of a curve also
#'   takes the arguments of `plot_curves()`, or those of the panel.
#' @param what "surface": the curve on its specimen. "panel": the plane of s and d in which the
#'   curve was found.
#' @section Panel: The smoothed strength over arc length s along the reference path and signed
#'   distance d from it, with contours. It also shows the vertices from which it was smoothed, the
#'   reference path (d = 0, dashed), and the ridge found (solid) with a band of two standard errors.
#'   This is the right panel of Fig. 3 of the paper, which has no band. Further arguments:
#'   * `points`: whether to draw the vertices of the window (TRUE by default);
#'   * `grid`: numbers of grid cells along s and d (`c(300, 200)` by default);
#'   * `palette`: colours from strength 0 to the greatest;
#'   * `contours`: about how many contour lines (8 by default);
#'   * `colour`: colour of the ridge and its band;
#'   * `main`: title, by default the ends of the curve.
#'
#'   Others are passed to [graphics::image()].
#' @return The scene of [draw_surface()], invisibly. For a panel its grid, invisibly: a list of `s`,
#'   `d` (unit of the mesh) and `strength` (1 / unit). `strength` is a matrix with a row for each
#'   `s` and a column for each `d`; it is NA beyond the data.
#' @section Errors: of class `crestline_error`: the specimen has another mesh; a panel is asked for
#'   a plane curve, or for a curve that was not found by curvature.
#' @template glossary
#' @templateVar where Fig. 3
#' @template paper
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' lip <- ridge_curve(face, "chL", "st", "valley", radius = 5, width = 6, n = 9)
#' plot(lip, face, "plain", engine = "picture", around = face$landmarks[c("chL", "chR", "sn"), ])
#' plot(lip, what = "panel")
#' }
#' @export
plot.curve <- function(x, specimen, ..., what = c("surface", "panel")) {
  check_class(x, "curve", "x", "ridge_curve()")
  what <- check_choice(what, c("surface", "panel"), "what")
  if (what == "panel") draw_panel(x, ...) else plot_curves(list(x), specimen, ...)
}

#' @rdname plot.curve
#' @export
plot_curves <- function(curves, specimen, surface = "shape index", colour = NULL, band = TRUE,
                        points = TRUE, width = 2.5,
                        engine = drawing_engine(), legend = TRUE, ...) {
  if (missing(specimen)) {
    crestline_abort("`specimen` is not given.",
                    "Give the specimen of the curve; plot(curve, what = \"panel\") needs none.",
                    stage = "arguments")
  }
  check_given()
  check_flags(band, points, legend)
  if (!is.null(colour)) check_colour(colour, "colour")
  width <- check_number(width, "width", lower = 0)
  engine <- check_engine(engine)
  surface <- check_choice(surface, surface_choices, "surface")
  curves <- check_curves(curves)
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  for (i in seq_along(curves)) {
    name <- c(names(curves)[i], "")[1]
    label <- if (nzchar(name)) sprintf("curve \"%s\"", name) else
      sprintf("the curve from %s to %s", curves[[i]]$from, curves[[i]]$to)
    check_curve_on(curves[[i]], specimen, label)
  }
  more <- list(...)
  if (!"landmarks" %in% names(more)) more$landmarks <- FALSE
  scene <- do.call(plot, c(list(specimen, surface, engine = engine, legend = legend), more),
                   quote = TRUE)
  key <- curve_key(curves, colour)
  if (band) {
    scene <- in_layer(scene, "bands of error")
    for (i in seq_along(curves)) {
      scene <- draw_curve_band(scene, curves[[i]], specimen$mesh, key$colours[i])
    }
  }
  scene <- draw_curve_lines(in_layer(scene, "curves"), curves, key$colours, points, width)
  if (legend && length(key$names)) draw_key(scene, key$names, width = width)
  shown(scene)
}

#' Curves of [ridge_curve()] with their points, all lines below all points
#' @noRd
draw_curve_lines <- function(scene, curves, colours, points, width) {
  each <- seq_along(curves)
  name <- vapply(each, function(i) {
    own <- c(names(curves)[i], "")[1]
    if (nzchar(own)) own else paste(curves[[i]]$from, "to", curves[[i]]$to)
  }, "")
  if (inherits(scene, "picture_scene")) {
    for (curve in curves) draw_lines(scene, curve$path, "white", 2.2 * width)
  }
  for (i in each) scene <- draw_lines(scene, curves[[i]]$path, colours[i], width, name = name[i])
  if (points) for (i in each) {
    own <- curves[[i]]$points
    scene <- draw_points(scene, own, colours[i], 0.28 * width, "white",
                         name = paste(name[i], own$point))
  }
  scene
}

# The colour of each curve, and what the legend says of them: colours named by type, or by curve
# where the user chose them.
curve_key <- function(curves, colour, ridge = "#C8102E", valley = "#2350C8", plane = "#202020") {
  if (!is.null(colour)) {
    colours <- rep_len(colour, length(curves))
    return(list(colours = colours,
                names = stats::setNames(colours, names(curves))[!is.null(names(curves))]))
  }
  of_type <- c(ridge = ridge, valley = valley, plane = plane)
  type <- vapply(curves, function(curve) curve$type, "", USE.NAMES = FALSE)
  list(colours = unname(of_type[type]), names = of_type[names(of_type) %in% type])
}

# In two halves, whose outer sides are put on the surface: a wide band would stand off it.
draw_curve_band <- function(scene, curve, mesh, colour) {
  sides <- band_sides(curve, mesh)
  n <- nrow(sides$left)
  if (n < 2) return(scene)
  middle <- (sides$left + sides$right) / 2
  xyz <- rbind(sides$left, sides$right)
  outer <- columns_of(surface_points(mesh, xyz))[, 1:3]
  scene <- draw_band(scene, outer[seq_len(n), ], middle, colour)
  draw_band(scene, middle, outer[n + seq_len(n), ], colour)
}

# The two sides of the band along the path: `multiple` standard errors across it, along the surface.
band_sides <- function(curve, mesh, multiple = 2) {
  xyz <- point_matrix(curve$path)
  se <- se_along_path(curve)
  keep <- is.finite(se)
  # Tangents by central differences, zero where neighbours coincide.
  n <- nrow(xyz)
  tangent <- xyz[c(2:n, n), , drop = FALSE] - xyz[c(1, 1:(n - 1)), , drop = FALSE]
  across <- cross_rows(t(path_normals(mesh, curve$path)), tangent)
  shift <- multiple * se * across / row_lengths(across)
  keep <- keep & is.finite(rowSums(shift))
  list(left = (xyz + shift)[keep, , drop = FALSE], right = (xyz - shift)[keep, , drop = FALSE])
}

# The standard error at every place of the path, linear between the curve's points.
se_along_path <- function(curve) {
  known <- is.finite(curve$points$se)
  if (sum(known) < 2) return(rep(NA_real_, nrow(curve$path)))
  stats::approx(curve$points$s[known], curve$points$se[known], curve$path$s, rule = 2)$y
}

check_curves <- function(curves) {
  if (is.list(curves) && !is.object(curves) && !length(curves)) return(curves)
  check_list(curves, "curve", "curves", "ridge_curve()")
}
