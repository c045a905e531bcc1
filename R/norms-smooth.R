# Mean and spread of many columns by age: one spline basis for all, smoothed by REML.

#' Mean and spread by age of every column of a matrix, for each group apart
#'
#' The mean of a column is a penalised cubic spline with equidistant knots. Of the basis B = Q R and
#' the penalty S of second differences, R^-T S R^-1 = U diag(s) U' (Demmler and Reinsch), so that
#' the coefficients for every lambda are R^-1 U diag(1 / (1 + lambda s)) Z' y with Z = B R^-1 U, and
#' the restricted likelihood is a sum. The log variance is a spline of the squared residuals over
#' 1 - leverage, by Fisher scoring of a gamma model with log link, whose working weights are
#' constant.
#'
#' @param y n x q.
#' @param age n.
#' @param group Factor, n.
#' @param size List: `k`, `k_spread` (numbers of splines), `range` (of ages).
#' @param unit q: what coefficients of the mean are rounded to; those of log variances to 0.001.
#' @return List: `size`, and `groups`, a list by group: `n`, `mean` (k x q), `lambda` (q), `basis`
#'   (of [reinsch_basis()]), and the same of the spread: `spread`, `lambda_spread`, `basis_spread`.
#' @noRd
smooth_columns <- function(y, age, group, size, unit = rep(0, ncol(y))) {
  groups <- lapply(stats::setNames(nm = levels(group)), function(level) {
    own <- which(group == level)
    smooth_group(y[own, , drop = FALSE], age[own], size, unit)
  })
  list(size = size, groups = groups)
}

smooth_group <- function(y, age, size, unit) {
  x <- age_splines(age, size$k, size$range)
  basis <- reinsch_basis(x)
  fit <- smooth_mean(x, y, basis)
  mean <- rounded_to(fit$mean, rep(unit, each = nrow(fit$mean)))
  squares <- (y - x %*% mean)^2 / pmax(1 - leverage_of(x, basis, fit$lambda), 0.2)
  xs <- age_splines(age, size$k_spread, size$range)
  spread <- smooth_log_variance(xs, squares)
  list(n = nrow(y), mean = mean, lambda = fit$lambda, basis = basis,
       spread = rounded_to(spread$coef, 1e-3), lambda_spread = spread$lambda,
       basis_spread = spread$basis)
}

#' Numbers as whole multiples of a unit; unit 0: as they are
#' @noRd
rounded_to <- function(x, unit) {
  unit <- rep_len(unit, length(x))
  at <- which(unit > 0)
  x[at] <- round(x[at] / unit[at]) * unit[at]
  x
}

#' n x k cubic B-splines with equidistant knots
#' @noRd
age_splines <- function(age, k, range) {
  step <- diff(range) / (k - 3)
  splines::splineDesign(range[1] + step * (-3:k), pmin(pmax(age, range[1]), range[2]), 4)
}

#' The basis of Demmler and Reinsch
#'
#' @param ridge Added to the diagonal, as a share of its largest value: ages without people.
#' @return List: `turn` (k x k: R^-1 U), `s` (k, from the largest).
#' @noRd
reinsch_basis <- function(x, ridge = 1e-7) {
  k <- ncol(x)
  penalty <- crossprod(diff(diag(k), differences = 2))
  gram <- crossprod(x)
  root <- chol(gram + ridge * max(diag(gram)) * (diag(k) + penalty))
  inverse <- backsolve(root, diag(k))
  axes <- eigen(crossprod(inverse, penalty %*% inverse), symmetric = TRUE)
  list(turn = inverse %*% axes$vectors, s = pmax(axes$values, 0))
}

#' Coefficients of the means, with the lambda of greatest restricted likelihood
#' @param grid Values of lambda.
#' @noRd
smooth_mean <- function(x, y, basis, grid = 10^seq(-4, 6, length.out = 41)) {
  a <- crossprod(x %*% basis$turn, y)
  n <- nrow(x)
  squares <- colSums(y^2)
  bent <- utils::head(basis$s, -2)
  criterion <- vapply(grid, function(lambda) {
    left <- pmax(squares - colSums(a^2 / (1 + lambda * basis$s)), 1e-12 * squares + 1e-300)
    (n - 2) * log(left) + sum(log1p(lambda * bent)) - sum(log(lambda * bent))
  }, numeric(ncol(y)))
  lambda <- grid[max.col(-matrix(criterion, ncol(y)), "first")]
  list(mean = basis$turn %*% (a / (1 + outer(basis$s, lambda))), lambda = lambda)
}

