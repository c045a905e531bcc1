# Deviations of all points of a face together: few components, and a kernel for the rest.

#' The norm of a set of points
#'
#' Co-ordinates are smoothed by age, each column apart. The standardised deviations u have the
#' correlation V diag(values) V' + K + P (large I) P': components V, a kernel K of distances for
#' each co-ordinate, and pose and scale P, which are left free.
#'
#' @param y n x 3k: co-ordinates, all x first.
#' @param points k x 3: the reference, whose plane of symmetry is x = 0; `normal`: k x 3.
#' @param people List: `age`, `group`.
#' @param plan List: `size` (of [smooth_columns()]), `components`, `ranges`, `bins`.
#' @param partner k: row that each point is mirrored to. NULL: no side tells of the other.
#' @return List: `points`, `normal`, `columns`, `along` (norm of the part along the normal), `sd`
#'   (3k: mean spread), `vectors` (3k x K), `values` (K), `kernel` (nugget, and a weight a range),
#'   `mirrored` (a weight a range: the same with the other side, 0 without `partner`), `ranges`,
#'   `partner`.
#' @noRd
fit_field <- function(y, points, normal, people, plan, partner = NULL) {
  unit <- plan$unit
  columns <- smooth_columns(y, people$age, people$group, plan$size, rep(unit, ncol(y)))
  expected <- expected_columns(columns, people$age, people$group)
  along <- smooth_columns(normal_part(y, points, normal), people$age, people$group, plan$size,
                          rep(unit, nrow(points)))
  u <- (y - expected$mean) / expected$sd
  sd <- colMeans(expected$sd)
  rm(expected)
  parts <- leading_parts(u, plan$components)
  left <- u - tcrossprod(u %*% parts$vectors, parts$vectors)
  freedom <- nrow(u) / max(1, nrow(u) - plan$components - 10)
  kernel <- lapply(fit_kernel(left, points, plan, !is.null(partner)), `*`, freedom)
  list(points = points, normal = normal, columns = columns, along = along,
       sd = rounded_to(sd, unit / 10), vectors = rounded_to(parts$vectors, 1e-4),
       values = signif(parts$values, 6), kernel = signif(kernel$own, 6),
       mirrored = signif(kernel$mirrored, 6), ranges = plan$ranges, partner = partner)
}

#' n x k: how far along the normals points are from the reference
#' @noRd
normal_part <- function(y, points, normal) {
  k <- nrow(points)
  Reduce(`+`, lapply(1:3, function(d) {
    off <- y[, (d - 1) * k + seq_len(k), drop = FALSE] - rep(points[, d], each = nrow(y))
    off * rep(normal[, d], each = nrow(y))
  }))
}

#' Main axes of the rows of a matrix that is centred, signs by the largest entry
#' @return List: `vectors`, `values` (mean squares along them).
#' @noRd
leading_parts <- function(u, components) {
  if (components < 1) return(list(vectors = matrix(0, ncol(u), 0), values = numeric()))
  found <- RSpectra::svds(u, components, nu = 0, nv = components)
  v <- found$v
  largest <- v[cbind(max.col(t(abs(v)), "first"), seq_len(ncol(v)))]
  list(vectors = v * rep(sign(largest), each = nrow(v)), values = found$d^2 / nrow(u))
}

#' Pose and scale of the reference over the mean spread, 3k x 7, orthonormal
#' @noRd
pose_directions <- function(field) {
  k <- nrow(field$points)
  m <- sweep(field$points, 2, colMeans(field$points))
  zero <- numeric(k)
  one <- rep(1, k)
  moves <- cbind(c(one, zero, zero), c(zero, one, zero), c(zero, zero, one),
                 c(-m[, 2], m[, 1], zero), c(m[, 3], zero, -m[, 1]), c(zero, -m[, 3], m[, 2]),
                 as.vector(m))
  qr.Q(qr(moves / field$sd))
}

#' The inverse of the correlation of u, as what is needed to apply it (Woodbury)
#'
#' @param extra Variance added to each point (3k): large where a point is left out.
#' @param free Variance of pose and scale.
#' @return List: `solve_kernel` (a function), `roots` (Cholesky's, of the kernel of each
#'   co-ordinate), `kernel_diagonal` (of the kernel's inverse), `basis` (3k x (K + 7)), `inner` (the
#'   inverse of its matrix), `solved` (the kernel's inverse times the basis).
#' @noRd
invert_field <- function(field, extra = 0, free = 1e6) {
  k <- nrow(field$points)
  extra <- matrix(extra, k, 3)
  kernels <- axis_kernels(field)
  roots <- list()
  diagonal <- matrix(0, k, 3)
  for (axis in 1:3) {
    # Most often the next axis has the same matrix.
    same <- axis > 1 && identical(extra[, axis], extra[, axis - 1]) &&
      identical(kernels[[axis]], kernels[[axis - 1]])
    roots[[axis]] <- if (same) roots[[axis - 1]] else
      chol(kernels[[axis]] + diag(extra[, axis] + 1e-6))
    diagonal[, axis] <- if (same) diagonal[, axis - 1] else diag(chol2inv(roots[[axis]]))
  }
  solve_kernel <- function(x) {
    do.call(rbind, lapply(1:3, function(axis) {
      own <- x[(axis - 1) * k + seq_len(k), , drop = FALSE]
      backsolve(roots[[axis]], backsolve(roots[[axis]], own, transpose = TRUE))
    }))
  }
  basis <- cbind(field$vectors, pose_directions(field))
  solved <- solve_kernel(basis)
  inner <- diag(c(1 / field$values, rep(1 / free, 7)), ncol(basis)) + crossprod(basis, solved)
  list(solve_kernel = solve_kernel, roots = roots, kernel_diagonal = as.vector(diagonal),
       basis = basis, solved = solved, inner = chol2inv(chol(inner)))
}

apply_inverse <- function(inverse, x) {
  x <- as.matrix(x)
  y <- inverse$solve_kernel(x)
  y - inverse$solved %*% (inverse$inner %*% crossprod(inverse$solved, x))
}

inverse_diagonal <- function(inverse) {
  inverse$kernel_diagonal - rowSums((inverse$solved %*% inverse$inner) * inverse$solved)
}

#' Standardised deviations of faces, n x 3k
#' @noRd
field_deviations <- function(field, y, age, group) {
  expected <- expected_columns(field$columns, age, group)
  (y - expected$mean) / expected$sd / sqrt(1 + expected$h)
}

#' What is expected at points that are left out, given all others
#'
#' @param out 3k, which co-ordinates are left out.
#' @param extra The variance that leaves them out.
#' @return List: `fit` (3k: u itself outside), `variance` (3k: of u given the others, 0 outside).
#' @noRd
given_the_rest <- function(field, u, out, extra = 1e5) {
  inverse <- invert_field(field, ifelse(out, extra, 0))
  solved <- as.vector(apply_inverse(inverse, u))
  variance <- pmax(1 / inverse_diagonal(inverse) - extra, 0)
  list(fit = ifelse(out, u - extra * solved, u), variance = ifelse(out, variance, 0))
}
