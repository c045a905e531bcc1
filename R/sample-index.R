# The index of a folder of results: a line for each file, so that a batch is opened, printed and
# counted without reading its results. It is a copy of what lies in the files: a line counts only
# where size and time of its file are those that it names, and the others are made anew.

index_columns <- c("file", "size", "time", "state", "key", "mesh", "setting", "id", "found",
                   "lacking", "of", "unit", "surface", "marks", "red", "scheme_key", "scheme",
                   "words", "more", "end")

#' All results and failures of a folder, a row each, from its index and, where that does not know
#' them, from their files
#'
#' @return Data frame of [index_columns], all text; `path`. Rows are in the order of the files'
#'   names.
#' @noRd
folder_index <- function(dir) {
  files <- list.files(dir, "[.](shape|failure)$")
  there <- file.info(file.path(dir, files), extra_cols = FALSE)
  rows <- read_index(dir)
  at <- match(files, rows$file)
  fresh <- !is.na(at) & rows$size[at] == size_text(there) & rows$time[at] == time_text(there)
  index <- rows[at, ]
  new <- lapply(file.path(dir, files[which(!fresh)]), index_row)
  if (length(new)) {
    new <- do.call(rbind, new)
    index[which(!fresh), ] <- new
    known <- index_lines(new) %in% attr(rows, "unclear")
    if (!all(known)) append_index(new[!known, ], dir)
  }
  index$path <- file.path(dir, files)
  rownames(index) <- NULL
  index
}

size_text <- function(info) sprintf("%.0f", info$size)

time_text <- function(info) sprintf("%.6f", as.numeric(info$mtime))

#' The lines of all index files, of each result the last
#'
#' A line that was cut short, by a full disk or a process that was killed, is left out.
#' @param kind First word of the files' names.
#' @param columns Names of their columns, `file` the first and `end` the last.
#' @param most Files of which one is made where there are more.
#' @return Data frame of `columns`; attribute `unclear`: the lines of ambiguous files, which are
#'   left out.
#' @noRd
read_index <- function(dir, kind = "index", columns = index_columns, most = 8) {
  parts <- list.files(dir, sprintf("^%s-.*[.]tsv$", kind), full.names = TRUE)
  lines <- unlist(lapply(parts, function(part) {
    tryCatch(suppressWarnings(readLines(part, encoding = "UTF-8")), error = function(e) NULL)
  }))
  fields <- strsplit(as.character(lines), "\t", fixed = TRUE)
  whole <- lengths(fields) == length(columns)
  table <- matrix(as.character(unlist(fields[whole])), ncol = length(columns), byrow = TRUE,
                  dimnames = list(NULL, columns))
  table <- as.data.frame(table)
  table <- table[table$end == ".", ]
  # Measures are used by the key of their result only.
  unclear <- if (kind == "index") ambiguous_files(table)
  left_out <- table$file %in% unclear
  said <- if (any(left_out)) index_lines(table[left_out, ])
  table <- table[!left_out & !duplicated(table$file, fromLast = TRUE), ]
  if (length(parts) > most) merge_index(table, parts, dir, kind)
  structure(table, unclear = said)
}

#' Files of which two lines say different things, though they name the same size and time: on a disk
#' with coarse times one of them may be of a result that was replaced
#' @noRd
ambiguous_files <- function(table) {
  seen <- paste(table$file, table$size, table$time, sep = "\t")
  unique(table$file[table$key != table$key[match(seen, seen)]])
}

#' One index file in place of many. A line that another process adds meanwhile may be lost: it is
#' made anew from its file
#' @noRd
merge_index <- function(table, parts, dir, kind) {
  part <- tempfile(part_prefix(), dir, ".tmp")
  merged <- file.path(dir, sprintf("%s-%s.tsv", kind, substr(basename(part), 6, 60)))
  on.exit(unlink(part))
  written <- tryCatch({
    write_whole(charToRaw(paste0(index_lines(table), "\n", collapse = "")), part)
    file.rename(part, merged)
  }, error = function(e) FALSE, warning = function(w) FALSE)
  if (written) unlink(setdiff(parts, merged))
}

index_lines <- function(rows) {
  do.call(paste, c(unname(lapply(rows, function(x) enc2utf8(as.character(x)))), sep = "\t"))
}

#' Add lines to this process's own index file; nothing where that cannot be: an index may be absent
#' @noRd
append_index <- function(rows, dir, kind = "index") {
  name <- sub("-$", ".tsv", sub("^part", kind, part_prefix()))
  text <- paste0(index_lines(rows), "\n", collapse = "")
  tryCatch({
    to <- suppressWarnings(file(file.path(dir, name), "ab"))
    tryCatch(writeBin(charToRaw(text), to), finally = close(to))
  }, error = function(e) NULL, warning = function(w) NULL)
  invisible()
}

#' What the index says of a file
#' @param opened As of [open_kept()]; what was just written is known already.
#' @noRd
index_row <- function(file, opened = open_kept(file)) {
  info <- file.info(file, extra_cols = FALSE)
  about <- opened$about
  failed <- !is.null(about$failure)
  told <- as_told(about)
  more <- if (failed) about$failure else if (NROW(about$warnings)) about["warnings"]
  row <- list(basename(file), size_text(info), time_text(info),
              if (failed && opened$state == "whole") "failed" else opened$state, about$key,
              about$mesh, about$setting, about$id, told$found, told$lacking[1], told$lacking[2],
              sprintf("%.17g", told$unit), told$surface, told$marks, told$red, about$scheme$key,
              about$scheme$name, about$words,
              if (!is.null(more)) jsonlite::toJSON(more, auto_unbox = TRUE, null = "null"), ".")
  row <- vapply(row, function(value) c(as.character(value), NA)[1], "")
  as.data.frame(as.list(stats::setNames(one_line(row), index_columns)))
}

#' Text without tabs and ends of lines
#' @noRd
one_line <- function(x) gsub("[\t\r\n]+", " ", enc2utf8(ifelse(is.na(x), "", x)))

text_or_na <- function(x) ifelse(nzchar(x), x, NA_character_)

#' Results that are whole, as kept shapes, by id
#' @noRd
kept_in_index <- function(index) {
  number <- function(x) suppressWarnings(as.numeric(x))
  lacking <- as.integer(number(index$lacking))
  of <- as.integer(number(index$of))
  unit <- number(index$unit)
  red <- as.integer(number(index$red))
  surface <- text_or_na(index$surface)
  marks <- text_or_na(index$marks)
  found <- index$found == "TRUE"
  lapply(seq_len(nrow(index)), function(i) {
    kept <- list()
    attributes(kept) <- list(
      file = index$path[i], key = text_or_na(index$key[i]), id = index$id[i],
      warnings = if (nzchar(index$more[i])) {
        known <- jsonlite::fromJSON(index$more[i])$warnings
        if (NROW(known)) as.data.frame(known)
      },
      seen = c(index$size[i], index$time[i]), found = found[i], lacking = c(lacking[i], of[i]),
      unit = unit[i], surface = surface[i], marks = marks[i], red = red[i],
      class = c("kept_shape", "shape")
    )
    kept
  })
}
