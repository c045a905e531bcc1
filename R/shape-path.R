# What the curves and patches of a shape do with paths: shortest cuts near the surface's normal,
# joins.

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
