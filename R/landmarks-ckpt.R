# .ckpt of Stratovan Checkpoint, read only: sections in square brackets; under [Landmarks] the
# number of points and a line each, "number: ? state ? x y z, a normal and the name in quotes", the
# state N, or M of a missing point. [SinglePoints] lists those that are landmarks; the others are of
# curves and patches.

read_landmarks_ckpt <- function(file, options) {
  line <- file_lines(file)
  if (!any(grepl("Checkpoint", utils::head(line, 5), fixed = TRUE))) {
    refuse_landmark_file(file, "not a file of Stratovan Checkpoint",
                         "Save it anew from Checkpoint, or export .pts.")
  }
  row <- ckpt_rows(line, "NumberOfPoints", file)
  # Number, state, co-ordinates and name of every point
  pattern <- paste0("^\\s*([0-9]+):\\s+\\S+\\s+(\\S+)\\s+\\S+\\s+(\\S+)\\s+(\\S+)\\s+(\\S+)",
                    "(?:\\s+[^\\s\"]+)*\\s+\"(.*)\"[^\"]*$")
  part <- regmatches(line[row], regexec(pattern, line[row], perl = TRUE))
  wrong <- which(lengths(part) == 0)
  if (length(wrong)) {
    refuse_landmark_file(file, "not a point of Checkpoint",
                         "Write: 0: 0 N 0x8 x y z, a normal, \"name\" 0 1.", row[wrong[1]])
  }
  part <- matrix(as.character(unlist(part)), ncol = 7, byrow = TRUE)[, -1, drop = FALSE]
  state <- which(!part[, 2] %in% c("N", "M", "U"))
  if (length(state)) {
    said <- sprintf("the state of a point is \"%s\", not N or M", part[state[1], 2])
    refuse_landmark_file(file, said, "Save it anew.", row[state[1]])
  }
  x <- matrix(landmark_numbers(part[, 3:5], file, rep(row, 3)), ncol = 3)
  x[part[, 2] != "N", ] <- NA
  # Which points are landmarks: all where the file does not say
  number <- part[, 1]
  row <- ckpt_rows(line, "NumberOfSinglePoints", file, needed = FALSE)
  single <- if (is.null(row)) rep(TRUE, length(number)) else number %in%
    sub("^\\s*[0-9]+:\\s*([0-9]+).*$", "\\1", line[row])
  if (any(!single)) {
    crestline_warn(
      sprintf("%s: %d points of curves and patches are left out.", basename(file), sum(!single)),
      "Export them from Checkpoint as .pts.", stage = "landmarks",
      class = "crestline_format_warning"
    )
  }
  name <- ifelse(nzchar(part[, 6]), part[, 6], part[, 1])
  landmark_set(x[single, , drop = FALSE], name[single])
}

#' The lines that a count announces: those with a number and a colon in its section
#' @noRd
ckpt_rows <- function(line, key, file, needed = TRUE) {
  at <- grep(paste0("^\\s*", key, ":\\s*[0-9]{1,9}\\s*$"), line)[1]
  if (is.na(at)) {
    if (!needed) return(NULL)
    refuse_landmark_file(file, sprintf("no line %s", key), "Put the whole file.")
  }
  said <- as.integer(sub("^.*:", "", line[at]))
  end <- c(grep("^\\s*\\[", line), length(line) + 1)
  within <- seq_len(end[end > at][1] - 1)
  row <- within[within > at & grepl("^\\s*[0-9]+:", line[within])]
  if (length(row) != said) {
    refuse_landmark_file(file, sprintf("%d points are announced, %d follow", said, length(row)),
                         "Put the whole file.", at)
  }
  row
}
