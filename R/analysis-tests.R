# The statistics of a comparison of groups, for all regroupings at once.

#' Sums of squares between and within groups, for many regroupings
#'
#' @param about Function of an n x B matrix of 0 and 1, one group's members by regrouping, that
#'   gives the squared sums of these members: B x q. Of [squared_sums()], say.
#'   Variables are centred, so that the sums of a group are minus those of the others.
#' @param squares n x q, squared entries by specimen.
#' @param labels n x B matrix of group numbers, every column with groups of the same sizes.
#' @param apart Whether the squares within groups are wanted.
#' @return List: `between` (B x q), `within` (list of B x q, by group).
#' @noRd
group_squares <- function(about, squares, labels, apart) {
  own <- if (apart) group_sums(labels, function(member) crossprod(member, squares), FALSE)
  split_squares(group_sums(labels, about), own, colSums(squares), tabulate(labels[, 1]))
}

#' What a function gives of the members of each group
#'
#' @param of Function of an n x B matrix of 0 and 1.
#' @param last Whether the greatest group is wanted too. Of two groups it is taken to be as the
#'   other, as squared sums of centred variables are.
#' @return List by group of B x q.
#' @noRd
group_sums <- function(labels, of, last = TRUE) {
  sizes <- tabulate(labels[, 1])
  greatest <- which.max(sizes)
  found <- vector("list", length(sizes))
  rest <- 0
  for (g in seq_along(sizes)[-greatest]) {
    member <- labels == g
    storage.mode(member) <- "double"
    if (length(sizes) > 2 && last) rest <- rest + member
    found[[g]] <- of(member)
  }
  if (last) found[[greatest]] <- if (length(sizes) > 2) of(rest) else found[[3 - greatest]]
  found
}

#' Squares between and within groups from their sums
#'
#' @param sums,own Lists by group of B x q: squared sums, and sums of squares (of all but the
#'   greatest group; NULL where squares within groups are not wanted).
#' @param all q sums of squares in all.
#' @param sizes Of the groups.
#' @param rounding Share of all squares, up to which those between are 0: exact duplicates then tie.
#' @return As [group_squares()].
#' @noRd
split_squares <- function(sums, own, all, sizes, rounding = 1e-12) {
  left <- all <- rep(all, each = nrow(sums[[1]]))
  last <- which.max(sizes)
  within <- list()
  between <- 0
  for (g in c(seq_along(sizes)[-last], last)) {
    between <- between + sums[[g]] / sizes[g]
    if (is.null(own)) next
    squares <- if (g == last) left else own[[g]]
    left <- left - squares
    within[[g]] <- pmax(squares - sums[[g]] / sizes[g], 0)
  }
  between[between <= rounding * all] <- 0
  list(between = between, within = within)
}

#' @param y List of n x q matrices, columns centred, over which squares are summed (the co-ordinates
#'   of points).
#' @noRd
squared_sums <- function(y) {
  function(member) Reduce(`+`, lapply(y, function(part) crossprod(member, part)^2))
}

#' F of Brown and Forsythe (1974), with two groups the square of Welch's t: squares between over the
#' sum of (1 - n_g / n) times the variance within group g; and the degrees of freedom of that sum
#' (Satterthwaite), and of the squares between (Mehrotra 1997)
#' @param found As of [group_squares()].
#' @return List of three B x q matrices: `f`, `df`, `among` (with two groups 1).
#' @noRd
separate_f <- function(found, sizes) {
  n <- sum(sizes)
  variance <- spent <- mean <- square <- 0
  for (g in seq_along(sizes)) {
    own <- found$within[[g]] / (sizes[g] - 1)
    part <- (1 - sizes[g] / n) * own
    variance <- variance + part
    spent <- spent + part^2 / (sizes[g] - 1)
    mean <- mean + sizes[g] / n * own
    square <- square + (1 - 2 * sizes[g] / n) * own^2
  }
  df <- variance^2 / spent
  among <- variance^2 / (mean^2 + square)
  df[spent <= 0] <- n - length(sizes)
  among[spent <= 0] <- length(sizes) - 1
  list(f = pmin(found$between / variance, .Machine$double.xmax), df = df,
       among = if (length(sizes) > 2) among else 1)
}

