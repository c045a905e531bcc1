# The rotation that takes points nearest to others: shared by poses, mirror images and means.

#' @param x,y n x 3, centred, no missing points.
#' @return List: `rotation` r, proper, 3 x 3, such that `x %*% r` is nearest to `y`; `d`: singular values of `x' y`, the
#'   last negative where a reflection would come nearer.
#' @noRd
nearest_rotation <- function(x, y) {
  parts <- svd(crossprod(x, y))
  sense <- c(1, 1, sign(det(parts$u) * det(parts$v)))
  list(rotation = parts$u %*% (sense * t(parts$v)), d = sense * parts$d)
}
