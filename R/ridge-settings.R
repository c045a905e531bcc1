#' Settings of the ridge estimate
#'
#' All tuning constants of [ridge_curve()]. With the preset `"crestline"` curves do not depend on
#' the unit of the mesh or the number of grid points. `"one pass"` has neither the kernel nor the
#' second pass; it is the former default. `"paper"` has the choices of the paper. The usage shows
#' the values of `"crestline"`. Numbers have no unit (but see `lambda_scale`). Radius, width and
#' number of points of a curve are not settings: they are arguments of [ridge_curve()], or columns
#' of a scheme ([curve_scheme()]).
#'
#' @param preset `"crestline"`, `"one pass"` or `"paper"`.
#' @template setting-names
#' @param order Polynomial of the curvature fit, as in [curvature()].
#' @param strength Curvature that gives the strength: `"across"` (normal curvature perpendicular to
#'   the path) or `"principal"`.
#' @param wrong_sign Strength at vertices with the wrong sign of curvature: `"zero"`, or `"drop"` to
#'   leave them out.
#' @param cap,cap_quantile Strength is capped at `cap` times its quantile `cap_quantile`.
#' @param window Greatest half width of the window, in radii. `Inf`: no limit.
#' @param vertices Greatest number of vertices of a window that are used. A window with more
#'   vertices is divided into this number of square cells in (s, d), and one vertex of each cell is
#'   used. Dense meshes then take no longer, and the smooth surface is as good. `Inf`: all.
#' @param basis Number of B-splines along and across.
#' @param basis_most Curves of least cost and closed curves may be long. Along one that is longer
#'   than `basis[1]` radii there is a B-spline for each radius, up to this number; `df` and `grid`
#'   grow with their number, and `lambda` falls with the fourth power of the length.
#' @param anisotropy Penalty across over penalty along.
#' @param df Equivalent degrees of freedom of the smooth surface.
#' @param lambda Weight of the roughness of the ridge line.
#' @param lambda_scale `"feature"`: `lambda` is divided by the feature's strength times the radius.
#'   `"grid"`: the paper's sum over second differences (for meshes in mm).
#' @param grid Number of points of the ridge line, both ends included.
#' @param core Distance from the path within which the mean strength is taken that scales the
#'   criterion, as a share of the radius.
#' @param bound Greatest distance of the ridge from the path, as a share of the half width.
#' @param step Longest Newton step, as a share of the half width.
#' @param iterations,tolerance Greatest number of Newton steps, and the step at which they end, as a
#'   share of the half width.
#' @param kernel Half width of the kernel that averages the criterion across the path (see
#'   [ridge_line()]), in standard errors of the line without kernel. 0: no kernel.
#' @param kernel_most,kernel_least Greatest and least half width of the kernel, in radii. A narrower
#'   kernel is not used.
#' @param kernel_vertices As `vertices`, for the standard error of the line without a kernel.
#' @param second Share of a second pass in the curve if the curves of both passes are equally
#'   strong. The second pass takes the first curve as its reference path. 0: one pass.
#' @param second_gain Relative gain in strength of the second pass that raises its share by half of
#'   a pass. An equal loss lowers the share by as much.
#' @param second_whole Half width of the kernel, in radii, above which the share of the second pass
#'   is 1.
#' @param mix Half width of the kernel, in radii, above which the strength is that of the principal
#'   curvature. Below it the strength is a mixture with that across the path. `Inf`: always across
#'   the path. 0.6 suits very noisy data.
#' @param noise Noise of the scanner, as of [scan_noise()], or `NA` if it is not known. See
#'   [ridge_curve()], Standard error.
#' @param longest Greatest length of a reference path, as a multiple of the shortest.
#' @param inflation Factor on the standard error of the delta method. It corrects for the linear
#'   approximation. For the coverage see [ridge_curve()], Standard error.
#' @param undetermined Median standard error, in radii, above which a curve counts as not determined
#'   by curvature.
#' @param faint Mean strength near the reference path, times the radius, below which a curve counts
#'   as not determined by curvature.
#' @param beside Greatest distance of a landmark from the ridge or valley that ends on it, in radii.
#'   Beyond it the landmark counts as beside its crest, see `beside` of [ridge_curve()].
#' @param widest Greatest radius, as a multiple of the distance of the two ends (on a curve with
#'   `via`, of its reference path's length). With a wider one the curve counts as not determined:
#'   the radius is most likely in another unit than the mesh. Of the ridges of [face_scheme()] the
#'   widest has 0.33.
#' @param detour Greatest length of a curve, as a multiple of the distance of its ends, beyond which
#'   it counts as not determined. Curves of least cost may be longer. The ridges of [face_scheme()]
#'   have up to 1.3.
#' @param error Whether to compute standard errors.
#' @param passes Number of passes. Each pass takes the curve of the pass before as its reference
#'   path. `NULL`: one pass and a share of a second one, by `second`.
#' @return List of class `ridge_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
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
                           basis = c(10, 10), basis_most = 40, anisotropy = 10, df = 20,
                           lambda = 1e-4, lambda_scale = "feature", grid = 41, core = 0.3,
                           bound = 0.98, step = 0.25, iterations = 100, tolerance = 1e-9,
                           kernel = 12, kernel_most = 1.4, kernel_least = 0.15,
                           kernel_vertices = 400, second = 0.5, second_gain = 0.05,
                           second_whole = 0.6, mix = Inf, noise = NA, longest = 1.25,
                           inflation = 1.5, undetermined = 0.2, faint = 0.15, beside = 0.3,
                           widest = 0.75, detour = 3, error = TRUE, passes = NULL) {
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
  positive <- c("cap", "window", "vertices", "anisotropy", "df", "lambda", "core", "bound", "step",
                "tolerance", "longest", "inflation", "undetermined", "faint", "beside",
                "widest", "detour",
                "kernel_most", "kernel_least", "kernel_vertices", "second_gain", "second_whole",
                "mix")
  for (name in positive) {
    if (!identical(settings[[name]], Inf)) {
      check_number(settings[[name]], name, lower = 0, open = TRUE)
    }
  }
  check_flag(settings$error, "error")
  if (!is.null(settings$passes)) {
    settings$passes <- check_count(settings$passes, "passes", upper = 1000)
  }
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
  check_count(settings$basis_most, "basis_most", lower = 5)
  basis <- check_numbers(settings$basis, "basis", 2, lower = 5)
  if (any(basis != round(basis))) refuse_argument("basis", basis, "Give whole numbers.")
  if (settings$df <= 4 || settings$df >= prod(settings$basis)) {
    crestline_abort(sprintf("`df` is %s.", describe_value(settings$df)),
                    sprintf("Give a number between 4 and %g.", prod(settings$basis)),
                    stage = "arguments")
  }
  settings
}

#' Settings for a path that may be long
#'
#' Ten splines and one lambda for each curve make long curves stiff: with u = s / L the roughness
#' grows with (L / r)^4.
#' @param length Of the path, in the unit of the mesh.
#' @noRd
long_settings <- function(settings, length, radius) {
  usual <- settings$basis[1]
  k <- max(usual, min(ceiling(length / radius), settings$basis_most))
  settings$df <- settings$df * k / usual
  settings$basis[1] <- k
  settings$lambda <- settings$lambda * min(1, usual * radius / length)^4
  settings$grid <- max(settings$grid, 4 * k + 1)
  settings
}

#' @export
print.ridge_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, sprintf("<ridge_settings> preset \"%s\"", attr(x, "preset")))
}
