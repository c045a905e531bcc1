# Where the curvature of the surfaces of section 5.2 is greatest: not quite along their crest in
# height.

#' Locus of greatest curvature of a simulated ridge
#'
#' The places beside the crest where the principal curvature `k2` of \eqn{z = -b (x - a y^3)^2} is
#' least along its own direction, followed from the middle of the square outwards. The surface turns
#' into itself with (x, y) to (-x, -y), so one half is enough.
#'
#' @param a,b,end As in [simulate_ridge()].
#' @param reach The locus is sought up to this distance from the crest along x, in the unit of the
#'   surface.
#' @param step,rows Distance of the places that are looked at along x, and their number along y.
#' @param n Number of points.
#' @return Matrix n x 3, x, y, z from `y = -end` to `end`; NA from where the locus ends, if it does.
#' @noRd
ridge_crest <- function(a, b, end, reach = 0.5, step = 0.025, rows = 31, n = 401) {
  y <- seq(0, end, length.out = (n + 1) / 2)
  u <- if (a == 0) 0 * y else
    crest_offset(a, b, y, seq(0, end, length.out = rows), seq(-reach, reach, by = step))
  x <- u + a * y^3
  half <- cbind(x = x, y = y, z = -b * u^2)
  mirrored <- half[rev(seq_along(y))[-length(y)], ] %*% diag(c(-1, -1, 1))
  rbind(mirrored, half)
}

#' Distances along x from crest to locus at some y; NA from where it ends
#'
#' @param coarse Values of y, from 0, at which it is found; in between it is a spline.
#' @param at As in [follow_crest()].
#' @noRd
crest_offset <- function(a, b, y, coarse, at, h = 1e-3) {
  # The locus from 0 upwards, as far as it is found
  slope <- matrix(crest_slope(a, b, rep(at, length(coarse)), rep(coarse, each = length(at))),
                  length(at))
  u <- rep(NA_real_, length(coarse))
  last <- 0
  for (i in seq_along(coarse)) {
    before <- slope[-length(at), i]
    after <- slope[-1, i]
    least <- which(before <= 0 & after > 0)
    zero <- at[least] + diff(at)[least] * before[least] / (before[least] - after[least])
    nearest <- zero[which.min(abs(zero - last))]
    if (!length(nearest) || abs(nearest - last) > max(0.1, 2 * abs(last))) break
    u[i] <- last <- nearest
  }
  for (iteration in 1:4) {
    # Newton's step towards the locus
    grade <- crest_slope(a, b, u, coarse)
    bend <- (crest_slope(a, b, u + h, coarse) - crest_slope(a, b, u - h, coarse)) / (2 * h)
    step <- grade / bend
    u <- u - pmin(pmax(step, -0.02), 0.02)
  }
  known <- !is.na(u)
  if (sum(known) < 2) return(rep(NA_real_, length(y)))
  ifelse(y <= max(coarse[known]), stats::spline(coarse[known], u[known], xout = y)$y, NA)
}

#' Derivative of k2 along its principal direction, towards positive x
#' @noRd
crest_slope <- function(a, b, u, y, h = 1e-4) {
  x <- u + a * y^3
  along <- h * simulated_curvature(a, b, x, y)$direction2
  forward <- simulated_curvature(a, b, x + along[, 1], y + along[, 2])$k2
  backward <- simulated_curvature(a, b, x - along[, 1], y - along[, 2])$k2
  (forward - backward) / (2 * h)
}

#' Principal curvature k2 of z = -b (x - a y^3)^2 and its direction
#'
#' @return List: `k2`; `direction2`, n x 2, of length 1 in (x, y), with x positive.
#' @noRd
simulated_curvature <- function(a, b, x, y) {
  u <- x - a * y^3
  zx <- -2 * b * u
  zy <- 6 * a * b * u * y^2
  stretch <- sqrt(1 + zx^2 + zy^2)
  # First and second fundamental forms: e, f, g and l, m, n.
  l <- -2 * b / stretch
  m <- 6 * a * b * y^2 / stretch
  n <- (12 * a * b * u * y - 18 * a^2 * b * y^4) / stretch
  e <- 1 + zx^2
  f <- zx * zy
  g <- 1 + zy^2
  mean <- (e * n - 2 * f * m + g * l) / (2 * stretch^2)
  k2 <- mean - sqrt(pmax(mean^2 - (l * n - m^2) / stretch^2, 0))
  # Both rows of II - k2 I give the direction; the longer one is the safer.
  direction <- cbind(n - k2 * g, k2 * f - m)
  other <- cbind(m - k2 * f, k2 * e - l)
  longer <- which(rowSums(other^2) > rowSums(direction^2))
  direction[longer, ] <- other[longer, ]
  list(k2 = k2, direction2 = direction * ifelse(direction[, 1] < 0, -1, 1) /
       sqrt(rowSums(direction^2)))
}
