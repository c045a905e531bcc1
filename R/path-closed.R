# Closed paths: their last point is their first.

#' A closed path that begins elsewhere
#'
#' @param s Arc length of the place at which it is to begin.
#' @noRd
begun_at <- function(scan, path, s) {
  length <- attr(path, "length")
  s <- s %% length
  if (s == 0) return(path)
  at <- columns_of(place_along(scan, path, s))
  whole <- columns_of(path)
  after <- whole[path$s > s, , drop = FALSE]
  before <- whole[-1, , drop = FALSE][path$s[-1] < s, , drop = FALSE]
  kept <- attributes(path)[c("lifted", "type", "criterion", "competing", "smoothed")]
  path <- path_through(rbind(at, after, before, at), scan, closed = TRUE)
  attributes(path)[names(kept)] <- kept
  path
}

#' A closed path run the other way
#' @noRd
reversed_loop <- function(scan, path) {
  back <- reversed_path(scan, path)
  kept <- attributes(path)[c("lifted", "smoothed", "closed")]
  attributes(back)[names(kept)] <- kept
  back
}

#' Arc length of the place of a path that is nearest to a position
#' @noRd
nearest_along <- function(path, xyz) {
  line <- t(columns_of(path, c("x", "y", "z")))
  cpp_path_coordinates(matrix(xyz, 3), line, matrix(1, 3, ncol(line)), is_closed(path))$s
}

#' Twice the area that a closed path encloses as seen along the mean normal of the surface beside
#' it, as a share of what it encloses as seen from where that is most
#'
#' @return Between -1 and 1; above 0 where it runs anticlockwise as seen from outside, near 0 where
#'   the normals along it point all round.
#' @noRd
seen_turn <- function(scan, path) {
  xyz <- columns_of(path, c("x", "y", "z"))
  n <- nrow(xyz)
  about <- sweep(xyz, 2, colMeans(xyz))
  area <- colSums(cross_rows(about[-n, ], about[-1, ]))
  normal <- path_normals(scan, path)
  normal <- normal / rep(sqrt(colSums(normal^2)), each = 3)
  weight <- (c(diff(path$s), 0) + c(0, diff(path$s))) / 2
  sum(area * (normal %*% weight)) / (sqrt(sum(area^2)) * sum(weight))
}

#' Share of a path that has another part of it close by
#'
#' @param reach How close, in the unit of the mesh.
#' @param apart How far away along the path that other part is at least; of a closed path no more
#'   than a quarter of its length.
#' @noRd
share_twice <- function(path, reach, apart) {
  length <- attr(path, "length")
  n <- max(2, ceiling(4 * length / reach))
  s <- seq(0, length, length.out = n)
  near <- as.matrix(stats::dist(points_along(path, s))) <= reach
  away <- abs(outer(s, s, `-`))
  if (is_closed(path)) {
    away <- pmin(away, length - away)
    apart <- min(apart, length / 4)
  }
  mean(rowSums(near & away > apart) > 0)
}
