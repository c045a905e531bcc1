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
#' @references Vittert, Bowman and Katina (2019), "the paper" (see [crestline-package]), section 3.1.
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' quarter <- plane_path(ball, c(1, 0, 0), c(0, 1, 0), angle = 0)
#' attr(quarter, "length") # about pi / 2
#' @export
plane_path <- function(mesh, from, to, angle = 0, side = 0, reach = Inf) {
  check_given()
  check_surface(mesh, "mesh")
  check_ends(from = from, to = to)
  surface <- walkable(mesh)
  ends <- path_ends(mesh, surface, from, to)
  check_number(angle, "angle")
  check_number(side, "side", lower = 0, upper = 1)
  cut_path(surface, ends, cut_axis(surface, ends), angle, side, check_reach(reach))
}

#' One plane cut as a path
#'
#' @param surface,ends,axis As of [walkable()], [path_ends()] and [cut_axis()].
#' @param angle,side,reach As in [plane_path()].
#' @param ... Attributes of the path.
#' @noRd
cut_path <- function(surface, ends, axis, angle, side, reach, ...) {
  found <- cpp_plane_path(surface$vb, surface$it, surface$twin, ends$from, ends$to, plane_normal(axis, angle), side,
                          reach * axis$span)
  if (found$end != "arrived") abort_cut(found$end, ends, surface$id)
  new_path(found$points, ends, angle = angle, side = side, ...)
}

#' The arrays that walks need, from a specimen (kept) or a mesh (worked out)
#' @noRd
walkable <- function(mesh) {
  whole <- as_mesh(mesh)
  geometry <- if (inherits(mesh, "specimen")) mesh$geometry else mesh_topology(whole)[c("twin", "piece")]
  list(vb = whole$vb, it = whole$it, twin = geometry$twin, piece = geometry$piece,
       id = if (inherits(mesh, "specimen")) mesh$id)
}

#' Both ends of a path: located, in different places, on one piece of the mesh
#'
#' @param inside Barycentric weight by which ends are kept off edges and corners, so
#'   that a plane through an end always crosses its triangle. The path begins and
#'   stops at the exact places.
#' @return List: `from`, `to` (face, w1, w2, w3, moved inside), `exact` (2 x 7 matrix), `names`.
#' @noRd
path_ends <- function(mesh, surface, from, to, inside = 1e-6) {
  exact <- rbind(end_vector(mesh, from, "from"), end_vector(mesh, to, "to"))
  names <- c(end_name(from), end_name(to))
  if (all(exact[1, 1:3] == exact[2, 1:3])) {
    crestline_abort(sprintf("%s and %s are the same point.", names[1], names[2]),
                    "Choose two different landmarks, or correct the one that was misplaced.",
                    stage = "path", id = surface$id, class = "crestline_path_error", call = NULL)
  }
  if (surface$piece[exact[1, "face"]] != surface$piece[exact[2, "face"]]) {
    crestline_abort(sprintf("%s and %s lie on different pieces of the mesh.", names[1], names[2]),
                    "Join the pieces (fill the gap), or move the landmark to the main piece.",
                    stage = "path", id = surface$id, class = "crestline_path_error", call = NULL)
  }
  moved <- function(at) c(at[4], (at[5:7] + inside) / sum(at[5:7] + inside))
  list(from = moved(exact[1, ]), to = moved(exact[2, ]), exact = exact, names = names)
}

#' An end of a path as one row of its columns
#' @noRd
end_vector <- function(mesh, at, name) {
  if (is.numeric(at) && identical(names(at), mesh_columns)) return(at)
  unlist(unclass(end_point(mesh, at, name))[mesh_columns])
}

