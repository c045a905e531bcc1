# Points on a mesh: the exactly closest place, as face and barycentric weights.

# The columns of a point on a mesh.
mesh_columns <- c("x", "y", "z", "face", "w1", "w2", "w3")

# Columns of a data frame as a matrix, and columns as a data frame: without the checks of as.matrix() and data.frame(),
# which cost more than what is done with them.
columns_of <- function(x, names = mesh_columns) do.call(cbind, unclass(x)[names])
frame_of <- function(columns, ..., class = NULL) {
  structure(columns, row.names = .set_row_names(length(columns[[1]])), ..., class = c(class, "data.frame"))
}

#' Closest points of a mesh
#'
#' Candidates come from a k-d tree of the faces' centres; a point is settled once the faces
#' beyond its candidates are provably farther away, else all faces are searched. All in double
#' precision (Rvcg's own closest point works in single precision).
#'
#' @param mesh A `mesh3d` with triangles.
#' @param xyz n x 3 matrix in the mesh's unit; rows with NA give rows of NA.
#' @param candidates How many faces are tried before the search of all faces (speed only).
#' @return Data frame of n rows: `x, y, z` (exactly the weighted mean of the face's corners),
#'   `face` (column of `mesh$it`), `w1, w2, w3` (barycentric, in 0 to 1, sum 1).
#' @noRd
surface_points <- function(mesh, xyz, candidates = 24L) {
  xyz <- matrix(as.numeric(xyz), ncol = 3)
  known <- which(is.finite(rowSums(xyz)))
  face <- rep(NA_integer_, nrow(xyz))
  weight <- matrix(NA_real_, nrow(xyz), 3)
  if (length(known)) {
    nearest <- nearest_faces(mesh, xyz[known, , drop = FALSE], candidates)
    face[known] <- nearest$face
    weight[known, ] <- nearest$weight
  }
  place <- place_on_faces(mesh, face, weight)
  data.frame(x = place[, 1], y = place[, 2], z = place[, 3], face = face,
             w1 = weight[, 1], w2 = weight[, 2], w3 = weight[, 3])
}

# n x 3 positions from faces and barycentric weights.
place_on_faces <- function(mesh, face, weight) {
  vertex <- t(mesh$vb[1:3, , drop = FALSE])
  corner <- function(i) vertex[mesh$it[i, face], , drop = FALSE]
  weight[, 1] * corner(1) + weight[, 2] * corner(2) + weight[, 3] * corner(3)
}

# Faces without area have no plane to go on from; what lies on them lies on their neighbours' edges.
nearest_faces <- function(mesh, xyz, candidates) {
  solid <- which(row_lengths(face_normals(mesh)) > 0)
  if (length(solid) < ncol(mesh$it)) {
    mesh$it <- mesh$it[, solid, drop = FALSE]
    nearest <- nearest_faces(mesh, xyz, candidates)
    nearest$face <- solid[nearest$face]
    return(nearest)
  }
  corners <- face_corners(mesh)
  centre <- (corners[[1]] + corners[[2]] + corners[[3]]) / 3
  reach <- do.call(pmax, lapply(corners, function(a) row_lengths(a - centre)))
  tried <- nearest_centres(centre, xyz, min(candidates, nrow(centre)))
  best <- best_of_candidates(xyz, corners, tried)
  farthest <- row_lengths(xyz - centre[tried[, ncol(tried)], , drop = FALSE])
  # One part in a thousand for the k-d tree's single precision.
  unsettled <- which(0.999 * farthest - max(reach) <= best$distance)
  # At a corner the gap of its own face is 0 but for rounding.
  rounding <- 1e-12 * max(reach)
  for (i in if (ncol(tried) < nrow(centre)) unsettled) {
    gap <- sqrt(colSums((t(centre) - xyz[i, ])^2)) - reach
    all <- best_of_candidates(xyz[i, , drop = FALSE], corners,
                              matrix(which(gap <= best$distance[i] * (1 + 1e-12) + rounding), 1))
    best$face[i] <- all$face
    best$weight[i, ] <- all$weight
  }
  best
}

# n x k: the columns of faces whose centres are nearest, nearest first.
nearest_centres <- function(centre, xyz, k) {
  middle <- colMeans(centre)
  size <- max(abs(sweep(centre, 2, middle)), .Machine$double.xmin)
  unit <- function(x) sweep(x, 2, middle) / size
  near <- Rvcg::vcgKDtree(unit(centre), unit(xyz), k = k)$index
  matrix(near, nrow(xyz))
}

best_of_candidates <- function(xyz, corners, tried) {
  row <- rep(seq_len(nrow(xyz)), ncol(tried))
  face <- as.vector(tried)
  found <- closest_on_triangles(xyz[row, , drop = FALSE], corners[[1]][face, , drop = FALSE],
                                corners[[2]][face, , drop = FALSE],
                                corners[[3]][face, , drop = FALSE])
  first <- order(row, found$distance, face)
  first <- first[!duplicated(row[first])]
  list(face = face[first], weight = found$weight[first, , drop = FALSE],
       distance = found$distance[first])
}

# Row by row: the closest point of triangle (a, b, c) to p, as weights, and its distance.
closest_on_triangles <- function(p, a, b, c) {
  none <- numeric(nrow(p))
  ab <- closest_on_segments(p, a, b)
  bc <- closest_on_segments(p, b, c)
  ca <- closest_on_segments(p, c, a)
  options <- list(cbind(1 - ab, ab, none), cbind(none, 1 - bc, bc), cbind(ca, none, 1 - ca),
                  foot_in_triangles(p, a, b, c))
  distance <- vapply(options, function(w) {
    row_lengths(p - w[, 1] * a - w[, 2] * b - w[, 3] * c)
  }, none)
  distance <- matrix(distance, nrow(p))
  distance[!is.finite(distance)] <- Inf
  pick <- max.col(-distance, ties.method = "first")
  weight <- matrix(0, nrow(p), 3)
  for (i in seq_along(options)) weight[pick == i, ] <- options[[i]][pick == i, ]
  list(weight = weight, distance = distance[cbind(seq_along(pick), pick)])
}

closest_on_segments <- function(p, a, b) {
  along <- row_products(p - a, b - a) / row_products(b - a, b - a)
  along[!is.finite(along)] <- 0
  pmin(pmax(along, 0), 1)
}

# Barycentric weights of the foot of the perpendicular, NA where it is outside.
foot_in_triangles <- function(p, a, b, c) {
  u <- b - a
  v <- c - a
  w <- p - a
  uu <- row_products(u, u)
  uv <- row_products(u, v)
  vv <- row_products(v, v)
  wu <- row_products(w, u)
  wv <- row_products(w, v)
  det <- uu * vv - uv^2
  w2 <- (vv * wu - uv * wv) / det
  w3 <- (uu * wv - uv * wu) / det
  weight <- cbind(1 - w2 - w3, w2, w3)
  outside <- !is.finite(det) | det <= 0 | rowSums(!(weight >= 0)) > 0
  weight[outside, ] <- NA
  weight
}
