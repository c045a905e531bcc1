# The bytes of a mesh file, unpacked and in one encoding, what a reader says of them, and a mesh
# from the polygons of a file.

# All bytes, unpacked where they are gzip's, whatever the file's name.
file_bytes <- function(file, id) {
  raw <- readBin(file, "raw", file.size(file))
  if (identical(packed_by(utils::head(raw, 10)), "gzip")) raw <- unpacked_bytes(file, raw, id)
  for (kind in names(foreign_files)) {
    if (length(grepRaw(foreign_files[[kind]], utils::head(raw, 200), ignore.case = TRUE))) {
      refuse_file(file, sprintf("it is %s", kind), id, "Download the mesh itself.")
    }
  }
  raw
}

# What a download may leave in place of a mesh, by what it begins with.
foreign_files <- list("a page of the web" = "^\\s*<(!doctype )?html",
                      "a pointer of Git LFS" = "^version https://git-lfs")

# A cut file unpacks without a word: its last four bytes are then not the length.
unpacked_bytes <- function(file, raw, id, chunk = 2^24) {
  connection <- gzfile(file, "rb")
  on.exit(close(connection))
  parts <- list()
  repeat {
    part <- withCallingHandlers(
      readBin(connection, "raw", chunk), warning = function(w) stop(conditionMessage(w))
    )
    if (!length(part)) break
    parts <- c(parts, list(part))
  }
  out <- unlist(parts)
  promised <- sum(as.numeric(utils::tail(raw, 4)) * 256^(0:3))
  if (length(raw) < 18 || !length(out) || length(out) %% 2^32 != promised) {
    refuse_file(file, "its packed content is cut short", id)
  }
  out
}

# Bytes as text with a last line end.
text_bytes <- function(raw) c(unmarked_bytes(raw), as.raw(10))

# Without the mark of an encoding in front; text of two bytes a sign becomes text of one.
unmarked_bytes <- function(raw, signs = 16) {
  begins <- function(...) identical(raw[seq_along(c(...))], as.raw(c(...)))
  # Text of two bytes a sign without a mark: every other one of the first is 0. `signs`: how many
  # are looked at.
  wide <- if (begins(0xff, 0xfe)) "UTF-16LE" else if (begins(0xfe, 0xff)) "UTF-16BE" else
    if (length(raw) < 2 * signs) NULL else {
      zero <- matrix(raw[seq_len(2 * signs)] == 0, 2)
      if (all(zero[2, ]) && !any(zero[1, ])) "UTF-16LE" else
        if (all(zero[1, ]) && !any(zero[2, ])) "UTF-16BE"
    }
  if (!is.null(wide)) {
    # Signs beyond one byte stand in names and comments only: "?".
    pair <- matrix(raw[seq_len(2 * (length(raw) %/% 2))], 2)
    if (wide == "UTF-16BE") pair <- pair[2:1, , drop = FALSE]
    sign <- pair[1, ]
    sign[pair[2, ] != 0] <- charToRaw("?")
    raw <- if (identical(pair[, 1], as.raw(c(0xff, 0xfe)))) sign[-1] else sign
  }
  if (identical(raw[1:3], as.raw(c(0xef, 0xbb, 0xbf)))) raw[-(1:3)] else raw
}

# The lines of a text of bytes, without blanks about them.
text_lines <- function(raw) {
  raw[raw == 0] <- as.raw(32)
  trim_bytes(strsplit(rawToChar(raw), "\r\n|\n|\r", useBytes = TRUE)[[1]])
}

# trimws() stops at bytes that are no UTF-8.
trim_bytes <- function(text) gsub("^[ \t]+|[ \t]+$", "", text, useBytes = TRUE)

# A word that should be a number: decimal commas have a remedy of their own.
refuse_word <- function(file, word, line, id) {
  shown <- iconv(substr(iconv(word, "latin1", "UTF-8"), 1, 30), "UTF-8", "ASCII", sub = "?")
  if (grepl("^[-+]?[0-9]*,[0-9]+", shown)) {
    refuse_file(file, sprintf("line %d has the number %s with a decimal comma", line, shown), id,
                "Export it with decimal points: a comma is no part of a number in a mesh file.")
  }
  refuse_file(file, sprintf('line %d has "%s" where a number should be', line, shown), id)
}

# What is wrong with a file whose mesh is read all the same.
warn_file <- function(file, problem, remedy, id) {
  crestline_warn(sprintf("%s %s.", basename(file), problem), remedy, stage = "reading", id = id,
                 class = "crestline_file_warning")
}

# Bytes that may fill up the end of a file.
blank_bytes <- as.raw(c(0, 9, 10, 13, 26, 32))

warn_extra <- function(file, bytes, id) {
  warn_file(file,
            sprintf("holds %.0f bytes more than its header promises: they were passed over", bytes),
            "See whether the surface is whole, or export it again.", id)
}

# `vertex` n x 3, `corner` the 1-based vertex numbers of all polygons in turn, `sides` how many each
# has. A corner that is no whole number is NA, which the door refuses.
mesh_of_polygons <- function(vertex, corner, sides, colour = NULL) {
  # Places, in the run of all corners, of the triangles of each polygon's fan about its first
  # corner.
  first <- cumsum(c(0, sides))[seq_along(sides)] + 1
  fan <- pmax(sides - 2, 0)
  start <- rep(first, fan)
  step <- sequence(fan)
  corner <- corner[as.vector(rbind(start, start + step, start + step + 1))]
  if (is.double(corner)) corner[corner != round(corner) | abs(corner) > .Machine$integer.max] <- NA
  mesh <- list(vb = rbind(t(vertex), 1), it = matrix(as.integer(corner), 3))
  if (!is.null(colour)) mesh$material <- list(color = colour)
  if (any(sides < 3)) mesh$short <- sum(sides < 3)
  structure(mesh, class = "mesh3d")
}
