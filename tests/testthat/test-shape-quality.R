# The ball of helper-shape.R, its four curves and patch, whole and spoiled.

grade_in <- function(graded, part, level = "curves") {
  as.character(graded$grade[graded$part == part & graded$level == level])
}
why_in <- function(graded, part, level = "curves") {
  graded$why[graded$part == part & graded$level == level]
}

# The ball without the vertices within `radius` of a place.
without_disc <- function(at, radius) {
  function(mesh) {
    gone <- sqrt(colSums((mesh$vb[1:3, ] - at)^2)) < radius
    mesh$it <- mesh$it[, colSums(matrix(gone[mesh$it], 3)) == 0]
    mesh
  }
}

spoiled_shape <- function(change, ...) {
  fitting(quad_specimen(change), quad_scheme(), ..., progress = FALSE)
}

middle_of <- function(shape, curve) {
  at <- coords(shape, "curves")
  colMeans(at[grep(paste0("^", curve, " "), rownames(at)), ])
}

test_that("a good shape is green throughout, with nothing to say", {
  graded <- quality(quad_shape())
  expect_s3_class(graded, c("shape_quality", "data.frame"), exact = TRUE)
  expect_equal(names(graded)[c(1:10, 21:24)],
               c("specimen", "part", "level", "kind", "length", "strength", "contrast", "se",
                "competing", "z", "track", "noise_factor", "grade", "why"))
  expect_equal(graded$part, c("a", "b", "c", "d", "bottom", "top", "left", "right", "quad"))
  expect_equal(levels(graded$grade), c("green", "amber", "red"))
  expect_true(is.ordered(graded$grade) && all(graded$grade == "green"))
  expect_true(all(is.na(graded$why)) && all(is.na(graded$z)) && all(graded$specimen == "quad"))
  expect_equal(graded$length, quad_shape()$status$length)
  expect_output(print(graded), "9 parts: 9 green, 0 amber, 0 red", fixed = TRUE)
})

test_that("what is missing is red, with the reason", {
  graded <- quality(quad_shape(landmarks = quad_corners()[c("a", "b", "d"), ]))
  expect_equal(graded$part[graded$grade == "red"], c("c", "top", "right", "quad"))
  expect_match(why_in(graded, "top"), "landmark c", fixed = TRUE)
  expect_match(why_in(graded, "quad", "surface"), "24 of 35 points missing", fixed = TRUE)
  expect_equal(graded$missing[graded$level == "surface"], 24 / 35)
  lenient <- quality(quad_shape(landmarks = quad_corners()[c("a", "b", "d"), ]),
                     quality_limits(missing = c(0.5, 1)))
  expect_equal(grade_in(lenient, "quad", "surface"), "amber")
})

test_that("a curve that a hole pushes aside, and its patch, are graded; the others are not", {
  whole <- quad_shape()
  at <- middle_of(whole, "top") * 50 / sqrt(sum(middle_of(whole, "top")^2))
  shape <- spoiled_shape(without_disc(at, 4), bridge = 0)
  moved <- sqrt(rowSums((coords(shape, "curves") - coords(whole, "curves"))^2))
  expect_gt(max(moved[grep("top", names(moved))]), 3)
  graded <- quality(shape)
  expect_equal(grade_in(graded, "top"), "red")
  expect_match(why_in(graded, "top"), "border or hole", fixed = TRUE)
  expect_gte(match(grade_in(graded, "quad", "surface"), c("green", "amber", "red")), 2)
  expect_true(all(graded$grade[graded$part %in% c("bottom", "left", "right")] == "green"))
})

test_that("a bridged hole is told by the share of the curve over it; its points are missing", {
  whole <- quad_shape()
  at <- middle_of(whole, "top") * 50 / sqrt(sum(middle_of(whole, "top")^2))
  shape <- spoiled_shape(without_disc(at, 4))
  gap <- row_lengths(diff(as.matrix(shape$paths$top[c("x", "y", "z")])))
  row <- shape$checks[shape$checks$part == "top", ]
  expect_equal(row$bridged, max(gap) / status_of(shape, "top")$length, tolerance = 0.01)
  expect_equal(shape$checks$bridged[shape$checks$part %in% c("bottom", "left", "right")],
               c(0, 0, 0))
  expect_true(is.infinite(row$border))
  graded <- quality(shape)
  expect_gt(row$missing, 0)
  expect_true(grade_in(graded, "top") != "green")
  expect_match(why_in(graded, "top"), "over a hole", fixed = TRUE)
})

