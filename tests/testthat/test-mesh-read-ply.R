# A PLY file written by hand: a unit square of two triangles (or one quad), in any format.
write_ply <- function(format = "ascii", type = "float", faces = list(0:2, c(0, 2, 3)), count_type = "uchar",
                      index_type = "int", colour = NULL, extra = NULL, last = "\n", header_end = "\n", xyz = square) {
  file <- withr_tempfile("ply")
  header <- c("ply", paste("format", format, "1.0"), "comment made by a test", "element vertex 4",
              paste("property", type, c("x", "y", "z")),
              if (!is.null(colour)) paste("property", colour$type, c("red", "green", "blue")),
              paste("element face", length(faces)),
              sprintf("property list %s %s vertex_indices", count_type, index_type), extra, "end_header")
  connection <- file(file, "wb")
  on.exit(close(connection))
  writeChar(paste0(paste(header, collapse = header_end), header_end), connection, eos = NULL)
  put <- function(x, type) {
    size <- ply_types()[[type]]
    endian <- if (format == "binary_big_endian") "big" else "little"
    writeBin(if (grepl("float|double", type)) as.double(x) else as.integer(x), connection, size = size, endian = endian)
  }
  if (format == "ascii") {
    rows <- apply(cbind(xyz, colour$value), 1, function(x) paste(format(x, digits = 15), collapse = " "))
    rows <- c(rows, vapply(faces, function(f) paste(c(length(f), f, if (!is.null(extra)) 7), collapse = " "), ""))
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
      expect_equal(t(s$mesh$vb[1:3, ]), square, tolerance = if (grepl("64|double", type)) 1e-15 else tolerances$single)
      expect_equal(s$mesh$it, cbind(1:3, c(1, 3, 4)))
    }
    for (index in c("uchar", "short", "ushort", "int", "uint")) {
      expect_equal(read_mesh(write_ply(format, index_type = index, count_type = index))$it, cbind(1:3, c(1, 3, 4)))
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
    expect_equal(read_mesh(write_ply(format, faces = mixed))$it,
                 cbind(1:3, c(1, 3, 4), 1:3, c(4, 3, 2), c(4, 2, 1)))
    expect_equal(read_mesh(write_ply(format, faces = mixed, extra = "property int flags"))$it,
                 cbind(1:3, c(1, 3, 4), 1:3, c(4, 3, 2), c(4, 2, 1)))
  }
})

test_that("line ends of Windows and a missing last one do no harm", {
  expect_equal(read_mesh(write_ply(header_end = "\r\n"))$it, cbind(1:3, c(1, 3, 4)))
  expect_equal(read_mesh(write_ply("binary_little_endian", header_end = "\r\n"))$it, cbind(1:3, c(1, 3, 4)))
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
  writeLines(c("ply", "format ascii 1.0", "element camera 1", "property float f", "property list uchar int k",
               "element vertex 3", "property float z", "property float x", "property float quality", "property float y",
               "element face 1", "property list uchar float texcoord", "property list uchar uint vertex_index",
               "element edge 1", "property int a", "end_header",
               "1.5 2 8 9", "9 0 5 0", "9 1 5 0", "9 0 5 1", "6 0 0 1 0 0 1 3 0 1 2", "4"), file)
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
  damaged(charToRaw("ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n1\n"))
  damaged(charToRaw("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"))
  damaged(charToRaw("ply\nformat ascii 1.0\nelement vertex 1\nproperty complex x\nend_header\n1\n"))
  damaged(charToRaw("ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nend_header\n-3 1\n"))
})
