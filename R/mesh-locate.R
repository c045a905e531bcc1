# Points on a mesh: the exactly closest place, as face and barycentric weights.

# Columns of a data frame as a matrix, and columns as a data frame: without the checks of
# as.matrix() and data.frame(), which cost more than what is done with them.
columns_of <- function(x, names = mesh_columns) do.call(cbind, unclass(x)[names])
frame_of <- function(columns, ..., class = NULL) {
  attributes(columns) <- c(list(names = names(columns), class = c(class, "data.frame"),
                                row.names = .set_row_names(length(columns[[1]]))), list(...))
  columns
}

#' The closest places of a surface
#'
#' Finds for every point the closest place of the surface, exactly and in double precision. A place
#' on a mesh is a triangle (`face`) and three barycentric weights of its corners. With these weights
#' any value that is known at the vertices can be interpolated.
#'
#' @param mesh A [specimen()], or a `mesh3d` of triangles.
#' @param xyz Points in the unit of the mesh: n x 3 matrix, three co-ordinates, or a data frame with
#'   columns `x`, `y`, `z`. A row with `NA` gives a row of `NA`.
#' @return Data frame with a row for each point, and the row names of `xyz`. Columns: `face` (column
#'   of `mesh$it`); `w1`, `w2`, `w3` (weights of its corners, 0 to 1, with sum 1); `x`, `y`, `z`
#'   (the place); `distance` (unit of the mesh). If several triangles are equally close, the one
#'   with the lowest number is given. A triangle without area is given only if the mesh has no
#'   others.
#' @section Errors: of class `crestline_error`: the mesh has no triangles; `xyz` has not three
#'   columns, or holds infinite numbers.
#' @template glossary
#' @seealso [frechet_mean()] for the mean of such places; [path_coordinates()]
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' found <- locate(ball, rbind(above = c(0, 0, 2), inside = c(0.5, 0, 0)))
#' found
#' # What is known at the vertices, here their height, at these places:
#' corners <- ball$it[, found$face]
#' colSums(matrix(ball$vb[3, corners], 3) * t(found[c("w1", "w2", "w3")]))
#' @export
locate <- function(mesh, xyz) {
  mesh <- as_mesh(mesh)
  # Positions as an n x 3 matrix of numbers, each finite or NA
  remedy <- "Give an n x 3 matrix, three numbers, or a data frame with columns x, y, z."
  refuse <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "arguments")
  }
  given <- xyz
  if (is.data.frame(xyz)) {
    if (!all(c("x", "y", "z") %in% names(xyz))) refuse("`xyz` has no columns x, y and z.", remedy)
    xyz <- as.matrix(xyz[c("x", "y", "z")])
    if (.row_names_info(given) <= 0) rownames(xyz) <- NULL
  }
  if (is.logical(xyz) && all(is.na(xyz))) storage.mode(xyz) <- "double"
  if (is.numeric(xyz) && is.null(dim(xyz)) && length(xyz) == 3) xyz <- matrix(xyz, 1)
  if (!is.numeric(xyz) || !is.matrix(xyz) || ncol(xyz) != 3) {
    refuse(sprintf("`xyz` is %s.", describe_shape(given)), remedy)
  }
  if (any(is.infinite(xyz))) refuse("`xyz` has infinite numbers.", "Mark what is missing as NA.")
  found <- located_points(mesh, xyz)
  columns <- found$columns[c("face", "w1", "w2", "w3", "x", "y", "z")]
  rows <- frame_of(c(columns, list(distance = found$distance)))
  if (!is.null(rownames(xyz))) rownames(rows) <- make.unique(rownames(xyz))
  rows
}

#' The closest place of a mesh to each of some points, in the columns of a point on a mesh
#'
#' @param mesh A `mesh3d` with triangles.
#' @param xyz n x 3 matrix in the mesh's unit; rows with NA give rows of NA.
#' @param ... As of [located_points()].
#' @return Data frame of n rows: `x, y, z`, `face` (column of `mesh$it`), `w1, w2, w3`, as in
#'   [locate()].
#' @noRd
surface_points <- function(mesh, xyz, ...) {
  frame_of(located_points(mesh, xyz, ...)$columns[mesh_columns])
}

#' @param few So many points are searched for among all faces: to build a tree takes as long (of
#'   5,000 to 120,000 faces).
#' @param leaf Faces in a box of the tree that is not divided further (speed only).
#' @return List: `columns` (list by column of a point on a mesh), `distance`.
#' @noRd
located_points <- function(mesh, xyz, few = 24L, leaf = 8L) {
  xyz <- matrix(as.numeric(xyz), ncol = 3)
  found <- cpp_locate(mesh$vb, mesh$it, xyz, if (nrow(xyz) <= few) ncol(mesh$it) else leaf)
  columns <- stats::setNames(
    lapply(1:6, function(i) found$at[, i]), c("x", "y", "z", "w1", "w2", "w3")
  )
  list(columns = c(columns, list(face = found$face)), distance = found$distance)
}

# n x 3 positions from faces and barycentric weights.
place_on_faces <- function(mesh, face, weight) {
  vertex <- t(mesh$vb[1:3, , drop = FALSE])
  corner <- function(i) vertex[mesh$it[i, face], , drop = FALSE]
  weight[, 1] * corner(1) + weight[, 2] * corner(2) + weight[, 3] * corner(3)
}

# n x k: the columns of faces whose centres are nearest, nearest first.
nearest_centres <- function(centre, xyz, k) {
  middle <- colMeans(centre)
  size <- max(abs(sweep(centre, 2, middle)), .Machine$double.xmin)
  unit <- function(x) sweep(x, 2, middle) / size
  near <- Rvcg::vcgKDtree(unit(centre), unit(xyz), k = k)$index
  matrix(near, nrow(xyz))
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

#' Lengths of shortest paths over a mesh from places to all vertices
#'
#' Approximate geodesic distances of Novotni and Klein (2002); see src/mesh_geodesic.h.
#'
#' @param mesh A `mesh3d`.
#' @param places Data frame with columns `face`, `w1`, `w2`, `w3`, a row a place.
#' @return Matrix, vertices x places, unit of the mesh; `Inf` where there is no way over edges.
#' @noRd
geodesic_distances <- function(mesh, places) {
  cpp_geodesic_distances(mesh$vb, mesh$it, columns_of(places, c("face", "w1", "w2", "w3")))
}
