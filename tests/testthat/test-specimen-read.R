test_that("the id is the file's name unless given, landmarks come from a file or a matrix", {
  file <- file.path(tempdir(), "face 12.ply")
  Rvcg::vcgPlyWrite(ball_mesh(), file)
  landmarks <- rbind(top = c(0, 0, 1), gone = NA)
  csv <- tempfile(fileext = ".csv")
  write_landmarks(landmarks, csv)
  s <- read_specimen(file, csv)
  expect_equal(s$id, "face 12")
  expect_equal(rownames(s$landmarks), c("top", "gone"))
  expect_equal(read_specimen(file, landmarks, id = "b")$landmarks, s$landmarks)
  expect_equal(read_specimen(file, outward = "flip")$mesh$it[2:3, 1], s$mesh$it[3:2, 1])
})

test_that("files that are not there or of no known format are refused", {
  expect_crestline_error(read_specimen("nowhere.ply"), c("nowhere.ply", "Check the path"))
  expect_crestline_error(read_specimen(tempdir()), "is a folder")
  expect_crestline_error(read_specimen(c("a", "b")), "path of one file")
  file <- tempfile(fileext = ".xyz")
  file.create(file)
  expect_crestline_error(read_specimen(file, id = "q"), c("q", ".ply, .obj, .stl"), id = "q")
})

test_that("the real scans come in with nothing to mend", {
  for (name in c("scan_a", "template_male")) {
    s <- read_specimen(shared_data(name, "surface.ply"),
                       shared_data(name, "landmarks.csv"), id = name)
    expect_equal(setdiff(s$report$check[s$report$count > 0], "landmarks beside the surface"),
                 character())
    expect_on_mesh(s$geometry$located, s$mesh)
  }
})

test_that("new names of which none is there are named", {
  file <- tempfile(fileext = ".ply")
  Rvcg::vcgPlyWrite(Rvcg::vcgSphere(3), file)
  landmarks <- rbind(pn = c(0, 0, 1))
  expect_message(read_specimen(file, landmarks, names = c(prn = "pn")), "none named prn")
  expect_no_message(read_specimen(file, landmarks, names = c(pn = "prn")))
  expect_warning(read_specimen(file, landmarks, names = c(pn = "prn", nobody = "x")),
                 "`names` has nobody", class = "crestline_warning")
})

test_that("landmarks of a file without names take names in its order", {
  file <- tempfile(fileext = ".ply")
  tps <- tempfile(fileext = ".tps")
  on.exit(unlink(c(file, tps)))
  Rvcg::vcgPlyWrite(Rvcg::vcgSphere(3), file)
  writeLines(c("LM3=2", "0 0 1", "1 0 0"), tps)
  one <- read_specimen(file, tps, names = c("pn", "chL"))
  expect_equal(one$landmarks, rbind(pn = c(x = 0, y = 0, z = 1), chL = c(1, 0, 0)),
               tolerance = 1e-6)
  expect_crestline_error(read_specimen(file, tps, names = "pn"),
                         c("1 name without old ones, for 2 landmarks", "c(`1` = \"pn\")"))
  named <- rbind(a = c(0, 0, 1), b = c(1, 0, 0))
  expect_crestline_error(read_specimen(file, named, names = c("pn", "chL")), "c(a = \"pn\")")
})
