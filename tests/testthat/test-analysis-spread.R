# Two groups whose co-ordinates have one mean, the second's spread `ratio` times the first's.
spread_sample <- function(n, ratio, seed, effect = 0, k = 8) {
  data <- grouped_sample(n, effect, k = k, sd = 0.02, seed = seed)
  base <- with_seed(seed + 1000, matrix(stats::rnorm(3 * k), k))
  second <- data$group == "b"
  data$x[, , second] <- as.vector(base) + ratio * (data$x[, , second] - as.vector(base))
  data
}

apart_quietly <- function(...) comparing(..., equal_spread = FALSE, progress = FALSE)

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

# T2 of groups whose covariances have one form, from singular values of the specimens: `rounds`
# times components of the specimens on one scale, and the scales on these components.
one_form <- function(y, code, count, rounds = 3) {
  n <- nrow(y)
  df <- tabulate(code) - 1
  mean <- outer(code, code, `==`) / tabulate(code)[code]
  own <- rowsum(rowSums((y - mean %*% y)^2), code)[, 1] / df
  scale <- own * sum(df) / sum(df * own)
  laid <- function(y, scale) {
    by <- 1 / scale[code]
    (y - rep(colSums(y * by) / sum(by), each = n)) * sqrt(by)
  }
  for (round in seq_len(rounds)) {
    parts <- svd(laid(y, scale), count, count)
    u <- parts$u
    left <- rowsum(rowSums((u - mean %*% u)^2), code)[, 1]
    factor <- left / df * sum(df) / sum(left)
    # The means as they stand by the scales found.
    of_means <- laid(mean %*% y, scale * factor) %*% parts$v %*% diag(1 / parts$d[seq_len(count)])
    t2 <- sum(df) * sum(diag(solve(diag(count) - crossprod(mean %*% u), crossprod(of_means))))
    scale <- scale * factor * sum(df) / sum(df * scale * factor)
  }
  list(t2 = t2, scale = scale)
}

test_that("T2 has covariances of one form, on components of specimens brought to one scale", {
  for (sizes in list(c(14, 9), c(10, 8, 6))) {
    n <- sum(sizes)
    code <- rep(seq_along(sizes), sizes)
    y <- with_seed(2, matrix(rnorm(n * 40), n)) %*% diag(seq(2, 0.2, length.out = 40))
    y <- (y * c(1, 2, 3)[code]) %*% diag(rep(1, 40))
    y <- sweep(y, 2, colMeans(y))
    u <- svd(y, n - 1, 0)
    x <- u$u %*% diag(u$d[seq_len(n - 1)])
    labels <- cbind(code, with_seed(3, replicate(3, sample(code))), deparse.level = 0)
    ours <- common_form(x, labels, 5)
    theirs <- one_form(y, code, 5)
    expect_equal(ours$scale, theirs$scale, tolerance = 1e-8, ignore_attr = TRUE)
    # In variance, and greatest for the group that varies most.
    expect_equal(order(ours$scale), seq_along(sizes))
    laid <- on_one_scale(y, code, ours$scale)
    for (b in 1:4) {
      expect_equal(ours$t2[b], one_form(laid, labels[, b], 5)$t2, tolerance = 1e-8)
    }
    expect_equal(common_form(1e4 * x, labels, 5)$t2, ours$t2)
  }
  data <- spread_sample(c(14, 9), 2, 2)
  compared <- apart_quietly(data$x, data$group, n_perm = 19, seed = 1, tests = "T2", components = 5)
  aligned <- align(data$x)
  y <- scale(t(matrix(aligned$coords, 24)), scale = FALSE)
  among <- svd(y, 15, 15)
  code <- as.integer(data$group)
  y <- among$u %*% diag(among$d[1:15])
  theirs <- one_form(on_one_scale(y, code, one_form(y, code, 5)$scale), code, 5)
  expect_equal(compared$tests$statistic, theirs$t2, tolerance = 1e-8)
  expect_equal(unname(compared$components), 5)
})

test_that("on one scale groups vary alike, and their means are as far apart as they vary", {
  code <- rep(1:3, c(8, 4, 5))
  y <- with_seed(4, matrix(rnorm(34), 17))
  y <- sweep(y, 2, colMeans(y))
  scale <- c(0.5, 1, 4)
  laid <- on_one_scale(y, code, scale)
  for (g in 1:3) expect_equal(cov(laid[code == g, ]), cov(y[code == g, ]) / scale[g])
  expect_equal(colMeans(laid), c(0, 0))
  two <- on_one_scale(y, rep(1:2, c(12, 5)), c(0.5, 3))
  off <- function(x) colMeans(x[1:12, ]) - colMeans(x[13:17, ])
  expect_equal(off(two), off(y) * sqrt((1 / 12 + 1 / 5) / (0.5 / 12 + 3 / 5)))
  expect_equal(on_one_scale(y, code, c(1, 1, 1)), y, ignore_attr = TRUE)
})

test_that("on one scale as much lies between means, all alike, as lies there by precision", {
  code <- rep(1:4, c(8, 4, 5, 3))
  y <- with_seed(5, matrix(rnorm(60), 20))
  y <- sweep(y, 2, colMeans(y))
  scale <- c(0.5, 1, 4, 9)
  means <- rowsum(y, code) / tabulate(code)
  weight <- tabulate(code) / scale
  off <- sweep(means, 2, colSums(means * weight) / sum(weight))
  laid <- rowsum(on_one_scale(y, code, scale), code) / tabulate(code)
  expect_equal(crossprod(laid * sqrt(tabulate(code))), crossprod(off * sqrt(weight)))
  expect_equal(colSums(laid * tabulate(code)), c(0, 0, 0))
})

