# Size of the object on a mesh. Tolerances and sizes of holes are shares of it; units are recognised
# by it.

#' Size of a mesh that neither a stand nor a stray vertex changes
#'
#' The diagonal of the bounding box is that of all that was scanned: one vertex far away, a platform
#' or a stand make every share of it too large. This is the distance from the middle within which
#' half of the surface lies, of the pieces that carry the landmarks, times `diagonal`, but no more
#' than the diagonal of their box. On 43 face scans it is the diagonal of the
#' bounding box to within 10 per cent.
#'
#' @param mesh A checked mesh.
#' @param used Logical, a value a triangle: which count.
#' @param at k x 3: landmarks on the mesh, NA where missing. A stand that is one piece with the
#'   object can be as large as it likes: with at least `fewest` landmarks the size is at most
#'   `around` times the median distance of the landmarks from their middle. On whole faces it is 5
#'   to 7 times that.
#' @param diagonal Diagonals of a face in radii that hold half of its surface: the mean of those
#'   scans.
#' @param cap Greatest area of a triangle that counts, in units of their median.
#' @param steps Steps by which the middle is found.
#' @param around,fewest See `at`.
#' @return Number in the mesh's unit.
#' @noRd
mesh_size <- function(mesh, used = NULL, at = NULL, diagonal = 4, cap = 4, steps = 5, around = 12,
                      fewest = 4) {
  if (is.null(used)) used <- rep(TRUE, ncol(mesh$it))
  it <- mesh$it
  storage.mode(it) <- "integer"
  own <- mesh$vb[1:3, if (all(used)) TRUE else unique(as.vector(it[, used])), drop = FALSE]
  size <- min(diagonal * cpp_half_area_radius(mesh$vb, it, used, cap, steps), box_diagonal(own))
  at <- at[!is.na(at[, 1]), , drop = FALSE]
  if (NROW(at) < fewest) return(size)
  spread <- stats::median(row_lengths(sweep(at, 2, colMeans(at))))
  if (spread > 0) min(size, around * spread) else size
}

#' The size of a specimen, as it was worked out at the door
#' @noRd
specimen_size <- function(specimen) {
  known <- specimen$geometry$size
  if (is.null(known)) mesh_size(specimen$mesh) else known
}
