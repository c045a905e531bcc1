amira_file <- function(...) landmark_file("landmarkAscii", ...)
amira_head <- c("# Avizo 3D ASCII 3.0", "", "define Markers 2", "")
amira_one <- c("Parameters {", "    NumSets 1,", "    ContentType \"LandmarkSet\"", "}", "",
               "Markers { float[3] Coordinates } @1", "", "# Data section follows", "@1", "1 2 3",
               "4.0e+00 5 6", "")

test_that("what is written is read back, to the last bit, with names", {
  expect_round_trip(hard_landmarks(), "landmarkAscii")
  x <- hard_landmarks()
  rownames(x)[1:3] <- c("a\\", "N3 \"x\"", "{ Names }")
  expect_round_trip(list("set \\\"1\"" = x, b = -x), "landmarkAscii")
})

test_that("without names of landmarks the header is that of Amira, data from the tenth full line", {
  file <- expect_round_trip(xyz(1, 2, 3, 4, 5, 6, name = 1:2), "landmarkAscii")
  line <- readLines(file)
  expect_equal(line[nzchar(line)][9:10], c("@1", "1 2 3"))
})

test_that("parameters may come in any order and number, and colours among them", {
  expected <- xyz(1:6, name = 1:2)
  expect_equal(read_landmarks(amira_file(amira_head, amira_one)), expected)
  more <- c("Parameters {", "    ContentType \"LandmarkSet\",", "    Color 1 0.5 0,",
            "    Material { Id 1 },", "    NumSets 1", "}")
  expect_equal(read_landmarks(amira_file(amira_head, more, rep("", 120), amira_one[-(1:4)])),
               expected)
  expect_equal(read_landmarks(landmark_file("landmarkAscii", amira_head, amira_one, eol = "\r\n")),
               expected)
})

test_that("two sets are two specimens, whatever stands between head and data", {
  two <- c("Markers { float[3] Coordinates } @1", "Markers { float[3] Coordinates2 } @2", "",
           "# Data section follows")
  data <- c("@1", "1.000000000000000e+00 2.000000000000000e+00 3.000000000000000e+00", "4 5 6", "",
            "@2", "7 8 9", "10 11 12")
  parameters <- c("Parameters {", "    NumSets 2,", "    ContentType \"LandmarkSet\"", "}")
  many <- c("Parameters {", sprintf("    Colour%d 1 0 0,", 1:120),
            "    ContentType \"LandmarkSet\",", "    NumSets 2", "}")
  for (head in list(character(), parameters, many)) {
    x <- read_landmarks(amira_file(amira_head, head, two, data))
    expect_equal(x, list("1" = xyz(1:6, name = 1:2), "2" = xyz(7:12, name = 1:2)))
  }
})

test_that("what cannot be written or read is refused with file, line and remedy", {
  x <- xyz(1, 2, 3, name = "a")
  expect_crestline_error(write_landmarks(list(s = x, t = xyz(1, 2, 3, name = "b")),
                                         "a.landmarkAscii"), "other landmarks")
  expect_refused(amira_file("# AmiraMesh BINARY-LITTLE-ENDIAN 2.1"),
                 c("ASCII", "not binary"), line = 1)
  expect_refused(amira_file("# AmiraMesh 3D ASCII 2.0", amira_one), "define Markers")
  expect_refused(amira_file(amira_head, amira_one[-6]), "no co-ordinates")
  expect_refused(amira_file(amira_head, amira_one[-(9:11)]), "no data @1")
  expect_refused(amira_file(amira_head, amira_one[-10]),
                 "2 points are announced, 1 follow", line = 13)
  expect_refused(amira_file(amira_head, sub("4.0e+00", "x", amira_one, fixed = TRUE)),
                 '"x"', line = 15)
  expect_refused(amira_file(amira_head, sub("4.0e+00", "", amira_one, fixed = TRUE)),
                 "2 words where 3", line = 15)
})
