# Found landmarks are never mixed with placed ones unasked.

# The jobs of three meshes, of which some have landmarks, with a template that is made up.
jobs_with <- function(bare, found = NULL) {
  balls <- batch_specimens()
  for (i in bare) balls[[i]]$landmarks <- balls[[i]]$landmarks[0, ]
  template <- structure(list(id = "ball", specimen = balls[[1]], landmarks = quad_corners()),
                        class = "landmark_template")
  with_finder(batch_jobs(balls, NULL, list()), NULL, template, 0, edge_scheme(), found)
}

test_that("landmarks are found where none of the meshes has any, or where that is asked for", {
  has <- function(jobs, what) vapply(jobs, function(job) !is.null(job[[what]]), NA,
                                     USE.NAMES = FALSE)
  expect_identical(has(jobs_with(1:3), "finder"), c(TRUE, TRUE, TRUE))
  expect_identical(has(jobs_with(2), "finder"), c(FALSE, FALSE, FALSE))
  expect_identical(has(jobs_with(2), "refusal"), c(FALSE, TRUE, FALSE))
  expect_identical(has(jobs_with(2, TRUE), "finder"), c(FALSE, TRUE, FALSE))
  expect_identical(has(jobs_with(1:3, FALSE), "refusal"), c(TRUE, TRUE, TRUE))
  expect_identical(has(jobs_with(integer()), "refusal"), c(FALSE, FALSE, FALSE))
  expect_crestline_error(jobs_with(2, NA), "`found`")
  expect_crestline_error(jobs_with(2, "yes"), "`found`")
})

test_that("a mesh without a landmark file among others with one is a failure that says what to do",
          {
  skip_without_futures()
  dir <- batch_folder()
  on.exit(unlink(dir, recursive = TRUE))
  unlink(file.path(dir, "ball 2.csv"))
  failed <- failures(fit_shapes(meshes_in(dir), edge_scheme()))
  expect_identical(failed$id, "ball 2")
  expect_match(failed$message, "it has no landmarks, but 2 others of the batch have")
  expect_match(failed$remedy, "ball 2\\.\\*.*found = TRUE")
})

test_that("a batch and its quality tell of which specimens landmarks were found", {
  skip_without_futures()
  shapes <- lapply(batch_specimens(), fit_shape, edge_scheme(), progress = FALSE)
  shapes[[2]]$placing <- data.frame(landmark = "a", state = "found")
  shapes[[3]]$placing <- data.frame(landmark = "a", state = "placed")
  batch <- new_shape_batch(stats::setNames(shapes, paste("ball", 1:3)))
  expect_output(print(batch),
                "1 specimen: landmarks found by the template, not placed by hand: ball 2")
  expect_identical(summary(batch)$landmarks, c("placed", "found", "placed"))
  expect_identical(summary(quality(batch))$landmarks, c("placed", "found", "placed"))
  expect_output(print(quality(batch)), "not placed by hand, of 1 specimen: ball 2")
  expect_false(any(grepl("by hand", capture.output(print(quality(shapes[c(1, 3)]))))))
})
