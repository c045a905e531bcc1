# Many specimens by one scheme: what is kept, what is told, what a fault costs.

test_that("a batch has the shapes that fit_shape() gives, by name", {
  skip_without_futures()
  specimens <- batch_specimens()
  shapes <- fit_shapes(specimens, quad_scheme())
  expect_s3_class(shapes, "shape_batch")
  expect_named(shapes, paste("ball", 1:3))
  for (i in 1:3) same_points(shapes[[i]],
                             fit_shape(specimens[[i]], quad_scheme(), progress = FALSE))
  expect_identical(shapes[["ball 2"]], shapes[[2]])
  expect_named(as.list(shapes[c(1, 3)]), c("ball 1", "ball 3"))
  expect_identical(nrow(failures(shapes)), 0L)
  expect_output(print(shapes), "3 specimens: 3 measured, 0 failed", fixed = TRUE)
})

test_that("arguments of fit_shape() reach it", {
  skip_without_futures()
  two <- batch_specimens(2)
  finer <- fit_shapes(two, quad_scheme(), measuring = shape_settings(column_angle = 0.01))
  same_points(finer[[1]], fit_shape(two[[1]], quad_scheme(), progress = FALSE,
                                    measuring = shape_settings(column_angle = 0.01)))
})

test_that("files are read with the landmarks beside them; what goes wrong costs one specimen", {
  skip_without_futures()
  dir <- batch_folder()
  on.exit(unlink(dir, recursive = TRUE))
  writeLines("ply\nformat ascii 1.0\nelement vertex", file.path(dir, "broken.ply"))
  file.copy(file.path(dir, "ball 1.ply"), file.path(dir, "off.ply"))
  write_landmarks(quad_corners() + 40, file.path(dir, "off.csv"))
  shapes <- fit_shapes(meshes_in(dir), quad_scheme())
  expect_named(shapes, c("ball 1", "ball 2", "ball 3", "broken", "off"))
  expect_null(shapes$broken)
  same_points(shapes[[2]], fit_shape(batch_specimens()[[2]], quad_scheme(), progress = FALSE),
              tolerance = 1e-6)
  failed <- failures(shapes)
  expect_identical(failed$id, c("broken", "off"))
  expect_identical(failed$stage, c("reading", "landmarks"))
  expect_match(failed$message[1], "broken.ply cannot be read", fixed = TRUE)
  expect_true(all(nzchar(failed$remedy)))
  expect_output(print(shapes), "3 measured, 2 failed", fixed = TRUE)
})

test_that("results are kept as they come, and measured again only when something has changed", {
  skip_without_futures()
  dir <- batch_folder()
  out <- file.path(dir, "out")
  on.exit(unlink(dir, recursive = TRUE))
  run <- function(...) fit_shapes(meshes_in(dir), quad_scheme(...), out)
  kept <- function() file.path(out, paste0("ball ", 1:3, ".shape"))
  first <- run()
  expect_true(all(file.exists(kept())))
  expect_identical(lengths(unclass(first), use.names = FALSE), c(0L, 0L, 0L))
  same_points(first[[3]], fit_shape(batch_specimens()[[3]], quad_scheme(), progress = FALSE),
              tolerance = 1e-6)
  # A killed run: one result is missing, of another only a part was written. What another run has
  # left is not deleted.
  unlink(kept()[2])
  writeLines("half", file.path(out, "part-1.tmp"))
  Sys.setFileTime(kept()[c(1, 3)], "2001-01-01")
  again <- run()
  expect_identical(format(file.mtime(kept()), "%Y") == "2001", c(TRUE, FALSE, TRUE))
  expect_identical(list.files(out, "[.]tmp$"), "part-1.tmp")
  same_points(again[[2]], first[[2]])
  # Another landmark file, then another scheme.
  write_landmarks(batch_specimens()[[1]]$landmarks + 0.1, file.path(dir, "ball 1.csv"))
  expect_message(run(), "1 result .* replaced, of ball 1", class = "crestline_message")
  expect_identical(format(file.mtime(kept()), "%Y") == "2001", c(FALSE, FALSE, TRUE))
  expect_message(run(function(tables) {
    tables$curves$n[1:2] <- 7
    tables$patches$rows <- 5
    tables$landmarks$where <- "somewhere"
    tables
  }), "3 results .* measured in another way: kept", class = "crestline_message")
  # Results of another scheme stand beside those that are there.
  expect_identical(format(file.mtime(kept()), "%Y") == "2001", c(FALSE, FALSE, TRUE))
  expect_length(list.files(out, "[.]shape$"), 6)
  # A file that is not ours is left alone; one that is cut short is told, and measured again.
  writeLines("rubbish", kept()[3])
  last <- run()
  expect_s3_class(last[[3]], "shape")
  expect_identical(readLines(kept()[3]), "rubbish")
  writeBin(readBin(kept()[2], raw(), 1000), kept()[2])
  expect_identical(failures(last)[c("id", "stage")], data.frame(id = "ball 2", stage = "keeping"))
  expect_identical(nrow(failures(run())), 0L)
  same_points(last[[2]], first[[2]])
})

