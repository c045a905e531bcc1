# Limits of a norm: what faces that it was not made of look like in it.

#' Probabilities of the quantiles that a norm keeps
#' @noRd
limit_levels <- function() c(0.5, 0.75, 0.9, 0.95, 0.975, 0.99)

limit_quantiles <- function(x) {
  signif(stats::quantile(x, limit_levels(), names = FALSE, na.rm = TRUE), 6)
}

#' p of a value by quantiles: the logarithm of p is straight between them and beyond the last
#' @noRd
tail_p <- function(value, quantiles) {
  log_p <- log(1 - limit_levels())
  last <- length(quantiles)
  rate <- (log_p[last] - log_p[3]) / max(quantiles[last] - quantiles[3], 1e-12)
  inside <- stats::approx(c(0, quantiles), c(0, log_p), value, ties = "mean", rule = 2)$y
  exp(ifelse(value > quantiles[last], log_p[last] + rate * (value - quantiles[last]), inside))
}

#' All faces held out in turn
#'
#' @param data,plan As in [fit_parts()]; `scales` as in [hold_out()].
#' @return List: `z` (n x m), `map` (n), `surface`, `asymmetry`: lists `t` (by bump n x k),
#'   `rough` (n), `u`; `privacy`: of [membership()].
#' @noRd
cross_validated <- function(data, plan, scales, progress) {
  # Which fold each face is held out in: alike in ages and sexes
  order <- order(data$people$group, data$people$age)
  fold <- integer(length(order))
  fold[order] <- rep_len(seq_len(plan$folds), length(order))
  n <- length(fold)
  found <- NULL
  attack <- list()
  if (progress) cli::cli_progress_bar("Holding faces out", total = plan$folds)
  for (one in seq_len(plan$folds)) {
    rows <- which(fold == one)
    parts <- fit_parts(data, which(fold != one), plan)
    held <- hold_out(parts, data, rows, plan$radii, scales)
    attack[[one]] <- membership(parts$surface, data, which(fold != one), rows)
    if (is.null(found)) found <- empty_like(held, n)
    found <- put_rows(found, held, rows)
    if (progress) cli::cli_progress_update()
  }
  c(found, list(privacy = do.call(rbind, attack)))
}

#' A nested list of vectors and matrices with n rows in place of its own, and rows put into it
#' @noRd
empty_like <- function(x, n) {
  if (is.null(x)) return(NULL)
  if (is.list(x)) return(lapply(x, empty_like, n))
  if (is.matrix(x)) matrix(NA_real_, n, ncol(x), dimnames = list(NULL, colnames(x))) else
    rep(NA_real_, n)
}

put_rows <- function(x, part, rows) {
  if (is.null(x)) return(NULL)
  if (is.list(x)) return(Map(put_rows, x, part, MoreArgs = list(rows = rows)))
  if (is.matrix(x)) x[rows, ] <- part else x[rows] <- part
  x
}

#' Residuals of the projection on the components: of as many members as strangers
#'
#' @param shares Shares of the components that are tried, all first: what fewer would tell.
#' @return Data frame: `components`, `member`, `stranger` (root mean squares).
#' @noRd
membership <- function(field, data, members, strangers, shares = c(1, 0.75, 0.5, 0.25)) {
  members <- members[round(seq(1, length(members), length.out = length(strangers)))]
  counts <- unique(ceiling(shares * ncol(field$vectors)))
  residuals <- function(rows) {
    expected <- expected_columns(field$columns, data$people$age[rows], data$people$group[rows])
    u <- (data$y[rows, , drop = FALSE] - expected$mean) / expected$sd
    lapply(counts, function(count) {
      own <- field$vectors[, seq_len(count), drop = FALSE]
      left <- (u - tcrossprod(u %*% own, own)) * expected$sd
      sqrt(rowSums(left^2) * 3 / ncol(left))
    })
  }
  data.frame(components = rep(counts, each = length(strangers)),
             member = unlist(residuals(members)), stranger = unlist(residuals(strangers)))
}

#' How well files of some numbers of components tell a member from a stranger
#' @return Data frame: `components` (most first), `ratio` of the root mean squares, `auc`.
#' @noRd
privacy_figures <- function(residuals) {
  each <- lapply(split(residuals, -residuals$components), function(own) {
    n <- nrow(own)
    rank <- rank(c(own$member, own$stranger))
    auc <- (sum(rank[n + seq_len(n)]) - n * (n + 1) / 2) / n^2
    data.frame(components = own$components[1],
               ratio = signif(sqrt(mean(own$member^2) / mean(own$stranger^2)), 4),
               auc = signif(auc, 4))
  })
  do.call(rbind, unname(each))
}

#' The scan's scales and limit by held-out statistics
#'
#' @param t List by bump of [scan_bumps()] of n x k.
#' @param field Its points are those of the statistics.
#' @param people,plan As in [fit_parts()].
#' @return List: `radii`, `both` (of the bumps), `s` (k x bumps: spread of the statistic by place),
#'   `by_age` (list by group of coefficients, k_spread x bumps), `size` (of the splines),
#'   `quantiles` of the largest.
#' @noRd
scan_limits <- function(t, field, people, plan) {
  bumps <- scan_bumps(field, plan$radii)
  s <- vapply(seq_along(t), function(q) sqrt(colMeans(t[[q]]^2)), numeric(ncol(t[[1]])))
  if (length(people$age) < plan$smooth_below) {
    distance <- as.matrix(stats::dist(field$points))
    for (q in seq_along(t)) {
      near <- bump(distance, bumps$radius[q])
      s[, q] <- sqrt(near %*% s[, q]^2 / rowSums(near))
    }
  }
  s <- signif(s, 4)
  squares <- vapply(seq_along(t), function(q) rowMeans(t(t(t[[q]]) / s[, q])^2),
                    numeric(length(people$age)))
  squares <- matrix(squares, length(people$age))
  size <- list(k = plan$size$k_spread, range = plan$size$range)
  by_age <- lapply(stats::setNames(nm = levels(people$group)), function(level) {
    own <- which(people$group == level)
    x <- age_splines(people$age[own], size$k, size$range)
    part <- squares[own, , drop = FALSE]
    spread <- mean(t(t(part) / colMeans(part) - 1)^2)
    rounded_to(smooth_log_variance(x, part, max(spread, 0.01))$coef, 1e-3)
  })
  limits <- list(radii = bumps$radius, both = bumps$both, s = s, by_age = by_age, size = size)
  c(limits, list(quantiles = limit_quantiles(
    apply(scan_maps(t, limits, people$age, people$group)$largest, 1, max)
  )))
}

#' The scan's statistics over their spread at each place, age and group
#'
#' @param extra List by bump of n x k: variance that a worse scan adds, or NULL.
#' @return List: `z` (list by bump of n x k), `largest` (n x bumps: of |z|).
#' @noRd
scan_maps <- function(t, limits, age, group, extra = NULL) {
  factor <- matrix(1, length(age), length(t))
  for (level in names(limits$by_age)) {
    own <- which(group == level)
    if (!length(own)) next
    x <- age_splines(age[own], limits$size$k, limits$size$range)
    factor[own, ] <- exp(x %*% limits$by_age[[level]] / 2)
  }
  z <- lapply(seq_along(t), function(q) {
    variance <- outer(factor[, q]^2, limits$s[, q]^2)
    t[[q]] / sqrt(if (is.null(extra)) variance else variance + extra[[q]])
  })
  largest <- vapply(z, function(one) apply(abs(one), 1, max), numeric(length(age)))
  list(z = z, largest = matrix(largest, length(age)))
}
