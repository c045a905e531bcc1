# A sample in files: the points of so many specimens a file, read a block at a time.

#' A sample in files
#'
#' Keeps the points of a sample in a folder, some hundreds of specimens a file. [align()],
#' [shape_pca()], [compare_groups()] and [shape_lm()] take such a sample in place of one in memory.
#' They read one file at a time. Memory then does not grow with the number of points times
#' specimens: alignment and 50 components of 50,000 faces of 921 points take 0.45 GB.
#'
#' `write_blocks()` writes the folder, `open_sample()` opens it. Opening reads no points.
#'
#' Files are Parquet tables, which Python, DuckDB, Arrow and others read too. `block-0001.parquet`
#' has a row for each specimen: column `id`, then columns such as `curves brow left 3.x`: level,
#' name of the point, and axis. Co-ordinates are in the unit of the meshes, missing ones are null.
#' The file `sample.head` has the names, the template with its scheme, and the provenance.
#'
#' @param sample A `shape_sample`, as [homologise()] returns it, or a k x 3 x n array of homologous
#'   points (k x 2 x n for flat configurations).
#' @param dir Path of a folder; `write_blocks()` makes it if it is not there.
#' @param block Number of specimens a file.
#' @param triangles Triangles of an array's surface: 3 x m matrix of row numbers of points. A
#'   `shape_sample` has its own.
#' @return Object of class `sample_files`, a list:
#'   * `dir` (path), `ids` (names of the n specimens), `block` (n: number of the file of each);
#'   * `points`: data frame with a row for each point: `level`, `point` (name), `place` (points that
#'     coincide share one); `axes` (names of the co-ordinates);
#'   * `template` (a `shape`; `NULL` of an array), `triangles` (3 x m or `NULL`), `provenance`;
#'   * `hash` (of the bytes of each file).
#'
#'   `length()` is the number of specimens, `names()` are their names.
#' @section Errors: of class `crestline_error`: the folder cannot be made, or has a sample already;
#'   there is no sample in it; a file is absent, damaged or of other specimens (the error names it);
#'   the package nanoparquet is not installed.
#' @template glossary
#' @seealso [homologise()], [align()], [compare_groups()]
#' @examplesIf rlang::is_installed("nanoparquet")
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 20), c(4, 3, 20))
#' shapes <- shapes + rnorm(240, sd = 0.05)
#' folder <- tempfile("sample-")
#' write_blocks(shapes, folder, block = 8)
#' stored <- open_sample(folder)
#' stored
#' align(stored)
#' unlink(folder, recursive = TRUE)
#' @export
write_blocks <- function(sample, dir, block = 500, triangles = NULL) {
  check_given()
  block <- check_count(block, "block")
  points <- if (inherits(sample, "shape_sample")) {
    validate(sample)
    if (!is.null(triangles)) {
      refuse_argument("triangles", triangles, "Leave it out: the sample has its own.")
    }
    points_of_sample(sample$template)
  } else {
    sample <- named_array(check_array(sample))
    triangles <- check_triangles(triangles, dim(sample)[1])
    points_of_array(sample)
  }
  need_parquet()
  dir <- empty_sample_folder(dir)
  ids <- if (is.array(sample)) dimnames(sample)[[3]] else names(sample)
  at <- (seq_along(ids) - 1L) %/% block + 1L
  for (i in unique(at)) write_block(specimen_points(sample, which(at == i)), points, dir, i)
  whole <- !is.array(sample)
  axes <- if (whole) c("x", "y", "z") else dimnames(sample)[[2]]
  write_sample_head(list(
    ids = ids, block = at, points = points, axes = axes, triangles = triangles,
    template = if (whole) sample$template,
    provenance = if (whole) whole_provenance(sample) else made_with()
  ), dir)
  open_sample(dir)
}

#' @rdname write_blocks
#' @export
open_sample <- function(dir) {
  check_given()
  if (!is_path(dir)) refuse_argument("dir", dir, "Give the path of one folder.")
  file <- file.path(dir, "sample.head")
  opened <- open_kept(file)
  if (opened$state != "whole") {
    refuse_blocks(sprintf("`dir` has no whole sample: %s is %s.", file, opened$state),
                  "Give the folder of write_blocks(), or write it again.")
  }
  need_parquet()
  found <- structure(c(list(dir = normalizePath(dir)), kept_value(opened)), class = "sample_files")
  absent <- block_files(found)[!file.exists(block_files(found))]
  if (length(absent)) {
    refuse_blocks(sprintf("the folder lacks %s.", shorten(basename(absent))),
                  "Copy the whole folder, or write it again.")
  }
  found
}

refuse_blocks <- function(problem, remedy) {
  crestline_abort(problem, remedy, stage = "sample", class = "crestline_blocks_error")
}

need_parquet <- function() {
  if (requireNamespace("nanoparquet", quietly = TRUE)) return(invisible())
  refuse_blocks("the package nanoparquet is not installed.",
                "Samples in files need it: install.packages(\"nanoparquet\").")
}

#' A folder that has no sample yet
#' @noRd
empty_sample_folder <- function(dir) {
  dir <- results_folder(dir)
  if (file.exists(file.path(dir, "sample.head"))) {
    refuse_blocks(sprintf("`dir`, %s, has a sample already.", dir),
                  "Choose another, or delete it.")
  }
  dir
}

