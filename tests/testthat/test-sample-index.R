# The index of a folder is a copy of what lies in its files: lost, stale or cut short it is made
# anew.

indexed <- function(dir) folder_index(dir)[c("file", "state", "key", "id", "red")]

test_that("an index that is absent, stale, doubled or cut short changes nothing", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  fit_shapes(batch_specimens(3), edge_scheme(), out)
  parts <- function() list.files(out, "^index-", full.names = TRUE)
  known <- indexed(out)
  expect_identical(known$state, rep("whole", 3))
  expect_length(parts(), 1)
  bytes <- readBin(parts(), "raw", 1e5)
  writeBin(bytes[seq_len(length(bytes) - 20)], parts())
  expect_identical(indexed(out), known)
  unlink(parts())
  expect_identical(indexed(out), known)
  for (i in 1:12) file.copy(parts()[1], file.path(out, sprintf("index-other-%d.tsv", i)))
  expect_identical(indexed(out), known)
  expect_length(parts(), 1)
  # Two lines of one size and time that differ: the file is asked, whatever their order.
  line <- readLines(parts())
  stale <- sub(known$key[1], strrep("0", nchar(known$key[1])), line[1], fixed = TRUE)
  for (both in list(c(stale, line), c(line, stale))) {
    unlink(parts())
    writeLines(both, file.path(out, "index-both.tsv"))
    expect_identical(indexed(out), known)
    # Its line is there already: reading again adds none.
    before <- unlist(lapply(parts(), readLines))
    expect_identical(indexed(out), known)
    expect_identical(unlist(lapply(parts(), readLines)), before)
  }
  # Its file was touched: not the index is right.
  Sys.setFileTime(file.path(out, "ball 2.shape"), "2001-01-01")
  expect_identical(indexed(out), known)
  writeBin(raw(100), file.path(out, "ball 3.shape"))
  expect_identical(indexed(out)$state, c("whole", "whole", "damaged"))
})

test_that("the index alone is read by print(), failures() and warnings", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(3))
  out <- tempfile("out-")
  on.exit(unlink(c(dir, out), recursive = TRUE))
  writeLines("no mesh\twith tabs", meshes_in(dir)[2])
  shapes <- fit_shapes(dir, edge_scheme(), out)
  read <- read_batch(out)
  expect_identical(names(read), names(shapes))
  expect_identical(as.data.frame(failures(read)), as.data.frame(failures(shapes)))
  expect_identical(warnings_of(read), warnings_of(shapes))
  expect_identical(summary(read), summary(shapes))
  # Not one of the files is opened.
  opened <- 0
  suppressMessages(trace("open_kept", function() opened <<- opened + 1, print = FALSE,
                         where = asNamespace("crestline")))
  on.exit(suppressMessages(untrace("open_kept", where = asNamespace("crestline"))), add = TRUE)
  utils::capture.output(print(read_batch(out)))
  expect_identical(opened, 0)
  # A failure goes once it is measured.
  write_mesh(batch_specimens(2)[[2]], meshes_in(dir)[2])
  expect_message(fit_shapes(dir, edge_scheme(), out), "2 of 3 results are read")
  expect_identical(nrow(failures(read_batch(out))), 0L)
})

test_that("a result whose specimen failed later is taken with a message", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(2))
  out <- tempfile("out-")
  on.exit(unlink(c(dir, out), recursive = TRUE))
  fit_shapes(dir, edge_scheme(), out)
  expect_silent(read_batch(out))
  marks <- list.files(dir, "csv$", full.names = TRUE)[1]
  lines <- readLines(marks)
  writeLines(replace(lines, 2, sub(",[^,]*$", ",99999", lines[2])), marks)
  expect_identical(failures(suppressWarnings(fit_shapes(dir, edge_scheme(), out)))$id, "ball 1")
  expect_message(read <- read_batch(out), "last run failed on ball 1;")
  expect_identical(nrow(failures(read)), 0L)
})

test_that("a cohort is measured in parts, and what waits is a failure", {
  skip_without_futures()
  dir <- batch_folder(batch_specimens(5))
  out <- tempfile("out-")
  on.exit(unlink(c(dir, out), recursive = TRUE))
  first <- fit_shapes(dir, edge_scheme(), out, part = c(1, 2))
  expect_named(first, paste("ball", c(1, 3, 5)))
  whole <- read_batch(out)
  expect_setequal(names(whole), paste("ball", 1:5))
  expect_identical(unique(failures(whole)$stage), "waiting")
  expect_setequal(failures(whole)$id, paste("ball", c(2, 4)))
  fit_shapes(dir, edge_scheme(), out, part = c(2, 2))
  expect_identical(nrow(failures(read_batch(out))), 0L)
  expect_length(fit_shapes(dir, edge_scheme(), out, part = c(7, 9)), 0)
  # A scan is taken away: its result stays, and is named.
  unlink(file.path(dir, c("ball 5.ply", "ball 5.csv")))
  Sys.setFileTime(list.files(out, "^cohort-", full.names = TRUE), "2001-01-01")
  fit_shapes(dir, edge_scheme(), out, part = c(1, 2))
  expect_message(left <- read_batch(out), "1 result of scans .* not have: ball 5")
  expect_setequal(names(left), paste("ball", 1:5))
  for (part in list(0, c(3, 2), c(1.5, 2), "a", c(NA, 2))) {
    expect_crestline_error(fit_shapes(dir, edge_scheme(), out, part = part), "`part`")
  }
})

test_that("two runs with other settings, started at once, keep both results", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  one <- batch_specimens(1)
  fit_shapes(one, edge_scheme(), out)
  task <- list(key = "k2", mesh = "m2", setting = "s2", file = file.path(out, "ball 1.shape"))
  before <- tools::md5sum(task$file)
  write <- function(file, new) keep(list(1), task, file, new = new)
  kept <- keep_apart(task, write)
  expect_identical(basename(kept), "ball 1-k2.shape")
  expect_identical(tools::md5sum(task$file), before)
  expect_false(keep(list(2), task, kept, new = TRUE))
})
