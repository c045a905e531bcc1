# Section 5.2 of the paper: surfaces whose ridge is known, and how near the estimate comes to it.

#' Simulate a surface with a known ridge
#'
#' The surface \eqn{z = -b (x - a y^3)^2} on \eqn{[-1, 1]^2}: a ridge along \eqn{x = a y^3}, straight for
#' `a = 0`, sharper for larger `b` (curvature `-2 b` across it). Vertices lie on a square grid, each square is cut
#' along one of its diagonals at random, and independent (or smooth) normal noise is added to the heights.
#'
#' The ridge is the crest in height. The locus of greatest curvature, which estimates aim
#' at, is the same line for `a = 0` and lies beside it otherwise, the more so the smaller `b` is.
#'
#' @param a Bend of the ridge, in 1 / unit^2.
#' @param b Sharpness of the ridge, in 1 / unit.
#' @param spacing Side of the grid's squares; the side of the surface is 2.
#' @param noise Standard deviation of the noise in the heights, in the unit of the mesh.
#' @param seed `NULL` to go on in the user's random stream; or a whole number, and the stream is left as it was.
#' @param jitter Vertices move by up to this share of the spacing along x and y; 0: a regular grid, as in the paper.
#' @param correlation Standard deviation, in grid steps, of the Gaussian kernel that white noise is
#'   smoothed with before it is brought back to `noise`; 0: independent noise.
#' @param landmark_error Distance in (x, y) by which each landmark is moved off the ridge, in a random direction (held
#'   to the square).
#' @param end The landmarks lie on the ridge at `y = -end` and `end`, inside the mesh's border
#'   (an end exactly on the border has half a neighbourhood).
#' @return A [specimen()] with landmarks `from` and `to`, whose attribute `truth` is the ridge
#'   between `y = -end` and `end`: matrix 401 x 3, x, y, z in order along it.
#' @section Errors: of class `crestline_error`, for an argument out of its range.
#' @references Vittert, Bowman and Katina (2019), "the paper" (see [crestline-package]), section 5.2.
#' @seealso [ridge_study()]
#' @examples
#' surface <- simulate_ridge(a = 0.25, b = 1, noise = 0.01, seed = 1)
#' curve <- ridge_curve(surface, "from", "to", "ridge", radius = 0.25, width = 0.4, n = 21)
#' truth <- attr(surface, "truth")
#' plot(truth[, 1:2], type = "l", asp = 1)
#' points(curve$points[c("x", "y")])
#' @export
simulate_ridge <- function(a, b, spacing = 0.05, noise = 0, seed = NULL, jitter = 0, correlation = 0,
                           landmark_error = 0, end = 0.95) {
  check_number(a, "a")
  check_number(b, "b", lower = 0, open = TRUE)
  check_number(spacing, "spacing", lower = 0, upper = 0.5, open = TRUE)
  check_number(noise, "noise", lower = 0)
  check_number(jitter, "jitter", lower = 0, upper = 0.45)
  check_number(correlation, "correlation", lower = 0)
  check_number(landmark_error, "landmark_error", lower = 0)
  check_number(end, "end", lower = 0, upper = 1)
  ridge <- function(y) cbind(x = a * y^3, y = y, z = 0)
  with_seed(seed, {
    mesh <- ridge_mesh(function(x, y) -b * (x - a * y^3)^2, spacing, jitter, noise, correlation)
    marks <- ridge(c(from = -end, to = end))
    marks <- drop_on_mesh(mesh, marks + aside(landmark_error, nrow(marks)))
  })
  id <- sprintf("ridge a = %g, b = %g, noise = %g, seed = %s", a, b, noise, if (is.null(seed)) "none" else seed)
  out <- specimen(mesh, marks, id, outward = "keep")
  attr(out, "truth") <- ridge(seq(-end, end, length.out = 401))
  out
}

#' A square grid over [-1, 1]^2 with heights and noise
#' @noRd
ridge_mesh <- function(height, spacing, jitter, noise, correlation) {
  n <- round(2 / spacing) + 1
  side <- seq(-1, 1, length.out = n)
  at <- as.matrix(expand.grid(x = side, y = side)) + stats::runif(2 * n^2, -jitter, jitter) * spacing
  z <- height(at[, 1], at[, 2]) + noise * grid_noise(n, correlation)
  structure(list(vb = rbind(t(unname(at)), z, 1), it = grid_triangles(n)), class = "mesh3d")
}

#' Triangles of an n x n grid, facing up, each square cut along a diagonal at random: 3 x 2 (n - 1)^2
#' @noRd
grid_triangles <- function(n) {
  corner <- as.vector(outer(seq_len(n - 1), (seq_len(n - 1) - 1) * n, `+`))
  opposite <- corner + n + 1
  other <- stats::runif(length(corner)) < 0.5
  cbind(rbind(corner, corner + 1, ifelse(other, corner + n, opposite)),
        rbind(ifelse(other, corner + 1, corner), opposite, corner + n))
}

#' Standard normal noise on an n x n grid; smoothed by a Gaussian kernel, its variance kept at 1
#' @noRd
grid_noise <- function(n, correlation) {
  white <- matrix(stats::rnorm(n^2), n)
  if (correlation == 0) return(as.vector(white))
  kernel <- stats::dnorm(outer(seq_len(n), seq_len(n), `-`), sd = correlation)
  kernel <- kernel / sqrt(rowSums(kernel^2))
  as.vector(kernel %*% white %*% t(kernel))
}

