# The shell's commands in this process: files in, files out, exit codes, one line for an error.

# Exit code, output and standard error of a command.
run <- function(...) {
  error <- textConnection("said", "w", local = TRUE)
  sink(error, type = "message")
  on.exit({
    sink(type = "message")
    close(error)
  })
  out <- utils::capture.output(status <- run_command(c(...)))
  sink(type = "message")
  on.exit(close(error))
  list(status = status, out = out, said = textConnectionValue(error))
}

# Five balls with a scheme, as files in a folder.
ball_files <- function(n = 4, env = parent.frame()) {
  dir <- withr_tempdir(env)
  corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2))
  corners <- 50 * corners / sqrt(rowSums(corners^2))
  curves <- data.frame(curve = c("ab", "bc"), from = c("a", "b"), to = c("b", "c"),
                       kind = "plane", n = 5)
  scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "corner")
  write_scheme(scheme, file.path(dir, "scheme"))
  scans <- file.path(dir, "scans")
  dir.create(scans)
  ball <- Rvcg::vcgSphere(3)
  for (i in seq_len(n)) {
    stretch <- c(1, 1 + 0.03 * i, 1 + 0.02 * i^2)
    ball$vb[1:3, ] <- 50 * ball$vb[1:3, ] / rep(sqrt(colSums(ball$vb[1:3, ]^2)), each = 3)
    mesh <- list(vb = rbind(ball$vb[1:3, ] * stretch, 1), it = ball$it)
    write_mesh(structure(mesh, class = "mesh3d"), file.path(scans, sprintf("s%d.ply", i)))
    write_landmarks(corners * rep(stretch, each = 3), file.path(scans, sprintf("s%d.csv", i)))
  }
  list(scheme = file.path(dir, "scheme"), scans = scans, dir = dir)
}

withr_tempdir <- function(env) {
  dir <- tempfile("command-")
  dir.create(dir)
  do.call(on.exit, list(substitute(unlink(dir, recursive = TRUE), list(dir = dir)), add = TRUE),
          envir = env)
  dir
}

test_that("help lists every command, and the options of each", {
  help <- run("--help")
  expect_equal(help$status, 0L)
  for (name in names(commands())) {
    expect_true(any(startsWith(trimws(help$out), name)), label = name)
    own <- run(name, "--help")
    expect_equal(own$status, 0L)
    for (one in commands()[[name]]$options) {
      expect_true(any(startsWith(trimws(own$out), paste0("--", one$name))),
                  label = paste(name, one$name))
    }
  }
})

test_that("a wrong line gives 2 and one line that names what is wrong", {
  refused <- function(line, says) {
    ran <- run(line)
    expect_equal(ran$status, 2L)
    expect_length(ran$said, 1)
    expect_match(ran$said, says)
  }
  refused("fi", "no command of that name; fit is near")
  refused("fit", "needs SCAN")
  refused(c("fit", "x.ply"), "--out is missing")
  refused(c("fit", "x.ply", "--ot", "y"), "no option --ot")
  refused(c("fit", "x.ply", "--out"), "--out needs a value")
  refused(c("fit", "x.ply", "--out", "y", "--workers", "two"), "--workers is \"two\"")
  refused(c("quality", file.path(tempdir(), "nowhere")), "no folder or file")
  refused(c("homologise", tempdir(), "--sample", "x.csv"), "ends in .rds")
  refused(c("page", "none.ply", "--out", "page.txt"), "page.txt|none.ply")
  refused(c("page", "none.ply", "--out", file.path(tempdir(), "p.html")), "none.ply")
  refused(c("page", "a.ply", "b.ply", "--out", "p.html"), "2 files are given, and one is taken")
  refused("page", "needs SCAN")
  refused(c("find", "none.ply", "--out", "x.txt"), "ends in .csv, .json, .parquet")
  refused(c("compare", "none.rds", "--groups", "none.csv"), "none.rds is not there")
  expect_error(run_command(1), class = "crestline_error")
})

# A face as a file, thinned out, so that it is found quickly.
mesh_path_of_humface <- function() {
  file <- tempfile(fileext = ".ply")
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  write_mesh(Rvcg::vcgQEdecim(data$humface, tarface = 8000, silent = TRUE), file)
  file
}

test_that("two scans of one file name in two folders keep two ids", {
  dirs <- file.path(withr_tempdir(environment()), c("visit 1", "visit 2"))
  for (dir in dirs) {
    dir.create(dir)
    file.copy(mesh_path_of_humface(), file.path(dir, "anna.ply"))
  }
  found <- run("find", file.path(dirs, "anna.ply"))
  expect_equal(found$status, 0L)
  expect_equal(unique(read.csv(text = found$out)$specimen), c("visit 1/anna", "visit 2/anna"))
})

