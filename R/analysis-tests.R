# The statistics of a comparison of groups, for all regroupings at once.

#' Sums of squares between groups, by variable, for many regroupings
#'
#' @param y n x q matrix, columns centred.
#' @param labels n x B matrix of group numbers, every column with groups of the same sizes.
#' @return B x q matrix.
#' @noRd
between_squares <- function(y, labels) {
  sizes <- tabulate(labels[, 1])
  groups <- seq_along(sizes)[-which.max(sizes)]
  last <- 0
  total <- 0
  for (g in groups) {
    sums <- crossprod(labels == g, y)
    total <- total + sums^2 / sizes[g]
    last <- last + sums
  }
  total + last^2 / max(sizes)
}

#' The same summed over all variables, from the inner products of the specimens
#'
#' @param gram n x n, of centred rows.
#' @return B sums.
#' @noRd
between_total <- function(gram, labels) {
  sizes <- tabulate(labels[, 1])
  groups <- seq_along(sizes)[-which.max(sizes)]
  form <- function(e) colSums(e * (gram %*% e))
  total <- 0
  last <- 0
  for (g in groups) {
    e <- labels == g
    storage.mode(e) <- "double"
    total <- total + form(e) / sizes[g]
    last <- last + e
  }
  # The largest group's sum is minus that of the others.
  total + (if (length(groups) == 1) form(e) else form(last)) / max(sizes)
}

#' What the columns of y are tested by, for many regroupings: greater, the more lies between the
#' groups
#'
#' With equal spread: sum of squares between over that in all. Else, with F of Brown and Forsythe
#' (1974, with two groups the square of Welch's t) on df degrees of freedom of its own
#' (Satterthwaite's): df log(1 + (groups - 1) F / df), near to chi-squared on groups - 1 degrees
#' whatever df is (Wallace 1959). Without that a small group of great spread, which regroupings
#' dilute, would be compared with lighter tails than its own.
#'
#' @param y List of n x q matrices, columns centred, over which squares are summed (the co-ordinates
#'   of points).
#' @param labels As in [between_squares()].
#' @return B x q matrix; NA where nothing varies.
#' @noRd
group_scores <- function(y, labels, equal_spread) {
  squares <- Reduce(`+`, lapply(y, function(part) part^2))
  between <- Reduce(`+`, lapply(y, between_squares, labels))
  total <- rep(colSums(squares), each = nrow(between))
  score <- if (equal_spread) between / total else {
    apart <- separate_variance(y, squares, labels)
    f_score(between, apart$variance, apart$df, max(labels))
  }
  score[total <= 0] <- NA
  score
}

#' @param df Degrees of freedom of the variance.
#' @noRd
f_score <- function(between, variance, df, groups) {
  f <- pmin(between / variance, .Machine$double.xmax)
  df * log1p((groups - 1) * f / df)
}

#' Sum over groups of (1 - n_g / n) times the variance within the group, and its degrees of freedom
#' (Satterthwaite)
#' @return List of two B x q matrices: `variance`, `df`.
#' @noRd
separate_variance <- function(y, squares, labels) {
  sizes <- tabulate(labels[, 1])
  last <- which.max(sizes)
  sums <- lapply(y, function(part) 0)
  left <- rep(colSums(squares), each = ncol(labels))
  variance <- 0
  spent <- 0
  for (g in c(seq_along(sizes)[-last], last)) {
    if (g == last) {
      own <- left
      of_group <- sums
    } else {
      member <- labels == g
      own <- crossprod(member, squares)
      of_group <- lapply(y, function(part) crossprod(member, part))
      sums <- Map(`-`, sums, of_group)
      left <- left - own
    }
    about <- Reduce(`+`, lapply(of_group, function(x) x^2)) / sizes[g]
    part <- (1 - sizes[g] / sum(sizes)) * pmax(own - about, 0) / (sizes[g] - 1)
    variance <- variance + part
    spent <- spent + part^2 / (sizes[g] - 1)
  }
  df <- variance^2 / spent
  df[spent <= 0] <- sum(sizes) - length(sizes)
  list(variance = variance, df = df)
}

#' The same for the sum over all variables, from the inner products of the specimens
#' @param gram As in [between_total()].
#' @return B values: with equal spread the share that lies between, else F of Brown and Forsythe
#'   (1974).
#' @noRd
total_scores <- function(gram, labels, equal_spread) {
  between <- between_total(gram, labels)
  if (equal_spread) return(between / sum(diag(gram)))
  sizes <- tabulate(labels[, 1])
  variance <- 0
  for (g in seq_along(sizes)) {
    e <- labels == g
    storage.mode(e) <- "double"
    within <- drop(crossprod(e, diag(gram))) - colSums(e * (gram %*% e)) / sizes[g]
    variance <- variance + (1 - sizes[g] / sum(sizes)) * pmax(within, 0) / (sizes[g] - 1)
  }
  between / variance
}

