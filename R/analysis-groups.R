# Comparison of groups of specimens, level by level.

#' Compare groups of specimens
#'
#' Tests whether groups differ in size, in mean shape, in the first principal components together
#' (Hotelling's T2) and one by one, and at which points. Landmarks, curves and surface are tested
#' side by side. All p-values come from the same permutations of the groups. If there are only few
#' regroupings, all of them are used.
#'
#' The paper's section 6 tests size (t), the first ten principal components together (Hotelling's
#' T2) and one by one, by 1,000 permutations, for landmarks, curves and surface. Added here are a
#' test of the distance between the mean shapes, p-values adjusted for the number of components, a
#' test at every point, and a test of dispersion.
#'
#' | test | statistic: two groups; more | null hypothesis | `p_parametric` |
#' |---|---|---|---|
#' | "size t" | Welch's t of centroid sizes, first group less second; F of Brown and Forsythe | equal mean sizes | of t, F |
#' | "mean shape" | Procrustes distance between the mean shapes; F of Brown and Forsythe, all co-ordinates together | equal mean shapes | none |
#' | "T2" | T2 with covariances of one form, on the first components; Hotelling and Lawley's trace | equal mean scores | none |
#' | "PC1", ... | Welch's t of the scores, first group less second; F of Brown and Forsythe | equal mean scores | of t, F |
#' | points | Welch's t of the displacement along the mean surface's normal; elsewhere F of Brown and Forsythe of the point | equal mean places | none |
#' | "dispersion" | greatest over least spread (root mean square distance to the own mean) | equal mean distances | none |
#'
#' **Unequal spread.** By default every group has its own spread, and only the means are compared. F
#' of Brown and Forsythe is the squares between groups over the sum of (1 - n_g / n) times the
#' variance of group g. In every regrouping it is transformed to a chi-squared scale by its own
#' degrees of freedom (Satterthwaite's below, Mehrotra's above; Wallace 1959). The values on that
#' scale are compared.
#'
#' For T2 and components, the covariance of a group is taken to be a scale of the group times a form
#' that all groups share. Specimens and means are brought to one scale before they are regrouped,
#' and T2 is that of the first components of these. Means count by their precision (James 1951). A
#' group of six then has one number to estimate, not a covariance, and T2 uses as many components as
#' with equal spread. If the forms differ too, the scale is the mean over the components in use.
#'
#' The variance of a small group is often estimated too low, which costs power. For size and single
#' components, the p-values by permutation therefore raise it towards the pooled variance, at most
#' to 1.5 times itself (components: three times). `statistic` and `p_parametric` have the variances
#' as they are.
#'
#' The tests are exact if the groups have one distribution. If only their means agree, they are
#' approximate (Janssen 1997; Chung and Romano 2016). With 30 specimens and spreads that differ up
#' to threefold they rejected 4 to 8 % of true null hypotheses at a level of 5 %, if the forms agree
#' (500 samples a case). T2 rejected up to 13 % where the forms differ (120 samples).
#'
#' With `equal_spread = TRUE` variances are pooled: Student's t, Goodall's F, Hotelling's T2,
#' Hotelling and Lawley's trace times (n - groups). The null hypothesis is then that the groups have
#' one distribution, spread included. If a small group varies more than a large one, pooled tests
#' can reject although the means are equal. With 24 and 6 specimens and a threefold spread they do
#' so in up to 9 of 10 samples. The function warns if this can happen.
#'
#' If spreads are equal and group sizes very unequal, pooled tests have more power. With 24 and 6
#' specimens the default found a difference in size in 0.06 of samples less, and one in components
#' in 0.03 less. T2, mean shape and points lost next to nothing. No test that holds its level under
#' unequal spread has the pooled test's power for a single variable. Decide before the p-values are
#' seen. `print()` names the tests for which it matters.
#'
#' **Few regroupings.** A p-value by permutation is at least 1 / (`n_perm` + 1), and with all
#' regroupings at least 1 over their number. With five specimens in each of two groups there are 252
#' regroupings; two-sided tests have p of at least 2/252 = 0.008. `print()`, `summary()` and
#' `plot()` give p-values of single components that are adjusted for their number; `as.data.frame()`
#' has both, `p_value` and `p_adjusted`.
#'
#' **Effects.** The distance between two sample means is above 0 even without a difference. `effect`
#' of the mean shape is therefore this distance less its mean over the regroupings. `effect` of size
#' is Cohen's d. Their intervals are quantiles of bootstrap samples within groups, about their mean.
#' `z` is the standardised effect of RRPP.
#'
#' **Pairs, repeats, sites.** Specimens of one person, family or site are not independent. Give the
#' person, family or site as `block`. Some blocks have specimens of several groups (before and
#' after; sites with patients and controls). Specimens are then exchanged within their block only,
#' and differences between blocks are removed. If each block lies in one group (repeated scans of
#' persons), the means of the blocks are compared, and whole blocks are exchanged.
#'
#' Other exchanges can be given as `permutations`. An example are pairs, with specimens 1 to 12
#' before and 13 to 24 after, in the same order:
#' ```
#' orders <- replicate(999, {
#'   turned <- which(runif(12) < 0.5)
#'   order <- 1:24
#'   order[c(turned, turned + 12)] <- c(turned + 12, turned)
#'   order
#' })
#' compare_groups(sample, time, settings = comparison_settings(permutations = orders))
#' ```
#' These orders keep pairs together, but differences between persons stay in the statistics:
#' `block` removes them and has more power.
#'
#' For covariates and interactions see [shape_lm()].
#' [crestline-package] has a glossary.
#'
#' @param sample A `shape_sample`; a sample in files, as of [open_sample()]; a k x 3 x n array; an
#'   `aligned`; or a list of arrays or `aligned`s of the same specimens, named by level.
#' @param group Group of each specimen: a factor of length n, or a vector that can become one.
#'   Values with names are matched to the specimens by name. A data frame with one column of groups
#'   and one of specimens (`id`, `specimen`, `file` and the like, or row names) is matched too.
#'   Case, blanks and a file's extension are ignored. Values without names are taken in the order of
#'   the specimens, with a message.
#' @param level Levels of a `shape_sample`, as in [align()].
#' @param n_perm Number of random permutations.
#' @param seed Seed of the random numbers, one number; the random stream of the session is then not
#'   changed. `NULL`: the session's stream is used.
#' @param block Block of each specimen: a factor of length n, or a vector that can become one.
#'   Specimens of one block are not independent of each other. Values with names are matched to the
#'   specimens by name. `NULL`: all specimens are independent.
#' @param equal_spread TRUE: the groups are assumed to have equal spread, and variances are pooled.
#' @template progress
#' @param settings Which tests are made, on how many components, how a sample is aligned, and the
#'   like: as of [comparison_settings()].
#' @param ... Fields of [comparison_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return Object of class `group_comparison`, a list:
#'   * `tests`: data frame with a row for each level and test:
#'     * `level`, `test`, `statistic` (see the table above);
#'     * `p_value`: by permutation, the share of regroupings (the observed one included) whose
#'       statistic is at least as great;
#'     * `p_adjusted`: for the components of a level, by the greatest statistic over them, which
#'       controls the family-wise error. For other tests it is `p_value`;
#'     * `p_parametric`: p under normality;
#'     * `share`: share of the variance. For size and mean shape, the share between groups; for
#'       other tests, the share of the components used;
#'     * `z`, `effect`, and `lower`, `upper` (95 % bootstrap interval of the effect); `effect` and
#'       interval are NA for more than two groups;
#'   * `points`: data frame with a row for each level and point, tested or not; lengths in the unit
#'     of the meshes:
#'     * `level`, `point`, `x`, `y`, `z` (the mean, of mean size);
#'     * `distance`: second mean less first along the normal, outward positive; NA without
#'       triangles;
#'     * `displacement`: distance between the means;
#'     * `statistic`, `p_value`, `p_adjusted` (by the greatest statistic over all points of the
#'       level). NA at points that are not tested, see the section below;
#'   * `aligned`, `pca`: lists by level;
#'   * `group`, `n_perm` (number of regroupings besides the observed one), `exact` (TRUE if these
#'     are all), `least` (the least p-value that they can give), `components` (number by level),
#'     `seed`, `equal_spread`;
#'   * `design`: list of `kind` (of exchange: "free", "within" or "whole" blocks), `group` (of the
#'     exchanged units), `block`.
#'
#'   `as.data.frame()` gives `tests`. `summary()` gives the adjusted p-values, with a row for each
#'   test and a column for each level.
#' @section Errors: of class `crestline_error`:
#'   * there is only one group, or a group has fewer than two specimens;
#'   * groups do not match the specimens, or a specimen is in two groups;
#'   * names of groups differ by blanks or case only;
#'   * `permutations` are not orders of the specimens.
#' @section Points without a test: The points of a level with triangles are tested along the normal
#'   of the mean surface. A point that is in no triangle has no normal: its `distance`, `statistic`
#'   and p-values are NA, and `print()` counts it ("37 more: no test"). The surface of
#'   [face_scheme()] has 37 such points of 922, on the mid-line, the nose, the lips and the upper
#'   face. Their `displacement` is given. Without "points" among the tests of
#'   [comparison_settings()], `points` is `NULL`.
#' @section Warnings: of class `crestline_unequal_spread`: variances are pooled, and groups of
#'   unequal size differ in spread. Of class `crestline_few_permutations`: no p-value can be below
#'   0.05.
#' @templateVar where section 6
#' @template paper
#' @references Goodall (1991) Procrustes methods in the statistical analysis of shape,
#'   *Journal of the Royal Statistical Society B* 53, 285-339; Janssen (1997) Studentized
#'   permutation tests for non-i.i.d. hypotheses, *Statistics and Probability Letters* 36, 9-21;
#'   Brown and Forsythe (1974) The small sample behavior of some statistics which test the equality
#'   of several means, *Technometrics* 16, 129-132; Wallace (1959) Bounds on normal approximations
#'   to Student's and the chi-square distributions, *Annals of Mathematical Statistics* 30,
#'   1121-1130; Mehrotra (1997) Improving the Brown-Forsythe solution to the generalized
#'   Behrens-Fisher problem, *Communications in Statistics - Simulation and Computation* 26,
#'   1139-1145; James (1951) The comparison of several groups of observations when the ratios of the
#'   population variances are unknown, *Biometrika* 38, 324-329; Chung and Romano (2016)
#'   Multivariate and multiple permutation tests, *Journal of Econometrics* 193, 76-91; Collyer and
#'   Adams (2018) RRPP: an R package for fitting linear models to high-dimensional data using
#'   residual randomization, *Methods in Ecology and Evolution* 9, 1772-1779 (Z); Flury (1986)
#'   Proportionality of k covariance matrices, *Statistics and Probability Letters* 4, 29-33;
#'   Anderson (2006) Distance-based tests for homogeneity of multivariate dispersions, *Biometrics*
#'   62, 245-253;
#'   Westfall and Young (1993) *Resampling-Based Multiple Testing* (greatest statistics); Phipson
#'   and Smyth (2010) Permutation p-values should never be zero, *Statistical Applications in
#'   Genetics and Molecular Biology* 9, 39.
#' @seealso [comparison_settings()], [plot.group_comparison()], [align()], [shape_pca()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 20), c(4, 3, 20))
#' shapes <- shapes + rnorm(240, sd = 0.05)
#' sex <- rep(c("F", "M"), each = 10)
#' shapes[1, 3, sex == "M"] <- shapes[1, 3, sex == "M"] + 0.15
#' compared <- compare_groups(shapes, sex, seed = 1,
#'                            settings = comparison_settings(components = 3))
#' compared
#' head(compared$points)
#' @export
compare_groups <- function(sample, group, level = c("landmarks", "curves", "surface"),
                           n_perm = 1000, block = NULL, seed = NULL, equal_spread = FALSE,
                           progress = interactive(), settings = comparison_settings(), ...) {
  check_given()
  check_flags(progress, equal_spread)
  seed <- check_seed(seed)
  n_perm <- check_count(n_perm, "n_perm", upper = argument_limits()$permutations)
  check_class(settings, "comparison_settings", "settings", "comparison_settings()")
  settings <- settings_with_former(settings, "comparison_settings", ...)
  tests <- settings$tests
  # Before what align() warns of
  if (has_scheme(sample)) suppressMessages(check_group(group, names(sample)))
  aligned <- aligned_levels(sample, level, settings$scale, settings$weights, settings$missing)
  group <- check_group(group, names(aligned[[1]]))
  check_memory(length(group) * as.numeric(n_perm), n_perm, "n_perm")
  design <- comparison_design(group, block)
  exact <- if (is.null(settings$exact)) n_perm else settings$exact
  dealt <- design_regroupings(design, n_perm, exact, settings$permutations, seed)
  if (design$kind == "within") tests <- setdiff(tests, "dispersion")
  counts <- bootstrap_counts(dealt$labels[, 1], settings$n_boot, seed)
  each <- compare_levels(aligned, design, dealt$labels, settings$components, tests, equal_spread,
                         counts, progress)
  count <- vapply(each, function(one) as.integer(one$components), 0L)
  compared <- structure(
    list(tests = with_level(each, "tests"), points = with_level(each, "points"), aligned = aligned,
         pca = lapply(each, `[[`, "pca"), group = group, n_perm = ncol(dealt$labels) - 1L,
         exact = dealt$exact, components = count, seed = seed, design = design,
         equal_spread = equal_spread, least = least_p(dealt$labels),
         provenance = with_settings(
           aligned[[1]]$provenance, "compare",
           list(n_perm = n_perm, components = settings$components, tests = tests,
                exchange = design$kind, equal_spread = equal_spread, n_boot = settings$n_boot)
         )),
    class = "group_comparison"
  )
  warn_unequal_spread(compared)
  warn_few_orders(compared$least, "comparison", exact = isTRUE(compared$exact))
  compared
}

