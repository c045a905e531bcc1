# What a scanner and an observer do to a surface that is known.

#' Settings of a simulated scan
#'
#' @param noise Standard deviation of the noise of the vertices along the normal, in the unit of the
#'   template (0.1: a good stereo or laser scanner, in mm).
#' @param noise_range Range of the correlation of the noise, in the unit of the template. 0:
#'   independent noise at each vertex.
#' @param remesh TRUE: every specimen has its own vertices and triangles, in random order, so that
#'   vertices of two specimens do not correspond. FALSE: all have those of the template.
#' @param edge Edge length of the new mesh, in the unit of the template. `NULL`: the mean edge
#'   length of the template.
#' @param edge_sd Standard deviation of the logarithm of the edge length between specimens.
#' @param rounds Number of rounds of remeshing. More rounds make edges more even; each takes a third
#'   of a second on a face.
#' @param crease Angle between triangles, in degrees, above which remeshing keeps the edge between
#'   them.
#' @param holes Number of holes in every specimen.
#' @param hole_radius Radius of the holes, in the unit of the template. The distance between a hole
#'   and a landmark is at least this radius.
#' @param landmark_error Standard deviation of the observer's landmarks, in each direction along the
#'   surface, in the unit of the template.
#' @param turn,shift Standard deviations of the pose of each specimen: of the angle about a random
#'   axis, in radians, and of the translation in every co-ordinate, in the unit of the template.
#' @param ... Nothing: an unknown name is an error.
#' @return A list of these settings, of class `scan_settings`.
#' @section Errors: of class `crestline_error`: a value is out of its range.
#' @template glossary
#' @template experimental
#' @seealso [simulate_faces()]
#' @examples
#' str(scan_settings(noise = 0, remesh = FALSE))
#' @export
scan_settings <- function(noise = 0.1, noise_range = 0, remesh = TRUE, edge = NULL, edge_sd = 0.05,
                          rounds = 1L, crease = 30, holes = 0L, hole_radius = 5, landmark_error = 0,
                          turn = 0, shift = 0, ...) {
  new_settings("scan_settings", check_scan_settings, list(...))
}

check_scan_settings <- function(settings) {
  check_flag(settings$remesh, "remesh")
  for (name in c("noise", "noise_range", "edge_sd", "landmark_error", "turn", "shift")) {
    settings[[name]] <- check_number(settings[[name]], name, 0)
  }
  if (!is.null(settings$edge)) settings$edge <- check_number(settings$edge, "edge", 0, open = TRUE)
  settings$rounds <- check_count(settings$rounds, "rounds")
  settings$crease <- check_number(settings$crease, "crease", 0, 180)
  settings$holes <- check_count(settings$holes, "holes", lower = 0)
  settings$hole_radius <- check_number(settings$hole_radius, "hole_radius", 0, open = TRUE)
  settings
}

#' A mesh with its vertices moved along their normals
#' @param places n x 3: where in the template the vertices are; correlated noise is a field there.
#' @noRd
with_noise <- function(mesh, places, scan) {
  n <- ncol(mesh$vb)
  smooth <- scan$noise_range > 0
  height <- if (smooth) random_field(scan$noise_range, scan$noise, 1)(places) else
    stats::rnorm(n, 0, scan$noise)
  if (scan$noise == 0) return(mesh)
  normal <- vertex_normals(mesh)[1:3, ]
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] + normal * rep(height, each = 3)
  mesh
}

#' Which triangles of a mesh are left once round holes are cut
#' @param landmarks k x 3, kept clear of.
#' @noRd
outside_holes <- function(mesh, landmarks, scan) {
  xyz <- t(mesh$vb[1:3, ])
  kept <- rep(TRUE, nrow(xyz))
  if (scan$holes == 0) return(rep(TRUE, ncol(mesh$it)))
  within <- function(at, radius) row_lengths(sweep(xyz, 2, at)) < radius
  room <- kept
  for (i in seq_len(nrow(landmarks))) room <- room & !within(landmarks[i, ], 2 * scan$hole_radius)
  if (!any(room)) {
    crestline_abort("there is no room for a hole between the landmarks.",
                    "Give a smaller `hole_radius`.",
                    stage = "simulation")
  }
  for (centre in which(room)[sample.int(sum(room), scan$holes, replace = TRUE)]) {
    kept[within(xyz[centre, ], scan$hole_radius)] <- FALSE
  }
  colSums(matrix(kept[mesh$it], 3)) == 3
}
