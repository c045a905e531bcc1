# A specimen whose scan lies in its file.

stored_example <- function() {
  dir <- batch_folder(batch_specimens(1))
  mesh <- meshes_in(dir)
  whole <- read_specimen(mesh, sub("ply$", "csv", mesh))
  source <- list(file = mesh, hash = rlang::hash_file(mesh), reading = list())
  list(dir = dir, mesh = mesh, whole = whole, stored = stored_specimen(whole, source))
}

test_that("it is the specimen that it was, its scan read when it is asked for", {
  made <- stored_example()
  on.exit(unlink(made$dir, recursive = TRUE))
  stored <- unserialize(serialize(made$stored, NULL))
  expect_lt(length(serialize(stored, NULL)), length(serialize(made$whole, NULL)) / 5)
  expect_identical(stored$landmarks, made$whole$landmarks)
  expect_identical(stored$mesh, made$whole$mesh)
  expect_identical(stored[["geometry"]][c("twin", "located")],
                   made$whole$geometry[c("twin", "located")])
  expect_identical(names(stored), names(made$whole))
  expect_identical(whole_specimen(stored), made$whole)
  expect_silent(validate(stored))
  stored$id <- "another"
  expect_s3_class(stored, "stored_specimen")
  stored$landmarks <- stored$landmarks[-1, ]
  expect_identical(class(stored), "specimen")
  expect_identical(stored$mesh$vb, made$whole$mesh$vb)
})

test_that("two results of one scan have their own landmarks", {
  made <- stored_example()
  on.exit(unlink(made$dir, recursive = TRUE))
  moved <- made$whole$landmarks
  moved[c("a", "b"), ] <- moved[c("b", "a"), ]
  other <- read_specimen(made$mesh, moved)
  second <- stored_specimen(other, unclass(made$stored)$source)
  expect_identical(made$stored$geometry$landmarks, made$whole$geometry$landmarks)
  expect_identical(second$geometry$landmarks, other$geometry$landmarks)
  expect_identical(whole_specimen(second), other)
})

test_that("a scan that is gone, moved or changed is named, with the remedy", {
  made <- stored_example()
  moved <- tempfile("moved-")
  dir.create(moved)
  on.exit({
    unlink(c(made$dir, moved), recursive = TRUE)
    options(crestline.scans = NULL)
  })
  file.copy(made$mesh, moved)
  unlink(made$mesh)
  error <- expect_error(made$stored$mesh, class = "crestline_scan_error")
  expect_match(conditionMessage(error), paste0(made$whole$id, ".*", basename(made$mesh)))
  expect_match(conditionMessage(error), "crestline.scans")
  expect_identical(made$stored$landmarks, made$whole$landmarks)
  options(crestline.scans = moved)
  expect_identical(made$stored$mesh, made$whole$mesh)
  # Another file in the place of the first: the one that has not changed is read.
  writeLines("another scan", made$mesh)
  last_scan$what <- NULL
  expect_identical(made$stored$mesh, made$whole$mesh)
  unlink(made$mesh)
  bytes <- readBin(file.path(moved, basename(made$mesh)), "raw", 1e6)
  bytes[length(bytes) - 5] <- xor(bytes[length(bytes) - 5], as.raw(1))
  writeBin(bytes, file.path(moved, basename(made$mesh)))
  expect_error(made$stored$mesh, "has changed", class = "crestline_scan_error")
})
