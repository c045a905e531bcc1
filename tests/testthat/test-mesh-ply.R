# A PLY file written by hand: a unit square of two triangles (or one quad), in any format.
write_ply <- function(format = "ascii", type = "float", faces = list(0:2, c(0, 2, 3)),
                      count_type = "uchar", index_type = "int", colour = NULL, extra = NULL,
                      last = "\n", header_end = "\n", xyz = square) {
  file <- withr_tempfile("ply")
  header <- c("ply", paste("format", format, "1.0"), "comment made by a test", "element vertex 4",
              paste("property", type, c("x", "y", "z")),
              if (!is.null(colour)) paste("property", colour$type, c("red", "green", "blue")),
              paste("element face", length(faces)),
              sprintf("property list %s %s vertex_indices", count_type, index_type), extra,
              "end_header")
  connection <- file(file, "wb")
  on.exit(close(connection))
  writeChar(paste0(paste(header, collapse = header_end), header_end), connection, eos = NULL)
  put <- function(x, type) {
    size <- ply_types()[[type]]
    endian <- if (format == "binary_big_endian") "big" else "little"
    writeBin(if (grepl("float|double", type)) as.double(x) else as.integer(x), connection,
             size = size, endian = endian)
  }
  if (format == "ascii") {
    rows <- apply(cbind(xyz, colour$value), 1,
                  function(x) paste(format(x, digits = 15), collapse = " "))
    rows <- c(rows,
              vapply(faces, function(f)
                paste(c(length(f), f, if (!is.null(extra)) 7), collapse = " "), ""))
    writeChar(paste0(paste(rows, collapse = header_end), last), connection, eos = NULL)
  } else {
    for (i in 1:4) {
      put(xyz[i, ], type)
      if (!is.null(colour)) put(colour$value[i, ], colour$type)
    }
    for (f in faces) {
      put(length(f), count_type)
      put(f, index_type)
      if (!is.null(extra)) put(7, "int")
    }
  }
  file
}
square <- rbind(c(0, 0, 0), c(1, 0, 0), c(1, 1, 0.1), c(0, 1, 0))
withr_tempfile <- function(extension) tempfile(fileext = paste0(".", extension))

test_that("every format, type and byte order gives the same mesh", {
  for (format in c("ascii", "binary_little_endian", "binary_big_endian")) {
    for (type in c("float", "double", "float32", "float64")) {
      s <- read_specimen(write_ply(format, type), id = "square")
      expect_equal(t(s$mesh$vb[1:3, ]), square,
                   tolerance = if (grepl("64|double", type)) 1e-15 else tolerances$single)
      expect_equal(s$mesh$it, cbind(1:3, c(1, 3, 4)))
    }
    for (index in c("uchar", "short", "ushort", "int", "uint")) {
      expect_equal(read_mesh(write_ply(format, index_type = index, count_type = index))$it,
                   cbind(1:3, c(1, 3, 4)))
    }
  }
})

test_that("double co-ordinates keep all their digits", {
  far <- square + 123456.123456789
  for (format in c("ascii", "binary_big_endian")) {
    mesh <- read_mesh(write_ply(format, "double", xyz = far))
    expect_equal(t(mesh$vb[1:3, ]), far, tolerance = 1e-14)
  }
})

test_that("polygons of any and of mixed size become fans, extra properties are passed over", {
  for (format in c("ascii", "binary_little_endian")) {
    expect_equal(read_mesh(write_ply(format, faces = list(0:3)))$it, cbind(1:3, c(1, 3, 4)))
    mixed <- list(0:3, 0:2, 0:1, c(3, 2, 1, 0))
    expect_warning(mesh <- read_mesh(write_ply(format, faces = mixed), "m"),
                   "1 polygons with fewer than three corners")
    expect_equal(mesh$it,
                 cbind(1:3, c(1, 3, 4), 1:3, c(4, 3, 2), c(4, 2, 1)))
    mesh <- suppressWarnings(read_mesh(write_ply(format, faces = mixed,
                                                 extra = "property int flags"), "m"))
    expect_equal(mesh$it,
                 cbind(1:3, c(1, 3, 4), 1:3, c(4, 3, 2), c(4, 2, 1)))
  }
})

test_that("line ends of Windows and a missing last one do no harm", {
  expect_equal(read_mesh(write_ply(header_end = "\r\n"))$it, cbind(1:3, c(1, 3, 4)))
  expect_equal(read_mesh(write_ply("binary_little_endian", header_end = "\r\n"))$it,
               cbind(1:3, c(1, 3, 4)))
  expect_equal(read_mesh(write_ply(last = ""))$it, cbind(1:3, c(1, 3, 4)))
})

test_that("colours of the vertices are kept, as bytes or as shares", {
  hex <- c("#FF0000", "#00FF00", "#0000FF", "#FFFFFF")
  share <- rbind(diag(3), 1)
  for (format in c("ascii", "binary_big_endian")) {
    bytes <- read_specimen(write_ply(format, colour = list(type = "uchar", value = share * 255)))
    expect_equal(bytes$mesh$material$color, hex)
    shares <- read_specimen(write_ply(format, colour = list(type = "float", value = share)))
    expect_equal(shares$mesh$material$color, hex)
  }
})

