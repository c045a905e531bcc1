# The ball's quad with its left and right curves cut off below, and three landmarks of the middle;
# symmetric about x = 0.
mirror_landmarks <- function() {
  middle <- function(lat) 50 * c(0, sin(lat), cos(lat))
  rbind(quad_corners(), low = middle(-0.4), mid = middle(0.1), high = middle(0.6))
}

mirror_scheme <- function(share = 0.5) {
  quad_scheme(function(tables) {
    tables$landmarks <- data.frame(landmark = rownames(mirror_landmarks()))
    tables$curves[3:4, c("cut_share", "cut_from", "cut_to")] <- data.frame(share, "d", "c")
    tables$pairs <- data.frame(level = c("landmarks", "landmarks", "curves"),
                               left = c("a", "d", "left"), right = c("b", "c", "right"))
    tables[c("landmarks", "curves", "pairs")]
  })
}

without <- function(landmarks, names) {
  landmarks[rownames(landmarks) %in% names, ] <- NA
  landmarks
}

mirror_shape <- function(missing = character(), keep = function(xyz) TRUE, share = 0.5, ...) {
  crop <- function(mesh) {
    centre <- apply(mesh$it, 2, function(f) rowMeans(mesh$vb[1:3, f]))
    mesh$it <- mesh$it[, keep(centre), drop = FALSE]
    mesh
  }
  fitting(quad_specimen(crop, without(mirror_landmarks(), missing)), mirror_scheme(share),
          progress = FALSE, ...)
}

curve_at <- function(shape, name) {
  coords(shape, "curves")[shape$points$part[shape$points$level == "curves"] == name, ]
}

test_that("the mirror plane comes from pairs, else from the middle, else there is none", {
  pairs <- mirror_scheme()$pairs
  face <- quad_specimen(landmarks = mirror_landmarks())
  for (missing in list(character(), "a", c("a", "c"), c("low", "mid", "high"))) {
    plane <- mirror_plane(replace(face, "landmarks", list(without(mirror_landmarks(), missing))),
                          pairs)
    expect_equal(abs(plane$normal), c(1, 0, 0), tolerance = 1e-12)
    expect_equal(plane$offset, 0, tolerance = 1e-12)
  }
  face$landmarks <- without(mirror_landmarks(), c("a", "c", "mid"))
  expect_null(mirror_plane(face, pairs))
  along <- rbind(low = c(0, -20, 0), mid = c(0.4, 0, 0.5), high = c(0, 20, 0),
                 more = c(0.5, 1, -0.4))
  face$landmarks <- rbind(without(quad_corners(), c("a", "c")), along)
  expect_null(mirror_plane(face, pairs))
})

test_that("without one of the pair that shares are of, the mirror plane gives the length", {
  whole <- mirror_shape()
  half <- mirror_shape(c("b", "c"))
  expect_equal(status_of(half, "left")$length, status_of(whole, "left")$length, tolerance = 1e-9)
  of_left <- function(shape, name) shape$checks[shape$checks$part == "left", name]
  expect_equal(c(of_left(whole, "guessed"), of_left(half, "guessed")), c(FALSE, TRUE))
  expect_equal(c(of_left(whole, "cut"), of_left(mirror_shape(share = 1e3), "cut") < 1), c(1, 1))
  expect_match(status_of(half, "left")$reason,
               "c is missing: cut by the distance of its pair from the mirror plane", fixed = TRUE)
  expect_equal(curve_at(half, "left"), curve_at(whole, "left"), tolerance = 1e-9)
  lost <- mirror_shape(c("b", "c", "low"))
  expect_match(status_of(lost, "left")$reason, "c is missing: where to cut it is not known",
               fixed = TRUE)
  expect_false(status_of(lost, "left")$ok)
})

