# Specimens of the quad's ball, each a little wider; written as PLY with their landmarks beside them.
batch_specimens <- function(n = 3) {
  lapply(seq_len(n), function(i) {
    wide <- function(mesh) {
      mesh$vb[1, ] <- (1 + i / 50) * mesh$vb[1, ]
      mesh
    }
    one <- quad_specimen(wide, quad_corners() %*% diag(c(1 + i / 50, 1, 1)))
    one$id <- paste("ball", i)
    one
  })
}

batch_folder <- function(specimens = batch_specimens()) {
  dir <- tempfile("batch-")
  dir.create(dir)
  for (one in specimens) {
    write_mesh(one, file.path(dir, paste0(one$id, ".ply")))
    write_landmarks(one, file.path(dir, paste0(one$id, ".csv")))
  }
  dir
}

meshes_in <- function(dir) list.files(dir, "[.]ply$", full.names = TRUE)

skip_without_futures <- function() {
  for (package in c("future", "progressr")) testthat::skip_if_not_installed(package)
}

same_points <- function(a, b, ...) {
  for (level in c("landmarks", "curves", "surface")) expect_equal(coords(a, level), coords(b, level), ...)
}

test_that("a batch has the shapes that fit_shape() gives, by name", {
  skip_without_futures()
  specimens <- batch_specimens()
  shapes <- fit_shapes(specimens, quad_scheme())
  expect_s3_class(shapes, "shape_batch")
  expect_named(shapes, paste("ball", 1:3))
  for (i in 1:3) same_points(shapes[[i]], fit_shape(specimens[[i]], quad_scheme(), progress = FALSE))
  expect_identical(shapes[["ball 2"]], shapes[[2]])
  expect_named(as.list(shapes[c(1, 3)]), c("ball 1", "ball 3"))
  expect_identical(nrow(failures(shapes)), 0L)
  expect_output(print(shapes), "3 specimens: 3 measured, 0 failed", fixed = TRUE)
})

test_that("arguments of fit_shape() reach it", {
  skip_without_futures()
  two <- batch_specimens(2)
  finer <- fit_shapes(two, quad_scheme(), column_angle = 0.01)
  same_points(finer[[1]], fit_shape(two[[1]], quad_scheme(), column_angle = 0.01, progress = FALSE))
})

test_that("files are read with the landmarks beside them; what goes wrong costs one specimen and is told", {
  skip_without_futures()
  dir <- batch_folder()
  on.exit(unlink(dir, recursive = TRUE))
  writeLines("ply\nformat ascii 1.0\nelement vertex", file.path(dir, "broken.ply"))
  file.copy(file.path(dir, "ball 1.ply"), file.path(dir, "off.ply"))
  write_landmarks(quad_corners() + 40, file.path(dir, "off.csv"))
  shapes <- fit_shapes(meshes_in(dir), quad_scheme())
  expect_named(shapes, c("ball 1", "ball 2", "ball 3", "broken", "off"))
  expect_null(shapes$broken)
  same_points(shapes[[2]], fit_shape(batch_specimens()[[2]], quad_scheme(), progress = FALSE), tolerance = 1e-6)
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
  same_points(first[[3]], fit_shape(batch_specimens()[[3]], quad_scheme(), progress = FALSE), tolerance = 1e-6)
  # A killed run: one result is missing, of another only a part was written. What another run has left is not deleted.
  unlink(kept()[2])
  writeLines("half", file.path(out, "part-1.tmp"))
  Sys.setFileTime(kept()[c(1, 3)], "2001-01-01")
  again <- run()
  expect_identical(format(file.mtime(kept()), "%Y") == "2001", c(TRUE, FALSE, TRUE))
  expect_identical(list.files(out, "[.]tmp$"), "part-1.tmp")
  same_points(again[[2]], first[[2]])
  # Another landmark file, then another scheme.
  write_landmarks(batch_specimens()[[1]]$landmarks + 0.1, file.path(dir, "ball 1.csv"))
  run()
  expect_identical(format(file.mtime(kept()), "%Y") == "2001", c(FALSE, FALSE, TRUE))
  run(function(tables) {
    tables$curves$n[1:2] <- 7
    tables$patches$rows <- 5
    tables$landmarks$where <- "somewhere"
    tables
  })
  expect_false(any(format(file.mtime(kept()), "%Y") == "2001"))
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
  expect_true(any(quality(shapes)$why %in% "it was not measured"))
  expect_named(Filter(Negate(is.null), lapply(shapes, function(shape) shape$id)), paste("ball", 1:3))
  sample <- homologise(shapes, tolerance = 1e-3)
  expect_identical(dim(as.array(sample, "curves"))[3], 3L)
  expect_identical(sample, homologise(Filter(Negate(is.null), as.list(shapes)), tolerance = 1e-3))
})

test_that("arguments that serve no specimen are refused", {
  skip_without_futures()
  expect_crestline_error(fit_shapes(list(), quad_scheme()), "`x`")
  expect_crestline_error(fit_shapes(list(1), quad_scheme()), c("`x`", "specimen"))
  expect_crestline_error(fit_shapes(c("a.ply", "b.ply"), quad_scheme(), landmarks = "a.csv"), c("a.csv", "no file"))
  expect_crestline_error(fit_shapes(batch_specimens(1), quad_scheme(), dir = 1), "`dir`")
  expect_crestline_error(failures(list()), "fit_shapes()")
})
