# Norms as text: the same z, and nothing else is read.

written <- function(norms = small_norms(), ...) {
  dir <- tempfile("norms")
  write_norms(norms, dir, ...)
  dir
}

test_that("a norm that was written and read gives the same z", {
  norms <- small_norms()
  dir <- written(norms)
  read <- read_norms(dir)
  look <- function(x) {
    shape <- small_patient(lesions = data.frame(height = 6, radius = 18, point = "mid 4 3"))
    suppressWarnings(assess(shape, x, 10, "female"))
  }
  a <- look(norms)
  b <- look(read)
  expect_equal(a$values, b$values, tolerance = 1e-10)
  expect_equal(a$points, b$points, tolerance = 1e-10)
  expect_equal(a$verdicts, b$verdicts, tolerance = 1e-10)
  expect_equal(a$findings, b$findings, tolerance = 1e-8)
  # Written again, the files are the same to the last byte.
  again <- written(read)
  files <- setdiff(list.files(dir), "norms.json")
  expect_identical(list.files(again), list.files(dir))
  expect_equal(unname(tools::md5sum(file.path(dir, files))),
               unname(tools::md5sum(file.path(again, files))))
})

test_that("the folder is text, without a line for a person", {
  dir <- written()
  bytes <- unlist(lapply(list.files(dir, full.names = TRUE), readBin, "raw", 1e7))
  expect_true(all(as.integer(bytes) %in% c(10, 32:126)))
  tables <- list.files(dir, "csv$", full.names = TRUE)
  expect_false(any(vapply(tables, function(file) nrow(utils::read.csv(file)), 0L) == 120))
  header <- jsonlite::fromJSON(file.path(dir, "norms.json"))
  expect_identical(header$format, "crestline-norms")
  expect_equal(sum(utils::read.csv(file.path(dir, "counts.csv"))$n), 120)
})

test_that("damaged, foreign and newer folders are refused by name", {
  change <- function(file, from, to) {
    dir <- written()
    path <- file.path(dir, file)
    lines <- readLines(path)
    at <- grep(from, lines)[1]
    lines[at] <- sub(from, to, lines[at])
    writeLines(lines, path)
    dir
  }
  expect_crestline_error(read_norms(change("mean-surface.csv", "^1,", "2,")), "mean-surface.csv")
  expect_crestline_error(read_norms(change("norms.json", "\"n\": 120", "\"n\": 121")),
                         c("norms.json", "checksum"))
  expect_crestline_error(read_norms(change("norms.json", "\"version\": 3", "\"version\": 9")),
                         c("version 9", "Update"))
  expect_crestline_error(read_norms(change("norms.json", "\"version\": 3", "\"version\": 1")),
                         c("version 1", "Fit and write"))
  expect_crestline_error(read_norms(change("norms.json", "crestline-norms", "other")), "no norm")
  dir <- written()
  unlink(file.path(dir, "scan-surface.csv"))
  expect_crestline_error(read_norms(dir), c("scan-surface.csv", "missing"))
  dir <- written()
  text <- readLines(file.path(dir, "norms.json"))
  writeLines(text[1:20], file.path(dir, "norms.json"))
  expect_crestline_error(read_norms(dir), "norms.json")
  expect_crestline_error(read_norms(tempdir()), "no norms.json")
  expect_crestline_error(read_norms(tempfile()), "no folder")
  expect_crestline_error(write_norms(small_norms(), system.file(package = "stats")), "other files")
  expect_crestline_error(written(share = TRUE), "3 components of 120 faces")
})

test_that("numbers that no norm has are refused though the checksums fit", {
  norms <- small_norms()
  norms$surface$columns$groups$male$mean[2, 3] <- NA
  expect_crestline_error(read_norms(written(norms)), "not finite")
  norms <- small_norms()
  norms$surface$sd[4] <- 0
  expect_crestline_error(read_norms(written(norms)), "not above 0")
  norms <- small_norms()
  norms$surface$healing$at[1] <- 99L
  expect_crestline_error(read_norms(written(norms)), "healing.csv")
  norms <- small_norms()
  norms$surface$mirrored[1] <- norms$surface$kernel[2] + 0.1
  expect_crestline_error(read_norms(written(norms)), "kernel")
  norms <- small_norms()
  norms$points$r_xy[3] <- 1.2
  expect_crestline_error(read_norms(written(norms)), c("reference.csv", "correlations"))
})

test_that("pictures of an assessment show its maps", {
  found <- suppressWarnings(assess(small_patient(), small_norms(), 10, "female"))
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (what in c("map", "scan", "healed", "distance", "asymmetry")) {
    expect_identical(plot(found, what, resolution = 5, samples = 1), found)
  }
  expect_crestline_error(plot(found, "photograph"), "`what`")
})

test_that("a file that was changed on its way says how", {
  dir <- written()
  path <- file.path(dir, "ages.csv")
  lines <- readLines(path)
  writeLines(lines, path, sep = "\r\n")
  expect_crestline_error(read_norms(dir), c("ages.csv", "Windows", "zip"))
  writeBin(c(as.raw(c(0xef, 0xbb, 0xbf)), charToRaw(paste0(lines, "\n", collapse = ""))), path)
  expect_crestline_error(read_norms(dir), c("ages.csv", "byte order mark"))
  unlink(path)
  dir.create(path)
  expect_crestline_error(write_norms(small_norms(), dir), "ages.csv")
  dir <- written()
  path <- file.path(dir, "norms.json")
  zip <- tempfile(fileext = ".zip")
  writeLines("PK", zip)
  expect_crestline_error(read_norms(zip), c("no folder", "Unpack"))
  expect_crestline_error(read_norms(path), c("norms.json", "folder that it is in"))
})

test_that("share = TRUE believes no number that it can compute", {
  norms <- small_norms()
  norms$privacy <- list(ratio = 1, auc = 0.5, least = 50, closest = 0.4)
  one <- norms
  one$surface$values <- one$surface$values[1]
  one$values$groups$female$lambda[1] <- 1e-4
  share <- function(x) write_norms(x, tempfile(), share = TRUE)
  # Ages at which few faces count, whatever `privacy` says
  expect_crestline_error(suppressMessages(share(one)), c("the mean is decided by", "cuts ages"))
  many <- norms
  many$n <- 5000L
  expect_crestline_error(share(many), c("`norms`", "fitted to 120"))
  many$counts$n <- many$counts$n * 50L
  many$n <- 6000L
  expect_crestline_error(share(many), "fitted to 120")
  one$privacy$closest <- 0.1
  expect_crestline_error(share(one), c("copies", "one face of each person"))
  one$privacy$closest <- NULL
  expect_crestline_error(share(one), "Fit it again")
})
