tps_file <- function(...) landmark_file("tps", ...)

test_that("what is written is read back to the last bit, curves with names, order and kind", {
  expect_round_trip(hard_landmarks(), "tps")
  expect_round_trip(structure(hard_landmarks(), curves = hard_curves()), "tps")
  both <- hard_curves()[c(2, 1, 3)]
  expect_round_trip(list(a = structure(hard_landmarks(), curves = both),
                         b = structure(hard_landmarks()[1:3, ], curves = hard_curves())), "tps")
})

test_that("LM3= and CURVES= are read, the lengths of curves kept, equal or not", {
  x <- read_landmarks(tps_file("LM3=1", "1 2 3", "CURVES=2", "POINTS=2", "4 5 6", "7 8 9",
                               "POINTS=1", "1 1 1", "ID=a", "lm3=1", "1 2 -3", "curves=1",
                               "points=3", "1 2 3", "1 2 3", "1 2 3", "id=b"))
  expect_equal(names(x), c("a", "b"))
  expect_equal(unname(vapply(attr(x$a, "curves"), nrow, 0L)), 2:1)
  expect_equal(unname(vapply(attr(x$b, "curves"), nrow, 0L)), 3)
  expect_equal(x$b["1", "z"], -3)
})

test_that("POINTS= without a head, as in old files, are open curves", {
  x <- read_landmarks(tps_file("LM3=1", "1 2 3", "POINTS=2", "4 5 6", "7 8 9", "OUTLINES=1",
                               "POINTS=1", "1 1 1"))
  expect_equal(attr(x, "curves"), list("curve 1" = structure(xyz(4:9), closed = FALSE),
                                       "curve 2" = structure(xyz(1, 1, 1), closed = TRUE)))
})

test_that("two-dimensional records lie in z = 0; over 99 landmarks, without IMAGE or ID", {
  x <- read_landmarks(tps_file("LM=120", paste(1:120, 5), "OUTLINES=1", "POINTS=1", "7 8"))
  expect_equal(x[c("1", "120"), ], xyz(1, 5, 0, 120, 5, 0, name = c("1", "120")))
  expect_equal(attr(x, "curves"), list("curve 1" = structure(xyz(7, 8, 0), closed = TRUE)))
})

test_that("names come whole from ID=, from IMAGE= where ID= does not tell apart, else by number", {
  record <- function(...) c("LM3=1", "1 2 3", ...)
  expect_equal(names(read_landmarks(tps_file(record("ID=GRID=1", "IMAGE=a.jpg"), record("ID=2")))),
               c("GRID=1", "2"))
  expect_equal(
    names(read_landmarks(tps_file(record("IMAGE=a.jpg", "ID=0"), record("IMAGE=b.jpg", "ID=0")))),
    c("a.jpg", "b.jpg"))
  expect_equal(names(read_landmarks(tps_file(record("IMAGE=a.jpg"), record("ID=7")))), c("1", "2"))
})

test_that("SCALE= multiplies landmarks and curves; on some specimens only it is refused", {
  scaled <- c("LM3=1", "1 2 3", "CURVES=1", "POINTS=1", "4 5 6", "SCALE=0.5")
  x <- read_landmarks(tps_file(scaled))
  expect_equal(unname(x[1, ]), c(0.5, 1, 1.5))
  expect_equal(unname(attr(x, "curves")[[1]][1, ]), c(2, 2.5, 3))
  mixed <- tps_file(scaled, "LM3=1", "1 2 3")
  expect_refused(mixed, c("units would mix", "1 of 2", "scale = FALSE"), line = 7)
  x <- read_landmarks(mixed, scale = FALSE)
  expect_equal(unname(x[[1]][1, ]), 1:3)
  expect_equal(unname(read_landmarks(tps_file("LM3=1", "1 2 3", "SCALE="))[1, ]), 1:3)
  expect_refused(tps_file("LM3=1", "1 2 3", "SCALE=big"), '"big"', line = 3)
})

test_that("negative co-ordinates are numbers; NA in one is a missing point", {
  x <- read_landmarks(tps_file("LM3=3", "-1 -2 -3", "NA NA NA", "1 NaN 3"))
  expect_equal(x, xyz(-1, -2, -3, rep(NA, 6), name = c("1", "2", "3")))
})

test_that("comments of others and variables are left alone", {
  x <- read_landmarks(tps_file("LM3=1", "1 2 3", "COMMENT=landmarks were placed twice",
                               "VARIABLES=a=1"))
  expect_equal(rownames(x), "1")
  expect_refused(tps_file("LM3=2", "1 2 3", "1 2 3", 'COMMENT=landmarks: "a"'), "1 names for 2")
})

test_that("what cannot be read is refused with file, line and remedy", {
  expect_refused(tps_file("1 2 3"), "no line LM= or LM3=")
  expect_refused(tps_file("LM3=2", "1 2 3"), "LM3= announces 2 points, 1 follow", line = 1)
  expect_refused(tps_file("LM3=2", "1 2 3", "1 2"), "2 words where 3", line = 3)
  expect_refused(tps_file("LM3=1", "1 2 3,5"), "4 words where 3", line = 2)
  expect_refused(tps_file("LM=1", "1"), "two or three", line = 2)
  expect_refused(tps_file("LM3=x"), "no whole number", line = 1)
  expect_refused(tps_file("LM3=1", "1 2 3", "CURVES=2", "POINTS=1", "1 2 3"),
                 "CURVES= announces 2, 1 follow", line = 3)
  expect_refused(tps_file("LM3=1", "1 2 3", "ID=a", "4 5 6"),
                 "ID= announces 0 points, 1 follow", line = 3)
})

test_that("decimal commas that look like more numbers are refused", {
  expect_refused(tps_file("LM=2", "1,5 2", "3,5 4"), "both commas and blanks", line = 2)
  expect_equal(unname(read_landmarks(tps_file("LM3=1", "1, 2, 3"))[1, ]), 1:3)
})

test_that("a factor of nothing, a negative one and two of them are refused", {
  record <- c("LM3=1", "1 2 3", "ID=a")
  expect_refused(tps_file(record, "SCALE=0"), "SCALE=0 is not greater than 0", line = 4)
  expect_refused(tps_file(record, "SCALE=-0.5"), "SCALE=-0.5", line = 4)
  expect_refused(tps_file(record, "SCALE=2", "SCALE=3"), "two different SCALE=", line = 5)
  expect_equal(unname(read_landmarks(tps_file(record, "SCALE=2", "SCALE=2.0"))[1, ]), c(2, 4, 6))
  expect_equal(unname(read_landmarks(tps_file(record, "SCALE=0"), scale = FALSE)[1, ]), 1:3)
})

test_that("curves without landmarks have the co-ordinates that they have", {
  x <- read_landmarks(tps_file("LM=0", "CURVES=1", "POINTS=2", "1 2 3", "4 5 6", "ID=a"))
  expect_equal(nrow(x), 0)
  expect_equal(unname(attr(x, "curves")[[1]][2, ]), c(4, 5, 6))
})

test_that("names of many points stand in short lines, and are read back", {
  x <- matrix(1:600, 200, 3, dimnames = list(sprintf("brow ridge left %d", 1:200), NULL))
  file <- tempfile(fileext = ".tps")
  on.exit(unlink(file))
  write_landmarks(x, file)
  comments <- grep("^COMMENT=", readLines(file), value = TRUE)
  expect_gt(length(comments), 15)
  expect_lt(max(nchar(comments)), 250)
  expect_equal(rownames(read_landmarks(file)), rownames(x))
})
