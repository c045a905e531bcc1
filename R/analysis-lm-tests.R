# The table of tests of one level's linear model.

#' Rows of the table of tests of a model, one a column of the scores
#'
#' @param scores List: `squares` (B x q, or NULL), `f` (B x q).
#' @param total Sums of squares in all (q).
#' @noRd
lm_rows <- function(term, test, span, scores, total, parametric = NA_real_) {
  f <- as.matrix(scores$f)
  squares <- if (is.null(scores$squares)) NA_real_ else as.matrix(scores$squares)[1, ]
  family <- do.call(pmax, as.data.frame(f))
  data.frame(term = term, test = test, df = span$df, squares = squares, share = squares / total,
             statistic = f[1, ], z = apply(f, 2, effect_z), p_value = permutation_p(f),
             p_adjusted = permutation_p(matrix(family, length(family), ncol(f)), f[1, ]),
             p_parametric = parametric, row.names = NULL)
}

#' Tests of one level's model
#'
#' @param aligned An `aligned`, of the units that are exchanged.
#' @param tests,components As in [shape_lm()].
#' @param part As in [lm_points()].
#' @return List: `tests`, `points`, `parts`, `pca`.
#' @noRd
lm_level <- function(aligned, spans, orders, tests, components, part, tick) {
  flat <- matrix(aligned$coords, length(aligned$mean))
  y <- t((flat - rowMeans(flat)) * sqrt(rep(aligned$weights, ncol(aligned$mean))))
  whole <- if ("shape" %in% tests) shape_scores(y, spans, orders)
  pca <- if (any(c("components", "manova") %in% tests)) shape_pca(aligned)
  scores <- if (!is.null(pca)) {
    left <- spans[[1]]$left
    count <- if (components < 1) which(cumsum(pca$share) >= components - 1e-12)[1] else components
    pca$x[, seq_len(max(1, min(count, length(pca$sdev), left))), drop = FALSE]
  }
  each <- lapply(names(spans), function(term) {
    span <- spans[[term]]
    tick()
    row <- function(...) lm_rows(term, span = span, ...)
    by_column <- function(test, y) {
      found <- column_squares(list(y), span, orders)
      f <- found$own / span$df / (found$left / span$left)
      row(test, scores = list(squares = found$own, f = f), total = colSums(y^2),
          parametric = stats::pf(f[1, ], span$df, span$left, lower.tail = FALSE))
    }
    trace <- if ("manova" %in% tests) pillai_scores(scores, span, orders)
    at <- if ("points" %in% tests) lm_points(aligned, term, span, orders, part)
    rows <- list(if ("shape" %in% tests) row("shape", scores = whole[[term]], total = sum(y^2)),
                 if ("size" %in% tests) by_column("size", cbind(aligned$size - mean(aligned$size))),
                 if ("manova" %in% tests) {
                   row("manova", scores = list(f = trace$trace), total = 1,
                       parametric = trace$parametric)
                 },
                 if ("components" %in% tests) by_column(colnames(scores), scores))
    list(tests = do.call(rbind, rows), points = at$points, parts = at$parts)
  })
  bound <- function(what) do.call(rbind, lapply(each, `[[`, what))
  list(tests = bound("tests"), points = bound("points"), parts = bound("parts"), pca = pca)
}
