# Faces laid on the norm's reference alone, and what is taken from them; shapes laid on each other.

#' A face laid on a reference by least squares, with scale
#'
#' @param x k x 3, NA where missing.
#' @param reference k x 3.
#' @return List: `laid` (k x 3), `scale` (its factor), `turn` (3 x 3), `size` (centroid size; of
#'   missing points made up by the reference's).
#' @noRd
lay_face <- function(x, reference) {
  known <- !is.na(x[, 1])
  own <- x[known, , drop = FALSE]
  goal <- reference[known, , drop = FALSE]
  from <- colMeans(own)
  to <- colMeans(goal)
  centred <- sweep(own, 2, from)
  turned <- nearest_rotation(centred, sweep(goal, 2, to))
  squares <- sum(centred^2)
  scale <- sum(turned$d) / squares
  laid <- sweep(scale * sweep(x, 2, from) %*% turned$rotation, 2, to, `+`)
  whole <- sum(sweep(reference, 2, colMeans(reference))^2) / sum(sweep(goal, 2, to)^2)
  list(laid = laid, scale = scale, turn = turned$rotation, size = sqrt(squares * whole))
}

#' Half the difference between a laid face and its own mirror image
#'
#' @param partner Row that each point is mirrored to.
#' @return k x 3.
#' @noRd
asymmetric_part <- function(x, partner) {
  mirrored <- across_plane(x[partner, , drop = FALSE])
  known <- !is.na(x[, 1]) & !is.na(mirrored[, 1])
  a <- x[known, , drop = FALSE]
  b <- mirrored[known, , drop = FALSE]
  turn <- nearest_rotation(sweep(b, 2, colMeans(b)), sweep(a, 2, colMeans(a)))$rotation
  (x - sweep(sweep(mirrored, 2, colMeans(b)) %*% turn, 2, colMeans(a), `+`)) / 2
}

#' The reference of a sample: its Procrustes mean at its mean size, its points without those that
#' every specimen lacks
#'
#' @return List: `xyz` (k x 3), `coords` (k x 3 x n, complete), `missing` (names of points left
#'   out), `triangles` (3 x m, rows), `estimated` (data frame of [align()]).
#' @noRd
norm_reference <- function(sample) {
  settings <- list(scale = TRUE, weights = NULL, missing = "estimate", tangent = FALSE,
                   tolerance = 1e-12, rounds = 200)
  aligned <- align_configurations(configurations(sample, "surface"), settings)
  size <- exp(mean(log(aligned$size)))
  list(xyz = aligned$mean * size / sqrt(sum(sweep(aligned$mean, 2, colMeans(aligned$mean))^2)),
       coords = aligned$coords * rep(aligned$size, each = length(aligned$mean)),
       estimated = aligned$missing, triangles = aligned$triangles)
}

#' Points turned and moved as little as brings their plane of symmetry to x = 0
#'
#' @param partner Row that each point is mirrored to, NA for none.
#' @noRd
on_mirror_plane <- function(xyz, partner) {
  paired <- which(!is.na(partner) & partner != seq_along(partner))
  if (length(paired) < 4) return(xyz)
  symmetric <- xyz - asymmetric_part(xyz, partner)
  axis <- main_direction(symmetric[paired, ] - symmetric[partner[paired], ])
  axis <- axis * sign(axis[which.max(abs(axis))])
  normal <- cross_product(axis, c(1, 0, 0))
  angle <- acos(min(axis[1], 1))
  turn <- if (angle > 0) rotation_about(unit_vector(normal) * angle) else diag(3)
  xyz <- xyz %*% t(turn)
  # The asymmetric part of a face moves no mean.
  middle <- mean(drop(symmetric[paired, ] %*% turn[1, ]))
  xyz - rep(c(middle, 0, 0), each = nrow(xyz))
}

