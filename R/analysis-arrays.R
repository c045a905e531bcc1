# Arrays of configurations aligned by the kernel, and the weights of their points.

#' The kernel with names put back
#' @return List: `coords`, `mean`, `size`, `moved`, `converged`.
#' @noRd
fit_alignment <- function(whole, weight, scaling, tolerance, rounds) {
  x <- whole$coords
  fit <- cpp_align(x, dim(x), weight, whole$reference, scaling, tolerance, rounds)
  fit$coords <- array(fit$coords, dim(x), dimnames(x))
  fit$mean <- matrix(fit$mean, dim(x)[1], dim(x)[2], dimnames = dimnames(x)[1:2])
  names(fit$size) <- dimnames(x)[[3]]
  fit
}

#' k weights of mean 1
#' @noRd
point_weights <- function(weights, whole) {
  k <- length(whole$kept)
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "align")
  if (is.null(weights)) return(rep(1, k))
  if (identical(weights, "places")) {
    weights <- 1 / as.vector(table(whole$places)[whole$places])
  } else if (identical(weights, "area")) {
    if (is.null(whole$triangles)) {
      fail("there are no triangles to take areas of.", "Give `triangles`, or another `weights`.")
    }
    weights <- point_areas(mean_of_sizes(whole), whole$triangles)
  } else if (!is.numeric(weights) || length(weights) != whole$given || any(!is.finite(weights)) ||
             any(weights < 0)) {
    fail(sprintf("`weights` is %s.", describe_value(weights)),
         sprintf("Give \"area\", \"places\" or %d numbers, none of them negative.", whole$given))
  } else {
    weights <- weights[whole$kept]
  }
  if (sum(weights > 0) < 3) fail("fewer than three points have a weight.", "Give weights above 0.")
  weights * k / sum(weights)
}

#' An alignment as what [align()] weighs; its co-ordinates, a copy, only where areas need them
#' @noRd
as_whole <- function(aligned, weights) {
  k <- nrow(aligned$mean)
  list(coords = if (identical(weights, "area")) aligned$coords, reference = aligned$mean,
       triangles = aligned$triangles, places = aligned$places, given = k, kept = seq_len(k))
}
