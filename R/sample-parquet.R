# Points and status of many shapes as Parquet tables, which other programs read.

#' Write shapes as a table that other programs read
#'
#' Writes the points of a sample or batch, or what was measured of each part, as a Parquet file.
#' Python, DuckDB, Arrow, Spark and others read it without R. [crestline-package] has a glossary.
#'
#' Some hundred shapes are in memory at a time, so that the size of a batch in files does not
#' matter. `as.data.frame(nanoparquet::read_parquet(file))` reads the file again. Numbers come back
#' with every bit.
#'
#' @param x A `shape_sample` of [homologise()], a `shape_batch` of [fit_shapes()] or [read_batch()],
#'   a `shape`, or a list of shapes of one scheme. Specimens that failed have no rows.
#' @param file Path of the file to write.
#' @param what "points": places. "status": length, strength and the other measures of every part,
#'   with its grade, see [quality()].
#' @param form "long": a row for each specimen and point, or part. "wide": a row for each specimen.
#' @param specimens Data frame of what is known of the specimens, such as site or sex: a column `id`
#'   and others, which become columns of the file. Specimens without a row have missing values
#'   there. `NULL`: none.
#' @return The path, invisibly. Columns of the file are `id`, those of `specimens`, and then:
#'   * points, long: `level`, `part`, `point`, `x`, `y`, `z`, `se` (standard error), in the unit of
#'     the meshes;
#'   * points, wide: `curves brow left 3.x` and so on (level, part, point and axis), as in the files
#'     of [write_blocks()];
#'   * status, long: the columns of [quality()], with `id` in place of `specimen`;
#'   * status, wide: `curves brow left.grade` and so on (level and part): "green", "amber", "red".
#' @section Errors: of class `crestline_error`: `x` has no shapes; shapes have different schemes;
#'   `specimens` has no column `id`, an id twice, none of the ids of `x`, or a column of the file's
#'   own; the file cannot be written; the package nanoparquet is not installed.
#' @template glossary
#' @seealso [write_blocks()] for a sample in files that [align()] reads
#' @examplesIf rlang::is_installed("nanoparquet")
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2)) / sqrt(6)
#' curve <- data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b")), curve, name = "one line")
#' ball <- specimen(Rvcg::vcgSphere(4), corners, id = "ball")
#' shape <- fit_shape(ball, scheme, progress = FALSE)
#' file <- tempfile(fileext = ".parquet")
#' write_parquet(shape, file, specimens = data.frame(id = "ball", site = "here"))
#' head(nanoparquet::read_parquet(file))
#' @export
write_parquet <- function(x, file, what = c("points", "status"), form = c("long", "wide"),
                          specimens = NULL) {
  check_given()
  what <- check_choice(what, c("points", "status"), "what")
  form <- check_choice(form, c("long", "wide"), "form")
  if (!is_path(file)) refuse_argument("file", file, "Give the path of one file.")
  need_parquet()
  if (inherits(x, "shape_sample")) validate(x)
  if (!inherits(x, "shape_batch")) x <- named_shapes(x)
  rows <- if (what == "status") status_rows(x, form) else point_rows(x, form)
  write_table_parts(rows, check_covariates(specimens, rows$columns, names(x)), file)
  invisible(file)
}

#' A table of points in parts
#' @return List: `parts` (names of shapes, some hundred each), `rows` (function of one of them, a
#'   data frame), `columns`.
#' @noRd
point_rows <- function(x, form, block = 200) {
  first <- NULL
  one <- function(name) {
    shape <- x[[name]]
    if (is.null(shape)) return(NULL)
    if (is.null(first)) first <<- shape else check_same_scheme(shape, first)
    if (form == "wide") return(wide_points(shape, name))
    points <- shape$points[c("level", "part", "point", "x", "y", "z", "se")]
    cbind(id = rep(name, nrow(points)), points)
  }
  rows <- function(names) do.call(rbind, lapply(names, one))
  list(parts = split(names(x), (seq_along(names(x)) - 1) %/% block), rows = rows,
       columns = c("id", "level", "part", "point", "x", "y", "z", "se"))
}

#' One shape's points as a row
#' @param id Name of the specimen among the others.
#' @noRd
wide_points <- function(shape, id) {
  name <- table_columns(points_of_sample(shape), c("x", "y", "z"))
  values <- columns_of(shape$points, c("x", "y", "z"))
  order <- as.vector(t(matrix(seq_along(name), nrow(name))))
  row <- as.list(stats::setNames(as.vector(values)[order], name[order]))
  as.data.frame(c(list(id = id), row), optional = TRUE)
}

#' A table of parts' measures and grades
#' @noRd
status_rows <- function(x, form) {
  table <- as.data.frame(quality(x))
  table <- table[table$level != "specimen", ]
  names(table)[names(table) == "specimen"] <- "id"
  table$grade <- as.character(table$grade)
  if (form == "wide") {
    part <- paste0(table$level, " ", table$part, ".grade")
    grades <- tapply(table$grade, list(factor(table$id, unique(table$id)),
                                       factor(part, unique(part))), `[`, 1)
    table <- cbind(id = rownames(grades), as.data.frame(grades, optional = TRUE))
    rownames(table) <- NULL
  }
  list(parts = list(unique(table$id)), rows = function(names) table, columns = names(table))
}

#' What is known of specimens, a row each
#' @param ids Of the specimens of the file.
#' @noRd
check_covariates <- function(specimens, columns, ids) {
  if (is.null(specimens)) return(NULL)
  problem <- if (!is.data.frame(specimens) || !"id" %in% names(specimens)) {
    "has no column `id`"
  } else if (anyDuplicated(specimens$id)) {
    sprintf("has the id %s twice", specimens$id[anyDuplicated(specimens$id)])
  } else if (length(twice <- intersect(setdiff(names(specimens), "id"), columns))) {
    sprintf("has a column of the table's own: %s", shorten(twice))
  } else if (!any(ids %in% specimens$id)) {
    sprintf("has none of %s", shorten(ids))
  }
  if (is.null(problem)) return(specimens)
  refuse_argument("specimens", specimens, "Give a data frame with a row for each specimen.",
                  sprintf("a table that %s", problem))
}

#' Rows written part by part; the file has its name once all are there
#' @noRd
write_table_parts <- function(rows, specimens, file) {
  part <- tempfile(part_prefix(), dirname(file), ".tmp")
  on.exit(unlink(part))
  refuse <- function(e) {
    if (inherits(e, "crestline_error")) rlang::cnd_signal(e)
    refuse_keeping(file, conditionMessage(e))
  }
  written <- 0
  for (names in rows$parts) {
    table <- rows$rows(names)
    if (!NROW(table)) next
    if (!is.null(specimens)) {
      own <- specimens[match(table$id, specimens$id), setdiff(names(specimens), "id"), drop = FALSE]
      table <- cbind(table["id"], own, table[setdiff(names(table), "id")])
    }
    rownames(table) <- NULL
    tryCatch(if (written) nanoparquet::append_parquet(table, part) else
      nanoparquet::write_parquet(table, part), error = refuse)
    written <- written + nrow(table)
  }
  if (!written) refuse_keeping(file, "there is no shape")
  tryCatch({
    check_table_written(part, written)
    if (!file.rename(part, file)) stop("it cannot be given its name")
  }, error = refuse, warning = refuse)
}