#' @exportS3Method
validate.group_comparison <- function(x) {
  table <- function(value, columns) {
    is.null(value) ||
      is.data.frame(value) && all(columns %in% names(value)) && is.numeric(value$p_value) &&
        all(vapply(value, is.atomic, NA) & lengths(value) == nrow(value))
  }
  pca <- Filter(Negate(is.null), if (is.list(x$pca)) x$pca)
  design <- is.null(x$design) || is.list(x$design) && is.factor(x$design$group) &&
    is.character(x$design$kind) && isTRUE(x$design$kind %in% c("free", "whole", "within")) &&
    (x$design$kind == "whole" || length(x$design$group) == length(x$group))
  own <- function(one) inherits(one, "aligned") && length(one) == length(x$group)
  right <- table(x$tests, c(
      "level", "test", "statistic", "p_value", "p_parametric", "p_adjusted"
    )) &&
    design && table(x$points, c("level", "point", "p_value", "p_adjusted")) && is.factor(x$group) &&
    is.list(x$aligned) && length(x$aligned) > 0 && all(vapply(x$aligned, own, NA)) &&
    all(vapply(pca, inherits, NA, "shape_pca")) && is.numeric(x$n_perm) && length(x$n_perm) == 1
  if (!right) {
    crestline_abort("the comparison is damaged: its parts do not fit together.",
                    "Compare anew: compare_groups().",
                    stage = "comparison", call = NULL)
  }
  for (one in c(x$aligned, pca)) validate(one)
  invisible(x)
}

