# Mean and spread by age: mgcv's gaulss, REML by brute force, and closed forms.

# n people, columns whose mean and spread are known functions of age.
grown_columns <- function(n, seed = 1) {
  with_seed(seed, {
    age <- stats::runif(n, 3, 40)
    sd <- exp(-1 + 0.5 * stats::plogis((age - 12) / 3))
    mean <- cbind(log(age), sin(age / 8), 0 * age)
    list(age = age, sex = factor(rep_len(c("f", "m"), n)), sd = sd, mean = mean,
         y = mean + sd * matrix(stats::rnorm(3 * n), n))
  })
}

test_that("means and spreads are those of mgcv's gaulss, near enough", {
  made <- grown_columns(600)
  size <- list(k = 10, k_spread = 6, range = c(3, 40))
  fit <- smooth_columns(made$y, made$age, made$sex, size)
  at <- data.frame(age = seq(4, 39, 1), sex = factor("f", c("f", "m")))
  own <- expected_columns(fit, at$age, at$sex)
  data <- data.frame(y = made$y[, 1], age = made$age)[made$sex == "f", ]
  other <- mgcv::gam(list(y ~ s(age, k = 10, bs = "ps"), ~ s(age, k = 6, bs = "ps")),
                     family = mgcv::gaulss(), data = data)
  found <- stats::predict(other, at, type = "response")
  expect_lt(sqrt(mean(((own$mean[, 1] - found[, 1]) / own$sd[, 1])^2)), 0.1)
  expect_lt(sqrt(mean(log(own$sd[, 1] * found[, 2])^2)), 0.05)
})

test_that("lambda has the greatest restricted likelihood, and leverages are the hat matrix's", {
  made <- grown_columns(80)
  x <- age_splines(made$age, 8, c(3, 40))
  basis <- reinsch_basis(x, 0)
  grid <- 10^seq(-2, 4, length.out = 7)
  fit <- smooth_mean(x, made$y[, 2, drop = FALSE], basis, grid)
  penalty <- crossprod(diff(diag(8), differences = 2))
  bent <- sum(log(eigen(penalty)$values[1:6]))
  reml <- sapply(grid, function(lambda) {
    inner <- crossprod(x) + lambda * penalty
    y <- made$y[, 2]
    b <- solve(inner, crossprod(x, y))
    78 * log(sum(y * (y - x %*% b))) + determinant(inner)$modulus - bent - 6 * log(lambda)
  })
  expect_equal(fit$lambda, grid[which.min(reml)])
  hat <- x %*% solve(crossprod(x) + fit$lambda * penalty, t(x))
  expect_equal(as.vector(leverage_of(x, basis, fit$lambda)), diag(hat))
  expect_equal(as.vector(x %*% fit$mean), as.vector(hat %*% made$y[, 2]))
})

test_that("z of new people is normal, even from few", {
  share <- sapply(1:15, function(seed) {
    made <- grown_columns(60, seed)
    fit <- smooth_columns(made$y, made$age, made$sex,
                                      list(k = 10, k_spread = 6, range = c(3, 40)))
    new <- grown_columns(200, seed + 100)
    expected <- expected_columns(fit, new$age, new$sex)
    plain <- (new$y - expected$mean) / expected$sd
    c(mean(abs(plain) <= 1.96), mean(abs(predicted_z(new$y, expected)) <= 1.96))
  })
  expect_lt(mean(share[1, ]), 0.93)
  expect_equal(mean(share[2, ]), 0.95, tolerance = 0.02)
})

test_that("columns do not depend on each other, and rounding is as said", {
  made <- grown_columns(100)
  size <- list(k = 10, k_spread = 6, range = c(3, 40))
  all <- smooth_columns(made$y, made$age, made$sex, size, rep(1e-3, 3))
  one <- smooth_columns(made$y[, 2, drop = FALSE], made$age, made$sex, size, 1e-3)
  expect_equal(all$groups$m$mean[, 2], one$groups$m$mean[, 1])
  expect_equal(all$groups$m$mean, round(all$groups$m$mean, 3))
  expect_equal(all$groups$f$lambda[2], one$groups$f$lambda)
  # A spread that does not change is found as the standard deviation.
  flat <- matrix(rep(c(-1, -1, 1, 1), 25))
  fit <- smooth_columns(flat, made$age, made$sex, size)
  expect_equal(unname(expected_columns(fit, 20, "f")$sd[1]), 1, tolerance = 0.05)
})
