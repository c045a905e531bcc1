# The relabelled reflection of a shape, laid on it by the closed form of Procrustes.
reflected <- function(shape) {
  at <- places_of(shape)
  mirrored <- at[mirror_places(shape$scheme), ] %*% diag(c(-1, 1, 1))
  dimnames(mirrored) <- dimnames(at)
  laid_onto(mirrored, at, FALSE)
}

uneven <- function(...) paired_shape(c(1.2, 1, 1.1), landmarks = replace(paired_corners(), 1, 24), ...)

test_that("a symmetric shape is its own reflection to 1e-10", {
  for (shape in list(uneven(), paired_shape())) {
    mean <- symmetrise(shape)
    expect_lte(max(abs(reflected(mean) - places_of(mean))), 1e-10)
  }
  expect_gt(max(abs(reflected(uneven()) - places_of(uneven()))), 0.1)
})

test_that("it is the mean of shape and reflection, and symmetrising it again changes nothing", {
  shape <- uneven()
  mean <- symmetrise(shape)
  expect_equal(places_of(mean), (places_of(shape) + reflected(shape)) / 2, tolerance = 1e-9)
  expect_equal(places_of(symmetrise(mean)), places_of(mean), tolerance = 1e-12)
  expect_true(all(is.na(mean$points$face)))
  expect_equal(mean$points[c("level", "part", "point")], shape$points[c("level", "part", "point")])
})

test_that("curves and columns that cross the middle run backwards in the mirror", {
  scheme <- paired_scheme()
  place <- unique(scheme$points$place)
  partner <- stats::setNames(place[mirror_places(scheme)], place)
  expect_equal(unname(partner[partner]), place)
  expect_equal(partner[["curves|across|2"]], "curves|across|4")
  expect_equal(partner[["curves|side left|3"]], "curves|side right|3")
  expect_equal(partner[["curves|middle|3"]], "curves|middle|3")
  expect_equal(partner[["surface|cheek left|2 3"]], "surface|cheek right|2 3")
  expect_equal(partner[["landmarks|low"]], "landmarks|low")
  expect_false(anyNA(partner))
})

test_that("every place of the face has its partner", {
  scheme <- face_scheme()
  partner <- mirror_places(scheme)
  expect_equal(partner[partner], seq_along(partner))
  place <- unique(scheme$points$place)
  expect_equal(chartr("LR", "RL", sub("left", "right", place[grepl("left", place)])),
               chartr("LR", "RL", place[partner][grepl("left", place)]))
})

test_that("asymmetry is the distance from the mean, 0 without any, in the mesh's unit", {
  shape <- uneven()
  found <- asymmetry(shape)
  gap <- sqrt(rowSums((places_of(shape) - places_of(symmetrise(shape)))^2))
  expect_equal(found$rms[1], sqrt(mean(gap^2)))
  expect_equal(found$largest[1], max(gap))
  expect_equal(found$points[1], length(gap))
  pair <- found$rms[match(c("side left", "side right"), found$part)]
  expect_equal(pair[1], pair[2], tolerance = 1e-8)
  expect_lte(asymmetry(symmetrise(shape))$largest[1], 1e-10)
  by_point <- asymmetry(shape, "point")
  expect_equal(nrow(by_point), nrow(shape$points))
  expect_equal(by_point$distance, sqrt(by_point$dx^2 + by_point$dy^2 + by_point$dz^2))
})

test_that("a known asymmetry comes back: one landmark moved apart from its pair", {
  shape <- symmetrise(paired_shape())
  moved <- shape
  moved$points$y[moved$points$part == "lowL"] <- moved$points$y[moved$points$part == "lowL"] + 0.002
  found <- asymmetry(moved)
  expect_equal(found$rms[found$part == "lowL"], 0.001, tolerance = 0.1)
  expect_lte(found$rms[found$part == "middle"], 1e-4)
})

test_that("a missing point is filled from its partner; without pairs there is no symmetry", {
  corners <- paired_corners()
  corners["highL", ] <- NA
  mean <- symmetrise(paired_shape(landmarks = corners))
  expect_false(anyNA(coords(mean, "landmarks")))
  expect_false(anyNA(coords(mean, "curves")["side left 3", ]))
  expect_lte(max(abs(reflected(mean) - places_of(mean))), 1e-10)
  expect_crestline_error(symmetrise(quad_shape()), "pairs")
})
