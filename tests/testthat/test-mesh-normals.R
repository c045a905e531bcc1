test_that("normals of faces are twice the area long and square to their sides", {
  mesh <- Rvcg::vcgSphere(2)
  normal <- face_normals(mesh)
  corner <- face_corners(mesh)
  expect_equal(rowSums(normal * (corner[[2]] - corner[[1]])), rep(0, ncol(mesh$it)),
               tolerance = 1e-15)
  expect_equal(sum(row_lengths(normal)) / 2, Rvcg::vcgArea(mesh), tolerance = 1e-6)
})

test_that("normals of vertices point out of a ball, and are 0 where no triangle has an area", {
  mesh <- Rvcg::vcgSphere(4)
  expect_gt(min(colSums(vertex_normals(mesh)[1:3, ] * mesh$vb[1:3, ])), 0.9999)
  flat <- list(vb = rbind(c(0, 1, 2), 0, 0, 1), it = matrix(1:3, 3))
  expect_identical(vertex_normals(flat), rbind(matrix(0, 3, 3), 1))
})

test_that("normals do not depend on the order of the triangles, the unit or the place", {
  mesh <- Rvcg::vcgSphere(3)
  moved <- mesh
  moved$vb[1:3, ] <- 1000 * mesh$vb[1:3, ] + 7
  moved$it <- mesh$it[, rev(seq_len(ncol(mesh$it)))]
  expect_equal(vertex_normals(moved), vertex_normals(mesh), tolerance = 1e-12)
})
