# A ball of some subdivision beside another.
two_balls <- function(second = 3, apart = 5) {
  one <- Rvcg::vcgSphere(3)
  other <- Rvcg::vcgSphere(second)
  other$vb[1, ] <- other$vb[1, ] + apart
  structure(list(vb = cbind(one$vb, other$vb), it = cbind(one$it, other$it + ncol(one$vb))),
            class = "mesh3d")
}
top <- rbind(top = c(0, 0, 1), front = c(0, 1, 0))

test_that("a second large piece without landmarks is told of, with its share", {
  expect_warning(one <- specimen(two_balls(), top, id = "pair"), "50 % of the triangles",
                 class = "crestline_bare_piece")
  row <- one$report[one$report$check == "isolated pieces", ]
  expect_match(row$action, "the largest has 50.0 % of the triangles")
  expect_output(print(one), "50.0 %")
})

test_that("scraps, pieces with landmarks, and meshes without landmarks are not told of", {
  expect_no_warning(small <- specimen(two_balls(1), top, id = "scrap"))
  expect_match(small$report$action[small$report$check == "isolated pieces"], "5.9 %")
  expect_no_warning(specimen(two_balls(), rbind(top, other = c(5, 0, 1)), id = "both"))
  expect_no_warning(specimen(two_balls(), id = "bare"))
})
