# The frame in which a browser draws: near the origin, of one size, whatever the unit of the mesh.

#' The frame of the scene: the middle of a box, and a diagonal of 200
#'
#' rgl works in single precision, and paints balls black whose radius is far below 1: neither a scan
#' in metres nor one far from its origin is to suffer.
#' @noRd
scene_frame <- function(mesh, diagonal = 200) points_frame(t(mesh$vb[1:3, ]), diagonal)

points_frame <- function(xyz, diagonal = 200) {
  range <- apply(xyz, 2, range, na.rm = TRUE)
  size <- sqrt(sum((range[2, ] - range[1, ])^2))
  list(middle = unname(colMeans(range)), scale = diagonal / if (size > 0) size else 1)
}

#' Points, n x 3, into the frame of the scene and back
#' @noRd
into_scene <- function(xyz, frame) sweep(xyz, 2, frame$middle) * frame$scale
from_scene <- function(xyz, frame) sweep(xyz / frame$scale, 2, frame$middle, `+`)

with_normals <- function(mesh) {
  if (is.null(mesh$normals)) mesh$normals <- vertex_normals(mesh)
  mesh
}