test_that("find says which scan failed, and its table has the numbers of find_landmarks()", {
  dir <- withr_tempdir(environment())
  file.copy(mesh_path_of_humface(), scan <- file.path(dir, "anna.ply"))
  writeLines("no mesh", bad <- file.path(dir, "bad.ply"))
  found <- run("find", scan, bad, "--out", out <- file.path(dir, "found.json"))
  expect_equal(found$status, 1L)
  expect_match(found$said, "bad.ply: ", all = FALSE)
  table <- jsonlite::fromJSON(out)
  own <- find_landmarks(read_specimen(scan))$placing
  expect_equal(table$landmark, own$landmark)
  expect_equal(table$x, own$x, tolerance = 1e-9)
  expect_equal(run("find", bad)$status, 2L)
})

test_that("page writes the page of a result, and a table may be a Parquet file", {
  skip_if_not_installed("htmltools")
  skip_if_not_installed("future")
  skip_if_not_installed("progressr")
  at <- ball_files(2)
  file <- function(...) file.path(at$dir, ...)
  expect_equal(run("fit", at$scans, "--scheme", at$scheme, "--out", file("results"))$status, 0L)
  kept <- list.files(file("results"), "[.]shape$", recursive = TRUE, full.names = TRUE)
  paged <- run("page", kept[1], "--out", file("page.html"))
  expect_equal(paged$status, 0L)
  html <- paste(readLines(file("page.html"), warn = FALSE), collapse = "")
  for (curve in c("ab", "bc")) expect_true(grepl(paste0(">", curve, "</td>"), html, fixed = TRUE))
  graded <- run("quality", file("results"), "--out", file("grades.parquet"))
  if (requireNamespace("nanoparquet", quietly = TRUE)) {
    expect_equal(graded$status, 0L)
    expect_equal(as.character(nanoparquet::read_parquet(file("grades.parquet"))$grade),
                 as.character(quality(read_batch(file("results")))$grade))
  } else {
    expect_equal(graded$status, 2L)
    expect_match(graded$said, "nanoparquet")
  }
})

test_that("scans go through fit, quality, homologise and compare", {
  skip_if_not_installed("future")
  skip_if_not_installed("progressr")
  at <- ball_files()
  writeLines("no mesh", file.path(at$scans, "s9.ply"))
  file <- function(...) file.path(at$dir, ...)
  fitted <- run("fit", at$scans, "--scheme", at$scheme, "--out", file("results"))
  expect_equal(fitted$status, 1L)
  expect_match(tail(fitted$said, 1), "4 measured, 1 failed")
  expect_match(tail(fitted$said, 2)[1], "^s9, reading: ")
  expect_equal(read.csv(file("results", "failures.csv"))$id, "s9")
  points <- read.csv(file("results", "points.csv"))
  expect_equal(unique(points$id), paste0("s", 1:4))
  kept <- read_batch(file("results"))
  expect_equal(points$x[points$id == "s2"], kept[["s2"]]$points$x)

  graded <- run("quality", file("results"), "--out", file("grades.json"))
  # The scan that failed is known to the folder, and tells here too.
  expect_equal(graded$status, 1L)
  expect_equal(jsonlite::fromJSON(file("grades.json"))$grade,
               as.character(quality(kept)$grade))

  slid <- run("homologise", file("results"), "--red=keep", "--out", file("points.csv"),
              "--sample", file("sample.rds"))
  expect_equal(slid$status, 1L)
  sample <- readRDS(file("sample.rds"))
  expect_equal(read.csv(file("points.csv"))$z, as.data.frame(sample)$z)

  write.csv(data.frame(scan = paste0("s", 1:4), site = c("x", "y", "x", "y")), file("g.csv"),
            row.names = FALSE)
  compared <- run("compare", file("sample.rds"), "--groups", file("g.csv"), "--id", "scan",
                  "--by", "site", "--level", "landmarks", "--seed", "2")
  expect_equal(compared$status, 0L)
  tests <- read.csv(text = compared$out)
  own <- suppressWarnings(compare_groups(sample, c(s1 = "x", s2 = "y", s3 = "x", s4 = "y"),
                                         "landmarks", seed = 2, progress = FALSE))
  expect_equal(tests$p_value, own$tests$p_value)
  column <- run("compare", file("sample.rds"), "--groups", file("g.csv"))
  expect_equal(column$status, 2L)
  expect_match(column$said, "has no column id, group; it has scan, site")
})

test_that("the script itself runs, from Python's subprocess too", {
  script <- file.path(system.file("exec", package = "crestline"), "crestline")
  skip_if_not(file.exists(script), "the package was loaded without its script")
  rscript <- file.path(R.home("bin"), "Rscript")
  ran <- suppressWarnings(system2(rscript, c(shQuote(script), "fit"), stdout = TRUE, stderr = TRUE))
  expect_equal(attr(ran, "status"), 2L)
  expect_match(paste(ran, collapse = " "), "crestline fit: it needs SCAN")
  python <- unname(Sys.which("python3"))
  skip_if_not(nzchar(python), "no Python here")
  code <- sprintf(paste0("import subprocess; p = subprocess.run([%s, %s, 'find', '--help'], ",
                         "capture_output=True, text=True); print(p.returncode, p.stdout[:14])"),
                  dQuote(rscript, FALSE), dQuote(script, FALSE))
  expect_equal(system2(python, c("-c", shQuote(code)), stdout = TRUE), "0 crestline find")
})
