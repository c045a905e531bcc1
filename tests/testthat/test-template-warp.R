named <- function(x) `rownames<-`(x, paste0("landmarks|", seq_len(nrow(x))))

test_that("the warp is the thin-plate spline of other software, and goes through the landmarks", {
  skip_if_not_installed("Morpho")
  from <- named(with_seed(1, matrix(stats::rnorm(60), 20)))
  to <- from + with_seed(2, matrix(stats::rnorm(60, 0, 0.1), 20))
  to[9:20, ] <- NA
  at <- landmark_warp(from, to, rownames(from)[1:8], 1e-6)
  expect_equal(at[1:8, ], to[1:8, ], tolerance = 1e-9)
  expect_equal(unname(at), unname(Morpho::tps3d(from, from[1:8, ], to[1:8, ], threads = 1)),
               tolerance = 1e-8)
})

test_that("landmarks of a plane, a line, a point leave other directions to the similarity", {
  from <- named(with_seed(3, matrix(stats::rnorm(60), 20)))
  turn <- qr.Q(qr(with_seed(4, matrix(stats::rnorm(9), 3))))
  turn <- turn * det(turn)
  to <- sweep(2 * from %*% turn, 2, 1:3, `+`)
  for (n in 0:5) {
    flat <- from
    flat[1:3, 3] <- 0
    aim <- sweep(2 * flat %*% turn, 2, 1:3, `+`)
    expect_equal(landmark_warp(flat, aim, rownames(flat)[seq_len(n)], 1e-6), aim, tolerance = 1e-9,
                 ignore_attr = TRUE)
  }
  expect_equal(landmark_warp(from, to, rownames(from)[1:6], 1e-6), to, tolerance = 1e-9,
               ignore_attr = TRUE)
})
