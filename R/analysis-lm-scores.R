# Statistics of a linear model's terms for many permutations of the residuals of the model without
# the term.

#' Whole shape: sums of squares over all co-ordinates, from the inner products of the specimens
#'
#' @param aligned An `aligned`.
#' @param spans As of [term_spans()].
#' @param orders n x B, the observed order first.
#' @return List by term: `squares`, `f`, each of B.
#' @noRd
shape_scores <- function(aligned, spans, orders) {
  if (!by_products(length(aligned), length(aligned$mean), spans, ncol(orders))) {
    return(Map(function(found, span) {
      as_scores(found$own, found$whole, found$total, span)
    }, summed_squares(aligned, spans, orders), spans))
  }
  gram <- inner_products(aligned)
  lapply(spans, function(span) {
    half <- gram - span$without %*% crossprod(span$without, gram)
    left <- half - tcrossprod(half %*% span$without, span$without)
    own <- span$basis[, seq_len(span$df), drop = FALSE]
    sums <- cpp_permuted_forms(left, tcrossprod(own), tcrossprod(span$basis), orders)
    as_scores(sums[1, ], sums[2, ], sum(diag(left)), span)
  })
}

#' Whether inner products cost less than projections: n^2 q products once and n^2 a permutation and
#' term, or n x q x p a permutation
#'
#' @param scattered How much longer a product of permuted entries takes than one of a projection: at
#'   500 to 2,000 specimens of 922 points 2 to 8 times.
#' @noRd
by_products <- function(n, q, spans, permutations, scattered = 4) {
  n * (q + scattered * length(spans) * permutations) <= q * ncol(spans[[1]]$basis) * permutations
}

#' Sums of squares of every column, for all terms at once
#'
#' The variables are permuted once for all terms: what permuted residuals have on the model is that
#' of the permuted variables less that of their fitted values.
#'
#' @return List by term: `own`, `whole` (B x q, in the span of the term and of the model), `total`
#'   (q).
#' @noRd
permuted_squares <- function(y, spans, orders) {
  basis <- spans[[1]]$basis
  without <- lapply(spans, `[[`, "without")
  fitted <- lapply(without, function(x) crossprod(y, x))
  own <- lapply(spans, function(span) {
    crossprod(basis, span$basis[, seq_len(span$df), drop = FALSE])
  })
  found <- cpp_permuted_squares(t(y), basis, without, fitted, own, orders)
  squares <- colSums(y^2)
  stats::setNames(Map(function(one, fit) c(one, list(total = pmax(squares - rowSums(fit^2), 0))),
                      found, fitted),
                  names(spans))
}

#' The same summed over all columns, some columns at a time
#' @param block Columns at a time: a block needs block x B numbers a term.
#' @return List by term: `own`, `whole` (B), `total`.
#' @noRd
summed_squares <- function(aligned, spans, orders, block = 500) {
  flat <- over_points(aligned, function(y) {
    each <- lapply(permutation_blocks(ncol(y), block), function(columns) {
      found <- permuted_squares(y[, columns, drop = FALSE], spans, orders)
      unlist(lapply(unname(found), function(one) {
        list(rowSums(one$own), rowSums(one$whole), sum(one$total))
      }), recursive = FALSE)
    })
    Reduce(function(a, b) Map(`+`, a, b), each)
  })
  at <- 3 * seq_along(spans)
  Map(function(own, whole, total) list(own = own, whole = whole, total = total),
      stats::setNames(flat[at - 2], names(spans)), flat[at - 1], flat[at])
}

#' @param rounding Share of all squares, up to which those of the term are 0: exact duplicates then
#'   tie.
#' @noRd
as_scores <- function(own, whole, total, span, rounding = 1e-12) {
  own[own <= rounding * total] <- 0
  list(squares = own, f = own / span$df / (pmax(total - whole, 0) / span$left))
}

#' Sums of squares of every column of y, for all terms
#'
#' @param y List of n x q matrices over which squares are summed (the co-ordinates of points).
#' @param rounding Share of all squares, up to which those of the term are 0. They are squares of
#'   sums here, whose rounding is far below that of inner products.
#' @return List by term: `own`, `left` (B x q: sums of squares of the term and of the residuals).
#' @noRd
column_squares <- function(y, spans, orders, rounding = 1e-24) {
  each <- lapply(y, permuted_squares, spans, orders)
  lapply(stats::setNames(nm = names(spans)), function(term) {
    add <- function(part) Reduce(`+`, lapply(each, function(one) one[[term]][[part]]))
    own <- add("own")
    total <- rep(add("total"), each = nrow(own))
    own[own <= rounding * total] <- 0
    list(own = own, left = pmax(total - add("whole"), 0))
  })
}

#' Pillai's trace of the first components, for all permutations, and its approximate p
#' @param u n x c scores.
#' @noRd
pillai_scores <- function(u, span, orders, rounding = 1e-24) {
  left <- u - span$without %*% crossprod(span$without, u)
  whole <- crossprod(left)
  own <- seq_len(span$df)
  trace <- apply(orders, 2, function(order) {
    sums <- crossprod(span$basis, left[order, , drop = FALSE])
    among <- crossprod(sums[own, , drop = FALSE])
    error <- whole - crossprod(sums)
    sum(diag(solve(error + among, among)))
  })
  trace[trace <= rounding] <- 0
  c <- ncol(u)
  s <- min(c, span$df)
  m <- (abs(c - span$df) - 1) / 2
  k <- (span$left - c - 1) / 2
  df <- c(s * (2 * m + s + 1), s * (2 * k + s + 1))
  f <- df[2] / df[1] * trace[1] / (s - trace[1])
  list(trace = trace, parametric = stats::pf(f, df[1], df[2], lower.tail = FALSE))
}

#' Standardised effect: the observed value among the permuted ones, after a power transformation
#' that makes these nearest to normal (Collyer and Adams 2018; as in RRPP)
#'
#' @param x Positive values, the observed first.
#' @param range Powers that are looked through.
#' @param log_below Powers nearer to 0 than that are the logarithm.
#' @noRd
effect_z <- function(x, range = c(-2, 2), log_below = 1e-3) {
  if (!all(is.finite(x) & x > 0) || length(unique(x)) == 1) return(NA_real_)
  power <- function(y, a) if (a == 0) log(y) else expm1(a * log(y)) / a
  others <- x[-1] / exp(mean(log(x[-1])))
  likelihood <- function(a) {
    y <- power(others, a)
    -length(y) / 2 * log(sum((y - mean(y))^2))
  }
  best <- stats::optimise(likelihood, range, maximum = TRUE)$maximum
  y <- power(x, if (abs(best) < log_below) 0 else best)
  (y[1] - mean(y)) / sqrt(mean((y - mean(y))^2))
}
