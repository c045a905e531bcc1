# Linear models of shape: which terms act on it, and where.

#' Linear models of shape
#'
#' Tests the terms of a linear model of shape: age, sex, size and their interactions. Each term is
#' tested for the whole shape, for size, for principal components, and at every point. A map of the
#' points shows where the term acts. [predict.shape_lm()] gives the expected shape, such as the mean
#' face at an age of 12 and of 40.
#'
#' **Tests.** The residuals of the model without the term are permuted and added to its fitted
#' values (Freedman and Lane 1983). The term is tested on each of these samples. Sums of squares, F,
#' Z and p of the whole shape equal those of `RRPP::lm.rrpp()` and `geomorph::procD.lm()` on the
#' same permutations. The same orders are used for all terms, tests and levels.
#'
#' **Sums of squares.** Type I tests a term given the terms before it: the order in the formula
#' matters. Type II tests it given all terms that do not contain it. Type III tests it given all
#' other terms. Main effects then depend on the coding of factors, which must sum to zero
#' (`contrasts = list(sex = "contr.sum")`).
#'
#' **Size.** `size` in the formula is the centroid size of the level, in the unit of the meshes. `~
#' log(size) + sex` tests whether the sexes differ by more than the effect of size. Do not regress
#' on size first and then test the residuals by sex. With groups of different size that removes part
#' of the difference, and the degrees of freedom are too many.
#'
#' **Blocks.** Residuals are exchanged within the blocks of `block` only (persons measured twice,
#' families, sites). To remove the differences between blocks, put the block into the formula as
#' well, as the first term. If every variable but size is constant within the blocks, the means of
#' the blocks are modelled. If only some are, terms that are constant within blocks have no p-value,
#' with a warning. For these terms, other random effects and phylogenies use `RRPP::lmm.rrpp()` and
#' `RRPP::lm.rrpp()` with [as_rrpp()], see `vignette("interop")`.
#'
#' @param sample As in [compare_groups()].
#' @param formula Right-hand side of a linear model, such as `~ age * sex + log(size)`. It may have
#'   numbers, factors, interactions, and functions of variables such as `poly(age, 2)` and
#'   `splines::ns(age, 3)`. Characters are factors. A group that is coded by numbers is a number:
#'   write `factor(sex)`.
#' @param data Data frame of the variables with a row for each specimen, matched by name as in
#'   [as_geomorph()]. Missing values are refused: leave the specimen out with
#'   `sample[setdiff(names(sample), "anna")]`. Not needed if `size` is the only variable.
#' @param level,n_perm,seed,progress As in [compare_groups()].
#' @param block Block of each specimen: a factor of length n, or a vector that can become one.
#'   Values with names are matched to the specimens by name. `NULL`: all specimens are independent.
#' @param settings Which tests are made, the type of the sums of squares, how a sample is aligned,
#'   and the like: as of [model_settings()].
#' @param ... Fields of [model_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return Object of class `shape_lm`, a list:
#'   * `tests`: data frame with a row for each level, term and test:
#'     * `level`, `term`, `test` ("shape", "size", "manova", "PC1", ...), `df`;
#'     * `squares`: sum of squares of the term; without unit if the alignment scales;
#'     * `share`: share of all squares (R squared);
#'     * `statistic`: F; for "manova" Pillai's trace;
#'     * `z`: standardised effect as in RRPP: the observed statistic among the permuted ones,
#'       transformed to normal and standardised;
#'     * `p_value`: by permutation;
#'     * `p_adjusted`: for components, by the greatest F over them;
#'     * `p_parametric`: under normality; for "manova" by the approximate F;
#'   * `points`: data frame with a row for each level, term and point; lengths in the unit of the
#'     meshes:
#'     * `level`, `term`, `point`, `x`, `y`, `z` (the mean);
#'     * `distance`: effect along the normal, outward positive. It is the effect of one unit of the
#'       term, or the difference from the reference level of a factor with two levels. NA without
#'       triangles, and for terms with more degrees of freedom;
#'     * `displacement`: root mean square displacement of the specimens by the term;
#'     * `statistic`: signed t if there is a `distance`, else F;
#'     * `p_value`, `p_adjusted` (by the greatest F over all points of the level and term, which
#'       controls the family-wise error). NA at points that are in no triangle of a level with
#'       triangles, as in [compare_groups()];
#'   * `parts`: data frame with a row for each level, term, and curve or patch of a `shape_sample`.
#'     Columns are `level`, `term`, `part`, `points` (number), `statistic` (F of all its points),
#'     `p_value`, and `p_adjusted` (by the least p over all parts);
#'   * `aligned`, `pca`, `models` (`terms`, `frame`, `matrix`, `coefficients`: p x dk): lists by
#'     level;
#'   * `left`: residual degrees of freedom;
#'   * `formula`, `ss`, `n_perm`, `block`, `exchange` ("free", "within", "whole"), `seed`,
#'     `provenance`.
#'
#'   `as.data.frame()` gives `tests`. `summary()` gives the adjusted p-values, with a row for each
#'   term and test and a column for each level.
#' @section Errors: of class `crestline_error`:
#'   * a variable is not a column of `data`, or has missing or infinite values (the error names the
#'     specimens);
#'   * a term is a linear combination of others, or no residual degrees of freedom are left.
#' @section Warnings: of class `crestline_contrasts`: type III has interactions of factors whose
#'   coding does not sum to zero. Of class `crestline_constant_term`: terms are constant within
#'   blocks. Of class `crestline_few_permutations`: no p-value can be below 0.05.
#' @template glossary
#' @references Freedman and Lane (1983) A nonstochastic interpretation of reported significance
#'   levels, *Journal of Business and Economic Statistics* 1, 292-298; Collyer, Sekora and Adams
#'   (2015) A method for analysis of phenotypic change for phenotypes described by high-dimensional
#'   data, *Heredity* 115, 357-365; Collyer and Adams (2018) RRPP, *Methods in Ecology and
#'   Evolution* 9, 1772-1779; Winkler, Ridgway, Webster, Smith and Nichols (2014) Permutation
#'   inference for the general linear model, *NeuroImage* 92, 381-397.
#' @seealso [model_settings()], [predict.shape_lm()], [plot.shape_lm()], [compare_groups()];
#'   `vignette("covariates")`
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 20), c(4, 3, 20))
#' shapes <- shapes + rnorm(240, sd = 0.05)
#' people <- data.frame(id = 1:20, age = runif(20, 5, 40), sex = rep(c("F", "M"), 10))
#' shapes[1, 3, ] <- shapes[1, 3, ] + people$age / 100
#' model <- shape_lm(shapes, ~ age + sex, people, n_perm = 199, seed = 1,
#'                   settings = model_settings(components = 3))
#' model
#' predict(model, data.frame(age = c(12, 40), sex = "F"))[1, , ]
#' @export
shape_lm <- function(sample, formula, data = NULL, level = c("landmarks", "curves", "surface"),
                     n_perm = 1000, block = NULL, seed = NULL, progress = interactive(),
                     settings = model_settings(), ...) {
  check_given()
  check_flags(progress)
  seed <- check_seed(seed)
  n_perm <- check_count(n_perm, "n_perm", upper = argument_limits()$permutations)
  check_class(settings, "model_settings", "settings", "model_settings()")
  settings <- settings_with_former(settings, "model_settings", ...)
  ss <- settings$ss
  terms <- model_terms(formula)
  tests <- setdiff(settings$tests, if ("size" %in% all.vars(terms)) "size")
  aligned <- aligned_levels(sample, level, settings$scale, settings$weights, settings$missing)
  columns <- model_data(terms, data, names(aligned[[1]]))
  design <- model_blocks(block, terms, columns, names(aligned[[1]]))
  units <- if (design$kind == "whole") lapply(aligned, in_design, design) else aligned
  if (design$kind == "whole") columns <- of_first(columns, design$block)
  orders <- model_orders(length(units[[1]]), design, n_perm, settings$permutations, seed)
  models <- lapply(units, level_model, terms = terms, columns = columns,
                   contrasts = settings$contrasts)
  warn_contrasts(models[[1]], ss)
  spans <- lapply(models, term_spans, ss)
  warn_few_orders(least_of_orders(orders, design), "model")
  tick <- comparison_ticks(progress, length(units) * length(spans[[1]]))
  each <- Map(function(one, span, name) {
    lm_level(one, span, orders, tests, settings$components, parts_of_points(sample, one, name),
             tick)
  }, units, spans, names(units))
  found <- structure(
    list(tests = with_level(each, "tests"), points = with_level(each, "points"),
         parts = with_level(each, "parts"), aligned = units, pca = lapply(each, `[[`, "pca"),
         models = models, left = spans[[1]][[1]]$left, formula = formula, ss = ss,
         n_perm = ncol(orders) - 1L, block = design$block, exchange = design$kind, seed = seed,
         provenance = with_settings(aligned[[1]]$provenance, "model", list(
           formula = deparse1(formula), ss = ss, n_perm = n_perm, exchange = design$kind))),
    class = "shape_lm")
  without_constant_terms(found, spans, design)
}