#' The table of a norm's points
#' @noRd
norm_points <- function(reference, scheme, unit) {
  points <- scheme$points[scheme$points$level == "surface", ]
  name <- paste(points$part, points$point)
  own <- match(rownames(reference$xyz), name)
  at <- which(scheme$points$level == "surface")
  partner <- match(match(mirror_rows(scheme)[at], at)[own], own)
  reference$xyz <- on_mirror_plane(reference$xyz, partner)
  normal <- point_normals(reference$xyz, reference$triangles)
  bare <- which(!is.finite(normal[, 1]))
  there <- which(is.finite(normal[, 1]))
  for (row in bare) {
    apart <- rowSums(sweep(reference$xyz[there, , drop = FALSE], 2, reference$xyz[row, ])^2)
    normal[row, ] <- normal[there[which.min(apart)], ]
  }
  left <- scheme$pairs$left[scheme$pairs$level == "surface"]
  right <- scheme$pairs$right[scheme$pairs$level == "surface"]
  part <- points$part[own]
  row <- seq_along(own)
  side <- part %in% left | (!part %in% right & !is.na(partner) & row < partner)
  data.frame(point = name[own], part = part, index = points$point[own],
             rounded_points(reference$xyz, unit), stats::setNames(
               as.data.frame(rounded_to(normal, 1e-6)), c("nx", "ny", "nz")
             ), partner = partner, side = side & !is.na(partner) & partner != row,
             row.names = NULL)
}

rounded_points <- function(xyz, unit) {
  as.data.frame(matrix(rounded_to(xyz, unit), ncol = 3, dimnames = list(NULL, c("x", "y", "z"))))
}

#' What a norm is made of: all faces of a sample laid on the reference
#'
#' @param plan Of [measurement_plan()], or NULL.
#' @return List: `points` (as of [norm_points()], with `se_norm`), `triangles`, `y` (n x 3k), `off`
#'   (n x 3l: the asymmetric part on the side), `values` (n x m: log size and measurements, less
#'   what errors add to them),
#'   `estimated`.
#' @noRd
norm_data <- function(sample, plan, unit) {
  reference <- norm_reference(sample)
  points <- norm_points(reference, sample$template$scheme, unit)
  xyz <- as.matrix(points[c("x", "y", "z")])
  n <- dim(reference$coords)[3]
  y <- matrix(0, n, 3 * nrow(xyz))
  scale <- size <- numeric(n)
  surface <- which(sample$template$scheme$points$level == "surface")
  paired <- sum(points$side) > 3
  off <- if (paired) matrix(0, n, 3 * sum(points$side))
  for (i in seq_len(n)) {
    laid <- lay_face(reference$coords[, , i], xyz)
    y[i, ] <- laid$laid
    scale[i] <- laid$scale
    own <- sample$shapes[[i]]$points[surface, ]
    size[i] <- unbiased_log_size(laid$size, own$se[match(points$point, paste(own$part, own$point))])
    if (paired) off[i, ] <- asymmetric_part(laid$laid, points$partner)[points$side, ]
  }
  points$se_norm <- sample_errors(sample, points$point, scale, unit / 10)
  measured <- if (length(plan)) unbiased_values(unname(sample$shapes), plan)
  list(points = points, triangles = reference$triangles, y = y, off = off,
       values = cbind(size = size, measured), estimated = reference$estimated)
}

#' Root mean square standard errors of points, at the reference's size; NA where none is known
#' @noRd
sample_errors <- function(sample, names, scale, unit) {
  squares <- 0
  known <- 0
  for (i in seq_along(sample$shapes)) {
    points <- sample$shapes[[i]]$points
    points <- points[points$level == "surface", ]
    se <- points$se[match(names, paste(points$part, points$point))] * scale[i]
    squares <- squares + ifelse(is.na(se), 0, se^2)
    known <- known + !is.na(se)
  }
  rounded_to(ifelse(known > 0, sqrt(squares / pmax(known, 1)), NA_real_), unit)
}

point_columns <- function(shape) as.matrix(shape$points[c("x", "y", "z")])

#' The rigid motion that lays points on others by weighted least squares, a function
#' @noRd
weighted_move <- function(x, y, weight) {
  weight <- weight / sum(weight)
  from <- colSums(x * weight)
  to <- colSums(y * weight)
  turn <- nearest_rotation(sweep(x, 2, from) * weight, sweep(y, 2, to))$rotation
  function(points) sweep(sweep(points, 2, from) %*% turn, 2, to, `+`)
}

#' Normals at all points of a shape
#' @noRd
row_normals <- function(shape) {
  place <- shape$scheme$points$place
  normal <- place_normals(places_of(shape), shape$scheme)
  normal[match(place, unique(place)), , drop = FALSE]
}