test_that("workers give what one process gives", {
  skip_without_futures()
  testthat::skip_on_cran()
  old <- future::plan("multisession", workers = 2)
  on.exit(future::plan(old))
  specimens <- batch_specimens(4)
  parallel <- fit_shapes(specimens, quad_scheme())
  future::plan("sequential")
  alone <- fit_shapes(specimens, quad_scheme())
  for (i in 1:4) same_points(parallel[[i]], alone[[i]])
})

test_that("a batch goes into quality(), homologise() and lapply()", {
  skip_without_futures()
  dir <- batch_folder()
  on.exit(unlink(dir, recursive = TRUE))
  writeLines("no mesh", file.path(dir, "broken.ply"))
  shapes <- fit_shapes(meshes_in(dir), quad_scheme(), file.path(dir, "out"))
  expect_identical(unique(quality(shapes)$specimen), names(shapes))
  expect_true(any(grepl("^it was not measured: .*broken", quality(shapes)$why)))
  expect_named(Filter(Negate(is.null), lapply(shapes, function(shape) shape$id)),
               paste("ball", 1:3))
  sample <- homologise(shapes, tolerance = 1e-3)
  expect_identical(dim(as.array(sample, "curves"))[3], 3L)
  expect_identical(sample, homologise(Filter(Negate(is.null), as.list(shapes)), tolerance = 1e-3))
})

test_that("arguments that serve no specimen are refused", {
  skip_without_futures()
  expect_crestline_error(fit_shapes(list(), quad_scheme()), "`x`")
  expect_crestline_error(fit_shapes(list(1), quad_scheme()), c("`x`", "specimen"))
  expect_crestline_error(fit_shapes(c("a.ply", "b.ply"), quad_scheme(), landmarks = "a.csv"),
                         c("a.csv", "no file"))
  expect_crestline_error(fit_shapes(batch_specimens(1), quad_scheme(), dir = 1), "`dir`")
  expect_crestline_error(failures(list()), "fit_shapes()")
})

test_that("a renamed scan is not measured again; two of one name never answer for each other", {
  skip_without_futures()
  dir <- batch_folder()
  out <- file.path(dir, "out")
  on.exit(unlink(dir, recursive = TRUE))
  all <- fit_shapes(meshes_in(dir), edge_scheme(), out)
  Sys.setFileTime(list.files(out, full.names = TRUE), "2001-01-01")
  # The second scan under the first one's name, and the first under a new one.
  for (end in c(".ply", ".csv")) {
    file.rename(file.path(dir, paste0("ball 1", end)), file.path(dir, paste0("anna", end)))
    file.rename(file.path(dir, paste0("ball 2", end)), file.path(dir, paste0("ball 1", end)))
  }
  renamed <- fit_shapes(meshes_in(dir), edge_scheme(), out)
  expect_named(renamed, c("anna", "ball 1", "ball 3"))
  results <- list.files(out, "shape$", full.names = TRUE)
  expect_identical(format(file.mtime(results), "%Y"), rep("2001", 3))
  expect_identical(coords(renamed$anna, "curves"), coords(all[["ball 1"]], "curves"))
  expect_identical(coords(renamed[["ball 1"]], "curves"), coords(all[["ball 2"]], "curves"))
  expect_identical(vapply(as.list(renamed), `[[`, "", "id"), stats::setNames(nm = names(renamed)))
  expect_identical(renamed$anna$specimen$id, "anna")
  # Another scan in the place of one whose result is of use still: both are kept.
  file.copy(file.path(dir, "ball 3.ply"), file.path(dir, "anna.ply"), overwrite = TRUE)
  file.copy(file.path(dir, "ball 3.csv"), file.path(dir, "anna.csv"), overwrite = TRUE)
  unlink(file.path(dir, "ball 3.ply"))
  write_landmarks(quad_corners() %*% diag(c(1.06, 1, 1)) |> `rownames<-`(letters[1:4]),
                  file.path(dir, "anna.csv"))
  again <- fit_shapes(meshes_in(dir), edge_scheme(), out)
  expect_equal(coords(again$anna, "curves"), coords(all[["ball 3"]], "curves"), tolerance = 1e-6)
  expect_identical(nrow(failures(all)), 0L)
})

