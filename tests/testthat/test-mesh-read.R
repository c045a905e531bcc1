# A ball as text of three formats, and the mesh that each must give.
ball_lines <- function() {
  ball <- ball_mesh(1)
  row <- function(x, ...) apply(x, 1, paste, collapse = " ")
  vertex <- t(ball$vb[1:3, ])
  corner <- vertex[ball$it, ]
  face <- rep(seq_len(80), each = 3)
  list(
    obj = c("# a ball", paste("v", row(vertex)), paste("f", row(t(ball$it)))),
    ply = c("ply", "format ascii 1.0", "element vertex 42",
            paste("property float", c("x", "y", "z")), "element face 80",
            "property list uchar int vertex_indices", "end_header", row(vertex),
            paste(3, row(t(ball$it) - 1))),
    stl = c("solid b", unlist(lapply(seq_len(80), function(i) {
      c("facet normal 0 0 0", "outer loop", paste("vertex", row(corner[face == i, ])),
        "endloop", "endfacet")
    })), "endsolid b")
  )
}
write_raw <- function(bytes, name) {
  file <- file.path(tempfile("raw"), name)
  dir.create(dirname(file))
  writeBin(bytes, file)
  file
}
text_raw <- function(lines, end = "\n") charToRaw(paste0(paste(lines, collapse = end), end))
expect_ball <- function(file) {
  s <- expect_no_warning(read_specimen(file))
  expect_equal(c(ncol(s$mesh$vb), ncol(s$mesh$it)), c(42, 80))
  expect_equal(s$mesh$vb[, s$mesh$it], ball_mesh(1)$vb[, ball_mesh(1)$it], tolerance = 1e-14)
}

test_that("text is read whatever ends its lines and whatever mark stands in front", {
  lines <- ball_lines()
  wide <- function(raw, big) as.vector(if (big) rbind(as.raw(0), raw) else rbind(raw, as.raw(0)))
  for (kind in names(lines)) {
    name <- paste0("ball.", kind)
    for (end in c("\n", "\r\n", "\r")) expect_ball(write_raw(text_raw(lines[[kind]], end), name))
    expect_ball(write_raw(text_raw(gsub(" ", "\t ", lines[[kind]])), name))
    raw <- text_raw(lines[[kind]], "\r\n")
    expect_ball(write_raw(c(as.raw(c(0xef, 0xbb, 0xbf)), raw), name))
    for (big in c(FALSE, TRUE)) {
      expect_ball(write_raw(wide(raw, big), name))
      expect_ball(write_raw(c(as.raw(if (big) c(0xfe, 0xff) else c(0xff, 0xfe)), wide(raw, big)),
                            name))
    }
  }
})

test_that("gzip is read by any name, refused if cut or damaged; other packings by name", {
  lines <- ball_lines()
  for (kind in names(lines)) {
    packed <- write_raw(raw(), paste0("ball 1.", kind, ".gz"))
    connection <- gzfile(packed, "wb")
    writeBin(text_raw(lines[[kind]]), connection)
    close(connection)
    expect_ball(packed)
    expect_equal(read_specimen(packed)$id, "ball 1")
    raw <- readBin(packed, "raw", 1e6)
    expect_ball(write_raw(raw, paste0("ball.", toupper(kind))))
    for (cut in c(1, 9, 200)) {
      expect_crestline_error(read_specimen(write_raw(utils::head(raw, -cut),
                                                     paste0("c.", kind, ".GZ")), id = "c"),
                             "c, reading", id = "c")
    }
    raw[300] <- xor(raw[300], as.raw(1))
    expect_crestline_error(read_specimen(write_raw(raw, paste0("d.", kind)), id = "d"),
                           "d, reading", id = "d")
  }
  expect_crestline_error(read_specimen(write_raw(as.raw(c(0x50, 0x4b, 3, 4, 1:40)), "z.ply")),
                         c("zip", "Unpack"))
  expect_crestline_error(read_specimen(write_raw(text_raw("<!DOCTYPE html><html>"), "h.ply")),
                         "page of the web")
  expect_crestline_error(
    read_specimen(write_raw(text_raw("version https://git-lfs.github.com/spec/v1"), "l.stl")),
    "Git LFS")
})

test_that("what is empty, a folder or a pipe is refused at once", {
  expect_crestline_error(read_specimen(write_raw(raw(), "e.stl")), "empty")
  skip_on_os("windows")
  pipe <- tempfile(fileext = ".ply")
  system2("mkfifo", pipe)
  expect_crestline_error(read_specimen(pipe, id = "p"), c("p, reading", "pipe"), id = "p")
  expect_crestline_error(read_specimen("/dev/zero"), c("zero", "format"))
  device <- tempfile(fileext = ".obj")
  file.symlink("/dev/zero", device)
  expect_crestline_error(read_specimen(device), "device")
})

test_that("missing numbers of every system are missing; words, commas refused by line", {
  lines <- ball_lines()
  for (word in c("nan", "-NaN", "1.#QNAN", "-1.#IND00", "1.#INF", "1.#J", "nan(ind)", "-nan(snan)",
                 "inf", "-Infinity", "NA")) {
    ply <- lines$ply
    ply[10] <- paste("0", word, "1")
    expect_equal(which(!is.finite(colSums(read_mesh(write_raw(text_raw(ply), "n.ply"), "n")$vb))),
                 1)
    obj <- lines$obj
    obj[2] <- paste("v 0", word, "1")
    expect_equal(which(!is.finite(colSums(read_mesh(write_raw(text_raw(obj), "n.obj"), "n")$vb))),
                 1)
  }
  for (kind in names(lines)) {
    comma <- gsub("([0-9])[.]([0-9]{3})", "\\1,\\2", lines[[kind]])
    expect_crestline_error(read_specimen(write_raw(text_raw(comma), paste0("k.", kind)), id = "k"),
                           c("k, reading", "line ", "decimal comma", "decimal points"), id = "k")
  }
  lines$ply[12] <- "1 2 x"
  expect_crestline_error(read_specimen(write_raw(text_raw(lines$ply), "w.ply")),
                         'line 12 has "x" where a number should be')
})
