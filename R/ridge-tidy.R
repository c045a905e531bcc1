# A curve as the generics of R and broom see it: intervals, tidy tables, a summary.

#' Confidence intervals, tidy tables and summary of a curve
#'
#' `confint()` gives a confidence interval for the distance d of each point from the reference path.
#' `tidy()`, `glance()` and `augment()` are methods for the package generics; broom re-exports its
#' functions.
#'
#' The intervals are `d` plus and minus a normal quantile times `se`. They hold for one point at a
#' time. The landmarks are taken as exact: `se` is 0 at the ends. The section on the standard error
#' in [ridge_curve()] names the errors that `se` does not include.
#'
#' @param object,x A `curve`, as [ridge_curve()] returns it.
#' @param parm Numbers of points, as in the column `point`. Default: all.
#' @param level,conf.level Confidence level, a share between 0 and 1.
#' @param conf.int Whether to add the interval.
#' @param ... Ignored.
#' @return `confint()`: matrix with a row for each point, and the lower and upper bound of d in the
#'   unit of the mesh; NA without standard errors.
#'
#'   `tidy()`: data frame with a row for each point: `term` (point), `s` (arc length along the
#'   curve), `estimate` (d), `std.error`, and with `conf.int` `conf.low` and `conf.high`.
#'
#'   `glance()`: data frame with one row: `type`, `length`, `strength` (mean along the curve),
#'   `std.error` (median), `nobs`, `df`, `sigma` (residual standard deviation of strength),
#'   `converged`, `determined`. `nobs` is the number of vertices in the smooth surface of curvature.
#'   Lengths and standard errors are in the unit of the mesh, strengths in 1 / unit.
#'
#'   `augment()`: data frame with a row for each vertex in that surface: `vertex`, `s`, `d`,
#'   `strength`, `.fitted`, `.resid` (1 / unit).
#'
#'   `summary()`: as in [provenance], with the standard errors of the length and of the mean
#'   strength.
#' @section Errors: of class `crestline_error`: `augment()` of a plane curve, or of a curve that was
#'   not found by curvature.
#' @template glossary
#' @seealso [ridge_curve()], [plot.curve()]
#' @examples
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' lip <- ridge_curve(face, "chL", "st", "valley", radius = 5, width = 6, n = 9)
#' confint(lip)
#' summary(lip)
#' @export
confint.curve <- function(object, parm = object$points$point, level = 0.95, ...) {
  check_method_dots(..., known = c("parm", "level"))
  check_class(object, "curve", "object", "ridge_curve()")
  level <- check_number(level, "level", 0, 1, open = TRUE)
  row <- match(check_numbers(parm, "parm"), object$points$point)
  if (anyNA(row)) {
    refuse_argument("parm", parm, "Give numbers of points of the curve.")
  }
  tail <- (1 - level) / 2
  bounds <- object$points$d[row] +
    outer(object$points$se[row], stats::qnorm(c(tail, 1 - tail)))
  percent <- paste(format(100 * c(tail, 1 - tail), trim = TRUE, digits = 3), "%")
  dimnames(bounds) <- list(object$points$point[row], percent)
  bounds
}

#' @rdname confint.curve
#' @exportS3Method generics::tidy
tidy.curve <- function(x, conf.int = FALSE, conf.level = 0.95, ...) {
  check_method_dots(..., known = c("conf.int", "conf.level"))
  check_class(x, "curve", "x", "ridge_curve()")
  check_flag(conf.int, "conf.int")
  points <- x$points
  table <- data.frame(term = points$point, s = points$s, estimate = points$d,
                      std.error = as.numeric(points$se))
  if (!conf.int) return(table)
  bounds <- confint.curve(x, level = check_number(conf.level, "conf.level", 0, 1, open = TRUE))
  cbind(table, conf.low = unname(bounds[, 1]), conf.high = unname(bounds[, 2]))
}

#' @rdname confint.curve
#' @exportS3Method generics::glance
glance.curve <- function(x, ...) {
  check_method_dots(...)
  check_class(x, "curve", "x", "ridge_curve()")
  fit <- if (!is.null(x$surface)) augment.curve(x)
  df <- if (is.null(fit)) NA_real_ else x$surface$df
  data.frame(type = x$type, length = x$length, strength = x$strength, std.error = x$se,
             nobs = if (is.null(fit)) NA_integer_ else nrow(fit), df = df,
             sigma = if (is.null(fit)) NA_real_ else sqrt(sum(fit$.resid^2) / (nrow(fit) - df)),
             converged = x$converged, determined = x$determined)
}

#' @rdname confint.curve
#' @exportS3Method generics::augment
augment.curve <- function(x, ...) {
  check_method_dots(...)
  check_class(x, "curve", "x", "ridge_curve()")
  if (is.null(x$surface)) {
    crestline_abort(sprintf("the curve from %s to %s was not found by curvature.", x$from, x$to),
                    "Give a ridge or valley that was found.", stage = "ridge curve", id = x$id)
  }
  at <- as.data.frame(unclass(x$coordinates))[x$surface$rows, c("vertex", "s", "d")]
  fitted <- predict.curvature_surface(x$surface, at$s, at$d)
  data.frame(at, strength = x$surface$strength, .fitted = fitted,
             .resid = x$surface$strength - fitted, row.names = NULL)
}

#' @rdname confint.curve
#' @export
summary.curve <- function(object, ...) {
  check_method_dots(...)
  check_class(object, "curve", "object", "ridge_curve()")
  range_text <- function(x) paste(signif(range(x, na.rm = TRUE), 3), collapse = " to ")
  points <- object$points
  found <- object$type != "plane" && !all(is.na(points$d))
  lines <- c(printed_lines(object),
             if (found) sprintf("  distance from the reference path %s", range_text(points$d)),
             if (found && !all(is.na(points$se))) {
               sprintf("  standard error %s", range_text(points$se))
             },
             if (!is.na(object$length_se)) {
               sprintf("  standard error of the length %.3g, of the mean strength %.3g",
                       object$length_se, object$strength_se)
             })
  settings <- if (object$type != "plane") list(ridge = unclass(object$settings))
  mesh <- if (!is.null(object$key)) list(id = object$id, key = object$key)
  new_summary(lines, c(made_with(), list(mesh = mesh, settings = settings)))
}
