# A scan as a cloud of representative points with normals and curvature, and its anchors: the
# strongest caps and cups.

#' Centroid and principal axes of points, as a rotation
#'
#' The axes' signs are free but for the turn's being proper: what is worked out by them must not
#' hang on two of them being turned round.
#'
#' @param xyz n x 3.
#' @return List: `centre` (3), `rotation` (3 x 3, axes in columns).
#' @noRd
principal_axes <- function(xyz) {
  centre <- colMeans(xyz)
  axes <- eigen(crossprod(sweep(xyz, 2, centre)), symmetric = TRUE)$vectors
  if (det(axes) < 0) axes[, 3] <- -axes[, 3]
  list(centre = centre, rotation = axes)
}

#' One vertex for each cell of a grid in the cloud's own principal axes
#'
#' Cells are laid about the centroid, so that neither pose nor the axes' signs matter.
#'
#' @param vertex n x 3.
#' @return Indices of the vertices nearest to the middles of their cells.
#' @noRd
cell_vertices <- function(vertex, cell) cell_groups(vertex, cell)$vertex

#' The same, with the number of the cell of each vertex
#' @return List: `vertex` (indices), `number` (n, indices among these).
#' @noRd
cell_groups <- function(vertex, cell) {
  axes <- principal_axes(vertex)
  turned <- sweep(vertex, 2, axes$centre) %*% axes$rotation
  at <- round(turned / cell)
  off <- row_lengths(turned - cell * at)
  at <- sweep(at, 2, apply(at, 2, min))
  span <- apply(at, 2, max) + 1
  key <- at[, 1] + span[1] * (at[, 2] + span[2] * at[, 3])
  group <- match(key, unique(key))
  sorted <- order(group, off)
  first <- sorted[!duplicated(group[sorted])]
  list(vertex = first, number = group)
}

#' The cloud that a scan is matched by
#'
#' Where its vertices lie farther apart than the cells, the centres of its triangles are points too.
#'
#' @param specimen A specimen.
#' @param scale Factor on its lengths: to the template's unit.
#' @param settings Of [find_settings()], in the template's unit.
#' @return List: `xyz`, `normal` (3 x n), `border` (n, logical), `coarse` (indices among n of a
#'   thinner cloud), `spacing` (lengths, of the cloud and of the thinner one), `corners` (3 x n: the
#'   vertices whose mean a point is), `mesh` (scaled).
#' @noRd
scan_cloud <- function(specimen, scale, settings) {
  mesh <- specimen$mesh
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] * scale
  n <- ncol(mesh$vb)
  corners <- matrix(rep(seq_len(n), each = 3), 3)
  sparse <- sum(row_lengths(face_normals(mesh))) / 2 > n * settings$cluster^2
  if (sparse) corners <- cbind(corners, mesh$it)
  xyz <- if (sparse) corner_means(mesh$vb[1:3, ], corners) else mesh$vb[1:3, ]
  kept <- cell_vertices(t(xyz), settings$cluster)
  corners <- corners[, kept, drop = FALSE]
  normal <- corner_means(mesh$normals[1:3, ], corners)
  normal <- normal / rep(pmax(sqrt(colSums(normal^2)), .Machine$double.xmin), each = 3)
  border <- seq_len(n) %in% border_vertices(mesh$it, specimen$geometry$twin)
  xyz <- xyz[, kept, drop = FALSE]
  list(xyz = xyz, normal = normal, border = corner_means(rbind(border), corners)[1, ] >= 2 / 3,
       coarse = cell_vertices(t(xyz), settings$coarse),
       spacing = c(settings$cluster, settings$coarse), corners = corners, mesh = mesh)
}

#' Means of vertices' values over the corners of points
#' @param x Rows by vertices; `corners` (3 x n). @return Rows by n.
#' @noRd
corner_means <- function(x, corners) {
  at <- function(i) x[, corners[i, ], drop = FALSE]
  (at(1) + at(2) + at(3)) / 3
}