#' n x q: how far each face decides its own mean
#' @noRd
leverage_of <- function(x, basis, lambda) {
  (x %*% basis$turn)^2 %*% (1 / (1 + outer(basis$s, lambda)))
}

#' Log variance of columns from squared residuals, by Fisher scoring
#'
#' @param variance Of a squared standardised residual: 2 of a normal one.
#' @param most Largest relative step up of one face, so that an outlier does not lead.
#' @param rounds Most rounds; in the first `free` of them lambda is chosen.
#' @return List: `coef`, `lambda`, `basis`, `converged`.
#' @noRd
smooth_log_variance <- function(x, squares, variance = 2, most = 8, rounds = 30, free = 4,
                                tolerance = 1e-4) {
  basis <- reinsch_basis(x)
  squares <- pmax(squares, 1e-12)
  eta <- matrix(log(colMeans(squares)), nrow(x), ncol(squares), byrow = TRUE)
  lambda <- NULL
  for (round in seq_len(rounds)) {
    fit <- smooth_known(x, eta + pmin(squares / exp(eta) - 1, most), basis, variance, lambda)
    new <- x %*% fit$coef
    if (round == free) lambda <- fit$lambda
    moved <- max(abs(new - eta))
    eta <- new
    if (round > free && moved < tolerance) break
  }
  c(fit, list(basis = basis, converged = moved < tolerance))
}

#' Smoothing with a known variance
#' @noRd
smooth_known <- function(x, y, basis, variance, lambda, grid = 10^seq(-3, 6, length.out = 31)) {
  a <- crossprod(x %*% basis$turn, y)
  bent <- utils::head(basis$s, -2)
  if (is.null(lambda)) {
    squares <- colSums(y^2)
    criterion <- vapply(grid, function(one) {
      (squares - colSums(a^2 / (1 + one * basis$s))) / variance + sum(log1p(one * bent)) -
        sum(log(one * bent))
    }, numeric(ncol(y)))
    lambda <- grid[max.col(-matrix(criterion, ncol(y)), "first")]
  }
  list(coef = basis$turn %*% (a / (1 + outer(basis$s, lambda))), lambda = lambda)
}

#' What is expected at ages: mean and spread of every column, and their leverages
#'
#' @return List of n x q matrices: `mean`, `sd`, `h` (leverage of the mean), `h_spread`.
#' @noRd
expected_columns <- function(fit, age, group) {
  q <- length(fit$groups[[1]]$lambda)
  empty <- matrix(NA_real_, length(age), q)
  found <- list(mean = empty, sd = empty, h = empty, h_spread = empty)
  for (level in names(fit$groups)) {
    own <- which(group == level)
    if (!length(own)) next
    one <- fit$groups[[level]]
    x <- age_splines(age[own], fit$size$k, fit$size$range)
    xs <- age_splines(age[own], fit$size$k_spread, fit$size$range)
    found$mean[own, ] <- x %*% one$mean
    found$sd[own, ] <- exp(xs %*% one$spread / 2)
    found$h[own, ] <- leverage_of(x, one$basis, one$lambda)
    found$h_spread[own, ] <- leverage_of(xs, one$basis_spread, one$lambda_spread)
  }
  found
}

#' z of new values: prediction of a normal variable whose mean and spread were estimated
#'
#' @param y n x q.
#' @param extra Variance that a worse scan adds, n x q or one number.
#' @param fewest Least degrees of freedom.
#' @noRd
predicted_z <- function(y, expected, extra = 0, fewest = 3) {
  z <- (y - expected$mean) / sqrt(expected$sd^2 + extra) / sqrt(1 + expected$h)
  df <- pmax(fewest, 1 / expected$h_spread)
  low <- stats::qnorm(stats::pt(-abs(z), df, log.p = TRUE), log.p = TRUE)
  -low * sign(z)
}

#' Standard error of z by the norm itself
#' @param factor The bias of smoothing, which the leverages leave out.
#' @noRd
norm_error <- function(z, expected, factor = 1.25) {
  factor * sqrt(expected$h + z^2 * expected$h_spread / 2)
}
