# Triangles across each edge, and borders.

#' Which triangle lies across each edge
#'
#' @param mesh A `mesh3d` with triangles `it` (3 x m).
#' @return A list: `twin` 3 x m, the half edge across side c of triangle f (numbered 3 (f - 1) + c;
#'   0 at a border and at non-manifold edges); `piece`, length m, the edge-connected piece of each
#'   triangle; the counts `pieces`, `border_edges`, `nonmanifold_edges`.
#' @noRd
mesh_topology <- function(mesh) cpp_mesh_topology(mesh$it, ncol(mesh$vb))

# The topology is kept with the mesh as long as the faces stay as they are.
with_topology <- function(mesh) {
  if (is.null(mesh$topology)) mesh$topology <- mesh_topology(mesh)
  mesh
}

#' Vertices of the borders, and of edges that act as such, each once
#' @param it 3 x m; `twin`: of [mesh_topology()].
#' @noRd
border_vertices <- function(it, twin) {
  side <- which(twin == 0)
  unique(c(it[side], it[next_side(side)]))
}

# Half edge h runs from corner h of `it` to the next corner of the same face.
next_side <- function(h) ifelse(h %% 3 == 0, h - 2, h + 1)

border_sides <- function(topology) which(topology$twin == 0)

# Which way the triangles face: all alike, and outwards.

# Turns triangles so that neighbours agree. What agrees already moves as one: the pieces of the
# topology are the nodes of a graph whose links join pieces that meet against each other.
mend_winding <- function(mesh, id) {
  mesh <- with_topology(mesh)
  topology <- mesh$topology
  # Pairs of pieces (two columns) that share an edge run through in the same direction by both.
  side <- which(topology$twin == 0)
  a <- mesh$it[side]
  b <- mesh$it[next_side(side)]
  sorted <- order(pmin(a, b), pmax(a, b), method = "radix")
  edge <- cumsum(c(TRUE, diff(pmin(a, b)[sorted]) != 0 | diff(pmax(a, b)[sorted]) != 0))
  pair <- tabulate(edge)[edge] == 2
  piece <- matrix(topology$piece[(side[sorted[pair]] - 1) %/% 3 + 1], ncol = 2, byrow = TRUE)
  link <- unique(piece[piece[, 1] != piece[, 2], , drop = FALSE])
  if (!nrow(link)) return(mended(mesh, "faces wound against their neighbours", 0))
  # Walks the links breadth first: across a link the sense changes. What hangs together keeps the
  # sense of the greater part of its faces.
  size <- tabulate(topology$piece, topology$pieces)
  link <- rbind(link, link[, 2:1])
  turned <- rep(NA, length(size))
  turned[!seq_along(size) %in% link] <- FALSE
  for (seed in unique(link[, 1])) {
    if (!is.na(turned[seed])) next
    turned[seed] <- FALSE
    front <- seed
    reached <- seed
    while (length(front)) {
      step <- link[link[, 1] %in% front & is.na(turned[link[, 2]]), , drop = FALSE]
      step <- step[!duplicated(step[, 2]), , drop = FALSE]
      turned[step[, 2]] <- !turned[step[, 1]]
      front <- step[, 2]
      reached <- c(reached, front)
    }
    if (sum(size[reached] * (2 * turned[reached] - 1)) > 0) turned[reached] <- !turned[reached]
  }
  face <- which(turned[topology$piece])
  mended(turn_faces(mesh, face), "faces wound against their neighbours", length(face),
         "turned round")
}

turn_faces <- function(mesh, face) {
  if (!length(face)) return(mesh)
  mesh$it[2:3, face] <- mesh$it[3:2, face]
  mesh$topology <- NULL
  mesh
}

# `certainty`: a piece is turned where its outwardness is below minus this. Whole face scans score
# 0.55 to 0.85 (-0.55 to -0.85 inside out), a plane 0, a patch about the inner eye corner -0.57.
# Pieces nearer to 0 than it go with the largest.
turn_outward <- function(mesh, id, outward, certainty = 0.4) {
  check <- "faces looking inwards"
  if (outward == "keep") return(mended(mesh, check, 0))
  mesh <- with_topology(mesh)
  piece <- mesh$topology$piece
  normal <- face_normals(mesh)
  # For each piece the area-weighted mean of cos(normal, direction away from the mesh's centroid):
  # positive outside a closed surface, and on the outer side of an open, mainly convex one. Unlike
  # the signed volume a far rim counts no more than its area
  corner <- face_corners(mesh)
  middle <- (corner[[1]] + corner[[2]] + corner[[3]]) / 3
  area <- row_lengths(normal)
  away <- middle - rep(colSums(middle * area) / max(sum(area), .Machine$double.xmin),
                       each = nrow(middle))
  cosine <- row_products(normal, away) / pmax(row_lengths(away), .Machine$double.xmin)
  total <- pmax(rowsum(area, piece), .Machine$double.xmin)
  out <- as.vector(rowsum(cosine, piece) / total)
  size <- tabulate(piece)
  unclear <- abs(out) < certainty
  out[unclear] <- if (unclear[which.max(size)]) 0 else out[which.max(size)]
  inward <- outward == "flip" | out < -certainty
  face <- which(inward[piece])
  if (!length(face)) mesh$face_normals <- normal
  if (outward == "detect" && length(face)) {
    crestline_warn(
      sprintf("%d of %d triangles looked inwards and were turned round.", length(face),
              length(piece)),
      'If they were right (a hollow surface), give outward = "keep".', stage = "mesh", id = id
    )
  }
  mended(turn_faces(mesh, face), check, length(face), "turned round")
}

# Three m x 3 matrices, the corners of the faces.
face_corners <- function(mesh) {
  vertex <- t(mesh$vb[1:3, , drop = FALSE])
  lapply(1:3, function(i) vertex[mesh$it[i, ], , drop = FALSE])
}

# m x 3, twice the area long.
face_normals <- function(mesh) cpp_face_normals(mesh$vb, mesh$it)

# 4 x n unit normals of the vertices, area-weighted means of their faces' (as Rvcg's, in double
# precision); 0 where all faces are without area.
vertex_normals <- function(mesh) cpp_vertex_normals(mesh$vb, mesh$it)

# Triangles whose normal lies against those at their corners.
flipped_triangles <- function(xyz, it, normals) {
  corner <- function(x, i) x[it[i, ], , drop = FALSE]
  own <- cross_rows(corner(xyz, 2) - corner(xyz, 1), corner(xyz, 3) - corner(xyz, 1))
  which(rowSums(own * (corner(normals, 1) + corner(normals, 2) + corner(normals, 3))) < 0)
}
