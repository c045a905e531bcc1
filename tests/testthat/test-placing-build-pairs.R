test_that("pairs are found by the mirror image, in any pose, and named by their sides", {
  half <- rbind(enL = c(2, 3, 1), exL = c(5, 3.3, 0), chL = c(3, -4, 1), n = c(0, 4, 2),
                pn = c(0, 0, 4), gn = c(0, -7, 2))
  other <- half[1:3, ] * rep(c(-1, 1, 1), each = 3)
  rownames(other) <- sub("L$", "R", rownames(other))
  at <- with_seed(1, rbind(other, half) + stats::rnorm(27, 0, 0.1))
  pairs <- mirror_pairs(at %*% rotation_about(c(1, 2, 0.5)) * 30)
  expect_equal(pairs[order(pairs$left), ], data.frame(left = c("chL", "enL", "exL"),
                                                      right = c("chR", "enR", "exR")),
               ignore_attr = TRUE)
  rownames(at) <- letters[1:9]
  expect_equal(mirror_pairs(at), data.frame(left = c("a", "b", "c"), right = c("d", "e", "f")),
               ignore_attr = TRUE)
  expect_equal(nrow(mirror_pairs(with_seed(4, matrix(stats::rnorm(36), 12,
                                                     dimnames = list(letters[1:12], NULL))))), 0)
  expect_equal(nrow(mirror_pairs(at[1:2, ])), 0)
})

test_that("curves and patches follow their landmarks, and make a lawful scheme", {
  scheme <- quad_scheme()
  curves <- data.frame(curve = c("side a", "side b", "top"), from = c("aL", "aR", "aL"),
                       to = c("bL", "bR", "aR"), kind = "plane", radius = NA, width = NA, n = 5)
  pairs <- pairs_of_all(data.frame(left = c("aL", "bL"), right = c("aR", "bR")), curves, NULL)
  expect_equal(pairs$level, c("landmarks", "landmarks", "curves"))
  expect_equal(unlist(pairs[3, 2:3]), c(left = "side a", right = "side b"))
  built <- curve_scheme(data.frame(landmark = c("aL", "aR", "bL", "bR")), curves, pairs = pairs)
  expect_equal(nrow(as.data.frame(built, "pairs")), 3)
  own <- data.frame(patch = c("left", "right"), columns = "1:5", rows = 3, rows_kept = "1:3",
                    curve_a = c("side a[1:5]", "side b[1:5]"), curve_b = "top[1:5]")
  all <- pairs_of_all(data.frame(left = c("aL", "bL"), right = c("aR", "bR")), curves,
                      own[c(2, 1), ])
  expect_equal(unlist(all[all$level == "surface", 2:3]), c(left = "left", right = "right"))
})
