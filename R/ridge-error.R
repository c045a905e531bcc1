# Standard error of the ridge line by the delta method, from the heights of the mesh's vertices on.

#' Standard error of a ridge line
#'
#' The offset depends on the smooth strength, that on the strength at the vertices of the window,
#' that on the local fits, and those on the heights of the vertices, which neighbouring fits share.
#' The chain of derivatives is followed through all of them; the heights' errors are independent
#' with the residual standard deviation of each local fit. The result is inflated by
#' `settings$inflation`, and the change of the line when lambda is divided by ten stands for its
#' bias. Near an end, which is fixed, the offset is at most as large as the way from there, and so
#' is its error.
#'
#' @param scan The mesh, as of [walkable()].
#' @param coordinates,surface,line The stages of the fit.
#' @param strength As of [window_strength()].
#' @param scale,radius,type,settings As in [ridge_line()] and [ridge_curve()].
#' @return Numeric, one standard error for each of `line$s`, in the unit of the mesh.
#' @noRd
ridge_error <- function(scan, coordinates, surface, line, strength, scale, radius, type,
                        settings) {
  problem <- ridge_problem(surface, scale, radius, settings)
  alpha <- line$alpha[-c(1, length(line$alpha))]
  live <- which(strength$value[surface$rows] > 0 & strength$value[surface$rows] < strength$cap)
  slope <- strength_jacobian(problem, surface, alpha, live)
  rows <- surface$rows[live]
  vb <- scan$vb
  sigma <- rep(stats::median(strength$sigma, na.rm = TRUE), ncol(vb))
  known <- !is.na(strength$sigma)
  sigma[coordinates$vertex[known]] <- strength$sigma[known]
  turn <- if (type == "ridge") -1 else 1
  variance <- cpp_curvature_variance(
    vb, scan$it, coordinates$vertex[rows],
    t(strength$direction[rows, , drop = FALSE]), turn * slope, sigma,
    kernel_settings(radius, settings$order)
  )
  loose <- highest_line(surface, scale, radius, loosen(settings))
  bias <- line$alpha - loose$alpha
  error <- c(0, sqrt(settings$inflation^2 * variance + bias[-c(1, length(bias))]^2), 0)
  pmin(error, line$s - line$s[1], line$s[length(line$s)] - line$s)
}

#' Settings with a tenth of the roughness penalty
#' @noRd
loosen <- function(settings, by = 10) {
  settings$lambda <- settings$lambda / by
  settings
}

#' Derivative of the line's offsets by the strength at the vertices of the fit
#'
#' J = (-H)^-1 (dg / d beta) (X'X + S)^-1 X', interior grid points x vertices.
#' @param rows Which vertices of the fit.
#' @noRd
strength_jacobian <- function(problem, surface, alpha, rows) {
  interior <- seq_along(alpha) + 1
  along <- margin_design(surface$margins$along, problem$u[interior])
  across <- margin_design(problem$across, alpha / problem$width, 1) / problem$width
  by_beta <- mgcv::tensor.prod.model.matrix(list(along, across)) * problem$weight
  factor <- ascent_factor(problem, alpha)
  by_beta <- backsolve(factor, backsolve(factor, by_beta, transpose = TRUE))
  smooth <- backsolve(surface$factor, backsolve(surface$factor, t(by_beta), transpose = TRUE))
  design <- lapply(surface$design, function(margin) margin[rows, , drop = FALSE])
  tcrossprod(t(smooth), mgcv::tensor.prod.model.matrix(design))
}
