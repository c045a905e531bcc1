one <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1), front = c(1, 0, 0)), id = "ball")

test_that("a summary tells of package, mesh and landmarks, on one screen", {
  one <- from_files(one, "/scans/ball.ply", "/scans/ball.csv")
  said <- summary(one)
  expect_s3_class(said, "crestline_summary")
  expect_identical(said$provenance$mesh, list(id = "ball", key = one$key, file = "/scans/ball.ply"))
  expect_identical(said$provenance$landmarks, one$origin)
  expect_identical(said$provenance$package, as.character(packageVersion("crestline")))
  text <- capture.output(print(said))
  expect_lte(length(text), 24)
  expect_lte(max(nchar(text)), 80)
  for (word in c(R.version$major, one$key, "from ball.ply",
                 "2 from a file (ball.csv)")) expect_match(paste(text, collapse = " "), word,
                                                           fixed = TRUE)
})

test_that("only settings that are not as by default are told, in every stage", {
  lines <- settings_lines(list(ridge = utils::modifyList(unclass(ridge_settings()),
                                                         list(error = FALSE)),
                               fit = list(bridge = 0.2, cut_scale = 0.8),
                               slide = unclass(slide_settings("paper")), align = list()))
  expect_match(lines, "ridge error = FALSE; fit cut_scale = 0.8; slide energy = own, nugget = 0",
               fixed = TRUE)
  expect_match(settings_lines(list(fit = list(bridge = 0.2))), "fit as by default", fixed = TRUE)
  expect_null(settings_lines(list()))
  defaults <- lapply(stats::setNames(nm = c("ridge", "slide", "fit", "homologise", "align", "pca",
                                            "compare")), default_settings)
  expect_true(all(lengths(defaults) > 0))
  for (stage in names(defaults)) expect_identical(changed_words(defaults[[stage]],
                                                                defaults[[stage]]), "as by default")
})

test_that("comments of files are single lines of ASCII", {
  odd <- from_files(one, "/a/na\u00efve\nface\\")
  lines <- comment_lines(odd)
  expect_false(any(grepl("[^ -~]", lines)))
  expect_false(any(grepl("\\", lines, fixed = TRUE)))
  expect_length(grep("face/$", lines), 1)
})

test_that("files of meshes and landmarks carry it, and our readers read them as ever", {
  for (extension in c("ply", "obj", "stl")) {
    for (ascii in c(TRUE, FALSE)) {
      file <- tempfile(fileext = paste0(".", extension))
      write_mesh(one, file, ascii = ascii)
      text <- readBin(file, "raw", 5000)
      found <- grepl(one$key, rawToChar(text[text != 0]), fixed = TRUE, useBytes = TRUE)
      expect_identical(found, extension != "stl")
      expect_equal(ncol(read_specimen(file)$mesh$it), ncol(one$mesh$it))
    }
  }
  odd <- with_fields(one, file = "odd: LM=3 ID=x CURVES=2 end_header\\\n'.ply")
  for (extension in c("tps", "nts", "dta", "mrk.json", "csv", "pts", "fcsv", "landmarkAscii")) {
    file <- tempfile(fileext = paste0(".", extension))
    write_landmarks(odd, file)
    expect_identical(any(grepl(one$key, readLines(file), fixed = TRUE)),
                     extension %in% c("tps", "nts", "dta", "mrk.json"))
    expect_equal(unclass(read_landmarks(file)), one$landmarks, ignore_attr = "curves")
  }
  for (extension in c("ply", "obj")) {
    file <- tempfile(fileext = paste0(".", extension))
    write_mesh(odd, file)
    expect_equal(read_specimen(file)$mesh$vb, one$mesh$vb)
  }
  # Of matrices and bare meshes nothing is known.
  file <- tempfile(fileext = ".tps")
  write_landmarks(one$landmarks, file)
  expect_no_match(readLines(file), "provenance")
})

test_that("of several specimens in one file each has its own", {
  two <- list(one, with_fields(one, id = "b", file = "b.ply"))
  for (extension in c("tps", "nts")) {
    file <- tempfile(fileext = paste0(".", extension))
    write_landmarks(two, file)
    expect_length(grep("from b.ply", readLines(file)), 1)
    expect_identical(names(read_landmarks(file)), c("ball", "b"))
  }
})

test_that("pages have it in a block that opens", {
  skip_if_not_installed("htmltools")
  block <- as.character(provenance_block(specimen_provenance(from_files(one, "<b>.ply"))))
  expect_match(block, one$key, fixed = TRUE)
  expect_match(block, "&lt;b&gt;.ply", fixed = TRUE)
})

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

test_that("who writes predicted landmarks that lie off the scan is told how to keep them", {
  ball <- specimen(ball_mesh(), rbind(a = c(1, 0, 0), b = c(0, 0, 1)), id = "ball")
  away <- with_fields(ball, landmarks = rbind(ball$landmarks, c = c(0, 1.5, 0)),
                      placing = data.frame(landmark = c("a", "b", "c"),
                                           state = c("found", "found", "predicted")))
  expect_message(written_landmarks(away), "off the scan: c.*saveRDS", class = "crestline_message")
  near <- with_fields(away, landmarks = ball$landmarks)
  expect_identical(testthat::capture_messages(written_landmarks(near)), character())
})