#' The tests of all levels, on the same regroupings
#' @return List by level, see [compare_level()].
#' @noRd
compare_levels <- function(aligned, design, labels, components, tests, equal_spread, counts,
                           progress) {
  # A block of point-wise tests needs 250 x k numbers.
  blocks <- permutation_blocks(ncol(labels), 250)
  tick <- comparison_ticks(progress, length(aligned) * (1 + length(blocks) * ("points" %in% tests)))
  spread <- list(equal = equal_spread,
                 lost = if (design$kind == "within") nlevels(design$block) - 1 else 0)
  each <- lapply(aligned, function(one) {
    tick()
    units <- in_design(one, design)
    on.exit(forget_units(units, one))
    compare_level(units, labels, components, tests, spread, blocks, counts, tick)
  })
  signs_of_first(each, nlevels(design$group) == 2)
}

#' The tests of one level
#' @param wide How many times as many components as are tested T2 with unequal spread is sought
#'   among: with 30 specimens and ten components all of them.
#' @return List: `tests`, `points`, `pca`, `components`.
#' @noRd
compare_level <- function(aligned, labels, components, tests, spread, blocks, counts, tick,
                          wide = 3) {
  wants <- function(test) test %in% tests
  pca <- found <- most <- common <- NULL
  if (wants("T2") || wants("components")) {
    if (spread$equal) wide <- 1
    found <- shape_pca(aligned, components = if (components >= 1) components * wide)
    most <- component_count(components, found)
    count <- testable_components(found, most, nrow(labels), max(labels), spread)
    among <- seq_len(min(wide * most, ncol(found$x)))
    if (!spread$equal) common <- common_form(found$x[, among, drop = FALSE], labels, count)
    pca <- first_components(found, if (components >= 1) most else length(found$sdev))
  }
  known <- if (inherits(aligned, "aligned_files") && (wants("shape") || wants("points"))) {
    sums_in_files(aligned, labels, counts, tested_normals(aligned))
  }
  total <- if (wants("shape")) {
    whole_shape(aligned, labels, spread, leading_squares(aligned, found), known)
  }
  rows <- list(if (wants("size")) size_test(aligned$size, labels, spread, counts),
               if (wants("shape")) mean_shape_test(total, labels, spread, counts),
               if (wants("T2")) t2_test(pca, most, labels, spread, common),
               if (wants("components")) component_tests(pca, most, labels, spread, common),
               if (wants("dispersion")) dispersion_test(aligned, labels))
  points <- if (wants("points")) point_tests(aligned, labels, spread, blocks, tick, known)
  list(tests = do.call(rbind, rows), points = points, pca = pca,
       components = if (is.null(pca)) NA else count)
}

