#' Plane cut of a surface between two points
#'
#' The plane contains both points; `angle` turns it about the axis through them. At angle 0 it also
#' contains the mean of the surface normals at the two points, and so cuts straight into the
#' surface. The cut is followed from triangle to triangle, from the first point to the second.
#'
#' @param mesh A `specimen` or a `mesh3d`.
#' @param from,to The two ends. Each is the name of a landmark (of a `specimen`), or a position:
#'   three co-ordinates in the unit of the mesh, which are moved onto the surface.
#' @param angle Angle of the plane in radians, in (-pi/2, pi/2]; positive turns
#'   right-handed about the axis from `from` to `to`.
#' @param side 0: the path leaves `from` towards `to`. 1: it runs round the other side of the
#'   object.
#' @param reach Greatest distance of the cut from the straight line between the points, as a share
#'   of that line's length. `Inf`: no limit.
#' @return A `mesh_path`: a data frame with a row for each point where the plane crosses an edge of
#'   the mesh, in order from `from` to `to`. Its columns are `s` (arc length), `x`, `y`, `z`, `face`
#'   (triangle of the segment that ends at the point), and the barycentric weights `w1`, `w2`, `w3`
#'   in it. Lengths are in the unit of the mesh. Its attributes are `length` (unit of the mesh),
#'   `angle` (radians) and `side`.
#' @section Errors: of class `crestline_path_error`: the cut ends at a border of the mesh (such as a
#'   hole between the points), exceeds `reach`, or returns without meeting `to`.
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
  in_context(cut_path(located_ends(mesh, scan, from, to), angle, side, reach), scan$id)
}

#' One plane cut as a path, or a failure
#'
#' @param ends As of [path_ends()]; a failure is handed on.
#' @param angle,side,reach As in [plane_path()].
#' @param ... Attributes of the path.
#' @noRd
cut_path <- function(ends, angle, side, reach, ...) {
  if (failed(ends)) return(ends)
  scan <- ends$scan
  found <- cpp_plane_path(
    scan$vb, scan$it, scan$twin, ends$from, ends$to, plane_normal(ends, angle), side,
    reach * ends$span
  )
  if (found$end != "arrived") return(failed_cut(found$end, ends))
  path_through(rbind(ends$exact[1, ], found$points, ends$exact[2, ]), scan, angle = angle,
               side = side, ...)
}

#' A mesh as walks need it, from a specimen (kept) or a mesh (worked out)
#'
#' @return List: `passed` (as of [passed_mesh()]), its `vb` and `it` (as kernels take them),
#'   `normals` (NULL where the mesh has none), `twin`, `piece` of [mesh_topology()], `key`,
#'   `diagonal`, `id`, and `search`, the constants of searches for paths. It serves as a mesh too.
#' @noRd
walkable <- function(specimen) {
  whole <- as_mesh(specimen)
  known <- passed_mesh(whole, NULL)
  geometry <- if (inherits(specimen, "specimen")) specimen$geometry else
    mesh_topology(whole)[c("twin", "piece")]
  list(passed = known, vb = known$vb, it = known$it, normals = whole$normals, twin = geometry$twin,
       piece = geometry$piece, key = known$key, diagonal = known$diagonal,
       id = if (inherits(specimen, "specimen")) specimen$id, search = path_settings())
}

#' The ends of a path, from names of landmarks and positions as a user gives them
#' @param via List of places on the way; NULL: none.
#' @noRd
located_ends <- function(specimen, scan, from, to, via = NULL) {
  stops <- lapply(via, function(at) end_vector(specimen, scan, at, "via"))
  path_ends(scan, rbind(end_vector(specimen, scan, from, "from"),
                        end_vector(specimen, scan, to, "to")), c(end_name(from), end_name(to)),
            do.call(rbind, stops))
}

#' What looks up the ends of regions, see [located_regions()]
#' @noRd
region_locator <- function(specimen) {
  scan <- walkable(specimen)
  function(at, end) end_vector(specimen, scan, at, end)[c("x", "y", "z")]
}