#' Variables of the first specimen of each block
#' @noRd
of_first <- function(columns, block) {
  first <- match(levels(block), block)
  lapply(columns, function(x) if (length(dim(x)) == 2) x[first, , drop = FALSE] else x[first])
}

#' What is exchanged: all specimens, those of a block, or whole blocks
#'
#' @return List: `kind` ("free", "within", "whole"), `block` (factor of n).
#' @noRd
model_blocks <- function(block, terms, columns, ids) {
  if (is.null(block)) return(list(kind = "free"))
  block <- check_block(block, ids)
  used <- columns[intersect(names(columns), all.vars(terms))]
  constant <- function(x) {
    x <- if (length(dim(x)) == 2) interaction(as.data.frame(x), drop = TRUE) else x
    all(tapply(as.character(x), block, function(own) length(unique(own))) == 1)
  }
  whole <- length(used) && all(vapply(used, constant, NA))
  list(kind = if (whole) "whole" else "within", block = block)
}

#' Orders of the units, the observed one first
#' @noRd
model_orders <- function(n, design, n_perm, permutations, seed) {
  check_memory(n * as.numeric(n_perm), n_perm, "n_perm")
  random <- if (!is.null(permutations)) check_permutations(permutations, n) else
    with_seed(seed, if (design$kind == "within") {
      block <- as.integer(design$block)
      own <- order(block)
      drawn <- replicate(n_perm, order(block, stats::runif(n)))
      drawn[own, ] <- drawn
      drawn
    } else replicate(n_perm, sample.int(n)))
  orders <- cbind(seq_len(n), random, deparse.level = 0)
  storage.mode(orders) <- "integer"
  orders
}