#' Steps of a given length in (x, y) and random direction: n x 3
#' @noRd
aside <- function(distance, n) {
  angle <- stats::runif(n, 0, 2 * pi)
  distance * cbind(cos(angle), sin(angle), 0)
}

#' Points of the mesh straight above or below places of the square
#' @noRd
drop_on_mesh <- function(mesh, xyz) {
  flat <- mesh
  flat$vb[3, ] <- 0
  below <- pmin(pmax(xyz, -1), 1)
  below[, 3] <- 0
  located <- surface_points(flat, below)
  at <- place_on_faces(mesh, located$face, as.matrix(located[c("w1", "w2", "w3")]))
  matrix(at, nrow(xyz), dimnames = dimnames(xyz))
}

#' Evaluate with the random stream started at a seed, and leave the user's stream as it was
#' @noRd
with_seed <- function(seed, code) {
  if (is.null(seed)) return(code)
  old <- globalenv()$.Random.seed
  on.exit(if (is.null(old)) rm(".Random.seed", envir = globalenv()) else
    assign(".Random.seed", old, envir = globalenv()))
  set.seed(seed)
  code
}

#' Signed distances in (x, y) from a known ridge, positive to the left of its direction
#'
#' Seen along z, since the noise moves points up and down only.
#'
#' @param points Matrix or data frame whose columns x, y are used.
#' @param truth k x 3, in order along the ridge; past its ends it goes straight on.
#' @noRd
ridge_offset <- function(points, truth) {
  flat <- function(p) rbind(t(as.matrix(p[, c("x", "y")])), 0)
  cpp_path_coordinates(flat(points), flat(truth), matrix(c(0, 0, 1), 3, nrow(truth)))$d
}

#' Study of ridge estimates on simulated surfaces
#'
#' For each combination of the surface's bend and sharpness, noise, landmark error
#' and number of passes, estimates the ridge of `n` simulated surfaces and measures how far
#' it lies from the true one.
#'
#' @param settings [ridge_settings()].
#' @param n Number of simulated surfaces for each combination; their seeds are `1, ..., n`.
#' @param a,b,noise,landmark_error Vectors of values, as in [simulate_ridge()].
#' @param passes Vector of numbers of passes, as in [ridge_curve()].
#' @param radius,width As in [ridge_curve()], in the unit of the surface, whose side is 2.
#' @param spacing As in [simulate_ridge()].
#' @param points Number of points at which each curve is compared.
#' @param progress Whether to show a progress bar on long runs.
#' @param ... Further arguments of [simulate_ridge()]: `jitter`, `correlation`, `end`.
#' @return Data frame with a row for each curve: `a`, `b`, `noise`, `landmark_error`, `passes`, `seed`;
#'   `distance`: mean distance between estimate and true ridge seen along z, **in spacings**, mean of that from the
#'   estimate to the truth and that from the truth to the estimate; `se`: median standard error, in spacings;
#'   `determined`, `converged` (logical); `seconds`; `error`: the message
#'   where the estimate failed, and then the others are `NA`.
#' @section Errors: only for arguments out of their range; a failed estimate is a row with `error`.
#' @references Vittert, Bowman and Katina (2019), "the paper" (see [crestline-package]), section 5.2.
#' @examples
#' study <- ridge_study(n = 2, a = 0.25, b = 1, noise = c(0, 0.01))
#' aggregate(distance ~ a + b + noise, study, mean)
#' @export
ridge_study <- function(settings = ridge_settings(), n = 20, a = c(0, 0.25, 0.5), b = c(0.25, 0.5, 1, 2),
                        noise = c(0, 0.01, 0.05), landmark_error = 0, passes = 1, radius = 0.25,
                        width = 0.4, spacing = 0.05, points = 101, progress = interactive(), ...) {
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  check_count(n, "n")
  cells <- expand.grid(seed = seq_len(n), passes = passes, landmark_error = landmark_error,
                       noise = noise, b = b, a = a)[6:1]
  rows <- vector("list", nrow(cells))
  if (progress) cli::cli_progress_bar("Estimating ridges", total = nrow(cells))
  for (i in seq_len(nrow(cells))) {
    cell <- cells[i, ]
    surface <- simulate_ridge(cell$a, cell$b, spacing, cell$noise, cell$seed,
                              landmark_error = cell$landmark_error, ...)
    rows[[i]] <- study_row(surface, settings, cell$passes, radius, width, spacing, points)
    if (progress) cli::cli_progress_update()
  }
  cbind(cells, do.call(rbind, rows))
}

#' One estimate of the study
#' @noRd
study_row <- function(surface, settings, passes, radius, width, spacing, points) {
  start <- proc.time()[["elapsed"]]
  curve <- tryCatch(
    suppressWarnings(ridge_curve(surface, "from", "to", "ridge", radius, width, points,
                                 settings = settings, passes = passes), classes = "crestline_warning"),
    error = conditionMessage
  )
  seconds <- proc.time()[["elapsed"]] - start
  if (is.character(curve)) {
    return(data.frame(distance = NA_real_, se = NA_real_, determined = NA, converged = NA,
                      seconds = seconds, error = curve))
  }
  data.frame(distance = ridge_distance(curve, attr(surface, "truth")) / spacing, se = curve$se / spacing,
             determined = curve$determined, converged = curve$converged, seconds = seconds, error = NA_character_)
}

#' Mean distance between a curve and the true ridge, both ways, seen along z
#' @noRd
ridge_distance <- function(curve, truth) {
  there <- mean(abs(ridge_offset(curve$points, truth)))
  back <- mean(abs(ridge_offset(truth, as.matrix(curve$points[c("x", "y", "z")]))))
  (there + back) / 2
}
