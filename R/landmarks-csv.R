# Landmarks as comma-separated values: name, x, y, z.

read_landmarks_csv <- function(file) {
  table <- tryCatch(
    suppressWarnings(utils::read.csv(text = csv_lines(file), colClasses = "character", strip.white = TRUE,
                                     na.strings = character(), check.names = FALSE)),
    error = function(e) refuse_csv(file, conditionMessage(e))
  )
  names(table) <- tolower(trimws(names(table)))
  xyz <- match(c("x", "y", "z"), names(table))
  if (anyNA(xyz)) refuse_csv(file, sprintf("no column %s", paste(c("x", "y", "z")[is.na(xyz)], collapse = ", ")))
  x <- vapply(xyz, function(i) csv_numbers(table[[i]], names(table)[i], file), numeric(nrow(table)))
  x <- matrix(x, ncol = 3, dimnames = list(NULL, c("x", "y", "z")))
  label <- names(table) %in% c("name", "landmark", "label")
  if (!any(label)) label <- !seq_along(table) %in% xyz
  if (!any(label)) refuse_csv(file, "no column of names")
  rownames(x) <- table[[which(label)[1]]]
  x
}

# UTF-8, with or without a mark of it; else taken for Latin 1, as Windows writes names with accents.
csv_lines <- function(file) {
  line <- readLines(file, warn = FALSE, skipNul = TRUE)
  line <- if (all(validUTF8(line))) enc2utf8(`Encoding<-`(line, "UTF-8")) else iconv(line, "latin1", "UTF-8")
  line[1] <- sub("^\ufeff", "", line[1])
  line
}

csv_numbers <- function(text, column, file) {
  missing <- text %in% c("", "NA", "NaN", "na", "nan")
  number <- suppressWarnings(as.numeric(ifelse(missing, NA, text)))
  wrong <- which(is.na(number) & !missing)
  if (length(wrong)) {
    refuse_csv(file, sprintf('line %d, column %s: "%s" is not a number', wrong[1] + 1, column, text[wrong[1]]))
  }
  number
}

refuse_csv <- function(file, reason) {
  crestline_abort(sprintf("%s cannot be read: %s.", basename(file), reason),
                  "Give a header line with name, x, y, z, commas between, points in numbers.",
                  stage = "landmarks", call = NULL)
}

write_landmarks_csv <- function(x, file) {
  table <- data.frame(name = as.character(rownames(x)), x = x[, 1], y = x[, 2], z = x[, 3])
  number <- function(v) ifelse(is.na(v), "NA", format(v, digits = 15, trim = TRUE))
  table[2:4] <- lapply(table[2:4], function(v) vapply(v, number, ""))
  utils::write.csv(table, file, row.names = FALSE, quote = 1)
}
