# Section 5.2 of the paper: surfaces whose ridge is known, and how near the estimate comes to it.

#' Simulate a surface with a known ridge
#'
#' Makes the surface \eqn{z = -b (x - a y^3)^2} on \eqn{[-1, 1]^2}. It has a ridge along \eqn{x = a
#' y^3}, which is straight for `a = 0` and sharper for larger `b` (curvature `-2 b` across it).
#' Vertices lie on a square grid; each square is cut along one of its diagonals at random.
#' Independent (or smooth) normal noise is added to the heights.
#'
#' The surfaces follow the paper's section 5.2. Its ridge is x = (y / a)^(1/3), as printed on
#' \eqn{[0, 10]^2}: there the surface is infinitely steep at y = 0, and a = 0 has no value. Here the
#' ridge is x = a y^3 on \eqn{[-1, 1]^2}. On it the paper's distances between vertices (0.05 to 0.1)
#' give 41 and 21 lines.
#'
#' The ridge is the crest in height. Estimates aim at the locus of greatest curvature, where the
#' principal curvature is least along its own direction. The two lines are the same for `a = 0`.
#' Otherwise their distance is larger for smaller `b`. For `a = 0.5` it is 0.2, 0.8 and up to 7
#' spacings of 0.05 at `b` = 2, 1, 0.5. Blunt ridges have no such locus towards their ends (`b =
#' 0.25`; `b = 0.5` with `a = 0.5`).
#'
#' @param a Bend of the ridge, in 1 / unit^2.
#' @param b Sharpness of the ridge, in 1 / unit.
#' @param spacing Side of the grid's squares; the side of the surface is 2.
#' @param noise Standard deviation of the noise in the heights, in the unit of the mesh. The noise
#'   is normal; the paper's is uniform.
#' @template seed
#' @param jitter Vertices move by up to this share of the spacing along x and y; 0: a regular grid,
#'   as in the paper.
#' @param correlation Standard deviation of the Gaussian kernel that smooths the noise, in grid
#'   steps. The smooth noise is scaled to standard deviation `noise`. 0: independent noise.
#' @param landmark_error Distance in (x, y) by which each landmark is moved off the ridge, in a
#'   random direction (within the square), in the unit of the mesh.
#' @param end The landmarks lie on the ridge at `y = -end` and `y = end`, inside the mesh's border.
#'   A landmark on the border would have half a neighbourhood.
#' @return A [specimen()] with landmarks `from` and `to`. Attribute `truth`: the ridge between `y =
#'   -end` and `y = end`, a 401 x 3 matrix of x, y, z in order along it. Attribute
#'   `truth_curvature`: the locus of greatest curvature, in the same form; NA beyond its ends.
#' @section Errors: of class `crestline_error`: an argument is out of its range.
#' @template glossary
#' @template experimental
#' @templateVar where section 5.2
#' @template paper
#' @seealso [ridge_study()]
#' @examples
#' surface <- simulate_ridge(a = 0.25, b = 1, noise = 0.01, seed = 1)
#' curve <- ridge_curve(surface, "from", "to", "ridge", radius = 0.25, width = 0.4, n = 21)
#' truth <- attr(surface, "truth")
#' plot(truth[, 1:2], type = "l", asp = 1)
#' points(curve$points[c("x", "y")])
#' @export
simulate_ridge <- function(a, b, spacing = 0.05, noise = 0, seed = NULL, jitter = 0,
                           correlation = 0,
                           landmark_error = 0, end = 0.95) {
  check_given()
  seed <- check_seed(seed)
  check_number(a, "a")
  check_number(b, "b", lower = 0, open = TRUE)
  check_spacing(spacing)
  check_number(noise, "noise", lower = 0)
  check_number(jitter, "jitter", lower = 0, upper = 0.45)
  check_number(correlation, "correlation", lower = 0)
  check_number(landmark_error, "landmark_error", lower = 0)
  check_number(end, "end", lower = 0, upper = 1)
  out <- simulated_ridge(a, b, spacing, noise, seed, jitter, correlation, landmark_error, end)
  structure(out, truth_curvature = ridge_crest(a, b, end))
}

#' Between 1e-3, four million vertices, and a quarter of the side
#' @noRd
check_spacing <- function(spacing) {
  spacing <- check_number(spacing, "spacing", lower = 1e-3, upper = 0.5)
  if (spacing == 0.5) {
    check_number(spacing, "spacing", lower = 0, upper = 0.5, open = TRUE)
  }
  spacing
}

#' The surface without its locus of greatest curvature, which takes as long as the surface
#' @noRd
simulated_ridge <- function(a, b, spacing, noise, seed, jitter, correlation, landmark_error, end) {
  ridge <- function(y) cbind(x = a * y^3, y = y, z = 0)
  with_seed(seed, {
    mesh <- ridge_mesh(function(x, y) -b * (x - a * y^3)^2, spacing, jitter, noise, correlation)
    marks <- ridge(c(from = -end, to = end))
    # Points of the mesh straight above or below places of the square
    xyz <- marks + aside(landmark_error, nrow(marks))
    flat <- mesh
    flat$vb[3, ] <- 0
    below <- pmin(pmax(xyz, -1), 1)
    below[, 3] <- 0
    located <- surface_points(flat, below)
    at <- place_on_faces(mesh, located$face, as.matrix(located[c("w1", "w2", "w3")]))
    marks <- matrix(at, nrow(xyz), dimnames = dimnames(xyz))
  })
  id <- sprintf("ridge a = %g, b = %g, noise = %g, seed = %s", a, b, noise,
                if (is.null(seed)) "none" else seed)
  structure(specimen(mesh, marks, id, outward = "keep"),
            truth = ridge(seq(-end, end, length.out = 401)))
}

#' A square grid over [-1, 1]^2 with heights and noise
#' @noRd
ridge_mesh <- function(height, spacing, jitter, noise, correlation) {
  n <- round(2 / spacing) + 1
  side <- seq(-1, 1, length.out = n)
  at <- as.matrix(expand.grid(x = side, y = side)) +
    stats::runif(2 * n^2, -jitter, jitter) * spacing
  # Standard normal noise on an n x n grid; smoothed by a Gaussian kernel, its variance kept at 1
  white <- matrix(stats::rnorm(n^2), n)
  rough <- if (correlation == 0) as.vector(white) else {
    kernel <- stats::dnorm(outer(seq_len(n), seq_len(n), `-`), sd = correlation)
    kernel <- kernel / sqrt(rowSums(kernel^2))
    as.vector(kernel %*% white %*% t(kernel))
  }
  z <- height(at[, 1], at[, 2]) + noise * rough
  structure(list(vb = rbind(t(unname(at)), z, 1), it = grid_triangles(n)), class = "mesh3d")
}

#' Triangles of an n x n grid, facing up, each square cut along a diagonal at random: 3 x 2 (n -
#' 1)^2
#' @noRd
grid_triangles <- function(n) {
  corner <- as.vector(outer(seq_len(n - 1), (seq_len(n - 1) - 1) * n, `+`))
  opposite <- corner + n + 1
  other <- stats::runif(length(corner)) < 0.5
  cbind(rbind(corner, corner + 1, ifelse(other, corner + n, opposite)),
        rbind(ifelse(other, corner + 1, corner), opposite, corner + n))
}

#' Steps of a given length in (x, y) and random direction: n x 3
#' @noRd
aside <- function(distance, n) {
  angle <- stats::runif(n, 0, 2 * pi)
  distance * cbind(cos(angle), sin(angle), 0)
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
