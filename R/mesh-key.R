# What a mesh is, in one string: by it points, paths and shapes know the mesh that their face numbers belong to.

#' Key of a mesh
#'
#' A hash of vertices and triangles, in their order. Normals, colours, names and the fourth row of `vb` do not count; whole
#' numbers are the same as integers and -0 as 0. A mesh that was moved, or whose triangles stand in another order, has
#' another key, for its faces have other numbers or places.
#'
#' @param mesh A `mesh3d` with `vb` and `it`, or a list of the two.
#' @return One string of 32 characters.
#' @noRd
mesh_key <- function(mesh) cpp_mesh_key(as_doubles(mesh$vb), as_integers(mesh$it))

# Matrices in the type of the kernel, without names.
as_doubles <- function(x) if (is.double(x)) x else structure(as.double(x), dim = dim(x))
as_integers <- function(x) if (is.integer(x)) x else structure(as.integer(x), dim = dim(x))