#' Components of later levels turned to the side of the first level's of the same number
#' @noRd
signs_of_first <- function(each, two) {
  first <- each[[1]]$pca
  for (i in seq_along(each)[-1]) {
    pca <- each[[i]]$pca
    shared <- seq_len(min(length(first$sdev), length(pca$sdev)))
    turned <- shared[colSums(first$x[, shared, drop = FALSE] * pca$x[, shared, drop = FALSE]) < 0]
    each[[i]]$pca <- turn_components(pca, turned)
    of_turned <- each[[i]]$tests$test %in% names_of_components(pca)[turned]
    if (two) each[[i]]$tests$statistic[of_turned] <- -each[[i]]$tests$statistic[of_turned]
  }
  each
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
aligned_levels <- function(sample, level, scale, weights, missing) {
  if (inherits(sample, "aligned")) {
    validate(sample)
    return(stats::setNames(list(sample), sample$level))
  }
  as_aligned <- function(one, level) {
    areas <- identical(weights, "area") && has_scheme(one) && !level %in% c("surface", "model")
    if (inherits(one, "aligned")) one else align(one, level, scale, if (!areas) weights, missing)
  }
  if (has_scheme(sample)) {
    level <- check_choices(level, sample_levels, "level")
    return(lapply(stats::setNames(nm = level), function(one) as_aligned(sample, one)))
  }
  stored <- inherits(sample, "sample_files")
  if (is.list(sample) && !stored && length(sample) && !is.null(names(sample))) {
    aligned <- Map(as_aligned, sample, names(sample))
    ids <- lapply(aligned, names)
    if (!all(vapply(ids, identical, NA, ids[[1]]))) {
      crestline_abort("the levels have different specimens.",
                      "Give arrays with the same specimens in the same order.",
                      stage = "comparison")
    }
    return(aligned)
  }
  list(points = as_aligned(sample, "points"))
}

#' Whether a sample was measured by a scheme, in memory or in files
#' @noRd
has_scheme <- function(x) {
  inherits(x, "shape_sample") || inherits(x, "sample_files") && !is.null(x$template)
}

#' A factor with the levels that occur, in the order of the specimens
#' @noRd
check_group <- function(group, ids) {
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "comparison"
  )
  group <- by_specimen(group, ids, "group", fail)
  if (!is.factor(group)) group <- as.factor(if (is.character(group)) trimws(group) else group)
  absent <- is.na(group) | !nzchar(trimws(as.character(group)))
  if (any(absent)) fail(sprintf("`group` is missing for %s.", shorten(ids[absent])),
                        "Leave these specimens out.")
  group <- stats::setNames(droplevels(group), ids)
  alike <- alike_levels(levels(group))
  if (length(alike)) {
    fail(sprintf("the groups %s differ by blanks or case only.",
                 paste0("\"", alike, "\"", collapse = " and ")),
         "Give them one name.")
  }
  if (nlevels(group) < 2) fail("there is one group only.", "Give two or more.")
  if (min(table(group)) < 2) {
    fail(sprintf("the group \"%s\" has one specimen.", names(which.min(table(group)))),
         "Give every group two or more. Two single shapes: plot(sample) draws both.")
  }
  group
}