#' A cloud with the curvature of its points: `k1`, `k2`, in balls of `feature`, 0 where there is
#' none
#'
#' Of a mesh that has very many vertices in such a ball, one for each cell stands for all.
#' @noRd
with_curvature <- function(cloud, settings, threads) {
  mesh <- cloud$mesh
  corners <- cloud$corners
  area <- sum(row_lengths(face_normals(mesh))) / 2
  full <- pi * settings$feature^2 * ncol(mesh$vb) / area / settings$ball_points
  if (full > 1) {
    cell <- settings$feature * sqrt(2 * pi / settings$ball_points)
    group <- cell_groups(t(mesh$vb[1:3, ]), cell)
    mesh <- thinned_mesh(mesh, group)
    corners[] <- group$number[corners]
  }
  vertex <- unique(c(corners))
  fine <- curvature(mesh, settings$feature, "adaptive cubic", threads, vertex)
  both <- corner_means(rbind(fine$k1, fine$k2), corners)
  both[is.na(both)] <- 0
  cloud$k1 <- both[1, ]
  cloud$k2 <- both[2, ]
  cloud
}

#' A mesh with one vertex for each cell, and the triangles whose corners are in three of them
#' @param group Of [cell_groups()].
#' @noRd
thinned_mesh <- function(mesh, group) {
  it <- matrix(group$number[mesh$it], 3)
  it <- it[, it[1, ] != it[2, ] & it[2, ] != it[3, ] & it[3, ] != it[1, ], drop = FALSE]
  least <- pmin(it[1, ], it[2, ], it[3, ])
  most <- pmax(it[1, ], it[2, ], it[3, ])
  key <- least + length(group$vertex) * most
  it <- it[, !duplicated(complex(real = key, imaginary = colSums(it) - least - most)), drop = FALSE]
  structure(list(vb = mesh$vb[, group$vertex, drop = FALSE],
                 normals = mesh$normals[, group$vertex, drop = FALSE], it = it),
            class = "mesh3d")
}

#' A cloud with `anchors`: its strongest caps and cups, apart from each other
#'
#' @return The cloud with `anchors`, a data frame `point`, `kind`, `size` with the attributes
#'   `frames` (3 x 3 each) and `places` (3 x anchors).
#' @noRd
with_anchors <- function(cloud, settings, threads) {
  vertex <- unique(cloud$corners[1, ])
  broad <- curvature(cloud$mesh, settings$bend, "quadratic", threads, vertex)
  broad <- lapply(unclass(broad), rows_at, vertex)
  xyz <- cloud$mesh$vb[1:3, vertex, drop = FALSE]
  found <- rbind(strongest_points(xyz, -broad$k1, "cap", settings),
                 strongest_points(xyz, broad$k2, "cup", settings))
  frames <- lapply(found$point, function(i) {
    normal <- broad$normal[i, ]
    first <- broad$direction1[i, ]
    cbind(first, cross_product(normal, first), normal)
  })
  cloud$anchors <- structure(found, frames = frames, places = xyz[, found$point, drop = FALSE])
  cloud
}

at_points <- function(points, at) {
  lapply(points, function(x) if (is.matrix(x)) x[, at, drop = FALSE] else x[at])
}

rows_at <- function(x, i) if (is.matrix(x)) x[i, , drop = FALSE] else x[i]

strongest_points <- function(xyz, size, kind, settings) {
  left <- which(!is.na(size) & size > settings$cap)
  left <- left[order(-size[left])]
  chosen <- integer()
  while (length(left) && length(chosen) < settings$anchors) {
    chosen <- c(chosen, left[1])
    gap <- sqrt(colSums((xyz[, left, drop = FALSE] - xyz[, left[1]])^2))
    left <- left[gap > settings$apart]
  }
  data.frame(point = chosen, kind = rep(kind, length(chosen)), size = size[chosen])
}

#' A cloud turned inside out
#' @noRd
inverted_cloud <- function(cloud) {
  cloud$normal <- -cloud$normal
  k1 <- cloud$k1
  cloud$k1 <- -cloud$k2
  cloud$k2 <- -k1
  if (is.null(cloud$anchors)) return(cloud)
  cloud$anchors$kind <- ifelse(cloud$anchors$kind == "cap", "cup", "cap")
  attr(cloud$anchors, "frames") <- lapply(
    attr(cloud$anchors, "frames"), function(f) cbind(f[, 2], f[, 1], -f[, 3])
  )
  cloud
}