#' Which points are written of every specimen, in order
#' @return Data frame: `level`, `point`, `place`.
#' @noRd
points_of_sample <- function(template) {
  at <- template$scheme$points
  landmark <- at$level == "landmarks"
  data.frame(level = at$level, point = ifelse(landmark, at$part, paste(at$part, at$point)),
             place = at$place)
}

points_of_array <- function(x) {
  name <- dimnames(x)[[1]]
  if (anyDuplicated(name)) {
    crestline_abort(sprintf("two points have the name \"%s\".", name[anyDuplicated(name)]),
                    "Name each of its own: columns of the files are found by name.",
                    stage = "sample")
  }
  data.frame(level = rep("points", length(name)), point = name, place = name)
}

#' Points of some specimens, k x d x m, of all levels
#' @noRd
specimen_points <- function(sample, which) {
  if (is.array(sample)) return(sample[, , which, drop = FALSE])
  each <- lapply(sample$shapes[which], function(shape) columns_of(shape$points, c("x", "y", "z")))
  array(unlist(each), c(dim(each[[1]]), length(which)),
        list(NULL, c("x", "y", "z"), names(sample)[which]))
}

#' Columns of points in a table: k x d, in the order of an array
#' @noRd
table_columns <- function(points, axes) {
  outer(paste(points$level, points$point), axes, paste, sep = ".")
}

#' One file of specimens, under another name until all of it is there
#'
#' @param coords k x d x m, the specimens' names its third dimension's.
#' @param points As of [points_of_sample()].
#' @noRd
write_block <- function(coords, points, dir, i) {
  name <- table_columns(points, dimnames(coords)[[2]])
  flat <- t(matrix(coords, length(name)))
  # Co-ordinates of a point side by side
  order <- as.vector(t(matrix(seq_along(name), nrow(name))))
  table <- as.data.frame(flat[, order, drop = FALSE])
  table <- cbind(id = dimnames(coords)[[3]], stats::setNames(table, name[order]))
  file <- file.path(dir, block_name(i))
  part <- tempfile(part_prefix(), dir, ".tmp")
  on.exit(unlink(part))
  refuse <- function(e) refuse_keeping(file, conditionMessage(e))
  tryCatch({
    nanoparquet::write_parquet(table, part, compression = "uncompressed", encoding = "PLAIN")
    check_table_written(part, nrow(table))
    if (!file.rename(part, file)) stop("it cannot be given its name")
  }, error = refuse, warning = refuse)
  file
}

#' A table that was written is whole: nanoparquet says nothing of a full disk
#' @noRd
check_table_written <- function(file, rows) {
  info <- tryCatch(suppressWarnings(nanoparquet::read_parquet_info(file)),
                   error = function(e) NULL)
  if (!identical(as.numeric(info$num_rows), as.numeric(rows))) {
    stop("it cannot be written there, or the disk is full")
  }
}

block_name <- function(i) sprintf("block-%04d.parquet", i)

block_files <- function(x) file.path(x$dir, block_name(seq_len(n_blocks(x))))

#' @param head List: `ids`, `block`, `points`, and what else is the same for all specimens. The hash
#'   of every block goes with it: another sample may have the same specimens.
#' @noRd
write_sample_head <- function(head, dir) {
  head$hash <- rlang::hash_file(file.path(dir, block_name(seq_len(max(head$block)))))
  keep(head, list(key = content_hash(head$ids), mesh = "none"), file.path(dir, "sample.head"))
}

n_blocks <- function(x) max(x$block, 0L)

#' Numbers of the specimens of a block
#' @noRd
block_rows <- function(x, i) which(x$block == i)

#' Points of the specimens of a block
#'
#' @param rows Which of the points; all of them by default.
#' @return k x d x m array with names.
#' @noRd
read_block <- function(x, i, rows = seq_len(nrow(x$points))) {
  file <- file.path(x$dir, block_name(i))
  points <- x$points[rows, ]
  name <- as.vector(table_columns(points, x$axes))
  table <- tryCatch(nanoparquet::read_parquet(file, col_select = c("id", name)),
                    error = function(e) NULL)
  ids <- x$ids[block_rows(x, i)]
  # Samples of former versions have no hashes.
  own <- is.null(x$hash) || file.exists(file) && identical(rlang::hash_file(file), x$hash[i])
  if (!own || is.null(table) || !identical(as.character(table$id), ids)) {
    refuse_blocks(sprintf("%s is damaged, or not of this sample.", file),
                  "Write the sample again.")
  }
  flat <- matrix(as.numeric(unlist(table[name], use.names = FALSE)), length(ids))
  array(t(flat), c(nrow(points), length(x$axes), length(ids)), list(points$point, x$axes, ids))
}

#' @export
length.sample_files <- function(x) length(unclass(x)$ids)

#' @export
names.sample_files <- function(x) unclass(x)$ids

#' @export
print.sample_files <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    count <- table(factor(x$points$level, unique(x$points$level)))
    cat("<sample_files> ", amount(length(x), "specimen"), " in ", amount(n_blocks(x), "file"),
        ": ", x$dir, "\n", sep = "")
    cat("  points: ", paste(count, names(count), collapse = ", "), "\n", sep = "")
    invisible(x)
  })
}
