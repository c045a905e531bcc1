extensions <- c("csv", "tps", "mrk.json", "pts", "nts", "dta", "landmarkAscii", "fcsv")
shape_file <- function(extension) tempfile(fileext = paste0(".", extension))

# The quad's shape without its corner c: a landmark and two curves missing, as points of NA.
lost_shape <- function() quad_shape(landmarks = quad_corners()[c("a", "b", "d"), ])

# A shape's points of one curve, as read_curves() has them.
curve_of <- function(shape, name) {
  at <- coords(shape, "curves")[shape$points$part[shape$points$level == "curves"] == name, ]
  structure(unname(at), dimnames = list(NULL, c("x", "y", "z")), closed = FALSE)
}

test_that("a shape's landmarks and curves, missing ones too, are read back to the last bit", {
  for (shape in list(quad_shape(), lost_shape())) {
    curves <- c("bottom", "top", "left", "right")
    expected <- lapply(stats::setNames(nm = curves), curve_of, shape = shape)
    for (extension in extensions) {
      file <- shape_file(extension)
      suppressWarnings(write_landmarks(shape, file), classes = "crestline_format_warning")
      landmarks <- read_landmarks(file)
      expect_identical(unname(landmarks[c("a", "b", "c", "d"), ]),
                       unname(coords(shape, "landmarks")))
      again <- read_curves(file)
      if (extension == "pts") names(again) <- curves
      expect_identical(again, expected)
    }
  }
})

test_that("what a format lacks for a shape is told: names of curves, or curves", {
  told <- function(extension, words) {
    warning <- expect_warning(write_landmarks(quad_shape(), shape_file(extension)),
                              class = "crestline_format_warning")
    for (word in words) expect_match(conditionMessage(warning), word, fixed = TRUE)
  }
  told("pts", c("C000 is bottom", "C003 is right"))
  for (extension in c("nts", "dta", "landmarkAscii", "fcsv")) {
    told(extension, c("no curves", "\"bottom 1\"", "read_curves()"))
  }
  for (extension in c("csv", "tps", "mrk.json")) {
    expect_no_warning(write_landmarks(quad_shape(), shape_file(extension)))
  }
  file <- shape_file("nts")
  expect_no_warning(write_landmarks(quad_shape(), file, curves = list()))
  expect_identical(read_landmarks(file), coords(quad_shape(), "landmarks"))
})

test_that("several shapes go into one file, each by its id", {
  shapes <- list(quad_shape(), lost_shape())
  shapes[[2]]$id <- "lost"
  for (extension in c("tps", "nts", "dta", "landmarkAscii")) {
    file <- shape_file(extension)
    suppressWarnings(write_landmarks(shapes, file), classes = "crestline_format_warning")
    again <- read_curves(file, c("top", "left"))
    expect_equal(names(again), c("quad", "lost"))
    for (i in 1:2) {
      expect_identical(again[[i]],
                       list(top = curve_of(shapes[[i]], "top"),
                            left = curve_of(shapes[[i]], "left")))
    }
  }
})

test_that("curves are found by name, in the order asked for; one that is not there is named", {
  file <- shape_file("csv")
  write_landmarks(quad_shape(), file)
  expect_named(read_curves(file, c("left", "bottom")), c("left", "bottom"))
  error <- expect_crestline_error(read_curves(file, c("left", "botom")),
                                  c(basename(file), "botom", "Near names: bottom"))
  expect_s3_class(error, "crestline_landmark_error")
  write_landmarks(xyz(1, 2, 3, name = "a"), file)
  expect_equal(read_curves(file), list(), ignore_attr = TRUE)
  expect_crestline_error(read_curves(file, "left"), "has no curves")
})

test_that("numbered points are a curve only where the numbers run from 1 without a gap", {
  x <- xyz(1:24,
           name = c("lip 2", "lip 1", "P 1", "eye 1", "eye 3", "brow 10 1", "brow 10 2", "rim"))
  file <- shape_file("fcsv")
  write_landmarks(x, file)
  expected <- list(lip = structure(xyz(4:6, 1:3), closed = FALSE),
                   "brow 10" = structure(xyz(16:21), closed = FALSE))
  expect_equal(read_curves(file), expected)
})

test_that("frames are passed on, and curves from a file take the place of a shape's own", {
  shape <- quad_shape()
  file <- shape_file("mrk.json")
  write_landmarks(shape, file)
  expect_equal(read_curves(file, "left", frame = "RAS")$left[2, ],
               read_curves(file)$left[2, ] * c(-1, -1, 1))
  again <- fit_shape(quad_specimen(), quad_scheme(), curves = read_curves(file), progress = FALSE)
  expect_equal(coords(again, "curves"), coords(shape, "curves"), tolerance = 1e-9)
})
