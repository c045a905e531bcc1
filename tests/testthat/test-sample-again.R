# What failed is measured again, and takes its place.

test_that("the failed of a batch are measured again with what is changed", {
  skip_without_futures()
  two <- batch_specimens(2)
  dir <- batch_folder(two)
  on.exit(unlink(dir, recursive = TRUE))
  file <- file.path(dir, "ball 2.csv")
  file.rename(file, file.path(dir, "mine.csv"))
  shapes <- fit_shapes(meshes_in(dir), quad_scheme(),
                       measuring = shape_settings(column_angle = 0.01))
  expect_identical(failures(shapes)$id, "ball 2")
  # Still without landmarks; they are not found among placed ones.
  expect_match(failures(fit_shapes(shapes))$message, "1 other of the batch has")
  marks <- list("ball 2" = read_landmarks(file.path(dir, "mine.csv")))
  by_hand <- fit_shapes(shapes, landmarks = marks)
  expect_identical(nrow(failures(by_hand)), 0L)
  expect_identical(names(by_hand), names(shapes))
  expect_identical(by_hand[[1]], shapes[[1]])
  own <- fit_shape(two[[2]], quad_scheme(), progress = FALSE,
                   measuring = shape_settings(column_angle = 0.01))
  same_points(by_hand[[2]], own, tolerance = 1e-6)
  # The file is put beside the mesh.
  file.copy(file.path(dir, "mine.csv"), file)
  expect_identical(nrow(failures(fit_shapes(shapes, reading = list(tolerance = 0.02)))), 0L)
  expect_message(fit_shapes(by_hand), "No specimen of the batch has failed")
  expect_crestline_error(fit_shapes(shapes, quad_scheme()), "`scheme`")
})

test_that("a result takes the place of a failure of the same id, in a batch of two", {
  skip_without_futures()
  two <- batch_specimens(2)
  bad <- two[[2]]
  bad$landmarks[] <- NA
  shapes <- fit_shapes(list(two[[1]], bad), edge_scheme(), unit = 1)
  bare <- fit_shapes(specimen(two[[1]]$mesh, id = "ball 3"), edge_scheme())
  expect_identical(failures(bare)$id, "ball 3")
  one <- fit_shapes(two[[1]], edge_scheme())
  third <- two[[1]]
  third$id <- "ball 3"
  mended <- fit_shapes(third, edge_scheme())
  expect_message(all <- suppressWarnings(c(bare, one, mended)), "replaced by results of: ball 3")
  expect_named(all, c("ball 3", "ball 1"))
  expect_identical(nrow(failures(all)), 0L)
  expect_crestline_error(c(one, one), "twice")
  expect_identical(failures(c(bare, bare))$id, "ball 3")
})
