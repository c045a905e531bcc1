# PLY: a header that names elements and their properties, then numbers, ascii or binary.
# Own code, since Rvcg rounds double co-ordinates to single precision.

read_ply <- function(file, id) {
  raw <- file_bytes(file, id)
  header <- ply_header(raw, file, id)
  stream <- ply_stream(header, file, id)
  read <- ply_elements_read(stream, header$elements)
  stream$check(read$start, read$end)
  vertex <- read$table$vertex
  numbers <- names(vertex)[vapply(vertex, is.numeric, NA)]
  if (!all(c("x", "y", "z") %in% numbers)) refuse_file(file, "its vertices have no x, y, z", id)
  if (!length(vertex$x)) refuse_file(file, "it has no vertices", id)
  # The polygons of `face` and the triangles of `tristrips`, 0-based. A surface in any other element
  # is refused, since the vertices alone would be taken for a cloud.
  index <- function(element) {
    columns <- read$table[[element]]
    columns[[intersect(ply_index_names, names(columns))[1]]]
  }
  listed <- vapply(header$elements, function(x) {
    x$count > 0 && any(nzchar(x$properties$count_type) & x$properties$name %in% ply_index_names)
  }, NA)
  other <- setdiff(names(listed)[listed], c("face", "tristrips"))
  nameless <- isTRUE(header$elements$face$count > 0) && !listed["face"]
  if (nameless || length(other) && !any(listed[c("face", "tristrips")], na.rm = TRUE)) {
    refuse_file(file, if (nameless) "its faces have no list vertex_indices" else
      sprintf("its surface is in the element %s, that is not read", other[1]), id,
      "Export it as triangles: open and save it with MeshLab.")
  }
  if (length(other)) {
    warn_file(file, sprintf("has a second surface in the element %s: it was not read", other[1]),
              "Export all as one list of faces: open and save it with MeshLab.", id)
  }
  face <- if (isTRUE(listed["face"])) index("face")
  strip <- if (isTRUE(listed["tristrips"])) strip_triangles(index("tristrips"))
  mesh_of_polygons(cbind(vertex$x, vertex$y, vertex$z), c(face$value, strip$value) + 1,
                   c(face$sides, strip$sides), ply_colours(vertex[numbers], header))
}

ply_index_names <- c("vertex_indices", "vertex_index")