test_that("a far landmark that is missing is made up for by the mirror image of its pair", {
  whole <- mirror_shape()
  shape <- mirror_shape("a")
  expect_lte(max(abs(curve_at(shape, "left") - curve_at(whole, "left"))), 0.05)
  expect_true(status_of(shape, "left")$ok)
  expect_equal(shape$checks$guessed[shape$checks$part %in% c("left", "right", "top")],
               c(NA, TRUE, FALSE))
  expect_match(status_of(shape, "left")$reason,
               "landmark a is missing .*: followed towards the mirror image of b")
  expect_identical(curve_at(shape, "right"), curve_at(whole, "right"))
  none <- mirror_shape(c("a", "b"))
  expect_match(status_of(none, "left")$reason, "landmark a is missing", fixed = TRUE)
  expect_equal(sum(is.na(curve_at(none, "left")[, "x"])), 4)
})

test_that("a curve that the mesh's edge ends keeps its places to there, costs no other", {
  whole <- mirror_shape()
  near <- function(xyz, limit) xyz[1, ] > -2 | xyz[2, ] > limit
  shape <- mirror_shape("a", function(xyz) near(xyz, 2))
  gone <- is.na(curve_at(shape, "left")[, 1])
  expect_equal(unname(gone), unname(curve_at(whole, "left")[, "y"] < 2))
  expect_lte(max(abs((curve_at(shape, "left") - curve_at(whole, "left"))[!gone, ])), 0.1)
  expect_match(status_of(shape, "left")$reason, "it ends after .* of .*: [1-3] of 5 points missing")
  expect_false(status_of(shape, "left")$ok)
  expect_equal(curve_at(shape, "right"), curve_at(whole, "right"), tolerance = 1e-9)
  short <- mirror_shape("a", function(xyz) near(xyz, 2), cut_scale = 0.5)
  expect_false(anyNA(curve_at(short, "left")))
})

test_that("a landmark with co-ordinates off the mesh gives the direction", {
  keep <- function(xyz) xyz[1, ] > -2 | xyz[2, ] > 2
  whole <- mirror_shape()
  specimen <- quad_specimen(function(mesh) {
    mesh$it <- mesh$it[, keep(apply(mesh$it, 2, function(f) rowMeans(mesh$vb[1:3, f])))]
    mesh
  }, without(mirror_landmarks(), "a"))
  specimen$landmarks["a", ] <- mirror_landmarks()["a", ]
  shape <- fit_shape(specimen, mirror_scheme(), progress = FALSE)
  gone <- is.na(curve_at(shape, "left")[, 1])
  expect_true(any(gone) && sum(!gone) >= 2)
  expect_lte(max(abs((curve_at(shape, "left") - curve_at(whole, "left"))[!gone, ])), 0.1)
  expect_match(status_of(shape, "left")$reason, "followed towards a as far as the mesh goes",
               fixed = TRUE)
})

test_that("a curve of which the mesh has hardly anything is missing", {
  shape <- mirror_shape("a", function(xyz) xyz[1, ] > -2 | xyz[2, ] > 16)
  expect_match(status_of(shape, "left")$reason, "it ends after .*: 4 of 5 points missing")
  expect_true(is.na(status_of(shape, "left")$length))
})

test_that("different `cut_scale`s are told, curves that were merely short are not", {
  whole <- mirror_shape()
  other <- mirror_shape(cut_scale = 0.5)
  other$id <- "other"
  expect_equal(asked_cut_scale(whole), 1)
  expect_equal(asked_cut_scale(other), 0.5)
  long <- mirror_shape(share = 0.9)
  expect_lt(long$checks$cut[long$checks$part == "left"], 0.9)
  expect_equal(asked_cut_scale(long), 1)
  expect_true(is.na(asked_cut_scale(quad_shape())))
  expect_warning(curve_distance(whole, other), "other by 0.5", class = "crestline_cut_scale")
  expect_warning(try(homologise(list(whole, other), rounds = 1, progress = FALSE), silent = TRUE),
                 "cut_scale = 0.5", class = "crestline_cut_scale")
  expect_no_warning(curve_distance(whole, whole))
})
