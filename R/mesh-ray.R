# Where a ray meets a mesh first: the place that a click shows.

#' The first place of a mesh on a ray
#'
#' Every face is tried (Moeller and Trumbore's test) in double precision, from either side.
#'
#' @param mesh A `mesh3d` with triangles.
#' @param from,towards Where the ray begins, and a place that it passes: three co-ordinates each, in
#'   the mesh's unit.
#' @param slack How far beyond its edges a face still counts (in barycentric weights), so that no
#'   ray slips through between two of them.
#' @return One-row data frame as of [surface_points()]; NULL where the ray meets nothing.
#' @noRd
mesh_on_ray <- function(mesh, from, towards, slack = 1e-9) {
  corners <- face_corners(mesh)
  n <- nrow(corners[[1]])
  along <- matrix(unit_vector(towards - from), n, 3, byrow = TRUE)
  side <- list(corners[[2]] - corners[[1]], corners[[3]] - corners[[1]])
  start <- matrix(from, n, 3, byrow = TRUE) - corners[[1]]
  across <- cross_rows(along, side[[2]])
  turned <- cross_rows(start, side[[1]])
  det <- row_products(side[[1]], across)
  weight <- cbind(row_products(start, across), row_products(along, turned)) / det
  weight <- cbind(1 - rowSums(weight), weight)
  distance <- row_products(side[[2]], turned) / det
  met <- which(is.finite(distance) & distance >= 0 & rowSums(weight >= -slack) == 3)
  if (!length(met)) return(NULL)
  face <- met[which.min(distance[met])]
  weight <- pmax(weight[face, , drop = FALSE], 0)
  weight <- weight / sum(weight)
  at <- place_on_faces(mesh, face, weight)
  data.frame(x = at[1], y = at[2], z = at[3], face = face, w1 = weight[1], w2 = weight[2],
             w3 = weight[3])
}
