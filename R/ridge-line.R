#' Penalised ridge of a curvature surface
#'
#' Finds the offset alpha(u) from the reference path, with u = s / length, that maximises \deqn{\int
#' \nu(u, \alpha) / \nu_0 \, du - \lambda \int (d^2 (\alpha / r) / du^2)^2 du} with alpha = 0 at
#' both ends. Here nu is the smooth strength, nu0 its mean near the path, and r the radius of the
#' curvature estimates. The criterion has no unit. It is maximised by Newton's method from
#' alpha = 0. The criterion is not concave. If the negative Hessian is not positive definite, the
#' second derivatives of nu are replaced by their absolute values. Steps are bounded, and halved
#' until the criterion rises. The result is the local optimum near the reference path; the global
#' optimum is usually a competing feature.
#'
#' With `kernel` > 0, nu is replaced by its mean across the path under a biweight kernel,
#' \deqn{\nu_h(u, \alpha) = \int \nu(u, d) K_h(d - \alpha) \, dd, \quad K_h(t) = \frac{15}{16 h}
#' (1 - t^2 / h^2)^2,} and 0 outside the window. As h grows, the line moves from the mode of nu to
#' its centroid in the window. The mean is computed exactly, through the B-splines across the path.
#'
#' @param surface A [curvature_surface()].
#' @param scale Mean strength nu0 near the path, in 1 / unit.
#' @param radius Radius of the curvature estimates, in the unit of the mesh.
#' @param settings [ridge_settings()]: `lambda`, `lambda_scale`, `grid`, `bound`, `step`,
#'   `iterations`, `tolerance`.
#' @param kernel Half width h of the kernel, in the unit of the mesh; 0: none. [ridge_curve()]
#'   chooses it from the standard error.
#' @return Object of class `ridge_line`, a list:
#'   * `s` and `alpha`: the line at the points of the grid, in the unit of the mesh;
#'   * `lambda` and `criterion`: of the criterion above, without unit;
#'   * `gradient`: largest absolute gradient in the interior of the bounds;
#'   * `iterations`, `converged`;
#'   * `at_bound`: TRUE if the ridge runs along the edge of the window;
#'   * `kernel`: half width of the kernel, in the unit of the mesh.
#' @template glossary
#' @templateVar where section 3.2
#' @template paper
#' @examples
#' ball <- Rvcg::vcgSphere(4)
#' path <- plane_path(ball, c(1, 0, 0), c(0, 1, 0))
#' window <- path_coordinates(ball, path, width = 0.3)
#' smooth <- curvature_surface(window, 1 - (window$d - 0.1 * sin(2 * window$s))^2)
#' ridge_line(smooth, scale = 1, radius = 0.2)
#' @export
ridge_line <- function(surface, scale, radius, settings = ridge_settings(), kernel = 0) {
  check_given()
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  radius <- check_number(radius, "radius", lower = 0, open = TRUE)
  check_class(surface, "curvature_surface", "surface", "curvature_surface()")
  check_number(scale, "scale", lower = 0, open = TRUE)
  kernel <- check_number(kernel, "kernel", lower = 0)
  in_context(highest_line(surface, scale, radius, settings, kernel), NULL)
}

#' The ridge line without checks, by safeguarded Newton steps from the reference path; or a failure
#' @noRd
highest_line <- function(surface, scale, radius, settings, kernel = 0) {
  problem <- ridge_problem(surface, scale, radius, settings, kernel)
  if (!all(is.finite(problem$roughness), is.finite(problem$lambda), is.finite(problem$weight))) {
    return(no_result(
      sprintf("`radius` %g or `scale` %g is beyond the numbers that can be worked with.", radius,
              scale),
      "Give both in the unit of the surface.", "ridge"
    ))
  }
  alpha <- numeric(length(problem$u) - 2)
  value <- ridge_criterion(problem, alpha)
  small <- settings$tolerance * problem$width
  converged <- FALSE
  round <- 0
  while (!converged && round < settings$iterations) {
    round <- round + 1
    factor <- ascent_factor(problem, ridge_bend(problem, alpha))
    gradient <- ridge_gradient(problem, alpha)
    step <- backsolve(factor, backsolve(factor, gradient, transpose = TRUE))
    step <- step * min(1, settings$step * problem$width / max(abs(step)), na.rm = TRUE)
    risen <- rise(problem, alpha, value, step, small)
    converged <- max(abs(risen$alpha - alpha)) <= small
    alpha <- risen$alpha
    value <- risen$value
  }
  free <- abs(alpha) < problem$limit
  structure(
    list(s = problem$u * surface$length, alpha = with_ends(alpha, problem$closed),
         lambda = problem$lambda,
         criterion = value, gradient = max(0, abs(ridge_gradient(problem, alpha)[free])),
         iterations = round, converged = converged, at_bound = any(!free), kernel = kernel),
    class = "ridge_line"
  )
}

