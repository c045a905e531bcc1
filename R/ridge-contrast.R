# How much a curve's strength stands out from what lies beside it.

#' Contrast of a curve: mean strength along it over mean strength beside it
#'
#' Beside it are the vertices of its window that are farther than `settings$core` radii from the
#' ridge line.
#'
#' @param curve A `curve`.
#' @return One number without unit: 1 where the curve is no stronger than its surroundings, Inf
#'   where these have no such curvature; NA for plane curves and those that were not found.
#' @noRd
curve_contrast <- function(curve) {
  if (is.null(curve$line) || all(is.na(curve$points$d))) return(NA_real_)
  window <- curve$coordinates[curve$surface$rows, ]
  offset <- stats::approx(curve$line$s, curve$line$alpha, window$s, rule = 2)$y
  beside <- abs(window$d - offset) > curve$settings$core * curve$radius
  if (any(beside)) curve$strength / mean(curve$surface$strength[beside]) else NA_real_
}
