#' Smooth surface of curvature strength over arc length and distance
#'
#' Fits a smooth surface to the strength at the vertices of a window. It is a tensor
#' product of cubic B-splines with second-order difference penalties and a fixed
#' number of equivalent degrees of freedom.
#'
#' @param coordinates [path_coordinates()] of the window.
#' @param strength Strength at each row of `coordinates`, in 1 / unit of the mesh. `NA` leaves a
#'   vertex out.
#' @param settings [ridge_settings()]: `basis`, `anisotropy`, `df`.
#' @return Object of class `curvature_surface`, a list:
#'   * `coefficients`: matrix, basis across x basis along;
#'   * `length`, `width`: of the window, in the unit of the mesh;
#'   * `rows`, `strength`: rows of `coordinates` in the fit, and their strength;
#'   * `penalty`: the smoothing parameter;
#'   * `df`: equivalent degrees of freedom of the fit; `converged`;
#'   * the spline margins.
#'
#'   `predict(x, s, d, derivative)` gives the strength at places (s, d), one number each, or its
#'   derivative of the given order by `d`.
#' @section Errors: of class `crestline_error`: fewer vertices are left than the fit has degrees of
#'   freedom.
#' @template glossary
#' @templateVar where section 3.2
#' @template paper
#' @references Eilers, P. H. C. and Marx, B. D. (1996) Flexible smoothing with B-splines and
#'   penalties. *Statistical Science* 11(2), 89-121. Bases and penalties are those of the package
#'   mgcv.
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' path <- plane_path(ball, c(1, 0, 0), c(0, 1, 0))
#' window <- path_coordinates(ball, path, width = 0.3)
#' smooth <- curvature_surface(window, 1 - window$d^2)
#' predict(smooth, s = 0.7, d = c(0, 0.1))
#' @export
curvature_surface <- function(coordinates, strength, settings = ridge_settings()) {
  check_given()
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  check_class(coordinates, "path_coordinates", "coordinates", "path_coordinates()")
  strength <- check_numbers(strength, "strength", nrow(coordinates), missing = TRUE)
  in_context(smooth_strength(coordinates, strength, settings), attr(coordinates, "id"))
}

#' The smooth surface without checks, or a failure
#' @noRd
smooth_strength <- function(coordinates, strength, settings) {
  length <- attr(coordinates, "length")
  width <- attr(coordinates, "width")
  rows <- which(coordinates$inside & !is.na(strength))
  if (length(rows) < settings$df) {
    return(no_result(
      sprintf("only %d vertices of the window have a curvature, fewer than %g degrees of freedom.",
              length(rows), settings$df),
      "Give a larger `width` or `radius`, or fewer degrees of freedom: ridge_settings(df = ).",
      "curvature surface"
    ))
  }
  margins <- list(along = spline_margin(settings$basis[1], 0, 1,
                                        isTRUE(attr(coordinates, "closed"))),
                  across = spline_margin(settings$basis[2], -1, 1))
  design <- list(along = margin_design(margins$along, coordinates$s[rows] / length),
                 across = margin_design(margins$across, coordinates$d[rows] / width))
  penalty <- tensor_penalty(margins, settings$anisotropy)
  moments <- cpp_tensor_moments(design$along, design$across, strength[rows])
  chosen <- penalty_for_df(moments$matrix, penalty, settings$df)
  factor <- if (failed(chosen)) chosen else
    surface_factor(moments$matrix + chosen$value * penalty)
  if (failed(factor)) return(factor)
  beta <- backsolve(factor, backsolve(factor, moments$right, transpose = TRUE))
  structure(
    list(coefficients = matrix(beta, settings$basis[2]), length = length, width = width,
         rows = rows,
         strength = strength[rows], penalty = chosen$value, df = chosen$df,
         converged = chosen$converged,
         margins = margins, design = design, factor = factor),
    class = "curvature_surface"
  )
}

#' Cholesky factor, or a failure when the vertices do not determine a surface
#' @noRd
surface_factor <- function(moments) {
  tryCatch(chol(moments), error = function(e) {
    no_result(paste("the vertices of the window lie on a line in (s, d), or far too unevenly",
                    "for a smooth surface."),
                "Check the mesh by the landmarks for stretched triangles; give a larger `width`.",
                "curvature surface")
  })
}

