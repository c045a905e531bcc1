# The distance to each triangle by minimising over a fine grid of weights would be slow: search all faces instead.
brute_distance <- function(mesh, p) {
  corner <- face_corners(mesh)
  apply(p, 1, function(x) {
    min(closest_on_triangles(matrix(x, ncol(mesh$it), 3, byrow = TRUE), corner[[1]], corner[[2]], corner[[3]])$distance)
  })
}

test_that("closest points on one triangle are right in all seven regions", {
  a <- c(0, 0, 0); b <- c(4, 0, 0); c <- c(0, 4, 0)
  p <- rbind(c(1, 1, 3), c(-1, -1, 0), c(6, -1, 0), c(-1, 6, 0), c(2, -2, 1), c(-2, 2, 1), c(4, 4, 0))
  truth <- rbind(c(1, 1, 0), a, b, c, c(2, 0, 0), c(0, 2, 0), c(2, 2, 0))
  rows <- function(v) matrix(v, 7, 3, byrow = TRUE)
  found <- closest_on_triangles(p, rows(a), rows(b), rows(c))
  expect_equal(found$weight %*% rbind(a, b, c), truth, ignore_attr = TRUE)
  expect_equal(found$distance, unname(sqrt(rowSums((p - truth)^2))))
})

test_that("points are the exactly closest ones, near, far and beside the mesh", {
  set.seed(2)
  mesh <- grid_mesh(15, function(x, y) sin(x) + cos(2 * y))
  p <- cbind(runif(200, -3, 18), runif(200, -3, 18), rnorm(200, 0, rep(c(0.01, 1, 30, 300), 50)))
  found <- surface_points(mesh, p)
  expect_on_mesh(found, mesh)
  expect_equal(sqrt(rowSums((as.matrix(found[1:3]) - p)^2)), brute_distance(mesh, p), tolerance = tolerances$rounding)
})

test_that("uneven faces do not mislead the candidates", {
  # A huge face above, a clump of tiny ones below: the huge one's centre is far, its surface near.
  clump <- grid_mesh(9)
  clump$vb[1:3, ] <- clump$vb[1:3, ] / 100
  mesh <- structure(list(vb = cbind(clump$vb, c(-1000, -1000, 1, 1), c(3000, -1000, 1, 1), c(-1000, 3000, 1, 1)),
                         it = cbind(clump$it, 82:84)), class = "mesh3d")
  found <- surface_points(mesh, rbind(c(0.04, 0.04, 0.9), c(0.04, 0.04, 0.1)))
  expect_equal(found$z, c(1, 0))
})

test_that("corners of small faces are found beside a huge one", {
  # With a huge face all faces are searched; a corner is as near as its face can be, but for rounding.
  set.seed(1)
  middle <- cbind(rep(1:10, 10), rep(1:10, each = 10), 0)
  corners <- middle[rep(1:100, each = 3), ] + runif(900, -0.3, 0.3)
  huge <- rbind(c(-1000, -1000, 1), c(3000, -1000, 1), c(-1000, 3000, 1))
  mesh <- structure(list(vb = rbind(t(rbind(corners, huge)), 1), it = matrix(1:303, 3)), class = "mesh3d")
  expect_equal(as.matrix(surface_points(mesh, corners)[1:3]), corners, ignore_attr = TRUE, tolerance = tolerances$rounding)
})

test_that("points of the mesh come back to themselves; NA stays NA", {
  mesh <- ball_mesh()
  p <- rbind(t(mesh$vb[1:3, 1:20]), NA)
  found <- surface_points(mesh, p)
  expect_equal(as.matrix(found[1:20, 1:3]), p[1:20, ], ignore_attr = TRUE, tolerance = tolerances$rounding)
  expect_true(all(is.na(found[21, ])))
  expect_equal(nrow(surface_points(mesh, p[0, ])), 0)
})

test_that("degenerate faces do not disturb", {
  mesh <- grid_mesh(3)
  mesh$it <- cbind(c(1L, 1L, 1L), c(1L, 2L, 3L), mesh$it)
  expect_equal(surface_points(mesh, cbind(0.3, 0.4, 5))[1:3], data.frame(x = 0.3, y = 0.4, z = 0))
  expect_gt(surface_points(mesh, cbind(0.5, 0, 0))$face, 2)
})

test_that("the place does not depend on unit, position or scale", {
  mesh <- ball_mesh(3)
  p <- cbind(0.3, -0.5, 0.9)
  weights <- surface_points(mesh, p)[4:7]
  for (scale in c(1e-30, 1e-3, 1e3, 1e30)) {
    moved <- mesh
    moved$vb[1:3, ] <- scale * (mesh$vb[1:3, ] + 10)
    expect_equal(surface_points(moved, scale * (p + 10))[4:7], weights, tolerance = tolerances$invariance)
  }
})
