#' Arc length and signed distance of the surface near a path
#'
#' Gives each vertex near a path two co-ordinates. `s` is the arc length at the closest place of the
#' path. `d` is the signed distance from that place. It is positive to the left of the path as seen
#' from outside (the side of normal x tangent).
#'
#' Only vertices that are connected to the path within the window and its margin are kept. Beyond
#' its ends the path is continued straight; vertices there have `s < 0` or `s` above the length.
#' Vertices in the margin are not used in fits. [lift()] needs them for a curve near the edge or the
#' ends of the window. A closed path has no ends: `s` runs from 0 to its length.
#'
#' @param specimen A [specimen()] or `mesh3d`.
#' @param path A `mesh_path` on that mesh, as of [plane_path()] or [reference_path()].
#' @param width Half width of the window, in the unit of the mesh.
#' @param margin Width of the strip outside the window in which vertices are kept, in the unit of
#'   the mesh.
#' @return Object of class `path_coordinates`: a data frame with a row for each vertex. Its columns
#'   are `vertex` (index), `s`, `d` (unit of the mesh), `inside` (FALSE in the margin), and `tx`,
#'   `ty`, `tz` (unit tangent of the path at the closest place). Its attributes are `length` (of the
#'   path), `width`, `key` and `id` (of the mesh).
#' @section Errors: of class `crestline_wrong_mesh`, when the path belongs to another mesh.
#' @template glossary
#' @templateVar where section 3.2
#' @template paper
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' path <- plane_path(ball, c(1, 0, 0), c(0, 1, 0))
#' head(path_coordinates(ball, path, width = 0.2))
#' @export
path_coordinates <- function(specimen, path, width, margin = width) {
  check_given()
  check_surface(specimen, "specimen")
  check_class(path, "mesh_path", "path", "plane_path() or reference_path()")
  check_number(width, "width", lower = 0, open = TRUE)
  margin <- check_number(margin, "margin", lower = 0)
  check_path_on(path, specimen, "`path`")
  near_path(walkable(specimen), path, width, margin)
}

#' Arc length and signed distance near a path, without checks
#'
#' @param scan As of [walkable()]; the others as in [path_coordinates()].
#' @noRd
near_path <- function(scan, path, width, margin) {
  clear <- without_stubs(path)
  track <- t(columns_of(clear, c("x", "y", "z")))
  length <- attr(path, "length")
  found <- cpp_near_path(mesh_graph(scan$passed), track, path_normals(scan, clear), is_closed(path),
                         path$face, width, margin, length)
  inside <- found$s >= 0 & found$s <= length & abs(found$d) <= width
  columns <- list(vertex = found$vertex, s = found$s, d = found$d, inside = inside,
                  tx = found$tangent[, 1], ty = found$tangent[, 2], tz = found$tangent[, 3])
  new_path_coordinates(columns, length, width, scan, if (is_closed(path)) TRUE)
}

#' @param columns List of the columns that [path_coordinates()] says.
#' @param mesh As of [mesh_of()].
#' @param closed TRUE of a closed path, else NULL.
#' @noRd
new_path_coordinates <- function(columns, length, width, mesh, closed = NULL) {
  frame_of(columns, length = length, width = width, key = mesh$key, id = mesh$id, closed = closed,
           class = "path_coordinates")
}

#' Refuse co-ordinates without their columns, length or width
#' @noRd
validate_path_coordinates <- function(x) {
  columns <- c("vertex", "s", "d", intersect(c("tx", "ty", "tz"), names(x)))
  one <- function(value) is.numeric(value) && length(value) == 1 && is.finite(value)
  right <- is.data.frame(x) && all(c(columns, "inside") %in% names(x)) && is.logical(x$inside) &&
    all(vapply(unclass(x)[columns], function(column) is.numeric(column) && all(is.finite(column)),
               NA)) &&
    one(attr(x, "length")) && one(attr(x, "width"))
  if (right) return(invisible(x))
  crestline_abort("the co-ordinates lack columns, the path's length or the window's width.",
                  "Give what path_coordinates() returns, whole.", stage = "path",
                  id = attr(x, "id"), call = NULL)
}

#' @exportS3Method
validate.path_coordinates <- function(x) validate_path_coordinates(x)

#' Refuse co-ordinates of the vertices of another mesh
#' @noRd
check_coordinates_on <- function(coordinates, mesh, name) {
  check_same_mesh(coordinates, mesh, name)
  vertex <- coordinates$vertex
  if (all(vertex == round(vertex) & vertex >= 1 &
          vertex <= ncol(as_mesh(mesh)$vb))) return(invisible(coordinates))
  crestline_abort(sprintf("%s names vertices that the mesh does not have.", name),
                  "Give what path_coordinates() returns, whole.",
                  stage = "path", id = mesh_of(mesh)$id, class = "crestline_wrong_mesh",
                  call = NULL)
}

#' A path without the crossings next to its ends
#'
#' An end at a corner or on an edge of the mesh is moved inside its triangle for the walk, so that
#' the first crossing may be next to it, in any direction; the path's direction at its ends is that
#' beyond.
#'
#' @return Data frame of its rows, not a path: their arc lengths are those of the whole.
#' @param stub Arc length below which a crossing is next to an end, as a share of the path's length.
#' @noRd
without_stubs <- function(path, stub = 1e-5) {
  least <- stub * attr(path, "length")
  beyond <- path$s > least & path$s < attr(path, "length") - least
  frame_of(lapply(unclass(path)[c("s", mesh_columns)], `[`, c(1, which(beyond), nrow(path))))
}

#' Surface normals along a path: the vertices' normals weighted as the points are, 3 x k
#' @noRd
path_normals <- function(mesh, path) {
  normals <- mesh$normals
  if (is.null(normals)) normals <- vertex_normals(mesh)
  corner <- function(i, w) normals[1:3, mesh$it[i, path$face], drop = FALSE] * rep(w, each = 3)
  corner(1, path$w1) + corner(2, path$w2) + corner(3, path$w3)
}
