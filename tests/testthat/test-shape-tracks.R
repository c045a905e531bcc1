# Two ridges part at a and meet at b; landmark c, on the left, fixes the frame.
arches_specimen <- function(left, right, seed) {
  made <- suppressWarnings(arched_ridges(left, right, spacing = 1.2, seed = seed))
  off <- cbind(0, 9, 9^2 / 10 + left * exp(-(9 - 5)^2 / 3))
  marks <- rbind(made$landmarks, c = off[1, ])
  suppressWarnings(specimen(made$mesh, marks, id = paste("arches", seed), outward = "keep",
                            tolerance = 0.25))
}

arches_scheme <- curve_scheme(
  data.frame(landmark = c("a", "b", "c"), x = c(-13.5, 13.5, 0), y = c(0, 0, 9), z = c(0, 0, 8)),
  data.frame(curve = "arch", from = "a", to = "b", kind = "ridge", radius = 3, width = 4, n = 9),
  name = "arches"
)

fit_arches <- function(specimen, scheme = arches_scheme, ...) {
  suppressWarnings(fit_shape(specimen, scheme, ridge_settings(error = FALSE),
                             progress = FALSE, ...))
}

right_ones <- lapply(1:4, function(seed) arches_specimen(3, 2, seed))
shapes <- lapply(right_ones, fit_arches)
learnt <- learn_tracks(shapes, fewest = 3, places = 5)
middle_of <- function(shape) coords(shape)[5, "y"]

test_that("a learnt track lies on the curves, in the frame of the scheme's landmarks", {
  track <- as.data.frame(learnt, "tracks")
  expect_identical(track$curve, rep("arch", 5))
  expect_equal(track$s, 1:5 / 6)
  across <- as.matrix(track[c("across_x", "across_y", "across_z")])
  expect_equal(rowSums(across^2), rep(1, 5))
  # In the middle the crest runs along u, half-way between the ends.
  middle <- stats::median(vapply(shapes, middle_of, 0))
  expect_equal(track$y[3] * 27, middle, tolerance = 0.1)
  expect_equal(track$x[3], 0.5, tolerance = 0.02)
  expect_lt(abs(across[3, 1]), 0.1)
  # Four equal specimens: the least spread, a tenth of the radius.
  expect_equal(track$spread * 27, rep(0.3, 5), tolerance = 0.3)
  expect_true(all(vapply(shapes, function(x) fit_arches(x$specimen, learnt)$checks$track[4], 0) <
                  4))
  expect_match(paste(capture.output(print(learnt)), collapse = " "), "expected tracks: of 1 curve")
})

test_that("a stronger ridge elsewhere is taken without a track only, and is amber then", {
  other <- arches_specimen(2.4, 2.5, 9)
  expect_lt(middle_of(fit_arches(other)), -4)
  with_track <- fit_arches(other, learnt)
  expect_gt(middle_of(with_track), 4)
  drawn <- fit_arches(other, learnt, curves = list(arch = coords(fit_arches(other))))
  graded <- as.data.frame(quality(drawn))
  graded <- graded[graded$level == "curves", ]
  expect_gt(graded$track, 4)
  expect_equal(as.character(graded$grade), "amber")
  expect_match(graded$why, "leaves its expected track by [0-9.]+ spreads")
  expect_lt(quality(with_track)$track[4], 4)
  # One that is stronger by far prevails, and is amber.
  clear <- fit_arches(arches_specimen(2.4, 2.8, 9), learnt)
  expect_lt(middle_of(clear), -4)
  expect_gt(quality(clear)$track[4], 4)
})

test_that("tracks of other objects are said and not used", {
  away <- c(7, 5, 4.5, 1, NA)
  named <- list(curves = data.frame(curve = c("brow", "lip", "nose", "chin", "ear")))
  expect_identical(foreign_tracks(named, away), list(off = c("brow", "lip", "nose"), of = 4L))
  expect_null(foreign_tracks(named, c(7, 5, 4, 1, NA))) # too few
  expect_null(foreign_tracks(named, c(away, rep(1, 9))))
  expect_null(foreign_tracks(named, NA * away))
  # Three names for one curve, whose track is of objects with the arch on the other side
  rows <- arches_scheme$curves[c(1, 1, 1), ]
  rows$curve <- c("arch", "bow", "vault")
  three <- curve_scheme(arches_scheme$landmarks, rows, name = "arches")
  turned <- lapply(1:3, function(seed) fit_arches(arches_specimen(2, 3, seed), three))
  foreign <- learn_tracks(turned, fewest = 3, places = 5)
  fit <- function(scheme) {
    fit_shape(right_ones[[1]], scheme, ridge_settings(error = FALSE), progress = FALSE)
  }
  plain <- fit(three)
  expect_warning(shape <- fit(foreign), "3 of 3 curves leave .* not used: arch, bow, vault",
                 class = "crestline_foreign_tracks")
  expect_identical(shape$points, plain$points)
  expect_true(all(quality(shape)$track[shape$status$level == "curves"] > 4))
  expect_no_warning(fit(learn_tracks(lapply(right_ones[1:3], fit_arches, three), fewest = 3)),
                    class = "crestline_foreign_tracks")
})

