# Tables as text: the one reader of comma-separated files, whatever a spreadsheet has made of them.

#' A table from the lines of a file
#'
#' Fields are counted against the header, so that no value can move into another column. What
#' spreadsheets leave is taken off: a line `sep=;`, comments (#) above the header, empty rows and
#' columns, a separator at the end of all rows.
#'
#' @param line Lines of text, as of file_lines().
#' @param refuse Function that stops, of a problem and the number of its line.
#' @return Data frame of text, without blanks around unquoted cells, "" where empty; attributes
#'   `line` (of each row) and `sep`.
#' @noRd
text_table <- function(line, refuse) {
  start <- table_start(line)
  at <- start$at
  if (!length(at)) refuse("there is no header line", NULL)
  sep <- if (is.null(start$sep)) {
    # Spreadsheets write semicolons, and decimal commas, where the comma is the decimal mark; some
    # write tabs.
    bare <- strsplit(gsub("\"[^\"]*\"", "", line[at[1]]), "")[[1]]
    marks <- c(",", ";", "\t")
    marks[which.max(vapply(marks, function(mark) sum(bare == mark), 0))]
  } else start$sep
  record <- table_records(line, at, sep, refuse)
  header <- trimws(record$field[[1]])
  if (sum(!is.na(suppressWarnings(as.numeric(header)))) > 1) {
    refuse("there is no header line: the first line holds numbers", at[1])
  }
  name <- tolower(header[nzchar(header)])
  again <- name[anyDuplicated(name)]
  if (length(again)) refuse(sprintf("two columns are called \"%s\"", again), at[1])
  full <- vapply(record$field, function(field) any(nzchar(field)), NA)
  full[1] <- FALSE
  field <- record$field[full]
  row <- record$line[full]
  # Rows of as many cells as the header has names; all rows may end in the same number of empty
  # cells more
  named <- max(which(nzchar(header)), 0)
  width <- if (length(field)) length(field[[1]]) else length(header)
  even <- all(lengths(field) == width) && width >= named
  if (even && width != length(header)) {
    even <- !any(nzchar(unlist(lapply(field, utils::tail, width - named))))
  }
  if (!even) {
    wrong <- which(lengths(field) != length(header))[1]
    refuse(sprintf("%s where the header has %d", amount(length(field[[wrong]]), "field"),
                   length(header)), row[wrong])
  }
  cells <- matrix(as.character(unlist(field)), ncol = width, byrow = TRUE)
  cells <- cells[, seq_len(min(width, length(header))), drop = FALSE]
  structure(named_columns(cells, header, row, refuse), line = row, sep = sep)
}

#' The lines of a table from its header on, and the separator that a line `sep=` above it names
#' @noRd
table_start <- function(line) {
  at <- grep("\\S", line, perl = TRUE)
  sep <- regexec("^\\s*\"?sep=(.)\"?[,;\t]*$", line[at[1]], ignore.case = TRUE)
  said <- if (length(at)) regmatches(line[at[1]], sep)[[1]]
  if (length(said)) at <- at[-1]
  first <- which(!grepl("^\\s*\"?#", line[at], perl = TRUE))[1]
  list(at = if (!is.na(first)) at[first:length(at)], sep = if (length(said)) said[2])
}

#' The fields of every record; a quoted field may run over several lines
#' @return List: `field` (list of character vectors), `line` (where each record begins).
#' @noRd
table_records <- function(line, at, sep, refuse) {
  text <- line[at]
  field <- split_fields(text, sep)
  broken <- which(lengths(field) == 0)
  quotes <- if (length(broken)) nchar(gsub("[^\"]", "", text))
  for (i in broken) {
    if (is.na(text[i])) next
    later <- seq(i, length(text))
    for (end in later[cumsum(quotes[later]) %% 2 == 0]) {
      field[i] <- split_fields(paste(text[i:end], collapse = "\n"), sep)
      if (length(field[[i]])) break
    }
    if (!length(field[[i]])) {
      refuse("a quotation mark is not closed, or text stands behind a closed one", at[i])
    }
    text[setdiff(i:end, i)] <- NA
  }
  list(field = field[!is.na(text)], line = at[!is.na(text)])
}

#' Fields of each text; none where quotation marks do not fit
#' @noRd
split_fields <- function(text, sep) {
  field <- strsplit(paste0(text, sep, "|"), sep, fixed = TRUE)
  last <- cumsum(lengths(field))
  line <- rep(seq_along(field), lengths(field))[-last]
  cell <- unlist(field)[-last]
  loose <- grepl("^\\s|\\s$", cell, perl = TRUE)
  cell[loose] <- trimws(cell[loose])
  marked <- which(grepl("\"", cell, fixed = TRUE))
  inner <- substr(cell[marked], 2, nchar(cell[marked]) - 1)
  whole <- cell[marked] == paste0("\"", inner, "\"") & !grepl("\"", inner, fixed = TRUE)
  cell[marked[whole]] <- inner[whole]
  field <- unname(split(cell, factor(line, seq_along(text))))
  again <- unique(line[marked[!whole]])
  # A field is quoted as a whole, with quotes in it doubled, or has none at its start.
  pattern <- gsub("@", paste0("\\Q", sep, "\\E"),
                  "@(?: *\"[^\"]*(?:\"\"[^\"]*)*\" *| *[^\" @][^@]*| *)(?=@|\\z)", fixed = TRUE)
  field[again] <- lapply(paste0(sep, text[again]), function(one) {
    part <- regmatches(one, gregexpr(pattern, one, perl = TRUE))[[1]]
    if (sum(nchar(part)) != nchar(one)) return(character())
    part <- trimws(substring(part, 2))
    quoted <- startsWith(part, "\"")
    inside <- substr(part[quoted], 2, nchar(part[quoted]) - 1)
    part[quoted] <- gsub("\"\"", "\"", inside, fixed = TRUE)
    part
  })
  field
}

#' Columns under their names. Empty ones without a name are left out; the first may do without, as
#' row names have none
#' @noRd
named_columns <- function(cells, header, line, refuse) {
  header <- header[seq_len(ncol(cells))]
  nameless <- which(!nzchar(header))
  filled <- nameless[colSums(cells[, nameless, drop = FALSE] != "") > 0]
  beyond <- setdiff(filled, 1)
  if (length(beyond)) {
    refuse(sprintf("column %d holds something and has no name", beyond[1]),
           line[which(nzchar(cells[, beyond[1]]))[1]])
  }
  kept <- setdiff(seq_along(header), setdiff(nameless, filled))
  header[filled] <- "row names"
  table <- lapply(kept, function(i) cells[, i])
  attributes(table) <- list(
    names = header[kept], row.names = seq_len(nrow(cells)), class = "data.frame"
  )
  table
}

#' Decimal commas as points in some columns of a table whose separator is none
#'
#' @return The table. Refused where some numbers have a comma and others a point: one of them would
#'   be of thousands.
#' @noRd
decimal_points <- function(table, columns, refuse) {
  if (attr(table, "sep") == ",") return(table)
  text <- as.matrix(table[columns])
  comma <- grepl(",", text, fixed = TRUE)
  point <- grepl(".", text, fixed = TRUE)
  if (any(comma & !point) && any(point & !comma)) {
    at <- which(comma & !point)[1]
    other <- text[point & !comma][1]
    refuse(sprintf("\"%s\" has a decimal comma, \"%s\" a point", text[at], other),
           attr(table, "line")[row(text)[at]])
  }
  table[columns] <- lapply(table[columns], sub, pattern = ",", replacement = ".", fixed = TRUE)
  table
}
