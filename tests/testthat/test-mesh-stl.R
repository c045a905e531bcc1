test_that("ascii and binary are read, equal vertices merged, though a header says solid", {
  ball <- ball_mesh()
  for (binary in c(TRUE, FALSE)) {
    file <- tempfile(fileext = ".STL")
    Rvcg::vcgStlWrite(ball, sub("[.]STL$", "", file), binary = binary)
    file.rename(sub("STL$", "stl", file), file)
    if (binary) {
      raw <- readBin(file, "raw", file.size(file))
      raw[1:5] <- charToRaw("solid")
      writeBin(raw, file)
    }
    s <- read_specimen(file, id = "ball")
    expect_equal(ncol(s$mesh$vb), 162)
    expect_equal(report_count(s, "duplicate vertices"), 960 - 162)
    expect_equal(s$mesh$vb[, s$mesh$it], ball$vb[, ball$it], tolerance = tolerances$single)
  }
})

test_that("damaged files are refused", {
  file <- tempfile(fileext = ".stl")
  Rvcg::vcgStlWrite(ball_mesh(), sub("[.]stl$", "", file), binary = TRUE)
  raw <- readBin(file, "raw", file.size(file))
  for (keep in c(0, 50, 84, 1000, length(raw) - 1)) {
    writeBin(raw[seq_len(keep)], file)
    expect_crestline_error(read_specimen(file, id = "s"), "s, ", id = "s")
  }
  writeLines(c("solid a", "facet", "vertex 0 0 0", "vertex 1 0 0", "endsolid"), file)
  expect_crestline_error(read_specimen(file), "threes")
})

# A binary STL of the ball, the number in its header and the header's text of choice.
stl_raw <- function(faces = 320, head = "solid ball") {
  ball <- ball_mesh()
  corner <- t(ball$vb[1:3, ball$it])
  body <- vapply(seq_len(320), function(i) {
    c(writeBin(c(0, 0, 0, t(corner[3 * i - 2:0, ])), raw(), size = 4, endian = "little"), raw(2))
  }, raw(50))
  head <- charToRaw(head)
  c(head, raw(80 - length(head)), writeBin(as.integer(faces), raw(), endian = "little"),
    as.vector(body))
}
read_raw <- function(bytes) {
  file <- tempfile(fileext = ".stl")
  writeBin(bytes, file)
  read_specimen(file, id = "s")
}

test_that("a binary header that disagrees with the content is told of or refused", {
  for (head in c("solid ball", strrep("solid vertex ", 6))) {
    expect_equal(ncol(expect_no_warning(read_raw(stl_raw(head = head)))$mesh$it), 320)
  }
  for (faces in c(0, 100)) {
    expect_warning(s <- read_raw(stl_raw(faces)),
                   sprintf("promises %d triangles and holds 320", faces),
                   class = "crestline_file_warning")
    expect_equal(ncol(s$mesh$it), 320)
  }
  for (faces in c(321, -1)) {
    expect_crestline_error(read_raw(stl_raw(faces)), c("s, reading", "and holds 320"), id = "s")
  }
  expect_crestline_error(read_raw(utils::head(stl_raw(), -20)),
                         "promises 320 triangles and holds 319")
  expect_warning(read_raw(c(stl_raw(), as.raw(1:20))), "20 bytes more",
                 class = "crestline_file_warning")
  expect_no_warning(read_raw(c(stl_raw(), raw(20))))
})

test_that("ascii words may be in capitals, names are no words, exponents are numbers", {
  file <- tempfile(fileext = ".stl")
  Rvcg::vcgStlWrite(ball_mesh(), sub("[.]stl$", "", file), binary = FALSE)
  line <- readLines(file)
  whole <- read_specimen(file)
  same <- function(lines) {
    writeLines(lines, file)
    expect_identical(expect_no_warning(read_specimen(file))$mesh$vb, whole$mesh$vb)
  }
  same(toupper(line))
  same(c("solid", line[-c(1, length(line))], "endsolid"))
  same(c("solid vertex 1 2 facet", line[-1]))
  same(gsub("e-01", "E-1", line))
  same(gsub("vertex +([0-9])", "vertex\t+\\1", line))
  same(c(line[seq_len(7 * 100 + 1)], "endsolid a", "solid b", line[-seq_len(7 * 100 + 1)]))
  cut <- line[seq_len(7 * 100 + 1)]
  writeLines(cut, file)
  expect_warning(s <- read_specimen(file), "ends without", class = "crestline_file_warning")
  writeLines(cut[-length(cut) + 0:4], file)
  expect_crestline_error(read_specimen(file), "not in threes at line")
})
