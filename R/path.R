# Parts of paths as a user takes them, and paths put one behind the other: arc lengths that are
# those of the points.

# What a path is not without; other columns go along.
path_columns <- c("s", mesh_columns)

#' Parts of a path, and paths joined
#'
#' `path[i, ]` is a new path. Its arc lengths begin at 0, and its `length` is the sum of the steps
#' between its points. A step over points that were left out is straight. Attributes of the whole
#' path (angle, side, optima, criterion, ...) are dropped; the key of the mesh is kept. `rbind()`
#' joins paths of one mesh end to end. If one path ends where the next begins, that point is kept
#' once. If co-ordinates are set, the length is computed again.
#'
#' @param x A `mesh_path`, see [plane_path()].
#' @param ... Rows and columns, as for any data frame. For `rbind()`: `mesh_path`s of one mesh.
#' @param deparse.level Ignored.
#' @return A `mesh_path` with the attribute `length`. If one of the columns `s`, `x`, `y`, `z`,
#'   `face`, `w1`, `w2`, `w3` is dropped, a plain data frame or a vector.
#' @section Errors: of class `crestline_error`: rows that the path does not have; paths of different
#'   meshes.
#' @template glossary
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' path <- plane_path(ball, c(1, 0, 0), c(0, 1, 0))
#' half <- path[path$s <= attr(path, "length") / 2, ]
#' attr(half, "length")
#' rbind(half, path[nrow(half):nrow(path), ])
#' head(path[c("s", "z")])
#' @name mesh_path
NULL

#' @rdname mesh_path
#' @export
`[.mesh_path` <- function(x, ...) {
  part <- NextMethod()
  if (!is.data.frame(part)) return(part)
  if (!all(path_columns %in% names(part))) return(plain_frame(part))
  if (anyNA(part$face) && !anyNA(x$face)) {
    crestline_abort("the path has no such rows.", sprintf("It has rows 1 to %d.", nrow(x)),
                    stage = "path")
  }
  whole <- all(vapply(path_columns, function(name) identical(part[[name]], x[[name]]), NA))
  if (!whole) return(rebased_path(part, attr(x, "key"), attr(x, "id")))
  kept <- attributes(x)[setdiff(names(attributes(x)), names(attributes(part)))]
  attributes(part)[names(kept)] <- kept
  part
}

#' @rdname mesh_path
#' @param name,i Name or number of a column.
#' @param value New values of the column; NULL removes it.
#' @export
`$<-.mesh_path` <- function(x, name, value) changed_path(x, NextMethod())

#' @rdname mesh_path
#' @export
`[[<-.mesh_path` <- function(x, i, value) changed_path(x, NextMethod())

#' A path of which a column was set: without one of its own it is none, and other co-ordinates have
#' another length
#' @noRd
changed_path <- function(before, after) {
  if (!all(path_columns %in% names(after))) return(plain_frame(after))
  same <- vapply(c("x", "y", "z"), function(name) identical(after[[name]], before[[name]]), NA)
  if (!all(same)) rebased_path(after, attr(before, "key"), attr(before, "id")) else after
}

#' @rdname mesh_path
#' @export
rbind.mesh_path <- function(..., deparse.level = 1) {
  paths <- Filter(Negate(is.null), list(...))
  strange <- Filter(function(path) !inherits(path, "mesh_path"), paths)
  if (length(strange)) {
    crestline_abort(sprintf("a path is joined with %s.", describe_value(strange[[1]])),
                    "Give paths only, as of plane_path() or reference_path().", stage = "path")
  }
  check_one_mesh(paths)
  columns <- Reduce(intersect, lapply(paths, names))
  rows <- do.call(rbind, lapply(unname(paths), function(path) plain_frame(path)[columns]))
  first <- cumsum(c(1, vapply(paths, nrow, 0L)))[-c(1, length(paths) + 1)]
  meets <- first[first > 1 & first <= nrow(rows)]
  xyz <- columns_of(rows, c("x", "y", "z"))
  meets <- meets[row_lengths(xyz[meets, , drop = FALSE] - xyz[meets - 1, , drop = FALSE]) == 0]
  rebased_path(rows[setdiff(seq_len(nrow(rows)), meets), ], common_attribute(paths, "key"),
               common_attribute(paths, "id"))
}