#' One margin: mgcv's p-spline smooth on equally spaced knots over an interval, made once a session
#' @param closed Whether the interval is a circle: its end is its beginning.
#' @noRd
spline_margin <- function(k, lower, upper, closed = FALSE) {
  key <- paste("margin", k, lower, upper, closed)
  kept_once(key, {
    margin <- new_margin(k, lower, upper, closed)
    margin$key <- key
    margin
  })
}

#' A value that depends on its key alone, made once a session
#' @noRd
kept_once <- function(key, value) {
  if (is.null(kept_values[[key]])) kept_values[[key]] <- value
  kept_values[[key]]
}

kept_values <- new.env(parent = emptyenv())

new_margin <- function(k, lower, upper, closed) {
  term <- eval(substitute(mgcv::s(x, bs = basis, k = k, m = c(2, 2)),
                          list(x = quote(x), k = k, basis = if (closed) "cp" else "ps")))
  mgcv::smoothCon(term, data.frame(x = seq(lower, upper, length.out = 2 * k)),
                  knots = list(x = c(lower, upper)))[[1]]
}

#' B-splines of a margin, or their derivatives, at places: n x k
#' @noRd
margin_design <- function(margin, x, derivative = 0) {
  order <- margin$m[1] + 2
  if (inherits(margin, "cpspline.smooth")) {
    return(mgcv::cSplineDes(x - floor(x), margin$knots, order, derivative))
  }
  range <- margin$knots[c(order, length(margin$knots) - order + 1)]
  cpp_spline_design(margin$knots, pmin(pmax(x, range[1]), range[2]), 0, derivative)
}

tensor_penalty <- function(margins, anisotropy) {
  key <- paste("penalty", margins$along$key, margins$across$key, format(anisotropy, digits = 17))
  kept_once(key, {
    along <- margins$along$S[[1]]
    across <- margins$across$S[[1]]
    kronecker(along, diag(ncol(across))) + anisotropy * kronecker(diag(ncol(along)), across)
  })
}

#' The smoothing parameter with given equivalent degrees of freedom
#'
#' With A the moment matrix and c making A and c S of one size, the eigenvalues m of
#' (A + c S)^-1 A give the degrees of freedom sum(m / (m + (1 - m) penalty / c)) for any penalty.
#' @noRd
penalty_for_df <- function(moments, penalty, df) {
  scale <- sum(diag(moments)) / sum(diag(penalty))
  factor <- surface_factor(moments + scale * penalty)
  if (failed(factor)) return(factor)
  half <- backsolve(factor, moments, transpose = TRUE)
  inner <- backsolve(factor, t(half), transpose = TRUE)
  m <- pmin(pmax(eigen((inner + t(inner)) / 2, symmetric = TRUE, only.values = TRUE)$values, 0), 1)
  reached <- function(t) sum(m / (m + (1 - m) * exp(t)))
  found <- tryCatch(stats::uniroot(function(t) reached(t) - df, c(-25, 25), tol = 1e-10),
                    error = function(e) NULL)
  t <- if (is.null(found)) (if (reached(-25) < df) -25 else 25) else found$root
  list(value = scale * exp(t), df = reached(t), converged = !is.null(found))
}

#' @rdname curvature_surface
#' @param object A `curvature_surface`.
#' @param s,d Arc lengths and distances, in the unit of the mesh.
#' @param derivative Order of the derivative by `d`: 0, 1 or 2.
#' @param ... Not used.
#' @export
predict.curvature_surface <- function(object, s, d, derivative = 0, ...) {
  check_method_dots(..., known = c("s", "d", "derivative"))
  s <- check_numbers(s, "s")
  d <- check_numbers(d, "d")
  derivative <- check_count(derivative, "derivative", lower = 0, upper = 3)
  along <- margin_design(
    object$margins$along, rep_len(s, max(length(s), length(d))) / object$length
  )
  across <- margin_design(object$margins$across, rep_len(d, nrow(along)) / object$width, derivative)
  rowSums(across * tcrossprod(along, object$coefficients)) / object$width^derivative
}

#' @export
print.curvature_surface <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<curvature_surface> %.4g x %.4g (s, d): %d vertices, %.1f df%s\n", x$length,
                2 * x$width, length(x$rows), x$df, if (x$converged) "" else ", df not reached"))
    invisible(x)
  })
}
