# Plane cuts between two landmarks (the paper's Fig. 2).

#' The paths that planes through two landmarks cut from the surface
#'
#' @param surface `colour` of [plot.specimen()]; the arguments are described there.
#' @return The paths, invisibly: a list with a `mesh_path` for each angle at which there is one. For
#'   a widget its scene.
#' @noRd
draw_cuts <- function(specimen, from, to, angles = c(-pi / 6, 0, pi / 6), surface = "plain",
                      colours = grDevices::hcl.colors(length(angles), "Dark 3"), width = 2.5,
                      engine, ...) {
  check_given()
  check_ends(from = from, to = to)
  angles <- check_numbers(angles, "angles")
  colours <- check_colour(colours, "colours")
  width <- check_number(width, "width", lower = 0)
  engine <- check_engine(engine)
  paths <- lapply(angles, function(angle) {
    tryCatch(plane_path(specimen, from, to, angle), crestline_path_error = identity)
  })
  paths <- arrived_cuts(paths, specimen$id)
  colours <- rep_len(colours, length(angles))[match(vapply(paths, attr, 0, "angle"), angles)]
  scene <- plot(specimen, surface, engine = engine, landmarks = FALSE, ...)
  key <- vapply(paths, function(path) {
    sprintf("%.0f degrees, length %.3g", attr(path, "angle") * 180 / pi, attr(path, "length"))
  }, "")
  scene <- in_layer(scene, "cuts")
  for (i in seq_along(paths)) scene <- draw_lines(scene, paths[[i]], colours[i], width,
                                                  halo = "white", name = key[i])
  scene <- draw_points(in_layer(scene, "landmarks"),
                       specimen$landmarks[c(from, to), , drop = FALSE], "black", 1.2,
                       halo = "white", labels = c(from, to))
  scene <- draw_key(scene, stats::setNames(colours, key), width = width)
  if (inherits(scene, "widget_scene")) scene else invisible(paths)
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