#' F with degrees of freedom of its own in every regrouping, on the scale of chi-squared with as
#' many as there are if spreads are equal
#'
#' f2 log(1 + f1 F / f2) is near to chi-squared on f1 degrees whatever f2 is (Wallace 1959). Cube
#' roots of chi-squared are near to normal (Wilson and Hilferty 1931), by which other f1 are brought
#' to groups - 1.
#'
#' @param own Of [separate_f()].
#' @param groups Their number.
#' @param times,counted What all degrees of freedom are multiplied by, and what those below are.
#' @noRd
chi_squared_scale <- function(own, groups, times = 1, counted = 1) {
  below <- own$df * times * counted
  among <- own$among * times
  score <- below * log1p(among * own$f / below)
  if (groups == 2) return(score)
  usual <- (groups - 1) * times
  normal <- ((score / among)^(1 / 3) - 1 + 2 / (9 * among)) / sqrt(2 / (9 * among))
  (score > 0) * usual * pmax(normal * sqrt(2 / (9 * usual)) + 1 - 2 / (9 * usual), 0)^3
}

#' How many directions share the variance: trace squared over the trace of the square of a
#' covariance (Box 1954)
#' @param y As of [squared_sums()].
#' @return q numbers, 1 to the number of matrices.
#' @noRd
effective_dimensions <- function(y) {
  dimensions_of_products(function(a, b) colSums(y[[a]] * y[[b]]), length(y))
}

#' @param product Function of the numbers of two matrices: sums of their products, q.
#' @noRd
dimensions_of_products <- function(product, directions) {
  each <- seq_len(directions)
  whole <- Reduce(`+`, lapply(each, function(a) product(a, a)))
  square <- Reduce(`+`, lapply(each, function(a) {
    Reduce(`+`, lapply(each, function(b) product(a, b)^2))
  }))
  ifelse(whole > 0, whole^2 / square, 1)
}

#' What variables are tested by, for many regroupings: greater, the more lies between the groups
#'
#' With equal spread: sum of squares between over that in all. Else F with separate variances, on
#' degrees of freedom of its own in every regrouping: see [chi_squared_scale()]. Without that a
#' small group of great spread, which regroupings dilute, would be compared with lighter tails than
#' its own.
#'
#' @param about,squares As in [group_squares()].
#' @param dimensions q numbers, as of [effective_dimensions()]: both degrees of freedom are
#'   multiplied by them.
#' @return List of B x q matrices: `between`, `score` (0 where nothing varies).
#' @noRd
spread_scores <- function(about, squares, labels, equal_spread, dimensions = 1) {
  found <- group_squares(about, squares, labels, !equal_spread)
  scores_of_squares(found, colSums(squares), tabulate(labels[, 1]), equal_spread, dimensions)
}

#' @rdname spread_scores
#' @param found As of [group_squares()].
#' @param all q sums of squares in all.
#' @noRd
scores_of_squares <- function(found, all, sizes, equal_spread, dimensions = 1) {
  total <- rep(all, each = nrow(found$between))
  if (equal_spread) score <- found$between / total else {
    own <- separate_f(found, sizes)
    by <- rep(dimensions, each = nrow(own$f), length.out = length(own$f))
    score <- chi_squared_scale(own, length(sizes), by)
  }
  score[total <= 0] <- 0
  list(between = found$between, score = score)
}

#' @rdname spread_scores
#' @noRd
group_scores <- function(y, labels, equal_spread) {
  squares <- Reduce(`+`, lapply(y, function(part) part^2))
  spread_scores(squared_sums(y), squares, labels, equal_spread, effective_dimensions(y))$score
}

#' The F of every column of y as it is grouped, and its degrees of freedom
#'
#' @param about,squares As in [group_squares()].
#' @param code Group numbers.
#' @param spread List: `equal` (see [compare_groups()]), `lost` (degrees of freedom that the means
#'   of blocks take).
#' @return List: `f` (with two groups the square of t: Student's, or Welch's), `df` (below).
#' @noRd
observed_f <- function(about, squares, code, spread) {
  found <- group_squares(about, squares, cbind(code), !spread$equal)
  f_of_squares(found, colSums(squares), tabulate(code), spread)
}

