# Values of measurements: distances, angles, depths, lengths, areas and volumes of places.

#' The measurements of configurations of places
#'
#' @param xyz k x 3 x n.
#' @return Matrix: measurements x n, NA where a place is missing.
#' @noRd
measure_places <- function(plan, xyz) {
  value <- matrix(NA_real_, length(plan), dim(xyz)[3])
  for (i in seq_along(plan)) {
    step <- plan[[i]]
    value[i, ] <- switch(
      step$kind, distance = row_lengths(place_at(xyz, step$at[1]) - place_at(xyz, step$at[2])),
      angle = angle_at(xyz, step$at), ratio = value[step$of[1], ] / value[step$of[2], ],
      depth = depth_at(xyz, step$at, step$base), length = length_along(xyz, step$lines),
      area = area_of(xyz, step$triangles), volume = volume_over(xyz, step$triangles, step$base)
    )
  }
  value
}

#' n x 3: one place in all configurations
#' @noRd
place_at <- function(xyz, row) matrix(aperm(xyz[row, , , drop = FALSE], c(3, 2, 1)), dim(xyz)[3])

angle_at <- function(xyz, at) {
  a <- place_at(xyz, at[1]) - place_at(xyz, at[2])
  b <- place_at(xyz, at[3]) - place_at(xyz, at[2])
  180 / pi * atan2(row_lengths(cross_rows(a, b)), row_products(a, b))
}

depth_at <- function(xyz, at, base) {
  along <- place_at(xyz, base[2]) - place_at(xyz, base[1])
  row_lengths(cross_rows(place_at(xyz, at) - place_at(xyz, base[1]), along)) / row_lengths(along)
}

length_along <- function(xyz, lines) {
  each <- lapply(lines, function(rows) {
    step <- xyz[rows[-1], , , drop = FALSE] - xyz[rows[-length(rows)], , , drop = FALSE]
    colSums(matrix(sqrt(step[, 1, ]^2 + step[, 2, ]^2 + step[, 3, ]^2), length(rows) - 1))
  })
  Reduce(`+`, each)
}

#' Doubled area vectors of triangles, (m n) x 3, and the triangles' corners
#' @noRd
triangle_vectors <- function(xyz, triangles) {
  corner <- lapply(1:3, function(i) {
    matrix(aperm(xyz[triangles[i, ], , , drop = FALSE], c(1, 3, 2)), ncol = 3)
  })
  list(corner = corner, cross = cross_rows(corner[[2]] - corner[[1]], corner[[3]] - corner[[1]]))
}

area_of <- function(xyz, triangles) {
  colSums(matrix(row_lengths(triangle_vectors(xyz, triangles)$cross), ncol(triangles))) / 2
}

#' Volume between triangles and a plane: prisms of signed height, positive whichever way the plane
#' looks
#' @noRd
volume_over <- function(xyz, triangles, base) {
  origin <- place_at(xyz, base[1])
  normal <- cross_rows(place_at(xyz, base[2]) - origin, place_at(xyz, base[3]) - origin)
  normal <- normal / row_lengths(normal)
  owner <- rep(seq_len(dim(xyz)[3]), each = ncol(triangles))
  parts <- triangle_vectors(xyz, triangles)
  middle <- (parts$corner[[1]] + parts$corner[[2]] + parts$corner[[3]]) / 3
  own <- normal[owner, , drop = FALSE]
  height <- row_products(middle - origin[owner, , drop = FALSE], own)
  prism <- height * row_products(parts$cross, own)
  abs(colSums(matrix(prism, ncol(triangles))) / 2)
}
