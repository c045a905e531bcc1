# How far a curve is from the mirror image of its partner: what one specimen can say against itself.

#' Asymmetry of every curve of a shape
#'
#' The shape is reflected, left and right exchanged, and laid on itself by its landmarks (rotation
#' and translation). Between the curve and its partner's image only what lies between the ends
#' counts: the ends' own difference, interpolated along the curve, is taken off. A curve that is its
#' own partner is compared with its own image.
#'
#' @param shape A `shape`.
#' @return Numeric by curve of the scheme, in the unit of the mesh: the greatest distance of
#'   corresponding points; NA where one of the two is missing, the scheme has no pairs, or the
#'   landmarks do not fix the image.
#' @noRd
curve_asymmetry <- function(shape) {
  curves <- shape$scheme$curves
  pairs <- shape$scheme$pairs
  none <- stats::setNames(rep(NA_real_, nrow(curves)), curves$curve)
  image <- if (nrow(pairs)) mirror_image(coords(shape, "landmarks"), pairs)
  if (is.null(image)) return(none)
  points <- shape$points[shape$points$level == "curves", ]
  own <- split.data.frame(as.matrix(points[c("x", "y", "z")]), factor(points$part, curves$curve))
  partner <- partner_of(curves$curve, pairs, "curves")
  backwards <- partner_of(curves$from, pairs,
                          "landmarks") != curves$from[match(partner, curves$curve)]
  for (i in seq_along(none)) {
    mirrored <- image(own[[partner[i]]])
    if (backwards[i]) mirrored <- mirrored[rev(seq_len(nrow(mirrored))), , drop = FALSE]
    none[i] <- bow(mirrored - own[[i]])
  }
  none
}

#' The map to the mirror image of landmarks, best laid on themselves; `NULL` where they do not fix
#' it
#'
#' @param flat Landmarks on a line fix no image: the second singular value as a share of the first.
#' @noRd
mirror_image <- function(landmarks, pairs, flat = 1e-6) {
  flip <- diag(c(-1, 1, 1))
  mirrored <- landmarks[partner_of(rownames(landmarks), pairs, "landmarks"), ,
                        drop = FALSE] %*% flip
  known <- stats::complete.cases(landmarks, mirrored)
  if (sum(known) < 3) return(NULL)
  from <- colMeans(mirrored[known, ])
  to <- colMeans(landmarks[known, ])
  turn <- nearest_rotation(sweep(mirrored[known, ], 2, from), sweep(landmarks[known, ], 2, to))
  if (turn$d[2] <= flat * turn$d[1]) return(NULL)
  function(xyz) sweep(sweep(xyz %*% flip, 2, from) %*% turn$rotation, 2, to, "+")
}

#' Greatest length of differences (n x 3) after those between their first and last are interpolated
#' and taken off
#' @noRd
bow <- function(gap) {
  share <- seq(0, 1, length.out = nrow(gap))
  max(row_lengths(gap - outer(1 - share, gap[1, ]) - outer(share, gap[nrow(gap), ])))
}
