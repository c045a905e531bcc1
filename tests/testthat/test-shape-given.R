# The curves of a shape, as a list of matrices.
curves_of <- function(shape) {
  points <- shape$points[shape$points$level == "curves", ]
  lapply(split(points[c("x", "y", "z")], factor(points$part, unique(points$part))), as.matrix)
}

test_that("a shape's own curves, given, are its curves again, and the patches between them", {
  found <- quad_shape()
  given <- quad_shape(curves = curves_of(found))
  expect_true(all(given$status$ok))
  expect_lte(max(abs(as.matrix(given$points[c("x", "y", "z")]) -
                     as.matrix(found$points[c("x", "y", "z")]))), 1e-3)
  at <- given$points$level == "curves"
  expect_equal(coords(given, "curves"), coords(found, "curves"), tolerance = 1e-9)
  expect_on_mesh(given$points, quad_specimen()$mesh)
  expect_match(given$status$reason[given$status$level == "curves"],
               "as given: points on the mesh")
  off <- lapply(curves_of(found), `*`, 1.0001)
  expect_match(quad_shape(curves = off)$status$reason[given$status$level == "curves"],
               "as given: points up to .* from the mesh")
})

test_that("a line of any number of points, either way round, gives points at equal chords", {
  specimen <- quad_specimen()
  line <- plane_path(specimen, "a", "b", angle = 0.3)
  dense <- as.matrix(as.data.frame(line)[c("x", "y", "z")])
  expected <- as.matrix(resample_path(specimen$mesh, line, 7)[c("x", "y", "z")])
  for (drawn in list(dense, dense[rev(seq_len(nrow(dense))), ], as.data.frame(dense),
                     1.001 * dense[-c(1, nrow(dense)), ])) {
    shape <- fit_shape(specimen, quad_scheme(), curves = list(bottom = drawn), progress = FALSE)
    expect_equal(unname(coords(shape, "curves")[1:7, ]), unname(expected), tolerance = 1e-3)
    chord <- chords(shape$points[shape$points$part == "bottom", ])
    expect_lte(max(chord) / min(chord) - 1, 1e-8)
    expect_identical(coords(shape, "curves")[8:24, ], coords(quad_shape(), "curves")[8:24, ])
  }
})

test_that("given curves are not cut off, and do not bear on how others are", {
  cut <- quad_scheme(function(tables) {
    tables$curves[1:2, c("cut_share", "cut_from", "cut_to")] <- data.frame(0.5, "a", "b")
    tables
  })
  plain <- quad_shape(cut)
  short <- curves_of(quad_shape(cut, cut_scale = 0.4))["bottom"]
  shape <- quad_shape(cut, curves = short)
  expect_equal(status_of(shape, "bottom")$length, 0.4 * status_of(plain, "bottom")$length,
               tolerance = 1e-3)
  expect_identical(status_of(shape, "top"), status_of(plain, "top"))
})

test_that("what does not lie on the mesh is missing from there on, and says why", {
  whole <- curves_of(quad_shape())
  beside <- whole["bottom"]
  beside$bottom[3, ] <- 1.2 * beside$bottom[3, ]
  shape <- quad_shape(curves = beside)
  expect_equal(which(is.na(coords(shape, "curves")[, 1])), c("bottom 2" = 2L, "bottom 3" = 3L))
  expect_false(status_of(shape, "bottom")$ok)
  expect_match(status_of(shape, "bottom")$reason,
               "it begins at point 4 of 7: a point is not on the mesh", fixed = TRUE)
  expect_match(status_of(shape, "quad")$reason, "2 of 7 points of bottom are missing", fixed = TRUE)
  expect_false(anyNA(coords(shape, "surface")[paste("quad", rep(4:7, each = 5), 1:5), ]))
  beside$bottom <- beside$bottom[c(1, 3, 7), ]
  expect_match(status_of(quad_shape(curves = beside), "bottom")$reason,
               "as given: a point is not on the mesh")
  expect_match(status_of(quad_shape(curves = list(top = whole$top[c(1, 1), ])), "top")$reason,
               "fewer than two points")
})

test_that("a curve that the scheme has not is refused, with the nearest name", {
  expect_crestline_error(quad_shape(curves = list(botom = quad_corners())), c("botom", "bottom"),
                         id = "quad")
  expect_crestline_error(quad_shape(curves = quad_corners()), "list")
})

test_that("from the authors' curves of scan_a come the authors' 922 points", {
  scan <- read_specimen(shared_data("scan_a", "surface.ply"),
                        shared_data("scan_a", "landmarks.csv"), id = "scan_a")
  curves <- attr(read_landmarks(shared_data("scan_a", "reference_curves.csv")), "curves")
  shape <- fit_shape(scan, face_scheme(), curves = curves, progress = FALSE)
  reference <- utils::read.csv(shared_data("scan_a", "reference_surface.csv"))
  expect_identical(rownames(coords(shape, "surface")), paste(reference$patch, reference$index))
  gap <- coords(shape, "surface") - as.matrix(reference[c("x", "y", "z")])
  expect_lte(sqrt(mean(rowSums(gap^2))), 0.02)
  expect_lte(max(sqrt(rowSums(gap^2))), 0.1)
})
