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
