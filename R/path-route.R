# Where a curve may run, and where along it curvature counts.

#' Where a curve may run
#'
#' The limits of one curve of [ridge_curve()]. In a scheme each curve has columns for them, see
#' [curve_scheme()].
#'
#' @template setting-names
#' @param keep_away Region where curvature is ignored, as of [keep_away()] or [keep_side()], or a
#'   list of regions. `NULL`: none.
#' @param path,via As in [reference_path()].
#' @param trust Two shares of the path's length, 0 to 1. Curvature is used between them only. From
#'   there to the landmarks curvature is ignored, and the path is the shortest cut. Use it if a
#'   feature fades near a landmark, or if the mesh is crumpled there. For ridges and valleys only.
#' @param reach Greatest distance of the reference path from the straight line between the
#'   landmarks, as a share of that line's length (the paper: 1/2). `Inf`: no limit.
#' @return List of class `curve_route`.
#' @section Errors: of class `crestline_error`: a name is not that of a field, or a value is out of
#'   range.
#' @template glossary
#' @templateVar where section 3.1
#' @template paper
#' @seealso [ridge_curve()], [path_settings()]
#' @examples
#' curve_route(reach = 1, trust = c(0.1, 1))
#' @export
curve_route <- function(..., keep_away = NULL, path = "plane", via = NULL, trust = c(0, 1),
                        reach = 0.5) {
  new_settings("curve_route", check_curve_route, list(...))
}

check_curve_route <- function(route) {
  route[c("path", "via")] <- check_route(route$path, route$via, "ridge")
  route["keep_away"] <- list(check_regions(route$keep_away))
  route$trust <- check_trusted(route$trust)
  route$reach <- check_reach(route$reach)
  route
}

#' @export
print.curve_route <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<curve_route> of ridge_curve()")
}
