# Landmarks and curves as comma-separated values: name, x, y, z and, for points of curves, curve,
# closed. 3D Slicer exports its lists as such tables with r, a, s (or l, p, s) in place of x, y, z;
# several specimens have a column of them.

read_landmarks_csv <- function(file, options) {
  refuse <- function(problem, line = NULL) refuse_csv(file, problem, line)
  csv_sets(text_table(file_lines(file), refuse), file, options, refuse)
}

#' @param table As of [text_table()].
#' @return One set, or a named list where a column names specimens.
#' @noRd
csv_sets <- function(table, file, options, refuse) {
  names(table) <- tolower(names(table))
  # The columns of co-ordinates, and the frame that their names say (NULL: x, y, z say none).
  known <- list(c("x", "y", "z"), RAS = c("r", "a", "s"), LPS = c("l", "p", "s"))
  whole <- which(vapply(known, function(one) all(one %in% names(table)), NA))
  if (length(whole) > 1) refuse(sprintf("co-ordinates twice: %s", toString(unlist(known[whole]))))
  if (!length(whole)) {
    refuse(sprintf("no column %s among %s", toString(setdiff(known[[1]], names(table))),
                   shorten(names(table))))
  }
  frame <- list(columns = known[[whole]], frame = if (whole > 1) names(known)[whole])
  table <- decimal_points(table, frame$columns, refuse)
  line <- attr(table, "line")
  x <- vapply(frame$columns, function(name) landmark_numbers(table[[name]], file, line),
              numeric(nrow(table)))
  x <- matrix(x, ncol = 3)
  if (!is.null(table$defined)) x[tolower(table$defined) %in% c("0", "false"), ] <- NA
  if (!is.null(frame$frame)) x <- change_frame(x, frame$frame, options$frame)
  column <- csv_columns(table, frame$columns)
  if (is.null(column$specimen)) return(csv_set(x, table, column$label, line, refuse))
  # Ids of specimens, blanks at their ends aside.
  id <- table[[column$specimen]]
  id <- trimws(id)
  if (any(!nzchar(id))) refuse("no specimen is named", line[!nzchar(id)][1])
  name <- unique(id)
  alike <- which(duplicated(plain_id(name)))
  if (length(alike)) {
    first <- name[match(plain_id(name[alike[1]]), plain_id(name))]
    refuse(sprintf("\"%s\" and \"%s\" seem to be one specimen", first, name[alike[1]]),
           line[match(name[alike[1]], id)])
  }
  specimen <- id
  lapply(split(seq_along(specimen), factor(specimen, unique(specimen))), function(row) {
    csv_set(x[row, , drop = FALSE], table[row, , drop = FALSE], column$label, line[row], refuse)
  })
}

#' Which column names the landmarks, and which the specimens
#'
#' A column called id or name may number the points as well: it names specimens only where landmarks
#' would be named twice without it.
#'
#' @return List: `label`, `specimen`: names of columns, NULL where there is none.
#' @noRd
csv_columns <- function(table, xyz) {
  other <- setdiff(names(table), c(xyz, "curve", "closed"))
  label <- intersect(names(table), c("name", "landmark", "label"))
  strong <- setdiff(names(table)[is_key_column(names(table))], c(label, "id"))[1]
  if (!is.na(strong)) return(list(label = c(label, setdiff(other, strong))[1], specimen = strong))
  one <- list(label = c(label, other)[1])
  row <- if (is.null(table$curve)) rep(TRUE, nrow(table)) else !nzchar(table$curve)
  twice <- function(...) anyDuplicated(paste(..., sep = "\r")[row]) > 0
  if (!length(label) || !twice(table[[label[1]]])) return(one)
  for (name in intersect(c("landmark", "label", "name"), label)) {
    for (key in setdiff(intersect(c("id", "name", "label"), names(table)), name)) {
      if (!twice(table[[key]], table[[name]]) &&
          twice(table[[key]])) return(list(label = name, specimen = key))
    }
  }
  one
}

csv_set <- function(x, table, label, line, refuse) {
  curve <- if (is.null(table$curve)) character(nrow(table)) else table$curve
  single <- !nzchar(curve)
  if (is.null(label) || is.na(label)) {
    if (any(single) || is.null(table$curve)) refuse("no column of names")
    name <- character()
  } else {
    name <- table[[label]][single]
    # Every landmark has a name; the same name twice has the same place.
    if (any(!nzchar(name))) refuse("a point has no name", line[single][!nzchar(name)][1])
    again <- if (anyDuplicated(name))
      which(duplicated(name) & !duplicated(data.frame(name, x[single, , drop = FALSE])))
    if (length(again)) {
      refuse(sprintf("the landmark %s is there twice", name[again[1]]), line[single][again[1]])
    }
  }
  # The points of a curve by their numbers in a column `point` where there are such, else in the
  # order of the rows.
  curves <- unique(curve[nzchar(curve)])
  is_closed <- tolower(table$closed) %in% c("true", "t", "yes", "1")
  number <- if (is.null(table$point)) seq_along(curve) else
    suppressWarnings(as.numeric(table$point))
  curves <- lapply(stats::setNames(nm = curves), function(one) {
    row <- which(curve == one)
    if (!anyNA(number[row])) row <- row[order(number[row])]
    landmark_curve(x[row, , drop = FALSE], isTRUE(is_closed[row[1]]))
  })
  landmark_set(x[single, , drop = FALSE], name, curves)
}

refuse_csv <- function(file, reason, line = NULL) {
  refuse_landmark_file(file, paste("cannot be read:", reason),
                       "Give a header line with name, x, y, z; commas, semicolons or tabs between.",
                       line)
}

write_landmarks_csv <- function(sets, file, options) {
  x <- sets[[1]]
  curves <- attr(x, "curves")
  single <- if (nrow(x)) paste(quote_name(rownames(x)), row_text(x, sep = ","), sep = ",")
  if (!length(curves)) return(write_file_lines(c('"name","x","y","z"', single), file))
  point <- lapply(names(curves), function(name) {
    closed <- attr(curves[[name]], "closed")
    paste('""', row_text(curves[[name]], sep = ","), quote_name(name), closed, sep = ",")
  })
  if (nrow(x)) single <- paste0(single, ",,")
  write_file_lines(c('"name","x","y","z","curve","closed"', single, unlist(point)), file)
}
