# Twenty shapes of ten points that are alike, one of them changed.
alike <- function(change = identity, n = 20, sd = 0.02) {
  x <- with_seed(1, array(stats::rnorm(30), c(10, 3, n)) + stats::rnorm(30 * n, sd = sd))
  dimnames(x) <- list(letters[1:10], c("x", "y", "z"), paste0("s", seq_len(n)))
  change(x)
}

test_that("a good sample is aligned without a word, of whatever size and poses", {
  expect_no_warning(align(alike()))
  for (seed in 1:3) expect_no_warning(align(posed_sample(sd = 0.1, seed = seed)))
  expect_no_warning(align(alike(sd = 0)))
  twice <- alike()
  twice[, , 7] <- twice[, , 3]
  expect_warning(align(twice), "under two names: s3 and s7", class = "crestline_twin")
  growing <- alike(function(x) x * rep(seq(0.5, 2, length.out = 20), each = 30))
  expect_no_warning(align(growing))
})

test_that("a specimen with two points exchanged is named, and it is told that few stand out", {
  swapped <- alike(function(x) {
    x[c("c", "g"), , "s12"] <- x[c("g", "c"), , "s12"]
    x
  })
  expect_warning(align(swapped, "landmarks"), "landmarks: far from the others: s12",
                 class = "crestline_far")
  expect_warning(align(swapped), class = "crestline_sample_doubt")
  expect_no_warning(align(swapped, limits = sample_limits(far = Inf, point = Inf)))
  expect_no_warning(align(swapped[, , c(1:3, 12)]))
})

test_that("one point beside its place is named, though the shape as a whole is near", {
  moved <- alike(function(x) {
    x["b", 1, "s3"] <- x["b", 1, "s3"] + 0.8
    x
  }, sd = 0.03)
  expect_warning(align(moved, limits = sample_limits(far = Inf)),
                 "points far from those of the others: b of s3", class = "crestline_point")
})

test_that("sizes that differ as units do are told, with the ratio", {
  mixed <- alike(function(x) {
    x[, , "s5"] <- x[, , "s5"] / 1000
    x
  })
  expect_warning(align(mixed), "s5 .0.00099 times", class = "crestline_size")
  expect_warning(compare_groups(mixed, rep(1:2, 10), n_perm = 19, progress = FALSE,
                                settings = comparison_settings(tests = "size")),
                 class = "crestline_size")
})

test_that("points estimated for too many, or too many of one, and far from the rest are told", {
  lacking <- alike(function(x) {
    x["a", , 1:8] <- NA
    x
  })
  limits <- function(...) sample_limits(beyond = Inf, ...)
  expect_warning(align(lacking, limits = limits()),
                 "more than 33 % of the specimens: a \\(1 point\\)", class = "crestline_estimated")
  expect_no_warning(align(lacking[, , 6:20], limits = limits()))
  poor <- alike(function(x) {
    x[1:4, , "s2"] <- NA
    x
  })
  expect_warning(align(poor, limits = limits()), "of the points are estimated of s2",
                 class = "crestline_estimated")
  expect_no_warning(align(poor, limits = limits(estimated = 0.5)))
  expect_equal(reach_beyond(cbind(c(-1, 1), 0, 0), rbind(c(0.5, 0, 0), c(3, 0, 0))), 2)
  # A row of points of which the last is far out.
  row <- with_seed(2, array(cbind(c(0:8, 14), stats::rnorm(10), stats::rnorm(10)), c(10, 3, 8)) +
                      stats::rnorm(240, sd = 0.05))
  dimnames(row) <- list(letters[1:10], NULL, paste0("s", 1:8))
  row["j", , "s4"] <- NA
  expect_warning(align(row), "points are estimated far from those that are there: of s4",
                 class = "crestline_beyond")
  row["j", , "s4"] <- row["j", , "s3"]
  row["e", , "s4"] <- NA
  expect_no_warning(align(row))
})

test_that("an alignment and a comparison print how many points were estimated, and of whom", {
  lacking <- alike(function(x) {
    x["a", , 1:3] <- NA
    x["b", , 2] <- NA
    x
  })
  aligned <- align(lacking, limits = sample_limits(beyond = Inf))
  expect_output(print(aligned), "missing and estimated: 4 points of s1, s2, s3; most, 2, of s2",
                fixed = TRUE)
  gone <- data.frame(id = "s1", point = c("a", "b"), action = "estimated")
  expect_identical(missing_lines(gone), "missing and estimated: 2 points of s1")
  compared <- compare_groups(aligned, rep(1:2, 10), n_perm = 19, progress = FALSE,
                             settings = comparison_settings(tests = "size"))
  expect_output(print(compared), "missing and estimated: 4 points of s1, s2, s3", fixed = TRUE)
})

test_that("limits are numbers above 0", {
  expect_crestline_error(sample_limits(far = 0), "`far`")
  expect_crestline_error(sample_limits(fewest = 2), "`fewest`")
  expect_crestline_error(align(alike(), limits = list()), "sample_limits()")
  expect_output(print(sample_limits()), "size = 5")
})