# Triangles of strips: every vertex with the two before it, every other one turned. A negative
# number ends a strip, as the end of a row does.
strip_triangles <- function(strip) {
  n <- length(strip$value)
  row <- rep(seq_along(strip$sides), strip$sides)
  break_at <- !is.na(strip$value) & strip$value < 0
  run <- cumsum(break_at | c(TRUE, row[-1] != row[-n])[seq_len(n)])
  place <- sequence(rle(run)$lengths) - break_at[match(run, run)]
  last <- which(place >= 3 & !break_at)
  odd <- place[last] %% 2 == 0
  value <- rbind(strip$value[last - 2], strip$value[last - 1], strip$value[last])
  value[1:2, odd] <- value[2:1, odd]
  list(value = as.vector(value), sides = rep(3, length(last)))
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

# list(format, raw, body, elements): `body` the bytes of `raw` before the data; an element has
# `count` and `properties` (data frame: name, type, count_type, which is "" but for lists).
ply_header <- function(raw, file, id) {
  raw <- unmarked_bytes(raw)
  body <- ply_header_end(raw)
  if (is.na(body)) refuse_file(file, "it has no PLY header", id)
  if (any(raw[seq_len(body)] == 0)) refuse_file(file, "its header is no text", id)
  token <- strsplit(text_lines(raw[seq_len(body)]), "[ \t]+", useBytes = TRUE)
  key <- vapply(token, function(x) c(x, "")[1], "")
  format <- unlist(token[key == "format"])[2]
  if (!isTRUE(format %in% c("ascii", "binary_little_endian", "binary_big_endian"))) {
    refuse_file(file, sprintf("the format %s is not known", format), id)
  }
  # An element cannot have more rows than the file has bytes.
  lines <- length(token)
  token <- token[key %in% c("element", "property")]
  is_element <- vapply(token, function(x) x[1] == "element", NA)
  group <- cumsum(is_element)
  if (!length(token) || !is_element[1] ||
      any(lengths(token) < 3)) refuse_file(file, "its header is damaged", id)
  count <- suppressWarnings(vapply(token[is_element], function(x) as.numeric(x[3]), 0))
  if (anyNA(count) || any(count < 0 | count > length(raw) | count != round(count))) {
    refuse_file(file, "it promises more than it holds", id)
  }
  properties <- lapply(seq_along(count),
                       function(g) ply_properties(token[group == g & !is_element], file, id))
  names(properties) <- vapply(token[is_element], `[`, "", 2)
  twice <- names(properties)[duplicated(names(properties))]
  if (length(twice)) refuse_file(file, sprintf("its header has the element %s twice", twice[1]), id)
  elements <- Map(function(count, properties) list(count = count, properties = properties), count,
                  properties)
  list(format = format, raw = raw, body = body, lines = lines,
       elements = stats::setNames(elements, names(properties)))
}

# Bytes up to the end of the line end_header, NA where there is none. If the first line ends in CR
# alone, so do all, and a byte LF behind the last is data. `usual`: most headers are shorter.
ply_header_end <- function(raw, usual = 2^16) {
  if (!identical(raw[1:3], charToRaw("ply"))) return(NA)
  first <- grepRaw("^ply[ \t]*\r[^\n]", raw[seq_len(min(usual, length(raw)))])
  end <- if (length(first)) "[\r\n]end_header[ \t]*\r" else "[\r\n]end_header[ \t]*\r?\n"
  for (size in c(usual, length(raw))) {
    found <- grepRaw(end, raw[seq_len(min(size, length(raw)))], value = TRUE)
    if (length(found)) return(grepRaw(end, raw) + length(found) - 1)
  }
  NA
}

ply_types <- function() {
  c(char = 1, int8 = 1, uchar = 1, uint8 = 1, short = 2, int16 = 2, ushort = 2, uint16 = 2,
    int = 4, int32 = 4, uint = 4, uint32 = 4, float = 4, float32 = 4, double = 8, float64 = 8)
}

ply_properties <- function(token, file, id) {
  is_list <- vapply(token, function(x) x[2] == "list" && length(x) >= 5, NA)
  pick <- function(one, many) unlist(Map(function(x, l) if (l) x[many] else x[one], token, is_list))
  type <- as.character(pick(2, 4))
  count_type <- as.character(unlist(Map(function(x, l) if (l) x[3] else "", token, is_list)))
  if (!all(c(type, count_type[is_list]) %in% names(ply_types()))) {
    refuse_file(file, "its header names types that are not known", id)
  }
  name <- as.character(pick(3, 5))
  again <- intersect(c("x", "y", "z", ply_index_names), name[duplicated(name)])
  if (length(again)) {
    refuse_file(file, sprintf("its header has the property %s twice", again[1]), id)
  }
  data.frame(name = name, type = type, count_type = count_type)
}

# What follows the header as a stream: `get(at, type)` gives the numbers at 0-based places, `size`
# the places a number of each type takes, `start` and `end` the first place and the one behind the
# last; `short()` refuses a file that ends too early, `check(start, end)` warns of what is behind
# the places that were used and refuses rows that are no lines.
ply_stream <- function(header, file, id) {
  if (header$format == "ascii") {
    text <- cpp_read_numbers(c(header$raw, as.raw(10)), header$body)
    short <- function() {
      if (nzchar(text$bad)) refuse_word(file, text$bad, text$bad_line + header$lines, id)
      refuse_file(file, "it ends too early", id)
    }
    return(list(get = function(at, type) text$number[at + 1], size = 0 * ply_types() + 1, start = 0,
                end = length(text$number), short = short,
                check = function(start, end) ply_check_lines(
                  text, start, end, header$lines, file, id
                )))
  }
  raw <- header$raw
  endian <- if (header$format == "binary_big_endian") "big" else "little"
  check <- function(start, end) {
    rest <- length(raw) - end
    if (rest > 0 && !all(raw[end + seq_len(rest)] %in% blank_bytes)) warn_extra(file, rest, id)
  }
  get <- function(at, type) {
    cpp_numbers_at(raw, at, grepl("float|double", type), !startsWith(type, "u"),
                   ply_types()[[type]], endian == "big")
  }
  list(get = get, size = ply_types(), start = header$body, end = length(raw),
       short = function() refuse_file(file, "it ends too early", id), check = check)
}

# Rows stand on lines of their own. Only where exactly as many numbers are there as the header
# promises, on another number of lines, lines may be broken as they like.
ply_check_lines <- function(text, start, end, lines, file, id) {
  rows <- seq_along(start)
  aligned <- length(text$start) >= length(start) && all(text$start[rows] == start)
  rest <- length(text$number) - end
  if (!aligned && (rest > 0 || nzchar(text$bad) || length(text$start) == length(start))) {
    wrong <- which(text$start[rows] != start | is.na(text$start[rows]))[1]
    refuse_file(file,
                sprintf("line %d has not as many numbers as the header promises",
                        lines + text$line[max(wrong - 1, 1)]),
                id,
                "The header's numbers of vertices, faces or properties are wrong: export it again.")
  }
  if (rest > 0 || nzchar(text$bad)) {
    warn_file(file,
              sprintf(paste0("goes on behind what its header promises, at line %d: that was ",
                             "passed over"),
                      lines + c(text$line, text$bad_line)[length(start) + 1]),
              "See whether the surface is whole, or export it again.", id)
  }
}

# `table`: every element as a named list, a vector for each property, list(value, sides) for a list;
# `start`: where all rows start; `end`: behind the last.
ply_elements_read <- function(stream, elements) {
  at <- stream$start
  starts <- list()
  for (name in names(elements)) {
    # Where the rows start: at equal steps if every list is as long as the first row's, else one
    # by one.
    element <- elements[[name]]
    start <- if (element$count == 0 || nrow(element$properties) == 0) numeric() else {
      is_list <- nzchar(element$properties$count_type)
      first <- ply_rows(stream, element$properties, at)
      equal <- at + (seq_len(element$count) - 1) * (first$end - at)
      if (!any(is_list)) equal else {
        rows <- tryCatch(ply_rows(stream, element$properties, equal), error = function(e) NULL)
        alike <- !is.null(rows) && all(vapply(which(is_list), function(i) {
          all(rows$column[[i]]$sides == first$column[[i]]$sides)
        }, NA))
        if (alike) equal else ply_walk_rows(stream, element, at)
      }
    }
    row <- ply_rows(stream, element$properties, start)
    at <- if (length(start)) row$end[length(start)] else at
    elements[[name]] <- row$column
    starts <- c(starts, list(start))
  }
  list(table = elements, start = unlist(starts), end = at)
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
      column[[properties$name[i]]] <- list(
        value = ply_get(stream, place, properties$type[i]), sides = sides
      )
    } else {
      column[[properties$name[i]]] <- ply_get(stream, at, properties$type[i])
    }
    at <- at + sides * size
  }
  list(column = column, end = at)
}

