# Comparison of groups of specimens, level by level.

#' Compare groups of specimens
#'
#' The tests of the paper's section 6, for landmarks, curves and surface side by side: does size differ between the groups,
#' does the mean shape, do the first principal components together (Hotelling's T2) and one by one, and where. All p-values
#' come from the same permutations of the groups; where there are few regroupings, from all of them.
#'
#' | test | statistic (two groups; more) | `p_parametric` |
#' |---|---|---|
#' | "size t" | Student's t of centroid sizes, first group less second; F | of t, F |
#' | "mean shape" | Procrustes distance between the mean shapes; Goodall's F | none |
#' | "T2" | Hotelling's T2 on the first components; Hotelling and Lawley's trace times (n - groups) | of F |
#' | "PC1", ... | t of the scores, first group less second; F | of t, F |
#' | points | on a surface t of the displacement along the mean's normal (F), elsewhere Goodall's F of the point | none |
#'
#' For covariates, interactions, nested designs, give the sample to RRPP or geomorph: [as_geomorph()].
#'
#' @param sample A `shape_sample`; an array, k x 3 x n; a list of arrays or `aligned`s of the same specimens, named by level;
#'   or an `aligned`.
#' @param group Factor of n, or what makes one; with names, matched by the specimens' names.
#' @param level Levels of a `shape_sample`, as in [align()].
#' @param n_perm Number of random permutations.
#' @param components How many principal components: a whole number, or a share of the variance below 1. Never more than
#'   n - groups - 1.
#' @param seed Number that starts the random stream; the stream of the session is then left untouched. `NULL`: the
#'   session's stream.
#' @param tests Which: "size", "shape", "T2", "components", "points".
#' @param exact Most regroupings that are enumerated instead of drawn at random.
#' @param permutations Orders to use in place of random ones: n x B matrix or list (as of `RRPP:::perm.index()`), each
#'   an order
#'   of the specimens that takes the place of the observed one.
#' @param scale,weights,missing As in [align()]; "area" is for levels with triangles, the others then have none. Not used
#'   with an `aligned`, which is aligned already.
#' @param progress Whether to show a progress bar.
#' @return Object of class `group_comparison`, a list:
#'   * `tests`: data frame `level`, `test`, `statistic`, `p_value` (by permutation: the share of regroupings, the
#'     observed one
#'     among them, whose statistic is at least as great), `p_adjusted` (for the components of a level: by the greatest
#'     statistic over them, which controls the family-wise error; else as `p_value`), `p_parametric` (under normality),
#'     `share`
#'     (of variance: between groups for "mean shape", of the components used for the rest);
#'   * `points`: data frame, a row a level and point: `level`, `point`, `x`, `y`, `z` (the mean, of mean size), `distance`
#'     (second mean less first along the normal, outward positive; NA without triangles), `displacement` (between the
#'     means), in the unit of the meshes; `statistic`, `p_value`, `p_adjusted` (by the greatest statistic over all points of
#'     the level);
#'   * `aligned`, `pca`: lists by level; `group`; `n_perm` (regroupings besides the observed one), `exact` (whether all),
#'     `components` (by level), `seed`.
#'
#'   `as.data.frame()` gives `tests`; `summary()` the p-values with a row a test and a column a level.
#' @section Errors: of class `crestline_error`: a group with fewer than two specimens, one group only, groups that do
#'   not match
#'   the specimens, permutations that are none.
#' @references The paper, section 6; Goodall (1991) Procrustes methods in the statistical analysis of shape, *Journal of the
#'   Royal Statistical Society B* 53, 285-339; Westfall and Young (1993) *Resampling-Based Multiple Testing* (greatest
#'   statistics); Phipson and Smyth (2010) Permutation p-values should never be zero, *Statistical Applications in Genetics
#'   and Molecular Biology* 9, 39.
#' @seealso [plot.group_comparison()], [align()], [shape_pca()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 20), c(4, 3, 20))
#' shapes <- shapes + rnorm(240, sd = 0.05)
#' sex <- rep(c("F", "M"), each = 10)
#' shapes[1, 3, sex == "M"] <- shapes[1, 3, sex == "M"] + 0.15
#' compared <- compare_groups(shapes, sex, components = 3, seed = 1)
#' compared
#' head(compared$points)
#' @export
compare_groups <- function(sample, group, level = c("landmarks", "curves", "surface"), n_perm = 1000, components = 10,
                           seed = NULL, tests = c("size", "shape", "T2", "components", "points"), exact = n_perm,
                           permutations = NULL, scale = TRUE, weights = NULL,
                           missing = c("estimate", "drop", "stop"), progress = interactive()) {
  check_given()
  check_flags(progress)
  seed <- check_seed(seed)
  n_perm <- check_count(n_perm, "n_perm", upper = argument_limits()$permutations)
  exact <- check_number(exact, "exact", lower = 0)
  components <- check_components(components)
  tests <- check_tests(tests)
  aligned <- aligned_levels(sample, level, scale, weights, missing)
  group <- check_group(group, dimnames(aligned[[1]]$coords)[[3]])
  check_memory(length(group) * as.numeric(n_perm), n_perm, "n_perm")
  dealt <- regroupings(group, n_perm, exact, permutations, seed)
  # A block of point-wise tests needs 250 x k numbers.
  blocks <- permutation_blocks(ncol(dealt$labels), 250)
  tick <- comparison_ticks(progress, length(aligned) * (1 + length(blocks) * ("points" %in% tests)))
  each <- lapply(aligned, function(one) {
    tick()
    compare_level(one, dealt$labels, components, tests, blocks, tick)
  })
  count <- vapply(each, function(one) as.integer(one$components), 0L)
  structure(list(tests = with_level(each, "tests"), points = with_level(each, "points"), aligned = aligned,
                 pca = lapply(each, `[[`, "pca"), group = group, n_perm = ncol(dealt$labels) - 1L, exact = dealt$exact,
                 components = count, seed = seed), class = "group_comparison")
}

