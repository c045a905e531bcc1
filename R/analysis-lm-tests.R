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
  wants <- function(test) test %in% tests
  total <- sum(over_points(aligned, squares_by_row))
  whole <- if (wants("shape")) shape_scores(aligned, spans, orders)
  pca <- if (wants("components") || wants("manova")) {
    shape_pca(aligned, components = if (components >= 1) components)
  }
  scores <- if (!is.null(pca)) model_scores(pca, components, spans[[1]]$left)
  size <- cbind(size = aligned$size - mean(aligned$size))
  single <- cbind(if (wants("size")) size, if (wants("components")) scores)
  of_single <- if (!is.null(single)) column_squares(list(single), spans, orders)
  at <- if (wants("points")) lm_points(aligned, spans, orders, part)
  each <- lapply(names(spans), function(term) {
    span <- spans[[term]]
    tick()
    row <- function(...) lm_rows(term, span = span, ...)
    by_column <- function(names) {
      own <- of_single[[term]]$own[, match(names, colnames(single)), drop = FALSE]
      left <- of_single[[term]]$left[, match(names, colnames(single)), drop = FALSE]
      f <- own / span$df / (left / span$left)
      row(names, scores = list(squares = own, f = f),
          total = colSums(single[, names, drop = FALSE]^2),
          parametric = stats::pf(f[1, ], span$df, span$left, lower.tail = FALSE))
    }
    trace <- if (wants("manova")) pillai_scores(scores, span, orders)
    rows <- list(if (wants("shape")) row("shape", scores = whole[[term]], total = total),
                 if (wants("size")) by_column("size"),
                 if (wants("manova")) {
                   row("manova", scores = list(f = trace$trace), total = 1,
                       parametric = trace$parametric)
                 },
                 if (wants("components")) by_column(colnames(scores)))
    list(tests = do.call(rbind, rows), points = at[[term]]$points, parts = at[[term]]$parts)
  })
  bound <- function(what) do.call(rbind, lapply(each, `[[`, what))
  list(tests = bound("tests"), points = bound("points"), parts = bound("parts"), pca = pca)
}

#' Scores on as many components as leave a degree of freedom
#' @noRd
model_scores <- function(pca, components, left) {
  count <- if (components < 1) which(cumsum(pca$share) >= components - 1e-12)[1] else components
  pca$x[, seq_len(max(1, min(count, length(pca$sdev), left))), drop = FALSE]
}