test_that("F of three groups has Mehrotra's degrees of freedom, and the scale is chi-squared's", {
  y <- with_seed(6, cbind(rnorm(12) * rep(1:3, 4)))
  code <- rep(1:3, 4)
  found <- group_squares(squared_sums(list(y - mean(y))), (y - mean(y))^2, cbind(code), TRUE)
  own <- separate_f(found, c(4, 4, 4))
  v <- tapply(y, code, var)
  expect_equal(own$among[1], sum(v * 2 / 3)^2 / (sum(v / 3)^2 + sum(v^2 / 3)))
  expect_equal(own$df[1], sum(v)^2 / sum(v^2 / 3))
  expect_equal(own$f[1], sum(4 * (tapply(y, code, mean) - mean(y))^2) / sum(v * 2 / 3))
  # Normal scores of what F has by its own degrees, and of chi-squared with two.
  many <- list(f = matrix(c(0.5, 2, 5)), df = matrix(30), among = matrix(1.4))
  by_f <- qnorm(pf(many$f[, 1], 1.4, 30))
  by_scale <- qnorm(pchisq(chi_squared_scale(lapply(many, rep_len, 3), 3), 2))
  expect_lt(max(abs(by_f - by_scale)), 0.05)
  expect_equal(chi_squared_scale(list(f = 2, df = 30, among = 2), 3), 30 * log1p(4 / 30))
  expect_equal(chi_squared_scale(list(f = 0, df = 30, among = 1.2), 3), 0)
})

test_that("a variance is raised towards the pooled one, at most to twice itself", {
  y <- with_seed(4, cbind(rnorm(12), c(rnorm(8), rnorm(4, sd = 0.1)),
                          c(rnorm(8, sd = 0.1), rnorm(4))))
  y <- sweep(y, 2, colMeans(y))
  code <- rep(1:2, c(8, 4))
  variance <- apply(y, 2, function(one) tapply(one, code, var))
  raised <- pmax(variance, pmin(rep(colSums(variance * c(7, 3)) / 10, each = 2), 2 * variance))
  part <- raised / c(8, 4)
  f <- apply(y, 2, function(one) diff(tapply(one, code, mean)))^2 / colSums(part)
  df <- 3 * colSums(part)^2 / colSums(part^2 / c(7, 3))
  expect_equal(raised_scores(y, cbind(code), FALSE, 2, counted = 3)[1, ], df * log1p(f / df))
  # Some are raised, some of these to the limit.
  expect_true(any(raised > variance) && any(raised == 2 * variance))
})

test_that("components are adjusted by the greatest statistic over them", {
  data <- spread_sample(c(14, 9), 2, 2)
  own <- apart_quietly(data$x, data$group, n_perm = 99, seed = 1, tests = "components",
                       components = 4)$tests
  expect_true(all(own$p_adjusted >= own$p_value))
  expect_gte(min(own$p_adjusted), min(own$p_value))
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
      found <- suppressWarnings(compare_groups(data$x, data$group, n_perm = 99, seed = seed,
                                               progress = FALSE, equal_spread = equal,
                                               settings = comparison_settings(
                                                 exact = 0,
                                                 tests = c("shape", "points"))))
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

test_that("the loss of power with groups of unequal size is said where there is one", {
  said <- function(sizes, ...) {
    data <- spread_sample(sizes, 1, 1)
    compared <- suppressWarnings(comparing(data$x, data$group, n_perm = 19, components = 2,
                                           progress = FALSE, ...))
    any(grepl("unequal in size", capture.output(print(compared))))
  }
  expect_true(said(c(12, 6)))
  expect_false(said(c(12, 6), equal_spread = TRUE))
  expect_false(said(c(12, 6), tests = c("shape", "T2")))
  expect_false(said(c(11, 6)))
})

test_that("groups unequal in size and in spread are not advised to pool", {
  printed <- function(ratio, ...) {
    data <- spread_sample(c(20, 6), ratio, 1)
    compared <- suppressWarnings(comparing(data$x, data$group, n_perm = 19, components = 2,
                                           progress = FALSE, ...))
    paste(trimws(capture.output(print(compared))), collapse = " ")
  }
  expect_match(printed(3), "unequal size differ in spread: equal_spread = TRUE would give wrong")
  expect_no_match(printed(3), "more power")
  expect_match(printed(3, equal_spread = TRUE), "give equal_spread = FALSE")
  expect_match(printed(1), "more power")
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
                           progress = FALSE, equal_spread = equal,
                           settings = comparison_settings(tests = "size"))$tests
    expect_equal(size$p_value, 1)
  }
})

test_that("dispersion is found where there is one, by its ratio", {
  p <- vapply(c(1, 3), function(ratio) {
    data <- spread_sample(c(15, 15), ratio, 4)
    own <- compare_groups(data$x, data$group, n_perm = 99, seed = 1, progress = FALSE,
                          settings = comparison_settings(exact = 0))$tests
    own <- own[own$test == "dispersion", ]
    expect_equal(own$statistic, ratio, tolerance = 0.15)
    own$p_value
  }, 0)
  expect_gt(p[1], 0.05)
  expect_lte(p[2], 0.01)
})
