at <- function(k) xyz(k, 0, 0, 0, k, 0, name = c("a", "b"))
new_folder_of <- function(...) {
  dir <- tempfile("beside")
  dir.create(dir)
  files <- list(...)
  for (name in names(files)) {
    path <- file.path(dir, name)
    if (is.character(files[[name]])) writeLines(files[[name]], path) else
      write_landmarks(files[[name]], path)
  }
  dir
}
beside <- function(dir, mesh = "f.ply") basename(landmarks_beside(file.path(dir, mesh)))
several <- list(S01 = at(1), S02 = at(2), S03 = at(3))

test_that("the file beside a mesh is found in any format and any case of its extension", {
  for (name in c("f.csv", "f.CSV", "f.Pts", "f.TPS", "f.nts", "f.landmarkascii", "f.fcsv", "f.json",
                 "f.MRK.JSON", "f.pp", "f_picked_points.pp")) {
    expect_equal(beside(do.call(new_folder_of, stats::setNames(list(at(1)), name))), name)
  }
  expect_equal(beside(new_folder_of(f.PLY.csv = at(1))), "f.PLY.csv")
  expect_equal(beside(new_folder_of(f.obj.csv = at(1), f.obj = "x")), "")
  expect_equal(beside(new_folder_of(g.csv = at(1), f2.csv = at(1), f.txt = "x", f.ply = "x")), "")
})

test_that("a name that differs in case is taken where it is no other mesh's", {
  expect_equal(beside(new_folder_of(F.csv = at(1), f.ply = "x")), "F.csv")
  expect_equal(beside(new_folder_of(F.csv = at(1), f.ply = "x", F.PLY = "x")), "")
  expect_equal(beside(new_folder_of(F.csv = at(1), f.csv = at(2))), "f.csv")
})

test_that("a .json of another program is no landmark file; a damaged one is not passed over", {
  expect_equal(beside(new_folder_of(f.json = '{"camera": 1}', f.pts = at(1))), "f.pts")
  expect_equal(beside(new_folder_of(f.json = "[1, 2]")), "")
  expect_equal(beside(new_folder_of(f.json = '{"markups": [')), "f.json")
})

test_that("two files must have the same landmarks in the same places, digits of formats aside", {
  rounded <- at(100) + 4e-4
  expect_equal(beside(new_folder_of(f.csv = at(100), f.fcsv = rounded)), "f.csv")
  expect_crestline_error(beside(new_folder_of(f.csv = at(100), f.pts = at(101))),
                         c("f.ply differ: f.csv and f.pts", "`landmarks`"))
  expect_crestline_error(beside(new_folder_of(f.csv = at(1), F.x = "x",
                                              f.mrk.json = at(1)[1, , drop = FALSE])), "f.mrk.json")
  missing <- at(1)
  missing["b", ] <- NA
  expect_crestline_error(beside(new_folder_of(f.csv = at(1), f.tps = missing)), "differ")
})

test_that("landmarks of several specimens go to them by id, from whatever holds them", {
  dir <- new_folder_of(all.tps = several, all.nts = several, all.landmarkAscii = several)
  table <- data.frame(scan = rep(names(several), each = 2), landmark = c("a", "b"),
                      do.call(rbind, unname(several)))
  utils::write.csv(table, file.path(dir, "all.csv"), row.names = FALSE)
  array <- structure(unlist(several), dim = c(2, 3, 3),
                     dimnames = list(c("a", "b"), NULL, names(several)))
  file <- file.path(dir, c("all.tps", "all.nts", "all.landmarkAscii", "all.csv"))
  for (landmarks in c(as.list(file), list(file[c(1, 1)], several, array, table))) {
    found <- landmarks_for(landmarks, c("s03.ply", "S01"))
    expect_equal(names(found), c("s03.ply", "S01"))
    expect_equal(unname(vapply(found, `[`, 0, 1)), c(3, 1))
    expect_true(all(is.na(attr(found, "problem"))))
  }
  folder <- new_folder_of(S02.csv = at(2), S01.PTS = at(1), readme.txt = "x", S03.json = "{}")
  found <- landmarks_for(folder, c("S01", "S02"))
  expect_equal(basename(unlist(found)), c("S01.PTS", "S02.csv"))
  expect_equal(read_landmarks(folder)[c("S01", "S02")], list(S01 = at(1), S02 = at(2)))
})

test_that("what one specimen lacks is its own problem, with near names", {
  found <- landmarks_for(several, c("S01", "S04"))
  expect_null(found$S04)
  expect_match(attr(found, "problem")[["S04"]], "no landmarks of S04. Near names: S01, S02, S03",
               fixed = TRUE)
  expect_equal(attr(found, "problem")[["S01"]], NA_character_)
  found <- landmarks_for(new_folder_of(S01.csv = at(1), S02.csv = at(1), S02.pts = at(2)),
                         c("S01", "S02"))
  expect_match(attr(found, "problem")[["S02"]], "different landmarks of S02: S02.csv, S02.pts")
  expect_crestline_error(landmarks_for(several, c("x", "y")),
                         c("no landmarks of x, y", "S01, S02, S03"))
  expect_crestline_error(read_landmarks(new_folder_of(S02.csv = at(1), S02.pts = at(2))),
                         "S02.csv, S02.pts")
})

