# STL: triangles without shared vertices; the door merges equal ones.

# Binary unless the length says otherwise and the text is one: a binary header may start with
# "solid", as the ascii format does.
read_stl <- function(file, id, bytes = 1000) {
  raw <- file_bytes(file, id)
  # The number that a binary file has behind its 80 bytes of header; infinite in a shorter one.
  faces <- if (length(raw) < 84) Inf else sum(as.numeric(raw[81:84]) * 256^(0:3))
  # Bytes that no text has, among the first `bytes`, and no text of two bytes a sign.
  first <- utils::head(text_bytes(utils::head(raw, bytes)), -1)
  binary <- any(first < 9 | first > 13 &
                first < 32) || !any(grepRaw("vertex|facet|solid", first, ignore.case = TRUE))
  vertex <- if (length(raw) >= 84 + 50 * faces && faces > 0 || binary) {
    stl_binary(raw, faces, file, id)
  } else {
    stl_ascii(raw, file, id)
  }
  mesh_of_polygons(vertex, seq_len(nrow(vertex)), rep(3L, nrow(vertex) / 3))
}

# Each face: 12 floats (normal, three corners) and two bytes. The number of faces is the content's
# where that is whole.
stl_binary <- function(raw, faces, file, id) {
  there <- (length(raw) - 84) / 50
  if (there < 1) refuse_file(file, "it has no triangles", id)
  if (faces > there && faces > 0) {
    refuse_file(file, sprintf("it promises %.0f triangles and holds %.0f", faces, floor(there)), id)
  }
  if (there > faces && (faces == 0 || there == floor(there))) {
    warn_file(file,
              sprintf("promises %.0f triangles and holds %.0f: all were read", faces, floor(there)),
              "See that nothing is on the surface that does not belong there, or export it again.",
              id)
    faces <- floor(there)
  } else if (!all(raw[-seq_len(84 + 50 * faces)] %in% blank_bytes)) {
    warn_extra(file, length(raw) - 84 - 50 * faces, id)
  }
  body <- matrix(raw[84 + seq_len(50 * faces)], 50)[13:48, ]
  matrix(readBin(as.vector(body), "double", 9 * faces, size = 4, endian = "little"), ncol = 3,
         byrow = TRUE)
}

stl_ascii <- function(raw, file, id) {
  text <- cpp_read_stl(text_bytes(raw))
  if (nzchar(text$bad)) refuse_word(file, text$bad, text$bad_line, id)
  if (text$bad_line > 0) {
    refuse_file(file, sprintf("its vertices are not in threes at line %d", text$bad_line), id)
  }
  if (!length(text$vertex)) refuse_file(file, "it has no triangles", id)
  if (!text$ended) {
    warn_file(file, 'ends without "endsolid", as a file that was cut short does',
              "Look whether the surface is whole, or export or copy it again.", id)
  }
  matrix(text$vertex, ncol = 3, byrow = TRUE)
}

write_stl <- function(mesh, file, ascii) {
  corner <- lapply(1:3, function(i) mesh$xyz[mesh$it[, i], , drop = FALSE])
  normal <- cross_rows(corner[[2]] - corner[[1]], corner[[3]] - corner[[1]])
  normal <- normal / pmax(row_lengths(normal), .Machine$double.xmin)
  if (ascii) {
    vertex <- lapply(corner, function(xyz) paste("vertex", row_text(xyz, missing = "nan")))
    lines <- rbind(paste("facet normal", row_text(normal, missing = "nan")), "outer loop",
                   do.call(rbind, vertex), "endloop",
                   "endfacet")
    return(write_content(c("solid crestline", as.vector(lines), "endsolid crestline"), file))
  }
  # A binary header must not begin with "solid".
  head <- c(charToRaw(formatC("written by crestline", width = -80)),
            writeBin(nrow(mesh$it), raw(), endian = "little"))
  facet <- rbind(bytes_of(cbind(normal, do.call(cbind, corner)), 4L), as.raw(0), as.raw(0))
  write_content(c(head, as.vector(facet)), file)
}
