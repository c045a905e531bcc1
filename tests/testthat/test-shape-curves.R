test_that("a ridge of a scheme is that of ridge_curve()", {
  face <- straight_ridge()
  shape <- fit_shape(face, ends_scheme(curve = "crest", kind = "ridge", radius = 6, width = 6),
                     progress = FALSE)
  alone <- curve_of(face, "a", "b", "ridge", radius = 6, width = 6, n = 9)
  expect_equal(unname(coords(shape, "curves")), unname(as.matrix(alone$points[c("x", "y", "z")])),
               tolerance = 1e-6)
  status <- status_of(shape, "crest")
  expect_equal(unlist(status[c("length", "strength", "se")]),
               unlist(alone[c("length", "strength", "se")]), tolerance = 1e-6)
  own <- shape$points$se[shape$points$level == "curves"]
  expect_equal(own[2:8], alone$points$se[2:8], tolerance = 1e-6)
})

test_that("side_of takes the ridge on that side of another curve", {
  face <- arched_ridges(3, 3.2)
  on <- function(side) {
    scheme <- ends_scheme(curve = c("arch", "middle"), kind = c("ridge", "plane"), radius = 3,
                          width = c(6, NA), side_of = c("middle", NA), side = c(side, NA))
    shape <- fit_shape(face, scheme, progress = FALSE)
    mean(coords(shape, "curves")[paste("arch", 4:6), "y"])
  }
  expect_gt(on("left"), 2)
  expect_lt(on("right"), -2)
})

test_that("keep_side takes the ridge on that side of a line between landmarks", {
  face <- arched_ridges(3, 3.2)
  face$landmarks <- rbind(face$landmarks, up = c(0, 5, 5.5), down = c(0, -5, 5.7))
  on <- function(towards) {
    landmarks <- data.frame(landmark = rownames(face$landmarks))
    curves <- data.frame(curve = "arch", from = "a", to = "b", kind = "ridge", radius = 3,
                         width = 6, n = 9, keep_side_from = "a", keep_side_to = "b",
                         keep_side_towards = towards)
    shape <- fit_shape(face, curve_scheme(landmarks, curves, name = "ends"), progress = FALSE)
    mean(coords(shape, "curves")[paste("arch", 4:6), "y"])
  }
  expect_gt(on("up"), 2)
  expect_lt(on("down"), -2)
})

test_that("a curve comes after the one whose side it keeps to", {
  curves <- data.frame(curve = c("p", "q", "r"), side_of = c("q", "r", NA))
  expect_equal(fitting_order(curves), c(3, 2, 1))
})

test_that("angle_limit holds cuts and reference paths near the surface's normal", {
  face <- straight_ridge()
  for (kind in c("plane", "ridge")) {
    scheme <- ends_scheme(curve = "crest", kind = kind, radius = 6, width = 6, angle_limit = 0)
    shape <- fit_shape(face, scheme, progress = FALSE)
    expect_true(status_of(shape, "crest")$ok)
    if (kind == "plane") expect_equal(attr(shape$paths$crest, "angle"), 0)
    expect_equal(is.na(status_of(shape, "crest")$strength), kind == "plane")
  }
})

test_that("outside the trusted part of the path strength does not count, whatever the pass", {
  face <- straight_ridge()
  for (passes in 1:2) {
    scheme <- ends_scheme(curve = "crest", kind = "ridge", radius = 6, width = 6, trust_from = 0.25,
                          trust_to = 0.75)
    expect_true(status_of(fit_shape(face, scheme, progress = FALSE,
                                    settings = ridge_settings(passes = passes)), "crest")$ok)
    curve <- ridge_curve(face, "a", "b", "ridge", 6, 6, 5,
                         settings = ridge_settings(error = FALSE, passes = passes),
                         trust = c(0.25, 0.75))
    at <- curve$coordinates[curve$surface$rows, ]
    share <- at$s / attr(curve$coordinates, "length")
    counted <- curve$surface$strength > 0
    # The shortest cuts to the landmarks change the path's length a little.
    trusted <- attr(curve$reference, "trusted") / attr(curve$reference, "length")
    expect_equal(trusted, c(0.25, 0.75), tolerance = 1e-3)
    expect_true(all(share[counted] >= trusted[1] & share[counted] <= trusted[2]))
    expect_gt(sum(counted), 50)
    expect_true(all(counted[abs(at$d) < 2 & abs(share - 0.5) < 0.2]))
  }
})

