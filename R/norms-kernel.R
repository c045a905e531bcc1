# The kernel of a norm: what the neighbours of a point tell of it, and those of its mirror image.

#' Weights of the nugget and of Gaussian kernels by the covariances at some distances
#'
#' A field is the sum of one that is symmetric and one that is antisymmetric. Of the weights a and b
#' of their kernels the covariance at a distance has (a + b) / 2, that with the mirror image at this
#' distance (a - b) / 2. Of each pair of points the shorter of both distances counts: near the plane
#' of symmetry both are short, and neither can be told apart.
#'
#' @param left n x 3k: what the components leave of u.
#' @param points k x 3, whose plane of symmetry is x = 0 if `mirrored`.
#' @param plan List: `ranges`, `bins` (edges of the distances), `nugget` (its least weight).
#' @return List: `own` (the nugget, and a weight a range), `mirrored` (a weight a range).
#' @noRd
fit_kernel <- function(left, points, plan, mirrored) {
  k <- nrow(points)
  each <- lapply(1:3, function(d) crossprod(left[, (d - 1) * k + seq_len(k), drop = FALSE]))
  distance <- distances_between(points)
  opposite <- if (mirrored) distances_between(points, across_plane(points)) else distance + 1
  own <- binned_covariances(Reduce(`+`, each), distance, distance <= opposite, plan$bins)
  own$covariance <- pmax(own$covariance, 0) / (3 * nrow(left))
  design <- vapply(plan$ranges, function(range) exp(-own$at^2 / (2 * range^2)), own$at)
  nugget <- as.numeric(own$at < plan$bins[2])
  if (!mirrored) {
    found <- non_negative(cbind(nugget, design) * own$weight, own$covariance * own$weight)
    return(list(own = replace(found, 1, max(found[1], plan$nugget)), mirrored = 0 * found[-1]))
  }
  other <- binned_covariances(each[[2]] + each[[3]] - each[[1]], opposite, opposite < distance,
                              plan$bins)
  other$covariance <- other$covariance / (3 * nrow(left))
  across <- vapply(plan$ranges, function(range) exp(-other$at^2 / (2 * range^2)), other$at)
  found <- non_negative(
    rbind(cbind(nugget, design / 2, design / 2) * own$weight,
          cbind(0 * other$at, across / 2, -across / 2) * other$weight),
    c(own$covariance * own$weight, other$covariance * other$weight)
  )
  a <- found[1 + seq_along(plan$ranges)]
  b <- found[-seq_len(1 + length(plan$ranges))]
  list(own = c(max(found[1], plan$nugget), (a + b) / 2), mirrored = (a - b) / 2)
}

#' Mean covariances of pairs of points by bins of their distance
#'
#' @param pairs,distance k x k; `used`: k x k, which pairs count.
#' @param most Pairs from which on a bin has no more weight.
#' @return List of vectors, without empty bins: `at` (mean distance), `covariance`, `weight`.
#' @noRd
binned_covariances <- function(pairs, distance, used, bins, most = 5000) {
  chosen <- which(used & upper.tri(distance, TRUE))
  bin <- cut(distance[chosen], bins, labels = FALSE, include.lowest = TRUE)
  bin <- factor(bin, seq_len(length(bins) - 1))
  count <- as.vector(table(bin))
  mean_of <- function(value) as.vector(tapply(value, bin, mean))[count > 0]
  list(at = mean_of(distance[chosen]), covariance = mean_of(pairs[chosen]),
       weight = sqrt(pmin(count[count > 0], most)))
}

#' Least squares with coefficients of at least 0: the best of all sets of columns
#' @noRd
non_negative <- function(x, y) {
  best <- list(left = sum(y^2), coef = numeric(ncol(x)))
  for (set in seq_len(2^ncol(x) - 1)) {
    chosen <- which(bitwAnd(set, 2^(seq_len(ncol(x)) - 1)) > 0)
    coef <- qr.coef(qr(x[, chosen, drop = FALSE]), y)
    if (anyNA(coef) || any(coef < 0)) next
    left <- sum((y - x[, chosen, drop = FALSE] %*% coef)^2)
    if (left < best$left) best <- list(left = left, coef = replace(numeric(ncol(x)), chosen, coef))
  }
  best$coef
}

#' Whether the weights of a field are those of a correlation, but for their rounding
#' @noRd
is_kernel <- function(field, rounding = 1e-5) {
  own <- field$kernel[-1]
  other <- field$mirrored
  all(is.finite(c(field$kernel, other)), field$kernel >= 0) &&
    length(own) == length(field$ranges) && length(other) == length(own) &&
    all(abs(other) <= own * (1 + rounding))
}

across_plane <- function(points) points * rep(c(-1, 1, 1), each = nrow(points))

distances_between <- function(a, b = a) {
  sqrt(pmax(outer(rowSums(a^2), rowSums(b^2), `+`) - 2 * tcrossprod(a, b), 0))
}

#' The kernels of the three co-ordinates between all points, with the nugget
#'
#' x is turned round by a mirror, y and z are not. Points near the plane of symmetry would vary more
#' or less than others; each is scaled to the variance of a point far from it, as u is standardised.
#'
#' @return List of three k x k matrices; the last two are the same, and without mirror all are.
#' @noRd
axis_kernels <- function(field) {
  summed <- function(weights, squares) {
    Reduce(`+`, Map(function(weight, range) weight * exp(-squares / (2 * range^2)), weights,
                    field$ranges))
  }
  own <- summed(field$kernel[-1], distances_between(field$points)^2)
  diag(own) <- sum(field$kernel)
  if (!any(field$mirrored != 0)) return(list(own, own, own))
  other <- summed(field$mirrored,
                  distances_between(field$points, across_plane(field$points))^2)
  scaled <- function(kernel) {
    by <- sqrt(sum(field$kernel) / diag(kernel))
    kernel * tcrossprod(by)
  }
  straight <- scaled(own + other)
  list(scaled(own - other), straight, straight)
}
