# Deviations along the surface.

test_that("D2 is the squared distance in the tangent plane", {
  norms <- small_norms()
  k <- nrow(norms$points)
  expected <- expected_columns(norms$surface$columns, 10, "female")
  y <- expected$mean + with_seed(2, stats::rnorm(3 * k)) * expected$sd
  extra <- rep(0.3, 3 * k)
  found <- tangential_parts(norms$points, y, expected, extra)
  spread <- matrix(expected$sd * sqrt(1 + expected$h), k)
  off <- matrix(y - expected$mean, k)
  for (i in c(1, 18, 35)) {
    r <- diag(3)
    r[lower.tri(r)] <- unlist(norms$points[i, c("r_xy", "r_xz", "r_yz")])
    r[upper.tri(r)] <- t(r)[upper.tri(r)]
    s <- spread[i, ] * t(r * spread[i, ]) + diag(extra[1], 3)
    normal <- unlist(norms$points[i, c("nx", "ny", "nz")])
    plane <- qr.Q(qr(cbind(normal, diag(3)[, 1:2])))[, 2:3]
    a <- crossprod(plane, off[i, ])
    expect_equal(found$d2[i], drop(t(a) %*% solve(t(plane) %*% s %*% plane, a)), tolerance = 1e-5)
    expect_equal(found$off[i], sqrt(sum(a^2)), tolerance = 1e-5)
  }
  df <- 1 / rowMeans(matrix(expected$h_spread, k))
  expect_equal(as.vector(found$p), stats::pf(as.vector(found$d2) / 2, 2, pmax(3, df),
                                             lower.tail = FALSE))
})

test_that("correlations of co-ordinates are found, and D2 of new faces has its level", {
  r <- matrix(c(1, 0.5, -0.3, 0.5, 1, 0.2, -0.3, 0.2, 1), 3)
  e <- with_seed(4, matrix(stats::rnorm(3 * 4000), 4000)) %*% chol(r)
  found <- joint_correlations(cbind(e[, 1], e[, 1], e[, 2], e[, 2], e[, 3], e[, 3]))
  expect_equal(unlist(found[2, ]), c(0.5, -0.3, 0.2), tolerance = 0.1, ignore_attr = TRUE)
  norms <- small_norms()
  fresh <- small_cohort(60, seed = 8)
  inside <- which(fresh$data$age > 7 & fresh$data$age < 13)
  p <- sapply(inside, function(i) {
    found <- suppressWarnings(assess(fresh$sample[[i]], norms, fresh$data$age[i],
                                     fresh$data$sex[i]))
    found$points$p_tangential
  })
  expect_equal(mean(p < 0.05), 0.05, tolerance = 0.6)
})
