test_that("the format goes by the extension, in any case; others are refused by name", {
  x <- xyz(1, 2, 3, name = "a")
  for (extension in c("csv", "PTS", "tps", "nts", "DTA", "landmarkAscii", "landmarkascii", "fcsv",
                      "mrk.json", "json")) {
    expect_round_trip(x, extension)
    expect_round_trip(x[0, , drop = FALSE], extension)
  }
  expect_crestline_error(write_landmarks(x, "a.unknown"),
                         c("a.unknown", "Known: .csv, .pts", ".mrk.json"))
  expect_crestline_error(write_landmarks(x, 5), "path of one file")
  expect_crestline_error(read_landmarks(c("a.pts", "b.pts")), "path of one file")
  expect_crestline_error(write_landmarks(1:3, "a.csv"), "k x 3")
  expect_crestline_error(write_landmarks(x, "/none/at/all.pts"), c("all.pts", "cannot be written"))
})

test_that("lines may end as on any system, the last without an end", {
  for (eol in c("\n", "\r\n", "\r")) {
    file <- landmark_file("pts", "Version 1.0", "2", "S000 1 2 3", "S001 4 5 6", eol = eol)
    expect_equal(read_landmarks(file), xyz(1, 2, 3, 4, 5, 6, name = c("S000", "S001")))
  }
  file <- landmark_file("tps", "LM3=1\n1 2 3", eol = "")
  expect_equal(read_landmarks(file), xyz(1, 2, 3, name = "1"))
})

test_that("several specimens are a named list where the format holds them", {
  x <- list("face 1" = hard_landmarks(), b = hard_landmarks() * 2)
  for (extension in c("tps", "nts", "dta", "landmarkAscii")) expect_round_trip(x, extension)
  for (extension in c("csv", "pts", "fcsv", "mrk.json")) {
    expect_crestline_error(write_landmarks(x, paste0("a.", extension)),
                           c("a.", "one specimen, not 2", ".tps"))
  }
  s <- list(specimen(ball_mesh(), rbind(top = c(0, 0, 1)), id = "s1"),
            specimen(ball_mesh(), rbind(top = c(0, 1, 0)), id = "s2"))
  file <- tempfile(fileext = ".nts")
  write_landmarks(s, file)
  expect_identical(read_landmarks(file), list(s1 = s[[1]]$landmarks, s2 = s[[2]]$landmarks))
  expect_crestline_error(write_landmarks(list(), file), "must be one")
  expect_crestline_error(write_landmarks(unname(x)[c(1, 1)], file, curves = hard_curves()),
                         "attribute `curves`")
  expect_crestline_error(write_landmarks(stats::setNames(x, c("a", "a")), file),
                         "two specimens have the same")
  expect_crestline_error(write_landmarks(stats::setNames(x, c("a", "b ")), file),
                         "no blanks at the ends")
})

test_that("curves come from the argument or attribute; where they have no place: refused", {
  x <- structure(xyz(1, 2, 3, name = "a"), curves = hard_curves())
  for (extension in c("nts", "dta", "landmarkAscii", "fcsv")) {
    expect_crestline_error(write_landmarks(x, paste0("a.", extension)),
                           c("no curves", ".mrk.json", "curves = list()"))
    file <- tempfile(fileext = paste0(".", extension))
    write_landmarks(x, file, curves = list())
    expect_identical(read_landmarks(file), xyz(1, 2, 3, name = "a"))
  }
  file <- tempfile(fileext = ".csv")
  write_landmarks(NULL, file, curves = list(line = data.frame(s = 0, x = 1, y = 2, z = 3)))
  expect_equal(attr(read_landmarks(file), "curves"),
               list(line = structure(xyz(1, 2, 3), closed = FALSE)))
  expect_crestline_error(write_landmarks(x, file, curves = list(xyz(1, 2, 3))), "a name of its own")
  expect_crestline_error(write_landmarks(x, file, curves = list(a = 1:3)), "curve a is 1, 2, 3")
  expect_crestline_error(write_landmarks(x, file, curves = list(a = matrix(0, 0, 3))),
                         "a row at least")
  expect_crestline_error(write_landmarks(x, file, curves = list("a\nb" = xyz(1, 2, 3))),
                         "line break")
})

test_that("curves of ridge_curve() are written point by point", {
  curve <- structure(list(points = data.frame(point = 1:2, x = c(1, 2), y = 3:4, z = 5:6)),
                     class = "curve")
  file <- tempfile(fileext = ".tps")
  write_landmarks(NULL, file, curves = list(lip = curve))
  expect_equal(attr(read_landmarks(file), "curves")$lip,
               structure(xyz(1, 3, 5, 2, 4, 6), closed = FALSE))
})

