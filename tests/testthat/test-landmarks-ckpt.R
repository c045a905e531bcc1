ckpt_file <- function(points, single = NULL, count = length(points)) {
  landmark_file("ckpt", "Version 6", "Stratovan Checkpoint (TM)", "", "[Surface Information]",
                "NumberOfSurfaces: 1", '0: -41 "" 200 200 200', "", "[Landmarks]",
                paste("NumberOfPoints:", count), "Units: um", points, "", single, "[Curves]",
                "NumberOfCurves: 0")
}
ckpt_point <- function(i, x, name, state = "N") {
  sprintf('%d: 0 %s 0x48 %s 2.5 -3 0.69 -0.65 -0.28 "%s" 0 1', i, state, x, name)
}

test_that("points of Checkpoint are read by name, those marked M as missing", {
  x <- read_landmarks(ckpt_file(c(ckpt_point(0, "1469.846313", "eye tip L"),
                                  ckpt_point(1, 1, "eye_R", "M"), ckpt_point(2, 7, ""))))
  expect_equal(x, xyz(1469.846313, 2.5, -3, NA, NA, NA, 7, 2.5, -3,
                      name = c("eye tip L", "eye_R", "2")))
})

test_that("points of curves are left out with a warning", {
  single <- c("[SinglePoints]", "NumberOfSinglePoints: 1", "0: 1 0 2", "")
  expect_warning(x <- read_landmarks(ckpt_file(c(ckpt_point(0, 5, ""), ckpt_point(1, 6, "pn")),
                                               single)), "1 points of curves",
                 class = "crestline_format_warning")
  expect_equal(x, xyz(6, 2.5, -3, name = "pn"))
})

test_that("what cannot be read or written is refused", {
  expect_refused(landmark_file("ckpt", "weights"), "not a file of Stratovan Checkpoint")
  expect_refused(ckpt_file(ckpt_point(0, 1, "a"), count = 2), "2 points are announced, 1 follow",
                 line = 9)
  expect_refused(ckpt_file("0: 0 N 0x48 1 2"), "not a point of Checkpoint", line = 11)
  expect_refused(ckpt_file(ckpt_point(0, "one", "a")), "\"one\" is not a number", line = 11)
  expect_refused(ckpt_file(ckpt_point(0, 1, "a", "Q")), "the state of a point is \"Q\"", line = 11)
  expect_crestline_error(write_landmarks(xyz(1, 2, 3, name = "a"), tempfile(fileext = ".ckpt")),
                         c("read, not written", ".pts"))
})
