# Results as tidy tables, for those who have generics or broom.

#' Tidy tables of comparisons, components and alignments
#'
#' Methods for the generics `tidy()` and `glance()` of the package generics, which broom re-exports.
#'
#' @param x A `group_comparison`, `shape_lm`, `shape_pca` or `aligned`.
#' @param what "tests" or "points" of a `group_comparison`; "tests", "points" or "parts" of a
#'   `shape_lm`.
#' @param ... Ignored.
#' @return Data frames. `tidy()` gives
#'   * for a comparison: a row for each level and test, with `level`, `term` (test), `statistic`,
#'     `p.value`, `adj.p.value`, `p.value.parametric`. With `what = "points"`: `level`, `term`
#'     (point), `estimate` (`distance` along the normal, or the displacement without normals; unit
#'     of the meshes), `statistic`, `p.value`, `adj.p.value`;
#'   * for a model: a row for each level, term and test (or point, or part);
#'   * for components: `PC`, `std.dev`, `percent`, `cumulative` (shares, as in broom);
#'   * for an alignment: a row for each specimen, as `as.data.frame()`.
#'
#'   `glance()` gives one row:
#'   * for a comparison: `nobs`, `groups`, `levels`, `permutations`, `exact`, `p.value` (smallest p
#'     of the mean shape over the levels);
#'   * for components: `nobs`, `points`, `components`, `variance` (total);
#'   * for an alignment: `nobs`, `points`, `size` (mean), `distance` (root mean square from the
#'     mean), `missing`.
#' @template glossary
#' @examplesIf requireNamespace("generics", quietly = TRUE)
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' aligned <- align(shapes + rnorm(120, sd = 0.05))
#' generics::tidy(shape_pca(aligned))
#' compared <- compare_groups(aligned, rep(1:2, 5), n_perm = 99,
#'                            settings = comparison_settings(components = 2))
#' generics::glance(compared)
#' @name tidy.group_comparison
NULL

#' @rdname tidy.group_comparison
#' @exportS3Method generics::tidy
tidy.group_comparison <- function(x, what = c("tests", "points"), ...) {
  check_method_dots(..., known = "what")
  validate(x)
  what <- check_choice(what, c("tests", "points"), "what")
  table <- x[[what]]
  if (is.null(table)) {
    crestline_abort(sprintf("there are no %s.", what), "Compare with more `tests`.",
                    stage = "comparison")
  }
  if (what == "points") {
    estimate <- ifelse(is.na(table$distance), table$displacement, table$distance)
    return(data.frame(level = table$level, term = table$point, estimate = estimate,
                      statistic = table$statistic,
                      p.value = table$p_value, adj.p.value = table$p_adjusted))
  }
  data.frame(level = table$level, term = table$test, statistic = table$statistic,
             p.value = table$p_value,
             adj.p.value = table$p_adjusted, p.value.parametric = table$p_parametric)
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::glance
glance.group_comparison <- function(x, ...) {
  check_method_dots(...)
  validate(x)
  shape <- x$tests$p_value[startsWith(as.character(x$tests$test), "mean shape")]
  data.frame(nobs = length(x$group), groups = nlevels(x$group), levels = length(x$aligned),
             permutations = x$n_perm,
             exact = x$exact,
             p.value = if (length(shape)) min(shape) else NA_real_)
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::tidy
tidy.shape_pca <- function(x, ...) {
  check_method_dots(...)
  validate(x)
  data.frame(PC = seq_along(x$sdev), std.dev = x$sdev, percent = x$share,
             cumulative = cumsum(x$share))
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::glance
glance.shape_pca <- function(x, ...) {
  check_method_dots(...)
  validate(x)
  data.frame(nobs = nrow(x$x), points = nrow(x$mean), components = length(x$sdev),
             variance = sum(x$sdev^2))
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::tidy
tidy.aligned <- function(x, ...) {
  check_method_dots(...)
  as.data.frame(x)
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::glance
glance.aligned <- function(x, ...) {
  check_method_dots(...)
  table <- as.data.frame(x)
  data.frame(nobs = nrow(table), points = nrow(x$mean), size = mean(table$size),
             distance = sqrt(mean(table$distance^2)),
             missing = nrow(x$missing))
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::tidy
tidy.shape_lm <- function(x, what = c("tests", "points", "parts"), ...) {
  check_method_dots(..., known = "what")
  validate(x)
  what <- check_choice(what, c("tests", "points", "parts"), "what")
  table <- x[[what]]
  if (is.null(table)) {
    crestline_abort(sprintf("there are no %s.", what), "Fit with more `tests`.", stage = "model")
  }
  own <- switch(what, tests = table[c("test", "df", "squares", "share")],
                points = table[c("point", "distance", "displacement")],
                parts = table[c("part", "points")])
  data.frame(level = table$level, term = table$term, own, statistic = table$statistic,
             p.value = table$p_value, adj.p.value = table$p_adjusted)
}

#' @rdname tidy.group_comparison
#' @exportS3Method generics::glance
glance.shape_lm <- function(x, ...) {
  check_method_dots(...)
  validate(x)
  shape <- x$tests[x$tests$test %in% "shape", ]
  data.frame(nobs = length(x$aligned[[1]]),
  terms = length(attr(x$models[[1]]$terms, "term.labels")),
             df.residual = x$left, levels = length(x$aligned), permutations = x$n_perm,
             p.value = if (NROW(shape)) min(shape$p_value) else NA_real_)
}
