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

row_lengths <- function(a) sqrt(a[, 1] * a[, 1] + a[, 2] * a[, 2] + a[, 3] * a[, 3])

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

# Main direction of rows of vectors, up to sign: of the differences between points and their mirror
# partners the normal of the mirror.
main_direction <- function(x) eigen(crossprod(x), symmetric = TRUE)$vectors[, 1]

#' The place of a polyline that is nearest to each of some points
#'
#' @param xyz k x 3.
#' @param line n x 3, a row a vertex; with one row that is the nearest place.
#' @return List of vectors, one value a point: `distance`, `segment` (its first vertex), `share` (of
#'   the way along the segment).
#' @noRd
nearest_on_polyline <- function(xyz, line) {
  distance <- row_lengths(sweep(xyz, 2, line[1, ]))
  segment <- rep(1L, nrow(xyz))
  share <- numeric(nrow(xyz))
  for (i in seq_len(nrow(line) - 1)) {
    step <- line[i + 1, ] - line[i, ]
    off <- sweep(xyz, 2, line[i, ])
    along <- if (any(step != 0)) pmin(pmax(drop(off %*% step) / sum(step^2), 0), 1) else share * 0
    here <- row_lengths(off - outer(along, step))
    nearer <- which(here < distance)
    distance[nearer] <- here[nearer]
    segment[nearer] <- i
    share[nearer] <- along[nearer]
  }
  list(distance = distance, segment = segment, share = share)
}

mesh_diagonal <- function(mesh) box_diagonal(mesh$vb)

# The columns of a point on a mesh: its triangle and weights, and with the position.
face_columns <- c("face", "w1", "w2", "w3")
mesh_columns <- c("x", "y", "z", face_columns)

# The largest value that is there, NA where none is.
largest <- function(x) if (all(is.na(x))) NA_real_ else max(x, na.rm = TRUE)