#' Both ends of a path: in different places, on one piece of the mesh
#'
#' @param exact 2 x 7 matrix, columns as `mesh_columns`.
#' @param names What the ends are called.
#' @param via k x 7 matrix of places on the way, NULL where there is none. With it both ends may be
#'   one place, of a closed path.
#' @param inside Barycentric weight by which ends are kept off edges and corners, so
#'   that a plane through an end always crosses its triangle. The path begins and
#'   stops at the exact places.
#' @return List: `scan`, `from`, `to` (face, w1, w2, w3, moved inside), `exact`, `names`; of the
#'   axis between the moved ends `axis` and `across` (unit vectors; the plane at angle 0 contains
#'   `axis` and is normal to `across`) and `span` (its length); `via` and `closed`. Or a failure.
#' @noRd
path_ends <- function(scan, exact, names, via = NULL, inside = 1e-6) {
  refuse <- function(said, remedy) {
    no_result(sprintf(said, names[1], names[2]), remedy, "path", scan$id, "crestline_path_error")
  }
  if (all(exact[1, 1:3] == exact[2, 1:3])) {
    if (!is.null(via)) {
      return(list(scan = scan, exact = exact, names = names, via = via, closed = TRUE))
    }
    return(refuse("%s and %s are the same point.",
                  paste("Choose two different landmarks, or correct the one that was misplaced.",
                        "A closed ridge or valley has a `via`.")))
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
  list(scan = scan, from = from, to = to, exact = exact, names = names, via = via, closed = FALSE,
       axis = axis$axis, across = axis$across, span = axis$span)
}

#' Normals of the planes at given angles, 3 x k
#'
#' @param ends List with `axis` and `across`, as of [path_ends()].
#' @noRd
plane_normal <- function(ends, angle) {
  turned <- cross_product(ends$axis, ends$across)
  outer(ends$across, cos(angle)) + outer(turned, sin(angle))
}

failed_cut <- function(end, ends) {
  why <- switch(end, border = "meets a border of the mesh",
                round = "does not come to the second point",
                "too far" = "strays too far from the axis")
  no_result(sprintf("the plane cut from %s to %s %s.", ends$names[1], ends$names[2], why),
              "Fill the hole between them, try another angle, or check the two landmarks.", "path",
              ends$scan$id, "crestline_path_error")
}

# Holes of a mesh bridged by flat triangles, for paths to pass over; nothing that is measured may
# lie on them.

#' A specimen with its holes bridged
#'
#' A fan of triangles about its centre is laid over every loop of the border that is not too large.
#' The mesh's own vertices and faces keep their numbers.
#'
#' @param largest Diagonal of the bounding box of a hole, as a share of the object's size
#'   ([mesh_size()]), up to which it is bridged.
#' @return The specimen, with more vertices and faces where there are such holes.
#' @noRd
bridge_holes <- function(specimen, largest) {
  mesh <- specimen$mesh
  corners <- lapply(cpp_border_loops(specimen$geometry$twin),
                    function(loop) simple_loops(mesh$it[loop]))
  corners <- unlist(corners, recursive = FALSE)
  size <- vapply(corners, function(loop) box_diagonal(mesh$vb[1:3, loop, drop = FALSE]), 0)
  holes <- corners[lengths(corners) >= 3 & size > 0 & size <= largest * specimen_size(specimen)]
  if (!length(holes)) return(specimen)
  centre <- ncol(mesh$vb) + seq_along(holes)
  middle <- function(x) vapply(
    holes, function(loop) rowMeans(x[, loop, drop = FALSE]), numeric(nrow(x))
  )
  mesh$vb <- cbind(mesh$vb, middle(mesh$vb))
  mesh$normals <- cbind(mesh$normals, middle(mesh$normals))
  fans <- Map(function(loop, centre) rbind(c(loop[-1], loop[1]), loop, centre), holes, centre)
  mesh$it <- unname(cbind(mesh$it, do.call(cbind, fans)))
  storage.mode(mesh$it) <- "integer"
  geometry <- specimen$geometry
  geometry[c("twin", "piece")] <- mesh_topology(mesh)[c("twin", "piece")]
  with_fields(specimen, mesh = mesh, key = passed_mesh(mesh, specimen$id)$key, geometry = geometry)
}

#' A loop of vertices taken apart where it meets itself
#' @return List of loops in which no vertex is twice.
#' @noRd
simple_loops <- function(loop) {
  found <- list()
  while (anyDuplicated(loop)) {
    end <- anyDuplicated(loop)
    start <- max(which(loop[seq_len(end - 1)] == loop[end]))
    found <- c(found, list(loop[start:(end - 1)]))
    loop <- loop[-(start:(end - 1))]
  }
  c(found, list(loop))
}

#' A path without its parts on bridges: straight from rim to rim
#' @noRd
unbridged_path <- function(path, specimen) {
  mesh <- specimen$mesh
  if (is.null(path)) return(NULL)
  attr(path, "key") <- specimen_key(specimen)
  bridge <- path$face > ncol(mesh$it)
  if (!any(bridge)) return(path)
  landing <- which(bridge & !c(bridge[-1], TRUE))
  path[landing, mesh_columns] <- surface_points(mesh, as.matrix(path[landing, c("x", "y", "z")]))
  kept <- sort(c(which(!bridge), landing))
  # Its arc lengths stay those of the way over the bridges, along which it was measured.
  whole <- is_closed(path) && all(c(1, nrow(path)) %in% kept)
  new_mesh_path(lapply(unclass(path)[c("s", mesh_columns)], `[`, kept), attr(path, "length"),
                attr(path, "key"), attr(path, "id"), closed = if (whole) TRUE)
}
