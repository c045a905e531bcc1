# Parts of paths as a user takes them, and paths put one behind the other: arc lengths that are
# those of the points.

# What a path is without; other columns go along.
path_columns <- c("s", mesh_columns)

#' Parts of a path, and paths joined
#'
#' `path[i, ]` is a path of its own: its arc lengths begin at 0 and its `length` is that of the
#' steps between its points, straight where points between them were left out. What was true of the
#' whole path (angle, side, optima, criterion, ...) is dropped; the mesh that it lies on is
#' remembered. `rbind()` puts paths of one mesh behind each other; where one ends and the next
#' begins at the same place, that point is there once. A path whose co-ordinates are set has the
#' length of these.
#'
#' @param x A `mesh_path`, see [plane_path()].
#' @param ... Rows and columns as for any data frame; of `rbind()`: `mesh_path`s of one mesh.
#' @param deparse.level Ignored.
#' @return A `mesh_path` with the attribute `length`. Without one of the columns `s`, `x`, `y`, `z`,
#'   `face`, `w1`, `w2`, `w3` it is no path but a plain data frame, or a vector, as of any data
#'   frame.
#' @section Errors: of class `crestline_error`: rows that are not there; paths of different meshes.
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
#' @param name,i A column.
#' @param value What it shall hold; NULL takes it away.
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

check_one_mesh <- function(paths, call = rlang::caller_env()) {
  keys <- unique(unlist(lapply(paths, attr, "key")))
  if (length(keys) < 2) return(invisible())
  ids <- unique(unlist(lapply(paths, attr, "id")))
  crestline_abort(sprintf("the paths lie on %d meshes%s.", length(keys),
                          if (length(ids) > 1) paste0(": ", shorten(ids)) else ""),
                  "Join paths of one mesh only: their faces are numbers of its triangles.",
                  stage = "path", call = call)
}

#' An attribute that all have alike, NULL where they have not
#' @noRd
common_attribute <- function(x, name) {
  values <- unique(lapply(x, attr, name))
  if (length(values) == 1) values[[1]]
}
