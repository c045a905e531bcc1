# Functions of former names: each says once a session what to write today, and does it.

#' Deprecated functions
#'
#' These names still work. Each gives a message once a session (class `crestline_deprecated`).
#'
#' * `plot_placing(specimen)` is `plot(specimen, what = "placing")`;
#' * `plot_refinement(specimen)` is `plot(specimen, what = "refinement")`;
#' * `plot_cuts(specimen, from, to)` is `plot(specimen, what = "cuts", from = from, to = to)`;
#' * `plot_panel(x)` is `plot(x, what = "panel")`.
#'
#' The former order of arguments of [write_page()] and [write_pca_page()], file first, works too,
#' with a message. So do the former names of their first argument, `specimen` and `pca`, and the
#' search constants of [reference_path()] as arguments; they are fields of [path_settings()] today.
#'
#' @param specimen,x A `specimen`, a `curve`.
#' @param from,to Names of two landmarks.
#' @param angles,surface `angles` and `colour` of [plot.specimen()].
#' @param ... Further arguments of [plot.specimen()] or [plot.curve()].
#' @return As of [plot.specimen()] and [plot.curve()].
#' @name crestline-deprecated
#' @keywords internal
NULL

#' @rdname crestline-deprecated
#' @export
plot_placing <- function(specimen, ...) {
  check_given()
  check_class(specimen, "specimen", "specimen", "find_landmarks()")
  inform_former("plot_placing(specimen)", "plot(specimen, what = \"placing\")")
  plot(specimen, what = "placing", ...)
}

#' @rdname crestline-deprecated
#' @export
plot_refinement <- function(specimen, ...) {
  check_given()
  check_class(specimen, "specimen", "specimen", "refine_landmarks()")
  inform_former("plot_refinement(specimen)", "plot(specimen, what = \"refinement\")")
  plot(specimen, what = "refinement", ...)
}

#' @rdname crestline-deprecated
#' @export
plot_cuts <- function(specimen, from, to, angles = c(-pi / 6, 0, pi / 6), surface = "plain", ...) {
  check_given()
  surface <- check_choice(surface, surface_choices, "surface")
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  inform_former("plot_cuts(specimen, from, to)",
                "plot(specimen, what = \"cuts\", from = from, to = to)")
  former <- list(...)
  names(former)[names(former) == "colour"] <- "colours"
  do.call(plot, c(list(specimen, surface, what = "cuts", from = from, to = to, angles = angles),
                  former), quote = TRUE)
}

#' @rdname crestline-deprecated
#' @export
plot_panel <- function(x, ...) {
  check_given()
  check_class(x, "curve", "x", "ridge_curve()")
  inform_former("plot_panel(x)", "plot(x, what = \"panel\")")
  plot(x, what = "panel", ...)
}
