# A ball with a bump on one side, whose height differs from specimen to specimen.
bumpy_balls <- function(n = 6) {
  ball <- ball_mesh(3)
  xyz <- t(ball$vb[1:3, ])
  mirrored <- apply(xyz, 1, function(at) which.min(colSums((t(xyz) - at * c(-1, 1, 1))^2)))
  right <- which(mirrored > seq_along(mirrored))
  bump <- exp(-20 * rowSums(sweep(xyz, 2, c(0.6, 0, 0.8))^2))
  balls <- lapply(seq_len(n), function(i) {
    3 * xyz * (1 + 0.02 * (i %% 3) * xyz[, 2]^2 + (0.04 + i / 200) * bump)
  })
  x <- simplify2array(stats::setNames(balls, paste0("s", seq_len(n))))
  list(parts = symmetry_parts(align(x, "ball", triangles = ball$it), n_perm = 9,
                              pairs = cbind(right, mirrored[right])),
       bump = bump, mirrored = mirrored)
}

test_that("maps of asymmetry are red at the bump, blue at its mirror image, and of its size", {
  made <- bumpy_balls()
  value <- made$parts$directional[[1]]
  normal <- point_normals(made$parts$symmetric[[1]]$mean, made$parts$symmetric[[1]]$triangles)
  height <- rowSums(value * normal)
  top <- which.max(made$bump)
  # Half of the bump at most: the alignment shares it out, and normals lean on its slope.
  expect_gt(height[[top]], 0.06)
  expect_lt(height[[top]], 3 * (0.04 + 3.5 / 200) / 2)
  expect_equal(height[[made$mirrored[top]]], -height[[top]], tolerance = 1e-3)
  pixels <- drawn_pixels(plot(made$parts, engine = "picture", legend = FALSE))
  red <- which(pixels[, , 1] > pixels[, , 3] + 0.15, arr.ind = TRUE)
  blue <- which(pixels[, , 3] > pixels[, , 1] + 0.15, arr.ind = TRUE)
  expect_gt(min(red[, 2]), max(blue[, 2]))
  fluctuating <- drawn_pixels(plot(made$parts, "asymmetric", engine = "picture", legend = FALSE))
  expect_false(any(fluctuating[, , 3] > fluctuating[, , 1] + 0.15))
})

test_that("points without triangles are coloured by their distance", {
  kite <- rbind(left = c(-1, 0, 0), right = c(1, 0, 0), top = c(0, 2, 0), low = c(0, -1, 0.5))
  x <- array(kite, c(4, 3, 8), list(rownames(kite), NULL, paste0("s", 1:8)))
  x <- x + with_seed(1, rnorm(96, sd = 0.02))
  x["left", 2, ] <- x["left", 2, ] + 0.3
  parts <- symmetry_parts(x, pairs = cbind("left", "right"), n_perm = 9, seed = 1)
  drawn <- draw_quietly(plot(parts, engine = "picture"))
  expect_equal(drawn$value, sqrt(rowSums(parts$directional$points^2)), ignore_attr = TRUE)
  drawn <- draw_quietly(plot(parts, "symmetric", engine = "picture"))
  one <- parts$symmetric$points
  off <- one$coords - as.vector(apply(one$coords, 1:2, mean))
  expect_equal(drawn$value, mean(one$size) * sqrt(rowSums(apply(off^2, 1:2, mean))),
               ignore_attr = TRUE)
  expect_crestline_error(plot(parts, level = "curves"), "`level`")
})
