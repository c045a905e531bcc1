# Deviations along the surface: correspondence as much as anatomy, so that no verdict uses them.

#' Correlations between the standardised co-ordinates of each point
#' @param u n x 3k.
#' @return Data frame: `r_xy`, `r_xz`, `r_yz`.
#' @noRd
joint_correlations <- function(u, unit = 1e-3) {
  k <- ncol(u) / 3
  part <- function(d) u[, (d - 1) * k + seq_len(k), drop = FALSE]
  root <- sqrt(colMeans(u^2))
  between <- function(a, b) {
    rounded_to(colMeans(part(a) * part(b)) / root[(a - 1) * k + seq_len(k)] /
                 root[(b - 1) * k + seq_len(k)], unit)
  }
  data.frame(r_xy = between(1, 2), r_xz = between(1, 3), r_yz = between(2, 3))
}

#' Two unit vectors along the surface at each point, k x 3 each
#' @noRd
tangent_axes <- function(normal) {
  axis <- diag(3)[max.col(-abs(normal), "first"), , drop = FALSE]
  first <- cross_rows(normal, axis)
  first <- first / row_lengths(first)
  list(first, cross_rows(normal, first))
}

#' How far points lie from their expectation along the surface, against how far they may
#'
#' The covariance of two deviations in the tangent plane is that of the co-ordinates: their spreads
#' at this age and their constant correlations. For a predicted point half of D2 has an F
#' distribution, with as many degrees of freedom as faces decide the spread.
#'
#' @param points Of a norm, with the normals and the correlations.
#' @param y n x 3k; `expected` of [expected_columns()] alike.
#' @param extra Variance of the co-ordinates that a worse scan adds, n x 3k or one number.
#' @param fewest Least degrees of freedom.
#' @return List of n x k matrices: `off` (length, at the norm's scale), `d2`, `p`.
#' @noRd
tangential_parts <- function(points, y, expected, extra = 0, fewest = 3) {
  k <- nrow(points)
  part <- function(x, d) x[, (d - 1) * k + seq_len(k), drop = FALSE]
  extra <- matrix(extra, nrow(y), 3 * k)
  spread <- expected$sd * sqrt(1 + expected$h)
  r <- list(points$r_xy, points$r_xz, points$r_yz)
  axes <- tangent_axes(as.matrix(points[c("nx", "ny", "nz")]))
  along <- lapply(axes, function(axis) {
    Reduce(`+`, lapply(1:3, function(d) t(t(part(y - expected$mean, d)) * axis[, d])))
  })
  covariance <- function(a, b) {
    own <- lapply(1:3, function(d) {
      t(t(part(spread, d)^2 + part(extra, d)) * a[, d] * b[, d])
    })
    mixed <- lapply(1:3, function(i) {
      d <- c(1, 1, 2)[i]
      e <- c(2, 3, 3)[i]
      t(t(part(spread, d) * part(spread, e)) * r[[i]] * (a[, d] * b[, e] + a[, e] * b[, d]))
    })
    Reduce(`+`, c(own, mixed))
  }
  c11 <- covariance(axes[[1]], axes[[1]])
  c12 <- covariance(axes[[1]], axes[[2]])
  c22 <- covariance(axes[[2]], axes[[2]])
  d2 <- (c22 * along[[1]]^2 - 2 * c12 * along[[1]] * along[[2]] + c11 * along[[2]]^2) /
    (c11 * c22 - c12^2)
  df <- pmax(fewest, 3 / Reduce(`+`, lapply(1:3, part, x = expected$h_spread)))
  list(off = sqrt(along[[1]]^2 + along[[2]]^2), d2 = d2,
       p = stats::pf(d2 / 2, 2, df, lower.tail = FALSE))
}
