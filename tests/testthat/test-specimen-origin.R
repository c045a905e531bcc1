ball <- function(...) specimen(Rvcg::vcgSphere(3),
                               rbind(top = c(0, 0, 1), front = c(1, 0, 0),
                                     gone = c(NA, NA, NA)), id = "ball", ...)

how_of <- function(x) stats::setNames(origin_of(x)$how, origin_of(x)$landmark)

test_that("landmarks that are given are recorded as given, missing ones as nothing", {
  one <- ball()
  expect_identical(names(one$origin), c("landmark", "how", "file", "time"))
  expect_identical(how_of(one), c(top = "given", front = "given", gone = NA))
  expect_true(is.na(one$file))
  expect_equal(nrow(specimen(Rvcg::vcgSphere(2))$origin), 0)
})

test_that("files of mesh and landmarks are recorded", {
  mesh <- tempfile(fileext = ".ply")
  points <- tempfile(fileext = ".csv")
  write_mesh(Rvcg::vcgSphere(3), mesh)
  write_landmarks(ball(), points)
  read <- read_specimen(mesh, points)
  expect_identical(read$file, mesh)
  expect_identical(read$origin$how, c("file", "file", NA))
  expect_identical(read$origin$file, c(points, points, NA))
  given <- read_specimen(mesh, ball()$landmarks)
  expect_identical(given$origin$how, c("given", "given", NA))
  expect_identical(given$file, mesh)
})

test_that("what is changed by hand is recorded with its time, the rest stays as it was", {
  before <- time_stamp()
  one <- ball()
  one$landmarks["top", ] <- c(0, 0.6, 0.8)
  one$landmarks["gone", ] <- c(0, 1, 0)
  expect_identical(how_of(one), c(top = "moved", front = "given", gone = "placed"))
  expect_true(all(one$origin$time[c(1, 3)] >= before & one$origin$time[c(1, 3)] <= time_stamp()))
  expect_true(is.na(one$origin$time[2]))
  stamped <- one$origin
  one$landmarks <- one$landmarks[c("gone", "top"), ]
  expect_identical(one$origin[order(one$origin$landmark), ], stamped[c(3, 1), ], ignore_attr = TRUE)
  one$landmarks["top", ] <- NA
  expect_identical(how_of(one), c(gone = "placed", top = NA))
  one$landmarks["top", ] <- c(0, 0.6, 0.8)
  expect_identical(how_of(one)[["top"]], "placed")
  bare <- specimen(Rvcg::vcgSphere(3))
  bare$landmarks <- rbind(a = c(0, 0, 1))
  expect_identical(how_of(bare), c(a = "given"))
})

test_that("a landmark set to where it is was not moved", {
  one <- ball()
  one$landmarks["top", ] <- one$landmarks["top", ]
  expect_identical(how_of(one)[["top"]], "given")
})

test_that("moving, placing and defining by the package's own functions is recorded", {
  one <- move_landmark(ball(), "top", surface_points(ball()$mesh, cbind(0, 0.6, 0.8)))
  expect_identical(how_of(one)[["top"]], "moved")
  expect_false(is.na(one$origin$time[1]))
  confirmed <- move_landmark(ball(), "front",
                             surface_points(ball()$mesh, ball()$landmarks["front", , drop = FALSE]))
  expect_identical(how_of(confirmed)[["front"]], "placed")
  expect_identical(how_of(move_landmark(ball(), "gone",
                                        surface_points(ball()$mesh,
                                                       cbind(0, 1, 0))))[["gone"]], "placed")
  expect_identical(how_of(move_landmark(ball(), "top", NULL))[["top"]], NA_character_)
  expect_identical(how_of(with_origin(ball(), "front", "defined")),
                   c(top = "given", front = "defined", gone = NA))
})

test_that("a specimen of an older version has its landmarks given", {
  old <- with_fields(ball(), origin = NULL)
  expect_identical(how_of(old), c(top = "given", front = "given", gone = NA))
  old$landmarks["top", ] <- c(0, 0.6, 0.8)
  expect_identical(how_of(old), c(top = "moved", front = "given", gone = NA))
})

test_that("the record is told in words", {
  one <- ball()
  expect_identical(origin_words(one$origin), "2 given")
  one <- from_files(one, "a/face.ply", "a/face.csv")
  one$landmarks["top", ] <- c(0, 0.6, 0.8)
  expect_identical(sub("; .*Z", "; then", origin_words(one$origin)),
                   "1 from a file (face.csv), 1 moved by hand (top; then)")
  expect_identical(origin_words(specimen(Rvcg::vcgSphere(2))$origin), "none")
})
