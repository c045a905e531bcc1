test_that("curves and columns of a ball are great circles, on the mesh, at equal chords", {
  shape <- quad_shape()
  expect_s3_class(shape, "shape")
  expect_true(all(shape$status$ok))
  expect_true(all(is.na(shape$status$reason)))
  expect_on_mesh(shape$points, quad_specimen()$mesh)
  corners <- quad_corners()
  arc <- function(p, q) 50 * acos(sum(p * q) / 2500)
  expect_equal(status_of(shape, "bottom")$length, arc(corners["a", ], corners["b", ]), tolerance = 1e-3)
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
  expect_equal(shape$points[c("level", "part", "point")], shape$scheme$points[c("level", "part", "point")])
  expect_equal(vapply(c("landmarks", "curves", "surface"), function(level) nrow(coords(shape, level)), 0L),
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
  for (landmarks in list(quad_corners()[c("a", "b", "d"), ], replace(quad_corners(), cbind(3, 1:3), NA))) {
    shape <- quad_shape(landmarks = landmarks)
    expect_equal(shape$status$part[!shape$status$ok], c("c", "top", "right", "quad"))
    expect_match(shape$status$reason[!shape$status$ok][1:3], "landmark c", fixed = TRUE)
    expect_match(status_of(shape, "quad")$reason, "24 of 35 points missing: top is missing", fixed = TRUE)
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
  expect_equal(status_of(quad_shape(quad_scheme(cut(0.5)), cut_scale = 0.6), "top")$length, 0.3 * span)
  long <- quad_shape(quad_scheme(cut(c(4, 2))))
  share <- status_of(whole, "bottom")$length / (4 * span)
  expect_equal(status_of(long, "bottom")$length, status_of(whole, "bottom")$length)
  expect_equal(status_of(long, "top")$length, 2 * span * share)
  expect_match(status_of(long, "top")$reason, sprintf("%.3g of the scheme's share", share), fixed = TRUE)
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
  scan <- read_specimen(shared_data("scan_a", "surface.ply"), shared_data("scan_a", "landmarks.csv"), id = "scan_a")
  shape <- fit_shape(scan, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  expect_equal(as.vector(table(shape$points$level)[c("landmarks", "curves", "surface")]), c(23, 467, 922))
  expect_true(all(shape$status$ok))
  reference <- utils::read.csv(shared_data("scan_a", "reference_surface.csv"))
  expect_identical(rownames(coords(shape, "surface")), paste(reference$patch, reference$index))
  curves <- utils::read.csv(shared_data("scan_a", "reference_curves.csv"))
  middle <- c("mid-line nasal profile", "mid-line philtral", "nasal root left", "nasal base right", "mid-line upper lip")
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
  pairs <- data.frame(level = c("landmarks", "landmarks", "curves"), left = c("a", "d", "left"), right = c("b", "c", "right"))
  scheme <- quad_scheme(function(tables) c(tables[1:2], list(pairs = pairs)))
  specimen <- quad_specimen()
  mesh <- specimen$mesh
  mesh$vb[1, ] <- -mesh$vb[1, ]
  mesh$it <- mesh$it[c(1, 3, 2), ]
  mesh$normals <- NULL
  landmarks <- specimen$landmarks[c("b", "a", "d", "c"), ] %*% diag(c(-1, 1, 1))
  rownames(landmarks) <- c("a", "b", "c", "d")
  mirror <- fit_shape(specimen(mesh, landmarks, id = "mirror"), scheme, progress = FALSE)
  at <- coords(mirror, "curves") %*% diag(c(-1, 1, 1))
  whole <- coords(fit_shape(specimen, scheme, progress = FALSE), "curves")
  expect_equal(unname(at[paste("left", 1:5), ]), unname(whole[paste("right", 1:5), ]), tolerance = 1e-7)
  expect_equal(unname(at[paste("top", 1:7), ]), unname(whole[paste("top", 7:1), ]), tolerance = 1e-7)
})