test_that("the distance from a hole is to its rim's nearest vertex, the curve's ends aside", {
  whole <- quad_shape()
  shape <- spoiled_shape(without_disc(c(0, 0, 50), 6), bridge = 0)
  specimen <- quad_specimen(without_disc(c(0, 0, 50), 6))
  edges <- cbind(specimen$mesh$it[1:2, ], specimen$mesh$it[2:3, ], specimen$mesh$it[c(3, 1), ])
  key <- paste(pmin(edges[1, ], edges[2, ]), pmax(edges[1, ], edges[2, ]))
  rim <- unique(as.vector(edges[, key %in% names(which(table(key) == 1))]))
  path <- shape$paths$bottom
  inner <- path$s >= 0.05 * max(path$s) & path$s <= 0.95 * max(path$s)
  gap <- vapply(rim, function(v) {
    min(colSums((t(as.matrix(path[inner, c("x", "y", "z")])) - specimen$mesh$vb[1:3, v])^2))
  }, 0)
  row <- shape$checks[shape$checks$part == "bottom", ]
  expect_equal(row$border, sqrt(min(gap)), tolerance = 1e-10)
  expect_equal(row$size, attr(path, "length"))
  expect_equal(quality(shape)$border[5], row$border / row$size)
  expect_true(all(is.infinite(whole$checks$border[5:9])))
})

test_that("a spike beside a curve is seen, noise is seen everywhere", {
  whole <- quad_shape()
  tip <- function(mesh) which.min(colSums((mesh$vb[1:3, ] - coords(whole, "curves")["top 4", ])^2))
  spiked <- quality(spoiled_shape(function(mesh) {
    mesh$vb[1:3, tip(mesh)] <- 1.3 * mesh$vb[1:3, tip(mesh)]
    mesh
  }))
  expect_true(grade_in(spiked, "top") != "green")
  expect_match(why_in(spiked, "top"), "spike", fixed = TRUE)
  expect_equal(grade_in(spiked, "bottom"), "green")
  noisy <- quality(spoiled_shape(function(mesh) with_seed(1, {
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] * rep(1 + 0.02 * stats::rnorm(ncol(mesh$vb)), each = 3)
    mesh
  })))
  expect_true(all(noisy$grade[noisy$level == "curves"] > "green"))
  expect_match(noisy$why[noisy$level == "curves"], "the surface is rough there", fixed = TRUE)
})

test_that("the bend of a triangle is the angle between its normal and its corners' mean", {
  mesh <- grid_mesh(2)
  tilt <- c(0, 30, 75) * pi / 180
  for (angle in tilt) {
    mesh$normals <- matrix(c(sin(angle), 0, cos(angle), 1), 4, 4)
    expect_equal(cpp_face_bend(mesh$vb, mesh$normals, mesh$it), rep(angle * 180 / pi, 2))
  }
  mesh$vb[, 2] <- mesh$vb[, 1]
  expect_equal(cpp_face_bend(mesh$vb, mesh$normals, mesh$it)[1], 0)
})

test_that("a patch's size is the diameter of the disc with points as far from their centroid", {
  turn <- seq(0, 2 * pi, length.out = 101)[-1]
  radius <- 7 * sqrt(seq(0.005, 0.995, length.out = 100))
  disc <- expand.grid(radius = radius, turn = turn)
  points <- data.frame(level = "surface", part = "disc", point = seq_len(nrow(disc)),
                       x = disc$radius * cos(disc$turn), y = disc$radius * sin(disc$turn),
                       z = 3, face = 1L)
  shape <- list(points = points, status = data.frame(level = "surface", part = "disc"))
  expect_equal(part_places(shape, list(), 1, 0)[[1]]$size, 14, tolerance = 1e-3)
})

test_that("grades do not depend on the unit or the pose", {
  turn <- rbind(c(0, -1, 0), c(0.6, 0, -0.8), c(0.8, 0, 0.6))
  specimen <- quad_specimen(without_disc(c(0, 0, 50), 6))
  shape <- fit_shape(specimen, quad_scheme(), progress = FALSE,
                     measuring = shape_settings(bridge = 0))
  moved <- rbind(turn %*% specimen$mesh$vb[1:3, ] / 1000 + 0.2, 1)
  mesh <- structure(list(vb = moved, it = specimen$mesh$it), class = "mesh3d")
  small <- specimen(mesh, specimen$landmarks %*% t(turn) / 1000 + 0.2, id = "quad")
  one <- quality(shape)
  other <- quality(fit_shape(small, quad_scheme(), progress = FALSE,
                             measuring = shape_settings(bridge = 0)))
  expect_equal(other$length, one$length / 1000, tolerance = tolerances$invariance)
  same <- setdiff(names(one), "length")
  expect_equal(other[same], one[same], tolerance = tolerances$invariance)
})

