#' Settings of the ridge estimate
#'
#' All tuning constants of [ridge_curve()] in one place. With the preset `"crestline"` curves do not
#' depend on the unit of the mesh or the number of grid points. `"one pass"` is the same without the
#' kernel and without the second pass, the former default. `"paper"` reproduces the
#' choices of the paper.
#'
#' @param preset `"crestline"`, `"one pass"` or `"paper"`.
#' @param ... Settings to change, by name; print a preset to see its values. Numbers have no unit
#'   (but see `lambda_scale`):
#'   * `order`: polynomial of the curvature fit, as in [curvature()];
#'   * `strength`: `"across"` the path (normal curvature normal to it) or `"principal"`;
#'   * `wrong_sign`: vertices with the wrong sign of curvature count as `"zero"` or are left out,
#'     `"drop"`;
#'   * `cap`, `cap_quantile`: strength is capped at `cap` times its quantile;
#'   * `window`: half width at most this many radii; `Inf`: the width given;
#'   * `vertices`: where a window holds more vertices than this it is divided into so many square
#'     cells in (s, d), and one vertex of each is used: the smooth surface gains nothing from more,
#'     and dense meshes take no longer; `Inf`: all;
#'   * `basis`: number of B-splines along and across;
#'   * `anisotropy`: penalty across over penalty along;
#'   * `df`: equivalent degrees of freedom of the smooth surface;
#'   * `lambda`: weight of the roughness of the ridge line, and `lambda_scale`: `"feature"`, divided
#'     by the feature's strength times the radius, or `"grid"`, the paper's sum over second
#'     differences (for meshes in mm);
#'   * `grid`: number of points of the ridge line, ends counted;
#'   * `core`: the mean strength that scales the criterion is taken within this share of the radius
#'     from the path;
#'   * `bound`: the ridge stays within this share of the half width;
#'   * `step`: longest Newton step, as a share of the half width; `iterations`, `tolerance` (share
#'     of the half width);
#'   * `kernel`: the criterion is averaged across the path under a kernel ([ridge_line()]), whose
#'     half width is this many standard errors of the line without it; 0: none. `kernel_most`:
#'     widest, in radii; `kernel_least`: narrower ones, in radii, count as none; `kernel_vertices`:
#'     as `vertices`, for this standard error;
#'   * `second`: share of a second pass, about the curve of the first, that is taken where both
#'     curves are equally strong; 0: one pass. `second_gain`: relative gain in strength at which
#'     half as much again of a whole pass is taken, the loss at which it is so much less;
#'     `second_whole`: half width of the kernel, in radii, from which the whole of it is taken;
#'   * `mix`: half width of the kernel, in radii, from which strength is that of the principal
#'     curvature; it is mixed with that across the path below. `Inf`: never. 0.6 suits very noisy
#'     data;
#'   * `noise`: the noise of the scanner, as [scan_noise()] measures it, or `NA`: not known. See
#'     [ridge_curve()], Standard error;
#'   * `longest`: reference paths may be this many times as long as the shortest;
#'   * `inflation`: factor of the standard error of the delta method, for what the linear
#'     approximation misses (what the band then covers: [ridge_curve()], Standard error);
#'   * `undetermined`: median standard error, in radii, above which a curve counts as not determined
#'     by curvature;
#'   * `faint`: a curve also counts as not determined where the mean strength near the reference
#'     path, times the radius (so without unit), is below this;
#'   * `error`: whether to work out standard errors at all.
#' @return List of class `ridge_settings`.
#' @section Errors: of class `crestline_error`, for a name that is no setting.
#' @template glossary
#' @templateVar where section 3.2 (12 degrees of freedom, lambda = 0.5)
#' @template paper
#' @examples
#' ridge_settings(df = 25)
#' ridge_settings("paper")
#' @export
ridge_settings <- function(preset = c("crestline", "one pass", "paper"), ...) {
  preset <- check_choice(preset, c("crestline", "one pass", "paper"), "preset")
  settings <- list(order = "adaptive cubic", strength = "across", wrong_sign = "zero", cap = 2,
                   cap_quantile = 0.99, window = 1.5, vertices = 4000, basis = c(10, 10),
                   anisotropy = 10, df = 20,
                   lambda = 1e-4, lambda_scale = "feature", grid = 41, core = 0.3, bound = 0.98,
                   step = 0.25, iterations = 100, tolerance = 1e-9, kernel = 12, kernel_most = 1.4,
                   kernel_least = 0.15, kernel_vertices = 400, second = 0.5, second_gain = 0.05,
                   second_whole = 0.6,
                   mix = Inf, noise = NA, longest = 1.25, inflation = 1.5,
                   undetermined = 0.2, faint = 0.15, error = TRUE)
  single <- list(kernel = 0, second = 0)
  paper <- list(order = "forced", strength = "principal", wrong_sign = "drop", cap = Inf,
                window = Inf, vertices = Inf, anisotropy = 1, df = 12, lambda = 0.5,
                lambda_scale = "grid",
                longest = Inf)
  if (preset != "crestline") settings[names(single)] <- single
  if (preset == "paper") settings[names(paper)] <- paper
  settings <- changed_settings(settings, list(...))
  # The presets as they are need no checks.
  structure(if (...length()) check_settings(settings) else settings, preset = preset,
            class = "ridge_settings")
}

check_settings <- function(settings) {
  positive <- c("cap", "cap_quantile", "window", "vertices", "anisotropy", "df", "lambda", "core",
                "bound", "step",
                "tolerance", "longest", "inflation", "undetermined", "faint", "kernel_most",
                "kernel_least", "kernel_vertices", "second_gain", "second_whole", "mix")
  for (name in positive) {
    if (!identical(settings[[name]], Inf)) {
      check_number(settings[[name]], name, lower = 0, open = TRUE)
    }
  }
  check_number(settings$kernel, "kernel", lower = 0)
  check_number(settings$second, "second", lower = 0, upper = 1)
  settings$noise <- noise_setting(settings$noise)
  check_count(settings$grid, "grid", lower = 5)
  check_count(settings$iterations, "iterations")
  check_choice(settings$strength, c("across", "principal"), "strength")
  check_choice(settings$wrong_sign, c("zero", "drop"), "wrong_sign")
  check_choice(settings$lambda_scale, c("feature", "grid"), "lambda_scale")
  if (!is.numeric(settings$basis) || length(settings$basis) != 2 || any(settings$basis < 5)) {
    crestline_abort(sprintf("`basis` is %s.", describe_value(settings$basis)),
                    "Give two whole numbers of at least 5: B-splines along and across.",
                    stage = "arguments")
  }
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
  printed(x, {
    cat(sprintf("<ridge_settings> preset \"%s\"\n", attr(x, "preset")))
    values <- vapply(x, function(value) paste(format(value), collapse = " x "), "")
    cat(strwrap(paste(names(x), values, sep = " = ", collapse = ", "), indent = 2, exdent = 2),
        sep = "\n")
    invisible(x)
  })
}
