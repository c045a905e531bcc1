# Plane cuts between two landmarks (the paper's Fig. 2).

#' Plot plane cuts between two landmarks
#'
#' The paths that planes through both landmarks cut from the surface, one a plane: Fig. 2 of the paper, from which
#' [reference_path()] chooses.
#'
#' @param specimen A `specimen`.
#' @param from,to Names of two of its landmarks.
#' @param angles Angles of the planes about the axis between them, in radians, as in [plane_path()].
#' @param surface What the colours of the surface show, as `colour` of [plot.specimen()].
#' @param colour Colours of the cuts, one each.
#' @param width Line width.
#' @param engine,... As in [plot.specimen()], which the rest is passed to.
#' @return The paths, invisibly: a list with a `path` for each angle.
#' @references The paper, Fig. 2; see [crestline-package].
#' @export
plot_cuts <- function(specimen, from, to, angles = c(-pi / 6, 0, pi / 6), surface = "plain",
                      colour = grDevices::hcl.colors(length(angles), "Dark 3"), width = 2.5,
                      engine = if (interactive()) "rgl" else "picture", ...) {
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  paths <- lapply(angles, function(angle) plane_path(specimen$mesh, specimen$landmarks[from, ], specimen$landmarks[to, ], angle))
  scene <- plot(specimen, surface, engine = engine, landmarks = FALSE, ...)
  for (i in seq_along(paths)) scene <- draw_lines(scene, paths[[i]], colour[i], width, halo = "white")
  draw_points(scene, specimen$landmarks[c(from, to), , drop = FALSE], "black", 1.2, halo = "white", labels = c(from, to))
  if (engine == "picture") {
    lengths <- vapply(paths, attr, numeric(1), "length")
    graphics::legend("topleft", sprintf("%.0f degrees, length %.1f", angles * 180 / pi, lengths),
                     col = colour, lwd = width, bty = "n", cex = 0.8)
  }
  invisible(paths)
}
