# The one door for meshes: what passes it can be walked on, whoever made it.

#' A mesh as the kernels take it, or an error in the words of [specimen()]
#'
#' @param mesh A `mesh3d` or a specimen.
#' @return The `mesh3d`: `vb` with finite co-ordinates and a fourth row of 1, `it` integer, 3 x m,
#'   all its vertices there; without normals that do not fit.
#' @noRd
as_mesh <- function(mesh) {
  if (inherits(mesh, "specimen")) return(validate(mesh)$mesh)
  known <- passed_mesh(mesh, NULL)
  mesh[c("vb", "it")] <- list(known$vb, known$it)
  if (!is.null(mesh$normals) && !fits_vertices(mesh$normals, ncol(mesh$vb))) mesh$normals <- NULL
  mesh
}

#' What is known of a mesh that has passed the door
#'
#' What passed lately is known again by its place in memory: R changes no vector that something else
#' holds, so that a mesh that was touched in any way lies elsewhere.
#'
#' @param id Of its specimen, for errors.
#' @return Environment: `vb`, `it` (as kernels take them), `key`, `diagonal`; what was found right
#'   with this mesh is kept in it.
#' @noRd
passed_mesh <- function(mesh, id, most = 2) {
  if (!inherits(mesh, "mesh3d") || !is.list(mesh)) {
    refuse_mesh(sprintf("the mesh is %s, not a mesh3d.", describe_value(mesh)),
                "Give a mesh3d, as of Rvcg::vcgImport(), or a file to read_specimen().", id)
  }
  for (known in passed_meshes$last) {
    if (is_the_same(mesh$vb, known$given$vb) && is_the_same(mesh$it, known$given$it) &&
        length(mesh$ib) == 0) return(known)
  }
  # Vertices as a matrix of four rows, the fourth 1
  vb <- mesh$vb
  if (!is.numeric(vb) || !is.matrix(vb) || !nrow(vb) %in% 3:4 ||
      ncol(vb) < 3) refuse_no_vertices(id)
  vb <- as_doubles(vb)
  if (nrow(vb) == 3) vb <- rbind(vb, 1)
  if (!identical(range(vb[4, ]), c(1, 1))) {
    vb[1:3, ] <- vb[1:3, ] / rep(vb[4, ], each = 3)
    vb[4, ] <- 1
  }
  it <- face_matrix(mesh$it, 3, id)
  if (ncol(it) == 0 || length(mesh$ib)) {
    refuse_mesh(if (ncol(it) == 0) "the mesh has no triangles." else
                  "the mesh has quads beside its triangles.",
                "Pass it through specimen(), which mends what it can.", id)
  }
  faults <- cpp_mesh_faults(vb, it)
  if (faults$faces > 0) refuse_indices(it, ncol(vb), id)
  if (faults$vertices > 0) {
    refuse_mesh(sprintf("%d of %d vertices have non-finite co-ordinates, or absurd ones.",
                        faults$vertices, ncol(vb)),
                "Pass it through specimen(), which leaves them out, or export it again.", id)
  }
  sound <- list(vb = vb, it = it)
  known <- rlang::env(given = unclass(mesh)[c("vb", "it")], vb = vb, it = it,
                      key = mesh_key(sound), diagonal = mesh_diagonal(sound))
  passed_meshes$last <- utils::head(c(list(known), passed_meshes$last), most)
  known
}

passed_meshes <- new.env(parent = emptyenv())
passed_meshes$last <- list()

is_the_same <- function(a, b) rlang::is_reference(a, b)

refuse_no_vertices <- function(id) {
  refuse_mesh("the mesh has no vertices (`vb` must be 4 x n, n at least 3).",
              "Read or export it again.", id)
}

#' The mesh with the neighbours and normals of its vertices, as searches about vertices take it
#'
#' It is made when it is first asked for, and kept with what is known of the mesh.
#' @param known As of [passed_mesh()].
#' @return External pointer.
#' @noRd
mesh_graph <- function(known) {
  if (!cpp_points_somewhere(known$graph)) known$graph <- cpp_mesh_graph(known$vb, known$it)
  known$graph
}

#' Faces as an integer matrix with a column each
#'
#' @param corners Number of rows.
#' @noRd
face_matrix <- function(x, corners, id) {
  if (is.null(x) || length(x) == 0) return(matrix(0L, corners, 0))
  if (!is.numeric(x) || length(x) %% corners != 0 || !is.null(dim(x)) && dim(x)[1] != corners) {
    lying <- is.matrix(x) && ncol(x) == corners
    refuse_mesh(sprintf("the faces are not a numeric matrix of %d rows but %s.", corners,
                        describe_shape(x)),
                if (lying) "Give them a column each: t(mesh$it)." else
                  "Give `it` as 3 x m vertex numbers.", id)
  }
  if (is.double(x)) {
    part <- colSums(matrix(x != round(x), corners), na.rm = TRUE) > 0
    if (any(part)) {
      refuse_mesh(sprintf("%d of %d faces have corners that are not whole numbers.", sum(part),
                          length(part)),
                  "Give `it` as 3 x m vertex numbers, counted from 1.", id)
    }
  }
  if (is.integer(x) && identical(dim(x), c(corners, length(x) %/% corners)) &&
      is.null(dimnames(x))) return(x)
  matrix(suppressWarnings(as.integer(x)), corners)
}

#' @param n Number of vertices.
#' @noRd
refuse_indices <- function(it, n, id) {
  bad <- sum(colSums(is.na(it) | it < 1 | it > n) > 0)
  from_zero <- !anyNA(it) && min(it) == 0 && max(it) < n
  refuse_mesh(sprintf("%d of %d faces name vertices that do not exist%s.", bad, ncol(it),
                      if (from_zero) ": they are counted from 0" else ""),
              if (from_zero) "R counts from 1: mesh$it <- mesh$it + 1." else
                "The mesh is damaged: export or download it again.", id)
}

fits_vertices <- function(x, n) is.numeric(x) && is.matrix(x) && nrow(x) %in% 3:4 && ncol(x) == n

#' @exportS3Method
mesh_of.mesh3d <- function(x) list(key = passed_mesh(x, NULL)$key)

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
