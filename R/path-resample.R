#' Points along a path at equal chords
#'
#' @param mesh The mesh of the path.
#' @param path A `mesh_path`.
#' @param n Number of points, both ends counted, at least 2.
#' @param tolerance Relative difference of the chords at which to stop.
#' @param iterations Most rounds of correction.
#' @param slowest Least share of a correction that is carried out.
#' @return Data frame of n rows `s, x, y, z, face, w1, w2, w3`; the straight distances between
#'   neighbours are equal. The points lie on the path, so on the mesh. Attribute `converged`.
#' @noRd
resample_path <- function(mesh, path, n, tolerance = 1e-10, iterations = 200, slowest = 0.2) {
  spaced <- cpp_equal_chords(columns_of(path, c("x", "y", "z")), path$s, n,
                             chord_settings(tolerance, iterations, slowest))
  structure(place_along(mesh, path, spaced$s), converged = spaced$converged)
}

chord_settings <- function(tolerance = 1e-10, iterations = 200, slowest = 0.2) {
  list(tolerance = tolerance, iterations = iterations, slowest = slowest)
}

# Positions at arc lengths, n x 3.
points_along <- function(path, s) {
  vapply(c("x", "y", "z"),
         function(a) stats::approx(path$s, path[[a]], s, rule = 2, ties = "ordered")$y, s)
}

#' Points of a path at given arc lengths, each in the triangle of its segment
#' @noRd
place_along <- function(mesh, path, s) {
  placed <- cpp_place_along(mesh$vb, mesh$it, columns_of(path, c("x", "y", "z")), path$s, path$face,
                            s)
  ends <- which(s %in% range(path$s))
  if (length(ends)) placed[ends, ] <- columns_of(path)[ifelse(s[ends] == 0, 1, nrow(path)), ]
  columns <- stats::setNames(c(list(s), lapply(1:7, function(i) placed[, i])), c("s", mesh_columns))
  columns$face <- as.integer(columns$face)
  frame_of(columns)
}

# Barycentric weights of points that lie in the given triangles.
weights_in_faces <- function(mesh, face, xyz) {
  corner <- function(i) t(mesh$vb[1:3, mesh$it[i, face], drop = FALSE])
  a <- corner(1)
  u <- corner(2) - a
  v <- corner(3) - a
  w <- xyz - a
  uu <- rowSums(u * u)
  uv <- rowSums(u * v)
  vv <- rowSums(v * v)
  det <- uu * vv - uv^2
  w2 <- (vv * rowSums(w * u) - uv * rowSums(w * v)) / det
  w3 <- (uu * rowSums(w * v) - uv * rowSums(w * u)) / det
  weight <- pmax(cbind(1 - w2 - w3, w2, w3), 0)
  weight / rowSums(weight)
}
