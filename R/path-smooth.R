# Paths made smooth: a least-cost path zigzags from node to node, and what is fitted about it would
# keep its waves.

#' Places every `step` along a polyline, smoothed
#'
#' A penalty on second differences. A wave of length `wave` keeps half its height.
#' @param xyz n x 3; of a closed line the first is not repeated.
#' @param closed Whether the last is joined to the first; else both ends stay.
#' @param few Least number of places.
#' @noRd
smooth_places <- function(xyz, step, wave, closed, few = 9) {
  if (closed) xyz <- xyz[c(seq_len(nrow(xyz)), 1), ]
  s <- c(0, cumsum(row_lengths(diff(xyz))))
  n <- max(few, ceiling(s[length(s)] / step)) + 1
  at <- seq(0, s[length(s)], length.out = n)
  x <- apply(xyz, 2, function(v) stats::approx(s, v, at, ties = "ordered")$y)
  kappa <- (wave / (2 * pi * at[2]))^4
  if (closed) {
    turned <- 2 - 2 * cos(2 * pi * (seq_len(n - 1) - 1) / (n - 1))
    return(Re(stats::mvfft(stats::mvfft(x[-n, ]) / (1 + kappa * turned^2), inverse = TRUE)) /
             (n - 1))
  }
  penalty <- diag(n) + kappa * crossprod(diff(diag(n), differences = 2))
  inner <- seq_len(n)[-c(1, n)]
  fixed <- penalty[inner, c(1, n)] %*% x[c(1, n), ]
  x[inner, ] <- solve(penalty[inner, inner], x[inner, ] - fixed)
  x
}

#' Positions put on that part of a mesh that is joined to a path within `reach` of it
#'
#' @param rough k x 7 matrix: the path.
#' @return n x 7 matrix.
#' @noRd
placed_beside <- function(scan, xyz, rough, reach) {
  line <- rough[, 1:3, drop = FALSE]
  box <- apply(line, 2, range) + c(-1, 1) * reach
  near <- cpp_vertices_in_box(scan$vb, box[1, ], box[2, ])
  vertex <- t(scan$vb[1:3, near, drop = FALSE])
  member <- logical(ncol(scan$vb))
  member[near[Rvcg::vcgKDtree(line, vertex, k = 1)$distance <= reach]] <- TRUE
  seeds <- as.vector(scan$it[, rough[, 4]])
  member[seeds] <- TRUE
  member <- cpp_joined_to(scan$it, member, seeds)
  inside <- matrix(member[scan$it], 3)
  faces <- which(inside[1, ] & inside[2, ] & inside[3, ])
  used <- which(member)
  part <- list(vb = scan$vb[, used, drop = FALSE],
               it = matrix(match(scan$it[, faces], used), 3))
  placed <- surface_points(part, xyz)
  placed$face <- faces[placed$face]
  columns_of(placed)
}

#' A smooth path through the triangles near a rough one between the same ends
#'
#' @param rough k x 7 matrix.
#' @param search As of [path_settings()].
#' @return A `mesh_path`; the rough one, with the attribute `smoothed` FALSE, where the smooth one
#'   cannot be walked.
#' @noRd
smooth_path <- function(scan, rough, radius, search) {
  n <- nrow(rough)
  x <- smooth_places(rough[, 1:3], search$smoothing_step * radius, search$smoothing * radius, FALSE)
  inner <- placed_beside(scan, x[-c(1, nrow(x)), ], rough, radius)
  track <- path_through(rbind(rough[1, ], inner, rough[n, ]), scan)
  window <- near_path(scan, track, radius / 2, radius / 2)
  walked <- walked_line(scan, window, track, c(0, attr(track, "length")), c(0, 0))
  if (failed(walked)) path_through(rough, scan, smoothed = FALSE) else walked
}

#' A smooth loop near a rough one
#'
#' Of the wavelengths `waves` the first counts that moves no place by more than `search$moved`
#' radii.
#' @param rough k x 7 matrix, the first place not repeated.
#' @return A closed `mesh_path`. Where it cannot be walked through the triangles it joins the smooth
#'   places straight, with the attribute `smoothed` FALSE.
#' @noRd
smooth_loop <- function(scan, rough, radius, search,
                        waves = search$smoothing / c(1, 2, 4, 8)) {
  for (wave in waves) {
    x <- smooth_places(rough[, 1:3], search$smoothing_step * radius, wave * radius, TRUE)
    line <- rbind(x, (x + x[c(2:nrow(x), 1), ]) / 2)
    moved <- max(Rvcg::vcgKDtree(line, rough[, 1:3], k = 1)$distance)
    if (moved <= search$moved * radius) break
  }
  track <- closed_path(placed_beside(scan, x, rough, radius), scan, smoothed = FALSE)
  window <- near_path(scan, track, radius / 2, radius / 2)
  walked <- walked_loop(scan, window, c(0, attr(track, "length")), c(0, 0))
  if (failed(walked)) track else walked
}
