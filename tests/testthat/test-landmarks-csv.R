csv_file <- function(...) {
  file <- tempfile(fileext = ".csv")
  writeLines(c(...), file)
  file
}
expected <- matrix(c(1.5, -2, 3e-5, NA, NA, NA), 2, byrow = TRUE, dimnames = list(c("pn", "sn, left"), c("x", "y", "z")))

test_that("what is written is read back, to the last digit", {
  x <- rbind(expected, thin = c(pi * 1e6, 1 / 3, -1e-300))
  file <- csv_file("")
  expect_identical(write_landmarks(x, file), file)
  expect_equal(read_landmarks(file), x, tolerance = 1e-14)
  s <- specimen(ball_mesh(), rbind(top = c(0, 0, 1)))
  write_landmarks(s, file)
  expect_equal(read_landmarks(file), s$landmarks, tolerance = 1e-14)
  write_landmarks(x[0, ], file)
  expect_equal(dim(read_landmarks(file)), c(0, 3))
})

test_that("header words, order of columns and further columns are free", {
  for (lines in list(
    c("name,x,y,z", "pn,1.5,-2,3e-5", "\"sn, left\",NA,NA,NA"),
    c("Z,Landmark,X,Y,note", "3e-5,pn,1.5,-2,good", ",\"sn, left\",,,"),
    c("\ufeffx,y,z,LABEL", "1.5,-2, 3e-5 , pn", "NaN,NaN,NA,\"sn, left\""),
    c("point,x,y,z", "pn,1.5,-2,3e-5", "\"sn, left\",NA,NA,NA")
  )) {
    expect_equal(read_landmarks(csv_file(lines)), expected)
  }
})

test_that("names with accents come through, in UTF-8 and in Latin 1", {
  text <- "name,x,y,z\nn\u00e9z,1,2,3\n"
  file <- csv_file("")
  for (encoding in c("UTF-8", "latin1")) {
    writeBin(iconv(text, "UTF-8", encoding, toRaw = TRUE)[[1]], file)
    expect_equal(rownames(read_landmarks(file)), "n\u00e9z")
  }
  writeBin(as.raw(c(0, 255, 128, 10, 200:255)), file)
  expect_crestline_error(read_landmarks(file), "cannot be read")
})

test_that("what cannot be read is refused with file, line and remedy", {
  expect_crestline_error(read_landmarks("none.csv"), "none.csv")
  expect_crestline_error(read_landmarks(csv_file("name,x,y", "a,1,2")), c("no column z", "header line"))
  expect_crestline_error(read_landmarks(csv_file("name,x,y,z", "a,1,2,3", "b,1,2;5,3")), c("line 3", "column y", "2;5"))
  expect_crestline_error(read_landmarks(csv_file("x,y,z", "1,2,3")), "no column of names")
  expect_crestline_error(read_landmarks(csv_file("")), "cannot be read")
  file <- tempfile(fileext = ".pts")
  file.create(file)
  expect_crestline_error(read_landmarks(file), ".csv")
  expect_crestline_error(write_landmarks(expected, "a.unknown"), "Known: .csv")
  expect_crestline_error(write_landmarks(1:3, csv_file("")), "k x 3")
})
