# Where a quantity known at points of a surface, or of a curve on it, is greatest, finer than
# between its points.

#' The strongest peak of a field near a place
#'
#' Points that no other within `apart` exceeds are tried from the strongest on; each is settled by
#' local fits, so that the peak does not depend on which points there are, nor on where the search
#' began.
#'
#' @param field List: `at` (n x 3), `value` (n), `dimensions` (2: points of a surface, 1: of a
#'   curve), `normal` (n x 3; NULL: the points' own main plane or line is taken, which fails in a
#'   deep cup).
#' @param start The place, and how far from it (`reach`) the peak may lie.
#' @param apart Distance within which only the greatest point is tried.
#' @param width Half width of the local fits.
#' @param least Value that a peak must exceed.
#' @return List `at` (a place on the fitted field, near the surface), `value`; NULL where there is
#'   no peak.
#' @noRd
strongest_peak <- function(field, start, reach, apart, width, least) {
  gap <- row_lengths(field$at - rep(start, each = nrow(field$at)))
  tried <- which(gap <= reach & field$value > least)
  is_greatest <- function(row) {
    near <- row_lengths(field$at - rep(field$at[row, ], each = nrow(field$at))) <= apart
    all(field$value[near] <= field$value[row])
  }
  tried <- tried[vapply(tried, is_greatest, NA)]
  for (row in tried[order(-field$value[tried])]) {
    peak <- settled_peak(field, field$at[row, ], width)
    if (!is.null(peak) && peak$value > least &&
        sqrt(sum((peak$at - start)^2)) <= reach) return(peak)
  }
  NULL
}

#' The place where the local fits about it have their peak
#'
#' @return As [strongest_peak()]; NULL where the fits lead nowhere.
#' @noRd
settled_peak <- function(field, at, width) {
  settled_place(field, at, width, function(fit, at, longest) {
    # Newton's step to the peak, or a step uphill where the fit has none
    if (fit$peaked) -solve(fit$hessian, fit$gradient) else
      fit$gradient / max(sqrt(sum(fit$gradient^2)), .Machine$double.xmin) * longest
  })
}

#' The place at which steps by local fits end
#'
#' Steps that turn back are halved: the place is then where the fits' slope changes its sign.
#'
#' @param step Function of a fit, a place and the longest step: the step in the fit's frame, or NULL
#'   where there is none.
#' @param longest Longest step, as a share of `width`.
#' @param tolerance Step at which to stop, as a share of `width`.
#' @param steps Most steps.
#' @return List `at`, `value`; NULL where the steps lead nowhere or do not settle.
#' @noRd
settled_place <- function(field, at, width, step, longest = 0.3, tolerance = 1e-6, steps = 200) {
  width <- fit_width(field, at, width)
  longest <- longest * width
  before <- numeric(3)
  for (i in seq_len(steps)) {
    fit <- local_fit(field, at, width)
    move <- if (!is.null(fit)) step(fit, at, longest)
    if (is.null(move)) return(NULL)
    length <- sqrt(sum(move^2))
    move <- if (length > longest) move * longest / length else move
    ahead <- drop(fit$frame %*% c(move, fit$offset(move)))
    if (sum(ahead * before) < 0) longest <- longest / 2
    at <- at + ahead
    before <- ahead
    if (sqrt(sum(move^2)) < tolerance * width) return(list(at = at, value = fit$value))
  }
  NULL
}

#' Half width of local fits: the one asked for, or wider where the points are far apart
#' @noRd
fit_width <- function(field, at, width, slack = 1.3) {
  gap <- row_lengths(field$at - rep(at, each = nrow(field$at)))
  max(width, slack * sort(gap)[min(c(curve = 5, surface = 13)[[field$dimensions]], length(gap))])
}

#' Quadratic fits of a field, and of the points' offsets from a plane (or line), about a place
#'
#' Weights fall smoothly to 0 at `width`, so that the fit changes smoothly with the place.
#'
#' @return List: `frame` (3 x 3, the columns across the plane last), `value`, `gradient`, `hessian`,
#'   `peaked` (the Hessian is negative), `offset` (function of a step in the plane: offsets across
#'   it). NULL where there are too few points.
#' @noRd
local_fit <- function(field, at, width) {
  apart <- field$at - rep(at, each = nrow(field$at))
  weight <- pmax(1 - rowSums(apart^2) / width^2, 0)^2
  near <- which(weight > 0)
  d <- field$dimensions
  if (length(near) <= (d + 1) * (d + 2) / 2) return(NULL)
  apart <- apart[near, , drop = FALSE]
  weight <- weight[near]
  frame <- if (is.null(field$normal)) {
    eigen(crossprod(apart * weight, apart), symmetric = TRUE)$vectors
  } else {
    qr.Q(qr(cbind(colSums(weight * field$normal[near, , drop = FALSE]), diag(3))))[, 3:1]
  }
  local <- apart %*% frame
  fit <- stats::lm.wfit(quadratic_terms(local[, 1:d, drop = FALSE]),
                        cbind(field$value[near], local[, -(1:d), drop = FALSE]),
                        weight)
  terms <- fit$coefficients
  if (anyNA(terms)) return(NULL)
  hessian <- if (d == 1) matrix(2 * terms[3, 1]) else
    matrix(terms[c(4, 5, 5, 6), 1] * c(2, 1, 1, 2), 2)
  list(frame = frame, value = terms[1, 1], gradient = terms[1 + seq_len(d), 1], hessian = hessian,
       peaked = all(eigen(hessian, symmetric = TRUE, only.values = TRUE)$values < 0),
       offset = function(move) drop(quadratic_terms(matrix(move, 1)) %*% terms[, -1, drop = FALSE]))
}

#' 1, u, u^2 or 1, u, v, u^2, uv, v^2
#' @noRd
quadratic_terms <- function(x) {
  if (ncol(x) == 1) return(cbind(1, x, x^2))
  cbind(1, x, x[, 1]^2, x[, 1] * x[, 2], x[, 2]^2)
}
