# Standard error of the ridge line by the delta method, from the heights of the mesh's vertices on.

#' Covariance of the moments of a window's strengths under noise in the heights
#'
#' The smooth strength depends on the moments X'nu, those on the strength at the vertices of the
#' window, that on the local fits, and those on the heights of the vertices, which neighbouring fits
#' share. The chain of derivatives is followed through all of them. The heights' errors are those of
#' `settings$noise`; where that is not known, independent with the residual standard deviation of
#' each local fit.
#'
#' @param scan The mesh, as of [walkable()].
#' @param window As of [ridge_window()].
#' @param settings [ridge_settings()].
#' @param most Where more vertices than this depend on the heights, one a cell of (s, d) stands for
#'   the others: curvatures of neighbours, whose fits share most vertices, are nearly the same.
#' @param factor Whether the noise factor is asked for.
#' @return List: `matrix`, of the moments (square of the order of the smooth surface); `factor`, as
#'   of [noise_factor()], 1 where the noise is known, NULL where not all vertices were used;
#'   `doubt`, as of [noise_doubt()].
#' @noRd
moment_noise <- function(scan, window, radius, settings, most = Inf, factor = TRUE) {
  surface <- window$surface
  strength <- window$strengths
  live <- which(surface$strength > 0 & surface$strength < strength$cap)
  rows <- surface$rows[live]
  known <- settings$noise
  if (anyNA(known)) {
    fitted <- which(!is.na(strength$sigma))
    sigma <- strength$sigma[fitted]
    other <- stats::median(sigma)
    smooth <- c(0, 0)
  } else {
    fitted <- integer()
    sigma <- numeric()
    other <- known[[1]]
    smooth <- unname(known[2:3])
  }
  margins <- lapply(surface$design, function(design) design[live, , drop = FALSE])
  target <- seq_along(rows)
  if (length(live) > most) {
    near <- structure(window$coordinates[rows, ], length = surface$length, width = surface$width)
    thinned <- thinned_rows(near, most)
    target <- thinned$cell
    rows <- rows[thinned$rows]
  }
  covariance <- function(other, smooth) cpp_curvature_covariance(
    mesh_graph(scan$passed), window$coordinates$vertex[rows],
    t(strength$direction[rows, , drop = FALSE]), margins, target,
    window$coordinates$vertex[fitted], sigma, other, c(smooth, attr(known, "direction")),
    kernel_settings(radius, settings$order)
  )
  found <- covariance(other, smooth)
  if (!factor || length(rows) < length(live)) return(list(matrix = found$matrix))
  if (anyNA(known)) {
    return(list(matrix = found$matrix, factor = noise_factor(surface, live, margins, found)))
  }
  list(matrix = found$matrix, factor = 1, doubt = noise_doubt(known, found$matrix, covariance))
}

#' How the covariance of the moments changes with what was measured of a noise
#'
#' @param known Noise as of [noise_setting()].
#' @param whole Covariance of the moments under it.
#' @param covariance Function of the independent standard deviation, and of the smooth one with its
#'   range.
#' @param step Step of the derivative by log range.
#' @return List: `slopes`, the derivatives of the covariance by independent^2, smooth^2 and
#'   log(range); `spread`, 3 x 3, the covariance of these. NULL where the noise is not measured but
#'   known.
#' @noRd
noise_doubt <- function(known, whole, covariance, step = 0.05) {
  spread <- attr(known, "spread")
  if (is.null(spread)) return(NULL)
  known <- unname(known[1:3])
  by_single <- covariance(1, c(0, 0))$matrix
  slopes <- list(by_single, 0 * whole, 0 * whole)
  if (known[2] > 0) {
    by_smooth <- (whole - known[1]^2 * by_single) / known[2]^2
    wider <- covariance(known[1], c(known[2], known[3] * exp(step)))$matrix
    slopes <- list(by_single, by_smooth, (wider - whole) / step)
  }
  list(slopes = slopes, spread = spread)
}

#' Variances of linear functions of the moments under a noise, with its factor
#'
#' Where the noise was measured, a variance v is an estimate itself. Its own variance w follows from
#' that of the measured noise by the delta method, and it counts as one of f = 2 v^2 / w degrees of
#' freedom (Satterthwaite 1946). It is widened, so that two standard errors hold of Student's
#' distribution with these what they hold of the normal one.
#'
#' @param rows A function a row.
#' @param noise As of [moment_noise()].
#' @param fewest Least number of degrees of freedom.
#' @noRd
noise_variance <- function(rows, noise, fewest = 3) {
  variance <- noise$factor * linear_variance(rows, noise$matrix)
  if (is.null(noise$doubt)) return(variance)
  slope <- vapply(noise$doubt$slopes, function(by) rowSums((rows %*% by) * rows), variance)
  df <- 2 * variance^2 / linear_variance(matrix(slope, length(variance)), noise$doubt$spread)
  wider <- stats::qt(stats::pnorm(2), pmax(df, fewest)) / 2
  variance * ifelse(variance > 0, wider, 1)^2
}