test_that("elements before and after vertex and face are passed over", {
  file <- withr_tempfile("ply")
  writeLines(c("ply", "format ascii 1.0", "element camera 1", "property float f",
               "property list uchar int k", "element vertex 3", "property float z",
               "property float x", "property float quality", "property float y",
               "element face 1", "property list uchar float texcoord",
               "property list uchar uint vertex_index", "element edge 1", "property int a",
               "end_header", "1.5 2 8 9", "9 0 5 0", "9 1 5 0", "9 0 5 1",
               "6 0 0 1 0 0 1 3 0 1 2", "4"), file)
  mesh <- read_mesh(file, "x")
  expect_equal(mesh$vb, rbind(c(0, 1, 0), c(0, 0, 1), 9, 1))
  expect_equal(mesh$it, cbind(1:3))
})

test_that("what Rvcg writes is read as Rvcg has it", {
  data("humface", package = "Rvcg", envir = environment())
  for (binary in c(TRUE, FALSE)) {
    file <- withr_tempfile("ply")
    Rvcg::vcgPlyWrite(humface, file, binary = binary)
    mesh <- read_mesh(file, "humface")
    expect_equal(mesh$vb, humface$vb, tolerance = tolerances$single)
    expect_equal(mesh$it, humface$it)
  }
})

test_that("nan in an ascii file is a non-finite vertex", {
  file <- write_ply()
  text <- readLines(file)
  text[11:12] <- c("nan 0 0", "1 inf 0")
  writeLines(text, file)
  expect_equal(is.finite(colSums(read_mesh(file)$vb)), c(FALSE, FALSE, TRUE, TRUE))
})

test_that("damaged files are refused with specimen, file and remedy", {
  file <- write_ply("binary_little_endian")
  all <- readBin(file, "raw", file.size(file))
  damaged <- function(bytes) {
    path <- file.path(tempdir(), "scan7.ply")
    writeBin(bytes, path)
    expect_crestline_error(read_specimen(path), c("scan7", "export or copy"), id = "scan7")
  }
  for (keep in c(0, 2, 50, length(all) - 1, length(all) - 20)) damaged(all[seq_len(keep)])
  damaged(charToRaw("ply\nformat fantasy 1.0\nelement vertex 1\nproperty float x\nend_header\n"))
  damaged(charToRaw(paste("ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float",
                          "x\nend_header\n1\n")))
  damaged(charToRaw("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"))
  damaged(charToRaw("ply\nformat ascii 1.0\nelement vertex 1\nproperty complex x\nend_header\n1\n"))
  damaged(charToRaw(paste("ply\nformat ascii 1.0\nelement face 1\nproperty list int int",
                          "vertex_index\nend_header\n-3 1\n")))
})

# An ascii PLY of the grid of `n` x `n` vertices; `vertices` and `faces`: the numbers that its
# header has.
ply_lines <- function(vertices = 16, faces = 18, properties = c("x", "y", "z")) {
  grid <- grid_mesh(4)
  c("ply", "format ascii 1.0", paste("element vertex", vertices),
    paste("property float", properties), paste("element face", faces),
    "property list uchar int vertex_indices", "end_header",
    apply(t(grid$vb[1:3, ]), 1, paste, collapse = " "),
    apply(cbind(3, t(grid$it) - 1), 1, paste, collapse = " "))
}
read_lines <- function(lines) {
  file <- withr_tempfile("ply")
  writeLines(lines, file)
  read_specimen(file, id = "g", outward = "keep")
}

test_that("a header that disagrees with the rows is told of or refused", {
  expect_equal(expect_no_warning(read_lines(ply_lines()))$mesh$it, grid_mesh(4)$it)
  lines <- ply_lines()
  expect_equal(
    expect_no_warning(read_lines(c(lines[1:9], paste(lines[-(1:9)], collapse = " "))))$mesh$it,
    grid_mesh(4)$it)
  for (wrong in list(c(15, 18), c(17, 18), c(16, 19), c(15, 19), c(17, 17))) {
    expect_crestline_error(read_lines(ply_lines(wrong[1], wrong[2])), "g, reading", id = "g")
  }
  expect_crestline_error(read_lines(ply_lines(properties = c("x", "y", "z", "q"))), "g, reading")
  lines[10:25] <- paste(lines[10:25], 1)
  expect_crestline_error(read_lines(lines), "g, reading")
  expect_warning(s <- read_lines(ply_lines(faces = 17)),
                 "goes on behind what its header promises, at line 43",
                 class = "crestline_file_warning")
  expect_equal(ncol(s$mesh$it), 17)
  expect_warning(read_lines(c(ply_lines(), "# end")), class = "crestline_file_warning")
  expect_crestline_error(read_lines(sub("vertex 16", "vertex 1.6e1x", ply_lines())), "g, reading")
  expect_crestline_error(read_lines(append(ply_lines(), "element face 0", 8)), "element face twice")
})

