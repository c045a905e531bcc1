# Sums by group of many regroupings.

test_that("sums of members are matrix products", {
  with_seed(1, for (size in list(c(1, 1, 1), c(5, 3, 4), c(32, 8, 1), c(33, 9, 2), c(70, 21, 30))) {
    x <- matrix(stats::rnorm(size[1] * size[2]), size[1])
    member <- matrix(sample(0:1, size[2] * size[3], TRUE), size[2])
    expect_equal(cpp_member_sums(x, member), x %*% member, tolerance = 1e-13)
  })
})

test_that("bootstrap sums count a specimen as often as it is drawn", {
  counts <- matrix(c(0L, 1L, 2L, 5L, 0L, 9L), 3)
  x <- matrix(c(1, -2, 3, 0.5, 4, -1), 2)
  expect_equal(drawn_sums(x, counts), x %*% counts, tolerance = 1e-13)
})

test_that("the greatest group's sums are minus the others'", {
  sums <- list(matrix(1:4, 2), matrix(5:8, 2))
  expect_identical(of_groups(sums, function(x) x^2, c(3, 9, 4)),
                   list(sums[[1]]^2, (sums[[1]] + sums[[2]])^2, sums[[2]]^2))
  expect_identical(of_groups(sums[1], sum, c(3, 9)), list(10L, 10L))
})

test_that("sums that memory cannot hold are refused before a file is read", {
  large <- list(mean = matrix(0, 1e6, 3), weights = 1)
  labels <- matrix(rep(1:2, 2000), 2)
  expect_crestline_error(sums_in_files(large, labels, matrix(1L, 2, 3), NULL),
                         c("`n_perm` is 1999", "GB"))
  expect_silent(check_sums(list(mean = matrix(0, 921, 3)), 1, 1e5, 1000))
})
