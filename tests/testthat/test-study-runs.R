# The study of section 5.2: known distances, the same answer however it is run.

fast <- ridge_settings(error = FALSE)

test_that("a straight ridge is found exactly, a bent one nearly", {
  study <- ridge_study(n = 1, a = c(0, 0.25), b = 2, noise = 0)
  expect_equal(nrow(study), 2)
  expect_true(all(is.na(study$error)) && all(study$converged) && all(study$determined))
  expect_lt(max(study$distance[study$a == 0]), 0.01)
  expect_lt(max(study$distance[study$a == 0.25]), 0.4)
})

test_that("two passes come nearer on clean surfaces", {
  study <- ridge_study(n = 1, a = 0.25, b = c(1, 2), noise = 0,
                       study = study_settings(passes = 1:2))
  once <- study$distance[study$passes == 1]
  twice <- study$distance[study$passes == 2]
  expect_true(all(twice < 0.6 * once))
})

test_that("a blunt ridge under noise is flagged, a sharp one is not", {
  study <- ridge_study(n = 2, a = 0.25, b = c(0.25, 2), noise = 0.01)
  expect_false(any(study$determined[study$b == 0.25]))
  expect_true(all(study$determined[study$b == 2]))
})

test_that("an estimate that fails is a row that says why", {
  study <- ridge_study(n = 1, a = 0, b = 1, noise = 0, study = study_settings(radius = 0.01))
  expect_true(is.na(study$distance) && is.na(study$determined))
  expect_match(study$error, "radius")
})

test_that("distances and coverage of a known estimate are exact", {
  # A line beside the straight ridge by 0.1 = 2 spacings.
  beside <- function(specimen, radius, width, n) cbind(0.1, seq(-0.95, 0.95, length.out = 7), 0)
  study <- ridge_study(list(beside = beside), n = 1, a = 0, b = 1, noise = 0)
  expect_equal(study$distance, 2)
  expect_equal(study$distance_curvature, 2)
  expect_true(is.na(study$covered) && is.na(study$se) && is.na(study$determined))
  found <- list(at = cbind(x = 0.1, y = seq(-0.9, 0.9, length.out = 6), z = 0),
                error = c(1, 0.051, 0.049, 0.051, 0.049, 1))
  expect_equal(share_covered(found, cbind(x = 0, y = c(-1, 1), z = 0)), 0.5)
})

test_that("points at equal distances along a line split it evenly", {
  line <- cbind(x = c(0, 0, 3, 3), y = c(0, 4, 4, 4), z = 1)
  expect_equal(equally_along(line, 8),
               cbind(x = c(0, 0, 0, 0, 0, 1, 2, 3), y = c(0:4, 4, 4, 4), z = 1))
})

test_that("every combination of factors and methods is a row, with its own surface", {
  methods <- list(once = fast, stiff = ridge_settings(lambda = 1e-2, error = FALSE))
  study <- ridge_study(methods, n = 2, a = 0.25, b = 2, noise = 0.01,
                       study = study_settings(spacing = c(0.1, 0.05), radius = c(0.25, 0.3),
                                              correlation = c(0, 2)))
  expect_equal(nrow(study), 2 * 2 * 2 * 2 * 2)
  expect_false(anyDuplicated(study[c("spacing", "radius", "correlation", "seed", "method")]) > 0)
  expect_equal(length(unique(study$distance)), nrow(study))
  expect_true(all(is.na(study$covered)) && all(study$seconds >= 0))
  alone <- ridge_study(fast, n = 2, a = 0.25, b = 2, noise = 0.01,
                       study = study_settings(spacing = 0.1, radius = 0.3, correlation = 2))
  same <- study[study$method == "once" & study$spacing == 0.1 & study$radius == 0.3 &
                study$correlation == 2, ]
  expect_equal(alone$distance, same$distance)
})

test_that("results do not depend on blocks or workers", {
  skip_if_not_installed("future")
  skip_if_not_installed("progressr")
  once <- function(...) {
    study <- ridge_study(fast, n = 5, a = 0.25, b = 2, noise = 0.01, ...)
    study[setdiff(names(study), "seconds")]
  }
  whole <- once()
  expect_identical(once(block = 2), whole)
  skip_on_cran() # two more processes
  before <- future::plan("multisession", workers = 2)
  on.exit(future::plan(before))
  expect_identical(once(block = 1), whole)
})