#' The criterion with everything that does not change with alpha worked out
#'
#' `alpha` in these functions is the interior part, in the unit of the mesh.
#' @noRd
ridge_problem <- function(surface, scale, radius, settings, kernel = 0) {
  grid <- settings$grid
  round <- goes_round(surface)
  # The line in equal parts; of one that goes round all places but the seam are inner ones
  inner <- grid - 2
  if (round) {
    parts <- inner
    u <- c(0, (seq_len(inner) - 0.5) / parts, 1)
    ahead <- diag(inner)[, c(seq_len(inner)[-1], 1)]
    second <- (ahead + t(ahead) - 2 * diag(inner)) * parts^2 / radius
  } else {
    parts <- grid - 1
    u <- seq(0, 1, length.out = grid)
    second <- kept_once(paste("differences", grid), {
      diff(diag(grid), differences = 2)[, -c(1, grid)]
    }) * parts^2 / radius
  }
  profile <- tcrossprod(margin_design(surface$margins$along, u), surface$coefficients)
  at_ends <- margin_design(surface$margins$across, c(0, 0)) * profile[c(1, grid), ]
  lambda <- switch(settings$lambda_scale, feature = settings$lambda / (scale * radius),
                   grid = settings$lambda * radius^2 / (scale * (grid - 1)^3))
  list(u = u, lambda = lambda, roughness = crossprod(second) / parts,
       across = surface$margins$across, width = surface$width,
       limit = settings$bound * surface$width, kernel = kernel / surface$width,
       interior = profile[-c(1, grid), ], weight = rep(1 / parts, inner) / scale,
       ends = if (round) 0 else sum(at_ends) / (2 * parts * scale), closed = round)
}

#' Whether a surface has no ends along
#' @noRd
goes_round <- function(surface) inherits(surface$margins$along, "cpspline.smooth")

#' Values at the inner places of a line with those at its ends: 0, or at a seam the mean of both
#' sides
#' @noRd
with_ends <- function(inner, closed) {
  end <- if (closed) mean(inner[c(1, length(inner))]) else 0
  c(end, inner, end)
}

#' Smooth strength, or a derivative by the offset, at the interior grid points
#' @noRd
profile_at <- function(problem, alpha, derivative) {
  rowSums(across_design(problem, alpha, derivative) * problem$interior)
}

#' B-splines across at offsets, their means under the kernel, or a derivative by the offset: n x k
#' @noRd
across_design <- function(problem, alpha, derivative) {
  basis <- cpp_spline_design(problem$across$knots, alpha / problem$width, problem$kernel,
                             derivative)
  basis / problem$width^derivative
}

ridge_criterion <- function(problem, alpha) {
  sum(problem$weight * profile_at(problem, alpha, 0)) + problem$ends -
    problem$lambda * sum(alpha * (problem$roughness %*% alpha))
}

ridge_gradient <- function(problem, alpha) {
  problem$weight * profile_at(problem, alpha, 1) -
    2 * problem$lambda * as.vector(problem$roughness %*% alpha)
}

#' Second derivatives of the criterion by the single offsets, roughness aside
#' @noRd
ridge_bend <- function(problem, alpha) problem$weight * profile_at(problem, alpha, 2)

#' Hessian, or with `convex` its negative-definite stand-in
#' @param bend As of [ridge_bend()].
#' @noRd
ridge_hessian <- function(problem, bend, convex = FALSE) {
  diag(if (convex) -abs(bend) else bend) - 2 * problem$lambda * problem$roughness
}

#' Cholesky factor of the negative Hessian, of its stand-in where that is not positive definite
#' @noRd
ascent_factor <- function(problem, bend) {
  exact <- tryCatch(chol(-ridge_hessian(problem, bend)), error = function(e) NULL)
  if (!is.null(exact)) return(exact)
  stand_in <- -ridge_hessian(problem, bend, convex = TRUE)
  chol(stand_in + diag(1e-12 * max(diag(stand_in)), nrow(stand_in)))
}

#' Longest of the halved steps with which the criterion rises, within the bounds
#'
#' The rise of the last steps is lost in rounding. They are taken all the same, so that the line is
#' as exact as its equations and not as the criterion's value.
#' @param rounding Share of the value by which it may fall.
#' @noRd
rise <- function(problem, alpha, value, step, small, rounding = 1e-13) {
  while (max(abs(step)) > small) {
    trial <- pmin(pmax(alpha + step, -problem$limit), problem$limit)
    next_value <- ridge_criterion(problem, trial)
    if (next_value > value - rounding * abs(value)) return(list(alpha = trial, value = next_value))
    step <- step / 2
  }
  list(alpha = alpha, value = value)
}

#' @export
print.ridge_line <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<ridge_line> %d places: offset %.3g to %.3g; %s after %d steps%s\n", length(x$s),
                min(x$alpha),
                max(x$alpha), if (x$converged) "converged" else "NOT converged", x$iterations,
                if (x$at_bound) ", along the edge of the window" else ""))
    invisible(x)
  })
}
