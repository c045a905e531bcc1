# Tables for other programs: what is written is read back.

test_that("points and status come back, long and wide, with what is known of specimens", {
  skip_without_futures()
  skip_if_not_installed("nanoparquet")
  out <- tempfile("out-")
  file <- tempfile(fileext = ".parquet")
  on.exit(unlink(c(out, file), recursive = TRUE))
  shapes <- fit_shapes(batch_specimens(3), quad_scheme(), out)
  known <- data.frame(id = paste("ball", 3:1), site = c("c", "b", "a"))
  read <- function(...) {
    expect_identical(write_parquet(shapes, file, ..., specimens = known), file)
    as.data.frame(nanoparquet::read_parquet(file))
  }
  long <- read()
  expect_identical(unique(long[c("id", "site")])$site, c("a", "b", "c"))
  for (id in names(shapes)) {
    own <- shapes[[id]]$points[c("level", "part", "point", "x", "y", "z", "se")]
    back <- long[long$id == id, names(own)]
    rownames(back) <- NULL
    expect_identical(back, own)
  }
  wide <- read(form = "wide")
  expect_identical(wide$id, names(shapes))
  own <- shapes[[2]]$points
  name <- paste(own$level, ifelse(own$level == "landmarks", own$part, paste(own$part, own$point)))
  expect_identical(as.numeric(unlist(wide[2, paste0(name, ".y")])), own$y)
  status <- read("status")
  grades <- as.data.frame(quality(shapes))
  expect_identical(status$grade, as.character(grades$grade))
  expect_identical(status$length, grades$length)
  wide <- read("status", "wide")
  one <- grades[grades$part == "top" & grades$level == "curves", ]
  expect_identical(wide[["curves top.grade"]], as.character(one$grade))
})

test_that("specimens have the names of the list, long and wide", {
  skip_if_not_installed("nanoparquet")
  file <- tempfile(fileext = ".parquet")
  on.exit(unlink(file))
  shape <- fit_shape(batch_specimens(1)[[1]], edge_scheme(), progress = FALSE)
  known <- data.frame(id = c("first", "second"), site = c("a", "b"))
  for (what in c("points", "status")) for (form in c("long", "wide")) {
    write_parquet(list(first = shape, second = shape), file, what, form, known)
    table <- nanoparquet::read_parquet(file)
    expect_identical(unique(table$id), known$id)
    expect_identical(unique(table$site), known$site)
  }
})

test_that("what cannot be written is told", {
  skip_if_not_installed("nanoparquet")
  shape <- fit_shape(batch_specimens(1)[[1]], edge_scheme(), progress = FALSE)
  file <- tempfile()
  for (wrong in list(data.frame(a = 1), data.frame(id = c("a", "a")), data.frame(id = "a", x = 1),
                     data.frame(id = "another", site = 1), "a")) {
    expect_crestline_error(write_parquet(shape, file, specimens = wrong), "`specimens`")
  }
  expect_crestline_error(write_parquet(shape, file.path(file, "none")), "cannot be written")
  expect_crestline_error(write_parquet(list(), file), "`x`")
  expect_false(file.exists(file))
})

test_that("a table of several parts is one file", {
  skip_if_not_installed("nanoparquet")
  file <- tempfile(fileext = ".parquet")
  on.exit(unlink(file))
  rows <- list(parts = list("a", "b", "none"), columns = "id",
               rows = function(name) if (name != "none") data.frame(id = name, x = pi))
  write_table_parts(rows, NULL, file)
  expect_identical(as.data.frame(nanoparquet::read_parquet(file)),
                   data.frame(id = c("a", "b"), x = pi))
})
