#' Settings of the search for a reference path
#'
#' All tuning constants of [reference_path()]. Numbers have no unit, but for angles.
#'
#' @template setting-names
#' @param reach Greatest distance of a cut from the straight line between the landmarks, as a share
#'   of that line's length (the paper: 1/2). `Inf`: no limit.
#' @param longest Greatest length of a cut, as a multiple of the shortest. `Inf`: no limit.
#' @param spacing Greatest distance between the places along a cut at which strength is taken, as a
#'   share of `radius`.
#' @param angles Number of angles of the coarse grid over a half turn.
#' @param refined Number of angles between the neighbours of each local optimum.
#' @param tie Relative difference from the best criterion below which local optima count as equal;
#'   the shortest of these cuts is taken. Curvature has an error of some per cent, and planes that
#'   nearly touch the surface give ragged cuts.
#' @param rival Relative difference from the best criterion below which another optimum is a rival.
#'   A rival gives a warning.
#' @param distinct Least distance of a rival from the path at some place, as a share of the path's
#'   length.
#' @param order Order of the curvature fits, as in [curvature()]. [ridge_curve()] uses the `order`
#'   of its own settings.
#' @param limited Number of angles of a curve whose planes a scheme limits (`angle_limit`, see
#'   [curve_scheme()]).
#' @return List of class `path_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @templateVar where section 3.1
#' @template paper
#' @examples
#' path_settings(longest = 1.5)
#' @export
path_settings <- function(..., reach = 0.5, longest = 1.25, spacing = 0.25, angles = 60,
                          refined = 21, tie = 0.002, rival = 0.05, distinct = 0.05,
                          order = "adaptive", limited = 61) {
  new_settings("path_settings", check_path_settings, list(...))
}

check_path_settings <- function(settings) {
  check_reach(settings$reach)
  if (!identical(settings$longest, Inf)) check_number(settings$longest, "longest", lower = 1)
  for (name in c("angles", "refined", "limited")) check_count(settings[[name]], name)
  for (name in c("spacing", "tie", "rival", "distinct")) {
    check_number(settings[[name]], name, lower = 0)
  }
  settings$order <- check_order(settings$order)
  settings
}

#' @export
print.path_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<path_settings> of reference_path()")
}
