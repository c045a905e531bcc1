test_that("what is no mesh is refused with the reason", {
  expect_crestline_error(specimen(1:3, id = "s1"), c("s1", "mesh3d"), id = "s1")
  expect_crestline_error(specimen(structure(list(), class = "mesh3d")), "no vertices")
  few <- structure(list(vb = rbind(diag(3), 1)), class = "mesh3d")
  expect_crestline_error(specimen(few, id = "few"), c("few", "no triangles", "3 points"), id = "few")
  line <- structure(list(vb = rbind(0:2, 0:2, 0:2, 1), it = matrix(1:3)), class = "mesh3d")
  expect_crestline_error(specimen(line), "no triangle with an area")
  bad <- ball_mesh()
  bad$it[1, 1:2] <- c(0L, 9999L)
  expect_crestline_error(specimen(bad, id = "b"), c("2 of 320 faces", "do not exist"), id = "b")
  bad$it <- bad$it[1:2, 1:2]
  bad$it <- matrix(1:4, 2)
  expect_crestline_error(specimen(bad), "3 x m")
})

test_that("homogeneous co-ordinates are divided out and three rows completed", {
  ball <- ball_mesh()
  scaled <- ball
  scaled$vb[, 1:10] <- 4 * scaled$vb[, 1:10]
  s <- specimen(scaled)
  expect_equal(s$mesh$vb, ball$vb)
  expect_equal(report_count(s, "homogeneous co-ordinates"), 10)
  scaled <- ball
  scaled$vb <- ball$vb[1:3, ]
  expect_equal(specimen(scaled)$mesh$vb, ball$vb)
})

test_that("quads are cut in two, with the same outline and sense", {
  grid <- grid_mesh(4)
  low <- grid$it[1, 1:9]
  quad <- structure(list(vb = grid$vb, ib = rbind(low, low + 1, low + 5, low + 4)), class = "mesh3d")
  s <- specimen(quad)
  expect_equal(ncol(s$mesh$it), 18)
  expect_equal(report_count(s, "quads"), 9)
  expect_equal(face_normals(s$mesh), matrix(c(0, 0, 1), 18, 3, byrow = TRUE))
})

test_that("non-finite vertices go, with their faces", {
  ball <- ball_mesh()
  ball$vb[2, 5] <- NaN
  ball$vb[1, 6] <- Inf
  touching <- sum(colSums(matrix(ball$it %in% 5:6, 3)) > 0)
  s <- specimen(ball)
  expect_equal(report_count(s, "non-finite co-ordinates"), 2)
  expect_equal(ncol(s$mesh$it), 320 - touching)
  expect_equal(s$mesh$vb, ball$vb[, -(5:6)])
})

test_that("equal vertices are merged, so that a soup of triangles becomes one piece", {
  ball <- ball_mesh()
  soup <- structure(list(vb = ball$vb[, ball$it], it = matrix(seq_along(ball$it), 3)), class = "mesh3d")
  s <- specimen(soup)
  expect_equal(ncol(s$mesh$vb), 162)
  expect_equal(report_count(s, "duplicate vertices"), 960 - 162)
  expect_equal(report_count(s, "holes"), 0)
  expect_equal(s$mesh$vb[, s$mesh$it], soup$vb)
})

test_that("degenerate, duplicate and areal nothing faces are told apart", {
  grid <- grid_mesh(5)
  grid$it <- cbind(grid$it, c(1L, 1L, 2L), grid$it[c(2, 3, 1), 4], grid$it[c(3, 2, 1), 7])
  s <- specimen(grid)
  expect_equal(report_count(s, "degenerate faces"), 1)
  expect_equal(report_count(s, "duplicate faces"), 2)
  expect_equal(s$mesh$it, grid_mesh(5)$it)
  sliver <- grid_mesh(3)
  sliver$vb[1:3, 5] <- (sliver$vb[1:3, 2] + sliver$vb[1:3, 4]) / 2
  s <- specimen(sliver)
  expect_equal(report_count(s, "faces without area"), 1)
  expect_equal(ncol(s$mesh$it), 8)
})

