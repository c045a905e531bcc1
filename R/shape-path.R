# What the curves and patches of a shape do with paths: shortest cuts near the surface's normal,
# joins.

#' Best plane cut among angles about the surface's normal
#'
#' @param surface As of [walkable()].
#' @param ends As of [path_ends()].
#' @param limit Greatest angle in radians between the plane and that of the mean of the normals at
#'   the ends.
#' @param angles Number of angles.
#' @param reach Cuts stay within this share of the ends' distance from the straight line between
#'   them.
#' @param rate Function of measured cuts that are at most `longest` times as long as the shortest:
#'   the greatest counts.
#' @return `mesh_path`; error of class `crestline_path_error` where no cut joins the ends.
#' @noRd
limited_cut <- function(surface, ends, limit, angles, reach,
                        rate = function(axis, found) -found$length, longest = 1) {
  axis <- cut_axis(surface, ends)
  found <- measure_cuts(surface, ends, axis, seq(-limit, limit, length.out = angles),
                        rep(0L, angles), reach)
  if (all(is.na(found$length))) abort_cut(found$end[ceiling(angles / 2)], ends, surface$id)
  allowed <- found[which(found$length <= longest * min(found$length, na.rm = TRUE)), ]
  best <- allowed[which.max(rate(axis, allowed)), ]
  cut_path(surface, ends, axis, best$angle, 0, reach)
}

check_column <- function(column_angle, column_angles, column_reach) {
  list(angle = check_number(column_angle, "column_angle", 0, pi / 2),
       angles = check_count(column_angles, "column_angles", upper = 10000),
       reach = check_number(column_reach, "column_reach", 0, open = TRUE))
}

#' A landmark on the mesh, NULL where it is missing
#' @noRd
known_point <- function(specimen, name) {
  tryCatch(landmark_point(specimen, name)[mesh_columns], crestline_error = function(e) NULL)
}