end_point <- function(mesh, at, name) {
  if (is.character(at) && inherits(mesh, "specimen")) {
    known <- rownames(mesh$landmarks)
    if (!all(at %in% known)) {
      refuse_landmarks(sprintf("`%s`: there is no landmark %s.", name, describe_value(at)), near_names(at, known), mesh$id)
    }
    return(landmark_point(mesh, at))
  }
  if (is.data.frame(at) && all(mesh_columns[-(1:3)] %in% names(at)) && nrow(at) == 1) return(at[mesh_columns])
  if (!is.numeric(at) || length(at) != 3 || !all(is.finite(at))) {
    crestline_abort(sprintf("`%s` is %s.", name, describe_value(at)),
                    "Give the name of a landmark of a specimen, or three finite co-ordinates.",
                    stage = "path", class = "crestline_path_error", call = NULL)
  }
  surface_points(as_mesh(mesh), matrix(at, 1))
}

end_name <- function(at) {
  if (is.character(at)) return(at)
  sprintf("(%s)", paste(signif(unlist(at[1:3]), 4), collapse = ", "))
}

#' Axis between the ends (moved inside their triangles), and the plane normal at angle 0
#' @return List: `axis` and `across` (unit vectors), `span` (length).
#' @noRd
cut_axis <- function(surface, ends) {
  axis <- cpp_cut_axis(surface$vb, surface$it, surface$twin, ends$from, ends$to)
  if (axis$span == 0) {
    crestline_abort(sprintf("%s and %s are too near to each other for the size of their triangle.",
                            ends$names[1], ends$names[2]),
                    "Check the mesh for huge triangles, and the two landmarks.",
                    stage = "path", id = surface$id, class = "crestline_path_error", call = NULL)
  }
  axis
}

#' Normals of the planes at given angles, 3 x k
#' @noRd
plane_normal <- function(axis, angle) {
  turned <- cross_product(axis$axis, axis$across)
  outer(axis$across, cos(angle)) + outer(turned, sin(angle))
}

cross_product <- function(a, b) {
  c(a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1])
}

#' A path from the crossings of a walk
#'
#' @param crossings k x 7.
#' @param ends As of [path_ends()].
#' @noRd
new_path <- function(crossings, ends, ...) path_through(rbind(ends$exact[1, ], crossings, ends$exact[2, ]), ...)

#' A path through points that follow one another on the mesh; of neighbours at one place the later goes, but not the last
#'
#' @param points k x 7 matrix.
#' @param ... Attributes of the path.
#' @noRd
path_through <- function(points, ...) {
  step <- unname(row_lengths(points[-1, 1:3, drop = FALSE] - points[-nrow(points), 1:3, drop = FALSE]))
  kept <- c(TRUE, step[-length(step)] > 0, TRUE)[seq_len(nrow(points))]
  columns <- lapply(1:7, function(i) as.vector(points[kept, i]))
  columns[[4]] <- as.integer(columns[[4]])
  columns <- c(list(c(0, cumsum(step))[kept]), columns)
  frame_of(stats::setNames(columns, c("s", mesh_columns)), length = sum(step), ..., class = "mesh_path")
}

abort_cut <- function(end, ends, id) {
  why <- switch(end, border = "meets a border of the mesh", round = "does not come to the second point",
                "too far" = "strays too far from the axis")
  crestline_abort(sprintf("the plane cut from %s to %s %s.", ends$names[1], ends$names[2], why),
                  "Fill the hole between them, try another angle, or check the two landmarks.",
                  stage = "path", id = id, class = "crestline_path_error", call = NULL)
}

#' @export
print.mesh_path <- function(x, ...) {
  check_method_dots(...)
  cat(sprintf("Path of %d points, length %.4g", nrow(x), attr(x, "length")))
  if (!is.null(attr(x, "angle"))) cat(sprintf(", angle %.1f degrees", attr(x, "angle") * 180 / pi))
  cat("\n")
  optima <- attr(x, "optima")
  if (!is.null(optima)) {
    cat("Local optima:\n")
    print(utils::head(optima, 6), digits = 3, row.names = FALSE)
  }
  invisible(x)
}