#' How much more the strengths scatter about their smooth surface than under independent noise
#'
#' With H = X (X'X + S)^-1 X' the smoother and G the covariance of the strengths under independent
#' noise, the residuals' expected sum of squares over the live vertices is the trace of
#' (I - H) G (I - H)'. Smooth noise leaves small residuals in each local fit, so that its standard
#' deviation comes out too small, but the strengths scatter, and the ratio shows it. It also shows
#' fine relief, and lack of fit of the smooth surface to a sharp ridge: one mesh cannot tell these
#' apart.
#'
#' @param live Rows of the surface's data whose strength depends on the heights.
#' @param margins Designs there.
#' @param covariance As of cpp_curvature_covariance().
#' @return Sum of squares of the residuals over its expectation, at least 1; NA where that is 0, so
#'   that the noise is not known.
#' @noRd
noise_factor <- function(surface, live, margins, covariance) {
  fitted <- rowSums(margins$across * tcrossprod(margins$along, surface$coefficients))
  residual <- surface$strength[live] - fitted
  inverse <- chol2inv(surface$factor)
  moments <- cpp_tensor_moments(margins$along, margins$across, residual)$matrix
  twice <- inverse %*% moments %*% inverse
  expected <- covariance$trace - 2 * sum(inverse * covariance$matrix) +
    sum(twice * covariance$matrix)
  if (isTRUE(expected > 0)) max(1, sum(residual^2) / expected) else NA_real_
}

#' Standard error of a ridge line
#'
#' The variance of the delta method is multiplied by the noise factor and by the square of
#' `settings$inflation`. Near an end, which is fixed, the offset is at most as large as the way from
#' there, and so is its error.
#'
#' @param slope As of [line_slope()].
#' @param noise As of [moment_noise()].
#' @param bias As of [line_bias()].
#' @param closed Whether the line goes round.
#' @return Numeric, one standard error for each of `line$s`, in the unit of the mesh.
#' @noRd
ridge_error <- function(line, slope, noise, bias, closed, settings) {
  variance <- with_ends(noise_variance(slope, noise), closed)
  error <- sqrt(settings$inflation^2 * variance + bias^2)
  if (closed) return(error)
  pmin(error, line$s - line$s[1], line$s[length(line$s)] - line$s)
}

#' The change of a line when lambda is divided by ten, which stands for its bias
#'
#' @param share Share of the offsets that is taken.
#' @noRd
line_bias <- function(window, radius, settings, share = 1) {
  loose <- highest_line(window$surface, window$scale, radius, loosen(settings), window$line$kernel)
  share * window$line$alpha - loose$alpha
}

#' Settings with a tenth of the roughness penalty
#' @noRd
loosen <- function(settings, by = 10) {
  settings$lambda <- settings$lambda / by
  settings
}

#' Variances of linear functions, a row each, of what has a covariance
#' @noRd
linear_variance <- function(rows, covariance) pmax(rowSums((rows %*% covariance) * rows), 0)

#' Derivative of a line's inner offsets by the moments of the strengths
#'
#' @param window As of [ridge_window()], with `line`.
#' @noRd
line_slope <- function(window, radius, settings) {
  line <- window$line
  problem <- ridge_problem(window$surface, window$scale, radius, settings, line$kernel)
  offset_slope(problem, window$surface, line$alpha[-c(1, length(line$alpha))])
}

#' Derivative of the line's offsets by the moments X'nu of the strengths
#'
#' (-H)^-1 (dg / d beta) (X'X + S)^-1, interior grid points x coefficients.
#' @noRd
offset_slope <- function(problem, surface, alpha) {
  along <- margin_design(surface$margins$along, problem$u[seq_along(alpha) + 1])
  across <- across_design(problem, alpha, 1)
  by_beta <- mgcv::tensor.prod.model.matrix(list(along, across)) * problem$weight
  factor <- ascent_factor(problem, ridge_bend(problem, alpha))
  by_beta <- backsolve(factor, backsolve(factor, by_beta, transpose = TRUE))
  t(backsolve(surface$factor, backsolve(surface$factor, t(by_beta), transpose = TRUE)))
}
