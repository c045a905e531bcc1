# What a batch is to measure: ids, landmarks by id, what a result depends on.

test_that("ids of files are their names, with as many folders as tell them apart", {
  expect_identical(file_ids(c("/a/one.ply", "/b/two.obj")), c("one", "two"))
  expect_identical(file_ids(c("/v1/anna/scan.ply", "/v1/ben/scan.ply", "/v1/cleo.ply")),
                   c("anna/scan", "ben/scan", "cleo"))
  expect_identical(file_ids(c("/v1/anna/scan.ply", "/v2/anna/scan.ply")),
                   c("v1/anna/scan", "v2/anna/scan"))
  expect_identical(file_ids(c("/a/face.ply", "/a/face.obj")), c("face.ply", "face.obj"))
  expect_identical(anyDuplicated(file_ids(c("/a/x.ply", "/a/x.ply", "/b/x.ply"))), 0L)
  expect_identical(file_ids("/a/.ply"), ".ply")
})

test_that("ids of specimens are their own, unless they share one", {
  two <- batch_specimens(2)
  expect_identical(specimen_ids(two), c("ball 1", "ball 2"))
  two[[2]]$id <- "ball 1"
  expect_identical(specimen_ids(two), c("ball 1", "ball 1 1"))
  expect_identical(specimen_ids(stats::setNames(two, c("before", "after"))), c("before", "after"))
  jobs <- batch_jobs(stats::setNames(two, c("before", "after")), NULL, list())
  expect_identical(jobs$after$specimen$id, "after")
})

test_that("landmarks are told by id, in whatever they come", {
  skip_without_futures()
  three <- batch_specimens()
  dir <- batch_folder(three)
  other <- tempfile("landmarks-")
  dir.create(other)
  on.exit(unlink(c(dir, other), recursive = TRUE))
  meshes <- meshes_in(dir)
  unlink(list.files(dir, "csv$", full.names = TRUE))
  sets <- stats::setNames(lapply(three, `[[`, "landmarks"), vapply(three, `[[`, "", "id"))
  for (id in names(sets)) write_landmarks(sets[[id]], file.path(other, paste0(id, ".pts")))
  all <- file.path(other, "all.tps")
  write_landmarks(rev(sets), all)
  right <- lapply(three, fit_shape, edge_scheme(), progress = FALSE)
  sources <- list(rev(sets), rev(list.files(other, "pts$", full.names = TRUE)), all,
                  array(unlist(sets), c(4, 3, 3),
                        list(rownames(sets[[1]]), c("x", "y", "z"), names(sets))))
  for (landmarks in sources) {
    shapes <- fit_shapes(meshes, edge_scheme(), landmarks = landmarks)
    expect_identical(nrow(failures(shapes)), 0L)
    for (i in 1:3) expect_equal(coords(shapes[[i]], "curves"), coords(right[[i]], "curves"),
                                tolerance = 1e-5)
  }
  unlink(all)
  expect_identical(nrow(failures(fit_shapes(meshes, edge_scheme(), landmarks = other))), 0L)
  # One that is not among them costs itself.
  lost <- fit_shapes(meshes, edge_scheme(), landmarks = sets[c(1, 3)])
  expect_identical(failures(lost)$id, "ball 2")
  expect_match(failures(lost)$message, "no landmarks of ball 2")
  expect_identical(failures(fit_shapes(meshes, edge_scheme(),
                                       landmarks = c(list.files(other, "pts$",
                                                                full.names = TRUE)[1:2], NA)))$id,
                   "ball 3")
})

test_that("two landmark files beside a mesh that differ cost that specimen", {
  skip_without_futures()
  dir <- batch_folder()
  on.exit(unlink(dir, recursive = TRUE))
  write_landmarks(quad_corners() * 1.01, file.path(dir, "ball 2.pts"))
  failed <- failures(fit_shapes(meshes_in(dir), edge_scheme()))
  expect_identical(failed$id, "ball 2")
  expect_match(failed$message, "ball 2.csv and ball 2.pts")
})

test_that("a key is of content, scheme, settings, reading, not of names, threads, progress", {
  three <- batch_specimens()
  dir <- batch_folder(three)
  on.exit(unlink(dir, recursive = TRUE))
  mesh <- meshes_in(dir)[1]
  key <- function(job, scheme = edge_scheme(), settings = list()) {
    job_content(job, scheme, settings)$key
  }
  job <- list(id = "a", mesh = mesh, landmarks = sub("ply$", "csv", mesh))
  copy <- file.path(dir, c("copy.ply", "copy.csv"))
  file.copy(c(job$mesh, job$landmarks), copy)
  expect_identical(key(list(id = "b", mesh = copy[1], landmarks = copy[2])), key(job))
  expect_identical(key(job, settings = list(threads = 2, progress = TRUE)), key(job))
  twice <- list(settings = ridge_settings(passes = 2))
  others <- list(key(job, edge_scheme(7)), key(job, settings = twice),
                 key(c(job, list(reading = list(1)))),
                 key(c(job, list(finder = list(key = "x")))),
                 key(list(mesh = meshes_in(dir)[2], landmarks = job$landmarks)),
                 key(list(mesh = mesh, landmarks = three[[1]]$landmarks)))
  expect_identical(anyDuplicated(c(list(key(job)), others)), 0L)
  moved <- three[[1]]
  moved$landmarks["a", ] <- moved$landmarks["b", ]
  expect_false(identical(key(list(specimen = moved)), key(list(specimen = three[[1]]))))
  expect_identical(key(list(mesh = file.path(dir, "gone.ply"))), NA_character_)
})

test_that("a path that is empty, and a file that is not there, are named as such", {
  expect_crestline_error(fit_shapes(c("a.ply", ""), face_scheme()), "no path at place 2")
  absent <- file.path(tempdir(), "absent.ply")
  expect_crestline_error(check_stored(absent, "reading"), c("absent.ply", "there is no such file"))
})

test_that("a folder and a pattern stand for their meshes, landmark files are no meshes", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(2))
  on.exit(unlink(dir, recursive = TRUE))
  ids <- c("ball 1", "ball 2")
  expect_named(fit_shapes(dir, edge_scheme()), ids)
  expect_named(batch_jobs(file.path(dir, "*.ply"), NULL, list()), ids)
  expect_crestline_error(fit_shapes(list.files(dir, full.names = TRUE), edge_scheme()),
                         c("landmark files", "ball 1.csv"))
  empty <- file.path(dir, "empty")
  dir.create(empty)
  expect_crestline_error(fit_shapes(empty, edge_scheme()), "no mesh files")
})
