# The scan for lesions: bumps along the normals, at every point, of some radii, on one side or both.

#' The bumps that a scan looks for
#'
#' Each side of a face tells what to expect of the other. A lesion on both sides is therefore what
#' the scan for one side sees least, and is looked for by itself.
#'
#' @return Data frame: `radius`, `both` (whether on both sides; not where points have no partners).
#' @noRd
scan_bumps <- function(field, radii) {
  both <- c(FALSE, if (!is.null(field$partner)) TRUE)
  data.frame(radius = rep(radii, length(both)), both = rep(both, each = length(radii)))
}

#' What belongs to bumps on one side, and after it the same of both sides, if there are partners
#'
#' @param each List by radius of matrices with a column for each centre, or of lists of them.
#' @noRd
with_both_sides <- function(each, field) {
  if (is.null(field$partner)) return(each)
  paired <- which(!is.na(field$partner) & field$partner != seq_along(field$partner))
  added <- function(x) {
    x[, paired] <- x[, paired] + x[, field$partner[paired]]
    x
  }
  c(each, lapply(each, function(x) if (is.list(x)) lapply(x, added) else added(x)))
}

#' Weights of the scan: a column for each centre
#'
#' t = w' u has variance 1 under the field, and is the best test of a bump along the normals there.
#' @return List by bump of [scan_bumps()] of 3k x k matrices.
#' @noRd
scan_weights <- function(field, radii, inverse = invert_field(field)) {
  distance <- as.matrix(stats::dist(field$points))
  along <- matrix(as.vector(field$normal) / field$sd, ncol = 3)
  kernels <- lapply(inverse$roots, chol2inv)
  each <- lapply(radii, function(radius) {
    # Most of a bump is 0.
    height <- Matrix::Matrix(bump(distance, radius), sparse = TRUE)
    lesion <- lapply(1:3, function(d) along[, d] * height)
    w <- do.call(rbind, Map(function(kernel, x) as.matrix(kernel %*% x), kernels, lesion))
    lesion <- do.call(rbind, lesion)
    w - inverse$solved %*% (inverse$inner %*% as.matrix(Matrix::crossprod(inverse$solved, lesion)))
  })
  scale <- scan_scale(field, radii, inverse)
  each <- with_both_sides(each, field)
  lapply(seq_along(each), function(q) each[[q]] / rep(scale[, q], each = nrow(each[[q]])))
}

#' By what the inverse's product with a bump is divided in these weights: k x bumps
#'
#' Of the bumps B and the inverse M along the normals alone, the root of the diagonal of B'MB.
#' @noRd
scan_scale <- function(field, radii, inverse = invert_field(field)) {
  k <- nrow(field$points)
  along <- as.vector(field$normal) / field$sd
  normal <- matrix(along, k)
  solved <- Reduce(`+`, lapply(1:3, function(d) {
    normal[, d] * inverse$solved[(d - 1) * k + seq_len(k), , drop = FALSE]
  }))
  m <- -solved %*% inverse$inner %*% t(solved)
  for (axis in 1:3) m <- m + chol2inv(inverse$roots[[axis]]) * tcrossprod(normal[, axis])
  distance <- as.matrix(stats::dist(field$points))
  each <- lapply(radii, function(radius) {
    height <- bump(distance, radius)
    list(height = height, solved = as.matrix(m %*% Matrix::Matrix(height, sparse = TRUE)))
  })
  vapply(with_both_sides(each, field), function(one) {
    sqrt(pmax(colSums(one$height * one$solved), 1e-300))
  }, numeric(k))
}

#' The scan's statistics without its weights: of many faces the shorter way
#'
#' @param u 3k x n.
#' @param scale Of [scan_scale()].
#' @return List by bump of n x k.
#' @noRd
scan_statistics <- function(field, u, radii, scale, inverse) {
  k <- nrow(field$points)
  solved <- apply_inverse(inverse, u) * (as.vector(field$normal) / field$sd)
  along <- Reduce(`+`, lapply(1:3, function(d) solved[(d - 1) * k + seq_len(k), , drop = FALSE]))
  distance <- as.matrix(stats::dist(field$points))
  each <- lapply(radii, function(radius) crossprod(along, bump(distance, radius)))
  each <- with_both_sides(each, field)
  lapply(seq_along(each), function(q) each[[q]] / rep(scale[, q], each = ncol(u)))
}
