# quality() of a batch in a folder is that of its shapes, and opens none of them.

opened_by <- function(code) {
  opened <- 0
  suppressMessages(trace("open_kept", function() opened <<- opened + 1, print = FALSE,
                         where = asNamespace("crestline")))
  on.exit(suppressMessages(untrace("open_kept", where = asNamespace("crestline"))))
  force(code)
  opened
}

measures_files <- function(out) list.files(out, "^quality-.*[.]tsv$", full.names = TRUE)

test_that("quality() of a folder is that of its shapes, and opens none", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(3))
  out <- tempfile("out-")
  on.exit(unlink(c(dir, out), recursive = TRUE))
  writeLines("no mesh", meshes_in(dir)[2])
  suppressWarnings(fit_shapes(dir, quad_scheme(), out))
  shapes <- read_batch(out)
  own <- as.list(shapes)
  graded <- NULL
  expect_identical(opened_by(graded <- quality(shapes)), 0)
  by_shapes <- quality(structure(own, failed = attr(shapes, "failed")))
  expect_identical(as.data.frame(graded), as.data.frame(by_shapes))
  expect_identical(attributes(graded)[c("found", "rows")],
                   attributes(by_shapes)[c("found", "rows")])
  expect_identical(opened_by(graded <- quality(own[[1]], others = shapes[3])), 0)
  expect_identical(graded, quality(own[[1]], others = own[3]))
  expect_identical(as.data.frame(quality(shapes[c(3, 1)])), as.data.frame(quality(own[c(3, 1)])))
})

test_that("measures that are absent, stale, damaged or of another version are made anew", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  fit_shapes(batch_specimens(3), edge_scheme(), out)
  right <- as.data.frame(quality(as.list(read_batch(out))))
  graded <- function() as.data.frame(quality(read_batch(out)))
  expect_length(measures_files(out), 1)
  lines <- readLines(measures_files(out))
  changed <- function(lines) {
    writeLines(lines, measures_files(out))
    # Each of the three is opened, and the next time none.
    expect_identical(opened_by(expect_identical(graded(), right)), 3)
    expect_identical(opened_by(expect_identical(graded(), right)), 0)
  }
  columns <- strsplit(lines, "\t", fixed = TRUE)
  with_column <- function(name, f) {
    vapply(columns, function(one) {
      at <- match(name, measures_columns)
      paste(replace(one, at, f(one[at])), collapse = "\t")
    }, "")
  }
  changed(character())
  changed(substr(lines, 1, nchar(lines) - 30))
  changed(with_column("version", function(x) "0"))
  changed(with_column("time", function(x) "1.000000"))
  changed(with_column("key", function(x) "another"))
  for (at in c(50, 400)) changed(with_column("packed", function(x) {
    paste0(substr(x, 1, at - 1), "AzBy", substring(x, at + 4))
  }))
  changed(with_column("packed", function(x) "no letters of 64: \u00e4"))
  writeLines(with_column("scheme", function(x) "none"), measures_files(out))
  expect_identical(graded(), right)
  unlink(measures_files(out))
  expect_identical(graded(), right)
  for (i in 1:12) file.copy(measures_files(out)[1], file.path(out, sprintf("quality-%d.tsv", i)))
  expect_identical(opened_by(expect_identical(graded(), right)), 0)
  expect_length(measures_files(out), 1)
})

test_that("a result that is damaged or another now is not graded by what was known of it", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  fit_shapes(batch_specimens(2), edge_scheme(), out)
  shapes <- read_batch(out)
  file <- file.path(out, "ball 2.shape")
  keep(as.list(shapes)[[1]], list(key = "other", mesh = "m", id = "ball 2"), file)
  expect_warning(graded <- quality(shapes), "another result", class = "crestline_keeping_warning")
  expect_identical(unique(graded$why[graded$specimen == "ball 2"]), "it was not measured")
  writeBin(raw(100), file)
  expect_warning(graded <- quality(shapes), "damaged", class = "crestline_keeping_warning")
  unlink(file)
  expect_warning(quality(shapes), "not there", class = "crestline_keeping_warning")
})

test_that("the columns that are graded are those of this version of the measures", {
  # Another column, or another meaning: raise measures_version.
  expect_identical(measures_version, 1L)
  shape <- fit_shape(batch_specimens(1)[[1]], edge_scheme(), progress = FALSE)
  expect_identical(names(part_measures(shape, "a")), c(
    "specimen", "part", "level", "kind", "length", "strength", "contrast", "se", "competing", "z",
    "asymmetry", "missing", "cut", "bridged", "faults", "roughness", "coarse", "border", "spike",
    "offset", "track", "noise_factor", "reason", "determined", "guessed", "size", "free", "radius",
    "se_max", "state", "confidence", "exchanged"
  ))
})
