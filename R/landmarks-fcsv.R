# .fcsv of 3D Slicer: comment lines with version, co-ordinate system and columns, then one point a
# line. After the named columns Slicer writes the state of the point: 0 undefined, 1 preview, 2
# defined, 3 missing.

read_landmarks_fcsv <- function(file, options) {
  line <- file_lines(file)
  comment <- grepl("^#", line)
  row <- which(!comment & grepl("\\S", line))
  column <- fcsv_header(line[comment], "columns")
  if (is.na(column)) column <- "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatednodeid"
  column <- tolower(trimws(strsplit(column, ",", fixed = TRUE)[[1]]))
  if (!all(c("x", "y", "z") %in% column)) {
    refuse_landmark_file(file, "no columns x, y, z",
                         "Give them in the line # columns = id,x,y,z,...")
  }
  # The fields of each line.
  field <- split_fields(line[row], ",")
  few <- which(lengths(field) < max(match(c("x", "y", "z"), column)))
  if (length(few)) {
    refuse_landmark_file(file, "too few fields", "Put the whole file; quote labels with commas.",
                         row[few[1]])
  }
  check_fcsv_fields(field, column, row, file)
  # Matrix of strings, a row a line, as wide as the widest and no less than the columns.
  width <- max(length(column), lengths(field))
  full <- lapply(field, function(value) c(value, rep("", width - length(value))))
  field <- matrix(as.character(unlist(full)), ncol = width, byrow = TRUE)
  xyz <- field[, match(c("x", "y", "z"), column)]
  x <- matrix(landmark_numbers(xyz, file, rep(row, 3)), ncol = 3)
  state <- length(column) + 1
  absent <- if (ncol(field) < state || !"associatednodeid" %in% column) logical(nrow(field)) else
    !trimws(field[, state]) %in% c("", "2")
  x[absent, ] <- NA
  frame <- slicer_frame(fcsv_frame(line[comment]), file)
  # Labels; where there is none the id, else the number of the point.
  label <- if ("label" %in% column) field[, match("label", column)] else character(nrow(field))
  id <- if ("id" %in% column) field[, match("id", column)] else character(nrow(field))
  label <- ifelse(nzchar(label), label, id)
  landmark_set(change_frame(x, frame, options$frame),
               ifelse(nzchar(label), label, as.character(seq_along(label))))
}

# The value of a comment "# key = value", or NA.
fcsv_header <- function(comment, key) {
  pattern <- paste0("^#.*\\b", key, "\\s*=\\s*")
  sub(pattern, "", grep(pattern, comment, ignore.case = TRUE, value = TRUE), ignore.case = TRUE)[1]
}

# Files before version 4.11 that do not say are RAS, later ones LPS.
fcsv_frame <- function(comment) {
  said <- fcsv_header(comment, "CoordinateSystem")
  if (!is.na(said)) return(trimws(said))
  version <- regmatches(comment, regexpr("version *= *[0-9]+([.][0-9]+)+", comment))[1]
  if (is.na(version) || numeric_version(sub("^[^0-9]*", "", version)) < "4.11") "RAS" else "LPS"
}

# As many fields as there are columns, or two more: the state of the point, and whether it was made
# by itself.
check_fcsv_fields <- function(field, column, line, file) {
  state <- vapply(field, function(value) value[length(column) + 1], "")
  more <- lengths(field) - length(column)
  wrong <- which(!(more == 0 | more == 2 & trimws(state) %in% c("", 0:3)))
  if (length(wrong)) {
    refuse_landmark_file(
      file,
      sprintf("%d fields where there are %d columns", lengths(field)[wrong[1]], length(column)),
      "Quote labels and descriptions that hold commas.", line[wrong[1]]
    )
  }
}

write_landmarks_fcsv <- function(sets, file, options) {
  x <- sets[[1]]
  quoted <- ifelse(grepl("[,\"#']|^\\s|\\s$", rownames(x)), quote_name(rownames(x)), rownames(x))
  state <- ifelse(is.na(x[, 1]), "0", "2")
  position <- row_text(x, missing = "0", sep = ",")
  row <- paste(sprintf("%d", seq_len(nrow(x))), position, "0,0,0,1,1,1,0", quoted, "", "", state,
               "0", sep = ",")
  write_file_lines(c(
    "# Markups fiducial file version = 4.11", paste("# CoordinateSystem =", options$frame),
    "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID",
    if (nrow(x)) row
  ), file)
}
