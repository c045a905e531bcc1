# Similarities, and the frames of template and scan.

#' Rotation, scale and shift that take points nearest to others
#' @noRd
similarity <- function(from, to) {
  a <- sweep(from, 2, colMeans(from))
  b <- sweep(to, 2, colMeans(to))
  turn <- nearest_rotation(a, b)
  rotation <- t(turn$rotation)
  scale <- sum(turn$d) / sum(a^2)
  list(rotation = rotation, scale = scale,
       shift = colMeans(to) - scale * drop(rotation %*% colMeans(from)))
}

apply_similarity <- function(xyz, by) {
  moved <- by$scale * xyz %*% t(by$rotation) + rep(by$shift, each = nrow(xyz))
  dimnames(moved) <- dimnames(xyz)
  moved
}

#' Points of the template's frame in that of a scan, and back
#' @noRd
from_frame <- function(xyz, laid) {
  t(laid$pose[13] * matrix(laid$pose[1:9], 3) %*% t(xyz) + laid$pose[10:12]) / laid$unit
}
into_frame <- function(xyz, laid) {
  t(crossprod(matrix(laid$pose[1:9], 3), t(xyz) * laid$unit - laid$pose[10:12])) / laid$pose[13]
}
