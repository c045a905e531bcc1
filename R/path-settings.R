#' Settings of the search for a reference path
#'
#' All tuning constants of [reference_path()] in one place.
#'
#' @param ... Nothing: settings are given by name, and an unknown name is an error.
#' @param reach Cuts stay within this share of the distance between the landmarks
#'   from the straight line between them (the paper: 1/2). `Inf`: anywhere.
#' @param longest Cuts may be this many times as long as the shortest. `Inf`: as long as they are.
#' @param spacing Strength is taken along a cut at places no further apart than this share of
#'   `radius`.
#' @param angles Number of angles of the coarse grid over a half turn.
#' @param refined Number of angles between the neighbours of each local optimum.
#' @param tie Of local optima within this share of the best the shortest cut is taken: curvature is
#'   not known better than to some per cent, and planes that nearly touch the surface gather it on a
#'   ragged way.
#' @param rival Share within which a second optimum is a rival that is warned of.
#' @param distinct A rival runs further than this share of the path's length from it at some place.
#' @param order As in [curvature()], where that is not given; [ridge_curve()] uses the `order` of
#'   its settings.
#' @param limited Number of angles of a curve whose planes a scheme limits (`angle_limit`, see
#'   [curve_scheme()]).
#' @return List of class `path_settings`.
#' @section Errors: of class `crestline_error`, for a name that is no setting or a value out of
#'   range.
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
