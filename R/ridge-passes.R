# The passes of a ridge estimate: windows, lines, and how much of a second pass is taken.

#' The passes of a fit
#'
#' A first pass about the reference path gives a line and its standard error. That sets the width of
#' the kernel under which the line is found again, and how much of the principal curvature is mixed
#' in. A second pass is about the first one's curve; of its offsets a share is taken. With
#' `job$passes` so many passes are made, each about the curve of the one before and counted whole.
#'
#' @param path A `mesh_path`; its attribute `trusted`, where it has one, is the range of arc length
#'   in which curvature counts.
#' @return The last window as of [ridge_window()], with `line`, `path` (the curve), `reference` (the
#'   path that the window is about), `share` (of the second pass that was taken), `beside` (as of
#'   [end_offsets()]) and `noise_factor`; `found` is FALSE, with `reason`, where there is no curve.
#'   Or a failure. [finished_fit()] has yet to be called.
#' @noRd
fit_passes <- function(scan, path, job) {
  settings <- job$settings
  window <- ridge_window(scan, path, job)
  if (is.null(window$surface)) return(window)
  window$line <- highest_line(window$surface, window$scale, job$radius, settings)
  if (failed(window$line)) return(window$line)
  edge <- window$line$at_bound
  beside <- end_offsets(scan, window, job)
  job$kernel <- if (settings$kernel > 0) kernel_width(scan, window, job$radius, settings) else 0
  job$mix <- min(1, job$kernel / (settings$mix * job$radius))
  if (job$mix > 0) window <- ridge_window(scan, path, job, job$mix)
  pass <- function(window, edge) {
    window <- window_line(window, job, edge)
    if (failed(window) || is.null(window$line)) return(window)
    window <- with_curve(scan, window)
    window$beside <- beside
    window
  }
  fit <- pass(window, edge)
  next_pass <- function(fit) {
    pass(ridge_window(scan, path_of_pass(fit), job, job$mix), fit$line$at_bound)
  }
  if (!is.null(job$passes)) {
    for (i in seq_len(job$passes)[-1]) if (isTRUE(fit$found)) fit <- next_pass(fit)
    return(fit)
  }
  second <- if (isTRUE(fit$found) && settings$second > 0) next_pass(fit)
  if (!isTRUE(second$found)) return(fit)
  strength <- path_strength(job$source, job$type, job$regions, scan)
  second$share <- second_share(scan, fit, second, strength, job$kernel / job$radius, settings)
  if (second$share > 0) second else fit
}

#' A window with its line under the kernel; as it is where it has no surface
#'
#' @param job With `kernel`, its half width, in the unit of the mesh.
#' @param edge Whether the line of a pass before ran along the edge of its window: neither kernel
#'   nor passes widen the window, and what ran along its edge once is in doubt.
#' @noRd
window_line <- function(window, job, edge) {
  if (is.null(window$surface)) return(window)
  if (is.null(window$line) || job$kernel > 0) {
    window$line <- highest_line(window$surface, window$scale, job$radius, job$settings, job$kernel)
  }
  if (failed(window$line)) return(window$line)
  window$line$at_bound <- edge || window$line$at_bound
  window
}

#' The curve of a pass as the path of the next one
#' @noRd
path_of_pass <- function(fit) {
  path <- fit$path
  before <- fit$reference
  trusted <- attr(before, "trusted")
  if (length(trusted)) {
    attr(path, "trusted") <- trusted / attr(before, "length") * attr(path, "length")
  }
  for (name in c("type", "criterion", "optima", "competing")) {
    attr(path, name) <- attr(before, name)
  }
  path
}

#' A window with its line lifted onto the mesh
#' @noRd
with_curve <- function(scan, window) {
  lifted <- lifted_line(scan, window$coordinates, window$reference, window$line$s,
                        window$line$alpha)
  window$found <- !failed(lifted)
  if (window$found) window$path <- lifted else
    window$reason <- "the ridge line leaves the surface near the reference path"
  window
}

#' Half width of the kernel, in the unit of the mesh
#'
#' The peak is looked for no finer than `settings$kernel` standard errors of the line without a
#' kernel: the median over its inner places, without inflation and bias, and without the noise
#' factor, which on a clean scan takes fine relief for noise. 0 where the error is not known.
#' @param window With its `line` without a kernel.
#' @noRd
kernel_width <- function(scan, window, radius, settings) {
  noise <- moment_noise(scan, window, radius, settings, settings$kernel_vertices, factor = FALSE)
  variance <- linear_variance(line_slope(window, radius, settings), noise$matrix)
  half <- min(settings$kernel_most, settings$kernel * stats::median(sqrt(variance)) / radius)
  if (is.na(half) || half < settings$kernel_least) 0 else half * radius
}

#' Share of a second pass that is taken
#'
#' All of it under a wide kernel. Else 1/2, and more or less where the mean principal strength along
#' the second curve is above or below that along the first. It does not switch: a choice of one or
#' the other falls differently when the surface is scanned again.
#'
#' @param first,second Fits with their curves.
#' @param strength Function of vertices.
#' @param kernel Half width of the kernel, in radii.
#' @param places Number of places along a curve at which its strength is taken.
#' @return Between 0 and 1.
#' @noRd
second_share <- function(scan, first, second, strength, kernel, settings, places = 101) {
  wide <- kernel / settings$second_whole
  if (wide >= 1) return(1)
  worth <- function(path) {
    s <- seq(0, attr(path, "length"), length.out = places)
    at <- place_along(scan, path, s)
    corner <- scan$it[, at$face]
    vertex <- unique(as.vector(corner))
    value <- matrix(strength(vertex)[match(corner, vertex)], 3)
    mean(colSums(rbind(at$w1, at$w2, at$w3) * value))
  }
  gain <- worth(second$path) / worth(first$path) - 1
  if (!is.finite(gain)) gain <- 0
  max(wide, min(1, max(0, settings$second + gain / (2 * settings$second_gain))))
}

#' A fit with standard errors, and with the share of its last pass taken
#' @noRd
finished_fit <- function(scan, fit, radius, settings) {
  if (is.null(fit$line)) return(fit)
  share <- if (fit$share > 0) fit$share else 1
  known <- if (settings$error) {
    list(noise = moment_noise(scan, fit, radius, settings),
         slope = line_slope(fit, radius, settings), bias = line_bias(fit, radius, settings, share))
  }
  if (share != 1) {
    fit$line$alpha <- share * fit$line$alpha
    fit <- with_curve(scan, fit)
  }
  if (is.null(known)) return(fit)
  fit$line$se <- ridge_error(fit$line, known$slope, known$noise, known$bias,
                             goes_round(fit$surface), settings)
  fit$noise_factor <- known$noise$factor
  with_measures(scan, fit, known, settings)
}
