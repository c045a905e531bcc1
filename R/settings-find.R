#' Settings of finding landmarks
#'
#' All tuning constants of [find_landmarks()] in one place. Lengths are those of a face in mm and go
#' with the size of the template: for another object they are multiplied by its template's `unit`,
#' see [landmark_template()].
#'
#' @param ... Settings to change, by name.
#'   * `cluster`: edge of the cells in which a scan's vertices are represented by one; `coarse`: of
#'     those for the first fits;
#'   * `bend`, `feature`: radii of the curvature that anchors are found by, and that points are
#'     matched by;
#'   * `cap`: least size of both curvatures at an anchor (1 / length); `apart`: least distance of
#'     two anchors; `anchors`: how many of a scan are tried, of caps and of cups; `own`: how many of
#'     the template; `turns`: in how many turns about their normal;
#'   * `reach`: of the rigid fits, at their first and last steps; `steps`: their number; `kept`:
#'     share of matches, nearest first, that count; `followed`, `refined`: how many of the best
#'     starts are gone on with, on thin clouds and on whole ones; `tight`, `loose`: bounds of the
#'     scale at first and where the fit is poor;
#'   * `cosine`: least cosine of the angle between normals of points that are matched;
#'   * `saturation`: distance from which on a point of the template counts as not matched in the
#'     score; `poor`: score above which other ways are tried and confidence is lowered; `refuse`:
#'     above which there is none;
#'   * `left_over`: weight of the share of the scan that has no like in the template, against the
#'     share of the template without one in the scan, when poses are compared;
#'   * `kernel_length`, `kernel_sd`: lengths and standard deviations of the Gaussian processes that
#'     make the displacement; `affine`: standard deviation of its affine part; `uneven`: that of the
#'     left-right antisymmetric part, as a share; `rank`: number of functions;
#'   * `weight`: of curvature against place, in a match (length squared); `warp_reach`: reach of
#'     matches at the first and last steps of `warp_steps`; `error`: standard deviation of a match;
#'     `robust`: scale of the Cauchy weights; `along`: weight of a match's part along the surface;
#'     `points`: number of the template's points; `thin`: of those for the first fits;
#'   * `moved`: distance between the answers with and without curvature at which confidence is a
#'     half; `off`: the same of the distance between template and scan about a landmark; `vague`:
#'     the same of the standard deviation that what the scan lacks adds; `near`: radius of what is
#'     about a landmark, at least so many points of the template as `about`; `lost`: share of points
#'     without a match about a landmark at which its place is missing; `slip`: distance along the
#'     surface, in units of `cluster`, from which on a match is none;
#'   * `low`: confidence below which a found landmark is doubted; `wrong`: share of the found
#'     landmarks that are doubted from which on the answer as a whole is. On 42 faces that are found
#'     right it is at most 0.47, on two that are found wrong and on objects that are no face at
#'     least 0.68;
#'   * `fewest`: matches without which the template is not bent.
#' @return List of class `find_settings`.
#' @section Errors: of class `crestline_error`, for a name that is no setting or a value that is not
#'   numeric.
#' @template glossary
#' @examples
#' find_settings(turns = 24)
#' @export
find_settings <- function(...) {
  settings <- list(cluster = 2.5, coarse = 5, bend = 12, feature = 8, cap = 0.03, apart = 12,
                   anchors = 8, own = 2,
                   turns = 12, reach = c(40, 10), steps = 6, kept = 0.7, followed = 40,
                   refined = 6, tight = c(0.95, 1.05), loose = c(0.75, 1.3),
                   cosine = 0.5, saturation = 5, poor = 0.55, refuse = 0.76, left_over = 0.5,
                   kernel_length = c(60, 30, 15), kernel_sd = c(4, 2.5, 1.5), affine = 5,
                   uneven = 0.3, rank = 220,
                   weight = 80, warp_reach = c(15, 6), warp_steps = 15, error = 3, robust = 1.5,
                   along = 0.1,
                   points = 2500, thin = 200,
                   moved = 2, off = 2.5, vague = 0.9, near = 8, about = 8, lost = 0.4, slip = 2,
                   low = 0.5, wrong = 0.6, fewest = 30)
  change <- list(...)
  unknown <- setdiff(names(change), names(settings))
  if (length(unknown) || (length(change) && is.null(names(change)))) {
    crestline_abort(sprintf("there is no setting %s.",
                            paste0("\"", unknown, "\"", collapse = ", ")),
                    paste0("Settings are: ", paste(names(settings), collapse = ", "), "."),
                    stage = "arguments")
  }
  may_be_none <- c("cap", "affine", "uneven", "weight", "along", "left_over", "lost", "cosine",
                   "low")
  for (name in names(change)) {
    value <- change[[name]]
    size <- length(settings[[name]])
    low <- if (name %in% may_be_none) 0 else .Machine$double.xmin
    if (!is.numeric(value) || length(value) != size || any(!is.finite(value) | value < low)) {
      crestline_abort(sprintf("`%s` is %s.", name, describe_value(value)),
                      sprintf("Give %d finite number%s %s 0.", size, if (size > 1) "s" else "",
                              if (low > 0) "above" else "of at least"), stage = "arguments")
    }
  }
  settings[names(change)] <- change
  structure(settings, class = "find_settings")
}

#' @export
print.find_settings <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat("<find_settings> of find_landmarks()\n")
    value <- vapply(x, function(v) paste(format(v, trim = TRUE), collapse = " to "), "")
    cat(strwrap(paste(names(x), value, sep = " = ", collapse = ", "), indent = 2, exdent = 2),
        sep = "\n")
    invisible(x)
  })
}

#' The settings' lengths for a template of another size
#' @noRd
scaled_settings <- function(settings, unit) {
  lengths <- c("cluster", "coarse", "bend", "feature", "apart", "reach", "saturation",
               "kernel_length", "kernel_sd", "affine",
               "warp_reach", "error", "robust", "moved", "off", "vague", "near")
  settings[lengths] <- lapply(settings[lengths], `*`, unit)
  settings$cap <- settings$cap / unit
  settings$weight <- settings$weight * unit^2
  settings
}
