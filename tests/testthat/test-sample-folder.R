# Folders of results: nothing is overwritten in silence, and all of it is read without the meshes.

test_that("a folder is read as a batch without meshes, also after it was moved", {
  skip_without_futures()
  out <- tempfile("out-")
  moved <- tempfile("moved-")
  on.exit(unlink(c(out, moved), recursive = TRUE))
  three <- batch_specimens()
  shapes <- fit_shapes(three, edge_scheme(), out)
  file.rename(out, moved)
  expect_match(failures(shapes)$remedy, "read_batch(", fixed = TRUE)
  read <- read_batch(moved)
  expect_named(read, names(shapes))
  for (i in 1:3) same_points(read[[i]], fit_shape(three[[i]], edge_scheme(), progress = FALSE))
  expect_output(print(read), "3 read from the folder, 0 measured now", fixed = TRUE)
  # It joins with others of the scheme, and runs go on in it.
  again <- fit_shapes(three[1], edge_scheme(), moved)
  expect_identical(attr(again, "read"), "ball 1")
  expect_length(c(read[2:3], again), 3)
  expect_crestline_error(c(read, fit_shapes(three[1], edge_scheme(7))), "different schemes")
  expect_named(read_batch(list.files(moved, full.names = TRUE)[2]), "ball 2")
  expect_crestline_error(read_batch(tempfile()), "no folder")
  expect_crestline_error(read_batch(tempdir(check = TRUE)), "no results")
  expect_crestline_error(read_batch(1), "`x`")
})

test_that("other settings in one folder overwrite nothing, and are told", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  two <- batch_specimens(2)
  first <- fit_shapes(two, quad_scheme(), out)
  before <- tools::md5sum(list.files(out, "shape$", full.names = TRUE))
  expect_message(second <- fit_shapes(two, quad_scheme(), out,
                                      measuring = shape_settings(column_angle = 0.01)),
                 "Now: scheme quad .*column_angle = 0.01, in files such as ball 1-")
  expect_identical(tools::md5sum(names(before)), before)
  expect_identical(nrow(failures(first)) + nrow(failures(second)), 0L)
  expect_no_message(third <- fit_shapes(two, quad_scheme(), out,
                                        measuring = shape_settings(column_angle = 0.01)))
  expect_identical(attr(third, "read"), names(two <- second))
  # The newest of each is read, with a message; others by their paths.
  Sys.setFileTime(names(before), "2001-01-01")
  expect_message(read <- read_batch(out), "several results")
  same_points(read[[1]], second[[1]])
  same_points(read_batch(names(before))[[1]], first[[1]])
  expect_message(read_batch(c(names(before)[1], list.files(out, "ball 2-", full.names = TRUE))),
                 "different ways")
})

test_that("a folder of two schemes is refused, a damaged result is a failure", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  two <- batch_specimens(2)
  fit_shapes(two[1], edge_scheme(), out)
  fit_shapes(two[2], edge_scheme(7), out)
  expect_crestline_error(read_batch(out), "different schemes: edges")
  file <- file.path(out, "ball 2.shape")
  writeBin(readBin(file, "raw", 1000), file)
  expect_identical(failures(read_batch(out))$id, "ball 2")
})
