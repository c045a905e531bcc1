# Triangles across each edge, and borders.

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
