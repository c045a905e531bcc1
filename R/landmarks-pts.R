# .pts of IDAV Landmark and Checkpoint: a version, the number of points, then name x y z.
# C000-001 is point 1 of curve 0; its numbers may have gaps. A missing point has 9999 three times.

read_landmarks_pts <- function(file, options) {
  line <- file_lines(file)
  count <- which(grepl("^\\s*[0-9]{1,9}\\s*$", line))[1]
  if (is.na(count)) {
    refuse_landmark_file(file, "no line with the number of points",
                         'Begin with the lines "Version 1.0" and the number of points.')
  }
  row <- setdiff(which(grepl("\\S", line)), seq_len(count))
  said <- as.integer(line[count])
  if (length(row) != said) {
    refuse_landmark_file(file, sprintf("%d points are announced, %d follow", said, length(row)),
                         "Put the right number, or the whole file.", count)
  }
  part <- pts_parts(line[row], file, row)
  x <- matrix(landmark_numbers(part[, 2:4], file, rep(row, 3)), ncol = 3)
  x[which(rowSums(x == options$missing) == 3), ] <- NA
  name <- part[, 1]
  on_curve <- pts_curve_point(name)
  curve <- sub("[._-][0-9]+$", "", name[on_curve])
  number <- as.numeric(sub("^.*[._-]", "", name[on_curve]))
  point <- x[on_curve, , drop = FALSE]
  curves <- lapply(stats::setNames(nm = unique(curve)), function(one) {
    row <- which(curve == one)
    landmark_curve(point[row[order(number[row])], , drop = FALSE])
  })
  landmark_set(x[!on_curve, , drop = FALSE], name[!on_curve], curves)
}

# The last three words are the co-ordinates; all before them is the name, blanks and all.
pts_parts <- function(text, file, line) {
  part <- regmatches(text, regexec("^\\s*(.*\\S)\\s+(\\S+)\\s+(\\S+)\\s+(\\S+)\\s*$", text))
  wrong <- which(lengths(part) == 0)
  if (length(wrong)) {
    refuse_landmark_file(file, "not a name and three numbers", "Write: name x y z.", line[wrong[1]])
  }
  part <- matrix(as.character(unlist(part)), ncol = 5, byrow = TRUE)[, -1, drop = FALSE]
  fourth <- grep("\\s[-+]?[0-9]*[.][0-9]+([eE][-+]?[0-9]+)?$", part[, 1])
  if (length(fourth)) {
    refuse_landmark_file(
      file, sprintf("more than three numbers: \"%s\" would be a name", part[fourth[1], 1]),
      "Write: name x y z, no more.", line[fourth[1]]
    )
  }
  part
}

pts_curve_point <- function(name) grepl("^C[._-]?[0-9]+[._-][0-9]+$", name)

write_landmarks_pts <- function(sets, file, options) {
  x <- sets[[1]]
  curves <- attr(x, "curves")
  name <- rownames(x)
  wrong <- name[pts_curve_point(name) | grepl("^\\s|\\s$", name)]
  if (length(wrong)) {
    refuse_landmark_file(
      file, sprintf('"%s" would not be read as the name of a landmark', wrong[1]),
      paste0("Name it otherwise: C, number, dash, number is a point of a ",
             "curve; no blanks at the ends.")
    )
  }
  # Curves have numbers only: those called C000 ... keep them, others get them, with a warning.
  number <- if (!length(curves)) character() else {
    name <- names(curves)
    closed <- vapply(curves, attr, TRUE, "closed")
    number <- sprintf("C%03d", seq_along(curves) - 1L)
    if (all(grepl("^C[._-]?[0-9]+$", name))) number <- name
    if (!identical(number, name) || any(closed)) {
      crestline_warn(
        sprintf("%s: .pts has curves by number and open only: %s.", basename(file), paste(
          number, "is", paste0(name, ifelse(closed, " (closed)", "")), collapse = ", ")),
        "Keep a .mrk.json, .tps or .csv as well.", stage = "landmarks",
        class = "crestline_format_warning"
      )
    }
    number
  }
  point <- unlist(lapply(seq_along(curves), function(i) {
    sprintf("%s-%03d %s", number[i], seq_len(nrow(curves[[i]])) - 1,
            pts_rows(curves[[i]], file, options))
  }))
  row <- c(if (nrow(x)) paste(rownames(x), pts_rows(x, file, options)), point)
  write_file_lines(c("Version 1.0", sprintf("%d", length(row)), row), file)
}

pts_rows <- function(x, file, options) {
  if (any(rowSums(x == options$missing) == 3, na.rm = TRUE)) {
    refuse_landmark_file(
      file, sprintf("a point at %s three times would be read as missing", options$missing),
      "Give another number as `missing`."
    )
  }
  row_text(x, missing = number_text(options$missing))
}
