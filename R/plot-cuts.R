# Plane cuts between two landmarks (the paper's Fig. 2).

#' Plot plane cuts between two landmarks
#'
#' The paths that planes through both landmarks cut from the surface, one a plane: Fig. 2 of the
#' paper, from which [reference_path()] chooses.
#'
#' @param specimen A `specimen`.
#' @param from,to Names of two of its landmarks.
#' @param angles Angles of the planes about the axis between them, in radians, as in [plane_path()].
#' @param surface What the colours of the surface show, as `colour` of [plot.specimen()].
#' @param colour Colours of the cuts, one each.
#' @param width Line width.
#' @param engine,... As in [plot.specimen()], which the rest is passed to.
#' @return The paths, invisibly: a list with a `mesh_path` for each angle at which there is one.
#' @section Warnings: of class `crestline_warning`, when a cut comes to a border of the mesh and is
#'   left out; when all do, that is an error.
#' @references Vittert, Bowman and Katina (2019), "the paper" (see [crestline-package]), Fig. 2.
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' mouth <- face$landmarks[c("chL", "chR", "sn"), ]
#' plot_cuts(face, "chL", "chR", around = mouth, engine = "picture")
#' }
#' @export
plot_cuts <- function(specimen, from, to, angles = c(-pi / 6, 0, pi / 6), surface = "plain",
                      colour = grDevices::hcl.colors(length(angles), "Dark 3"), width = 2.5,
                      engine = if (interactive()) "rgl" else "picture", ...) {
  check_given()
  check_ends(from = from, to = to)
  angles <- check_numbers(angles, "angles")
  colour <- check_colour(colour, "colour")
  width <- check_number(width, "width", lower = 0)
  engine <- check_choice(engine, c("rgl", "picture"), "engine")
  surface <- check_choice(surface, surface_choices, "surface")
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  paths <- lapply(angles, function(angle) {
    tryCatch(plane_path(specimen, from, to, angle), crestline_path_error = identity)
  })
  paths <- arrived_cuts(paths, specimen$id)
  colour <- rep_len(colour, length(angles))[match(vapply(paths, attr, 0, "angle"), angles)]
  scene <- plot(specimen, surface, engine = engine, landmarks = FALSE, ...)
  for (i in seq_along(paths)) scene <- draw_lines(scene, paths[[i]], colour[i], width,
                                                  halo = "white")
  scene <- draw_points(scene, specimen$landmarks[c(from, to), , drop = FALSE], "black", 1.2,
                       halo = "white", labels = c(from, to))
  if (engine == "picture") {
    key <- vapply(paths, function(path) {
      sprintf("%.0f degrees, length %.3g", attr(path, "angle") * 180 / pi, attr(path, "length"))
    }, "")
    on_scene(scene, graphics::legend("bottomleft", key, col = colour, lwd = width, bty = "n",
                                     cex = 0.8))
  }
  invisible(paths)
}

# The cuts that arrived at the second landmark; a warning says why others did not, an error when
# none did.
arrived_cuts <- function(paths, id) {
  failed <- vapply(paths, inherits, NA, "error")
  if (all(failed)) rlang::cnd_signal(paths[[1]])
  if (any(failed)) {
    crestline_warn(sprintf("%d of %d cuts are left out: %s", sum(failed), length(paths),
                           paths[failed][[1]]$problem),
                   "Choose other angles.", stage = "path", id = id)
  }
  paths[!failed]
}
