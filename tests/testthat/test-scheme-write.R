test_that("a written scheme is read again number by number, no table of another is left", {
  dir <- file.path(tempfile(), "new", "folder")
  leaf <- leaf_scheme(set_cell("curves", 1, "radius", 1 / 3))
  write_scheme(leaf, dir)
  expect_equal(read_scheme(dir, "leaf"), leaf)
  expect_identical(read_scheme(dir, "leaf")$curves$radius, leaf$curves$radius)
  write_scheme(face_scheme(), dir)
  expect_identical(scheme_hash(read_scheme(dir)), scheme_hash(face_scheme()))
  write_scheme(leaf, dir)
  expect_false(file.exists(file.path(dir, "definitions.csv")))
  expect_equal(read_scheme(dir, "leaf"), leaf)
})

test_that("quotes, commas and letters of other languages come back", {
  dir <- tempfile()
  odd <- leaf_scheme(set_cell("curves", 2, "curve", "edge \"\u00e4\", left") |>
                       (\(change) function(tables) {
                         tables <- change(tables)
                         tables[c("patches", "pairs", "strips")] <- NULL
                         tables
                       })())
  write_scheme(odd, dir)
  expect_identical(read_scheme(dir, "leaf")$curves$curve, odd$curves$curve)
})

test_that("what is no folder is refused", {
  file <- tempfile()
  writeLines("x", file)
  expect_crestline_error(write_scheme(leaf_scheme(), file), "cannot be made")
  expect_crestline_error(write_scheme(leaf_scheme(), 3), "`dir` is")
})
