# Discs that are left out of a face, and made up from the rest.

test_that("squares of what is missed are those of each face by itself", {
  field <- small_norms()$surface
  u <- with_seed(3, matrix(stats::rnorm(105 * 4), 105))
  inverse <- invert_field(field)
  disc <- c(4, 5, 12, 13)
  found <- disc_squares(field, inverse, lapply(inverse$roots, chol2inv), apply_inverse(inverse, u),
                        disc)
  each <- sapply(1:4, function(i) {
    made <- given_the_rest(field, u[, i], rep(seq_len(35) %in% disc, 3))
    missed <- matrix((u[, i] - made$fit) * field$sd, ncol = 3)
    (row_products(missed, field$normal)^2 /
       variance_along(field$normal, made$variance * field$sd^2))[disc]
  })
  expect_equal(found, rowMeans(each), tolerance = 0.02, ignore_attr = TRUE)
})

test_that("faces that the field describes need no wider interval, others do", {
  field <- small_norms()$surface
  pose <- pose_directions(field)
  whole <- field$vectors %*% (field$values * t(field$vectors)) + block_kernel(field) +
    tcrossprod(pose)
  u <- with_seed(5, matrix(stats::rnorm(300 * 105), 300)) %*% chol(whole)
  table <- healing_table(field, u, c(12, 30), centres = 4)
  expect_equal(nrow(table), 8)
  expect_equal(table$base + table$peak / 3, rep(1, 8), tolerance = 0.15)
  twice <- healing_table(field, 2 * u, c(12, 30), centres = 4)
  expect_equal(twice$base, 4 * table$base, tolerance = 1e-3)
  field$healing <- twice
  wider <- wider_by(field, list(at = table$at[1], radius = 30), c(0, 10, 20))
  expect_equal(wider[c(1, 3)], c(twice$base[5] + twice$peak[5], twice$base[5]))
  rounded <- list(at = table$at[1], radius = 30 * (1 + 1e-15))
  expect_identical(wider_by(field, rounded, c(0, 10, 20)), wider)
  # A disc of its centre alone
  expect_equal(wider_by(field, rounded, 0), wider[1])
})

test_that("a disc has at most its share of the points", {
  distance <- c(0, 1, 2, 3, 4, 5, 6, 7, 8, 9)
  expect_equal(which(lesion_disc(distance, 2)), 1:4)
  expect_equal(which(lesion_disc(distance, 20)), 1:4)
  expect_equal(which(lesion_disc(distance, 20, most = 0.5)), 1:5)
})