#' The tests of one level
#' @return List: `tests`, `points`, `pca`, `components`.
#' @noRd
compare_level <- function(aligned, labels, components, tests, blocks, tick) {
  wants <- function(test) test %in% tests
  flat <- matrix(aligned$coords, length(aligned$mean))
  y <- t((flat - rowMeans(flat)) * sqrt(rep(aligned$weights, ncol(aligned$mean))))
  pca <- if (wants("T2") || wants("components")) shape_pca(aligned)
  count <- if (is.null(pca)) NA else component_count(components, pca, max(labels))
  rows <- list(if (wants("size")) size_test(aligned$size, labels), if (wants("shape")) mean_shape_test(y, labels),
               if (wants("T2")) t2_test(pca, count, labels), if (wants("components")) component_tests(pca, count, labels))
  points <- if (wants("points")) point_tests(aligned, labels, blocks, tick)
  list(tests = do.call(rbind, rows), points = points, pca = pca, components = count)
}

#' Tables of all levels in one, the level first
#' @noRd
with_level <- function(each, table) {
  rows <- lapply(names(each), function(level) {
    own <- each[[level]][[table]]
    if (!is.null(own)) cbind(level = level, own)
  })
  every <- do.call(rbind, rows)
  if (!is.null(every)) rownames(every) <- NULL
  every
}

comparison_ticks <- function(progress, n) {
  if (!progress) return(function() NULL)
  bar <- cli::cli_progress_bar("Comparing groups", total = n, .envir = parent.frame())
  function() cli::cli_progress_update(id = bar)
}

#' `aligned`s named by level
#' @noRd
aligned_levels <- function(sample, level, scale, weights, missing, call = rlang::caller_env()) {
  if (inherits(sample, "aligned")) return(stats::setNames(list(sample), sample$level))
  as_aligned <- function(one, level) {
    areas <- identical(weights, "area") && inherits(one, "shape_sample") && !level %in% c("surface", "model")
    if (inherits(one, "aligned")) one else align(one, level, scale, if (!areas) weights, missing)
  }
  if (inherits(sample, "shape_sample")) {
    level <- check_choices(level, sample_levels, "level", call)
    return(lapply(stats::setNames(nm = level), function(one) as_aligned(sample, one)))
  }
  if (is.list(sample) && length(sample) && !is.null(names(sample))) {
    aligned <- Map(as_aligned, sample, names(sample))
    ids <- lapply(aligned, function(one) dimnames(one$coords)[[3]])
    if (!all(vapply(ids, identical, NA, ids[[1]]))) {
      crestline_abort("the levels have different specimens.", "Give arrays with the same specimens in the same order.",
                      stage = "comparison", call = call)
    }
    return(aligned)
  }
  list(points = as_aligned(sample, "points"))
}