#' The F of every column of y as it is grouped, and its degrees of freedom
#'
#' @param y As in [group_scores()].
#' @param code Group numbers.
#' @param spread List: `equal` (see [compare_groups()]), `lost` (degrees of freedom that the means
#'   of blocks take).
#' @return List: `f` (with two groups the square of t: Student's, or Welch's), `df` (below).
#' @noRd
observed_f <- function(y, code, spread) {
  labels <- cbind(code)
  n <- length(code)
  groups <- max(code)
  squares <- Reduce(`+`, lapply(y, function(part) part^2))
  between <- as.vector(Reduce(`+`, lapply(y, between_squares, labels)))
  if (spread$equal) {
    df <- n - spread$lost - groups
    within <- pmax(colSums(squares) - between, 0)
    return(list(f = between / within * df / (groups - 1), df = df))
  }
  apart <- lapply(separate_variance(y, squares, labels), as.vector)
  kept <- kept_df(n, groups, spread)
  list(f = between / apart$variance * kept, df = apart$df * kept)
}

#' Share of the degrees of freedom that the means of blocks leave
#' @noRd
kept_df <- function(n, groups, spread) (n - spread$lost - groups) / (n - groups)

#' Hotelling's T2 of many regroupings
#'
#' With more than two groups: Hotelling and Lawley's trace times n - groups, which is T2 for two.
#'
#' @param u n x c, orthonormal, centred: whitened scores.
#' @return B values.
#' @noRd
hotelling <- function(u, labels) {
  sizes <- tabulate(labels[, 1])
  n <- nrow(u)
  if (length(sizes) == 2) {
    share <- pmin(rowSums(between_squares(u, labels)), 1)
    return((n - 2) * share / (1 - share))
  }
  vapply(seq_len(ncol(labels)), function(b) {
    sums <- rowsum(u, labels[, b]) / sqrt(sizes)
    share <- pmin(eigen(tcrossprod(sums), symmetric = TRUE, only.values = TRUE)$values, 1)
    (n - length(sizes)) * sum(share / (1 - share))
  }, 0)
}

#' T2 with separate covariances of one grouping
#'
#' The trace of the squares between over the sum of (1 - n_g / n) S_g, S_g the groups' covariances;
#' with two groups T2 = d' (S_1 / n_1 + S_2 / n_2)^-1 d. Its degrees of freedom as Krishnamoorthy
#' and Yu (2004) have them.
#'
#' @return `t2`, `df`; NA without an inverse.
#' @noRd
separate_t2 <- function(u, code) {
  sizes <- tabulate(code)
  p <- ncol(u)
  each <- lapply(seq_along(sizes), function(g) {
    (1 - sizes[g] / sum(sizes)) * stats::cov(u[code == g, , drop = FALSE])
  })
  whole <- tryCatch(chol2inv(chol(Reduce(`+`, each))), error = function(e) NULL)
  if (is.null(whole)) return(c(t2 = NA_real_, df = NA_real_))
  mean <- rowsum(u, code) / sizes
  spent <- vapply(seq_along(sizes), function(g) {
    part <- each[[g]] %*% whole
    (sum(part * t(part)) + sum(diag(part))^2) / (sizes[g] - 1)
  }, 0)
  c(t2 = sum((mean %*% whole) * mean * sizes), df = (p + p^2) / sum(spent))
}

#' What T2 with separate covariances is tested by: minus the logarithm of its approximate p, as its
#' tails depend on the grouping
#' @noRd
separate_t2_scores <- function(u, labels) {
  groups <- max(labels)
  vapply(seq_len(ncol(labels)), function(b) {
    own <- separate_t2(u, labels[, b])
    -t2_tail(own[["t2"]], own[["df"]], ncol(u), groups, log = TRUE)
  }, 0)
}

#' Tail of F of T2 on its degrees of freedom; those below are at least `least`
#' @noRd
t2_tail <- function(t2, df, components, groups, log = FALSE, least = 0.5) {
  below <- pmax(df - components + 1, least)
  stats::pf(t2 * below / (df * components * (groups - 1)), components * (groups - 1), below,
            lower.tail = FALSE,
            log.p = log)
}

#' Parametric p of T2, with equal spread by F (more groups: its approximation by McKeon)
#' @noRd
hotelling_p <- function(t2, n, groups, components) {
  if (groups == 2) {
    f <- t2 * (n - components - 1) / (components * (n - 2))
    return(stats::pf(f, components, n - components - 1, lower.tail = FALSE))
  }
  trace <- t2 / (n - groups)
  s <- min(components, groups - 1)
  m <- (abs(components - groups + 1) - 1) / 2
  half <- (n - groups - components - 1) / 2
  df1 <- s * (2 * m + s + 1)
  df2 <- 2 * (s * half + 1)
  stats::pf(df2 * trace / (s^2 * (2 * m + s + 1)), df1, df2, lower.tail = FALSE)
}

