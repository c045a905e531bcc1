# .landmarkAscii of Amira and Avizo: define Markers n, Parameters,
# Markers { float[3] Coordinates } @1, data after @1. Several sets of co-ordinates are several
# specimens. The format has no names: they stand among the parameters. A missing point is NaN.

read_landmarks_amira <- function(file, options) {
  line <- file_lines(file)
  if (!grepl("^#.*ASCII", line[1])) {
    refuse_landmark_file(file, "not an AmiraMesh or Avizo file in ASCII",
                         "Save it as ASCII, not binary.", 1)
  }
  count <- regmatches(line, regexec("^\\s*define\\s+Markers\\s+([0-9]{1,9})", line))
  count <- unlist(lapply(count, `[`, 2))
  if (all(is.na(count))) {
    refuse_landmark_file(file, "no line define Markers",
                         "Give the number of points: define Markers 23.")
  }
  n <- as.integer(count[!is.na(count)][1])
  name <- amira_names(line, "Names", n)
  # The numbers after @ of every set of co-ordinates, in the order of their declaration.
  pattern <- paste0("Markers\\s*[{]\\s*(float|double)\\[3\\]\\s*",
                    "Coordinates[0-9]*\\s*[}]\\s*=?\\s*@([0-9]+)")
  section <- unlist(lapply(regmatches(line, regexec(pattern, line)), `[`, 3))
  section <- section[!is.na(section)]
  if (!length(section)) {
    refuse_landmark_file(file, "no co-ordinates are declared",
                         "Write: Markers { float[3] Coordinates } @1.")
  }
  sets <- lapply(section, function(at) landmark_set(amira_rows(line, at, n, file), name))
  specimen <- amira_names(line, "Sets", length(sets))
  structure(stats::setNames(sets, if (is.null(specimen)) seq_along(sets) else specimen),
            numbered = is.null(specimen))
}

amira_rows <- function(line, section, n, file) {
  mark <- grep("^\\s*@[0-9]+\\s*$", line)
  at <- mark[trimws(line[mark]) == paste0("@", section)][1]
  if (is.na(at)) refuse_landmark_file(file, sprintf("no data @%s", section), "Put the whole file.")
  end <- c(mark[mark > at], length(line) + 1)[1]
  row <- seq_len(end - at - 1) + at
  row <- row[grepl("\\S", line[row])]
  if (length(row) != n) {
    refuse_landmark_file(file,
                         sprintf("%d points are announced, %d follow @%s", n, length(row), section),
                         "Put the right number, or the whole file.", at)
  }
  landmark_rows(line[row], 3, file, row)
}

# The n names of the parameter `key { N1 "a", N2 "b" }`, or NULL.
amira_names <- function(line, key, n) {
  found <- grep(paste0("(^|[ ,])", key, " [{] "), line, value = TRUE)[1]
  if (is.na(found)) return(NULL)
  found <- sub(paste0("^.*?(^|[ ,])", key, " [{] "), "", found, perl = TRUE)
  name <- regmatches(found,
                     gregexpr('N[0-9]+ "(\\\\.|[^"\\\\])*"', found, perl = TRUE))[[1]][seq_len(n)]
  if (!anyNA(name)) gsub("\\\\(.)", "\\1", sub('"$', "", sub('^N[0-9]+ "', "", name)))
}

write_landmarks_amira <- function(sets, file, options) {
  check_nts_sets(sets, file)
  x <- sets[[1]]
  number <- seq_along(sets)
  coordinates <- paste0("Coordinates", c("", number[-1]))
  write_file_lines(c(
    "# AmiraMesh 3D ASCII 2.0", "", sprintf("define Markers %d", nrow(x)), "",
    "Parameters {", sprintf("    NumSets %d,", length(sets)),
    paste0('    ContentType "LandmarkSet"', amira_parameter("Sets", names(sets)),
           amira_parameter("Names", rownames(x))),
    "}", "", sprintf("Markers { float[3] %s } @%d", coordinates, number), "",
    "# Data section follows",
    unlist(Map(function(x, i) c(paste0("@", i), if (nrow(x)) row_text(x, missing = "NaN"), ""),
               sets, number))
  ), file)
}

amira_parameter <- function(key, name) {
  if (identical(name, as.character(seq_along(name)))) return("")
  escaped <- gsub('(["\\\\])', "\\\\\\1", name)
  sprintf(", %s { %s }", key, paste0("N", seq_along(name), ' "', escaped, '"', collapse = ", "))
}
