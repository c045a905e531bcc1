nts_file <- function(...) landmark_file("nts", ...)

test_that("what is written is read back, to the last bit, from .nts and .dta", {
  for (extension in c("nts", "dta")) {
    expect_round_trip(hard_landmarks(), extension)
    expect_round_trip(list(a = hard_landmarks(), "b 2" = hard_landmarks() / 3), extension)
    expect_round_trip(list(a = xyz(1, 2, 3, name = "pn"), b = xyz(4, 5, 6, name = "pn"),
                           c = xyz(7, 8, 9, name = "pn")), extension)
    expect_round_trip(list(a = xyz(1, 2, 3, name = "1"), b = xyz(4, 5, 6, name = "1")), extension)
  }
})

test_that("labels may hold blanks, stand one a line or several, and letters be of either case", {
  expected <- list("face one" = xyz(1:6, name = c("1", "2")), two = xyz(7:12, name = c("1", "2")))
  head <- "1 2L 6 1 9999 dim=3"
  expect_equal(read_landmarks(nts_file("' comment", "\" and another", head, "", "face one", "two",
                                       "", "1 2 3", "4 5 6", "", "7 8 9", "10 11 12")), expected)
  expect_equal(read_landmarks(nts_file("1 2l 6 1 9999 DIM=3", "face one", "two", "1 2 3 4 5 6",
                                       "7 8 9 10 11 12")), expected)
  expect_equal(names(read_landmarks(nts_file(head, "one two", 1:12))), c("one", "two"))
  expect_equal(names(read_landmarks(nts_file("1 2 6L 0 Dim = 3", paste0("v", 1:6), 1:12))),
               c("1", "2"))
})

test_that("one specimen with rows and columns swapped has labels for landmarks", {
  expected <- xyz(1:6, name = c("tip of nose", "sn"))
  expect_equal(read_landmarks(nts_file("1 2L 3 0 DIM=3", "tip of nose", "sn", "1 2 3", "4 5 6")),
               expected)
  expect_equal(read_landmarks(nts_file("1 2 2 0 DIM=2", "1 2", "4 5")),
               xyz(1, 2, 0, 4, 5, 0, name = c("1", "2")))
})

test_that("only the code itself is missing, and reading leaves the options alone", {
  before <- options(warn = 1)
  on.exit(options(before))
  x <- read_landmarks(nts_file("1 1L 9 1 9999 DIM=3", "a", "9999 9999 9999", "99991.5 1 9999.5",
                               "1 9999.0 3"))
  expect_equal(x, xyz(NA, NA, NA, 99991.5, 1, 9999.5, NA, NA, NA, name = 1:3))
  expect_equal(getOption("warn"), 1)
})

test_that("the code of a missing point is what the header says, and need not occur", {
  x <- read_landmarks(nts_file("1 1L 9 1 -999 DIM=3", "a", "-999 -999 -999",
                               "9999 9999 9999", "1 2 3"))
  expect_equal(x, xyz(NA, NA, NA, 9999, 9999, 9999, 1, 2, 3, name = 1:3))
  expect_false(anyNA(read_landmarks(nts_file("1 1L 6 1 9999 DIM=3", "a", "1 2 3", "4 5 6"))))
})

test_that("a header that declares nothing missing keeps the code in single co-ordinates", {
  x <- read_landmarks(nts_file("1 1L 6 0 9999 DIM=3", "a", "9999 9999 9999", "1 9999 3"))
  expect_equal(x, xyz(NA, NA, NA, 1, 9999, 3, name = 1:2))
})

test_that("the code that is written is no co-ordinate", {
  file <- expect_round_trip(xyz(9999, 99999, 3, NA, NA, NA, name = c("a", "b")), "nts")
  expect_true("1 1L 6 1 999999 DIM=3" %in% readLines(file))
})

test_that("what cannot be written or read is refused with file, line and remedy", {
  x <- xyz(1, 2, 3, name = "a")
  expect_crestline_error(write_landmarks(list(s = x, t = xyz(1, 2, 3, name = "b")), "a.nts"),
                         c("a.nts", "specimen t has other landmarks"))
  expect_crestline_error(write_landmarks(list("'s" = x, t = x), "a.dta"), "cannot be a label")
  expect_refused(nts_file("'only a comment"), "no line of parameters")
  expect_refused(nts_file("1 2L 6 1 9999", "1 2 3"), c("cannot be read", "DIM=3"), line = 1)
  expect_refused(nts_file("2 3 3 0 DIM=3", "1"), "rectangular", line = 1)
  expect_refused(nts_file("1 2B 6 0 DIM=3", "1"), "B, E", line = 1)
  expect_refused(nts_file("1 2 7 0 DIM=3", "1"), "not points", line = 1)
  expect_refused(nts_file("1 1L 6 1 x DIM=3", "1"), '"x"', line = 1)
  expect_refused(nts_file("'", "1 1L 6 1 9999 DIM=3", "a", "1 2 3", "4 5"),
                 "1 labels and 6 numbers are announced, 6 words follow")
  expect_refused(nts_file("1 1L 6 1 9999 DIM=3", "a", "1 2 3", "4 5 6,x"), "8 words")
  expect_refused(nts_file("1 1L 6 1 9999 DIM=3", "a", "1 2 3", "4 5 sn"), '"sn"', line = 4)
})

test_that("a label over two different specimens is refused", {
  expect_refused(nts_file("1 2L 6 0 DIM=3", "a a", "1 2 3 4 5 6", "1 2 3 4 5 7"),
                 "the specimen a is there twice")
  expect_identical(
    names(read_landmarks(nts_file("1 2L 6 0 DIM=3", "a b", "1 2 3 4 5 6", "1 2 3 4 5 6"))),
    c("a", "b"))
})
