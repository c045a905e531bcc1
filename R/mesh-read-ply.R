# PLY: a header that names elements and their properties, then numbers, ascii or binary.
# Own code, since Rvcg rounds double co-ordinates to single precision.

read_ply <- function(file, id) {
  header <- ply_header(file, id)
  table <- ply_elements_read(ply_stream(file, header), header$elements)
  vertex <- table$vertex
  if (!all(c("x", "y", "z") %in% names(vertex))) refuse_file(file, "its vertices have no x, y, z", id)
  face <- table$face
  list_name <- intersect(c("vertex_indices", "vertex_index"), names(face))
  polygon <- if (length(list_name)) face[[list_name[1]]] else list(value = integer(), sides = integer())
  mesh_of_polygons(cbind(vertex$x, vertex$y, vertex$z), polygon$value + 1, polygon$sides,
                   ply_colours(vertex, header))
}

ply_colours <- function(vertex, header) {
  name <- c("red", "green", "blue")
  if (is.null(vertex$red)) name <- paste0("diffuse_", name)
  if (!all(name %in% names(vertex)) || !length(vertex$x)) return(NULL)
  colour <- do.call(cbind, vertex[name])
  property <- header$elements$vertex$properties
  bytes <- property$type[match(name[1], property$name)] %in% c("uchar", "uint8")
  if (bytes) colour_hex(colour, 255) else colour_hex(colour)
}

# list(format, lines, bytes, elements): an element has `count` and `properties` (data frame: name,
# type, count_type, which is "" but for lists).
ply_header <- function(file, id) {
  raw <- readBin(file, "raw", min(file.size(file), 65536))
  end <- grepRaw("end_header[ \t]*\r?\n", raw, all = FALSE, value = TRUE)
  at <- grepRaw("end_header[ \t]*\r?\n", raw)
  if (!length(at) || !identical(rawToChar(raw[1:3]), "ply")) refuse_file(file, "it has no PLY header", id)
  text <- raw[seq_len(at - 1)]
  if (any(text == 0)) refuse_file(file, "its header is no text", id)
  lines <- strsplit(gsub("\r", "", rawToChar(text), useBytes = TRUE), "\n", fixed = TRUE, useBytes = TRUE)[[1]]
  token <- strsplit(trimws(lines), "[ \t]+", useBytes = TRUE)
  key <- vapply(token, function(x) c(x, "")[1], "")
  format <- unlist(token[key == "format"])[2]
  if (!isTRUE(format %in% c("ascii", "binary_little_endian", "binary_big_endian"))) {
    refuse_file(file, sprintf("the format %s is not known", format), id)
  }
  list(format = format, lines = length(lines) + 1, bytes = at - 1 + length(end),
       elements = ply_elements(token[key %in% c("element", "property")], file, id))
}

ply_types <- function() {
  c(char = 1, int8 = 1, uchar = 1, uint8 = 1, short = 2, int16 = 2, ushort = 2, uint16 = 2,
    int = 4, int32 = 4, uint = 4, uint32 = 4, float = 4, float32 = 4, double = 8, float64 = 8)
}

ply_elements <- function(token, file, id) {
  is_element <- vapply(token, function(x) x[1] == "element", NA)
  group <- cumsum(is_element)
  if (!length(token) || !is_element[1] || any(lengths(token) < 3)) refuse_file(file, "its header is damaged", id)
  count <- suppressWarnings(vapply(token[is_element], function(x) as.numeric(x[3]), 0))
  if (anyNA(count) || any(count < 0 | count > file.size(file))) {
    refuse_file(file, "it promises more than it holds", id)
  }
  properties <- lapply(seq_along(count), function(g) ply_properties(token[group == g & !is_element], file, id))
  names(properties) <- vapply(token[is_element], `[`, "", 2)
  elements <- Map(function(count, properties) list(count = count, properties = properties), count, properties)
  stats::setNames(elements, names(properties))
}

ply_properties <- function(token, file, id) {
  is_list <- vapply(token, function(x) x[2] == "list" && length(x) >= 5, NA)
  pick <- function(one, many) unlist(Map(function(x, l) if (l) x[many] else x[one], token, is_list))
  type <- as.character(pick(2, 4))
  count_type <- as.character(unlist(Map(function(x, l) if (l) x[3] else "", token, is_list)))
  if (!all(c(type, count_type[is_list]) %in% names(ply_types()))) {
    refuse_file(file, "its header names types that are not known", id)
  }
  data.frame(name = as.character(pick(3, 5)), type = type, count_type = count_type)
}

