# A grid of n x n points without the faces for which `gone` (of their middle x and y) is TRUE.
grid_without <- function(n, gone) {
  mesh <- grid_mesh(n)
  middle <- apply(mesh$it, 2, function(f) rowMeans(mesh$vb[1:2, f]))
  mesh$it <- mesh$it[, !gone(middle[1, ], middle[2, ])]
  specimen(mesh, id = "grid", outward = "keep")
}

loops_of <- function(specimen) lapply(cpp_border_loops(specimen$geometry$twin), function(loop) specimen$mesh$it[loop])

test_that("the loops of the border follow it round, outside and inside", {
  loops <- loops_of(grid_without(6, function(x, y) x > 2 & x < 3 & y > 2 & y < 3))
  expect_equal(sort(lengths(loops)), c(4, 20))
  expect_setequal(loops[[which.min(lengths(loops))]], c(15, 16, 21, 22))
  for (loop in loops) expect_equal(anyDuplicated(loop), 0L)
})

test_that("holes that meet in one vertex are bridged each", {
  scan <- grid_without(6, function(x, y) (x > 1 & x < 2 & y > 1 & y < 2) | (x > 2 & x < 3 & y > 2 & y < 3))
  bridged <- bridge_holes(scan, 0.3)
  expect_equal(bridged$mesh$vb[1:2, 37:38][, order(bridged$mesh$vb[1, 37:38])], cbind(c(1.5, 1.5), c(2.5, 2.5)))
  expect_equal(sum(bridged$geometry$twin == 0), 20)
  expect_equal(simple_loops(c(1, 2, 3, 2, 4, 5, 4)), list(c(2, 3), c(4, 5), c(1, 2, 4)))
})

test_that("a bridge closes a hole and leaves the mesh's own numbers", {
  scan <- grid_without(6, function(x, y) x > 2 & x < 3 & y > 2 & y < 3)
  bridged <- bridge_holes(scan, 0.3)
  expect_equal(bridged$mesh$vb[, 1:36], scan$mesh$vb)
  expect_equal(bridged$mesh$it[, seq_len(ncol(scan$mesh$it))], scan$mesh$it)
  expect_equal(bridged$mesh$vb[, 37], c(2.5, 2.5, 0, 1))
  expect_equal(sum(bridged$geometry$twin == 0), 20)
  expect_true(all(face_normals(bridged$mesh)[, 3] > 0))
  path <- plane_path(bridged, c(0.3, 2.4, 0), c(4.6, 2.4, 0))
  expect_equal(attr(path, "length"), 4.3)
  over <- unbridged_path(path, scan)
  expect_on_mesh(over, scan$mesh)
  expect_equal(over$s[over$s > 1.71 & over$s < 2.69], numeric())
  expect_identical(unbridged_path(plane_path(scan, c(0.3, 1.4, 0), c(4.6, 1.4, 0)), scan),
                   plane_path(scan, c(0.3, 1.4, 0), c(4.6, 1.4, 0)))
})

test_that("a hole that is too large, and the outer border, stay open", {
  scan <- grid_without(6, function(x, y) x > 1 & x < 4 & y > 1 & y < 4)
  expect_identical(bridge_holes(scan, 0.5), scan)
  expect_equal(sum(bridge_holes(scan, 0.7)$geometry$twin == 0), 20)
  ball <- specimen(ball_mesh(), id = "ball")
  expect_identical(bridge_holes(ball, 1), ball)
})
