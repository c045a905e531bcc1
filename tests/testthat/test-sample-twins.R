# One scan twice is told by name.

test_that("one scan under two ids is told, with the same landmarks as a warning", {
  skip_without_futures()
  two <- batch_specimens(2)
  dir <- batch_folder(two)
  on.exit(unlink(dir, recursive = TRUE))
  for (end in c(".ply", ".csv")) {
    file.copy(file.path(dir, paste0("ball 1", end)), file.path(dir, paste0("copy", end)))
  }
  run <- function(...) fit_shapes(meshes_in(dir), edge_scheme(), ...)
  expect_warning(shapes <- run(), "ball 1 and copy", class = "crestline_twin")
  expect_named(shapes, c("ball 1", "ball 2", "copy"))
  out <- file.path(dir, "out")
  for (i in 1:2) expect_warning(run(dir = out), "ball 1 and copy", class = "crestline_twin")
  expect_warning(tell_twins(as.list(shapes), "homologise"), "ball 1 and copy")
  expect_no_warning(tell_twins(shapes[1:2], "homologise"))
  # Placed a second time
  write_landmarks(two[[1]]$landmarks + 0.1, file.path(dir, "copy.csv"))
  expect_no_warning(expect_message(run(), "with other landmarks: ball 1 and copy"))
})

test_that("a file is named once, unless it has other landmarks each time", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(2))
  on.exit(unlink(dir, recursive = TRUE))
  twice <- meshes_in(dir)[c(1, 2, 1)]
  expect_crestline_error(fit_shapes(twice, edge_scheme()), c("twice", "ball 1.ply"))
  marks <- file.path(dir, c("ball 1.csv", "ball 2.csv", "again.csv"))
  expect_crestline_error(fit_shapes(twice, edge_scheme(), landmarks = marks[c(1, 2, 1)]), "twice")
  write_landmarks(batch_specimens(1)[[1]]$landmarks + 0.1, marks[3])
  shapes <- suppressMessages(fit_shapes(twice, edge_scheme(), landmarks = marks))
  expect_named(shapes, c("ball 1", "ball 2", "ball 1 1"))
})
