# Triangles across each edge, borders, and ways over edges.

#' Which triangle lies across each edge
#'
#' @param mesh A `mesh3d` with triangles `it` (3 x m).
#' @return A list: `twin` 3 x m, the half edge across side c of triangle f (numbered 3 (f - 1) + c;
#'   0 at a border and at non-manifold edges); `piece`, length m, the edge-connected piece of each
#'   triangle; the counts `pieces`, `border_edges`, `nonmanifold_edges`.
#' @noRd
mesh_topology <- function(mesh) cpp_mesh_topology(mesh$it, ncol(mesh$vb))

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
