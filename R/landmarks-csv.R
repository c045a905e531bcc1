# Landmarks and curves as comma-separated values: name, x, y, z and, for points of curves, curve, closed.

# Spreadsheets write semicolons, and decimal commas, where the comma is the decimal mark; some write tabs.
csv_separator <- function(header) {
  marks <- c(",", ";", "\t")
  marks[which.max(vapply(marks, function(mark) sum(strsplit(header, "")[[1]] == mark), 0))]
}

read_landmarks_csv <- function(file, options) {
  line <- file_lines(file)
  sep <- csv_separator(c(line, "")[1])
  table <- tryCatch(
    suppressWarnings(utils::read.csv(text = line, sep = sep, colClasses = "character", strip.white = TRUE,
                                     na.strings = character(), check.names = FALSE)),
    error = function(e) refuse_csv(file, conditionMessage(e))
  )
  names(table) <- tolower(trimws(names(table)))
  xyz <- match(c("x", "y", "z"), names(table))
  if (anyNA(xyz)) refuse_csv(file, sprintf("no column %s", paste(c("x", "y", "z")[is.na(xyz)], collapse = ", ")))
  if (sep == ";") table[xyz] <- lapply(table[xyz], sub, pattern = ",", replacement = ".", fixed = TRUE)
  x <- vapply(xyz, function(i) landmark_numbers(table[[i]], file, seq_len(nrow(table)) + 1), numeric(nrow(table)))
  x <- matrix(x, ncol = 3)
  curve <- if ("curve" %in% names(table)) table$curve else character(nrow(table))
  single <- !nzchar(curve)
  landmark_set(x[single, , drop = FALSE], csv_labels(table, single, file), csv_curves(x, curve, table$closed))
}

csv_labels <- function(table, single, file) {
  label <- names(table) %in% c("name", "landmark", "label")
  if (!any(label)) label <- !names(table) %in% c("x", "y", "z", "curve", "closed")
  if (!any(label) && (any(single) || !"curve" %in% names(table))) refuse_csv(file, "no column of names")
  if (any(single) || any(label)) table[[which(label)[1]]][single] else character()
}

csv_curves <- function(x, curve, closed) {
  name <- unique(curve[nzchar(curve)])
  is_closed <- tolower(closed) %in% c("true", "t", "yes", "1")
  lapply(stats::setNames(name, name), function(one) {
    landmark_curve(x[curve == one, , drop = FALSE], isTRUE(is_closed[match(one, curve)]))
  })
}

refuse_csv <- function(file, reason) {
  refuse_landmark_file(file, paste("cannot be read:", reason),
                       "Give a header line with name, x, y, z, and commas, semicolons or tabs between.")
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