#' @rdname compare_groups
#' @param x,object A `group_comparison`.
#' @param row.names,optional Ignored.
#' @export
as.data.frame.group_comparison <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  x$tests
}

#' @rdname compare_groups
#' @export
summary.group_comparison <- function(object, ...) {
  check_method_dots(...)
  validate(object)
  levels <- names(object$aligned)
  tests <- unique(object$tests$test)
  p <- lapply(levels, function(level) {
    own <- object$tests[object$tests$level == level, ]
    own$p_adjusted[match(tests, own$test)]
  })
  table <- data.frame(test = tests, stats::setNames(p, levels), check.names = FALSE)
  structure(table, provenance = object$provenance, class = c("comparison_summary", "data.frame"))
}

#' @export
print.comparison_summary <- function(x, ...) {
  printed(x, {
    print.data.frame(x, row.names = FALSE)
    if (!is.null(attr(x, "provenance"))) print_provenance(attr(x, "provenance"))
    invisible(x)
  })
}

#' @export
print.group_comparison <- function(x, most = 5, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  printed(x, {
    counts <- table(x$group)
    drawn <- if (x$exact) paste0(
      "all ", format(x$n_perm + 1, big.mark = ","), " regroupings",
      if (!is.null(x$least)) sprintf(", least p %.2g", x$least)
    ) else
      amount(x$n_perm, "random permutation")
    cat("<group_comparison> ", paste0(names(counts), " (", counts, ")", collapse = " and "), "; ",
        drawn, "\n", sep = "")
    if (!is.null(x$tests)) {
      adjusted <- if (any(grepl("^PC[0-9]+$", x$tests$test))) {
        " (of single components: adjusted for their number)"
      }
      cat("p-values by permutation", adjusted, ":\n",
          paste0("  ", comparison_lines(x, most), "\n"), sep = "")
    }
    line <- design_line(x$design)
    if (!is.null(line)) cat("  ", line, "\n", sep = "")
    said <- c(spread_line(x), power_line(x))
    if (length(said)) cat(strwrap(said, width = 80, indent = 2, exdent = 4), sep = "\n")
    for (level in names(x$aligned)) {
      for (line in missing_lines(x$aligned[[level]]$missing)) cat(strwrap(paste0(level, ": ", line),
                                                                          indent = 2, exdent = 4),
                                                                  sep = "\n")
    }
    used <- x$components[!is.na(x$components)]
    if (length(used)) cat("  T2 on ", paste(unique(used), collapse = ", "), " components\n",
                          sep = "")
    if (!is.null(x$points)) {
      for (level in unique(x$points$level)) {
        line <- points_line(x$points[x$points$level == level, ])
        cat(strwrap(line, width = 80, indent = 2, exdent = 4), sep = "\n")
      }
    }
    invisible(x)
  })
}

