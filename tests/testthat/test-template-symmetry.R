# The relabelled reflection of a shape, laid on it by the closed form of Procrustes.
reflected <- function(shape) {
  at <- places_of(shape)
  mirrored <- at[mirror_places(shape$scheme), ] %*% diag(c(-1, 1, 1))
  dimnames(mirrored) <- dimnames(at)
  laid_onto(mirrored, at, FALSE)
}

uneven <- function(...) {
  paired_shape(c(1.2, 1, 1.1), landmarks = replace(paired_corners(), 1, 24), ...)
}

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

test_that("landmarks in no pair beside the middle are named, with their distance from it", {
  scheme <- paired_scheme(function(tables) {
    tables$landmarks <- rbind(tables$landmarks, data.frame(landmark = c("cheekL", "cheekR")))
    tables
  })
  at <- paired_corners()
  cheek <- 50 * c(sin(0.5), 0, cos(0.5))
  corners <- rbind(at, cheekL = cheek, cheekR = cheek * c(-1, 1, 1))
  shape <- paired_shape(scheme = scheme, landmarks = corners)
  expect_warning(mean <- symmetrise(shape), "cheekL \\(24\\), cheekR \\(24\\)",
                 class = "crestline_unpaired")
  expect_lte(max(abs(coords(mean, "landmarks")[c("cheekL", "cheekR"), 1])), 0.05)
  expect_warning(asymmetry(shape), class = "crestline_unpaired")
  # 24 of a radius below 50: quiet from half of it on, and in another unit as in this one.
  expect_no_warning(symmetrise(shape, off_middle = 1))
  expect_no_warning(asymmetry(shape, off_middle = 1))
  small <- shape
  small$points[c("x", "y", "z")] <- small$points[c("x", "y", "z")] / 1000
  expect_warning(symmetrise(small), "cheekL \\(0.024\\)", class = "crestline_unpaired")
  expect_no_warning(symmetrise(paired_shape()))
  expect_no_warning(symmetrise(uneven()))
  expect_crestline_error(symmetrise(shape, off_middle = -1), "`off_middle`")
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

test_that("no pose lays the reflection nearer: asymmetry is half the Procrustes distance", {
  shape <- uneven()
  at <- places_of(shape)
  mirrored <- at[mirror_places(shape$scheme), ] %*% diag(c(-1, 1, 1))
  centred <- function(x) sweep(x, 2, colMeans(x))
  turn <- function(a) {
    about <- function(angle, i, j) {
      r <- diag(3)
      r[c(i, j), c(i, j)] <- c(cos(angle), sin(angle), -sin(angle), cos(angle))
      r
    }
    about(a[1], 1, 2) %*% about(a[2], 2, 3) %*% about(a[3], 1, 3)
  }
  gap <- function(a) sum((centred(at) - centred(mirrored) %*% turn(a))^2)
  starts <- rbind(c(0, 0, 0), with_seed(1, matrix(stats::runif(12, -3, 3), 4)))
  least <- min(apply(starts, 1, function(a)
    stats::optim(a, gap, method = "BFGS", control = list(reltol = 1e-14))$value))
  expect_equal(asymmetry(shape)$rms[1], sqrt(least / nrow(at)) / 2, tolerance = 1e-6)
})

test_that("sums of squares fall into symmetric and asymmetric parts (Klingenberg et al. 2002)", {
  shapes <- list(uneven(), paired_shape(),
                 paired_shape(c(1.05, 1, 0.95), landmarks = replace(paired_corners(), 8, -15)))
  aim <- places_of(symmetrise(shapes[[2]]))
  both <- lapply(shapes, function(shape) {
    fit <- superimposition(places_of(symmetrise(shape)), aim, FALSE)
    list(own = fit(places_of(shape)), mirrored = fit(reflected(shape)),
         symmetric = fit(places_of(symmetrise(shape))))
  })
  centre <- Reduce(`+`, lapply(both, function(x) x$own + x$mirrored)) / (2 * length(both))
  squares <- function(part) sum(vapply(both, function(x) sum((x[[part]] - centre)^2), 0))
  asymmetric <- sum(vapply(shapes, function(shape) 2 * asymmetry(shape)$points[1] *
                                   asymmetry(shape)$rms[1]^2, 0))
  expect_equal(squares("own") + squares("mirrored"), 2 * squares("symmetric") + asymmetric,
               tolerance = 1e-9)
})

test_that("the symmetric component is that of geomorph, to the square of the asymmetry", {
  skip_if_not_installed("geomorph")
  moved <- lapply(1:4, function(i) paired_corners() + with_seed(i, matrix(stats::rnorm(18), 6)))
  shapes <- lapply(moved, function(at) paired_shape(landmarks = at))
  partner <- mirror_places(paired_scheme())
  left <- which(partner > seq_along(partner))
  theirs <- geomorph::bilat.symmetry(simplify2array(lapply(shapes, places_of)), ind = factor(1:4),
                                     object.sym = TRUE, land.pairs = cbind(left, partner[left]),
                                     iter = 9, print.progress = FALSE)$symm.shape
  for (i in 1:4) {
    ours <- unname(places_of(symmetrise(shapes[[i]])))
    expect_equal(laid_onto(ours, unname(theirs[, , i]), TRUE), unname(theirs[, , i]),
                 tolerance = 2e-3, ignore_attr = TRUE)
  }
})
