# Permutations of a grouping: random, all, or given.

#' The regroupings that a test is referred to
#'
#' @param group Factor of n.
#' @param n_perm Number of random permutations.
#' @param exact Most regroupings that are enumerated instead.
#' @param permutations n x B matrix or list of B orders of 1, ..., n, or `NULL`.
#' @return List: `labels` (n x B integer matrix of group numbers, the observed first), `exact`
#'   (logical).
#' @noRd
regroupings <- function(group, n_perm, exact, permutations = NULL, seed = NULL) {
  code <- as.integer(group)
  if (!is.null(permutations)) {
    orders <- check_permutations(permutations, length(code))
    labels <- matrix(0L, length(code), ncol(orders))
    labels[cbind(as.vector(orders), rep(seq_len(ncol(orders)), each = length(code)))] <- code
    return(list(labels = cbind(code, labels, deparse.level = 0), exact = FALSE))
  }
  if (count_regroupings(code) <= exact) return(list(labels = all_regroupings(code), exact = TRUE))
  list(labels = dealt_labels(code, n_perm, seed, function() code[sample.int(length(code))]),
       exact = FALSE)
}

#' Group numbers in random orders, the observed one first: one matrix is made, and none on the way
#' @param deal Function that gives the numbers in a random order.
#' @noRd
dealt_labels <- function(code, n_perm, seed, deal) {
  labels <- matrix(code, length(code), n_perm + 1)
  with_seed(seed, for (b in seq_len(n_perm)) labels[, b + 1] <- deal())
  labels
}

check_permutations <- function(x, n) {
  if (is.list(x) && length(x) && all(lengths(x) == n)) x <- matrix(unlist(x), ncol = length(x))
  is_order <- function(order) all(sort(order) == seq_len(n))
  ok <- is.matrix(x) && is.numeric(x) && ncol(x) > 0 && nrow(x) == n && all(apply(x, 2, is_order))
  if (!ok) {
    crestline_abort("`permutations` are not orders of all specimens.",
                    sprintf(paste("Give a matrix of %d rows, every column an order of 1, ...,",
                                  "%d; their number is `n_perm`."),
                            n, n),
                    stage = "arguments")
  }
  # The first of RRPP's permutations is the observed order.
  if (all(x[, 1] == seq_len(n))) x[, -1, drop = FALSE] else x
}

#' How many ways there are to deal the specimens to groups of these sizes
#' @noRd
count_regroupings <- function(code) round(exp(
  lfactorial(length(code)) - sum(lfactorial(table(code)))
))

#' All of them, n x count, the observed first
#' @noRd
all_regroupings <- function(code) {
  deal <- function(free, sizes) {
    if (length(sizes) == 1) return(matrix(free, 1))
    first <- utils::combn(length(free), sizes[1])
    rest <- lapply(seq_len(ncol(first)), function(i) {
      others <- deal(free[-first[, i]], sizes[-1])
      cbind(matrix(free[first[, i]], nrow(others), sizes[1], byrow = TRUE), others)
    })
    do.call(rbind, rest)
  }
  sizes <- as.vector(table(code))
  dealt <- deal(seq_along(code), sizes)
  labels <- matrix(0L, length(code), nrow(dealt))
  labels[cbind(as.vector(t(dealt)),
               rep(seq_len(nrow(dealt)), each = length(code)))] <- rep(seq_along(sizes), sizes)
  same <- which(colSums(labels != code) == 0)
  labels[, c(same, seq_len(ncol(labels))[-same]), drop = FALSE]
}

#' A statistic of many regroupings, worked out some columns at a time, which takes n x `block`
#' numbers
#'
#' @param statistic Function of n x b labels that gives b values, or a matrix of b rows.
#' @param block Columns at a time.
#' @noRd
by_block <- function(labels, statistic, block = 250) {
  blocks <- permutation_blocks(ncol(labels), block)
  if (length(blocks) == 1) return(statistic(labels))
  each <- lapply(blocks, function(columns) statistic(labels[, columns, drop = FALSE]))
  if (is.matrix(each[[1]])) do.call(rbind, each) else unlist(each)
}

#' Columns of regroupings taken at a time
#' @noRd
permutation_blocks <- function(n, block) unname(split(seq_len(n), ceiling(seq_len(n) / block)))

#' Share of regroupings whose statistic is as great as the observed one, the first; rounding does
#' not break ties
#'
#' @param x Matrix, a row a regrouping, or a vector.
#' @param observed What is compared, a value a column of `x`.
#' @param slack Relative.
#' @noRd
permutation_p <- function(x, observed = x[1, ], slack = 1e-10) {
  x <- as.matrix(x)
  colMeans(x >= rep(observed - slack * abs(observed), each = nrow(x)))
}

#' The least p-value that regroupings can give: the share of those that deal the specimens as
#' observed, under whatever names of the groups
#' @noRd
least_p <- function(labels) {
  # A name stands for another wherever it does in the first column.
  first <- match(seq_len(max(labels)), labels[, 1])
  as_first <- function(b) all(labels[first, b][labels[, 1]] == labels[, b]) &&
    !anyDuplicated(labels[first, b])
  mean(vapply(seq_len(ncol(labels)), as_first, NA))
}

#' The least p-value that orders of units can give
#' @noRd
least_of_orders <- function(orders, design) {
  sizes <- if (design$kind == "within") tabulate(design$block) else nrow(orders)
  max(1 / ncol(orders), exp(-sum(lfactorial(sizes))))
}

#' @param level Least p-value that is called significant.
#' @param exact Whether all regroupings are used, so that no `n_perm` helps.
#' @noRd
warn_few_orders <- function(least, stage, level = 0.05, exact = FALSE) {
  if (least <= level) return(invisible())
  crestline_warn(sprintf("no p-value can be below %.2g: there are too few %s.", least,
                         if (exact) "specimens" else "permutations"),
                 if (exact) "All regroupings are used: more specimens are needed." else
                   "Give a greater `n_perm`; where all orders are used, more specimens are needed.",
                 stage = stage, class = "crestline_few_permutations")
}
