# n persons seen twice, `effect` at the first points the second time; what persons differ by is ten
# times as much.
paired_sample <- function(n = 12, effect = 0.03, seed = 1, k = 8) {
  with_seed(seed, {
    base <- matrix(stats::rnorm(3 * k), k)
    person <- array(stats::rnorm(3 * k * n, sd = 0.1), c(k, 3, n))
    x <- array(as.vector(base), c(k, 3, 2 * n)) + person[, , rep(seq_len(n), 2)] +
      stats::rnorm(6 * k * n, sd = 0.01)
  })
  x[1:3, 3, n + seq_len(n)] <- x[1:3, 3, n + seq_len(n)] + effect
  list(x = x, time = factor(rep(c("before", "after"), each = n), c("before", "after")),
       person = rep(paste0("p", seq_len(n)), 2))
}

blocked <- function(data, ..., seed = 1) {
  comparing(data$x, data$time, block = data$person, seed = seed, progress = FALSE, ...)
}

test_that("pairs are compared within persons: the paired t, and what differs is found", {
  data <- paired_sample()
  compared <- blocked(data, n_perm = 199, exact = 0)
  size <- align(data$x)$size
  theirs <- t.test(size[1:12], size[13:24], paired = TRUE)
  own <- compared$tests[compared$tests$test == "size t", ]
  expect_equal(own$statistic, theirs$statistic[["t"]], tolerance = 1e-8)
  expect_equal(own$p_parametric, theirs$p.value, tolerance = 1e-8)
  apart <- blocked(data, n_perm = 19, exact = 0, equal_spread = FALSE, tests = "size")$tests
  expect_equal(c(apart$statistic, apart$p_parametric), c(own$statistic, own$p_parametric),
               tolerance = 1e-8)
  shape <- function(x) x$tests$p_value[x$tests$test == "mean shape"]
  expect_lte(shape(compared), 0.01)
  free <- compare_groups(data$x, data$time, n_perm = 199, seed = 1, progress = FALSE)
  expect_gt(shape(free), 0.5)
  expect_match(capture.output(compared), "exchanged within 12 blocks", all = FALSE)
  expect_false("dispersion" %in% compared$tests$test)
})

test_that("few pairs are exchanged in every way: p of flips of signs", {
  data <- paired_sample(6, 0.02)
  compared <- blocked(data, exact = 64, tests = "size")
  expect_true(compared$exact)
  expect_equal(compared$n_perm, 63)
  size <- align(data$x)$size
  off <- size[1:6] - size[7:12]
  flips <- as.matrix(expand.grid(rep(list(c(1, -1)), 6)))
  each <- abs(flips %*% off)
  expect_equal(compared$tests$p_value, mean(each >= each[1] * (1 - 1e-10)))
})

test_that("regroupings within blocks keep every block's own specimens", {
  group <- factor(c("a", "b", "a", "b", "b", "a", "a"))
  block <- c("x", "x", "y", "y", "y", "z", "z")
  design <- comparison_design(stats::setNames(group, 1:7), block)
  expect_equal(design$silent, "z")
  code <- as.integer(group)
  for (exact in c(0, 100)) {
    labels <- design_regroupings(design, 50, exact, NULL, 1)$labels
    expect_equal(labels[, 1], code)
    each <- apply(labels, 2,
                  function(own) tapply(own, block, function(x) paste(sort(x), collapse = "")))
    expect_true(all(each == each[, 1]))
  }
  expect_equal(ncol(labels), 6)
  expect_equal(anyDuplicated(t(labels)), 0)
})

test_that("repeated scans of persons count once", {
  data <- paired_sample(10, 0)
  sex <- rep(rep(c("F", "M"), each = 5), 2)
  names(sex) <- NULL
  compared <- compare_groups(data$x, sex, block = data$person, n_perm = 99, seed = 1,
                             progress = FALSE, settings = comparison_settings(exact = 0))
  size <- align(data$x)$size
  mean <- (size[1:10] + size[11:20]) / 2
  theirs <- t.test(mean[1:5], mean[6:10], var.equal = TRUE)
  own <- compared$tests[compared$tests$test == "size t", ]
  expect_equal(own$statistic, theirs$statistic[["t"]], tolerance = 1e-8)
  expect_equal(nrow(compared$pca[[1]]$x), 10)
  expect_match(capture.output(compared), "the means of 10 blocks are compared", all = FALSE)
})

test_that("blocks that cannot be are refused", {
  data <- paired_sample(6)
  plainly <- function(...) comparing(data$x, data$time, n_perm = 19, progress = FALSE, ...)
  expect_crestline_error(plainly(block = 1:3), "`block` has 3 values for 12")
  expect_crestline_error(plainly(block = replace(data$person, 2, NA)), "`block` is missing for 2")
  expect_crestline_error(plainly(block = data$person, permutations = diag(12)), "both given")
  expect_crestline_error(plainly(block = data$time), "has one block")
  expect_no_error(plainly(block = data$person))
})
