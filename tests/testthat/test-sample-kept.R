# Names of files for any id, and files that are never taken for what they are not.

test_that("any id has a file's name that gives it back, and no two share one on any disk", {
  ids <- c("anna", "Anna", "ANNA", "a/b", "a\\b", "a:b*?\"<>|", "CON", "nul", "com1.txt", "a.",
           " a", "a%2Fb", "\u00e9t\u00e9",
           "\u4e2d\u6587", "tab\t", "~", ".hidden", "name with blanks", "Mixed Case 7")
  stems <- file_stems(ids)
  expect_identical(enc2utf8(vapply(stems, utils::URLdecode, "", USE.NAMES = FALSE)), enc2utf8(ids))
  expect_identical(anyDuplicated(tolower(stems)), 0L)
  expect_true(all(grepl("^[A-Za-z0-9 ._%-]+$", stems)))
  expect_false(any(grepl("^(con|nul|com1)([.]|$)", stems, ignore.case = TRUE)))
  expect_false(any(grepl("^[. ]|[. ]$", stems)))
  expect_identical(stems[c(18, 19)], ids[c(18, 19)])
  long <- file_stems(c(strrep("x", 300), paste0(strrep("x", 299), "y"), strrep("\u4e2d", 100)))
  expect_true(all(nchar(long) <= 160) && !anyDuplicated(long))
})

test_that("the failure of a specimen is not that of one whose name differs by capitals", {
  out <- tempfile("out-")
  dir.create(out)
  on.exit(unlink(out, recursive = TRUE))
  # On such a disk the second run finds the first one's file under its own name.
  task <- function(id) list(key = "k", mesh = "m", setting = "s", name = id,
                            file = file.path(out, "anna.shape"))
  for (id in c("Anna", "anna", "anna")) note_failure(new_failure("reading", "no", "yes"), task(id))
  index <- folder_index(out)
  expect_setequal(index$id, c("anna", "Anna"))
  expect_identical(failure_of_task(task("Anna")), file.path(out, "anna.failure"))
  expect_false(failure_of_task(task("anna")) == failure_of_task(task("Anna")))
})

kept_example <- function(value = list(a = 1:10, b = stats::rnorm(50))) {
  file <- tempfile(fileext = ".shape")
  keep(value, list(key = "k1", mesh = "m1", id = "\u00e9", warnings = no_warnings()), file)
  file
}

test_that("what is kept is read back, and its first line tells what it is of", {
  value <- list(a = 1:10, b = pi, c = "text")
  file <- kept_example(value)
  on.exit(unlink(file))
  opened <- open_kept(file)
  expect_identical(opened$state, "whole")
  expect_identical(opened$about[c("key", "id")], list(key = "k1", id = "\u00e9"))
  expect_identical(kept_value(opened), value)
  expect_identical(peek_kept(file),
                   list(key = "k1", mesh = "m1", setting = NA_character_, own = TRUE))
  expect_identical(open_kept(tempfile())$state, "absent")
})

test_that("any flipped bit and any cut is noticed before anything is unserialised", {
  file <- kept_example()
  on.exit(unlink(file))
  bytes <- readBin(file, "raw", 1e6)
  state <- function(bytes) {
    writeBin(bytes, file)
    open_kept(file)$state
  }
  places <- unique(round(seq(1, length(bytes), length.out = 150)))
  flipped <- vapply(places, function(i) {
    bytes[i] <- xor(bytes[i], as.raw(bitwShiftL(1L, i %% 8)))
    state(bytes)
  }, "")
  expect_false("whole" %in% flipped)
  # The first line is looked at before the checksum is.
  for (i in 1:60) {
    for (bit in 0:7) {
      one <- bytes
      one[i] <- xor(one[i], as.raw(bitwShiftL(1L, bit)))
      writeBin(one, file)
      expect_silent(peek_kept(file))
    }
  }
  cut <- vapply(round(seq(0, length(bytes) - 1, length.out = 30)),
                function(n) state(bytes[seq_len(n)]), "")
  expect_identical(unique(cut), "damaged")
  expect_identical(state(c(bytes, as.raw(0))), "damaged")
  expect_identical(state(bytes), "whole")
})

test_that("files of the former layout are known and not read, those of others are left alone", {
  file <- tempfile()
  on.exit(unlink(file))
  to <- gzfile(file, "wb")
  serialize("key", to)
  serialize(list(1), to)
  close(to)
  expect_identical(open_kept(file)$state, "former")
  expect_true(peek_kept(file)$own)
  writeLines("a letter", file)
  expect_false(peek_kept(file)$own)
  expect_identical(open_kept(file)$state, "damaged")
})

test_that("what cannot be written is an error of ours and leaves nothing behind", {
  dir <- tempfile("full-")
  expect_crestline_error(keep(1, list(key = "k", mesh = "m"), file.path(dir, "a.shape")),
                         "cannot be written")
  dir.create(dir)
  on.exit(unlink(dir, recursive = TRUE))
  # A folder cannot be replaced by a file.
  dir.create(file.path(dir, "a.shape"))
  expect_crestline_error(keep(1, list(key = "k", mesh = "m"), file.path(dir, "a.shape")),
                         "cannot be written")
  expect_identical(list.files(dir), "a.shape")
  skip_on_os("windows")
  skip_if_not(file.exists("/dev/full"))
  expect_error(suppressWarnings(write_whole(as.raw(1:200), "/dev/full")))
})

test_that("a hash is of the content, however R has it in memory", {
  expect_identical(content_hash(list(1:3)), content_hash(list(c(1L, 2L, 3L))))
  expect_false(identical(content_hash(1:3), content_hash(c(1, 2, 3))))
})

test_that("results that are absent, folders or cannot be written cost no connection", {
  before <- nrow(showConnections())
  folder <- tempfile("folder")
  dir.create(folder)
  for (i in 1:3) {
    expect_true(is.na(peek_kept(tempfile())$key))
    expect_false(peek_kept(folder)$own)
    expect_equal(open_kept(folder)$state, "damaged")
    expect_crestline_error(keep(1, list(key = "a", mesh = "b"), file.path(tempfile(), "a.shape")),
                           "cannot be written")
  }
  expect_equal(nrow(showConnections()), before)
})

test_that("hashes and checksums are those of other versions of rlang and R", {
  expect_identical(bytes_hash(as.raw(1:200)), "4d5d2c739a03aef0af7e5fb544c9ec7a")
  expect_identical(content_hash(list(a = 1:3, b = "text", c = pi)),
                   "54203a0f2cb5176643b4b6fc2c4cafdc")
  expect_identical(checksum(as.raw(1:3), as.raw(4:6), as.raw(7:9)),
                   "e54434537080ad24fb6b1de200f6f7a2")
})
