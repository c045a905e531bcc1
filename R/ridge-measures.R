# What is measured along a curve, its length and its strength, with standard errors; and how far its
# ends stand beside it.

#' A fit with the strength along its line, and standard errors of that and of the curve's length
#'
#' @param fit With its `line`, standard errors among it.
#' @param known List: `noise` as of [moment_noise()], `slope` as of [line_slope()], `bias` as of
#'   [line_bias()].
#' @noRd
with_measures <- function(scan, fit, known, settings) {
  line <- fit$line
  strength <- strength_along(fit$surface, line, known$slope)
  fit$line$strength <- strength$value
  fit$line$strength_se <- sqrt(noise_variance(strength$rows, known$noise))
  fit$strength_se <- sqrt(noise_variance(t(colMeans(strength$rows)), known$noise))
  if (!fit$found) return(fit)
  rate <- length_rate(scan, fit$path, line$s / line$s[length(line$s)], goes_round(fit$surface))
  moved <- crossprod(rate, known$slope)
  fit$length_se <- sqrt(settings$inflation^2 * noise_variance(moved, known$noise) +
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

#' How far the ends of a path lie beside the ridge that ends on them
#'
#' The curve is held at its landmarks: where its ridge runs beside one, it has a hook there. The
#' ridge is looked for across itself, by the principal directions about the landmark, as the path
#' may have the hook in it.
#'
#' @param window As of [ridge_window()].
#' @param job As of [curve_job()].
#' @return Two lengths, NA where no ridge is in the window at that end, or none that is not faint,
#'   and of closed paths.
#' @noRd
end_offsets <- function(scan, window, job) {
  path <- window$reference
  if (is_closed(path)) return(c(NA_real_, NA_real_))
  half <- min(job$width, job$settings$window * job$radius)
  ends <- columns_of(path, c("x", "y", "z"))[c(1, nrow(path)), ]
  vertex <- window$coordinates$vertex[window$strengths$rows]
  at <- t(scan$vb[1:3, vertex, drop = FALSE])
  vapply(1:2, function(i) {
    step <- at - rep(ends[i, ], each = nrow(at))
    near <- which(row_lengths(step) <= half + job$radius)
    if (length(near) < 2) return(NA_real_)
    nearest_crest(step[near, , drop = FALSE], job$source(vertex[near]), job, half)
  }, 0)
}

#' Distance of a place from the nearest crest, across that
#'
#' @param step Vertices about the place, as seen from it (n x 3); `curved`: their curvature.
#' @param reach Greatest distance that is looked at, in the unit of the mesh.
#' @param along Half width of the strip of vertices that count, along the crest, in radii.
#' @param width Half width of the local means across it, in radii.
#' @param places Number of distances that are tried, to either side.
#' @return NA where there is no crest within `reach` that is not faint.
#' @noRd
nearest_crest <- function(step, curved, job, reach, along = 1, width = 0.5, places = 50) {
  radius <- job$radius
  value <- strength_at(curved, job$type)
  own <- which(value > 0)
  if (length(own) < 2) return(NA_real_)
  across <- if (job$type == "ridge") curved$direction2 else curved$direction1
  weight <- value[own] * pmax(1 - (row_lengths(step)[own] / (along * radius))^2, 0)
  spread <- crossprod(sqrt(weight) * across[own, , drop = FALSE])
  axis <- eigen(spread, symmetric = TRUE)$vectors[, 1]
  t <- drop(step %*% axis)
  normal <- colMeans(curved$normal[own, , drop = FALSE] * weight)
  beside <- drop(step %*% unit_vector(cross_product(axis, normal)))
  strip <- which(abs(beside) < along * radius & !is.na(value))
  tried <- reach * seq(-places, places) / places
  square <- (outer(tried, t[strip], `-`) / (width * radius))^2
  kernel <- pmax(1 - square, 0)^2 *
    rep(1 - (beside[strip] / (along * radius))^2, each = length(tried))
  mean <- drop(kernel %*% value[strip]) / rowSums(kernel)
  inner <- seq(2, length(tried) - 1)
  top <- inner[which(mean[inner] > mean[inner - 1] & mean[inner] >= mean[inner + 1] &
                       mean[inner] * radius > job$settings$faint)]
  if (length(top)) min(abs(tried[top])) else NA_real_
}

#' What is to be said of a row that gave a curve: its width is cut, its ends stand beside their
#' ridge
#'
#' @param curve A `curve`.
#' @param free Two logical values: ends that need not stand on a ridge.
#' @return Text, NA where there is nothing.
#' @noRd
curve_remark <- function(curve, free = c(FALSE, FALSE)) {
  hooked <- which(curve$beside > curve$settings$beside * curve$radius & !free)
  said <- c(
    cut_width_words(curve$type, curve$width, curve$radius, curve$settings$window),
    sprintf("landmark %s stands %.2g beside the %s, which makes a hook",
            c(curve$from, curve$to)[hooked], curve$beside[hooked], curve$type)
  )
  said <- said[!is.na(said)]
  if (length(said)) paste(said, collapse = "; ") else NA_character_
}

#' That only so much of a width is used, NA where all of it is
#' @param window Greatest half width, in radii.
#' @noRd
cut_width_words <- function(type, width, radius, window) {
  if (type == "plane" || width <= window * radius * (1 + 1e-9)) return(NA_character_)
  sprintf("only %.3g of its width is used, %.3g radii", window * radius, window)
}