#' A path with the arc lengths of its points, from 0 on
#'
#' @param rows Data frame with the columns of a path.
#' @param key,id Of its mesh, NULL where they are not known.
#' @noRd
rebased_path <- function(rows, key, id) {
  xyz <- columns_of(rows, c("x", "y", "z"))
  n <- nrow(rows)
  rows$s <- c(0, cumsum(row_lengths(xyz[-1, , drop = FALSE] - xyz[-n, , drop = FALSE])))[seq_len(n)]
  columns <- lapply(unclass(rows)[names(rows)], unname)
  new_mesh_path(columns, if (n) rows$s[n] else 0, key, id)
}

#' A data frame without class and attributes of its own
#' @noRd
plain_frame <- function(x) {
  automatic <- .row_names_info(x) <= 0
  rows <- if (automatic) .set_row_names(nrow(x)) else attr(x, "row.names")
  attributes(x) <- list(names = names(x), row.names = rows, class = "data.frame")
  x
}

check_one_mesh <- function(paths) {
  keys <- unique(unlist(lapply(paths, attr, "key")))
  if (length(keys) < 2) return(invisible())
  ids <- unique(unlist(lapply(paths, attr, "id")))
  crestline_abort(sprintf("the paths lie on %d meshes%s.", length(keys),
                          if (length(ids) > 1) paste0(": ", shorten(ids)) else ""),
                  "Join paths of one mesh only: their faces are numbers of its triangles.",
                  stage = "path")
}

#' An attribute that all have alike, NULL where they have not
#' @noRd
common_attribute <- function(x, name) {
  values <- unique(lapply(x, attr, name))
  if (length(values) == 1) values[[1]]
}

#' Points along a path at equal chords
#'
#' @param mesh The mesh of the path.
#' @param path A `mesh_path`.
#' @param n Number of points, both ends counted, at least 2.
#' @param tolerance Relative difference of the chords at which to stop.
#' @param iterations Most rounds of correction.
#' @param slowest Least share of a correction that is carried out.
#' @return Data frame of n rows `s, x, y, z, face, w1, w2, w3`; the straight distances between
#'   neighbours are equal. The points lie on the path, so on the mesh. Attribute `converged`.
#' @noRd
resample_path <- function(mesh, path, n, tolerance = 1e-10, iterations = 200, slowest = 0.2) {
  spaced <- cpp_equal_chords(
    columns_of(path, c("x", "y", "z")), path$s, n, chord_settings(tolerance, iterations, slowest)
  )
  structure(place_along(mesh, path, spaced$s), converged = spaced$converged)
}

chord_settings <- function(tolerance = 1e-10, iterations = 200, slowest = 0.2) {
  list(tolerance = tolerance, iterations = iterations, slowest = slowest)
}

# Positions at arc lengths, n x 3.
points_along <- function(path, s) {
  vapply(c("x", "y", "z"),
         function(a) stats::approx(path$s, path[[a]], s, rule = 2, ties = "ordered")$y, s)
}

#' Points of a path at given arc lengths, each in the triangle of its segment
#' @noRd
place_along <- function(mesh, path, s) {
  placed <- cpp_place_along(
    mesh$vb, mesh$it, columns_of(path, c("x", "y", "z")), path$s, path$face, s
  )
  ends <- which(s %in% range(path$s))
  if (length(ends)) placed[ends, ] <- columns_of(path)[ifelse(s[ends] == 0, 1, nrow(path)), ]
  columns <- stats::setNames(c(list(s), lapply(1:7, function(i) placed[, i])), c("s", mesh_columns))
  columns$face <- as.integer(columns$face)
  frame_of(columns)
}

# Barycentric weights of points that lie in the given triangles.
weights_in_faces <- function(mesh, face, xyz) {
  corner <- function(i) t(mesh$vb[1:3, mesh$it[i, face], drop = FALSE])
  a <- corner(1)
  u <- corner(2) - a
  v <- corner(3) - a
  w <- xyz - a
  uu <- rowSums(u * u)
  uv <- rowSums(u * v)
  vv <- rowSums(v * v)
  det <- uu * vv - uv^2
  w2 <- (vv * rowSums(w * u) - uv * rowSums(w * v)) / det
  w3 <- (uu * rowSums(w * v) - uv * rowSums(w * u)) / det
  weight <- pmax(cbind(1 - w2 - w3, w2, w3), 0)
  weight / rowSums(weight)
}

