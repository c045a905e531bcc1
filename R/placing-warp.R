# The displacement of a template onto a scan: a low-rank Gaussian process, fitted to nearest points
# in place and curvature.

#' Basis of the displacements of a template
#'
#' The process is the sum of Gaussian kernels, split into a part that is its own mirror image in x
#' and one that is turned by the mirror, of smaller standard deviation. Each component of a
#' displacement is then a process of functions even or odd in x.
#'
#' @param xyz n x 3, the template's points in its own frame (mirror: x to -x), those that the
#'   functions are chosen by first.
#' @param m How many of them the functions are chosen by; the rest are landmarks.
#' @param symmetric Whether the template has a mirror.
#' @return List by component of n x k matrices whose coefficients are independent standard normal.
#' @noRd
warp_basis <- function(xyz, m, symmetric, settings) {
  affine <- settings$affine *
    cbind(1, sweep(xyz, 2, colMeans(xyz[seq_len(m), ])) / settings$length_scale[1])
  if (!symmetric) {
    own <- process_basis(xyz, m, function(a, b) gauss_kernel(a, b, settings), settings$rank / 3)
    each <- cbind(own$functions, affine)
    return(list(each, each, each))
  }
  mirror <- function(a) cbind(-a[, 1], a[, 2:3, drop = FALSE])
  part <- function(sign) function(a,
                                  b) (gauss_kernel(a, b, settings) + sign *
                                      gauss_kernel(a, mirror(b), settings)) / 2
  even <- process_basis(xyz, m, part(1), settings$rank / 3)
  odd <- process_basis(xyz, m, part(-1), settings$rank / 3)
  across <- joined_basis(odd, even, settings$uneven, settings$rank / 3)
  along <- joined_basis(even, odd, settings$uneven, settings$rank / 3)
  list(cbind(across, affine), cbind(along, affine), cbind(along, affine))
}

gauss_kernel <- function(a, b, settings) {
  d2 <- outer(rowSums(a^2), rowSums(b^2), `+`) - 2 * tcrossprod(a, b)
  total <- 0
  for (i in seq_along(settings$length_scale_sd)) {
    total <- total + settings$length_scale_sd[i]^2 * exp(-d2 / (2 * settings$length_scale[i]^2))
  }
  total
}

#' Principal functions of a process: pivoted Cholesky, then turned to the axes of its variance
#'
#' @param least Variance that is left, as a share of the greatest, at which no more functions are
#'   taken.
#' @return List: `functions` (n x k), `variance` (k, of each over the points).
#' @noRd
process_basis <- function(xyz, m, kernel, rank, least = 1e-12) {
  many <- min(m, ceiling(2 * rank))
  root <- matrix(0, nrow(xyz), many)
  left <- vapply(seq_len(nrow(xyz)),
                 function(i) kernel(xyz[i, , drop = FALSE], xyz[i, , drop = FALSE]), 0)
  least <- least * max(left[seq_len(m)])
  for (j in seq_len(many)) {
    pivot <- which.max(left[seq_len(m)])
    if (left[pivot] <= least) break
    used <- seq_len(j - 1)
    column <- drop(kernel(xyz, xyz[pivot, , drop = FALSE])) -
      drop(root[, used, drop = FALSE] %*% root[pivot, used])
    root[, j] <- column / sqrt(left[pivot])
    left <- pmax(left - root[, j]^2, 0)
  }
  axes <- eigen(crossprod(root[seq_len(m), ]), symmetric = TRUE)
  list(functions = root %*% axes$vectors, variance = axes$values)
}

joined_basis <- function(full, share, factor, rank) {
  values <- c(full$variance, factor^2 * share$variance)
  kept <- order(-values)[seq_len(min(ceiling(rank), length(values)))]
  cbind(full$functions, factor * share$functions)[, sort(kept), drop = FALSE]
}

#' Fit the displacement of a template's points to a cloud in the template's frame
#'
#' All steps but the last few take the template's light points only, each counting for more, so that
#' the balance with the prior is kept; without curvature in the matches all steps do.
#'
#' @param weight Of curvature in the matches.
#' @param pins Landmarks whose places are known, as of [warp_pins()]; NULL: none.
#' @return List: `moved` (n + k x 3, all rows of the basis), `coefficients`, `sd` (of the k, see
#'   [warp_sd()]); of the n points `index` (of the nearest in the cloud, or NA) and `residual` (the
#'   distance to it).
#' @noRd
fit_warp <- function(template, cloud, settings, weight, pins = NULL) {
  xyz <- t(template$xyz)
  n <- nrow(xyz)
  pinned <- pinned_system(template$basis, pins)
  basis <- lapply(template$basis, function(b) b[seq_len(n), , drop = FALSE])
  of <- function(x) weight * rbind(x$k1, x$k2)
  feature <- of(template)
  to_feature <- of(cloud)
  moved <- xyz
  ends <- settings$warp_reach
  reach <- ends[1] * (ends[2] / ends[1])^seq(0, 1, length.out = settings$warp_steps)
  light <- if (weight > 0) settings$warp_steps - settings$whole_steps else settings$warp_steps
  solved <- NULL
  for (step in seq_along(reach)) {
    own <- if (step <= light) template$light else seq_len(n)
    found <- match_points(moved[own, , drop = FALSE], template$normal[, own, drop = FALSE],
                          feature[, own, drop = FALSE], cloud, to_feature, reach[step],
                          settings$cosine)
    on <- which(!is.na(found$index) & !cloud$border[found$index])
    if (length(on) < settings$fewest) break
    solved <- solved_warp(basis, own[on], xyz, moved, found$index[on], cloud,
                          settings$error * sqrt(length(own) / n), pinned, settings)
    moved <- xyz + displaced(basis, solved$coefficients)
  }
  near <- match_points(moved, template$normal, 0 * feature, cloud, 0 * to_feature, ends[1],
                       settings$cosine)
  own <- lapply(template$basis, function(b) b[-seq_len(n), , drop = FALSE])
  list(moved = rbind(xyz, template$landmarks) + displaced(template$basis, solved$coefficients),
       coefficients = solved$coefficients,
       sd = warp_sd(own, solved$root), index = near$index, residual = near$distance)
}

