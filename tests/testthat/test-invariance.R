# A curve does not depend on unit, place, turn, numbering, direction or handedness.

# The specimen with its vertices and landmarks moved by a function of n x 3 co-ordinates.
moved_specimen <- function(specimen, move, turn_faces = FALSE) {
  mesh <- specimen$mesh
  mesh$vb[1:3, ] <- t(move(t(mesh$vb[1:3, ])))
  if (turn_faces) mesh$it <- mesh$it[c(1, 3, 2), ]
  remade(mesh, `dimnames<-`(move(specimen$landmarks), dimnames(specimen$landmarks)))
}
remade <- function(mesh, landmarks) {
  mesh$normals <- NULL
  suppressWarnings(specimen(mesh, landmarks, id = "moved", outward = "keep"),
                   classes = "crestline_mirrored")
}

turned <- function(x) {
  turn <- qr.Q(qr(matrix(c(0.3, 0.9, -0.2, -0.5, 0.4, 0.8, 0.7, 0.1, 0.6), 3)))
  turn[, 1] <- turn[, 1] * det(turn)
  x %*% turn + rep(c(300, -120, 45), each = nrow(x))
}

# Vertices and faces in another order, and every face from another corner on.
reordered <- function(specimen) {
  mesh <- specimen$mesh
  with_seed(8, {
    vertex <- sample(ncol(mesh$vb))
    face <- sample(ncol(mesh$it))
    shift <- sample(0:2, length(face), replace = TRUE)
  })
  mesh$vb <- mesh$vb[, vertex]
  it <- matrix(order(vertex)[mesh$it], 3)[, face]
  mesh$it <- vapply(seq_along(face), function(f) it[(0:2 + shift[f]) %% 3 + 1, f], integer(3))
  remade(mesh, specimen$landmarks)
}

# Largest distance of the points of two curves, as a share of the size of the object.
curve_difference <- function(curve, other, specimen, back = identity) {
  size <- max(apply(specimen$mesh$vb[1:3, ], 1, function(x) diff(range(x))))
  max(sqrt(rowSums((xyz_of(curve$points) - back(xyz_of(other$points)))^2))) / size
}

# curve(specimen, factor) of the specimen changed in every way of the issue against that of the
# specimen itself.
expect_invariant <- function(specimen, curve, factors = c(1e-3, 1e3)) {
  own <- curve(specimen, 1)
  for (factor in factors) {
    scaled <- curve(moved_specimen(specimen, function(x) factor * x), factor)
    testthat::expect_lt(curve_difference(own, scaled, specimen, function(x) x / factor),
                        tolerances$invariance)
    testthat::expect_equal(scaled$points$se / factor, own$points$se, tolerance = 1e-5)
    testthat::expect_identical(scaled[c("converged", "determined")],
                               own[c("converged", "determined")])
  }
  moved <- curve(moved_specimen(specimen, turned), 1)
  there <- structure(list(points = as.data.frame(turned(xyz_of(own$points)))), class = "curve")
  names(there$points) <- c("x", "y", "z")
  testthat::expect_lt(curve_difference(moved, there, specimen), tolerances$invariance)
  testthat::expect_equal(moved$points$se, own$points$se, tolerance = 1e-5)
  shuffled <- curve(reordered(specimen), 1)
  testthat::expect_lt(curve_difference(own, shuffled, specimen), tolerances$invariance)
  # A length like the points' own: about a second pass's reference offsets are a small remainder.
  size <- max(apply(specimen$mesh$vb[1:3, ], 1, function(x) diff(range(x))))
  testthat::expect_lt(max(abs(shuffled$points$d - own$points$d)) / size, tolerances$invariance)
}

expect_reversible <- function(specimen, curve) {
  there <- curve(specimen, FALSE)
  back <- curve(specimen, TRUE)
  back$points <- back$points[rev(seq_len(nrow(back$points))), ]
  testthat::expect_lt(curve_difference(there, back, specimen), 1e-5)
  testthat::expect_equal(back$points$d, -there$points$d, tolerance = 1e-4)
  testthat::expect_equal(back$points$se, there$points$se, tolerance = 1e-3)
}

expect_mirrored <- function(specimen, curve) {
  mirror <- function(x) x * rep(c(-1, 1, 1), each = nrow(x))
  own <- curve(specimen)
  image <- curve(moved_specimen(specimen, mirror, turn_faces = TRUE))
  testthat::expect_lt(curve_difference(own, image, specimen, mirror), tolerances$invariance)
  testthat::expect_equal(image$points$d, -own$points$d, tolerance = 1e-5)
}

