# The reference of a norm: where its plane of symmetry is.

test_that("the plane of symmetry is x = 0, whatever the pose and the asymmetry", {
  half <- with_seed(1, cbind(stats::runif(20, 5, 40), stats::runif(20, 0, 60), stats::runif(20)))
  xyz <- rbind(half, across_plane(half), c(0, 3, 9))
  partner <- c(21:40, 1:20, 41)
  turn <- rotation_about(c(0.3, -0.4, 0.5))
  moved <- sweep(xyz %*% turn, 2, c(5, -60, 9), `+`)
  found <- on_mirror_plane(moved, partner)
  expect_equal(across_plane(found)[partner, ], found)
  expect_equal(c(stats::dist(found)), c(stats::dist(xyz)))
  # What is on the plane already is left alone.
  expect_equal(on_mirror_plane(xyz, partner), xyz)
  # Asymmetric: no other plane leaves less between the points and their mirror images.
  bent <- moved + with_seed(2, matrix(stats::rnorm(123, 0, 2), 41))
  found <- on_mirror_plane(bent, partner)
  left <- function(x) sum((x - across_plane(x)[partner, ])^2)
  for (axis in 2:3) for (angle in c(-0.02, 0.02)) {
    expect_lt(left(found), left(found %*% rotation_about(replace(numeric(3), axis, angle))))
  }
  expect_lt(left(found), left(sweep(found, 2, c(0.2, 0, 0))))
  expect_lt(left(found), left(sweep(found, 2, c(-0.2, 0, 0))))
  # Without pairs there is no plane.
  expect_identical(on_mirror_plane(bent, rep(NA_integer_, 41)), bent)
  some <- on_mirror_plane(moved, replace(partner, c(3, 23), NA))
  expect_equal(across_plane(some)[partner, ], some)
})