test_that("a patch is amber where a curve that bounds it is not green", {
  shape <- quad_shape()
  shape$checks$determined[shape$checks$part == "left"] <- FALSE
  shape$status$reason[shape$status$part == "left"] <- "the curvature is faint."
  graded <- quality(shape)
  expect_equal(as.character(graded$grade[c(5:9)]), c("green", "green", "amber", "green", "amber"))
  expect_equal(graded$why[7:9], c("the curvature is faint", NA, "bounded by left (amber)"))
  expect_equal(grade_in(quality(shape, quality_limits(undetermined = "red")), "left"), "red")
  expect_true(all(quality(shape, quality_limits(undetermined = "green"))$grade == "green"))
  shape$checks$determined <- NA
  shape$checks$guessed[shape$checks$part == "left"] <- TRUE
  expect_equal(grade_in(quality(shape), "left"), "amber")
  expect_equal(grade_in(quality(shape, quality_limits(guessed = "red")), "left"), "red")
})

test_that("limits grade by their side, and can be switched off", {
  expect_equal(level_beyond(c(0.5, 1, 1.5, 3, NA), c(1, 2), FALSE), c(0, 0, 1, 2, 0))
  expect_equal(level_beyond(c(0.5, 1, 1.5, 3, NA), c(2, 1), TRUE), c(2, 1, 1, 0, 0))
  shape <- quad_shape()
  shape$status$competing[5] <- 0.99
  expect_equal(grade_in(quality(shape), "bottom"), "amber")
  expect_match(why_in(quality(shape), "bottom"), "another path is 99 % as good", fixed = TRUE)
  expect_equal(grade_in(quality(shape, quality_limits(competing = c(Inf, Inf))), "bottom"), "green")
  expect_crestline_error(quality_limits(length = c(1, 2)), "length")
  expect_crestline_error(quality_limits(c(1, 2)), "Limits are")
  expect_crestline_error(quality_limits(z = c(5, 3)), c("z", "no smaller"))
  expect_crestline_error(quality_limits(border = c(0.01, 0.02)), "no greater")
  expect_crestline_error(quality_limits(undetermined = "blue"), "amber")
  expect_output(print(quality_limits()), "border     below 0.04, 0.005", fixed = TRUE)
})

test_that("several specimens are told by name, and one that failed is told too", {
  shape <- quad_shape()
  graded <- quality(list(shape, lost = NULL, second = shape, shape))
  expect_equal(unique(graded$specimen), c("quad", "lost", "second", "quad 1"))
  lost <- graded[graded$specimen == "lost", ]
  expect_equal(c(lost$level, as.character(lost$grade)), c("specimen", "red"))
  expect_equal(summary(graded)$green, c(9, 0, 9, 9))
  expect_equal(summary(graded)$red, c(0, 1, 0, 0))
  expect_output(print(graded), "lost: 0 amber, 1 red", fixed = TRUE)
  expect_identical(as.data.frame(graded)[1:9, -1], as.data.frame(quality(shape))[, -1])
  expect_crestline_error(quality(quad_specimen()), "fit_shape()")
  expect_crestline_error(quality(list()), "fit_shape()")
  expect_crestline_error(quality(shape, list(z = c(1, 2))), "quality_limits()")
})

test_that("a length that is off the others' is flagged, a large specimen is not", {
  shape <- quad_shape()
  sample <- lapply(1:12, function(i) {
    curves <- shape$status$level == "curves"
    wobble <- with_seed(i, exp(0.01 * stats::rnorm(sum(curves))))
    shape$status$length[curves] <- shape$status$length[curves] * wobble * if (i == 3) 2 else 1
    shape
  })
  sample[[5]]$status$length[6] <- 1.5 * sample[[5]]$status$length[6]
  graded <- quality(sample)
  expect_equal(which(graded$grade > "green" & graded$level == "curves"), 4 * 9 + 6)
  expect_match(graded$why[4 * 9 + 6], "its length is off the others'", fixed = TRUE)
  alone <- quality(sample[[5]], others = sample[-5])
  expect_equal(alone$z, graded$z[37:45])
  expect_true(all(is.na(quality(sample[1:10])$z)))
})