#' Type III tests of main effects beside interactions of factors mean something where factors are
#' coded to sum to zero
#' @noRd
warn_contrasts <- function(model, ss) {
  if (ss != "III" || !any(attr(model$terms, "order") > 1)) return(invisible())
  summed <- vapply(names(model$contrasts), function(name) {
    coding <- stats::model.matrix(
      ~ x, list(x = factor(levels(factor(model$frame[[name]])))),
      stats::setNames(model$contrasts[name], "x")
    )
    all(abs(colSums(coding[, -1, drop = FALSE])) < 1e-8)
  }, NA)
  if (all(summed)) return(invisible())
  crestline_warn(sprintf("type III with interactions, and %s not coded to sum to zero.",
                         shorten(names(summed)[!summed])),
                 "Main effects are then those at the first level: give `contrasts`, \"contr.sum\".",
                 stage = "model", class = "crestline_contrasts")
}

#' A model whose terms that no exchange within blocks can change have no p-values
#' @noRd
without_constant_terms <- function(found, spans, design) {
  if (design$kind != "within") return(found)
  block <- as.integer(design$block)
  constant <- vapply(spans[[1]], function(span) {
    own <- span$basis[, seq_len(span$df), drop = FALSE]
    means <- rowsum(own, block) / tabulate(block)
    max(abs(own - means[block, ])) < 1e-8
  }, NA)
  terms <- names(constant)[constant]
  if (!length(terms)) return(found)
  for (table in c("tests", "points", "parts")) {
    at <- found[[table]]$term %in% terms
    for (column in intersect(c("z", "p_value", "p_adjusted"), names(found[[table]]))) {
      found[[table]][[column]][at] <- NA_real_
    }
  }
  crestline_warn(sprintf("%s constant within blocks: exchange within them does not test it.",
                         shorten(terms)),
                 "Its p is NA. Test it with block = NULL on the blocks' means, or by lmm.rrpp().",
                 stage = "model", class = "crestline_constant_term")
  found
}