#' Coefficients of a displacement by penalised least squares
#'
#' Distances across the scan's surface count in full, along it by a share.
#'
#' @param used Numbers of the matched points, whose places were `xyz` and are `moved` (n x 3).
#' @param to Their matches in the cloud. @param error Standard deviation of a match.
#' @param pinned As of [pinned_system()].
#' @return List: `coefficients`, `root` (see [warp_root()]).
#' @noRd
solved_warp <- function(basis, used, xyz, moved, to, cloud, error, pinned, settings) {
  across_surface <- cloud$normal[, to, drop = FALSE]
  normal <- t(across_surface)
  place <- t(cloud$xyz[, to, drop = FALSE])
  across <- row_products(place - moved[used, , drop = FALSE], normal)
  weights <- 1 / ((1 + (across / settings$robust_scale)^2) * error^2)
  gap <- place - xyz[used, , drop = FALSE]
  pull <- weights *
    ((1 - settings$along) * row_products(gap, normal) * normal + settings$along * gap)
  right <- unlist(lapply(1:3, function(k) {
    crossprod(basis[[k]], replace(numeric(nrow(xyz)), used, pull[, k]))
  }))
  right <- right + pinned$right
  root <- warp_root(basis, used, across_surface, weights, settings, pinned$precision)
  list(coefficients = drop(backsolve(root, backsolve(root, right, transpose = TRUE))), root = root)
}

#' What landmarks whose places are known add to the normal equations of a displacement
#' @return List: `precision`, `right`; 0 where there are none.
#' @noRd
pinned_system <- function(basis, pins) {
  if (is.null(pins)) return(list(precision = 0, right = 0))
  own <- lapply(basis, function(b) b[pins$row, , drop = FALSE])
  sizes <- vapply(own, ncol, 0L)
  precision <- matrix(0, sum(sizes), sum(sizes))
  end <- cumsum(sizes)
  for (k in 1:3) {
    block <- (end[k] - sizes[k] + 1):end[k]
    precision[block, block] <- pins$weight * crossprod(own[[k]])
  }
  list(precision = precision,
       right = pins$weight * unlist(lapply(1:3, function(k) crossprod(own[[k]], pins$by[, k]))))
}

match_points <- function(xyz, normal, feature, cloud, to_feature, reach, cosine) {
  cpp_match_clouds(t(xyz), normal, feature, cloud$xyz, cloud$normal, to_feature, reach, cosine)
}

displaced <- function(basis, coefficients) {
  if (is.null(coefficients)) return(0)
  sizes <- vapply(basis, ncol, 0L)
  end <- cumsum(sizes)
  vapply(1:3, function(k) drop(basis[[k]] %*% coefficients[(end[k] - sizes[k] + 1):end[k]]),
         numeric(nrow(basis[[1]])))
}

#' Cholesky factor of the precision of the coefficients
#' @param used Numbers of the matched points; `normal` (3 x matches) and `weight`: theirs.
#' @param pinned What pins add to the precision.
#' @noRd
warp_root <- function(basis, used, normal, weight, settings, pinned = 0) {
  precision <- pinned +
    cpp_warp_gram(basis, used, normal, weight, settings$along, 1 - settings$along)
  diag(precision) <- diag(precision) + 1
  chol(precision)
}

#' Standard deviation of displacements (root of the sum over x, y, z) that the matches leave
#' @noRd
warp_sd <- function(basis, root) {
  if (is.null(root)) return(rep(Inf, nrow(basis[[1]])))
  sizes <- vapply(basis, ncol, 0L)
  end <- cumsum(sizes)
  variance <- 0
  for (k in 1:3) {
    row <- matrix(0, sum(sizes), nrow(basis[[k]]))
    row[(end[k] - sizes[k] + 1):end[k], ] <- t(basis[[k]])
    variance <- variance + colSums(forwardsolve(t(root), row)^2)
  }
  sqrt(variance)
}