test_that("bytes behind the end of a binary file are told of", {
  file <- write_ply("binary_little_endian")
  raw <- readBin(file, "raw", 1e4)
  writeBin(c(raw, charToRaw("\n")), file)
  expect_no_warning(read_specimen(file))
  writeBin(c(raw, as.raw(1:9)), file)
  expect_warning(read_specimen(file), "9 bytes more than its header promises",
                 class = "crestline_file_warning")
  file <- write_ply("binary_big_endian", header_end = "\r", faces = list(0:2, c(0, 2, 3)))
  expect_equal(read_mesh(file)$it, cbind(1:3, c(1, 3, 4)))
  # One vertex too many takes the bytes of a face.
  text <- readBin(write_ply("binary_little_endian"), "raw", 1e4)
  at <- grepRaw("vertex 4", text)
  text[at + 7] <- charToRaw("5")
  writeBin(text, file)
  refused <- tryCatch(read_specimen(file), crestline_file_warning = identity,
                      crestline_error = identity)
  expect_s3_class(refused, "condition")
})

test_that("headers may be long and speak of their own end", {
  lines <- ply_lines()
  long <- c(lines[1:2], sprintf("comment step %05d of the protocol end_header", 1:3000), "comment",
            "obj_info num_cols 512", lines[-(1:2)])
  expect_gt(sum(nchar(long)), 65536)
  expect_equal(read_lines(long)$mesh$it, grid_mesh(4)$it)
})

# Two sheets of 10 x 10 squares as strips, the ends marked by -1 or by rows of their own.
test_that("triangles of strips are read, with their sense", {
  at <- expand.grid(x = 0:10, y = 0:10)
  xyz <- rbind(cbind(at$x, at$y, 0), cbind(at$x, at$y, 4))
  strip <- unlist(lapply(c(0, 121), function(o)
    lapply(0:9, function(r) rbind((r + 1) * 11 + 0:10, r * 11 + 0:10) + o)), recursive = FALSE)
  head <- c("ply", "format ascii 1.0", "element vertex 242",
            paste("property float", c("x", "y", "z")))
  list_of <- function(x) paste(c(length(x), x), collapse = " ")
  one <- utils::head(unlist(lapply(strip, c, -1)), -1)
  written <- list(
    c(head, "element tristrips 1", "property list int int vertex_indices", "end_header",
      apply(xyz, 1, paste, collapse = " "), list_of(one)),
    c(head, "element tristrips 20", "property list int int vertex_indices", "end_header",
      apply(xyz, 1, paste, collapse = " "), vapply(strip, list_of, ""))
  )
  for (lines in written) {
    s <- read_lines(lines)
    expect_equal(ncol(s$mesh$it), 400)
    level <- matrix(s$mesh$vb[3, s$mesh$it], 3)
    expect_equal(level[1, ], level[2, ])
    expect_equal(level[1, ], level[3, ])
    expect_equal(face_normals(s$mesh)[, 3], rep(1, 400))
  }
  expect_equal(strip_triangles(list(value = c(-1, 0, 1, 2, -1, -1, 3, 4, 5, 6), sides = 10))$value,
               c(0, 1, 2, 3, 4, 5, 5, 4, 6))
})

test_that("a surface in an element that is not read is refused by its name", {
  expect_crestline_error(read_lines(sub("element face", "element range_grid", ply_lines())),
                         c("element range_grid", "MeshLab"))
  expect_crestline_error(read_lines(sub("vertex_indices", "corners", ply_lines())),
                         "faces have no list vertex_indices")
  expect_crestline_error(read_lines(sub(" int vertex_indices", " float vertex_indices",
                                        sub("^3 (.*)", "3 \\1.5", ply_lines()))),
                         "18 of 18 faces")
})

test_that("a second surface beside the faces is told of", {
  line <- ply_lines()
  end <- match("end_header", line)
  more <- c("element range_grid 1", "property list uchar int vertex_indices")
  lines <- c(line[seq_len(end - 1)], more, line[-seq_len(end - 1)], "3 0 1 2")
  expect_warning(read_lines(lines), "second surface in the element range_grid",
                 class = "crestline_file_warning")
})

test_that("a property that is there twice is refused, and a list is no co-ordinate nor colour", {
  line <- ply_lines()
  z <- grep("^property .* z$", line)
  expect_crestline_error(read_lines(append(line, "property float x", z)), "property x twice")
  expect_crestline_error(read_lines(sub("^property [a-z0-9]+ x$", "property list uchar float x",
                                        line)), "cannot be read")
  nothing <- c("ply", "format ascii 1.0", "element vertex 0",
               paste("property float", c("x", "y", "z")), "end_header")
  expect_no_warning(expect_crestline_error(read_lines(nothing), "it has no vertices"))
})
