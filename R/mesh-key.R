# What a mesh is, in one string: by it points, paths and shapes know the mesh that their face
# numbers belong to.

#' Key of a mesh
#'
#' A hash of vertices and triangles, in their order. Normals, colours, names and the fourth row of
#' `vb` do not count; whole numbers are the same as integers and -0 as 0. A mesh that was moved, or
#' whose triangles stand in another order, has another key, for its faces have other numbers or
#' places.
#'
#' @param mesh A `mesh3d` with `vb` and `it`, or a list of the two.
#' @return One string of 32 characters.
#' @noRd
mesh_key <- function(mesh) {
  it <- mesh$it
  if (!is.integer(it)) it <- structure(as.integer(it), dim = dim(it))
  cpp_mesh_key(as_doubles(mesh$vb), it)
}

# Matrices in the type of the kernel, without names.
as_doubles <- function(x) if (is.double(x)) x else structure(as.double(x), dim = dim(x))

#' The mesh that something belongs to
#'
#' @param x A specimen, shape or curve (fields), or a path, its co-ordinates or a curvature
#'   (attributes).
#' @return List: `key` (NULL where it is not known), `id` (NULL where it has none).
#' @noRd
mesh_of <- function(x) UseMethod("mesh_of")

#' @exportS3Method
mesh_of.default <- function(x) list(key = attr(x, "key"), id = attr(x, "id"))

#' Refuse what was made on another mesh
#'
#' @param x What has faces or vertices, see [mesh_of()].
#' @param mesh The specimen or mesh that it is to be used with.
#' @param name What `x` is called.
#' @noRd
check_same_mesh <- function(x, mesh, name) {
  expected <- mesh_of(x)
  came <- mesh_of(mesh)
  if (is.null(expected$key)) {
    crestline_abort(
      sprintf("%s does not know the mesh that it was made on%s.", name,
              if (is.null(expected$id)) "" else paste(", of", expected$id)),
      paste("It comes from an older version of the package, or from elsewhere:",
            "make it anew on the mesh that you have."),
      stage = "mesh", id = came$id, class = "crestline_wrong_mesh", call = NULL
    )
  }
  if (identical(expected$key, came$key)) return(invisible(x))
  crestline_abort(
    sprintf("%s belongs to %s; here is %s.", name, mesh_words(expected), mesh_words(came)),
    paste("Give its own mesh, with the same vertices and triangles in the same order,",
          "or make it anew on the mesh that you have."),
    stage = "mesh", id = came$id, class = "crestline_wrong_mesh", call = NULL
  )
}

mesh_words <- function(mesh, digits = 8) {
  sprintf("%s (key %s)",
          if (is.null(mesh$id)) "a mesh without an id" else paste("the mesh of", mesh$id),
          substr(mesh$key, 1, digits))
}

#' Refuse points whose faces, weights and co-ordinates do not agree with a mesh
#'
#' @param points Data frame or matrix with the columns `x`, `y`, `z`, `face`, `w1`, `w2`, `w3`; rows
#'   without a face are passed over.
#' @param known The mesh, as of [passed_mesh()].
#' @param name What they are called.
#' @param id Of the mesh.
#' @param tolerance Greatest distance of a place from its co-ordinates, as a share of the mesh's
#'   diagonal.
#' @noRd
check_places <- function(points, known, name, id = NULL, tolerance = 1e-6) {
  at <- place_columns(points)
  problem <- if (is.null(at)) {
    "lack co-ordinates, faces or weights"
  } else {
    misplaced(at[!is.na(at[, "face"]), , drop = FALSE], known, tolerance * known$diagonal)
  }
  if (is.null(problem)) return(invisible(points))
  crestline_abort(sprintf("points of %s %s.", name, problem),
                  paste0("They were made on another mesh, or changed since: make them anew, or ",
                         "give three co-ordinates."),
                  stage = "mesh", id = id, class = "crestline_wrong_mesh", call = NULL)
}

#' The seven columns of points as a numeric matrix, NULL where they have them not
#' @noRd
place_columns <- function(points) {
  if (is.matrix(points)) {
    points <- if (all(mesh_columns %in% colnames(points))) as.data.frame(points)
  }
  columns <- if (is.list(points)) unclass(points)[mesh_columns]
  if (length(columns) && all(vapply(columns, is.numeric, NA))) do.call(cbind, columns)
}

#' What is wrong with places on a mesh, NULL where they are right
#' @noRd
misplaced <- function(at, mesh, tolerance) {
  face <- at[, "face"]
  if (any(face != round(face) | face < 1 |
          face > ncol(mesh$it))) return("name faces that the mesh does not have")
  if (!all(is.finite(at))) return("lack co-ordinates or weights")
  # As place_on_faces(), at the cost of the points alone.
  weight <- at[, c("w1", "w2", "w3"), drop = FALSE]
  corner <- function(i) t(mesh$vb[1:3, mesh$it[i, face], drop = FALSE])
  place <- weight[, 1] * corner(1) + weight[, 2] * corner(2) + weight[, 3] * corner(3)
  away <- row_lengths(place - at[, c("x", "y", "z"), drop = FALSE])
  if (any(away > tolerance)) {
    return(sprintf(paste0("are up to %.3g away from where their faces ", "are on this mesh"),
                   max(away)))
  }
  if (any(at[, c("w1", "w2", "w3")] < -1e-6)) "have negative weights"
}
