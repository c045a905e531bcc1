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

#' F from the share that lies between groups; with two groups, the square of Student's t
#' @noRd
share_to_f <- function(share, n, groups) {
  share <- pmin(share, 1)
  share / (1 - share) * (n - groups) / (groups - 1)
}

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

#' p-value of T2 under normality: exact for two groups, the usual approximation by F for more
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
test_row <- function(test, statistic, p_value, p_parametric = NA_real_, p_adjusted = p_value, share = NA_real_) {
  data.frame(test = test, statistic = statistic, p_value = p_value, p_adjusted = p_adjusted, p_parametric = p_parametric,
             share = share)
}

size_test <- function(size, labels) {
  n <- length(size)
  groups <- max(labels)
  squares <- between_squares(cbind(size - mean(size)), labels)
  f <- share_to_f(squares[1] / sum((size - mean(size))^2), n, groups)
  sign <- if (groups == 2) sign(mean(size[labels[, 1] == 1]) - mean(size[labels[, 1] == 2])) else NA
  test_row(if (groups == 2) "size t" else "size F", if (groups == 2) sign * sqrt(f) else f, permutation_p(squares),
           stats::pf(f, groups - 1, n - groups, lower.tail = FALSE))
}

#' @param y n x d k, centred, weighted.
#' @noRd
mean_shape_test <- function(y, labels) {
  squares <- between_total(tcrossprod(y), labels)
  sizes <- tabulate(labels[, 1])
  two <- length(sizes) == 2
  share <- squares[1] / sum(y^2)
  statistic <- if (two) sqrt(squares[1] * sum(1 / sizes)) else share_to_f(share, nrow(y), length(sizes))
  test_row(if (two) "mean shape" else "mean shape F", statistic, permutation_p(squares), share = share)
}

t2_test <- function(pca, components, labels) {
  n <- nrow(pca$x)
  groups <- max(labels)
  u <- pca$x[, seq_len(components), drop = FALSE] / rep(pca$sdev[seq_len(components)] * sqrt(n - 1), each = n)
  t2 <- hotelling(u, labels)
  test_row("T2", t2[1], permutation_p(t2), hotelling_p(t2[1], n, groups, components), share = sum(pca$share[seq_len(components)]))
}

#' Every component by itself; adjusted by the greatest over components
#' @noRd
component_tests <- function(pca, components, labels) {
  n <- nrow(pca$x)
  groups <- max(labels)
  x <- pca$x[, seq_len(components), drop = FALSE]
  share <- between_squares(x, labels) / rep(colSums(x^2), each = ncol(labels))
  f <- share_to_f(share[1, ], n, groups)
  first <- labels[, 1] == 1
  sign <- sign(colMeans(x[first, , drop = FALSE]) - colMeans(x[!first, , drop = FALSE]))
  most <- do.call(pmax, as.data.frame(share))
  test_row(colnames(x), if (groups == 2) sign * sqrt(f) else f, permutation_p(share),
           stats::pf(f, groups - 1, n - groups, lower.tail = FALSE),
           permutation_p(matrix(most, length(most), components), share[1, ]), pca$share[seq_len(components)])
}

#' How many components: a number, or a share of variance; never more than leave a degree of freedom
#' @noRd
component_count <- function(components, pca, groups) {
  if (components < 1) components <- which(cumsum(pca$share) >= components - 1e-12)[1]
  max(1, min(components, length(pca$sdev), nrow(pca$x) - groups - 1))
}
