# Whether what the template was laid on is the object at all.

#' How the curvature of the bent template agrees with that of the scan
#'
#' By the bend that leaves curvature out, so that the figure does not speak for itself.
#'
#' @param cloud In the template's frame.
#' @param plain As of [fit_warp()] without curvature.
#' @return Mean of two correlations over the points that have a match: of the mean curvature and of
#'   half the difference of the principal ones, both cut off at the setting `clip`. Where the scan's
#'   varies less than the template's, which it does by half on random bumps that the template was
#'   bent to, each is lowered by the ratio of the standard deviations.
#' @noRd
agreement <- function(template, cloud, plain, settings) {
  on <- which(!is.na(plain$index))
  if (length(on) < settings$fewest) return(0)
  clipped <- function(x) pmax(pmin(x, settings$clip), -settings$clip)
  alike <- vapply(c(1, -1), function(sign) {
    own <- clipped((template$k1 + sign * template$k2) / 2)[on]
    of_scan <- clipped((cloud$k1 + sign * cloud$k2) / 2)[plain$index[on]]
    spread <- c(stats::sd(own), stats::sd(of_scan))
    if (any(spread == 0)) return(0)
    stats::cor(own, of_scan) * min(1, spread[2] / spread[1])
  }, 0)
  mean(alike)
}

#' "face", "perhaps" or "none", by the agreement
#' @param limits Setting `agree`.
#' @noRd
verdict_of <- function(agree, limits) {
  if (agree >= limits[2]) "face" else if (agree >= limits[1]) "perhaps" else "none"
}
