#' Lift a curve given in arc length and distance onto the mesh
#'
#' The curve d = alpha(s) is followed through the triangles of the mesh. Every vertex of the window
#' has a value d - alpha(s). The zero line of these values is followed edge by edge, from the
#' triangle of the first end to that of the second. The result is a connected path on the mesh. If
#' (s, d) folds over, the path stays on the sheet that is joined to the reference path.
#'
#' @param specimen A [specimen()] or `mesh3d`.
#' @param coordinates [path_coordinates()] of the window.
#' @param path The reference path.
#' @param s,alpha The curve: offsets at increasing arc lengths from 0 to the length of the path. If
#'   the path is closed, the last offset is the first.
#' @return A `mesh_path` from the first to the last point of `path`. If a border or a fold stopped
#'   the walk, the path is made of plane cuts between the places of the curve, and the attribute
#'   `lifted` is `FALSE`.
#' @section Errors: of class `crestline_path_error`: neither the walk nor plane cuts give a path. Of
#'   class `crestline_wrong_mesh`: the path or its co-ordinates belong to another mesh.
#' @template glossary
#' @templateVar where section 3.3
#' @template paper
#' @details The paper looks each place up in the triangles of (s, d). These are the triangles of the
#'   scan or, if there are none, a Delaunay triangulation. Here the curve is walked through the
#'   scan's own triangles.
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' path <- plane_path(ball, c(1, 0, 0), c(0, 1, 0))
#' window <- path_coordinates(ball, path, width = 0.4)
#' s <- seq(0, attr(path, "length"), length.out = 21)
#' lift(ball, window, path, s, alpha = 0.1 * sin(2 * s))
#' @export
lift <- function(specimen, coordinates, path, s, alpha) {
  check_given()
  check_surface(specimen, "specimen")
  check_class(coordinates, "path_coordinates", "coordinates", "path_coordinates()")
  check_class(path, "mesh_path", "path", "reference_path() or plane_path()")
  s <- check_numbers(s, "s")
  alpha <- check_numbers(alpha, "alpha")
  if (length(s) < 2 || is.unsorted(s, strictly = TRUE) || length(alpha) != length(s)) {
    crestline_abort(sprintf("`s` (%s) and `alpha` (%s) are no line.", describe_value(s),
                            describe_value(alpha)),
                    "Give two places or more, in order, and an offset for each.",
                    stage = "arguments")
  }
  if (is_closed(path) && alpha[1] != alpha[length(alpha)]) {
    refuse_argument("alpha", alpha, "A closed curve ends with the offset that it begins with.")
  }
  check_path_on(path, specimen, "`path`")
  check_coordinates_on(coordinates, specimen, "`coordinates`")
  in_context(lifted_line(walkable(specimen), coordinates, path, s, alpha), mesh_of(specimen)$id)
}

#' A lifted line without checks, or a failure
#'
#' Where the line cannot be walked, a path through the places of the curve, joined by shortest plane
#' cuts. The place of each (s, alpha) is in a triangle that holds it in (s, d); of several, the one
#' nearest to the reference path. Those of a closed curve are put on the part of the mesh that is
#' joined to the reference path.
#' @param scan As of [walkable()].
#' @noRd
lifted_line <- function(scan, coordinates, path, s, alpha) {
  walked <- if (is_closed(path)) {
    walked_loop(scan, coordinates, s, alpha)
  } else {
    walked_line(scan, coordinates, path, s, alpha)
  }
  # Other failures are of the ends, which no path can join.
  if (!failed(walked) || walked$stage != "lift") return(walked)
  if (!is_closed(path)) {
    places <- places_in_plane(scan, coordinates, path, s, alpha)
    if (is.null(places)) {
      return(no_result("no triangle near the reference path holds the ridge line.",
                       "Give a smaller `width`, or use the plane cut.", "lift", scan$id,
                       "crestline_path_error"))
    }
    at <- columns_of(path)
    return(cuts_between(scan, rbind(at[1, ], columns_of(places), at[nrow(at), ])))
  }
  n <- length(s) - 1
  at <- place_along(scan, path, s[-1])
  xyz <- columns_of(at, c("x", "y", "z"))
  tangent <- xyz[c(2:n, 1), ] - xyz[c(n, seq_len(n - 1)), ]
  across <- cross_rows(t(path_normals(scan, at)), tangent)
  xyz <- xyz + alpha[-1] * across / row_lengths(across)
  placed <- placed_beside(scan, xyz, loop_places(path), attr(coordinates, "width"))
  joined <- cuts_between(scan, rbind(placed, placed[1, ]))
  if (!failed(joined)) attr(joined, "closed") <- TRUE
  joined
}

#' Shortest plane cuts from place to place as one path, or a failure
#'
#' @param knots k x 7 matrix.
#' @noRd
cuts_between <- function(scan, knots) {
  knots <- knots[c(TRUE, row_lengths(diff(knots[, 1:3])) > 0), ]
  search <- scan$search
  search$reach <- Inf
  pieces <- lapply(seq_len(nrow(knots) - 1), function(i) {
    names <- c(end_name(knots[i, ]), end_name(knots[i + 1, ]))
    ends <- path_ends(scan, knots[c(i, i + 1), ], names)
    find_reference(ends, "plane", NULL, NULL, search)
  })
  bad <- Find(failed, pieces)
  if (!is.null(bad)) return(bad)
  onward <- lapply(pieces, function(piece) columns_of(piece)[-1, ])
  path_through(do.call(rbind, c(list(knots[1, ]), onward)), scan, lifted = FALSE)
}

places_in_plane <- function(surface, coordinates, path, s, alpha) {
  row_of <- match(seq_len(ncol(surface$vb)), coordinates$vertex)
  corners <- matrix(row_of[surface$it], 3)
  faces <- which(colSums(is.na(corners)) == 0)
  flat <- list(vb = rbind(coordinates$s, coordinates$d, 0), it = corners[, faces, drop = FALSE])
  found <- lapply(seq_along(s)[-c(1, length(s))], function(i) {
    holds <- triangles_about(flat, s[i], alpha[i])
    if (length(holds$face) == 0) return(NULL)
    xyz <- place_on_faces(surface, faces[holds$face], holds$weight)
    at <- points_along(path, s[i])
    best <- which.min(rowSums(sweep(xyz, 2, at)^2))
    data.frame(x = xyz[best, 1], y = xyz[best, 2], z = xyz[best, 3], face = faces[holds$face[best]],
               w1 = holds$weight[best, 1], w2 = holds$weight[best, 2], w3 = holds$weight[best, 3])
  })
  do.call(rbind, found)
}

#' Triangles of a flat mesh that hold a point, with its weights
#' @noRd
triangles_about <- function(flat, x, y) {
  corner <- function(i, row) flat$vb[row, flat$it[i, ]]
  near <- which(pmin(corner(1, 1), corner(2, 1), corner(3, 1)) <= x &
                  pmax(corner(1, 1), corner(2, 1), corner(3, 1)) >= x)
  near_flat <- list(vb = flat$vb, it = flat$it[, near, drop = FALSE])
  corners <- lapply(1:3, function(i) t(near_flat$vb[, near_flat$it[i, ], drop = FALSE]))
  point <- matrix(rep(c(x, y, 0), each = length(near)), ncol = 3)
  weight <- foot_in_triangles(point, corners[[1]], corners[[2]], corners[[3]])
  inside <- which(!is.na(weight[, 1]))
  list(face = near[inside], weight = weight[inside, , drop = FALSE])
}
