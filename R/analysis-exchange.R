# Samples as the files of MorphoJ and Morphologika.

#' Write a sample for MorphoJ or Morphologika
#'
#' `write_morphologika()` writes the text format of Morphologika, which MorphoJ, geomorph and PAST
#' read too: names, one label, raw points, and lines between the neighbours of each curve. MorphoJ
#' reads a table of co-ordinates, which `write_morphoj()` writes with a row for each specimen.
#' Groups go into a second table beside it, which MorphoJ imports as classifier variables.
#'
#' @param x A `shape_sample`, as [homologise()] returns it, an `aligned`, as [align()] returns it,
#'   or a k x 3 x n (or k x 2 x n) array, in any unit.
#' @param file Path of the file, ending in `.txt`.
#' @param level Level of a `shape_sample`, as in [align()]. For an array: "curves" if its points are
#'   those of curves, named "curve 1", "curve 2" and so on. Only neighbours of curves are joined by
#'   lines.
#' @param group Group of each specimen, as in [compare_groups()], or `NULL`.
#' @return `write_morphologika()`: the path of the file. `write_morphoj()`: the paths of the table
#'   and, with groups, of the table of classifiers (`_classifiers` before the ending). Both
#'   invisibly.
#' @section Errors: of class `crestline_error`: a point is missing, as neither format has a sign for
#'   that; the file has another ending.
#' @template glossary
#' @seealso [write_landmarks()] for TPS and NTS, [as_geomorph()]
#' @examples
#' arcs <- array(rnorm(30), c(5, 3, 2), list(paste("arc", 1:5), NULL, c("a", "b")))
#' file <- tempfile(fileext = ".txt")
#' write_morphologika(arcs, file, "curves", group = c("x", "y"))
#' cat(readLines(file), sep = "\n")
#' unlink(file)
#' @export
write_morphologika <- function(x, file, level = "landmarks", group = NULL) {
  check_given()
  file <- check_path_to_write(file, "file", "txt", "writing")
  of <- exchanged(x, level, group)
  block <- function(name, lines) if (length(lines)) c(sprintf("[%s]", name), lines)
  points <- unlist(lapply(seq_along(of$id), function(i) {
    c(paste0("'", of$id[i]), number_rows(of$coords[, , i], " "))
  }))
  lines <- c(block("individuals", length(of$id)), block("landmarks", dim(of$coords)[1]),
             block("dimensions", dim(of$coords)[2]), block("names", of$id),
             if (!is.null(of$group)) c(block("labels", "group"),
                                       block("labelvalues", of$group)),
             block("rawpoints", points), block("wireframe", if (identical(of$level, "curves")) {
               curve_links(dimnames(of$coords)[[1]])
             }))
  write_content(charToRaw(enc2utf8(paste0(paste(lines, collapse = "\n"), "\n"))), file)
  invisible(file)
}

#' @rdname write_morphologika
#' @export
write_morphoj <- function(x, file, level = "landmarks", group = NULL) {
  check_given()
  file <- check_path_to_write(file, "file", "txt", "writing")
  of <- exchanged(x, level, group)
  d <- dim(of$coords)[2]
  flat <- matrix(aperm(of$coords, c(3, 2, 1)), length(of$id))
  head <- paste0(c("x", "y", "z")[seq_len(d)], rep(seq_len(dim(of$coords)[1]), each = d))
  table <- function(lines) charToRaw(enc2utf8(paste0(paste(lines, collapse = "\n"), "\n")))
  write_content(table(c(paste(c("ID", head), collapse = "\t"),
                        paste(of$id, number_rows(flat, "\t"), sep = "\t"))), file)
  if (is.null(of$group)) return(invisible(file))
  beside <- sub("[.]txt$", "_classifiers.txt", file, ignore.case = TRUE)
  write_content(table(c("ID\tgroup", paste(of$id, of$group, sep = "\t"))), beside)
  invisible(c(file, beside))
}

#' Co-ordinates, ids, groups and level of a sample, as other programs can read them
#' @noRd
exchanged <- function(x, level, group) {
  coords <- if (inherits(x, "shape_sample")) as.array(x, level) else
    if (inherits(x, "aligned")) as.array(x) else x
  check_array(coords, "x")
  if (is.array(x)) level <- check_choice(level, sample_levels, "level")
  id <- dimnames(coords)[[3]]
  if (is.null(id)) id <- paste0("s", seq_len(dim(coords)[3]))
  missing <- which(is.na(coords), arr.ind = TRUE)
  if (nrow(missing)) {
    crestline_abort(sprintf(paste("point %d of specimen %s is missing, and the format has no sign",
                                  "for it."), missing[1, 1], id[missing[1, 3]]),
                    "Align first: align() estimates missing points.", stage = "writing")
  }
  if (!is.null(group)) {
    fail <- function(problem, remedy) {
      crestline_abort(problem, remedy, stage = "writing")
    }
    group <- without_breaks(as.character(by_specimen(group, id, "group", fail)))
  }
  list(coords = coords, id = without_breaks(id), group = group,
       level = if (inherits(x, "aligned")) x$level else level)
}

#' Words as they stand in one field of one line
#' @noRd
without_breaks <- function(x) gsub("[[:cntrl:]]+", " ", x)

number_rows <- function(x, sep) {
  apply(matrix(x, nrow(x)), 1, function(row) {
    paste(format(row, digits = 15, trim = TRUE, scientific = FALSE), collapse = sep)
  })
}

#' "1 2", "2 3": neighbours on a curve, by the names of its points
#' @noRd
curve_links <- function(names) {
  if (is.null(names) || !all(grepl(" [0-9]+$", names))) return(character())
  part <- sub(" [0-9]+$", "", names)
  i <- which(part[-1] == part[-length(part)])
  paste(i, i + 1L)
}
