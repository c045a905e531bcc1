# STL: triangles without shared vertices; the door merges equal ones.

# Binary where the length says so: a binary header may start with "solid", as the ascii format does.
read_stl <- function(file, id) {
  bytes <- file.size(file)
  faces <- if (bytes >= 84) readBin(readBin(file, "raw", 84)[81:84], "integer", size = 4, endian = "little") else NA
  binary <- !is.na(faces) && faces >= 0 && bytes >= 84 + 50 * as.numeric(faces)
  if (binary && faces == 0) refuse_file(file, "it has no triangles", id)
  vertex <- if (binary) stl_binary(file, faces) else stl_ascii(file, id)
  corner <- seq_len(nrow(vertex))
  mesh_of_polygons(vertex, corner, rep(3L, nrow(vertex) / 3))
}

# Each face: 12 floats (normal, three corners) and two bytes.
stl_binary <- function(file, faces) {
  raw <- matrix(readBin(file, "raw", 84 + 50 * faces)[-(1:84)], 50)
  matrix(readBin(as.vector(raw[13:48, ]), "double", 9 * faces, size = 4, endian = "little"), ncol = 3, byrow = TRUE)
}

stl_ascii <- function(file, id) {
  line <- text_lines(file)
  line <- line[startsWith(line, "vertex ")]
  if (!length(line) || length(line) %% 3 != 0) refuse_file(file, "its vertices are not in threes", id)
  number_rows(line, 3)
}

# The lines of a text file, whatever bytes are in it; tabs and carriage returns become blanks.
text_lines <- function(file) {
  raw <- readBin(file, "raw", file.size(file))
  for (blank in as.raw(c(0, 9, 13))) {
    if (length(grepRaw(blank, raw, fixed = TRUE))) raw[raw == blank] <- as.raw(32)
  }
  line <- strsplit(rawToChar(raw), "\n", fixed = TRUE, useBytes = TRUE)[[1]]
  indented <- startsWith(line, " ")
  line[indented] <- sub("^ +", "", line[indented], useBytes = TRUE)
  line
}

# Lines of a word and at least `n` numbers, as a matrix of these. By a file, since scanning text is slow.
number_rows <- function(line, n) {
  rows <- scan_rows(line, rep(list(0), n), flush = TRUE)
  matrix(unlist(rows, use.names = FALSE), ncol = n)
}

# The fields after each line's first word, as a list of columns.
scan_rows <- function(line, what, flush = FALSE) {
  file <- tempfile()
  on.exit(unlink(file))
  writeLines(line, file, useBytes = TRUE)
  scan(file, c(list(NULL), what), quiet = TRUE, flush = flush, multi.line = FALSE, quote = "", comment.char = "",
       na.strings = c("NA", "nan", "-nan", "-nan(ind)"))[-1]
}