#' One row of the table of tests
#' @noRd
test_row <- function(test, statistic, p_value, p_parametric = NA_real_, p_adjusted = p_value,
                     share = NA_real_) {
  data.frame(test = test, statistic = statistic, p_value = p_value, p_adjusted = p_adjusted,
             p_parametric = p_parametric,
             share = share)
}

size_test <- function(size, labels, spread) {
  y <- list(cbind(size - mean(size)))
  scores <- by_block(labels, function(part) group_scores(y, part, spread$equal))
  groups <- max(labels)
  own <- observed_f(y, labels[, 1], spread)
  sign <- if (groups == 2) sign(mean(size[labels[, 1] == 1]) - mean(size[labels[, 1] == 2])) else NA
  test_row(if (groups == 2) "size t" else "size F", if (groups == 2) sign * sqrt(own$f) else own$f,
           permutation_p(scores), stats::pf(own$f, groups - 1, own$df, lower.tail = FALSE))
}

mean_shape_test <- function(y, labels, spread) {
  gram <- tcrossprod(y)
  scores <- by_block(labels, function(part) total_scores(gram, part, spread$equal))
  between <- between_total(gram, labels[, 1, drop = FALSE])
  sizes <- tabulate(labels[, 1])
  groups <- length(sizes)
  share <- between / sum(y^2)
  kept <- kept_df(nrow(y), groups, spread)
  statistic <- if (groups == 2) sqrt(between * sum(1 / sizes)) else
    kept * if (spread$equal) share / (1 - share) * (nrow(y) - groups) / (groups - 1) else scores[1]
  test_row(if (groups == 2) "mean shape" else "mean shape F", statistic, permutation_p(scores),
           share = share)
}

t2_test <- function(pca, components, labels, spread) {
  n <- nrow(pca$x)
  groups <- max(labels)
  u <- pca$x[, seq_len(components), drop = FALSE] / rep(pca$sdev[seq_len(components)] * sqrt(n - 1),
                                                        each = n)
  score <- if (spread$equal) hotelling else separate_t2_scores
  scores <- by_block(labels, function(part) score(u, part))
  kept <- kept_df(n, groups, spread)
  if (spread$equal) {
    statistic <- scores[1] * kept
    p <- hotelling_p(statistic, n - spread$lost, groups, components)
  } else {
    own <- separate_t2(u, labels[, 1]) * kept
    statistic <- own[["t2"]]
    p <- if (groups == 2) t2_tail(statistic, own[["df"]], components, groups) else NA_real_
  }
  test_row("T2", statistic, permutation_p(scores), p, share = sum(pca$share[seq_len(components)]))
}

#' Every component by itself; adjusted by the greatest over components
#' @noRd
component_tests <- function(pca, components, labels, spread) {
  groups <- max(labels)
  x <- pca$x[, seq_len(components), drop = FALSE]
  scores <- by_block(labels, function(part) group_scores(list(x), part, spread$equal))
  own <- observed_f(list(x), labels[, 1], spread)
  first <- labels[, 1] == 1
  sign <- sign(colMeans(x[first, , drop = FALSE]) - colMeans(x[!first, , drop = FALSE]))
  most <- do.call(pmax, as.data.frame(scores))
  test_row(colnames(x), if (groups == 2) sign * sqrt(own$f) else own$f, permutation_p(scores),
           stats::pf(own$f, groups - 1, own$df, lower.tail = FALSE),
           permutation_p(matrix(most, length(most), components), scores[1, ]),
           pca$share[seq_len(components)])
}

#' Whether the groups are equally spread: distances of specimens to the mean of their own group
#' (Anderson 2006)
#'
#' The statistic is the largest group's root mean square distance over the smallest's. A distance is
#' divided by the root of 1 - 1 / n_g, since the mean follows its own members.
#' @noRd
dispersion_test <- function(y, labels) {
  code <- labels[, 1]
  sizes <- tabulate(code)
  mean <- rowsum(y, code) / sizes
  distance <- sqrt(rowSums((y - mean[code, , drop = FALSE])^2) / (1 - 1 / sizes[code]))
  spread <- sqrt(rowsum(distance^2, code) / sizes)
  z <- list(cbind(distance - mean(distance)))
  scores <- by_block(labels, function(part) group_scores(z, part, FALSE))
  test_row("dispersion", max(spread) / min(spread), permutation_p(scores))
}

#' How many components: a number, or a share of variance; never more than leave a degree of freedom,
#' and with separate covariances never more than half the degrees of freedom of the smallest group
#' @noRd
component_count <- function(components, pca, code, spread) {
  sizes <- tabulate(code)
  if (components < 1) components <- which(cumsum(pca$share) >= components - 1e-12)[1]
  most <- nrow(pca$x) - spread$lost - length(sizes) - 1
  if (!spread$equal) most <- min(most, (min(sizes) - 1) %/% 2)
  max(1, min(components, length(pca$sdev), most))
}
