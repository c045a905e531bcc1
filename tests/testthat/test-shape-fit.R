test_that("curves and columns of a ball are great circles, on the mesh, at equal chords", {
  shape <- quad_shape()
  expect_s3_class(shape, "shape")
  expect_true(all(shape$status$ok))
  expect_true(all(is.na(shape$status$reason)))
  expect_on_mesh(shape$points, quad_specimen()$mesh)
  corners <- quad_corners()
  arc <- function(p, q) 50 * acos(sum(p * q) / 2500)
  expect_equal(status_of(shape, "bottom")$length, arc(corners["a", ], corners["b", ]),
               tolerance = 1e-3)
  at <- coords(shape, "surface")
  for (column in 2:7) {
    points <- at[paste("quad", column, 1:5), ]
    axis <- cross_product(points[1, ], points[5, ])
    expect_lte(max(abs(points %*% axis / sqrt(sum(axis^2)))), 0.02 * 50)
    chord <- sqrt(rowSums(diff(points)^2))
    expect_lte(max(chord) / min(chord) - 1, 1e-8)
  }
})

test_that("every point of the scheme has its row, in the scheme's order", {
  shape <- quad_shape()
  expect_equal(shape$points[c("level", "part", "point")],
               shape$scheme$points[c("level", "part", "point")])
  expect_equal(vapply(c("landmarks", "curves", "surface"),
                      function(level) nrow(coords(shape, level)), 0L),
               c(landmarks = 4L, curves = 24L, surface = 35L))
  expect_equal(rownames(coords(shape, "landmarks")), c("a", "b", "c", "d"))
  expect_equal(rownames(coords(shape, "curves"))[7:8], c("bottom 7", "top 1"))
  expect_identical(as.data.frame(shape), shape$points)
  expect_crestline_error(coords(shape, "patches"), "surface")
})

test_that("points of one place are one point, to the last digit", {
  shape <- quad_shape()
  at <- shape$points[c("x", "y", "z", "face", "w1", "w2", "w3")]
  first <- match(shape$scheme$points$place, shape$scheme$points$place)
  expect_true(any(first != seq_along(first)))
  expect_identical(unname(as.matrix(at)), unname(as.matrix(at[first, ])))
  specimen <- quad_specimen()
  expect_identical(unname(coords(shape, "landmarks")), unname(specimen$landmarks))
})

test_that("a landmark that is missing costs its curves and their part of the patch only", {
  for (landmarks in list(quad_corners()[c("a", "b", "d"), ],
                         replace(quad_corners(), cbind(3, 1:3), NA))) {
    shape <- quad_shape(landmarks = landmarks)
    expect_equal(shape$status$part[!shape$status$ok], c("c", "top", "right", "quad"))
    expect_match(shape$status$reason[!shape$status$ok][1:3], "landmark c", fixed = TRUE)
    expect_match(status_of(shape, "quad")$reason, "24 of 35 points missing: top is missing",
                 fixed = TRUE)
    whole <- quad_shape()
    found <- !is.na(shape$points$x)
    expect_equal(sum(!found & shape$points$level == "surface"), 24)
    expect_identical(shape$points[found, ], whole$points[found, ])
  }
})

test_that("a curve is cut off by arc length at its far end, all of a specimen by one factor", {
  cut <- function(share) function(tables) {
    tables$curves[1:2, c("cut_share", "cut_from", "cut_to")] <- data.frame(share, "a", "b")
    tables
  }
  ends <- quad_specimen()$landmarks
  span <- sqrt(sum((ends["a", ] - ends["b", ])^2))
  whole <- quad_shape()
  shape <- quad_shape(quad_scheme(cut(0.5)))
  expect_equal(status_of(shape, "bottom")$length, 0.5 * span)
  expect_identical(coords(shape, "curves")["bottom 7", ], coords(shape, "landmarks")["b", ])
  expect_on_mesh(shape$points, quad_specimen()$mesh)
  expect_true(all(is.na(shape$status$reason)))
  expect_equal(status_of(quad_shape(quad_scheme(cut(0.5)), cut_scale = 0.6), "top")$length,
               0.3 * span)
  long <- quad_shape(quad_scheme(cut(c(4, 2))))
  share <- status_of(whole, "bottom")$length / (4 * span)
  expect_equal(status_of(long, "bottom")$length, status_of(whole, "bottom")$length)
  expect_equal(status_of(long, "top")$length, 2 * span * share)
  expect_match(status_of(long, "top")$reason, sprintf("%.3g of the scheme's share", share),
               fixed = TRUE)
})

