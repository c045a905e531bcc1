# Displacements that are known everywhere: smooth random fields, and bumps that end at a radius.

#' A smooth random field
#'
#' A sum of cosine waves of random direction and phase (random Fourier features). Over draws, every
#' value has mean 0 and variance sd^2, and values at distance r have covariance sd^2 exp(-r^2 / (2
#' range^2)), exactly and for any number of waves; with many waves they are normal. It needs no
#' mesh, so it is known at every point of space.
#'
#' @param range Distance over which values go together, in the unit of the points.
#' @param sd Standard deviation of each component.
#' @param columns Components of the field: 3 for displacements, 1 for heights.
#' @param waves Number of waves.
#' @return Function of a k x 3 matrix that gives a k x `columns` matrix.
#' @noRd
random_field <- function(range, sd, columns = 3, waves = 200) {
  frequency <- matrix(stats::rnorm(3 * waves), 3) / range
  phase <- stats::runif(waves, 0, 2 * pi)
  height <- matrix(stats::rnorm(waves * columns), waves) * sd * sqrt(2 / waves)
  function(xyz) cos(xyz %*% frequency + rep(phase, each = nrow(xyz))) %*% height
}

#' Sum of random fields of several ranges
#' @param variation Data frame `range`, `sd`; perhaps without a row.
#' @noRd
random_fields <- function(variation, waves) {
  fields <- Map(random_field, variation$range, variation$sd, waves = waves)
  function(xyz) Reduce(`+`, lapply(fields, function(field) field(xyz)), matrix(0, nrow(xyz), 3))
}

#' A bump: 1 in its centre, 0 from a radius on, twice differentiable
#' @param distance,radius In the same unit.
#' @noRd
bump <- function(distance, radius) (1 - pmin(distance / radius, 1)^2)^3

#' Displacement by several bumps, each along its own direction
#'
#' @param places Data frame `x, y, z, radius, share, dx, dy, dz`.
#' @return Function of a k x 3 matrix that gives a k x 3 matrix: at the centre of a single bump its
#'   share in its direction.
#' @noRd
bump_field <- function(places) {
  centre <- unname(as.matrix(places[c("x", "y", "z")]))
  step <- unname(as.matrix(places[c("dx", "dy", "dz")])) * places$share
  function(xyz) {
    heights <- vapply(seq_len(nrow(centre)), function(i) {
      bump(row_lengths(sweep(xyz, 2, centre[i, ])), places$radius[i])
    }, numeric(nrow(xyz)))
    matrix(heights, nrow(xyz)) %*% step
  }
}
