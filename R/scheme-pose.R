# The pose of an object by its landmarks: views are named from its own front, however it lies.

#' The rotation of a view of an object, by its landmarks where a scheme says how they lie
#'
#' A matrix is taken as it is. A name or two angles are meant from the object's own front: its
#' landmarks are laid on those of the scheme, which are seen from the front along -z, y up.
#'
#' @param view As in [draw_surface()].
#' @param xyz k x 3 matrix; row names are those of landmarks or of points of the scheme.
#' @param scheme A `curve_scheme`.
#' @return 3 x 3 rotation.
#' @noRd
posed_view <- function(view, xyz, scheme = face_scheme()) {
  rotation <- view_rotation(view)
  if (is.matrix(view)) rotation else rotation %*% own_pose(xyz, scheme)
}

#' The rotation that turns an object to the pose of a scheme; the identity where too few landmarks
#' are known, or they lie otherwise than the scheme's
#'
#' @param fewest Least number of landmarks.
#' @param alike Greatest distance (root mean square) from the scheme's landmarks once they are laid
#'   on them, as a share of their size (four faces: 0.05 to 0.10; 1: nothing in common).
#' @noRd
own_pose <- function(xyz, scheme, fewest = 4, alike = 0.35) {
  typical <- scheme_places(scheme)
  if (is.null(typical) || is.null(rownames(xyz)) || ncol(xyz) != 3) return(diag(3))
  at <- match(rownames(xyz), rownames(typical))
  known <- which(!is.na(at) & !is.na(rowSums(xyz)) & !duplicated(at))
  if (length(known) < fewest) return(diag(3))
  centred <- function(x) sweep(x, 2, colMeans(x))
  own <- centred(unname(xyz[known, , drop = FALSE]))
  to <- centred(unname(typical[at[known], , drop = FALSE]))
  turn <- nearest_rotation(own, to)
  apart <- sqrt(max(0, 1 - sum(turn$d)^2 / (sum(own^2) * sum(to^2))))
  if (!is.finite(apart) || apart > alike) return(diag(3))
  t(turn$rotation)
}

#' Typical positions of a scheme's landmarks, by the names of landmarks and of the curve and surface
#' points that lie on them; NULL where the scheme has none
#' @noRd
scheme_places <- function(scheme) {
  axes <- c("x", "y", "z")
  if (!all(axes %in% names(scheme$landmarks))) return(NULL)
  points <- scheme$points
  row <- match(sub("^landmarks[|]", "", points$place), scheme$landmarks$landmark)
  row[!startsWith(points$place, "landmarks|")] <- NA
  xyz <- as.matrix(scheme$landmarks[row, axes])
  rownames(xyz) <- ifelse(points$level == "landmarks", points$part,
                          paste(points$part, points$point))
  # A curve and a patch may have points of one name, in different places.
  shared <- unique(rownames(xyz)[duplicated(rownames(xyz))])
  xyz <- xyz[!is.na(rowSums(xyz)) & !rownames(xyz) %in% shared, , drop = FALSE]
  if (nrow(xyz)) xyz
}
