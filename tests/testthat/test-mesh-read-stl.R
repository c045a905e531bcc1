test_that("ascii and binary are read, equal vertices merged, also where a binary header says solid", {
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