ply_get <- function(stream, at, type) {
  if (length(at) && max(at) + stream$size[[type]] > stream$end) stream$short()
  stream$get(at, type)
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

write_ply <- function(mesh, file, ascii) {
  if (ascii) {
    fields <- list(row_text(mesh$xyz, missing = "nan"), if (!is.null(mesh$rgb)) row_text(mesh$rgb),
                   if (!is.null(mesh$value)) number_text(mesh$value, missing = "nan"),
                   if (!is.null(mesh$row)) ply_rows_of(mesh))
    vertex <- do.call(paste, Filter(Negate(is.null), fields))
    return(write_content(c(ply_head(mesh, "ascii"), vertex, paste("3", row_text(mesh$it - 1))),
                         file))
  }
  head <- charToRaw(paste0(ply_head(mesh, "binary_little_endian"), "\n", collapse = ""))
  vertex <- rbind(bytes_of(mesh$xyz, 8L), if (!is.null(mesh$rgb)) bytes_of(mesh$rgb, 1L),
                  if (!is.null(mesh$value)) bytes_of(as.double(mesh$value), 8L),
                  if (!is.null(mesh$row)) bytes_of(ply_rows_of(mesh), 4L))
  face <- rbind(as.raw(3), bytes_of(mesh$it - 1L, 4L))
  write_content(c(head, as.vector(vertex), as.vector(face)), file)
}

# 0 for the points between those of a shape.
ply_rows_of <- function(mesh) as.integer(ifelse(is.na(mesh$row), 0, mesh$row))

ply_head <- function(mesh, format) {
  c("ply", paste("format", format, "1.0"), paste("comment", mesh$comments),
    paste("element vertex", nrow(mesh$xyz)),
    "property double x", "property double y", "property double z",
    if (!is.null(mesh$rgb)) c("property uchar red", "property uchar green", "property uchar blue"),
    if (!is.null(mesh$value)) "property double quality", if (!is.null(mesh$row)) "property int row",
    paste("element face", nrow(mesh$it)), "property list uchar int vertex_indices", "end_header")
}
