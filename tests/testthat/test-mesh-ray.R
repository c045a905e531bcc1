test_that("rays meet a ball where geometry says, on the near side", {
  ball <- Rvcg::vcgSphere(5)
  aim <- with_seed(1, matrix(stats::rnorm(60), 20))
  aim <- aim / sqrt(rowSums(aim^2))
  met <- do.call(rbind, lapply(seq_len(20), function(i) mesh_on_ray(ball, 3 * aim[i, ], -aim[i, ])))
  expect_on_mesh(met, ball)
  expect_lt(max(abs(as.matrix(met[1:3]) - aim)), 0.002)  # the chords of the triangles
})

test_that("a ray that misses meets nothing, nor one that has the mesh behind it", {
  flat <- grid_mesh(4)
  expect_null(mesh_on_ray(flat, c(5, 5, 1), c(5, 5, 0)))
  expect_null(mesh_on_ray(flat, c(1.2, 1.4, 1), c(1.2, 1.4, 2)))
  expect_null(mesh_on_ray(flat, c(0, 0, 1), c(1, 0, 1)))
  expect_equal(unlist(mesh_on_ray(flat, c(1.2, 1.4, 1), c(1.2, 1.4, 0))[1:3]),
               c(x = 1.2, y = 1.4, z = 0))
  expect_equal(unlist(mesh_on_ray(flat, c(1.2, 1.4, -7), c(1.2, 1.4, 0))[1:3]),
               c(x = 1.2, y = 1.4, z = 0))
})

test_that("no ray slips through an edge or a vertex, in whatever unit and place", {
  flat <- grid_mesh(6)
  for (scale in c(1e-3, 1, 1e6)) {
    moved <- moved_mesh(flat, some_rotation(3), scale * c(70, -30, 11), scale)
    at <- rbind(c(1, 1, 0), c(2.5, 2, 0), c(1.5, 1.5, 0), c(0.7, 0.3, 0), c(3, 2.2, 0))
    to_world <- function(x) {
      as.vector(scale * (some_rotation(3) %*% (x + c(0, 0, 0))) + scale * c(70, -30, 11))
    }
    for (i in seq_len(nrow(at))) {
      met <- mesh_on_ray(moved, to_world(at[i, ] + c(0.3, -0.2, 4)), to_world(at[i, ]))
      expect_equal(unlist(met[1:3], use.names = FALSE), to_world(at[i, ]), tolerance = 1e-9)
      expect_on_mesh(met, moved)
    }
  }
})

# Rvcg searches in single precision and now and then misses the nearest face.
test_that("Rvcg's ray search says the same, or a place farther off", {
  face <- humface_scan()
  towards <- t(face$vb[1:3, seq(100, ncol(face$vb), by = 500)])
  from <- matrix(c(20, 60, 400), nrow(towards), 3, byrow = TRUE)
  ours <- do.call(rbind,
                  lapply(seq_len(nrow(towards)),
                         function(i) mesh_on_ray(face, from[i, ], towards[i, ])))
  expect_on_mesh(ours, face)
  rays <- structure(list(vb = rbind(t(from), 1), normals = rbind(t(towards - from), 1)),
                    class = "mesh3d")
  theirs <- sqrt(rowSums((t(Rvcg::vcgRaySearch(rays, face)$vb[1:3, ]) - from)^2))
  farther <- theirs - sqrt(rowSums((as.matrix(ours[1:3]) - from)^2))
  expect_gt(min(farther), -1e-3)
  expect_lt(stats::median(abs(farther)), 1e-4)
})
