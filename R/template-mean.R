# Procrustes mean of configurations with points missing.

#' The map that moves, turns and, if wanted, scales one configuration onto another by the points
#' that both have
#' @return Function of a matrix of three columns.
#' @noRd
superimposition <- function(x, y, scale) {
  both <- !is.na(x[, 1]) & !is.na(y[, 1])
  centre <- colMeans(x[both, , drop = FALSE])
  aim <- colMeans(y[both, , drop = FALSE])
  from <- sweep(x[both, , drop = FALSE], 2, centre)
  to <- sweep(y[both, , drop = FALSE], 2, aim)
  turn <- nearest_rotation(from, to)$rotation * if (scale) sqrt(sum(to^2) / sum(from^2)) else 1
  function(points) sweep(sweep(points, 2, centre) %*% turn, 2, aim, `+`)
}

laid_onto <- function(x, y, scale) superimposition(x, y, scale)(x)

#' Procrustes mean: of sizes made equal, at their mean size, laid onto a reference
#'
#' A point that is missing from a configuration takes no part in its fit; the mean of a point is
#' over those that have it. Where points are missing, the size of a configuration is judged by the
#' points that it has.
#'
#' @param x List of k x 3 matrices.
#' @param reference k x 3: where the mean is laid, and the first guess of it.
#' @param tolerance Greatest move of a point between two rounds, as a share of the mean's RMS
#'   radius.
#' @param rounds Most rounds.
#' @return k x 3, NA where no configuration has the point.
#' @noRd
procrustes_mean <- function(x, reference, tolerance = 1e-10, rounds = 100) {
  mean <- reference
  for (round in seq_len(rounds)) {
    laid <- lapply(x, laid_onto, mean, scale = TRUE)
    size <- exp(mean(mapply(function(own, laid) log(relative_size(own, laid)), x, laid)))
    centred <- mean_of(laid) * size
    centred <- laid_onto(centred, mean, scale = FALSE)
    moved <- max(abs(centred - mean), na.rm = TRUE)
    mean <- centred
    if (moved < tolerance * sqrt(sum(stats::var(mean, na.rm = TRUE)[c(1, 5, 9)]))) break
  }
  laid_onto(mean, reference, scale = FALSE)
}

#' Size of a configuration over that of another of the same points
#' @noRd
relative_size <- function(x, y) {
  spread <- function(x) sqrt(sum(apply(x, 2, stats::var, na.rm = TRUE)))
  spread(x) / spread(y)
}

#' Point by point, over the configurations that have it
#' @noRd
mean_of <- function(x) {
  count <- Reduce(`+`, lapply(x, function(x) !is.na(x)))
  total <- Reduce(`+`, lapply(x, function(x) replace(x, is.na(x), 0)))
  mean <- total / count
  replace(mean, count == 0, NA)
}