test_that("the real face: nothing red, and a hole in its cheek is seen", {
  scan <- read_specimen(shared_data("scan_a", "surface.ply"),
                        shared_data("scan_a", "landmarks.csv"), id = "scan_a")
  whole <- fit_shape(scan, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  graded <- quality(whole)
  expect_equal(sum(graded$grade == "red"), 0)
  expect_lte(sum(graded$grade == "amber"), 5)
  at <- coords(whole, "curves")["cheek-lip left 10", ]
  mesh <- without_disc(at,
                       10)(structure(list(vb = scan$mesh$vb, it = scan$mesh$it), class = "mesh3d"))
  holed <- specimen(mesh, scan$landmarks, id = "holed")
  holed <- fit_shape(holed, face_scheme(), ridge_settings(error = FALSE), progress = FALSE,
                     measuring = shape_settings(bridge = 0))
  moved <- sqrt(rowSums((coords(holed, "curves") - coords(whole, "curves"))^2))
  expect_gt(max(moved, na.rm = TRUE), 3)
  after <- quality(holed)
  expect_equal(as.character(after$grade[after$part == "cheek-lip left"]), "red")
})

test_that("some of the columns print as the data frame that they are", {
  graded <- quality(quad_shape())
  expect_output(print(graded), "<shape_quality>", fixed = TRUE)
  expect_output(print(graded[1:2, c("part", "grade")]), "part grade", fixed = TRUE)
  expect_output(print(graded[0, c("part", "grade")]), "0 rows", fixed = TRUE)
})

test_that("a curve's largest standard error is in its status and grade, not in its patch's", {
  face <- humface_specimen()
  lips <- face_scheme()
  lips <- curve_scheme(lips$landmarks, lips$curves[grepl("^upper lip", lips$curves$curve), ],
                       name = "lips")
  shape <- suppressWarnings(fit_shape(face, lips, progress = FALSE))
  own <- split(shape$points$se, shape$points$part)
  for (name in c("upper lip left", "upper lip right")) {
    expect_equal(status_of(shape, name)$se_max, max(own[[name]], na.rm = TRUE))
  }
  # Beside the corner of the mouth curvature says nothing: the way from there bounds it.
  right <- coords(shape,
                  "curves")[grepl("upper lip right",
                                  shape$points$part[shape$points$level == "curves"]), ]
  expect_lte(own[["upper lip right"]][2], 1.1 * sqrt(sum((right[2, ] - right[1, ])^2)))
  narrow <- quality(shape, quality_limits(se_max = c(0.5, Inf)))
  expect_equal(grade_in(narrow, "upper lip right"), "amber")
  expect_match(why_in(narrow, "upper lip right"), "radii at one place", fixed = TRUE)
  expect_equal(grade_in(quality(shape), "upper lip right"), "green")
  quad <- quad_shape()
  quad$status$se_max[quad$status$part == "left"] <- 10
  quad$scheme$curves$radius <- 5
  graded <- quality(quad)
  expect_equal(grade_in(graded, "left"), "amber")
  expect_equal(grade_in(graded, "quad", "surface"), "green")
})

test_that("shapes of former versions, without what is known of landmarks, are graded", {
  shape <- quad_shape()
  shape$checks[c("state", "confidence", "exchanged")] <- NULL
  shape$status$se_max <- NULL
  expect_true(all(quality(shape)$grade == "green"))
})

test_that("the score is the share's distance from the others' median in their MAD", {
  wobble <- 0.01 * c(-2, -1, 0, 1, 2)
  share <- cbind(0, wobble, -wobble, 0, 0, c(0.3, 0, 0, 0, 0))
  share <- unname(rbind(share, 0))
  lengths <- exp(share) * rep(c(20, 30, 50, 10, 5, 80), each = 6)
  found <- length_scores(lengths, others = 5, spread = 1e-9)
  expect_equal(found[4, 2], (0.01 - 0) / stats::mad(c(wobble[-4], 0)))
  expect_equal(found[1, 6], 0.3 / 1e-9)
  expect_equal(length_scores(lengths * c(1, 2, 5, 0.1, 1, 3), 5, 1e-9), found)
})

test_that("few others give NA, and equal lengths are measured by the least spread", {
  lengths <- matrix(10, 6, 3)
  expect_true(all(is.na(length_scores(lengths, others = 6, spread = 0.01))))
  lengths[1, 2] <- 10 * exp(0.05)
  expect_equal(length_scores(lengths, 5, 0.01)[1, 2], 5)
  lengths[2:3, 3] <- NA
  expect_true(all(is.na(length_scores(lengths, 5, 0.01)[, 3])))
})

# The quad of helper-shape.R is its own mirror image: left and right are partners, bottom and top
# their own.
paired_shape <- function() {
  pairs <- data.frame(level = c("landmarks", "landmarks", "curves"),
                      left = c("a", "d", "left"), right = c("b", "c", "right"))
  quad_shape(quad_scheme(function(tables) c(tables[1:2], list(pairs = pairs))))
}

test_that("a symmetric shape has no asymmetry, wherever it lies", {
  shape <- paired_shape()
  expect_lte(max(curve_asymmetry(shape)), 0.05)
  straight <- shape
  turn <- rbind(c(0, -1, 0), c(0.6, 0, -0.8), c(0.8, 0, 0.6))
  straight$points[c("x", "y", "z")] <- as.matrix(shape$points[c("x", "y", "z")]) %*% t(turn) + 7
  expect_equal(curve_asymmetry(straight), curve_asymmetry(shape), tolerance = 1e-8)
})

test_that("a curve that bows out is off its partner's image by the bow, both sides alike", {
  shape <- paired_shape()
  for (part in c("left", "right", "bottom", "top")) {
    own <- shape$points$part == part & shape$points$level == "curves"
    ends <- as.matrix(shape$points[own, c("x", "y", "z")])[c(1, sum(own)), ]
    share <- seq(0, 1, length.out = sum(own))
    shape$points[own, c("x", "y", "z")] <- outer(1 - share, ends[1, ]) + outer(share, ends[2, ])
  }
  rows <- which(shape$points$part == "left" & shape$points$level == "curves")
  shape$points$z[rows[3]] <- shape$points$z[rows[3]] + 4
  found <- curve_asymmetry(shape)
  expect_equal(unname(found[c("left", "right")]), c(4, 4), tolerance = 1e-4)
  expect_lte(max(found[c("bottom", "top")]), 1e-3)
  shape$points$z[rows[5]] <- NA
  expect_true(all(is.na(curve_asymmetry(shape)[c("left", "right")])))
})

test_that("without pairs, or with landmarks that do not fix the image, it is NA", {
  expect_true(all(is.na(curve_asymmetry(quad_shape()))))
  shape <- paired_shape()
  line <- shape
  line$points[line$points$level == "landmarks", c("y", "z")] <- 0
  expect_true(all(is.na(curve_asymmetry(line))))
  shape$points$x[3:4] <- NA
  expect_true(all(is.na(curve_asymmetry(shape))))
})

test_that("print counts reasons by kind, and every check has a kind", {
  shape <- quad_shape()
  shape$status$reason[5:6] <- "cut at 0.865 of the scheme's share, as curves are short"
  shape$checks$cut[5:6] <- c(0.865, 0.9)
  graded <- quality(list(one = shape, two = shape))
  expect_output(print(graded), "amber: cut short: 4 parts of 2 specimens, such as bottom of one")
  expect_identical(sum(grepl("cut short", capture.output(print(graded)))), 1L)
  expect_output(print(graded), "lengths of curves are not compared")
  expect_output(print(graded, most = 0), "more that are not green: print(x, most = Inf)",
                fixed = TRUE)
  shape$status$reason[shape$status$part == "quad"] <- "2 flipped triangles"
  expect_output(print(quality(shape)), "patch quad: 2 flipped triangles")
  expect_identical(reason_kind("off the surface by more than 2: tL (by 3)"),
                   "a landmark is off the surface")
  # What the checks say is of a kind that the help explains.
  value <- as.data.frame(quality(shape))
  said <- said_of_parts(cbind(value, se_max = 1, track = 3), value$z, shape$scheme)
  for (name in names(said)) expect_true(reason_kind(said[[name]][5]) %in% reason_kinds)
  source <- test_path("..", "..", "R", "shape-quality.R")
  skip_if_not(file.exists(source), "sources not here")
  help <- paste(readLines(source), collapse = "\n")
  for (kind in reason_kinds) expect_match(help, kind, fixed = TRUE)
})

test_that("a batch's failures are in its quality and on the page, with the remedy", {
  skip_without_futures()
  testthat::skip_if_not_installed("htmltools")
  two <- batch_specimens(2)
  two[[2]]$landmarks <- two[[2]]$landmarks[0, ]
  shapes <- fit_shapes(two, edge_scheme())
  why <- quality(shapes)$why[quality(shapes)$specimen == "ball 2"]
  expect_match(why, "it was not measured: it has no landmarks.*found = TRUE")
  file <- tempfile(fileext = ".html")
  on.exit(unlink(file))
  quality_report(shapes, file, pictures = 0)
  expect_match(paste(readLines(file), collapse = "\n"), "it has no landmarks", fixed = TRUE)
})

test_that("chosen rows print each with its grade and reason, and one reason is said once", {
  shape <- spoiled_shape(without_disc(c(0, 0, 50), 6), bridge = 0)
  graded <- quality(shape)
  rows <- utils::capture.output(print(graded[graded$part == "left", ]))
  expect_match(rows, "left *green", all = FALSE)
  expect_match(utils::capture.output(print(graded[1:20, ], most = 2)), "and 18 more", all = FALSE)
  said <- utils::capture.output(print(graded), width = 80)
  graded$grade[1:2] <- "red"
  graded$why[1:2] <- "one thing"
  lines <- worst_lines(graded, FALSE)
  expect_identical(sum(grepl("one thing", lines)), 1L)
  expect_match(lines, paste(graded$part[1:2], collapse = ", "), all = FALSE, fixed = TRUE)
})

test_that("the median and MAD of the others are those of the values without one", {
  for (n in c(3, 4, 9, 12)) {
    x <- with_seed(n, round(stats::rnorm(n), 1))
    others <- vapply(seq_along(x), function(i) stats::median(x[-i]), 0)
    expect_identical(medians_without(x), others)
    expect_identical(medians_without(rep(1, n)), rep(1, n))
  }
  lengths <- with_seed(1, matrix(exp(stats::rnorm(60, sd = 0.1)), 15))
  lengths[c(4, 20)] <- NA
  share <- stats::medpolish(log(lengths), trace.iter = FALSE, na.rm = TRUE)$residuals
  alone <- apply(share, 2, function(x) {
    vapply(seq_along(x), function(i) {
      rest <- stats::na.omit(x[-i])
      (x[i] - stats::median(rest)) / max(stats::mad(rest), 0.01)
    }, 0)
  })
  expect_equal(length_scores(lengths, 5, 0.01), alone, tolerance = 1e-12)
})

test_that("specimens graded together have the grades that each has alone", {
  shapes <- list(one = quad_shape(), three = two_patch_shape(),
                 two = quad_shape(landmarks = quad_corners()[c("a", "b", "d"), ]))
  # Three are too few to compare lengths, and those of a ball are all alike.
  together <- suppressWarnings(as.data.frame(quality(shapes)))
  alone <- lapply(names(shapes), function(name) as.data.frame(quality(shapes[name])))
  expect_equal(together, do.call(rbind, alone), ignore_attr = c("found", "rows"))
  shapes <- shapes[c("one", "two")]
  measured <- Map(to_grade, shapes, names(shapes))
  scores <- sample_scores(measured, NULL, quality_limits())
  expect_identical(graded_measures(measured, scores, quality_limits(), block = 1),
                   graded_measures(measured, scores, quality_limits()))
})

test_that("of a curve the error says where its verdict is", {
  curve <- ridge_curve(quad_specimen(), "a", "b", "plane", n = 5)
  expect_crestline_error(quality(curve), c("grades shapes", "`determined`"))
})

test_that("a difference of two sides sends the reader to both, one of the mid-line does not", {
  value <- data.frame(part = c("left", "bottom"), level = "curves", asymmetry = 0.1)
  for (name in c("se", "se_max", "competing", "contrast", "roughness", "coarse", "bridged",
                 "border", "spike", "offset", "track")) value[[name]] <- 0
  pairs <- data.frame(level = "curves", left = "left", right = "right")
  said <- said_of_parts(value, c(0, 0), list(pairs = pairs))$asymmetry
  expect_identical(said, c(
    "it is off the mirror image of right by 10 % of its length: look at both sides",
    "it is off its own mirror image by 10 % of its length"
  ))
})
