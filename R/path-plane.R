#' Plane cut of a surface between two points
#'
#' The plane contains both points and is turned about the axis through them by
#' `angle`; at angle 0 it also contains the mean of the surface normals at the two
#' points, so that it cuts straight into the surface. The cut is walked from
#' triangle to triangle, from the first point until the second is reached.
#'
#' @param mesh A `specimen` or a `mesh3d`.
#' @param from,to Name of a landmark (with a `specimen`), or a position: three
#'   co-ordinates, put on the surface.
#' @param angle Angle of the plane in radians, in (-pi/2, pi/2]; positive turns
#'   right-handed about the axis from `from` to `to`.
#' @param side 0 when the path leaves `from` on the side of `to`, 1 for the way
#'   round the other side of the object.
#' @param reach A cut that gets further from the straight line between the points
#'   than this share of its length is given up; `Inf` for no limit.
#' @return A `mesh_path`: data frame of the points where the plane crosses the edges of
#'   the mesh, from `from` to `to`, with columns `s` (arc length, in the unit of the
#'   mesh), `x`, `y`, `z`, `face` (the triangle in which the segment that ends at the
#'   point lies) and barycentric weights `w1`, `w2`, `w3` there; attributes `length`,
#'   `angle`, `side`.
#' @section Errors: of class `crestline_path_error`, when the cut ends at a border
#'   of the mesh (a hole between the points) or comes round without meeting `to`.
#' @template glossary
#' @templateVar where section 3.1
#' @template paper
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' quarter <- plane_path(ball, c(1, 0, 0), c(0, 1, 0), angle = 0)
#' attr(quarter, "length") # about pi / 2
#' @export
plane_path <- function(mesh, from, to, angle = 0, side = 0, reach = Inf) {
  check_given()
  check_surface(mesh, "mesh")
  check_ends(from = from, to = to)
  check_number(angle, "angle")
  check_number(side, "side", lower = 0, upper = 1)
  reach <- check_reach(reach)
  scan <- walkable(mesh)
  in_context(cut_path(scan, located_ends(mesh, scan, from, to), angle, side, reach), scan$id)
}

#' One plane cut as a path, or a failure
#'
#' @param scan As of [walkable()].
#' @param ends As of [path_ends()]; a failure is handed on.
#' @param angle,side,reach As in [plane_path()].
#' @param ... Attributes of the path.
#' @noRd
cut_path <- function(scan, ends, angle, side, reach, ...) {
  if (failed(ends)) return(ends)
  found <- cpp_plane_path(scan$vb, scan$it, scan$twin, ends$from, ends$to,
                          plane_normal(ends, angle), side, reach * ends$span)
  if (found$end != "arrived") return(failed_cut(found$end, ends, scan$id))
  path_through(rbind(ends$exact[1, ], found$points, ends$exact[2, ]), scan, angle = angle,
               side = side, ...)
}

#' A mesh as walks need it, from a specimen (kept) or a mesh (worked out)
#'
#' @return List: `vb`, `it` (as kernels take them), `normals` (NULL where the mesh has none),
#'   `twin`, `piece` of [mesh_topology()], `key`, `diagonal`, `id`. It serves as a mesh too.
#' @noRd
walkable <- function(mesh) {
  whole <- as_mesh(mesh)
  known <- passed_mesh(whole, NULL)
  geometry <- if (inherits(mesh, "specimen")) mesh$geometry else
    mesh_topology(whole)[c("twin", "piece")]
  list(vb = known$vb, it = known$it, normals = whole$normals, twin = geometry$twin,
       piece = geometry$piece, key = known$key, diagonal = known$diagonal,
       id = if (inherits(mesh, "specimen")) mesh$id)
}

#' The ends of a path, from names of landmarks and positions as a user gives them
#' @noRd
located_ends <- function(mesh, scan, from, to) {
  path_ends(scan, rbind(end_vector(mesh, scan, from, "from"), end_vector(mesh, scan, to, "to")),
            c(end_name(from), end_name(to)))
}

#' Both ends of a path: in different places, on one piece of the mesh
#'
#' @param exact 2 x 7 matrix, columns as `mesh_columns`.
#' @param names What the ends are called.
#' @param inside Barycentric weight by which ends are kept off edges and corners, so
#'   that a plane through an end always crosses its triangle. The path begins and
#'   stops at the exact places.
#' @return List: `from`, `to` (face, w1, w2, w3, moved inside), `exact`, `names`; of the axis
#'   between the moved ends `axis` and `across` (unit vectors; the plane at angle 0 contains
#'   `axis` and is normal to `across`) and `span` (its length). Or a failure.
#' @noRd
path_ends <- function(scan, exact, names, inside = 1e-6) {
  refuse <- function(said, remedy) {
    no_result(sprintf(said, names[1], names[2]), remedy, "path", scan$id, "crestline_path_error")
  }
  if (all(exact[1, 1:3] == exact[2, 1:3])) {
    return(refuse("%s and %s are the same point.",
                  "Choose two different landmarks, or correct the one that was misplaced."))
  }
  if (scan$piece[exact[1, "face"]] != scan$piece[exact[2, "face"]]) {
    return(refuse("%s and %s lie on different pieces of the mesh.",
                  "Join the pieces (fill the gap), or move the landmark to the main piece."))
  }
  moved <- function(at) c(at[4], (at[5:7] + inside) / sum(at[5:7] + inside))
  from <- moved(exact[1, ])
  to <- moved(exact[2, ])
  axis <- cpp_cut_axis(scan$vb, scan$it, scan$twin, from, to)
  if (axis$span == 0) {
    return(refuse("%s and %s are too near to each other for the size of their triangle.",
                  "Check the mesh for huge triangles, and the two landmarks."))
  }
  list(from = from, to = to, exact = exact, names = names, axis = axis$axis, across = axis$across,
       span = axis$span)
}

