# The paths of curves that are fitted anew, and those of a whole fit of the same specimen.
refitted_paths <- function(fitting, specimen) {
  found <- Filter(function(fit) !is.null(fit$path), fitting$fits)
  lapply(found, function(fit) as.matrix(unbridged_path(fit$path, specimen)[1:4]))
}
whole_paths <- function(specimen, scheme) {
  paths <- fit_shape(specimen, scheme, quick_error(), progress = FALSE)$paths
  lapply(Filter(Negate(is.null), paths), function(path) as.matrix(path[1:4]))
}
quick_error <- function() ridge_settings(error = FALSE)
without_patches <- function(scheme) {
  curve_scheme(scheme$landmarks, scheme$curves, pairs = scheme$pairs[scheme$pairs$level != "surface", ])
}
humface_specimen <- function() specimen(humface_scan(), humface_landmarks(), id = "humface")

beside <- function(specimen, name, shift) surface_points(specimen$mesh, specimen$landmarks[name, , drop = FALSE] + shift)

test_that("after a move only what it touches is fitted, and all is as a whole fit has it", {
  face <- humface_specimen()
  scheme <- without_patches(face_scheme())
  fitting <- refit_curves(begin_fitting(face, scheme, quick_error(), 0.2, 1), face)
  expect_equal(refitted_paths(fitting, face), whole_paths(face, scheme), tolerance = 1e-6)
  expect_length(fitting$refitted, 40)
  for (name in c("chL", "enL", "exL")) {  # ends, the distance that shares are of, a side
    moved <- move_landmark(face, name, beside(face, name, c(2, 1, 1)))
    again <- refit_curves(fitting, moved, name)
    expect_equal(refitted_paths(again, moved), whole_paths(moved, scheme), tolerance = 1e-6)
    expect_lte(length(again$refitted), 6)
  }
  back <- refit_curves(again, face, name)
  expect_equal(refitted_paths(back, face), refitted_paths(fitting, face), tolerance = 1e-6)
})

test_that("curves come with their landmarks, and are followed towards those that are not there", {
  face <- humface_specimen()
  scheme <- without_patches(face_scheme())
  bare <- without_landmarks(face, scheme)
  fitting <- refit_curves(begin_fitting(bare, scheme, quick_error(), 0.2, 1), bare)
  expect_length(refitted_paths(fitting, bare), 0)
  for (name in c("st", "chL", "chR", "enL", "enR", "exL", "exR", "tL")) {
    bare <- move_landmark(bare, name, landmark_point(face, name))
    fitting <- refit_curves(fitting, bare, name)
  }
  expect_true(all(c("mid-line lip left", "mid-line lip right") %in% names(refitted_paths(fitting, bare))))
  expect_match(fitting$fits[["cheek-eye right"]]$reason, "mirror image of tL")
  expect_equal(refitted_paths(fitting, bare), whole_paths(bare, scheme), tolerance = 1e-6)
})

test_that("a curve that keeps to the side of another is touched with it", {
  curves <- data.frame(curve = c("one", "two", "three"), from = c("a", "b", "c"), to = c("d", "c", "d"), kind = "ridge",
                       radius = 1, width = 1, n = 5, side_of = c(NA, "one", "two"), side = c(NA, "left", "left"))
  curves <- curve_scheme(data.frame(landmark = letters[1:4]), curves)$curves
  whole <- rep(list(list(path = 1)), 3)
  expect_equal(touched_curves(curves, "a", whole), c(TRUE, TRUE, TRUE))
  expect_equal(touched_curves(curves, "b", whole), c(FALSE, TRUE, TRUE))
  expect_equal(touched_curves(curves, "x", whole), c(FALSE, FALSE, FALSE))
  expect_equal(touched_curves(curves, NULL, whole), c(TRUE, TRUE, TRUE))
})
