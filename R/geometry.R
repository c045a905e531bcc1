# Vectors, rows of vectors, rotations.

cross_product <- function(a, b) {
  c(a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1])
}

cross_rows <- function(a, b) {
  cbind(a[, 2] * b[, 3] - a[, 3] * b[, 2], a[, 3] * b[, 1] - a[, 1] * b[, 3],
        a[, 1] * b[, 2] - a[, 2] * b[, 1])
}

unit_vector <- function(x) x / sqrt(sum(x^2))

row_products <- function(a, b) a[, 1] * b[, 1] + a[, 2] * b[, 2] + a[, 3] * b[, 3]

row_lengths <- function(a) sqrt(row_products(a, a))

#' Diagonal of the bounding box of points, 3 x n
#' @noRd
box_diagonal <- function(xyz) cpp_box_diagonal(xyz)

#' @param x,y n x 3, centred, no missing points.
#' @return List: `rotation` r, proper, 3 x 3, such that `x %*% r` is nearest to `y`; `d`: singular
#'   values of `x' y`, the last negative where a reflection would come nearer.
#' @noRd
nearest_rotation <- function(x, y) {
  parts <- svd(crossprod(x, y))
  sense <- c(1, 1, sign(det(parts$u) * det(parts$v)))
  list(rotation = parts$u %*% (sense * t(parts$v)), d = sense * parts$d)
}

#' The rotation by the length of a vector about it (Rodrigues)
#' @noRd
rotation_about <- function(turn) {
  angle <- sqrt(sum(turn^2))
  if (angle == 0) return(diag(3))
  axis <- turn / angle
  cross <- matrix(c(0, axis[3], -axis[2], -axis[3], 0, axis[1], axis[2], -axis[1], 0), 3)
  diag(3) + sin(angle) * cross + (1 - cos(angle)) * cross %*% cross
}

mesh_diagonal <- function(mesh) box_diagonal(mesh$vb)

# The columns of a point on a mesh.
mesh_columns <- c("x", "y", "z", "face", "w1", "w2", "w3")
