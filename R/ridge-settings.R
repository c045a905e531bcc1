#' Settings of the ridge estimate
#'
#' All tuning constants of [ridge_curve()] in one place. With the preset `"crestline"` curves do not
#' depend on the unit of the mesh or the number of grid points. `"one pass"` is the same without the
#' kernel and without the second pass, the former default. `"paper"` reproduces the
#' choices of the paper. The usage shows the values of `"crestline"`. Numbers have no unit (but see
#' `lambda_scale`).
#'
#' @param preset `"crestline"`, `"one pass"` or `"paper"`.
#' @param ... Nothing: settings are given by name, and an unknown name is an error.
#' @param order Polynomial of the curvature fit, as in [curvature()].
#' @param strength `"across"` the path (normal curvature normal to it) or `"principal"`.
#' @param wrong_sign Vertices with the wrong sign of curvature count as `"zero"` or are left out,
#'   `"drop"`.
#' @param cap,cap_quantile Strength is capped at `cap` times its quantile `cap_quantile`.
#' @param window Half width at most this many radii; `Inf`: the width given.
#' @param vertices Where a window holds more vertices than this it is divided into so many square
#'   cells in (s, d), and one vertex of each is used: the smooth surface gains nothing from more,
#'   and dense meshes take no longer; `Inf`: all.
#' @param basis Number of B-splines along and across.
#' @param anisotropy Penalty across over penalty along.
#' @param df Equivalent degrees of freedom of the smooth surface.
#' @param lambda Weight of the roughness of the ridge line.
#' @param lambda_scale `"feature"`, `lambda` is divided by the feature's strength times the radius,
#'   or `"grid"`, the paper's sum over second differences (for meshes in mm).
#' @param grid Number of points of the ridge line, ends counted.
#' @param core The mean strength that scales the criterion is taken within this share of the radius
#'   from the path.
#' @param bound The ridge stays within this share of the half width.
#' @param step Longest Newton step, as a share of the half width.
#' @param iterations,tolerance Most Newton steps; the step at which it ends, as a share of the half
#'   width.
#' @param kernel The criterion is averaged across the path under a kernel ([ridge_line()]), whose
#'   half width is this many standard errors of the line without it; 0: none.
#' @param kernel_most,kernel_least Widest kernel, in radii; narrower ones than the least, in radii,
#'   count as none.
#' @param kernel_vertices As `vertices`, for the standard error of the line without a kernel.
#' @param second Share of a second pass, about the curve of the first, that is taken where both
#'   curves are equally strong; 0: one pass.
#' @param second_gain Relative gain in strength at which half as much again of a whole pass is
#'   taken, the loss at which it is so much less.
#' @param second_whole Half width of the kernel, in radii, from which the whole second pass is
#'   taken.
#' @param mix Half width of the kernel, in radii, from which strength is that of the principal
#'   curvature; it is mixed with that across the path below. `Inf`: never. 0.6 suits very noisy
#'   data.
#' @param noise The noise of the scanner, as [scan_noise()] measures it, or `NA`: not known. See
#'   [ridge_curve()], Standard error.
#' @param longest Reference paths may be this many times as long as the shortest.
#' @param inflation Factor of the standard error of the delta method, for what the linear
#'   approximation misses (what the band then covers: [ridge_curve()], Standard error).
#' @param undetermined Median standard error, in radii, above which a curve counts as not determined
#'   by curvature.
#' @param faint A curve also counts as not determined where the mean strength near the reference
#'   path, times the radius (so without unit), is below this.
#' @param error Whether to work out standard errors at all.
#' @return List of class `ridge_settings`.
#' @section Errors: of class `crestline_error`, for a name that is no setting.
#' @template glossary
#' @templateVar where section 3.2 (12 degrees of freedom, lambda = 0.5)
#' @template paper
#' @examples
#' ridge_settings(df = 25)
#' ridge_settings("paper")
#' @export
ridge_settings <- function(preset = c("crestline", "one pass", "paper"), ...,
                           order = "adaptive cubic", strength = "across", wrong_sign = "zero",
                           cap = 2, cap_quantile = 0.99, window = 1.5, vertices = 4000,
                           basis = c(10, 10), anisotropy = 10, df = 20, lambda = 1e-4,
                           lambda_scale = "feature", grid = 41, core = 0.3, bound = 0.98,
                           step = 0.25, iterations = 100, tolerance = 1e-9, kernel = 12,
                           kernel_most = 1.4, kernel_least = 0.15, kernel_vertices = 400,
                           second = 0.5, second_gain = 0.05, second_whole = 0.6, mix = Inf,
                           noise = NA, longest = 1.25, inflation = 1.5, undetermined = 0.2,
                           faint = 0.15, error = TRUE) {
  preset <- check_choice(preset, c("crestline", "one pass", "paper"), "preset")
  single <- list(kernel = 0, second = 0)
  paper <- list(order = "forced", strength = "principal", wrong_sign = "drop", cap = Inf,
                window = Inf, vertices = Inf, anisotropy = 1, df = 12, lambda = 0.5,
                lambda_scale = "grid", longest = Inf)
  values <- switch(preset, crestline = list(), `one pass` = single, paper = c(single, paper))
  settings <- new_settings("ridge_settings", check_settings, list(...), values)
  structure(settings, preset = preset, class = "ridge_settings")
}

check_settings <- function(settings) {
  positive <- c("cap", "window", "vertices", "anisotropy", "df", "lambda", "core",
                "bound", "step",
                "tolerance", "longest", "inflation", "undetermined", "faint", "kernel_most",
                "kernel_least", "kernel_vertices", "second_gain", "second_whole", "mix")
  for (name in positive) {
    if (!identical(settings[[name]], Inf)) {
      check_number(settings[[name]], name, lower = 0, open = TRUE)
    }
  }
  check_flag(settings$error, "error")
  check_order(settings$order)
  check_number(settings$cap_quantile, "cap_quantile", lower = 0, upper = 1)
  check_number(settings$kernel, "kernel", lower = 0)
  check_number(settings$second, "second", lower = 0, upper = 1)
  settings$noise <- noise_setting(settings$noise)
  check_count(settings$grid, "grid", lower = 5)
  check_count(settings$iterations, "iterations")
  check_choice(settings$strength, c("across", "principal"), "strength")
  check_choice(settings$wrong_sign, c("zero", "drop"), "wrong_sign")
  check_choice(settings$lambda_scale, c("feature", "grid"), "lambda_scale")
  basis <- check_numbers(settings$basis, "basis", 2, lower = 5)
  if (any(basis != round(basis))) refuse_argument("basis", basis, "Give whole numbers.", NULL)
  if (settings$df <= 4 || settings$df >= prod(settings$basis)) {
    crestline_abort(sprintf("`df` is %s.", describe_value(settings$df)),
                    sprintf("Give a number between 4 and %g.", prod(settings$basis)),
                    stage = "arguments")
  }
  settings
}

#' @export
print.ridge_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, sprintf("<ridge_settings> preset \"%s\"", attr(x, "preset")))
}
