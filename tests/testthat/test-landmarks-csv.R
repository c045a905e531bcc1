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
  expect_refused(csv_file("name,x,y,z", "a,1,2,3", "b,1,2;5,3"),
                 c("2;5", "decimal point"), line = 3)
  expect_refused(csv_file("name,x,y,z", "a,1,2,3", "b,1,1e999,3"), "not a finite number", line = 3)
  expect_refused(csv_file("x,y,z", "1,2,3"), "no column of names")
  expect_refused(csv_file(""), "cannot be read")
})

test_that("decimal commas between commas and thousands' between semicolons are refused", {
  expect_refused(csv_file("name;x;y;z", "a;1,234.5;2;3"), c("1.234.5", "decimal point"), line = 2)
  expect_refused(csv_file("name,x,y,z", 'a,"1,5",2,3'),
                 c('"1,5" is not a number', "decimal point"), line = 2)
})

test_that("blanks at the ends of a name stay when it is quoted", {
  expect_round_trip(xyz(1, 2, 3, name = " a "), "csv")
})

test_that("semicolons with decimal commas, and tabs, are read as spreadsheets write them", {
  for (lines in list(c("name;x;y;z", "pn;1,5;-2;3e-5", "\"sn, left\";;;"),
                     c("name\tx\ty\tz", "pn\t1.5\t-2\t3e-5", "\"sn, left\"\t\t\t"))) {
    expect_equal(read_landmarks(csv_file(lines)), expected, ignore_attr = TRUE)
  }
})

test_that("a row with more or fewer fields is refused with its line", {
  expect_refused(csv_file("name,x,y,z", "n,1,2,3", "pn,1,5,4,6"), "5 fields where the header has 4",
                 line = 3)
  expect_refused(csv_file("name,x,y,z", "n,1,2,3", "pn,1,2"), "3 fields", line = 3)
  expect_refused(csv_file("curve,point,x,y,z", "lip,1,1,2,3", "lip,2,1,5,2,3"),
                 "6 fields where the header has 5", line = 3)
  expect_refused(csv_file("name,x,x,y,z", "n,1,1,2,3"), "two columns are called \"x\"", line = 1)
  expect_refused(csv_file("n,1,2,3", "pn,4,5,6"), "no header line", line = 1)
  expect_refused(csv_file("name;x;y;z", "n;1,500;2.25;3"), "decimal comma", line = 2)
})

test_that("NaN of Windows programs is a missing landmark, their infinity is refused", {
  for (word in c("-1.#IND", "1.#QNAN0", "-nan(ind)", "nan(snan)", "NaN", "NA")) {
    expect_true(all(is.na(read_landmarks(csv_file("name,x,y,z", paste0("n,1,", word, ",3"))))))
  }
  expect_refused(csv_file("name,x,y,z", "n,1,1.#INF,3"), "is not a number", line = 2)
})

test_that("points have names, and one place", {
  expect_refused(csv_file("name,x,y,z", ",1,2,3"), "a point has no name", line = 2)
  expect_refused(csv_file("name,x,y,z", "n,1,2,3", "n,1,2,4"), "the landmark n is there twice",
                 line = 3)
  expect_equal(rownames(read_landmarks(csv_file('"","x","y","z"', '"n",1,2,3'))), "n")
})

test_that("what spreadsheets and R leave is read as without it", {
  for (lines in list(c("sep=;", "name;x;y;z", "n;1,5;2;3", ";;;", "pn;4;5;6"),
                     c("# mm", "name,x,y,z,", "n,1.5,2,3,", "pn,4,5,6,", ",,,,"))) {
    for (eol in c("\n", "\r", "\r\n")) {
      expect_equal(read_landmarks(landmark_file("csv", lines, eol = eol)),
                   xyz(1.5, 2, 3, 4, 5, 6, name = c("n", "pn")))
    }
  }
})

test_that("tables of 3D Slicer are read in the frame of their names", {
  ras <- csv_file("label,r,a,s,defined,selected,visible,locked,description",
                  "n,1,2,3,1,1,1,0,\"a, b\"", "gn,0,0,0,0,1,1,0,")
  lps <- csv_file("label,l,p,s,defined", "n,-1,-2,3,1", "gn,0,0,0,0")
  for (file in c(ras, lps)) {
    expect_equal(read_landmarks(file), xyz(-1, -2, 3, NA, NA, NA, name = c("n", "gn")))
    expect_equal(unname(read_landmarks(file, frame = "RAS")["n", ]), 1:3)
  }
  expect_equal(unname(read_landmarks(ras, frame = "file")["n", ]), 1:3)
  expect_refused(csv_file("name,x,y,z,r,a,s", "n,1,2,3,1,2,3"), "co-ordinates twice")
})

test_that("a column of specimens makes a list of them", {
  rows <- c("S1,n,1,2,3", "S1,pn,4,5,6", "S2,n,7,8,9", "S2,pn,NA,,")
  for (header in c("specimen,landmark,x,y,z", "ID,name,x,y,z", "File,label,x,y,z",
                   "name,landmark,x,y,z")) {
    expect_equal(read_landmarks(csv_file(header, rows)),
                 list(S1 = xyz(1:6, name = c("n", "pn")),
                      S2 = xyz(7:9, NA, NA, NA, name = c("n", "pn"))))
  }
  expect_equal(rownames(read_landmarks(csv_file("id,name,x,y,z", "1,n,1,2,3", "2,pn,4,5,6"))),
               c("n", "pn"))
  expect_equal(rownames(read_landmarks(csv_file("specimen,name,x,y,z", "S1,n,1,2,3",
                                                "S1,pn,4,5,6"))), c("n", "pn"))
  expect_refused(csv_file("scan,name,x,y,z", "S1,n,1,2,3", ",pn,4,5,6"), "no specimen is named",
                 line = 3)
  expect_refused(csv_file("scan,name,x,y,z", "S1,n,1,2,3", "s1,pn,4,5,6"),
                 "seem to be one specimen", line = 3)
  expect_length(read_landmarks(shared_data("simpop", "landmarks.csv")), 23)
})

test_that("points of a curve go by their numbers, not by their rows", {
  x <- read_landmarks(csv_file("curve,point,x,y,z", "lip,1,1,0,0", "lip,10,10,0,0", "lip,2,2,0,0"))
  expect_equal(attr(x, "curves")$lip[, "x"], c(1, 2, 10))
})