#' The table of p-values as lines of text; of the components the first ones
#' @noRd
comparison_lines <- function(x, most) {
  table <- summary(x)
  component <- grepl("^PC[0-9]+$", table$test)
  table <- table[!component | cumsum(component) <= most, ]
  digits <- function(p) ifelse(is.na(p), "", ifelse(
    p < 5e-5, "<0.0001", formatC(p, format = "f", digits = 4)
  ))
  shown <- vapply(table[-1], digits, character(nrow(table)))
  all <- rbind(names(table)[-1], matrix(shown, nrow(table)))
  width <- apply(nchar(all), 2, max) + 2
  cells <- vapply(seq_along(width), function(j) formatC(all[, j], width = width[j]),
                  character(nrow(all)))
  paste0(formatC(c("", table$test), width = -12),
         apply(matrix(cells, nrow(all)), 1, paste, collapse = ""))
}

#' One line about the spread of the groups
#' @noRd
spread_line <- function(x) {
  worst <- worst_spread(x)
  if (is.null(worst)) return(NULL)
  sprintf("dispersion: the spreads of the groups differ by a factor of %.2g at most (%s, p = %s)",
          worst$statistic,
          worst$level, format.pval(worst$p_value, digits = 2, eps = 1e-4))
}

#' One line where the groups' sizes and spreads are such that pooled tests are wrong, or else where
#' the default costs power
#' @param ratio Of the greatest group's size to the smallest's, from which it is said.
#' @noRd
power_line <- function(x, ratio = 2) {
  sizes <- table(x$design$group)
  if (unequal_spread(x)) {
    return(paste("groups of unequal size differ in spread:", if (x$equal_spread) {
      "pooled p-values are wrong then, give equal_spread = FALSE"
    } else "equal_spread = TRUE would give wrong p-values"))
  }
  tested <- x$tests$test %in% c("size t", "size F") | grepl("^PC[0-9]+$", x$tests$test)
  if (x$equal_spread || !any(tested) || max(sizes) < ratio * min(sizes)) return(NULL)
  paste("groups are unequal in size: tests of size and of single components have more power with",
        "equal_spread = TRUE, which takes the spreads for equal")
}