test_that("where a ridge cannot be estimated the shortest cut stands in, and says so", {
  face <- graph_specimen(quote(6 * exp(-v^2 / 50)), two_ends(c(-1, 1)))
  shape <- fit_shape(face, ends_scheme(curve = "crest", kind = "ridge", radius = 2, width = 1),
                     progress = FALSE)
  status <- status_of(shape, "crest")
  expect_true(status$ok)
  expect_match(status$reason, "the shortest cut instead", fixed = TRUE)
  expect_true(is.na(status$strength))
  plane <- fit_shape(face, ends_scheme(curve = "crest", kind = "plane"), progress = FALSE)
  expect_identical(coords(shape, "curves"), coords(plane, "curves"))
})

test_that("a rival path is seen in competing", {
  status <- function(left, right) {
    scheme <- ends_scheme(curve = "arch", kind = "ridge", radius = 3, width = 3)
    status_of(fit_shape(arched_ridges(left, right), scheme, progress = FALSE), "arch")
  }
  expect_gt(status(3, 3)$competing, 0.9)
  expect_lt(status(3, 1)$competing, status(3, 3)$competing)
})

test_that("without curvature the cut stands in, with the reason; no other error is caught", {
  face <- straight_ridge()
  scheme <- ends_scheme(curve = "crest", kind = "ridge", radius = 6, width = 6)
  scan <- prepare_scan(face, scheme, ridge_settings(), list(bridge = 0), 1L)
  row <- as.list(scheme$curves[1, ])
  scan$sources <- list("6" = function(vertices)
    crestline_abort("no good.", "Mend it.", "curvature"))
  cut <- curve_record(row_job(row, row$from, scan, list()))
  expect_equal(cut$reason, "the shortest cut instead: no good")
  expect_false(cut$determined)
  expect_s3_class(cut$path, "mesh_path")
  scan$sources <- list("6" = function(vertices) stop("not ours"))
  expect_error(curve_record(row_job(row, row$from, scan, list())), "not ours")
  row$from <- row$to
  expect_match(curve_record(row_job(row, row$from, scan, list()))$reason, "are the same point$")
})

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
  curve_scheme(scheme$landmarks, scheme$curves,
               pairs = scheme$pairs[scheme$pairs$level != "surface", ])
}
humface_specimen <- function() specimen(humface_scan(), humface_landmarks(), id = "humface")

beside <- function(specimen, name, shift) {
  surface_points(specimen$mesh, specimen$landmarks[name, , drop = FALSE] + shift)
}

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
  expect_true(all(c("mid-line lip left", "mid-line lip right") %in%
                  names(refitted_paths(fitting, bare))))
  expect_match(fitting$fits[["cheek-eye right"]]$reason, "mirror image of tL")
  expect_equal(refitted_paths(fitting, bare), whole_paths(bare, scheme), tolerance = 1e-6)
})

test_that("a curve that keeps to the side of another is touched with it", {
  curves <- data.frame(curve = c("one", "two", "three"), from = c("a", "b", "c"),
                       to = c("d", "c", "d"), kind = "ridge", radius = 1, width = 1, n = 5,
                       side_of = c(NA, "one", "two"), side = c(NA, "left", "left"))
  curves <- curve_scheme(data.frame(landmark = letters[1:4]), curves)$curves
  whole <- rep(list(list(path = 1)), 3)
  expect_equal(touched_curves(curves, "a", whole), c(TRUE, TRUE, TRUE))
  expect_equal(touched_curves(curves, "b", whole), c(FALSE, TRUE, TRUE))
  expect_equal(touched_curves(curves, "x", whole), c(FALSE, FALSE, FALSE))
  expect_equal(touched_curves(curves, NULL, whole), c(TRUE, TRUE, TRUE))
})