test_that("unreferenced vertices go and the others keep their order", {
  ball <- ball_mesh()
  more <- ball
  more$vb <- cbind(more$vb[, 1:3], c(7, 7, 7, 1), more$vb[, -(1:3)], c(8, 8, 8, 1))
  more$it <- more$it + (more$it > 3)
  more$material <- list(color = sprintf("#%06X", seq_len(164)))
  s <- specimen(more)
  expect_equal(report_count(s, "unreferenced vertices"), 2)
  expect_equal(s$mesh$vb, ball$vb)
  expect_equal(s$mesh$it, ball$it)
  expect_equal(s$mesh$material$color, sprintf("#%06X", seq_len(164)[-c(4, 164)]))
})

test_that("three faces on one edge are told and act as borders", {
  grid <- grid_mesh(4)
  grid$vb <- cbind(grid$vb, c(1.5, 1, 1, 1))
  grid$it <- cbind(grid$it, c(6L, 7L, 17L))
  s <- specimen(grid)
  expect_equal(report_count(s, "non-manifold edges"), 1)
  expect_equal(ncol(s$mesh$it), 19)
})

test_that("pieces are counted, and debris goes", {
  ball <- ball_mesh(3)
  two <- structure(list(vb = cbind(ball$vb, ball$vb + c(5, 0, 0, 0), c(0, 0, 9, 1), c(1, 0, 9, 1), c(0, 1, 9, 1)),
                        it = cbind(ball$it, ball$it + 642L, 1285:1287)), class = "mesh3d")
  s <- specimen(two)
  expect_equal(report_count(s, "debris"), 1)
  expect_equal(report_count(s, "isolated pieces"), 1)
  expect_equal(ncol(s$mesh$vb), 2 * 642)
  expect_equal(tabulate(s$geometry$piece), c(1280, 1280))
  s <- specimen(two, debris = 0)
  expect_equal(report_count(s, "isolated pieces"), 2)
})

test_that("a mesh whose pieces are all debris is refused with what to do", {
  loose <- function(n) {
    vb <- rbind(rep(seq_len(n), each = 3) + c(0, 0.8, 0), rep(c(0, 0, 30), n), 0, 1)
    structure(list(vb = vb, it = matrix(seq_len(3 * n), 3)), class = "mesh3d")
  }
  expect_equal(ncol(specimen(loose(1000))$mesh$it), 1000)
  expect_crestline_error(specimen(loose(1001), id = "loose"), c("1001 pieces", "`debris`"), "loose")
  expect_equal(ncol(specimen(loose(1001), debris = 0)$mesh$it), 1001)
})

test_that("holes are border loops beyond the outer one", {
  grid <- grid_mesh(8)
  expect_equal(report_count(specimen(grid), "holes"), 0)
  grid$it <- grid$it[, -c(10, 59, 40)]
  expect_equal(report_count(specimen(grid), "holes"), 2)
  expect_equal(report_count(specimen(ball_mesh()), "holes"), 0)
  # Two faces that meet at a corner: one hole of figure-eight shape or two, never none.
  ball <- ball_mesh()
  ball$it <- ball$it[, -c(1, 200)]
  expect_equal(report_count(specimen(ball), "holes"), 1)
})

test_that("a point cloud is triangulated and the report says so", {
  cloud <- ball_mesh(4)
  cloud$it <- NULL
  s <- suppressWarnings(specimen(cloud))
  expect_equal(report_count(s, "point cloud without triangles"), ncol(cloud$vb))
  expect_gt(ncol(s$mesh$it), 0.9 * ncol(ball_mesh(4)$it))
  outward <- colSums(s$mesh$normals[1:3, ] * s$mesh$vb[1:3, ])
  expect_gt(mean(outward > 0.9), 0.99)
})

test_that("results do not depend on scale", {
  ball <- ball_mesh()
  for (scale in c(1e-30, 1e-3, 1e3, 1e30)) {
    scaled <- ball
    scaled$vb[1:3, ] <- ball$vb[1:3, ] * scale
    s <- specimen(scaled, rbind(a = c(0, 0, scale)))
    expect_equal(s$mesh$normals, specimen(ball)$mesh$normals)
    expect_true(all(s$report$count[s$report$check != "landmarks beside the surface"] == 0))
  }
})