#' The same of the first regrouping of squares
#' @param found As of [group_squares()].
#' @param all q sums of squares in all.
#' @noRd
f_of_squares <- function(found, all, sizes, spread) {
  first <- function(x) x[1, , drop = FALSE]
  found <- list(between = first(found$between), within = lapply(found$within, first))
  groups <- length(sizes)
  n <- sum(sizes)
  if (spread$equal) {
    df <- n - spread$lost - groups
    within <- pmax(all - found$between, 0)
    return(list(f = as.vector(found$between / within) * df / (groups - 1), df = df))
  }
  own <- lapply(separate_f(found, sizes), as.vector)
  kept <- kept_df(n, groups, spread)
  list(f = own$f * kept, df = own$df * kept)
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
hotelling <- function(u, labels, rounding = 1e-12) {
  sizes <- tabulate(labels[, 1])
  n <- nrow(u)
  if (length(sizes) == 2) {
    share <- pmin(rowSums(group_squares(squared_sums(list(u)), u^2, labels, FALSE)$between), 1)
    return((n - 2) * share / (1 - share))
  }
  vapply(seq_len(ncol(labels)), function(b) {
    sums <- rowsum(u, labels[, b]) / sqrt(sizes)
    share <- pmin(eigen(tcrossprod(sums), symmetric = TRUE, only.values = TRUE)$values, 1)
    (n - length(sizes)) * sum((share / (1 - share))[share > rounding])
  }, 0)
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
                     share = NA_real_, z = NA_real_, effect = rep(NA_real_, 3)) {
  data.frame(test = test, statistic = statistic, p_value = p_value, p_adjusted = p_adjusted,
             p_parametric = p_parametric, share = share, z = z, effect = effect[1],
             lower = effect[2], upper = effect[3])
}

#' Z of a statistic among those of the regroupings
#' @param score As of [spread_scores()].
#' @noRd
score_z <- function(score, equal_spread) {
  effect_z(as.vector(if (equal_spread) score / (1 - score) else score))
}

#' Bootstrap samples within groups: how often each specimen is drawn
#' @param code Group numbers.
#' @return n x B matrix of counts.
#' @noRd
bootstrap_counts <- function(code, n_boot, seed) {
  members <- split(seq_along(code), code)
  with_seed(seed, replicate(n_boot, {
    drawn <- unlist(lapply(members, function(own) own[sample.int(length(own), replace = TRUE)]))
    tabulate(drawn, length(code))
  }))
}

#' An estimate with the quantiles of its bootstrapped values about their mean
#' @noRd
with_interval <- function(estimate, values, level = 0.95) {
  off <- values - mean(values, na.rm = TRUE)
  estimate + c(0, stats::quantile(off, c(1 - level, 1 + level) / 2, names = FALSE, na.rm = TRUE))
}

#' Cohen's d: first mean less second, over the root of the pooled variance
#' @param counts n x B, how often each specimen counts.
#' @noRd
cohen_d <- function(y, code, counts = cbind(rep(1, length(y)))) {
  of <- function(g) {
    own <- counts * (code == g)
    n <- colSums(own)
    mean <- colSums(own * y) / n
    list(mean = mean, squares = colSums(own * y^2) - n * mean^2)
  }
  first <- of(1)
  second <- of(2)
  variance <- (first$squares + second$squares) / (length(y) - 2)
  ifelse(variance > 0, (first$mean - second$mean) / sqrt(variance), NA)
}

size_test <- function(size, labels, spread, counts) {
  y <- list(varying(cbind(size - mean(size)), mean(size)))
  scores <- by_block(labels, function(part) raised_scores(y[[1]], part, spread$equal))
  groups <- max(labels)
  code <- labels[, 1]
  own <- observed_f(squared_sums(y), y[[1]]^2, code, spread)
  between <- group_squares(squared_sums(y), y[[1]]^2, cbind(code), FALSE)$between[1]
  two <- groups == 2
  d <- if (two) {
    with_interval(cohen_d(y[[1]][, 1], code), cohen_d(y[[1]][, 1], code, counts))
  } else rep(NA_real_, 3)
  test_row(if (two) "size t" else "size F", if (two) sign(d[1]) * sqrt(own$f) else own$f,
           permutation_p(scores), stats::pf(own$f, groups - 1, own$df, lower.tail = FALSE),
           share = between / sum(y[[1]]^2), z = score_z(scores, spread$equal), effect = d)
}

#' Centred values, 0 where they differ by rounding only
#' @param scale Size of what was centred.
#' @param digits Greatest difference by rounding, as a share of `scale`.
#' @noRd
varying <- function(y, scale, digits = 1e-13) {
  if (max(abs(y)) <= digits * abs(scale)) y[] <- 0
  y
}

#' @param total List, of [whole_shape()].
#' @noRd
#' @param counts Of [bootstrap_counts()].
#' @noRd
mean_shape_test <- function(total, labels, spread, counts) {
  code <- labels[, 1]
  sizes <- tabulate(code)
  share <- total$between[1] / sum(total$squares)
  tested <- function(...) test_row(
    ..., p_value = permutation_p(total$score), share = share, z = score_z(total$score, spread$equal)
  )
  if (length(sizes) > 2) {
    return(tested("mean shape F", total$f))
  }
  distance <- sqrt(total$between * sum(1 / sizes))
  # Of every bootstrap sample the first mean less the second.
  drawn <- total$drawn
  if (is.null(drawn)) drawn <- total$about(counts * c(1, -1)[code] / sizes[code])
  drawn <- sqrt(pmax(drawn, 0))
  tested("mean shape", distance[1],
         effect = with_interval(distance[1] - mean(distance), as.vector(drawn)))
}

#' All variables of a level together, as the groups are dealt
#'
#' From the inner products of the specimens where these are fewer than the variables; else from the
#' sums of the groups, some points at a time.
#'
#' @param leading Of [leading_squares()]; worked out only with more specimens than variables.
#' @param known Of [sums_in_files()], NULL of a sample in memory.
#' @return List: `about`, `squares` (n x 1), `between` and `score` (B x 1), `f` (as it is grouped),
#'   `drawn` (R x 1: `about` of bootstrap samples, NULL where not known).
#' @noRd
whole_shape <- function(aligned, labels, spread, leading, known = NULL) {
  gram <- if (length(aligned) <= length(aligned$mean)) inner_products(aligned)
  squares <- cbind(if (!is.null(gram)) diag(gram) else if (!is.null(known)) known$squares else
    over_points(aligned, squares_by_row))
  square <- if (spread$equal) NA else if (is.null(gram)) leading else sum_of_squares(gram)
  dimensions <- if (spread$equal) 1 else max(1, sum(squares)^2 / square, na.rm = TRUE)
  about <- function(member) total_of_sums(aligned, gram, member)
  sizes <- tabulate(labels[, 1])
  sums <- if (!is.null(gram)) by_columns(labels, group_sums, about) else if (!is.null(known)) {
    whole_of_sums(aligned, known$sums, sizes)
  } else whole_sums(aligned, labels)
  own <- if (!spread$equal) {
    by_columns(labels, group_sums, function(member) crossprod(member, squares), FALSE)
  }
  found <- split_squares(sums, own, sum(squares), sizes)
  score <- scores_of_squares(found, sum(squares), sizes, spread$equal, dimensions)$score
  list(about = about, squares = squares, between = found$between, score = score,
       f = f_of_squares(found, sum(squares), sizes, spread)$f,
       drawn = if (is.null(gram) && !is.null(known$drawn)) weighted_squares(aligned, known$drawn))
}

#' Squared sums over all variables of weighted specimens
#' @param member n x B weights.
#' @return B x 1.
#' @noRd
total_of_sums <- function(aligned, gram, member) {
  if (!is.null(gram)) return(cbind(colSums(member * (gram %*% member))))
  cbind(over_points(aligned, function(y) colSums(crossprod(y, member)^2)))
}

#' The same of every group, all regroupings for some points before the next points are read
#' @noRd
whole_sums <- function(aligned, labels) {
  over_points(aligned, function(y) {
    by_columns(labels, group_sums, function(member) cbind(colSums(crossprod(y, member)^2)))
  })
}

#' Lists by group of some columns of regroupings at a time, bound together
#' @param of Function of n x b labels and `...`.
#' @noRd
by_columns <- function(labels, of, ..., block = 250) {
  each <- lapply(permutation_blocks(ncol(labels), block), function(columns) {
    of(labels[, columns, drop = FALSE], ...)
  })
  do.call(Map, c(list(rbind), each))
}

#' Sum of the squared variances by component, by the leading ones
#' @param pca Components of the same co-ordinates, NULL where there are none.
#' @noRd
leading_squares <- function(aligned, pca, leading = 20) {
  if (length(pca$sdev) < leading) {
    return(sum(shape_svd(aligned, aligned$weights, 0, leading)$d^4))
  }
  sum((pca$sdev[seq_len(leading)]^2 * (length(aligned) - 1))^2)
}

#' T2 of the first components; unless spreads are equal, with covariances of one form
#' @param common Of [common_form()].
#' @noRd
t2_test <- function(pca, components, labels, spread, common) {
  n <- nrow(pca$x)
  groups <- max(labels)
  count <- testable_components(pca, components, n, groups, spread)
  kept <- kept_df(n, groups, spread)
  if (spread$equal) {
    u <- pca$x[, seq_len(count), drop = FALSE] / rep(pca$sdev[seq_len(count)] * sqrt(n - 1),
                                                      each = n)
    scores <- by_block(labels, function(part) hotelling(u, part))
    p <- hotelling_p(scores[1] * kept, n - spread$lost, groups, count)
  } else {
    scores <- common$t2
    p <- NA_real_
  }
  row <- test_row("T2", scores[1] * kept, permutation_p(scores), p,
                  share = sum(pca$share[seq_len(count)]), z = effect_z(scores))
  structure(row, components = count)
}

#' As many components as leave a degree of freedom
#' @noRd
testable_components <- function(pca, components, n, groups, spread) {
  min(components, ncol(pca$x), n - spread$lost - groups - 1)
}

#' Groups whose covariances have one form, each a scale of its own: T2, and the scales
#'
#' The covariance of group g is c_g times a common one. Specimens and means are brought to one scale
#' by those of the observed groups. Then they are regrouped, and scales and components found anew in
#' each regrouping. Components of the specimens as they are lean to the group that varies most, its
#' mean included, and regroupings do not share that: T2 on them rejected true null hypotheses in up
#' to 12 % of samples (`bench/spread.md`).
#'
#' @param x n x m scores on the leading components, among which those of T2 are sought.
#' @param rounds How often scales and components are found from each other.
#' @param least Least scale of a group, as a share of the mean one.
#' @param rounding Root of the share of a component that may lie between the means by rounding:
#'   exact duplicates then tie.
#' @return List: `t2` (B), `scale` (of the observed groups, their mean over degrees of freedom 1).
#' @noRd
common_form <- function(x, labels, count, rounds = 3, least = 1e-6, rounding = 1e-6) {
  of <- function(x, labels) {
    cpp_common_form_t2(t(x), labels, max(labels), count, rounds, least, rounding)
  }
  scale <- of(x, labels[, 1, drop = FALSE])$scale[, 1]
  list(t2 = of(on_one_scale(x, labels[, 1], scale), labels)$t2, scale = scale)
}

#' Variables whose groups are brought to one scale: residuals by the root of that of their group,
#' means so that what lies between them, all specimens alike, is what lies between them by precision
#'
#' Deviations of the means from their mean by precision, each over its standard error, are square to
#' the roots of the precisions. They are turned to be square to the roots of the group sizes, as
#' deviations from the plain mean are.
#'
#' @param x n x q, columns centred.
#' @param scale A number by group.
#' @noRd
on_one_scale <- function(x, code, scale) {
  sizes <- tabulate(code)
  mean <- rowsum(x, code) / sizes
  precision <- sizes / scale
  off <- mean - rep(colSums(mean * precision) / sum(precision), each = nrow(mean))
  from <- sqrt(precision / sum(precision))
  to <- sqrt(sizes / sum(sizes))
  across <- outer(to, from) - outer(from, to)
  turn <- diag(length(sizes)) + across + across %*% across / (1 + sum(from * to))
  laid <- turn %*% (off * sqrt(precision)) / sqrt(sizes)
  (x - mean[code, , drop = FALSE]) / sqrt(scale[code]) + laid[code, , drop = FALSE]
}

#' Every component by itself; adjusted by the greatest statistic over components
#' @param common Of [common_form()].
#' @noRd
component_tests <- function(pca, components, labels, spread, common) {
  groups <- max(labels)
  components <- testable_components(pca, components, nrow(pca$x), groups, spread)
  x <- pca$x[, seq_len(components), drop = FALSE]
  laid <- if (spread$equal) x else on_one_scale(x, labels[, 1], common$scale)
  scores <- by_block(labels, function(part) {
    raised_scores(laid, part, spread$equal, most = 3, counted = 4)
  })
  own <- observed_f(squared_sums(list(x)), x^2, labels[, 1], spread)
  first <- labels[, 1] == 1
  sign <- sign(colMeans(x[first, , drop = FALSE]) - colMeans(x[!first, , drop = FALSE]))
  most <- do.call(pmax, as.data.frame(scores))
  adjusted <- permutation_p(matrix(most, length(most), components), scores[1, ])
  test_row(colnames(x), if (groups == 2) sign * sqrt(own$f) else own$f, permutation_p(scores),
           stats::pf(own$f, groups - 1, own$df, lower.tail = FALSE), adjusted,
           pca$share[seq_len(components)])
}

#' Scores of single variables, the variance of each group raised towards the pooled one
#'
#' The variance of a small group is often estimated too low, which costs power. It is raised to the
#' pooled variance where that is greater, but at most `most` times. With equal spread as
#' [group_scores()].
#'
#' @param y n x q, columns centred.
#' @param most,counted `counted`: how many times its degrees of freedom a variance counts, as its
#'   lower tail is cut. For one variable whose spreads may differ: 1.5, the greatest of 1, 1.5 and 2
#'   with which at most 0.08 of true null hypotheses are rejected (24 and 6, and 18, 6 and 6
#'   specimens, ratios 1 to 3: `bench/spread.R variants size`), and 1.
#' @return B x q.
#' @noRd
raised_scores <- function(y, labels, equal_spread, most = 1.5, counted = 1) {
  found <- group_squares(squared_sums(list(y)), y^2, labels, !equal_spread)
  total <- rep(colSums(y^2), each = ncol(labels))
  if (equal_spread) score <- found$between / total else {
    sizes <- tabulate(labels[, 1])
    df <- sizes - 1
    pooled <- Reduce(`+`, found$within) / sum(df)
    found$within <- Map(function(own, df) pmax(own, pmin(pooled * df, most * own)),
                        found$within, df)
    score <- chi_squared_scale(separate_f(found, sizes), length(sizes), counted = counted)
  }
  score[total <= 0] <- 0
  score
}

#' Whether the groups are equally spread: distances of specimens to the mean of their own group
#' (Anderson 2006)
#'
#' The statistic is the largest group's root mean square distance over the smallest's. A distance is
#' divided by the root of 1 - 1 / n_g, since the mean follows its own members.
#' @noRd
dispersion_test <- function(aligned, labels) {
  code <- labels[, 1]
  sizes <- tabulate(code)
  distance <- sqrt(over_points(aligned, function(y) squares_by_row(y, code)) /
                     (1 - 1 / sizes[code]))
  spread <- sqrt(rowsum(distance^2, code) / sizes)
  z <- list(cbind(distance - mean(distance)))
  scores <- by_block(labels, function(part) group_scores(z, part, FALSE))
  test_row("dispersion", max(spread) / min(spread), permutation_p(scores))
}

#' How many components: a number, or a share of variance
#' @noRd
component_count <- function(components, pca) {
  if (components < 1) components <- which(cumsum(pca$share) >= components - 1e-12)[1]
  max(1, min(components, length(pca$sdev)))
}