# What follows the header as a stream: `get(at, type)` gives the numbers at 0-based places, `size`
# the places a number of each type takes, `end` how many places there are.
ply_stream <- function(file, header) {
  if (header$format == "ascii") {
    number <- scan(file, numeric(), skip = header$lines, quiet = TRUE, comment.char = "",
                   na.strings = c("NA", "nan", "-nan", "-nan(ind)"))
    return(list(get = function(at, type) number[at + 1], size = 0 * ply_types() + 1,
                start = 0, end = length(number)))
  }
  raw <- readBin(file, "raw", file.size(file))
  endian <- if (header$format == "binary_big_endian") "big" else "little"
  list(get = function(at, type) ply_numbers(raw, at, type, endian), size = ply_types(),
       start = header$bytes, end = length(raw))
}

ply_numbers <- function(raw, at, type, endian) {
  size <- ply_types()[[type]]
  bytes <- raw[rep(at, each = size) + seq_len(size)]
  if (grepl("float|double", type)) return(readBin(bytes, "double", length(at), size, endian = endian))
  unsigned <- startsWith(type, "u")
  number <- as.numeric(readBin(bytes, "integer", length(at), size, signed = size > 2 || !unsigned, endian = endian))
  if (size == 4 && unsigned) number[which(number < 0)] <- number[which(number < 0)] + 2^32
  number
}

# Every element as a named list: a vector for each property, list(value, sides) for a list.
ply_elements_read <- function(stream, elements) {
  at <- stream$start
  for (name in names(elements)) {
    start <- ply_row_starts(stream, elements[[name]], at)
    row <- ply_rows(stream, elements[[name]]$properties, start)
    at <- if (length(start)) row$end[length(start)] else at
    elements[[name]] <- row$column
  }
  elements
}

# The columns of rows that start at known places, and where each row ends.
ply_rows <- function(stream, properties, at) {
  column <- list()
  for (i in seq_len(nrow(properties))) {
    size <- stream$size[[properties$type[i]]]
    sides <- 1
    if (nzchar(properties$count_type[i])) {
      sides <- ply_get(stream, at, properties$count_type[i])
      at <- at + stream$size[[properties$count_type[i]]]
      if (any(is.na(sides) | sides < 0 | sides != round(sides)) || sum(sides) * size > stream$end) {
        stop("a list has an impossible length")
      }
      place <- rep(at, sides) + (sequence(sides) - 1) * size
      column[[properties$name[i]]] <- list(value = ply_get(stream, place, properties$type[i]), sides = sides)
    } else {
      column[[properties$name[i]]] <- ply_get(stream, at, properties$type[i])
    }
    at <- at + sides * size
  }
  list(column = column, end = at)
}

ply_get <- function(stream, at, type) {
  if (length(at) && max(at) + stream$size[[type]] > stream$end) stop("it ends too early")
  stream$get(at, type)
}

# Where the rows start: at equal steps if every list is as long as the first row's, else one by one.
ply_row_starts <- function(stream, element, at) {
  if (element$count == 0 || nrow(element$properties) == 0) return(numeric())
  is_list <- nzchar(element$properties$count_type)
  first <- ply_rows(stream, element$properties, at)
  equal <- at + (seq_len(element$count) - 1) * (first$end - at)
  if (!any(is_list)) return(equal)
  rows <- tryCatch(ply_rows(stream, element$properties, equal), error = function(e) NULL)
  alike <- !is.null(rows) && all(vapply(which(is_list), function(i) {
    all(rows$column[[i]]$sides == first$column[[i]]$sides)
  }, NA))
  if (alike) equal else ply_walk_rows(stream, element, at)
}

ply_walk_rows <- function(stream, element, at) {
  start <- numeric(element$count)
  type <- element$properties$type
  count_type <- element$properties$count_type
  for (row in seq_along(start)) {
    start[row] <- at
    for (i in seq_along(type)) {
      sides <- 1
      if (nzchar(count_type[i])) {
        sides <- ply_get(stream, at, count_type[i])
        if (is.na(sides) || sides < 0) stop("a list has an impossible length")
        at <- at + stream$size[[count_type[i]]]
      }
      at <- at + sides * stream$size[[type[i]]]
    }
  }
  start
}