test_that("a folder that two runs share has the results of both, each for its own", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  two <- batch_specimens(2)
  two[[2]]$id <- two[[1]]$id
  first <- fit_shapes(two[1], edge_scheme(), out)
  second <- fit_shapes(two[2], edge_scheme(), out)
  expect_length(list.files(out, "shape$"), 2)
  expect_false(identical(coords(first[[1]], "curves"), coords(second[[1]], "curves")))
  expect_equal(coords(first[[1]], "curves"),
               coords(fit_shape(two[[1]], edge_scheme(), progress = FALSE), "curves"))
  # Had the other one taken its file, it would be told.
  files <- list.files(out, "shape$", full.names = TRUE)
  file.copy(files[grepl("-", basename(files))], files[!grepl("-", basename(files))],
            overwrite = TRUE)
  expect_match(failures(first)$message, "another result")
  expect_warning(expect_null(first[[1]]), "another result", class = "crestline_keeping_warning")
})

test_that("what reading, finding and fitting warn of is kept and told", {
  skip_without_futures()
  landmarks <- paired_corners()
  mirrored <- landmarks
  rownames(mirrored) <- chartr("LR", "RL", rownames(landmarks))
  rownames(mirrored)[5:6] <- rownames(landmarks)[5:6]
  dir <- tempfile("batch-")
  dir.create(dir)
  on.exit(unlink(dir, recursive = TRUE))
  for (id in c("left", "right")) write_mesh(stretched_ball(), file.path(dir, paste0(id, ".ply")))
  write_landmarks(landmarks, file.path(dir, "left.csv"))
  write_landmarks(mirrored, file.path(dir, "right.csv"))
  for (out in list(NULL, file.path(dir, "out"))) {
    for (round in 1:2) {
      told <- character()
      shapes <- withCallingHandlers(
        fit_shapes(meshes_in(dir), paired_scheme(), out, settings = ridge_settings(error = FALSE),
                   reading = list(midline = c("high", "low"))),
        warning = function(w) told <<- c(told, conditionMessage(w))
      )
      expect_length(told, 0)
      expect_true("crestline_mirrored" %in% warnings_of(shapes)$class)
      expect_identical(unique(warnings_of(shapes)$id), "right")
      expect_identical(attr(failures(shapes), "warnings"), warnings_of(shapes))
      expect_output(print(shapes), "1 specimen: left and right look mirrored.*In: right")
      expect_identical(summary(shapes)$warnings > 0, c(FALSE, TRUE))
    }
  }
  expect_identical(shapes$right$warnings, warnings_of(shapes)[-1])
  graded <- quality(shapes)
  expect_match(graded$why[graded$level == "specimen"], "mirrored")
  expect_identical(graded$specimen[graded$level == "specimen"], "right")
})

test_that("arguments of reading reach it, and strange ones are refused at once", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(1))
  on.exit(unlink(dir, recursive = TRUE))
  mesh <- meshes_in(dir)
  off <- 1.05 * batch_specimens(1)[[1]]$landmarks
  write_landmarks(off, file.path(dir, "ball 1.csv"))
  expect_identical(failures(fit_shapes(mesh, edge_scheme()))$stage, "landmarks")
  expect_identical(nrow(failures(fit_shapes(mesh, edge_scheme(),
                                            reading = list(tolerance = 0.05)))), 0L)
  unlink(file.path(dir, "ball 1.csv"))
  write_landmarks(batch_specimens(1)[[1]]$landmarks, file.path(dir, "ball 1.mrk.json"),
                  frame = "RAS")
  at <- lapply(c("RAS", "LPS"), function(frame) {
    coords(fit_shapes(mesh, edge_scheme(), reading = list(frame = frame))[[1]], "landmarks")
  })
  expect_equal(at[[1]], batch_specimens(1)[[1]]$landmarks, tolerance = 1e-6)
  expect_equal(at[[2]][, "x"], -at[[1]][, "x"], tolerance = 1e-6)
  expect_crestline_error(fit_shapes(mesh, edge_scheme(), frame = "RAS"),
                         c("frame", "reading = list(frame"))
  expect_crestline_error(fit_shapes(mesh, edge_scheme(), no_such = 1), c("no_such", "measuring"))
  expect_crestline_error(fit_shapes(mesh, edge_scheme(), reading = list(no_such = 1)), "no_such")
  expect_crestline_error(fit_shapes(mesh, edge_scheme(), reading = "RAS"), "`reading`")
  expect_crestline_error(fit_shapes(batch_specimens(1), edge_scheme(),
                                    reading = list(frame = "RAS")), "mesh files")
})