test_that("a study that was cut short goes on where it was, and only with the same arguments", {
  dir <- tempfile("study")
  on.exit(unlink(dir, recursive = TRUE))
  run <- function(...) {
    ridge_study(fast, n = 4, a = 0.25, b = 2, noise = 0, dir = dir, ...,
                study = study_settings(block = 1))
  }
  whole <- run()
  files <- list.files(dir, full.names = TRUE)
  expect_length(files, 4)
  unlink(files[1])
  writeLines("cut short", files[2])
  again <- run()
  # Processor times tell which were run again.
  expect_equal(again[names(again) != "seconds"], whole[names(whole) != "seconds"])
  expect_gte(sum(again$seconds == whole$seconds), 2)
  expect_length(list.files(dir), 4)
  other <- run(points = 11)
  expect_length(list.files(dir), 8)
  expect_false(identical(other$distance, whole$distance))
})

test_that("methods that are none are refused", {
  expect_error(ridge_study(settings = list()), "ridge_settings", class = "crestline_error")
  expect_error(ridge_study(settings = list(fast)), "names", class = "crestline_error")
  expect_error(ridge_study(settings = list(a = "crestline")), "function", class = "crestline_error")
  expect_error(ridge_study(fast, n = 1, dir = 3), "folder", class = "crestline_error")
})

test_that("a grid that makes no study is refused before any work", {
  run <- function(...) studying(fast, n = 1, dir = file.path(tempdir(), "no study"), ...)
  for (value in list(Inf, NA, NaN, 0, -1, 5, 1e-9, "a", NULL, numeric(), c(0.05, Inf), list(0.05)))
    {
    expect_crestline_error(run(spacing = value), "`spacing`")
  }
  for (name in c("a", "b", "noise", "landmark_error", "correlation", "passes", "radius", "width",
                 "points", "jitter", "end")) {
    for (value in list(Inf, NA, "a", -1e9, 1e300)) {
      expect_crestline_error(do.call(run, stats::setNames(list(value), name)),
                             paste0("`", name, "`"))
    }
  }
  expect_crestline_error(run(passes = 1.5), "`passes`")
  expect_crestline_error(run(radius = 0), "`radius`")
  expect_crestline_error(run(strange = 1), "strange")
  expect_crestline_error(ridge_study(fast, n = 1e6, a = 1:3 / 10, b = 1, noise = 0), "curves")
  expect_crestline_error(run(spacing = 0.01, largest = 1000), "`spacing`")
  expect_false(dir.exists(file.path(tempdir(), "no study")))
})

test_that("two methods of one text and another constant are two methods in a folder", {
  dir <- tempfile("study")
  on.exit(unlink(dir, recursive = TRUE))
  beside <- function(k) function(specimen, radius, width, n) {
    cbind(k, seq(-0.95, 0.95, length.out = n), 0)
  }
  run <- function(k) {
    ridge_study(list(beside = beside(k)), n = 1, a = 0, b = 1, noise = 0, dir = dir)$distance
  }
  expect_equal(c(run(0.1), run(0.2), run(0.1)), c(2, 4, 2))
  expect_length(list.files(dir), 2)
})

test_that("a study whose results cannot be written is a study still", {
  dir <- tempfile("study")
  on.exit(unlink(dir, recursive = TRUE))
  run <- function() ridge_study(fast, n = 1, a = 0, b = 1, noise = 0, dir = dir,
                                study = study_settings(spacing = 0.1))
  first <- run()
  file <- list.files(dir, full.names = TRUE)
  unlink(file)
  dir.create(file)
  expect_warning(again <- run(), "1 of 1 block not kept", class = "crestline_keeping_warning")
  expect_equal(again$distance, first$distance)
  lost <- lost_block(list(cell = list(a = 0), seeds = 1:2), list(one = 1),
                     list(message = "gone\nfor good"))
  expect_identical(vapply(lost, `[[`, "", "error"), rep("the worker died: gone", 2))
})
