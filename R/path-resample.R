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
  s <- attr(path, "length") * seq(0, 1, length.out = n)
  spread <- Inf
  share <- 1
  for (round in seq_len(iterations)) {
    at <- points_along(path, s)
    chord <- sqrt(rowSums(diff(at)^2))
    before <- spread
    spread <- max(chord) / min(chord) - 1
    if (spread < tolerance) break
    # Towards where the sum of chords reaches equal shares; more slowly once that overshoots.
    if (spread >= before) share <- max(share / 2, slowest)
    aim <- stats::approx(c(0, cumsum(chord)) / sum(chord), s, seq(0, 1, length.out = n), ties = "ordered")$y
    s <- s + share * (aim - s)
  }
  structure(place_along(mesh, path, s), converged = spread < tolerance)
}

# Positions at arc lengths, n x 3.
points_along <- function(path, s) {
  vapply(c("x", "y", "z"), function(a) stats::approx(path$s, path[[a]], s, rule = 2, ties = "ordered")$y, s)
}

#' Points of a path at given arc lengths, each in the triangle of its segment
#' @noRd
place_along <- function(mesh, path, s) {
  segment <- pmin(findInterval(s, path$s, all.inside = TRUE), nrow(path) - 1)
  face <- path$face[segment + 1]
  xyz <- points_along(path, s)
  weight <- weights_in_faces(mesh, face, xyz)
  ends <- s %in% range(path$s)
  exact <- path[ifelse(s[ends] == 0, 1, nrow(path)), ]
  face[ends] <- exact$face
  weight[ends, ] <- as.matrix(exact[c("w1", "w2", "w3")])
  data.frame(s = s, place_on_faces(mesh, face, weight), face = face, weight) |>
    stats::setNames(c("s", "x", "y", "z", "face", "w1", "w2", "w3"))
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
