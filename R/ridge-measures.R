# What is measured along a curve, its length and its strength, with standard errors.

#' A fit with the strength along its line, and standard errors of that and of the curve's length
#'
#' @param fit With its `line`, standard errors among it.
#' @param known List: `noise` as of [moment_noise()], `slope` as of [line_slope()], `bias` as of
#'   [line_bias()].
#' @noRd
with_measures <- function(scan, fit, known, settings) {
  line <- fit$line
  strength <- strength_along(fit$surface, line, known$slope)
  covariance <- known$noise$factor * known$noise$matrix
  fit$line$strength <- strength$value
  fit$line$strength_se <- sqrt(linear_variance(strength$rows, covariance))
  fit$strength_se <- sqrt(linear_variance(t(colMeans(strength$rows)), covariance))
  if (!fit$found) return(fit)
  rate <- length_rate(scan, fit$path, line$s / line$s[length(line$s)], goes_round(fit$surface))
  moved <- crossprod(rate, known$slope)
  fit$length_se <- sqrt(settings$inflation^2 * linear_variance(moved, covariance) +
                          sum(rate * known$bias[-c(1, length(known$bias))])^2)
  fit
}

#' Smooth strength at the places of a line
#'
#' Noise moves the surface, and the line on it.
#'
#' @param slope As of [line_slope()].
#' @return List: `value`; `rows`, its derivatives by the moments of the strengths.
#' @noRd
strength_along <- function(surface, line, slope) {
  along <- margin_design(surface$margins$along, line$s / surface$length)
  across <- function(derivative) {
    margin_design(surface$margins$across, line$alpha / surface$width, derivative)
  }
  profile <- tcrossprod(along, surface$coefficients)
  fixed <- mgcv::tensor.prod.model.matrix(list(along, across(0))) %*% chol2inv(surface$factor)
  rise <- rowSums(across(1) * profile) / surface$width
  moves <- apply(slope, 2, with_ends, goes_round(surface))
  list(value = rowSums(across(0) * profile), rows = fixed + rise * moves)
}

#' Derivative of a curve's length by moves of its inner places across it
#'
#' To the left, as offsets are counted. It is minus the geodesic curvature, times the share of the
#' length that goes with a place.
#'
#' @param share Places as shares of the length, the ends among them.
#' @param closed Whether the curve goes round: its ends, at the seam, are no places then.
#' @noRd
length_rate <- function(scan, path, share, closed = FALSE) {
  at <- place_along(scan, path, share * attr(path, "length"))
  xyz <- columns_of(at, c("x", "y", "z"))
  if (closed) xyz[c(1, nrow(xyz)), ] <- xyz[c(nrow(xyz) - 1, 2), ]
  step <- diff(xyz)
  towards <- step / row_lengths(step)
  inner <- seq_len(nrow(step) - 1)
  before <- towards[inner, , drop = FALSE]
  after <- towards[inner + 1, , drop = FALSE]
  normal <- t(path_normals(scan, at))[inner + 1, , drop = FALSE]
  across <- cross_rows(normal, before + after)
  rowSums(across * (before - after)) / row_lengths(across)
}
