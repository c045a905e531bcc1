# How a shape is measured, beside its curves' own settings.

#' Settings of fit_shape() beside those of the curves
#'
#' How curves are cut off, holes bridged, and columns of patches cut. [ridge_settings()] has the
#' constants of the curves themselves.
#'
#' @template setting-names
#' @param cut_scale Multiplies the length at which trimmed curves are cut (no unit). Use one value
#'   below 1 for all specimens if some scans are too short. It is reduced for a specimen with a
#'   shorter curve.
#' @param bridge Greatest size of a hole that is bridged by flat triangles: the diagonal of its
#'   bounding box, as a share of the object's size. Curves and columns cross a bridged hole, and
#'   their points inside it are missing. They run round larger holes. 0: no hole is bridged.
#' @param column_angle Greatest angle in radians between a column's plane and the plane of the mean
#'   surface normal at its ends (pi / 4 in the programs of the paper's authors).
#' @param column_angles Number of planes that are tried for a column (51 in the authors' programs).
#' @param column_reach Greatest distance of a column from the straight line between its ends, as a
#'   share of that line's length (1 in the authors' programs).
#' @return List of class `shape_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @templateVar where section 4
#' @template paper
#' @seealso [fit_shape()], [patch_mesh()], [shape_mesh()]
#' @examples
#' shape_settings(cut_scale = 0.9)
#' @export
shape_settings <- function(..., cut_scale = 1, bridge = 0.2, column_angle = pi / 4,
                           column_angles = 51, column_reach = 1) {
  new_settings("shape_settings", check_shape_settings, list(...))
}

check_shape_settings <- function(settings) {
  check_number(settings$cut_scale, "cut_scale", lower = 0, open = TRUE)
  check_number(settings$bridge, "bridge", 0, 1)
  check_number(settings$column_angle, "column_angle", 0, pi / 2)
  check_count(settings$column_angles, "column_angles", upper = 10000)
  check_number(settings$column_reach, "column_reach", 0, open = TRUE)
  settings
}

#' @export
print.shape_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<shape_settings> of fit_shape()")
}

#' Settings as columns of patches take them
#' @return List: `angle`, `angles`, `reach`, `bridge`.
#' @noRd
column_settings <- function(settings) {
  list(angle = settings$column_angle, angles = settings$column_angles,
       reach = settings$column_reach, bridge = settings$bridge)
}

#' Settings with what a call gives of their columns in the former form
#' @noRd
measuring_with_former <- function(measuring, ...) {
  check_class(measuring, "shape_settings", "measuring", "shape_settings()")
  fields <- c("column_angle", "column_angles", "column_reach")
  check_dots(..., known = fields)
  with_former(list(measuring = measuring), list(measuring = fields), list(...))$measuring
}
