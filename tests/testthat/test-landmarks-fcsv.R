fcsv_file <- function(...) landmark_file("fcsv", ...)
fcsv_head <- function(system = "LPS", version = "4.11") {
  c(paste("# Markups fiducial file version =", version), paste("# CoordinateSystem =", system),
    "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID")
}
fcsv_row <- function(label, position = "10,20,30", end = ",,,2,0") {
  paste0("1,", position, ",0,0,0,1,1,1,0,", label, end)
}

test_that("what is written is read back, to the last bit, in either frame", {
  expect_round_trip(hard_landmarks(), "fcsv")
  file <- tempfile(fileext = ".fcsv")
  write_landmarks(hard_landmarks(), file, frame = "RAS")
  expect_identical(read_landmarks(file, frame = "RAS"), hard_landmarks())
  expect_identical(read_landmarks(file, frame = "file"), hard_landmarks())
  expect_identical(read_landmarks(file), hard_landmarks() * rep(c(-1, -1, 1), each = 106))
})

test_that("the frame is what the file says, in words or by number, or what its version implies", {
  x <- function(..., frame = "LPS") {
    unname(read_landmarks(fcsv_file(..., fcsv_row("a")), frame = frame)[1, ])
  }
  for (system in c("LPS", "1")) expect_equal(x(fcsv_head(system)), c(10, 20, 30))
  for (system in c("RAS", "0")) expect_equal(x(fcsv_head(system)), c(-10, -20, 30))
  expect_equal(x(fcsv_head("0"), frame = "RAS"), c(10, 20, 30))
  expect_equal(x(fcsv_head("LPS"), frame = "RAS"), c(-10, -20, 30))
  expect_equal(x(fcsv_head("0"), frame = "file"), c(10, 20, 30))
  expect_equal(x(fcsv_head(version = "4.6")[-2]), c(-10, -20, 30))
  expect_equal(x(fcsv_head(version = "4.11")[-2]), c(10, 20, 30))
  expect_equal(x(fcsv_head(version = "5.0")[-2]), c(10, 20, 30))
  expect_refused(fcsv_file(fcsv_head("XYZ"), fcsv_row("a")), c('"XYZ"', "LPS or RAS"))
  expect_crestline_error(read_landmarks(fcsv_file(fcsv_head()), frame = "LPI"), "Choose one of")
})

test_that("a point that is not defined is missing, whatever its position", {
  x <- read_landmarks(fcsv_file(fcsv_head(), fcsv_row("undefined", "0,0,0", ",,,0,0"),
                                fcsv_row("preview", "1,2,3", ",,,1,0"),
                                fcsv_row("defined", "0,0,0"),
                                fcsv_row("missing", "0,0,0", ",,,3,0"),
                                fcsv_row("old", "4,5,6", ",,")))
  expect_equal(rownames(x)[is.na(x[, 1])], c("undefined", "preview", "missing"))
  expect_equal(unname(x["defined", ]), c(0, 0, 0))
  expect_equal(unname(x["old", ]), 4:6)
})

test_that("labels hold #, commas and quotes; without a label the id is the name", {
  x <- read_landmarks(fcsv_file(fcsv_head(), fcsv_row("a #1"), fcsv_row('"nose, ""left"""'),
                                fcsv_row("#3", end = ",#,,2,0"), fcsv_row("")))
  expect_equal(rownames(x), c("a #1", 'nose, "left"', "#3", "1"))
  expect_equal(unname(x[, 3]), rep(30, 4))
})

test_that("other columns in another order are found by their names; any number of comment lines", {
  x <- read_landmarks(fcsv_file("# Fiducial List file old.fcsv", "# version = 2", "# name = F",
                                "# numPoints = 1", "# symbolScale = 5",
                                "# columns = label,x,y,z,sel,vis", "P1,1,2,3,1,1"))
  expect_equal(x, xyz(-1, -2, 3, name = "P1"))
  expect_equal(rownames(read_landmarks(fcsv_file(fcsv_row("no header")))), "no header")
})

test_that("what is written names its frame in a word, the columns, and the state of every point", {
  for (frame in c("LPS", "RAS")) {
    file <- fcsv_file("")
    write_landmarks(xyz(1, 2, 3, NA, NA, NA, name = c("a, b", "c")), file, frame = frame)
    line <- readLines(file)
    expect_equal(line[2], paste("# CoordinateSystem =", frame))
    expect_equal(line[1:3], fcsv_head(frame))
    field <- lapply(line[4:5], function(text) scan(text = text, what = "", sep = ",", quiet = TRUE))
    expect_equal(lengths(field), c(16L, 16L))
    expect_equal(vapply(field, `[`, "", 12), c("a, b", "c"))
    expect_equal(vapply(field, `[`, "", 15), c("2", "0"))
  }
})

test_that("descriptions with commas do not move the state, and lines may end as on Windows", {
  lines <- c(fcsv_head("1"), fcsv_row("a", end = ',"left, of two",node,3,1'),
             fcsv_row("b", end = ',"say ""x""",,2,1'))
  for (eol in c("\n", "\r\n")) {
    x <- read_landmarks(landmark_file("fcsv", lines, eol = eol))
    expect_equal(x, xyz(NA, NA, NA, 10, 20, 30, name = c("a", "b")))
  }
})

test_that("what cannot be read is refused with file, line and remedy", {
  expect_refused(fcsv_file(fcsv_head(), "1,2"), "too few fields", line = 4)
  expect_refused(fcsv_file(fcsv_head(), fcsv_row("a"), fcsv_row("b", "1,two,3")), '"two"', line = 5)
  expect_refused(fcsv_file("# columns = id,label", "1,2"), "no columns x, y, z")
})

test_that("a comma in a label without quotes is refused, not taken for the end of a field", {
  expect_refused(fcsv_file(fcsv_head(), fcsv_row("a"), fcsv_row("nose, left")),
                 "17 fields where there are 14 columns", line = 5)
  expect_refused(fcsv_file(fcsv_head(), fcsv_row("nose, left", end = ",,")), "15 fields", line = 4)
  expect_refused(fcsv_file(fcsv_head(), fcsv_row("a, b, c", end = ",x,")), "16 fields", line = 4)
  # Decimal commas, in a file that names no columns
  expect_refused(fcsv_file("1,1,5,2,5,3,5"), "7 fields where there are 14 columns", line = 1)
})
