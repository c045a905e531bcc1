# The same drawing in an rgl scene, which can be turned.

rgl_surface <- function(mesh, colour, rotation, ..., zoom = 0.8) {
  if (rgl::cur3d() == 0) rgl::open3d()
  look <- utils::modifyList(list(specular = "#202020", polygon_offset = 1), list(...))
  corners <- list(t(mesh$vb[1:3, , drop = FALSE]), normals = t(mesh$normals[1:3, , drop = FALSE]),
                  indices = mesh$it)
  id <- do.call(rgl::triangles3d, c(corners, list(color = colour), look))
  rgl::par3d(userMatrix = rbind(cbind(rotation, 0), c(0, 0, 0, 1)), FOV = 15, zoom = zoom)
  rgl::aspect3d("iso")
  structure(list(ids = as.vector(unclass(id)), diagonal = mesh_diagonal(mesh)), class = "rgl_scene")
}

add_ids <- function(scene, ids) {
  scene$ids <- c(scene$ids, as.vector(unclass(ids)))
  invisible(scene)
}

#' @export
draw_lines.rgl_scene <- function(scene, x, colour = "black", width = 2, halo = NA, name = NULL) {
  add_ids(scene, rgl::lines3d(point_matrix(x), color = colour, lwd = width, lit = FALSE))
}

#' @export
draw_points.rgl_scene <- function(scene, x, colour = "black", size = 1, halo = NA, labels = NULL,
                                  name = NULL) {
  x <- point_matrix(x)
  scene <- add_ids(scene, rgl::spheres3d(
    x, radius = size * scene$diagonal / 400, color = colour, specular = "black"
  ))
  if (is.null(labels)) return(invisible(scene))
  add_ids(scene, rgl::text3d(
    x, texts = labels, color = colour, cex = 0.7 * size, adj = c(-0.5, 0.5), lit = FALSE,
    depth_test = "always"
  ))
}

#' @export
draw_band.rgl_scene <- function(scene, left, right, colour = "black", opacity = 0.4) {
  left <- point_matrix(left)
  right <- point_matrix(right)
  i <- seq_len(nrow(left) - 1)
  corners <- rbind(i, i + 1, i + nrow(left) + 1, i + nrow(left))
  strip <- rgl::mesh3d(vertices = t(rbind(left, right)), quads = corners)
  add_ids(scene, rgl::shade3d(strip, color = colour, alpha = opacity, lit = FALSE))
}

#' @export
print.rgl_scene <- function(x, ...) {
  check_method_dots(...)
  cat("<rgl_scene> ", amount(length(x$ids), "object"), "\n", sep = "")
  invisible(x)
}

#' @export
print.picture_scene <- function(x, ...) {
  check_method_dots(...)
  cat("<picture_scene>", nrow(x$depth), "x", ncol(x$depth), "pixels, one pixel =",
      format(x$pixel, digits = 3), "units\n")
  invisible(x)
}
