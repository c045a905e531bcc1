# A folder of results: small files, scheme and settings once, scans where they are.

test_that("a result in a folder is the shape that was measured, without its scan", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(2))
  out <- tempfile("out-")
  on.exit(unlink(c(dir, out), recursive = TRUE))
  shapes <- fit_shapes(dir, quad_scheme(), out)
  mesh <- meshes_in(dir)[1]
  own <- fit_shape(read_specimen(mesh, sub("ply$", "csv", mesh)), quad_scheme(), progress = FALSE)
  read <- shapes[[1]]
  expect_s3_class(read$specimen, "stored_specimen")
  expect_identical(coords(read, "surface"), coords(own, "surface"))
  for (field in setdiff(names(own), "specimen")) expect_equal(read[[field]], own[[field]],
                                                              tolerance = 1e-9)
  expect_length(list.files(out, "^common-"), 2)
  embedded <- fit_shapes(dir, quad_scheme(), tempfile("whole-"), embed = TRUE)
  expect_identical(class(embedded[[1]]$specimen), "specimen")
  # Specimens in memory have no other place.
  given <- fit_shapes(batch_specimens(1), quad_scheme(), tempfile("given-"))
  expect_identical(class(given[[1]]$specimen), "specimen")
  # Both folders moved together.
  both <- tempfile("both-")
  dir.create(both)
  file.rename(c(dir, out), file.path(both, c(basename(dir), basename(out))))
  moved <- read_batch(file.path(both, basename(out)))
  expect_identical(moved[[1]]$specimen$mesh$vb, own$specimen$mesh$vb)
  unlink(file.path(both, basename(dir)), recursive = TRUE)
  expect_error(moved[[2]]$specimen$mesh, "ball 2.*is not there", class = "crestline_scan_error")
  same_points(moved[[1]], own)
})

test_that("a path with a missing place is stored as it is, and what cannot be kept is told", {
  skip_without_futures()
  shape <- fit_shape(batch_specimens(1)[[1]], edge_scheme(), progress = FALSE)
  shape$paths[[1]]$x[2] <- NA
  dir <- tempfile("out-")
  dir.create(dir)
  on.exit(unlink(dir, recursive = TRUE))
  stored <- stored_shape(shape, dir)
  expect_false(stored$pooled)
  expect_identical(from_stored(stored, dir)$paths, shape$paths)
})

test_that("a result of the former layout is read, and written anew, values equal", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(2))
  out <- tempfile("out-")
  dir.create(out)
  on.exit(unlink(c(dir, out), recursive = TRUE))
  before <- lapply(meshes_in(dir), function(mesh) {
    fit_shape(read_specimen(mesh, sub("ply$", "csv", mesh)), quad_scheme(), progress = FALSE)
  })
  names(before) <- vapply(before, `[[`, "", "id")
  files <- file.path(out, paste0(names(before), ".shape"))
  hash <- vapply(meshes_in(dir), rlang::hash_file, "")
  Map(function(shape, file, mesh) {
    keep(shape, list(key = "k", mesh = mesh, setting = "s", id = shape$id, words = "plain"), file)
    bytes <- readBin(file, "raw", 1e7)
    # The layout of its day: its number, and a checksum that fits.
    end <- grepRaw(as.raw(10L), bytes, all = TRUE)
    first <- charToRaw(sub("result 3", "result 2", rawToChar(bytes[seq_len(end[1] - 1)])))
    about <- bytes[(end[2] + 1):(end[3] - 1)]
    packed <- bytes[(end[3] + 1):length(bytes)]
    line <- as.raw(10L)
    sum <- charToRaw(former_checksum(first, about, packed))
    writeBin(c(first, line, sum, line, about, line, packed), file)
  }, before, files, hash)
  unlink(meshes_in(dir)[2])
  size <- file.size(files)
  read <- read_batch(out)
  for (id in names(before)) expect_identical(unclass(read[[id]]), unclass(before[[id]]))
  expect_true(all(file.size(files) < size))
  again <- read_batch(out)
  expect_s3_class(again[[1]]$specimen, "stored_specimen")
  expect_identical(class(again[[2]]$specimen), "specimen")
  for (id in names(before)) {
    for (field in setdiff(names(before[[id]]), "specimen")) {
      expect_equal(again[[id]][[field]], before[[id]][[field]], tolerance = 1e-9)
    }
    expect_identical(again[[id]]$specimen$mesh, before[[id]]$specimen$mesh)
  }
})

test_that("common files that are gone or damaged are told, and written again", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  shapes <- fit_shapes(batch_specimens(1), edge_scheme(6), out)
  rm(list = ls(shared_values), envir = shared_values)
  last_read$what <- NULL
  unlink(list.files(out, "^common-", full.names = TRUE))
  expect_warning(none <- shapes[[1]], "common-.*same scheme", class = "crestline_keeping_warning")
  expect_null(none)
  fit_shapes(c(batch_specimens(2)[2]), edge_scheme(6), out)
  expect_s3_class(shapes[[1]], "shape")
})

test_that("a result of a later version is refused, not misread", {
  later <- structure(list(version = stored_version + 1L), class = "stored_shape")
  expect_error(from_stored(later, tempdir()), "later version.*Install",
               class = "crestline_keeping_error")
})