#' A path through points that follow one another on the mesh; of neighbours at one place the later
#' goes, but not the last
#'
#' @param points k x 7 matrix.
#' @param mesh The mesh that they lie on: list of `key` and `id`, as of [walkable()] or [mesh_of()].
#' @param ... Attributes of the path.
#' @noRd
path_through <- function(points, mesh = NULL, ...) {
  step <- unname(row_lengths(
    points[-1, 1:3, drop = FALSE] - points[-nrow(points), 1:3, drop = FALSE]
  ))
  kept <- c(TRUE, step[-length(step)] > 0, TRUE)[seq_len(nrow(points))]
  columns <- lapply(1:7, function(i) as.vector(points[kept, i]))
  columns[[4]] <- as.integer(columns[[4]])
  columns <- c(list(c(0, cumsum(step))[kept]), columns)
  new_mesh_path(stats::setNames(columns, c("s", mesh_columns)), sum(step), mesh$key, mesh$id, ...)
}

# Whether the last point of a path is its first.
is_closed <- function(path) isTRUE(attr(path, "closed"))

#' A closed path through places in order
#'
#' @param points k x 7 matrix, the first not repeated at the end; the face of each is that of the
#'   segment that ends there.
#' @param ... Attributes of the path.
#' @noRd
closed_path <- function(points, scan, ...) {
  path_through(rbind(points, points[1, ]), scan, closed = TRUE, ...)
}

#' The places of a closed path without the one at which it closes
#' @noRd
loop_places <- function(path) columns_of(path)[-1, , drop = FALSE]

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
#' @param closed Whether it ends where it begins.
#' @param smoothed Of a path of least cost: FALSE where it could not be made smooth.
#' @noRd
new_mesh_path <- function(columns, length, key = NULL, id = NULL, angle = NULL, side = NULL,
                          type = NULL, criterion = NULL,
                          optima = NULL, competing = NULL, trusted = NULL, lifted = NULL,
                          closed = NULL, smoothed = NULL) {
  structure(columns, row.names = .set_row_names(length(columns[[1]])), length = length, key = key,
            id = id, angle = angle, side = side, type = type, criterion = criterion,
            optima = optima, competing = competing, trusted = trusted, lifted = lifted,
            closed = closed, smoothed = smoothed,
            class = c("mesh_path", "data.frame"))
}

#' Refuse a path without its columns, length or order
#' @noRd
validate_mesh_path <- function(x) {
  at <- if (is.data.frame(x)) place_columns(x)
  length <- attr(x, "length")
  right <- !is.null(at) && nrow(at) >= 2 && is.numeric(x$s) && !is.unsorted(x$s, na.rm = FALSE) &&
    is.numeric(length) && length(length) == 1 && is.finite(length)
  if (isTRUE(right)) return(invisible(x))
  crestline_abort(paste("the path lacks co-ordinates, faces, weights, rising arc lengths `s`,",
                        "or its length."),
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

#' @export
print.mesh_path <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<mesh_path>%s %d points, length %.4g", if (is_closed(x)) " closed," else "",
                nrow(x), attr(x, "length")))
    if (!is.null(attr(x, "angle"))) {
      cat(sprintf(", angle %.1f degrees", attr(x, "angle") * 180 / pi))
    }
    cat("\n")
    optima <- attr(x, "optima")
    if (!is.null(optima)) {
      cat("Local optima:\n")
      print(utils::head(optima, 6), digits = 3, row.names = FALSE)
    }
    invisible(x)
  })
}

#' Arc lengths on a path, those of a closed one brought into its length
#' @noRd
within_path <- function(path, s) if (is_closed(path)) s %% attr(path, "length") else s

#' The part of a path between two arc lengths; run backwards where the first is the greater. Of a
#' closed path they may lie beyond its seam
#' @noRd
part_of_path <- function(mesh, path, from, to) {
  range <- sort(c(from, to))
  length <- attr(path, "length")
  if (is_closed(path)) {
    range <- range - length * floor(range[1] / length)
    if (range[2] > length) path <- twice_round(path)
  }
  range <- pmin(pmax(range, 0), attr(path, "length"))
  between <- columns_of(path)[path$s > range[1] & path$s < range[2], , drop = FALSE]
  ends <- columns_of(place_along(mesh, path, range))
  part <- path_through(rbind(ends[1, ], between, ends[2, ]), mesh_of(path))
  if (from > to) reversed_path(mesh, part) else part
}

#' A closed path as an open one that goes round twice
#' @noRd
twice_round <- function(path) {
  places <- columns_of(path)
  path_through(rbind(places, places[-1, ]), mesh_of(path))
}

#' A path run backwards: the face of a point is that of the segment that ends there
#' @noRd
reversed_path <- function(mesh, path) {
  n <- nrow(path)
  back <- columns_of(path)[n:1, ]
  back[-1, "face"] <- path$face[n:2]
  back[-1, 5:7] <- weights_in_faces(mesh, back[-1, "face"], back[-1, 1:3, drop = FALSE])
  path_through(back, mesh_of(path))
}