test_that("specimen, scheme and settings are checked", {
  expect_crestline_error(fit_shape(Rvcg::vcgSphere(2), quad_scheme()), "specimen()")
  expect_crestline_error(fit_shape(quad_specimen(), quad_tables()), "face_scheme()")
  expect_crestline_error(quad_shape(cut_scale = 0), "cut_scale")
  expect_crestline_error(quad_shape(column_angle = 2), "column_angle")
})

test_that("print says what is there and what is not", {
  expect_output(print(quad_shape()), "4 of 4 curves with 24 of 24 points")
  shape <- quad_shape(landmarks = quad_corners()[1:3, ])
  expect_output(print(shape), "- top: there is no landmark d", fixed = TRUE)
})

test_that("the model of scan_a has the authors' names and, where cuts make it, their points", {
  scan <- read_specimen(shared_data("scan_a", "surface.ply"),
                        shared_data("scan_a", "landmarks.csv"), id = "scan_a")
  shape <- fit_shape(scan, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  expect_equal(as.vector(table(shape$points$level)[c("landmarks", "curves", "surface")]),
               c(23, 467, 922))
  expect_true(all(shape$status$ok))
  reference <- utils::read.csv(shared_data("scan_a", "reference_surface.csv"))
  expect_identical(rownames(coords(shape, "surface")), paste(reference$patch, reference$index))
  curves <- utils::read.csv(shared_data("scan_a", "reference_curves.csv"))
  middle <- c("mid-line nasal profile", "mid-line philtral", "nasal root left", "nasal base right",
              "mid-line upper lip")
  for (name in middle) {
    gap <- coords(shape, "curves")[shape$points$part[shape$points$level == "curves"] == name, ] -
      as.matrix(curves[curves$curve == name, c("x", "y", "z")])
    expect_lte(sqrt(mean(rowSums(gap^2))), 0.1)
  }
})

test_that("progress is shown on request, and changes nothing", {
  loud <- suppressMessages(fit_shape(quad_specimen(), quad_scheme(), progress = TRUE))
  expect_identical(loud$points, quad_shape()$points)
})

test_that("the mirrored specimen, its landmarks renamed, gives the mirrored points", {
  pairs <- data.frame(level = c("landmarks", "landmarks", "curves"), left = c("a", "d", "left"),
                      right = c("b", "c", "right"))
  scheme <- quad_scheme(function(tables) c(tables[1:2], list(pairs = pairs)))
  mirror <- fit_shape(mirrored_specimen(quad_specimen(), pairs), scheme, progress = FALSE)
  at <- coords(mirror, "curves") %*% diag(c(-1, 1, 1))
  whole <- coords(fit_shape(quad_specimen(), scheme, progress = FALSE), "curves")
  expect_equal(unname(at[paste("left", 1:5), ]), unname(whole[paste("right", 1:5), ]),
               tolerance = 1e-7)
  expect_equal(unname(at[paste("top", 1:7), ]), unname(whole[paste("top", 7:1), ]),
               tolerance = 1e-7)
})

test_that("a face's model is that of its mirror image, whatever the order of corners, faces", {
  face <- humface_specimen()
  pairs <- face_scheme()$pairs
  fit <- function(specimen) {
    fit_shape(specimen, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  }
  whole <- fit(face)
  size <- mesh_diagonal(face$mesh)
  for (shuffled in c(FALSE, TRUE)) {
    expect_lte(mirror_gap(whole, fit(mirrored_specimen(face, pairs, shuffled)), pairs),
               tolerances$invariance * size)
  }
  face$landmarks["tL", ] <- NA
  face$landmarks["enR", ] <- NA
  expect_lte(mirror_gap(fit(face), fit(mirrored_specimen(face, pairs)), pairs),
             tolerances$invariance * size)
})

test_that("points of one place agree exactly; what is missing has a reason, costs nothing else", {
  face <- humface_specimen()
  whole <- fit_shape(face, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  middle <- face$landmarks["acL", ] + c(12, 0, 0)
  torn <- face$mesh
  kept <- colSums((torn$vb[1:3, ] - middle)^2) > 6^2
  torn$it <- torn$it[, kept[torn$it[1, ]] & kept[torn$it[2, ]] & kept[torn$it[3, ]]]
  torn$normals <- NULL
  landmarks <- face$landmarks
  landmarks["st", ] <- NA
  landmarks <- landmarks[rownames(landmarks) != "tR", ]
  shape <- fit_shape(specimen(torn, landmarks, id = "torn"), face_scheme(),
                     ridge_settings(error = FALSE), progress = FALSE)
  columns <- c("x", "y", "z", "face", "w1", "w2", "w3")
  for (one in list(whole, shape)) {
    first <- match(one$scheme$points$place, one$scheme$points$place)
    expect_identical(unname(as.matrix(one$points[columns])),
                     unname(as.matrix(one$points[first, columns])))
  }
  part <- paste(shape$points$level, shape$points$part)
  lost <- tapply(is.na(shape$points$x), part, any)
  expect_equal(unname(lost[paste(shape$status$level, shape$status$part)]), !shape$status$ok,
               ignore_attr = TRUE)
  expect_true(all(nzchar(shape$status$reason[!shape$status$ok])))
  expect_true(all(c("st", "tR", "mid-line lip left", "cheek-nose left") %in%
                  shape$status$part[!shape$status$ok]))
  gap <- sqrt(rowSums((as.matrix(shape$points[c("x", "y", "z")]) -
                       as.matrix(whole$points[c("x", "y", "z")]))^2))
  followed <- unique(part[grepl("followed|right",
                                shape$status$reason[match(part,
                                                          paste(shape$status$level,
                                                                shape$status$part))])])
  expect_lte(max(gap[!grepl("right", part)], na.rm = TRUE), 0.5)
  expect_lte(max(gap, na.rm = TRUE), 4)
  expect_gt(mean(!is.na(gap)), 0.8)
})

test_that("a scan in another unit is measured by the same scheme", {
  ridge <- simulate_ridge(0.25, 2, noise = 0.01, seed = 1)
  curves <- data.frame(curve = "crest", from = "from", to = "to", kind = "ridge", radius = 0.25,
                       width = 0.4, n = 11)
  scheme <- curve_scheme(data.frame(landmark = c("from", "to")), curves, name = "ridge")
  small <- specimen(moved_mesh(ridge$mesh, diag(3), scale = 1e-3), ridge$landmarks / 1000,
                    id = "small")
  fit <- function(specimen, ...) fit_shape(specimen, scheme, ..., progress = FALSE)
  expect_equal(coords(fit(small, unit = 1000), "curves") * 1000, coords(fit(ridge), "curves"),
               tolerance = 1e-6)
  small$match <- list(unit = 1000) # as of find_landmarks()
  expect_identical(fit(small)$scheme$curves$radius, 0.25 / 1000)
  expect_crestline_error(fit(small, unit = 0), "unit")
  small$match <- NULL
  expect_crestline_error(fit(small), c("radius of 0.25", "unit"), "small")
})

test_that("landmarks under other names are an error that shows both", {
  corners <- quad_corners()
  rownames(corners) <- paste("corner", 1:4)
  expect_crestline_error(quad_shape(landmarks = corners),
                         c("a, b, c, d", "corner 1", "Rename"), "quad")
})
