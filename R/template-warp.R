# Where landmarks alone put the points of a template: the thin-plate spline through them.

#' The thin-plate spline that takes landmarks of a template to those of a specimen
#'
#' The similarity that lays all known places onto the specimen's comes first, then the spline
#' through what is left at the landmarks. With four landmarks or more that lie in no plane that is
#' the spline itself. With fewer, directions that the landmarks do not span keep the similarity.
#'
#' @param from,to Places of template and specimen, matrices of three columns, NA where missing.
#' @param landmarks Row names of the landmarks.
#' @param tolerance As in [bending_energy()].
#' @return Matrix like `from`: its image, NA where `from` is.
#' @noRd
landmark_warp <- function(from, to, landmarks, tolerance) {
  laid <- superimposition(from, to, scale = TRUE)(from)
  known <- landmarks[!is.na(from[landmarks, 1]) & !is.na(to[landmarks, 1])]
  known <- known[!duplicated(laid[known, , drop = FALSE])]
  if (!length(known)) return(laid)
  at <- laid[known, , drop = FALSE]
  centre <- colMeans(at)
  axes <- svd(sweep(at, 2, centre))
  size <- sqrt(mean(rowSums(sweep(laid, 2, centre)^2), na.rm = TRUE))
  spanned <- axes$d > tolerance * size * sqrt(length(known))
  functions <- function(x) cbind(1, sweep(x, 2, centre) %*% axes$v[, spanned, drop = FALSE])
  distance <- function(x) {
    apart <- outer(rowSums(x^2), rowSums(at^2), `+`) - 2 * x %*% t(at)
    sqrt(pmax(apart, 0))
  }
  affine <- functions(at)
  none <- matrix(0, ncol(affine), ncol(affine))
  system <- rbind(cbind(-as.matrix(stats::dist(at)), affine), cbind(t(affine), none))
  weight <- solve(system, rbind(to[known, , drop = FALSE] - at, matrix(0, ncol(affine), 3)))
  centred <- sweep(laid, 2, centre)
  at <- sweep(at, 2, centre)
  laid + cbind(-distance(centred), functions(laid)) %*% weight
}