check_components <- function(components, call = rlang::caller_env()) {
  components <- check_number(components, "components", lower = 0, call = call)
  if (components == 0) {
    crestline_abort("`components` is 0.", "Give a whole number, or a share of the variance below 1.", stage = "arguments",
                    call = call)
  }
  if (components >= 1) check_count(components, "components", call = call) else components
}

check_tests <- function(tests, call = rlang::caller_env()) {
  known <- c("size", "shape", "T2", "components", "points")
  check_choices(tests, known, "tests", call)
}

#' A factor with the levels that occur, in the order of the specimens
#' @noRd
check_group <- function(group, ids, call = rlang::caller_env()) {
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "comparison", call = call)
  if (!is.null(names(group))) {
    absent <- setdiff(ids, names(group))
    if (length(absent)) fail(sprintf("`group` has no value for %s.", shorten(absent)),
                             "Name its values by specimens, or not at all.")
    group <- group[ids]
  }
  if (length(group) != length(ids)) {
    fail(sprintf("`group` has %d values for %d specimens.", length(group), length(ids)), "Give one for each.")
  }
  if (anyNA(group)) {
    fail(sprintf("`group` is missing for %s.", shorten(ids[is.na(group)])), "Leave these specimens out.")
  }
  group <- stats::setNames(droplevels(as.factor(group)), ids)
  if (nlevels(group) < 2) fail("there is one group only.", "Give two or more.")
  if (min(table(group)) < 2) {
    fail(sprintf("the group \"%s\" has one specimen.", names(which.min(table(group)))), "Give every group two or more.")
  }
  group
}

#' @rdname compare_groups
#' @param x,object A `group_comparison`.
#' @param row.names,optional,... Ignored.
#' @export
as.data.frame.group_comparison <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$tests
}

#' @rdname compare_groups
#' @export
summary.group_comparison <- function(object, ...) {
  check_method_dots(...)
  levels <- names(object$aligned)
  tests <- unique(object$tests$test)
  p <- lapply(levels, function(level) {
    own <- object$tests[object$tests$level == level, ]
    own$p_value[match(tests, own$test)]
  })
  data.frame(test = tests, stats::setNames(p, levels), check.names = FALSE)
}

#' @export
print.group_comparison <- function(x, most = 5, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  counts <- table(x$group)
  drawn <- if (x$exact) paste("all", format(x$n_perm + 1, big.mark = ","), "regroupings") else
    amount(x$n_perm, "random permutation")
  cat("<group_comparison> ", paste0(names(counts), " (", counts, ")", collapse = " and "), "; ",
      drawn, "\n", sep = "")
  if (!is.null(x$tests)) cat("p-values by permutation:\n", paste0("  ", comparison_lines(x, most), "\n"), sep = "")
  used <- x$components[!is.na(x$components)]
  if (length(used)) cat("  T2 on ", paste(unique(used), collapse = ", "), " components\n", sep = "")
  if (!is.null(x$points)) {
    for (level in unique(x$points$level)) cat("  ", points_line(x$points[x$points$level == level, ]), "\n", sep = "")
  }
  invisible(x)
}

#' The table of p-values as lines of text; of the components the first ones
#' @noRd
comparison_lines <- function(x, most) {
  table <- summary(x)
  component <- grepl("^PC[0-9]+$", table$test)
  table <- table[!component | cumsum(component) <= most, ]
  digits <- function(p) ifelse(is.na(p), "", ifelse(p < 5e-5, "<0.0001", formatC(p, format = "f", digits = 4)))
  shown <- vapply(table[-1], digits, character(nrow(table)))
  all <- rbind(names(table)[-1], matrix(shown, nrow(table)))
  width <- apply(nchar(all), 2, max) + 2
  cells <- vapply(seq_along(width), function(j) formatC(all[, j], width = width[j]), character(nrow(all)))
  paste0(formatC(c("", table$test), width = -12), apply(matrix(cells, nrow(all)), 1, paste, collapse = ""))
}

points_line <- function(points, level = 0.05) {
  found <- which(points$p_adjusted <= level)
  text <- sprintf("%s: %s differ (family-wise %g)", points$level[1],
                  paste(length(found), "of", amount(nrow(points), "point")), level)
  if (!length(found) || all(is.na(points$displacement))) return(text)
  sprintf("%s, by %.3g at most (%s)", text, max(points$displacement[found]),
          points$point[found][which.max(points$displacement[found])])
}