noisy_bent <- function() bent_ridge(noise = 0.05, half = c(17, 14))
bent_curve <- function(specimen, factor = 1, from = "a", to = "b", ...) {
  curve_of(specimen, from, to, "ridge", radius = 4 * factor, width = 5 * factor, n = 9, ...)
}

test_that("a ridge on an irregular noisy mesh: unit, turn, shift and numbering", {
  expect_invariant(noisy_bent(), bent_curve)
})

test_that("the same with the other settings", {
  twice <- ridge_settings(passes = 2)
  expect_invariant(noisy_bent(), function(s, factor) bent_curve(s, factor, settings = twice),
                   factors = 1e3)
  principal <- ridge_settings(strength = "principal", wrong_sign = "drop",
                              order = "forced", df = 12)
  expect_invariant(noisy_bent(), function(s, factor)
    suppressWarnings(bent_curve(s, factor, settings = principal)), factors = 1e-3)
  expect_invariant(noisy_bent(), function(s, factor) curve_of(s, "a", "b", "plane", n = 9),
                   factors = 1e3)
})

test_that("the same with landmarks at vertices and on edges of the mesh", {
  bent <- noisy_bent()
  corner <- which.min(colSums((bent$mesh$vb[1:3, ] - bent$landmarks["a", ])^2))
  face <- bent$mesh$it[,
                       which(colSums(bent$mesh$it ==
                                     which.min(colSums((bent$mesh$vb[1:3, ] -
                                                        bent$landmarks["b", ])^2))) > 0)[1]]
  bent$landmarks["a", ] <- bent$mesh$vb[1:3, corner]
  bent$landmarks["b", ] <- rowMeans(bent$mesh$vb[1:3, face[1:2]])
  expect_invariant(remade(bent$mesh, bent$landmarks), bent_curve, factors = 1e3)
})

test_that("from b to a is from a to b", {
  expect_reversible(noisy_bent(), function(s, back)
    if (back) bent_curve(s, from = "b", to = "a") else bent_curve(s))
})

test_that("the mirror image has the mirrored curve", {
  expect_mirrored(noisy_bent(), bent_curve)
})

test_that("curvature turns with the mesh and goes as 1 / unit", {
  bent <- noisy_bent()
  own <- curvature(bent, 4)
  for (factor in c(1e-3, 1e3)) {
    scaled <- curvature(moved_specimen(bent, function(x) factor * x), 4 * factor)
    expect_equal(scaled$k1 * factor, own$k1, tolerance = 1e-7)
    expect_equal(scaled$sigma / factor, own$sigma, tolerance = 1e-7)
    expect_identical(scaled$neighbours, own$neighbours)
  }
  moved <- curvature(moved_specimen(bent, turned), 4)
  expect_equal(moved$k2, own$k2, tolerance = 1e-7)
  expect_equal(moved$normal, turned(own$normal) - turned(0 * own$normal), tolerance = 1e-7)
})

test_that("curves of humface and of real scans: unit, turn, shift, numbering, direction, mirror", {
  face <- humface_specimen()
  lip <- function(s, factor = 1, from = "chL", to = "st") {
    curve_of(s, from, to, "valley", radius = 5 * factor, width = 6 * factor, n = 9)
  }
  expect_invariant(face, lip)
  expect_reversible(face, function(s, back) if (back) lip(s, from = "st", to = "chL") else lip(s))
  expect_mirrored(face, lip)
})

test_that("template_male: lip and eye socket", {
  face <- read_specimen(shared_data("template_male", "surface.ply"),
                        shared_data("template_male", "landmarks.csv"))
  lip <- function(s, factor = 1) {
    curve_of(s, "chR", "cphR", "ridge", radius = 5 * factor, width = 10 * factor, n = 8)
  }
  expect_invariant(face, lip, factors = 1e3)
  socket <- function(s, factor = 1) {
    curve_of(s, "exL", "enL", "ridge", radius = 5 * factor, width = 15 * factor, n = 9)
  }
  expect_invariant(face, socket, factors = 1e-3)
})

test_that("scan_a: the valley between the lips", {
  face <- read_specimen(shared_data("scan_a", "surface.ply"),
                        shared_data("scan_a", "landmarks.csv"))
  lip <- function(s, factor = 1) {
    curve_of(s, "chL", "st", "valley", radius = 5 * factor, width = 6 * factor, n = 9)
  }
  expect_invariant(face, lip, factors = 1e3)
})
