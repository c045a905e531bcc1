bent_path <- function() {
  bent <- bent_ridge(noise = 0.03)
  list(mesh = bent$mesh, path = plane_path(bent, "a", "b", 0.3))
}

test_that("points have equal chords, the ends exactly, all on the path and the mesh", {
  b <- bent_path()
  for (n in c(2, 3, 9, 50, 400)) {
    points <- resample_path(b$mesh, b$path, n)
    expect_identical(nrow(points), as.integer(n))
    expect_true(attr(points, "converged"))
    expect_lt(max(chords(points)) / min(chords(points)) - 1, 1e-8)
    expect_identical(xyz_of(points)[c(1, n), ], xyz_of(b$path)[c(1, nrow(b$path)), ], ignore_attr = TRUE)
    expect_identical(points$s[c(1, n)], c(0, attr(b$path, "length")))
    expect_on_mesh(points, b$mesh)
    expect_lt(max(distance_from_line(xyz_of(points), xyz_of(b$path))), 1e-9)
  }
})

test_that("a straight path gives equal steps, a half circle the polygon's corners", {
  mesh <- grid_mesh(11)
  points <- resample_path(mesh, plane_path(mesh, c(1, 5.2, 0), c(9, 5.2, 0)), 5)
  expect_equal(points$x, c(1, 3, 5, 7, 9), tolerance = 1e-9)
  angle <- seq(0, pi, length.out = 2001)
  circle <- structure(data.frame(s = c(0, cumsum(rep(2 * sin(pi / 4000), 2000))), x = cos(angle), y = sin(angle), z = 0),
                      length = 2000 * 2 * sin(pi / 4000))
  at <- points_along(circle, attr(circle, "length") * (0:4) / 4)
  expect_equal(at[, 1], cos(pi * (0:4) / 4), tolerance = 1e-6, ignore_attr = TRUE)
})

test_that("chords that cannot be made equal in the rounds given are told", {
  b <- bent_path()
  expect_false(attr(resample_path(b$mesh, b$path, 30, iterations = 1), "converged"))
})

test_that("places between two points lie in the face of their segment", {
  b <- bent_path()
  middle <- (b$path$s[-1] + b$path$s[-nrow(b$path)]) / 2
  placed <- place_along(b$mesh, b$path, middle)
  expect_identical(placed$face, as.integer(b$path$face[-1]))
  half <- (xyz_of(b$path)[-1, ] + xyz_of(b$path)[-nrow(b$path), ]) / 2
  expect_equal(xyz_of(placed), half, tolerance = 1e-6, ignore_attr = TRUE)
})

test_that("weights in a face are barycentric, and clamped outside", {
  mesh <- grid_mesh(3)
  corners <- t(mesh$vb[1:3, mesh$it[, 1]])
  expect_equal(weights_in_faces(mesh, 1, rbind(c(0.2, 0.3, 0.5) %*% corners)), rbind(c(0.2, 0.3, 0.5)), ignore_attr = TRUE)
  expect_true(all(weights_in_faces(mesh, 1, rbind(c(-5, -5, 0))) >= 0))
})