test_that("random numbers are written with digits that give them back", {
  x <- with_seed(3,
                 c(rnorm(1e4) * 10^runif(1e4, -300, 300), runif(1e4, -300, 300),
                   .Machine$double.xmin, .Machine$double.xmax))
  expect_identical(as.numeric(number_text(x)), x)
  expect_identical(number_text(c(1.5, -2, NA)), c("1.5", "-2", "NA"))
})

test_that("an array, a sample's list or an alignment is written specimen by specimen, by name", {
  x <- array(with_seed(2, rnorm(60)), c(5, 3, 4),
             list(letters[1:5], c("x", "y", "z"), paste0("s", 1:4)))
  for (extension in c("tps", "nts", "landmarkAscii")) {
    file <- tempfile(fileext = paste0(".", extension))
    write_landmarks(x, file)
    expect_identical(read_landmarks(file), lapply(stats::setNames(nm = paste0("s", 1:4)),
                                                  function(id) x[, , id]))
    write_landmarks(unname(x), file)
    expect_identical(names(read_landmarks(file)), as.character(1:4))
  }
  file <- tempfile(fileext = ".tps")
  write_landmarks(align(x), file)
  expect_identical(read_landmarks(file)$s2, align(x)$coords[, , "s2"])
  expect_crestline_error(write_landmarks(x, tempfile(fileext = ".csv")), "one specimen, not 4")
  expect_crestline_error(write_landmarks(list(a = x[, , 1], b = NULL), file), "nothing of b")
})

test_that("pipes, devices, empty and compressed files are refused at once", {
  skip_on_os("windows")
  dir <- tempfile("odd")
  dir.create(dir)
  path <- function(name) file.path(dir, name)
  skip_if(system2("mkfifo", c(path("pipe.csv"), path("pipe.json"), path("pipe.ply"))) != 0)
  file.symlink("/dev/zero", path("zero.tps"))
  file.create(path("empty.csv"))
  time <- system.time({
    for (name in c("pipe.csv", "pipe.json", "zero.tps", "empty.csv")) {
      expect_crestline_error(read_landmarks(path(name)), c(name, "pipe or device"))
    }
    expect_crestline_error(read_specimen(path("pipe.ply")), c("pipe.ply", "pipe or device"),
                           id = "pipe")
    expect_crestline_error(read_landmarks(landmarks_beside(path("pipe.ply"))), "pipe")
  })
  expect_lt(time[["elapsed"]], 5)
  expect_crestline_error(write_landmarks(xyz(1, 2, 3, name = "a"), path("pipe.csv")), "is a pipe")
  expect_crestline_error(write_mesh(ball_mesh(), path("pipe.ply")), "it is a pipe")
  write_landmarks(xyz(1, 2, 3, name = "a"), path("empty.csv"))
  expect_equal(read_landmarks(path("empty.csv")), xyz(1, 2, 3, name = "a"))
  for (packer in list(gzfile, bzfile, xzfile)) {
    to <- packer(path("packed.csv"), "wb")
    writeLines(c("name,x,y,z", "n,1,2,3"), to)
    close(to)
    expect_crestline_error(read_landmarks(path("packed.csv")), c("compressed by", "Unpack it"))
  }
  skip_if(!file.exists("/dev/full"))
  file.symlink("/dev/full", path("full.csv"))
  expect_crestline_error(write_landmarks(xyz(1, 2, 3, name = "a"), path("full.csv")),
                         "was not written whole")
})

test_that("a session with decimal commas and few digits writes the same files", {
  x <- structure(hard_landmarks(), curves = hard_curves())
  written <- function() {
    lapply(c("csv", "tps", "mrk.json", "nts", "landmarkAscii", "fcsv", "pp"), function(extension) {
      file <- tempfile(fileext = paste0(".", extension))
      write_landmarks(if (extension %in% c("csv", "tps", "mrk.json")) x else hard_landmarks(), file)
      readLines(file)
    })
  }
  usual <- written()
  rlang::local_options(OutDec = ",", digits = 3, scipen = -9)
  expect_identical(written(), usual)
})

test_that("what is not read says what reads it, or what to give", {
  text <- tempfile(fileext = ".txt")
  on.exit(unlink(text))
  writeLines("[individuals]", text)
  expect_crestline_error(read_landmarks(text), "geomorph::read.morphologika()")
  expect_crestline_error(specimen(ball_mesh(), array(0, c(4, 3, 1))),
                         c("4 x 3 x 1", "landmarks[, , 1]"))
  words <- data.frame(V1 = "a", x = "1", y = "0", z = "0")
  expect_crestline_error(specimen(ball_mesh(), words), "The co-ordinates are text")
  file <- file.path(tempfile("none"), "x.csv")
  expect_crestline_error(write_landmarks(rbind(a = 1:3), file),
                         c(file, paste("There is no folder", dirname(file))))
})
