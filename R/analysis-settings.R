# Settings of alignments, comparisons and models.

#' Settings of align(), compare_groups() and shape_lm()
#'
#' `align_settings()` are the constants of [align()], `comparison_settings()` those of
#' [compare_groups()], and `model_settings()` those of [shape_lm()].
#'
#' @template setting-names
#' @param tolerance The rounds end when no co-ordinate of the mean changes by more than this share
#'   of its centroid size.
#' @param rounds Greatest number of rounds.
#' @param dir Of a sample in files ([open_sample()]): path of a new folder for the aligned points.
#'   `NULL`: one among the session's temporary files, which needs as much room as the sample's.
#' @param tests Tests to make. Comparisons: "size", "shape", "T2", "components", "points",
#'   "dispersion" (not with exchange within blocks). Models: "shape", "size" (centroid size; not
#'   with `size` in the formula), "manova" (Pillai's trace of the first components), "components"
#'   (each by itself), "points".
#' @param components Number of principal components: a whole number, or a share of the variance
#'   below 1. A comparison uses at most n - groups - 1.
#' @param exact Greatest number of regroupings that are enumerated in place of random permutations.
#'   `NULL`: `n_perm`.
#' @param permutations Orders of the specimens to use in place of random ones: n x B matrix, or list
#'   of B vectors. The orders of `RRPP:::perm.index()` give the p-values of RRPP. `NULL`: random
#'   orders.
#' @param n_boot Number of bootstrap samples for the intervals of effects.
#' @param ss Type of the sums of squares: "I", "II" or "III".
#' @param contrasts List of contrasts by factor, as in [stats::lm()]. `NULL`: those of the session.
#' @param scale,weights,missing How a sample is aligned, as in [align()]. "area" applies to levels
#'   with triangles; other levels have equal weights. Not used for an `aligned`.
#' @return List of class `align_settings`, `comparison_settings` or `model_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @seealso [align()], [compare_groups()], [shape_lm()]
#' @examples
#' comparison_settings(tests = c("shape", "T2"), components = 5)
#' model_settings(ss = "II")
#' @name test_settings
NULL

#' @rdname test_settings
#' @export
align_settings <- function(..., tolerance = 1e-12, rounds = 200, dir = NULL) {
  new_settings("align_settings", check_align_settings, list(...))
}

check_align_settings <- function(settings) {
  check_number(settings$tolerance, "tolerance", lower = 0)
  settings$rounds <- check_count(settings$rounds, "rounds")
  if (!is.null(settings$dir) && !is_path(settings$dir)) {
    refuse_argument("dir", settings$dir, "Give the path of one folder, or NULL.")
  }
  settings
}

#' @rdname test_settings
#' @export
comparison_settings <- function(..., tests = c("size", "shape", "T2", "components", "points",
                                               "dispersion"),
                                components = 10, exact = NULL, permutations = NULL, n_boot = 200,
                                scale = TRUE, weights = NULL, missing = "estimate") {
  new_settings("comparison_settings", check_comparison_settings, list(...))
}

check_comparison_settings <- function(settings) {
  if (!is.null(settings$exact)) check_number(settings$exact, "exact", lower = 0)
  settings$n_boot <- check_count(settings$n_boot, "n_boot", upper = argument_limits()$permutations)
  known <- c("size", "shape", "T2", "components", "points", "dispersion")
  check_test_settings(settings, known)
}

#' @rdname test_settings
#' @export
model_settings <- function(..., tests = c("shape", "size", "manova", "components", "points"),
                           components = 10, ss = "I", permutations = NULL, contrasts = NULL,
                           scale = TRUE, weights = NULL, missing = "estimate") {
  new_settings("model_settings", check_model_settings, list(...))
}

check_model_settings <- function(settings) {
  settings$ss <- check_choice(settings$ss, c("I", "II", "III"), "ss")
  contrasts <- settings$contrasts
  if (!is.null(contrasts) && (!is.list(contrasts) || is.null(names(contrasts)))) {
    refuse_argument("contrasts", contrasts, "Give a list by factor, or NULL.")
  }
  check_test_settings(settings, c("shape", "size", "manova", "components", "points"))
}

#' What comparisons and models share
#' @noRd
check_test_settings <- function(settings, known) {
  settings$tests <- check_choices(settings$tests, known, "tests")
  settings$components <- check_components(settings$components)
  check_scaling(settings$scale)
  settings$missing <- check_choice(settings$missing, c("estimate", "drop", "stop"), "missing")
  settings
}

check_components <- function(components) {
  components <- check_number(components, "components", lower = 0)
  if (components == 0) {
    crestline_abort("`components` is 0.",
                    "Give a whole number, or a share of the variance below 1.", stage = "arguments")
  }
  if (components >= 1) check_count(components, "components") else components
}

check_scaling <- function(scale) {
  if (isTRUE(scale)) return(1L)
  if (isFALSE(scale)) return(0L)
  if (identical(scale, "full")) return(2L)
  crestline_abort(sprintf("`scale` is %s.", describe_value(scale)),
                  "Choose TRUE, \"full\" or FALSE.", stage = "arguments")
}

#' @export
print.align_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<align_settings> of align()")
}

#' @export
print.comparison_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<comparison_settings> of compare_groups()")
}

#' @export
print.model_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<model_settings> of shape_lm()")
}