#' Normals of the planes at given angles, 3 x k
#'
#' @param ends List with `axis` and `across`, as of [path_ends()].
#' @noRd
plane_normal <- function(ends, angle) {
  turned <- cross_product(ends$axis, ends$across)
  outer(ends$across, cos(angle)) + outer(turned, sin(angle))
}

#' A path through points that follow one another on the mesh; of neighbours at one place the later
#' goes, but not the last
#'
#' @param points k x 7 matrix.
#' @param mesh The mesh that they lie on: list of `key` and `id`, as of [walkable()] or [mesh_of()].
#' @param ... Attributes of the path.
#' @noRd
path_through <- function(points, mesh = NULL, ...) {
  step <- unname(row_lengths(points[-1, 1:3, drop = FALSE] -
                             points[-nrow(points), 1:3, drop = FALSE]))
  kept <- c(TRUE, step[-length(step)] > 0, TRUE)[seq_len(nrow(points))]
  columns <- lapply(1:7, function(i) as.vector(points[kept, i]))
  columns[[4]] <- as.integer(columns[[4]])
  columns <- c(list(c(0, cumsum(step))[kept]), columns)
  new_mesh_path(stats::setNames(columns, c("s", mesh_columns)), sum(step), mesh$key, mesh$id, ...)
}

#' A path from its parts: all its attributes are declared here
#'
#' @param columns List of `s` and the columns of points on a mesh.
#' @param length In the unit of the mesh.
#' @param key,id Of the mesh that its faces are numbers of, and of the specimen; NULL where there is
#'   none.
#' @param angle,side Of a plane cut.
#' @param type,criterion,optima,competing Of a reference path.
#' @param trusted Arc lengths between which it is believed.
#' @param lifted Whether a lifted curve was walked in one.
#' @noRd
new_mesh_path <- function(columns, length, key = NULL, id = NULL, angle = NULL, side = NULL,
                          type = NULL, criterion = NULL,
                          optima = NULL, competing = NULL, trusted = NULL, lifted = NULL) {
  frame_of(columns, length = length, key = key, id = id, angle = angle, side = side, type = type,
           criterion = criterion,
           optima = optima, competing = competing, trusted = trusted, lifted = lifted,
           class = "mesh_path")
}

#' Refuse a path without its columns, length or order
#' @noRd
validate_mesh_path <- function(x) {
  at <- if (is.data.frame(x)) place_columns(x)
  length <- attr(x, "length")
  right <- !is.null(at) && nrow(at) >= 2 && is.numeric(x$s) && !is.unsorted(x$s, na.rm = FALSE) &&
    is.numeric(length) && length(length) == 1 && is.finite(length)
  if (isTRUE(right)) return(invisible(x))
  crestline_abort("the path lacks co-ordinates, faces, weights, rising arc lengths `s`, or its length.",
                  "Give a path as plane_path() or reference_path() returns it, whole.",
                  stage = "path", id = attr(x, "id"),
                  class = "crestline_path_error", call = NULL)
}

#' @exportS3Method
validate.mesh_path <- function(x) validate_mesh_path(x)

#' Refuse a path that does not lie on a mesh
#'
#' @param mesh The specimen or mesh that it is to be used with.
#' @noRd
check_path_on <- function(path, mesh, name) {
  if (!is.null(attr(path, "key"))) check_same_mesh(path, mesh, name)
  check_places(path, passed_mesh(as_mesh(mesh), NULL), name, mesh_of(mesh)$id)
}

failed_cut <- function(end, ends, id) {
  why <- switch(end, border = "meets a border of the mesh",
                round = "does not come to the second point",
                "too far" = "strays too far from the axis")
  no_result(sprintf("the plane cut from %s to %s %s.", ends$names[1], ends$names[2], why),
              "Fill the hole between them, try another angle, or check the two landmarks.", "path",
              id, "crestline_path_error")
}

#' @export
print.mesh_path <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<mesh_path> %d points, length %.4g", nrow(x), attr(x, "length")))
    if (!is.null(attr(x, "angle"))) cat(sprintf(", angle %.1f degrees",
                                                attr(x, "angle") * 180 / pi))
    cat("\n")
    optima <- attr(x, "optima")
    if (!is.null(optima)) {
      cat("Local optima:\n")
      print(utils::head(optima, 6), digits = 3, row.names = FALSE)
    }
    invisible(x)
  })
}