worst_spread <- function(x) {
  own <- x$tests[x$tests$test %in% "dispersion", ]
  if (NROW(own)) own[which.max(own$statistic), ]
}

#' Whether groups of unequal size differ in spread
#' @param ratio Of the spreads of groups of unequal size, above which pooled tests are not to be
#'   trusted. At 24 and 6 specimens and a ratio of 3 they reject a true null hypothesis in more than
#'   40 % of samples: `tests/testthat/test-analysis-spread.R`.
#' @noRd
unequal_spread <- function(x, ratio = 1.5) {
  worst <- worst_spread(x)
  sizes <- table(x$design$group)
  !is.null(worst) && min(sizes) != max(sizes) && isTRUE(worst$statistic > ratio)
}

warn_unequal_spread <- function(x) {
  if (!x$equal_spread || !unequal_spread(x)) return(invisible())
  worst <- worst_spread(x)
  sizes <- table(x$design$group)
  crestline_warn(
    sprintf(paste("the groups are unequal in size (%s), and their spreads differ by a factor of",
                  "%.2g (%s)."),
            paste(sizes, collapse = ", "), worst$statistic, worst$level),
    "Pooled tests then have wrong p-values: give `equal_spread = FALSE`.", stage = "comparison",
    class = "crestline_unequal_spread"
  )
}

points_line <- function(points, level = 0.05) {
  found <- which(points$p_adjusted <= level)
  untested <- sum(is.na(points$p_adjusted))
  more <- if (untested) sprintf(" (%d more: no test)", untested) else ""
  text <- sprintf("%s: %d of %s%s differ (family-wise %g)", points$level[1], length(found),
                  amount(nrow(points) - untested, "point"), more, level)
  if (!length(found) || all(is.na(points$displacement))) return(text)
  sprintf("%s, by %.3g at most (%s)", text, max(points$displacement[found]),
          points$point[found][which.max(points$displacement[found])])
}
