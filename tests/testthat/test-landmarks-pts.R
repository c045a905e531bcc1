pts_file <- function(...) landmark_file("pts", ...)

test_that("what is written is read back, to the last bit", {
  expect_round_trip(hard_landmarks(), "pts")
  curves <- list(C000 = structure(xyz(1 / 3, 2, 3, NA, NA, NA), closed = FALSE),
                 C002 = structure(xyz(7, 8, 9), closed = FALSE))
  file <- expect_round_trip(structure(hard_landmarks(), curves = curves), "pts")
  expect_equal(readLines(file)[1:2], c("Version 1.0", "109"))
  expect_true("C000-001 9999 9999 9999" %in% readLines(file))
})

test_that("names may hold blanks, the header further lines, and curves are not landmarks", {
  x <- read_landmarks(pts_file("Version 1.0", "specimen A", "6", "S000 1 2 3", "tip of nose 4\t5 6",
                               "  S.1   7 8 9  ", "", "C002-001 1 1 1", "C002-003 3 3 3",
                               "C.1.002 2 2 2"))
  expect_equal(rownames(x), c("S000", "tip of nose", "S.1"))
  expect_equal(unname(x["tip of nose", ]), 4:6)
  expect_equal(attr(x, "curves"), list(C002 = structure(xyz(1, 1, 1, 3, 3, 3), closed = FALSE),
                                       C.1 = structure(xyz(2, 2, 2), closed = FALSE)))
})

test_that("the last point counts without a line end too, points of patches keep their names", {
  lines <- "Version 1.0\n3\nS000 1 2 3\nP000-000 4 5 6\nS001 7 8 9"
  expected <- xyz(1:9, name = c("S000", "P000-000", "S001"))
  expect_equal(read_landmarks(landmark_file("pts", lines, eol = "")), expected)
  expect_equal(read_landmarks(pts_file(lines)), expected)
  expect_equal(read_landmarks(pts_file(lines, "", "")), expected)
})

test_that("names of landmarks stay, whatever they begin with, even when given twice", {
  x <- read_landmarks(pts_file("Version 1.0", "4", "pn 1 2 3", "Condyle 4 5 6", "sn 7 8 9",
                               "sn 7 8 9"))
  expect_equal(rownames(x), c("pn", "Condyle", "sn", "sn"))
  expect_null(attr(x, "curves"))
})

test_that("9999 is missing only three times in a point", {
  file <- pts_file("Version 1.0", "2", "a 9999 9999 9999.0", "b 9999 9999 3")
  expect_equal(read_landmarks(file), xyz(NA, NA, NA, 9999, 9999, 3, name = c("a", "b")))
  expect_equal(read_landmarks(file, missing = -1)["a", "x"], 9999)
  x <- xyz(9999, 9999, 9999, NA, NA, NA, name = c("a", "b"))
  expect_crestline_error(write_landmarks(x, file), c("read as missing", "`missing`"))
  write_landmarks(x, file, missing = -1)
  expect_identical(read_landmarks(file, missing = -1), x)
})

test_that("what the format cannot say is told", {
  file <- pts_file("")
  expect_warning(write_landmarks(xyz(1, 2, 3, name = "a"), file, curves = hard_curves()),
                 "C000 is upper lip, left, C001 is rim.*closed", class = "crestline_format_warning")
  expect_equal(names(attr(read_landmarks(file), "curves")), c("C000", "C001", "C002"))
  expect_crestline_error(write_landmarks(xyz(1, 2, 3, name = "C001-002"), file),
                         c("C001-002", "otherwise"))
  expect_crestline_error(write_landmarks(xyz(1, 2, 3, name = " a"), file), "no blanks at the ends")
})

test_that("what cannot be read is refused with file, line and remedy", {
  expect_refused(pts_file("Version 1.0", "pn 1 2 3"), c("number of points", "Version 1.0"))
  expect_refused(pts_file("Version 1.0", "3", "a 1 2 3", "b 1 2 3"),
                 "3 points are announced, 2 follow", line = 2)
  expect_refused(pts_file("Version 1.0", "1", "a 1 2 3", "b 1 2 3"),
                 "1 points are announced, 2 follow", line = 2)
  expect_refused(pts_file("Version 1.0", "2", "a 1 2 3", "b 1 2"),
                 "not a name and three numbers", line = 4)
  expect_refused(pts_file("Version 1.0", "2", "a 1 2 3", "b 1 2 x3"),
                 '"x3" is not a number', line = 4)
  expect_refused(pts_file(""), "number of points")
})

test_that("a fourth number in a row moves none of the others into the name", {
  expect_refused(pts_file("Version 1.0", "2", "a 1 2 3", "b 1.5 2 3 0.25"),
                 c("more than three numbers", "b 1.5"), line = 4)
  expect_identical(
    rownames(read_landmarks(pts_file("Version 1.0", "2", "tip 1 1.5 2 3", "no. 2 1 2 3"))),
    c("tip 1", "no. 2"))
})