#' @exportS3Method
validate.shape_lm <- function(x) {
  levels <- names(x$aligned)
  table <- function(value, columns) {
    is.null(value) || is.data.frame(value) && all(columns %in% names(value)) &&
      is.numeric(value$p_value)
  }
  whole <- function(model) is.list(model) && inherits(model$terms, "terms") &&
    is.matrix(model$matrix) && is.matrix(model$coefficients)
  right <- is.list(x$aligned) && length(levels) > 0 && identical(names(x$models), levels) &&
    all(vapply(x$aligned, inherits, NA, "aligned")) && all(vapply(x$models, whole, NA)) &&
    table(x$tests, c("level", "term", "test", "df", "statistic", "p_adjusted")) &&
    table(x$points, c("level", "term", "point", "displacement", "p_adjusted")) &&
    table(x$parts, c("level", "term", "part", "p_adjusted")) &&
    inherits(x$formula, "formula") && is.numeric(x$n_perm) && length(x$n_perm) == 1
  if (!right) {
    crestline_abort("the model is damaged: its parts do not fit together.",
                    "Fit it anew: shape_lm().", stage = "model", call = NULL)
  }
  for (one in x$aligned) validate(one)
  invisible(x)
}

#' @rdname shape_lm
#' @param x,object A `shape_lm`.
#' @param row.names,optional Ignored.
#' @export
as.data.frame.shape_lm <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  x$tests
}

#' @rdname shape_lm
#' @export
summary.shape_lm <- function(object, ...) {
  check_method_dots(...)
  validate(object)
  levels <- names(object$aligned)
  rows <- unique(object$tests[c("term", "test")])
  p <- lapply(levels, function(level) {
    own <- object$tests[object$tests$level == level, ]
    own$p_adjusted[match(paste(rows$term, rows$test), paste(own$term, own$test))]
  })
  table <- data.frame(rows, stats::setNames(p, levels), check.names = FALSE, row.names = NULL)
  structure(table, provenance = object$provenance, class = c("comparison_summary", "data.frame"))
}

#' @export
print.shape_lm <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    unit <- if (x$exchange == "whole") "block" else "specimen"
    cat("<shape_lm> ", deparse1(x$formula), ", ", amount(length(x$aligned[[1]]), unit), ", type ",
        x$ss, ", ", amount(x$n_perm, "permutation"),
        if (x$exchange == "within") paste(" within", amount(nlevels(x$block), "block")), "\n",
        sep = "")
    shape <- x$tests[x$tests$test %in% "shape", ]
    for (level in unique(shape$level)) {
      own <- shape[shape$level == level, ]
      cat("  ", level, ", whole shape:\n", sep = "")
      table <- data.frame(Df = own$df, SS = own$squares, Rsq = own$share, F = own$statistic,
                          Z = own$z, p = own$p_value, row.names = own$term)
      print(signif(table, 4))
    }
    for (level in unique(x$points$level)) {
      for (term in unique(x$points$term)) {
        own <- x$points[x$points$level == level & x$points$term == term, ]
        cat("  ", level, ", ", term, ": ", sum(own$p_adjusted <= 0.05, na.rm = TRUE), " of ",
            amount(sum(!is.na(own$p_adjusted)), "point"), " (family-wise 0.05)\n", sep = "")
      }
    }
    invisible(x)
  })
}
