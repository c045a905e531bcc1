# What Windows and macOS would trip over, as far as it shows here.

sources <- function(...) {
  dir <- testthat::test_path("..", "..")
  testthat::skip_if_not(file.exists(file.path(dir, "R", "zzz.R")), "sources not here")
  file.path(dir, ...)
}

# What R's functions that write need to stay the same in a folder of a name with blanks and umlauts.
odd_folder <- function() {
  testthat::skip_if_not(isTRUE(l10n_info()[["UTF-8"]]), "no UTF-8 here")
  dir <- file.path(tempfile("odd"), "Gr\u00f6\u00dfe der Nase (2)")
  dir.create(dir, recursive = TRUE)
  dir
}

test_that("no file has a name that Windows reserves or cannot have, or that differs by case only", {
  root <- sources()
  folders <- c("R", "src", "inst", "man", "tests", "vignettes", "exec", "tools", "bench",
               "data-raw", "man-roxygen")
  files <- list.files(file.path(root, intersect(folders, dir(root))), recursive = TRUE)
  reserved <- "^(con|prn|aux|nul|com[0-9]|lpt[0-9])([.]|$)"
  expect_gt(length(files), 300)
  expect_equal(grep(reserved, basename(files), ignore.case = TRUE, value = TRUE), character())
  expect_equal(grep("[<>:\"|?*\\\\]|[ .]$|[^ -~]", files, value = TRUE), character())
  for (folder in intersect(folders, dir(root))) {
    own <- list.files(file.path(root, folder), recursive = TRUE)
    expect_equal(own[duplicated(tolower(own))], character())
  }
  # R CMD build refuses longer ones.
  expect_lt(max(nchar(files)), 90)
})

test_that("scripts ask for nothing that macOS's bash 3.2 and BSD tools lack", {
  root <- sources("tools")
  skip_if_not(dir.exists(root), "tools not here")
  lines <- unlist(lapply(list.files(root, "[.]sh$", full.names = TRUE)[
    basename(list.files(root, "[.]sh$")) %in% c("steps.sh", "setup.sh", "install.sh")
  ], readLines))
  expect_gt(length(lines), 100)
  lacking <- paste0("mapfile|readarray|declare -A|[$][{][a-z]+(,,|\\^\\^)|xargs -d|sha256sum|",
                    "sed -r|grep -P|readlink -f|date -d|find .*-printf|\\bstat -c")
  expect_equal(grep(lacking, lines, value = TRUE), character())
})

test_that("the package is built by make without extensions of GNU's", {
  lines <- readLines(sources("src", "Makevars"))
  expect_equal(grep(":=|[$][(](shell|wildcard|patsubst)|^ifeq|^ifdef|[+]=", lines, value = TRUE),
               character())
})

test_that("files go through a folder with blanks, brackets and umlauts", {
  dir <- odd_folder()
  on.exit(unlink(dirname(dir), recursive = TRUE))
  x <- ball_specimen()
  for (ending in c("ply", "obj", "stl")) {
    file <- file.path(dir, paste0("Sch\u00e4del 1.", ending))
    write_mesh(x, file)
    expect_equal(ncol(read_specimen(file, outward = "keep", debris = 0)$mesh$it), ncol(x$mesh$it))
  }
  for (ending in c("csv", "pts", "fcsv", "mrk.json")) {
    file <- file.path(dir, paste0("Sch\u00e4del 1.", ending))
    write_landmarks(x, file)
    expect_equal(unname(read_landmarks(file)), unname(x$landmarks), tolerance = 1e-6)
  }
  write_glb(x, file.path(dir, "\u00e4.glb"))
  expect_gt(file.size(file.path(dir, "\u00e4.glb")), 1000)
  scheme <- file.path(dir, "Schema \u00dc")
  write_scheme(face_scheme(), scheme)
  expect_equal(read_scheme(scheme)$curves$curve, face_scheme()$curves$curve)
})