test_that("a result that cannot be written costs one specimen", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  three <- batch_specimens()
  # Folders stand where the second result could go.
  content <- job_content(batch_jobs(three, NULL, list())[[2]], edge_scheme(), list())
  mesh <- paste0("-", substr(content$mesh, 1, 8))
  ends <- c("", mesh, paste0(mesh, "-", substr(content$setting, 1, 8)))
  ends <- c(ends, paste0(ends[3], "-", substr(content$key, 1, 8)))
  taken <- file.path(out, paste0("ball 2", ends, ".shape"))
  for (folder in taken) dir.create(folder, recursive = TRUE)
  shapes <- fit_shapes(three, edge_scheme(), out)
  expect_identical(failures(shapes)[c("id", "stage")], data.frame(id = "ball 2", stage = "keeping"))
  expect_match(failures(shapes)$message, "cannot be written")
  expect_setequal(list.files(out, "shape$"), c("ball 1.shape", "ball 3.shape", basename(taken)))
  unlink(taken[2], recursive = TRUE)
  expect_identical(nrow(failures(fit_shapes(three, edge_scheme(), out))), 0L)
})

test_that("a folder without the right to write costs no measuring", {
  skip_without_futures()
  skip_on_os("windows")
  skip_if(identical(Sys.info()[["effective_user"]], "root"), "root may write anywhere")
  out <- tempfile("out-")
  dir.create(out, mode = "0555")
  on.exit(unlink(out, recursive = TRUE))
  shapes <- fit_shapes(batch_specimens(2), edge_scheme(), out)
  expect_identical(failures(shapes)$stage, c("keeping", "keeping"))
})

test_that("reading takes other names and another unit", {
  skip_without_futures()
  three <- lapply(batch_specimens(), function(one) {
    at <- one$landmarks
    rownames(at) <- toupper(rownames(at))
    specimen(one$mesh, at, id = one$id)
  })
  dir <- batch_folder(three)
  on.exit(unlink(dir, recursive = TRUE))
  renamed <- stats::setNames(rownames(batch_specimens()[[1]]$landmarks),
                             rownames(three[[1]]$landmarks))
  shapes <- fit_shapes(meshes_in(dir), edge_scheme(), reading = list(names = renamed, unit = 2))
  expect_identical(nrow(failures(shapes)), 0L)
  expect_true(all(shapes[[1]]$status$ok))
  expect_identical(shapes[[1]]$provenance$scheme$unit, 2)
  expect_crestline_error(fit_shapes(meshes_in(dir), edge_scheme(), unit = 1,
                                    reading = list(unit = 2)), "differ")
  expect_crestline_error(fit_shapes(meshes_in(dir), edge_scheme(), reading = list(unit = -1)),
                         "unit")
})

test_that("a scan in another unit is brought to that of the others as it is read", {
  skip_without_futures()
  two <- batch_specimens(2)
  dir <- batch_folder(two)
  on.exit(unlink(dir, recursive = TRUE))
  metres <- specimen(two[[2]]$mesh, two[[2]]$landmarks, id = "ball 2", rescale = 1e-3)
  write_mesh(metres, file.path(dir, "ball 2.ply"))
  write_landmarks(metres, file.path(dir, "ball 2.csv"))
  scheme <- edge_scheme()
  read <- list(rescale = c("ball 2" = 1000))
  mended <- fit_shapes(meshes_in(dir), scheme, reading = read)
  alike <- fit_shapes(two, scheme)
  for (i in 1:2) same_points(mended[[i]], alike[[i]], tolerance = 1e-5)
  expect_crestline_error(fit_shapes(meshes_in(dir), scheme, reading = list(rescale = c(bal = 2))),
                         c("bal", "ball 1"))
  expect_crestline_error(fit_shapes(meshes_in(dir), scheme, reading = list(rescale = -1)),
                         "rescale")
  # Measured in its own unit it is no part of the sample.
  own <- fit_shapes(meshes_in(dir)[2], scheme, unit = 1000)
  expect_warning(mixed <- c(alike[1], own), "unit", class = "crestline_unit_warning")
  error <- expect_crestline_error(homologise(mixed), c("rescale = 1000", "ball 2"))
  expect_s3_class(error, "crestline_unit_error")
})

test_that("a specimen that was measured later takes the place of its failure", {
  skip_without_futures()
  two <- batch_specimens(2)
  bare <- two
  bare[[2]]$landmarks <- bare[[2]]$landmarks[0, , drop = FALSE]
  first <- fit_shapes(bare, edge_scheme())
  expect_identical(failures(first)$id, two[[2]]$id)
  both <- c(first, fit_shapes(two[2], edge_scheme()))
  expect_named(both, c(two[[1]]$id, two[[2]]$id))
  expect_identical(nrow(failures(both)), 0L)
  expect_crestline_error(c(both, both), "twice")
})