test_that("sets without names are never taken by position", {
  dir <- new_folder_of(no.tps = c("LM3=1", "1 2 3", "LM3=1", "4 5 6"),
                       same.tps = c("LM3=1", "1 2 3", "ID=a", "LM3=1", "4 5 6", "ID=a"))
  for (landmarks in list(file.path(dir, "no.tps"), file.path(dir, "same.tps"), unname(several),
                         unname(array(1:12, c(2, 3, 2))))) {
    expect_crestline_error(landmarks_for(landmarks, c("1", "2")),
                           c("without names of specimens", "1, 2"))
  }
  expect_equal(unname(landmarks_for(list(at(1)), "S01")[[1]]), unname(at(1)))
})

test_that("records of tpsDig go by IMAGE= where ID= only counts", {
  dir <- new_folder_of(dig.tps = c("LM3=1", "1 2 3", "IMAGE=S01.jpg", "ID=0", "LM3=1", "4 5 6",
                                   "IMAGE=S02.JPG", "ID=1"))
  expect_equal(unname(landmarks_for(file.path(dir, "dig.tps"), c("S02", "S01"))[[1]][1, ]), 4:6)
})

test_that("several files go by their names; in order, said, where these are not the specimens'", {
  dir <- new_folder_of(S01.csv = at(1), S02.csv = at(2))
  path <- file.path(dir, c("S02.csv", "S01.csv"))
  expect_equal(basename(unlist(landmarks_for(path, c("S01", "S02")))), c("S01.csv", "S02.csv"))
  expect_equal(basename(unlist(landmarks_for(c(v = path[1], u = path[2]), c("u", "v")))),
               c("S01.csv", "S02.csv"))
  expect_message(found <- landmarks_for(path, c("u", "v")),
                 "in the order of the specimens, S02.csv for u")
  expect_equal(basename(unlist(found)), c("S02.csv", "S01.csv"))
  expect_crestline_error(landmarks_for(c("lm_S02.csv", "lm_S01.csv"), c("S01", "S02")),
                         "lm_S02.csv in the place of S01")
})

test_that("read_specimen() takes its own landmarks of several", {
  dir <- new_folder_of(all.tps = several, S02.csv = at(1))
  mesh <- file.path(dir, "S02.ply")
  ball <- ball_mesh(3)
  ball$vb[1:3, ] <- 2 * ball$vb[1:3, ]
  Rvcg::vcgPlyWrite(ball, mesh)
  table <- data.frame(id = rep(names(several), each = 2), landmark = c("a", "b"),
                      do.call(rbind, unname(several)))
  for (landmarks in list(file.path(dir, "all.tps"), several, table)) {
    expect_equal(read_specimen(mesh, landmarks)$landmarks, at(2), tolerance = 1e-6)
  }
  expect_crestline_error(read_specimen(mesh, file.path(dir, "all.tps"), id = "S9"),
                         c("no landmarks of S9", "S01, S02, S03"))
})

test_that("what is no source of landmarks is refused", {
  for (landmarks in list(3, character(), NULL,
                         mean)) expect_crestline_error(landmarks_for(landmarks, "a"), "`landmarks`")
  expect_crestline_error(landmarks_for(new_folder_of(a.txt = "x"), "a"),
                         c("has no landmark files", ".csv"))
  expect_crestline_error(landmarks_for(list(a = at(1), at(2)), c("a", "b")), "have no name")
})

test_that("an ID= that is there twice is named where specimens cannot be told apart", {
  tps <- landmark_file("tps", rep(c("LM3=1", "1 2 3", "ID=S1"), 2))
  expect_crestline_error(landmarks_for(tps, c("S1", "S2")), "ID=S1 is there twice")
})

test_that("the one set of a file that names another specimen is taken with a message", {
  one <- function(...) landmark_file("tps", c("LM3=1", "1 2 3", ...))
  bert <- one("ID=bert", "IMAGE=scan_7.jpg")
  expect_message(found <- landmarks_for(bert, "anna"), "has landmarks of bert.* taken for anna")
  expect_equal(unname(found$anna[1, ]), 1:3)
  expect_silent(landmarks_for(bert, "bert"))
  expect_silent(landmarks_for(bert, "scan_7"))
  # A number counts, and names nobody; nor does a file without a name.
  expect_silent(landmarks_for(one("ID=1"), "anna"))
  expect_silent(landmarks_for(one(), "anna"))
  dir <- new_folder_of(anna.tps = c("LM3=1", "1 2 3", "ID=bert"))
  on.exit(unlink(dir, recursive = TRUE))
  expect_silent(landmarks_for(file.path(dir, "anna.tps"), "anna"))
})