test_that("a scheme that grows fits curves with tracks anew: they depend on all curves", {
  # One curve alone does not show that its track is of other objects; three do.
  rows <- arches_scheme$curves[c(1, 1, 1), ]
  rows$curve <- c("arch", "bow", "vault")
  three <- curve_scheme(arches_scheme$landmarks, rows, name = "arches")
  turned <- lapply(1:3, function(seed) fit_arches(arches_specimen(2, 3, seed), three))
  foreign <- learn_tracks(turned, fewest = 3, places = 5)
  alone <- curve_scheme(foreign$landmarks, foreign$curves[1, ], name = "arches",
                        tracks = foreign$tracks[foreign$tracks$curve == "arch", ])
  begin <- function(scheme) {
    begin_fitting(right_ones[[1]], scheme, ridge_settings(error = FALSE), 0, 1)
  }
  small <- refit_curves(begin(alone), right_ones[[1]])
  grown <- suppressWarnings(grow_fitting(small, begin(foreign)))
  expect_identical(grown$refitted, c("arch", "bow", "vault"))
  anew <- suppressWarnings(refit_curves(begin(foreign), right_ones[[1]]))
  expect_identical(grown$fits, anew$fits)
  expect_false(identical(grown$fits$arch, small$fits$arch))
  # Curves without a track stay as they are.
  plain <- curve_scheme(arches_scheme$landmarks, rows[1:2, ], name = "arches")
  before <- refit_curves(begin(plain), right_ones[[1]])
  after <- grow_fitting(before, begin(three))
  expect_identical(after$refitted, "vault")
  expect_identical(after$fits[1:2], before$fits)
})

test_that("tracks are the same in another pose and unit, and one wrong curve does no harm", {
  turn <- rotation_about(c(0.3, -0.7, 1))
  moved <- lapply(right_ones, function(one) {
    mesh <- one$mesh
    mesh$vb[1:3, ] <- (turn %*% mesh$vb[1:3, ] + c(40, -7, 3)) / 1000
    marks <- sweep(one$landmarks %*% t(turn), 2, c(40, -7, 3), `+`) / 1000
    fit_arches(specimen(mesh[c("vb", "it")] |> structure(class = "mesh3d"), marks, id = one$id,
                        outward = "keep", tolerance = 0.001), unit = 1000)
  })
  again <- learn_tracks(moved, fewest = 3, places = 5)
  expect_equal(again$tracks, learnt$tracks, tolerance = 1e-4)
  expect_equal(again$curves$radius, 3)
  wrong <- fit_arches(arches_specimen(2, 3, 11))
  expect_lt(middle_of(wrong), -4)
  more <- learn_tracks(c(shapes, list(wrong)), fewest = 3, places = 5)
  expect_equal(more$tracks[c("x", "y")], learnt$tracks[c("x", "y")], tolerance = 0.02)
})

test_that("without tracks a scheme is what it was, and tracks are read again from its folder", {
  expect_identical(scheme_hash(arches_scheme), {
    old <- arches_scheme
    old$tracks <- NULL
    scheme_hash(old)
  })
  expect_false(scheme_hash(learnt) == scheme_hash(arches_scheme))
  expect_true(is.na(shapes[[1]]$checks$track[4]))
  dir <- tempfile()
  write_scheme(learnt, dir)
  expect_equal(read_scheme(dir, "arches"), learnt)
  expect_identical(unname(touched_curves(learnt$curves, "c",
                                         list(arch = list(path = 1, followed = NA)), "arch")), TRUE)
  expect_identical(unname(touched_curves(learnt$curves, "c",
                                         list(arch = list(path = 1, followed = NA)))), FALSE)
})

test_that("what cannot be learnt from is refused", {
  expect_crestline_error(learn_tracks(shapes), "no ridge or valley is there on 5 of the 4 shapes")
  light <- shapes
  light[[2]]$specimen <- NULL
  expect_crestline_error(learn_tracks(light, 3), "does not keep its specimen")
  bare <- arches_scheme
  bare$landmarks[1, "x"] <- NA
  blind <- shapes
  for (i in seq_along(blind)) blind[[i]]$scheme <- bare
  expect_crestline_error(learn_tracks(blind, 3), "does not have the places of three landmarks")
  other <- leaf_scheme()
  mixed <- shapes
  mixed[[2]]$scheme <- other
  mixed[[2]]$points <- cbind(other$points[c("level", "part", "point")], x = 0, y = 0, z = 0,
                             face = 1L, w1 = 1, w2 = 0, w3 = 0, se = NA_real_)
  expect_crestline_error(learn_tracks(mixed, 3), "is not that of the first")
  wrong <- learnt$tracks
  wrong$curve[1] <- "arc"
  expect_crestline_error(curve_scheme(learnt$landmarks, learnt$curves, tracks = wrong),
                         c("arc", "arch"))
  wrong <- learnt$tracks
  wrong$place[2] <- 1L
  expect_crestline_error(curve_scheme(learnt$landmarks, learnt$curves, tracks = wrong),
                         "is there twice")
})
