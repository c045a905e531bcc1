csv_file <- function(...) landmark_file("csv", ...)
expected <- xyz(1.5, -2, 3e-5, NA, NA, NA, name = c("pn", "sn, left"))

test_that("what is written is read back, to the last bit, with curves and without", {
  expect_round_trip(hard_landmarks(), "csv")
  expect_round_trip(hard_landmarks()[0, ], "csv")
  expect_round_trip(structure(hard_landmarks(), curves = hard_curves()), "csv")
  expect_round_trip(structure(hard_landmarks()[0, ], curves = hard_curves()), "CSV")
  s <- specimen(ball_mesh(), rbind(top = c(0, 0, 1)))
  file <- csv_file("")
  write_landmarks(s, file)
  expect_identical(read_landmarks(file), s$landmarks)
})

test_that("header words, order of columns and further columns are free", {
  for (lines in list(
    c("name,x,y,z", "pn,1.5,-2,3e-5", "\"sn, left\",NA,NA,NA"),
    c("Z,Landmark,X,Y,note", "3e-5,pn,1.5,-2,good", ",\"sn, left\",,,"),
    c("\ufeffx,y,z,LABEL", "1.5,-2, 3e-5 , pn", "NaN,3,NA,\"sn, left\""),
    c("point,x,y,z", "pn,1.5,-2,3e-5", "\"sn, left\",NA,NA,NA")
  )) {
    expect_equal(read_landmarks(csv_file(lines)), expected)
  }
})

test_that("a column curve makes curves of its rows", {
  x <- read_landmarks(csv_file("curve,point,x,y,z", "lip,1,1,2,3", "lip,2,4,5,6", "brow,1,7,8,9"))
  expect_equal(dim(x), c(0, 3))
  expect_equal(attr(x, "curves"), list(lip = structure(xyz(1, 2, 3, 4, 5, 6), closed = FALSE),
                                       brow = structure(xyz(7, 8, 9), closed = FALSE)))
  curves <- attr(read_landmarks(shared_data("scan_a", "reference_curves.csv")), "curves")
  expect_length(curves, 40)
  expect_equal(sum(vapply(curves, nrow, 0L)), 467)
})

test_that("names with accents come through, in UTF-8 and in Latin 1", {
  text <- "name,x,y,z\nn\u00e9z,1,2,3\n"
  file <- csv_file("")
  for (encoding in c("UTF-8", "latin1")) {
    writeBin(iconv(text, "UTF-8", encoding, toRaw = TRUE)[[1]], file)
    expect_equal(rownames(read_landmarks(file)), "n\u00e9z")
  }
  writeBin(as.raw(c(0, 255, 128, 10, 200:255)), file)
  expect_refused(file, "cannot be read")
})

test_that("what cannot be read is refused with file, line and remedy", {
  expect_crestline_error(read_landmarks("none.csv"), "none.csv")
  expect_refused(csv_file("name,x,y", "a,1,2"), c("no column z", "header line"))
  expect_refused(csv_file("name,x,y,z", "a,1,2,3", "b,1,2;5,3"), c("2;5", "decimal point"), line = 3)
  expect_refused(csv_file("name,x,y,z", "a,1,2,3", "b,1,1e999,3"), "not a finite number", line = 3)
  expect_refused(csv_file("x,y,z", "1,2,3"), "no column of names")
  expect_refused(csv_file(""), "cannot be read")
})

test_that("decimal commas between commas, and thousands' commas between semicolons, are refused, not misread", {
  expect_refused(csv_file("name;x;y;z", "a;1,234.5;2;3"), c("1.234.5", "decimal point"), line = 2)
  expect_refused(csv_file("name,x,y,z", 'a,"1,5",2,3'), c('"1,5" is not a number', "decimal point"), line = 2)
})

test_that("blanks at the ends of a name stay when it is quoted", {
  expect_round_trip(xyz(1, 2, 3, name = " a "), "csv")
})

test_that("semicolons with decimal commas, and tabs, are read as spreadsheets write them", {
  for (lines in list(c("name;x;y;z", "pn;1,5;-2;3e-5", "\"sn, left\";;;"), c("name\tx\ty\tz", "pn\t1.5\t-2\t3e-5", "\"sn, left\"\t\t\t"))) {
    expect_equal(read_landmarks(csv_file(lines)), expected, ignore_attr = TRUE)
  }
})
