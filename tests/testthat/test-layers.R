# A file calls only floors above its own, and no files call each other round in a circle.

# The floors, first to last. A file's floor is the first word of its name.
floors <- c("conditions", "text", "files", "geometry", "checks", "session", "settings",
            "mesh", "landmarks", "specimen", "curvature", "path", "draw", "ridge", "scheme",
            "shape", "placing", "template", "sample", "analysis", "study", "norms", "plot",
            "report", "command", "app", "crestline")

# Circles of files that stay, each with its reason.
circles <- list(
  # A part of an alignment is an alignment anew; what is missing is estimated by aligning.
  c("analysis-align.R", "analysis-aligned.R", "analysis-arrays.R", "analysis-missing.R")
)

# Calls to a later floor that stay, each with its reason.
exceptions <- character()

graph <- function() {
  dir <- testthat::test_path("..", "..", "R")
  testthat::skip_if_not(file.exists(file.path(dir, "conditions.R")), "sources not here")
  testthat::skip_if_not_installed("codetools")
  sources_of(dir)
}

test_that("nothing is defined twice", {
  defined <- graph()
  expect_equal(names(defined)[duplicated(names(defined))], character())
})

test_that("a file calls only its own floor and those above", {
  calls <- calls_between(graph())
  floor <- function(file) match(sub("[-.].*$", "", file), floors)
  unknown <- unique(c(calls$from_file[is.na(floor(calls$from_file))],
                      calls$to_file[is.na(floor(calls$to_file))]))
  expect_equal(unknown, character())
  up <- calls[which(floor(calls$from_file) < floor(calls$to_file)), ]
  found <- sprintf("%s:%s -> %s:%s", up$from_file, up$from, up$to_file, up$to)
  expect_equal(setdiff(found, exceptions), character())
  expect_equal(setdiff(exceptions, found), character())
})

test_that("no files call each other round in a circle, but for those that are listed", {
  found <- file_cycles(calls_between(graph()))
  known <- lapply(circles, sort)
  new <- Filter(function(one) !list(one) %in% known, found)
  expect_equal(vapply(new, paste, "", collapse = " <-> "), character())
  expect_true(all(lengths(found) <= 5))
})

test_that("no function is handed the call that an error names: conditions.R finds it", {
  functions <- Filter(function(one) is_function(one$value), graph())
  takes_call <- vapply(functions, function(one) "call" %in% names(one$value[[2]]), NA)
  expect_equal(names(functions)[takes_call], "crestline_abort")
})
