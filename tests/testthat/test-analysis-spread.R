# Two groups whose co-ordinates have one mean, the second's spread `ratio` times the first's.
spread_sample <- function(n, ratio, seed, effect = 0, k = 8) {
  data <- grouped_sample(n, effect, k = k, sd = 0.02, seed = seed)
  base <- with_seed(seed + 1000, matrix(stats::rnorm(3 * k), k))
  second <- data$group == "b"
  data$x[, , second] <- as.vector(base) + ratio * (data$x[, , second] - as.vector(base))
  data
}

apart_quietly <- function(...) compare_groups(..., equal_spread = FALSE, progress = FALSE)

test_that("sizes and scores are tested by Welch's t, on Satterthwaite's degrees of freedom", {
  data <- spread_sample(c(14, 7), 3, 1)
  data$x <- data$x * rep(with_seed(3, runif(21, 1, 1.4)), each = 24)
  compared <- apart_quietly(data$x, data$group, n_perm = 99, seed = 1)
  row <- function(test) compared$tests[compared$tests$test == test, ]
  size <- align(data$x)$size
  theirs <- t.test(size[1:14], size[15:21])
  expect_equal(row("size t")$statistic, theirs$statistic[["t"]], tolerance = 1e-10)
  expect_equal(row("size t")$p_parametric, theirs$p.value, tolerance = 1e-10)
  score <- shape_pca(align(data$x))$x[, 2]
  theirs <- t.test(score[1:14], score[15:21])
  expect_equal(row("PC2")$statistic, theirs$statistic[["t"]], tolerance = 1e-8)
  expect_equal(row("PC2")$p_parametric, theirs$p.value, tolerance = 1e-8)
})

test_that("T2 has separate covariances, on as many components as the degrees of freedom allow", {
  data <- spread_sample(c(14, 9), 2, 2)
  compared <- apart_quietly(data$x, data$group, n_perm = 19, seed = 1, tests = "T2")
  aligned <- align(data$x)
  first <- data$group == "a"
  flat <- t(matrix(aligned$coords, 24))
  # Satterthwaite's degrees of freedom of the summed variance.
  part <- c(sum(diag(cov(flat[first, ]))) / 14, sum(diag(cov(flat[!first, ]))) / 9)
  count <- sum(part)^2 / sum(part^2 / c(13, 8)) / 3
  expect_equal(unname(compared$components), floor(count))
  x <- shape_pca(aligned)$x[, seq_len(count)]
  off <- colMeans(x[first, ]) - colMeans(x[!first, ])
  t2 <- drop(off %*% solve(cov(x[first, ]) / 14 + cov(x[!first, ]) / 9, off))
  expect_equal(compared$tests$statistic, t2, tolerance = 1e-8)
})

test_that("components are adjusted by regroupings and by Sidak's inequality", {
  data <- spread_sample(c(14, 9), 2, 2)
  own <- apart_quietly(data$x, data$group, n_perm = 99, seed = 1, tests = "components",
                       components = 4)$tests
  sidak <- 1 - (1 - own$p_parametric)^4
  expect_true(all(own$p_adjusted >= sidak - 1e-12 & own$p_adjusted >= own$p_value))
})

test_that("variance in all directions alike has as many effective dimensions as directions", {
  cross <- rbind(diag(3), -diag(3))
  y <- lapply(1:3, function(d) cbind(cross[, d], cross[, 1]))
  expect_equal(effective_dimensions(y), c(3, 1))
})

test_that("with more groups F is that of Brown and Forsythe", {
  size <- with_seed(5, c(rnorm(6), rnorm(8, sd = 2), rnorm(5, sd = 4)))
  code <- rep(1:3, c(6, 8, 5))
  variance <- tapply(size, code, var)
  n <- c(6, 8, 5)
  f <- sum(n * (tapply(size, code, mean) - mean(size))^2) / sum((1 - n / 19) * variance)
  y <- cbind(size - mean(size))
  own <- observed_f(squared_sums(list(y)), y^2, code, list(equal = FALSE, lost = 0))
  expect_equal(own$f, f)
  part <- (1 - n / 19) * variance
  expect_equal(own$df, sum(part)^2 / sum(part^2 / (n - 1)))
})

test_that("if a small group varies most, pooled tests reject equal means, separate ones do not", {
  p <- vapply(1:100, function(seed) {
    data <- spread_sample(c(24, 6), 3, seed)
    of <- function(equal) {
      found <- suppressWarnings(compare_groups(data$x, data$group, n_perm = 99, exact = 0,
                                               seed = seed, progress = FALSE,
                                               tests = c("shape", "points"), equal_spread = equal))
      c(found$tests$p_value[1], min(found$points$p_adjusted))
    }
    c(of(TRUE), of(FALSE))
  }, numeric(4))
  rejected <- rowMeans(p <= 0.05)
  expect_true(all(rejected[1:2] > 0.4))
  expect_true(all(rejected[3:4] <= qbinom(0.999, 100, 0.05) / 100))
})

test_that("unequal groups of unequal spread are warned of, and only these", {
  data <- spread_sample(c(20, 6), 3, 1)
  quietly <- function(data, equal_spread = TRUE) {
    suppressWarnings(compare_groups(data$x, data$group, n_perm = 19, seed = 1, progress = FALSE,
                                    equal_spread = equal_spread), "crestline_sample_doubt")
  }
  expect_warning(quietly(data), "differ by a factor of 2[.]", class = "crestline_unequal_spread")
  class <- "crestline_unequal_spread"
  expect_no_warning(quietly(data, equal_spread = FALSE), class = class)
  expect_no_warning(quietly(spread_sample(c(13, 13), 3, 1)), class = class)
  even <- spread_sample(c(20, 6), 1, 1)
  expect_no_warning(quietly(even), class = class)
  expect_match(capture.output(quietly(even)), "dispersion: the spreads of the groups differ",
               all = FALSE)
})

test_that("exact duplicates do not differ", {
  compare_groups <- function(...) suppressWarnings(crestline::compare_groups(...))
  shape <- with_seed(1, matrix(rnorm(24), 8))
  other <- shape + with_seed(2, matrix(rnorm(24, sd = 0.01), 8))
  x <- simplify2array(rep(list(shape, other, 3 * shape), 4))
  group <- rep(c("a", "b"), each = 6)
  for (equal in c(TRUE, FALSE)) {
    found <- compare_groups(x, group, n_perm = 99, seed = 1, progress = FALSE,
                            equal_spread = equal)
    expect_true(all(found$tests$p_value == 1))
    expect_true(all(found$points$p_value == 1))
    alike <- x
    for (i in 1:12) alike[, , i] <- x[, , i] / sqrt(sum(scale(x[, , i], scale = FALSE)^2))
    size <- compare_groups(alike, rep(c("a", "b"), c(5, 7)), n_perm = 99, seed = 1,
                           progress = FALSE, equal_spread = equal, tests = "size")$tests
    expect_equal(size$p_value, 1)
  }
})

test_that("dispersion is found where there is one, by its ratio", {
  p <- vapply(c(1, 3), function(ratio) {
    data <- spread_sample(c(15, 15), ratio, 4)
    own <- compare_groups(data$x, data$group, n_perm = 99, exact = 0, seed = 1,
                          progress = FALSE)$tests
    own <- own[own$test == "dispersion", ]
    expect_equal(own$statistic, ratio, tolerance = 0.15)
    own$p_value
  }, 0)
  expect_gt(p[1], 0.05)
  expect_lte(p[2], 0.01)
})
