# A ball of radius 50 and things that a scan may have beside it.
big_ball <- function(subdivision = 4) {
  ball <- ball_mesh(subdivision)
  ball$vb[1:3, ] <- 50 * ball$vb[1:3, ]
  ball
}

joined <- function(a, b) {
  structure(list(vb = cbind(a$vb, b$vb), it = cbind(a$it, b$it + ncol(a$vb))), class = "mesh3d")
}

platform <- function(half, below, cells = 1) {
  grid <- grid_mesh(cells + 1)
  grid$vb[1:2, ] <- (2 * grid$vb[1:2, ] / cells - 1) * half
  grid$vb[3, ] <- below
  grid
}

test_that("half of a ball's surface lies within its radius, of a disc within 1 / sqrt(2)", {
  radius <- function(mesh) cpp_half_area_radius(mesh$vb, mesh$it, rep(TRUE, ncol(mesh$it)), 1e9, 6)
  expect_equal(radius(big_ball()), 50, tolerance = 0.01)
  disc <- grid_mesh(81)
  disc$vb[1:2, ] <- disc$vb[1:2, ] - 40
  kept <- colSums(matrix(colSums(disc$vb[1:2, ]^2)[disc$it] <= 1600, 3)) == 3
  disc$it <- disc$it[, kept]
  expect_equal(radius(disc), 40 / sqrt(2), tolerance = 0.02)
  disc$it <- disc$it[, 0]
  expect_equal(radius(disc), 0)
})

test_that("the size follows unit, place and turn, and does not hang on the order of triangles", {
  ball <- big_ball()
  ball$vb[1, ] <- 4 * ball$vb[1, ]
  size <- mesh_size(ball)
  changed <- moved_mesh(ball, some_rotation(2), c(4, -9, 2), 0.001)
  changed$it <- changed$it[, rev(seq_len(ncol(changed$it)))]
  expect_equal(1000 * mesh_size(changed), size, tolerance = tolerances$invariance)
})

test_that("a stray vertex, a platform, a stand leave the size of the landmarks' part alone", {
  size <- mesh_size(big_ball())
  needle <- big_ball()
  needle$vb <- cbind(needle$vb, c(0, 0, 1e5, 1))
  needle$it <- cbind(needle$it, c(1L, 2L, ncol(needle$vb)))
  # Four radii of a ball, where its box no longer bounds it: 200 for 173.
  expect_equal(mesh_size(needle), size, tolerance = 0.16)
  expect_equal(mesh_size(joined(big_ball(), platform(2000, -60))), size, tolerance = 0.16)
  # As dense as the ball, and forty times its area: a piece of its own, on which there is no
  # landmark.
  busy <- joined(big_ball(3), platform(500, -60, 60))
  at <- 50 * rbind(a = c(0, 0, 1), b = c(1, 0, 0), c = c(0, 1, 0))
  whole <- specimen(busy, at, id = "busy", outward = "keep")
  expect_equal(specimen_size(whole), mesh_size(big_ball(3)), tolerance = 0.02)
  expect_gt(mesh_size(busy), 4 * size)
})

test_that("a stand of one piece with the object does not make it endless if it has landmarks", {
  busy <- joined(big_ball(3), platform(500, -60, 60))
  at <- 50 * rbind(c(0, 0, 1), c(1, 0, 0), c(0, 1, 0), c(-1, 0, 0))
  expect_lte(mesh_size(busy, at = at), 12 * 50)
  expect_gt(mesh_size(busy, at = at[1:3, ]), 12 * 50)
})

test_that("a landmark beside the surface is refused, platform or not; so is a large ball", {
  at <- 50 * rbind(a = c(0, 0, 1), b = c(1, 0, 0), c = c(0, 1, 0))
  at["a", 3] <- 60
  expect_crestline_error(specimen(big_ball(), at), "off the surface")
  expect_crestline_error(specimen(joined(big_ball(), platform(2000, -60)), at, outward = "keep"),
                         c("off the surface", "a (by 1"))
  whole <- specimen(joined(big_ball(), platform(2000, -60)), outward = "keep")
  expect_crestline_error(curvature(whole, 200), "as large as the mesh")
})

test_that("on faces the size is the diagonal of the bounding box, within some per cent", {
  expect_equal(specimen_size(specimen(humface_scan())),
               mesh_diagonal(specimen(humface_scan())$mesh), tolerance = 0.12)
  scan <- read_specimen(shared_data("scan_a", "surface.ply"))
  expect_equal(specimen_size(scan), mesh_diagonal(scan$mesh), tolerance = 0.12)
})
