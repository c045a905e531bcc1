# Strength: how much of the sought curvature a place has.

#' Strength of a ridge or valley
#'
#' A valley has positive curvature where the shape index is negative, a ridge negative curvature
#' (sign turned) where it is positive; elsewhere the strength is 0. The shape index has the sign of
#' -(k1 + k2).
#'
#' @param curved A `curvature`.
#' @param type "ridge" or "valley".
#' @param at Vertices.
#' @param across Directions (length(at) x 3) in which the curvature is taken; the
#'   principal curvature when `NULL`.
#' @return Numeric, one value for each of `at`, in 1 / unit; NA where there is no curvature.
#' @noRd
strength_at <- function(curved, type, at = seq_along(curved$k1), across = NULL) {
  k1 <- curved$k1[at]
  k2 <- curved$k2[at]
  turn <- if (type == "ridge") -1 else 1
  sought <- if (is.null(across)) (if (type == "ridge") k2 else k1) else {
    normal_curvature(curved, at, across)
  }
  pmax(turn * sought, 0) * (turn * (k1 + k2) > 0)
}

#' Curvature of the normal section in given directions (Euler's formula)
#' @noRd
normal_curvature <- function(curved, at, direction) {
  along1 <- rowSums(curved$direction1[at, , drop = FALSE] * direction)
  along2 <- rowSums(curved$direction2[at, , drop = FALSE] * direction)
  (curved$k1[at] * along1^2 + curved$k2[at] * along2^2) / (along1^2 + along2^2)
}

#' A region where strength does not count
#'
#' Features near the sought one may be sharper: the rim of the orbit beside the
#' brow. A region about the axis between two landmarks is kept away from: strength
#' counts as 0 inside the cylinder about the axis.
#'
#' @param from,to Names of landmarks, or positions.
#' @param radius Radius of the cylinder, as a share of the distance between them.
#' @param extension Length by which the cylinder goes beyond each landmark, as a share of the distance.
#' @return A `keep_away` object for [reference_path()] and [ridge_curve()].
#' @section Errors: of class `crestline_error` when a share is negative.
#' @examples
#' keep_away("exL", "enL") # for the left brow ridge of a face
#' @export
keep_away <- function(from, to, radius = 0.7, extension = 0.2) {
  structure(list(from = from, to = to, radius = check_number(radius, "radius", lower = 0),
                 extension = check_number(extension, "extension", lower = 0)), class = "keep_away")
}

#' @export
print.keep_away <- function(x, ...) {
  cat(sprintf("Keep away from %s - %s: radius %g, extension %g of their distance\n", end_name(x$from),
              end_name(x$to), x$radius, x$extension))
  invisible(x)
}

#' Which points lie in any of the regions
#'
#' @param regions `NULL`, a `keep_away`, or a list of them.
#' @param specimen Specimen or mesh on which landmarks are looked up.
#' @param xyz n x 3.
#' @return Logical n.
#' @noRd
is_kept_away <- function(regions, specimen, xyz) {
  if (inherits(regions, "keep_away")) regions <- list(regions)
  inside <- logical(nrow(xyz))
  for (region in regions) {
    check_class(region, "keep_away", "keep_away", "keep_away()")
    ends <- rbind(end_point(specimen, region$from, "from"), end_point(specimen, region$to, "to"))
    a <- unlist(ends[1, c("x", "y", "z")])
    axis <- unlist(ends[2, c("x", "y", "z")]) - a
    span <- sqrt(sum(axis^2))
    relative <- sweep(xyz, 2, a)
    along <- as.vector(relative %*% axis) / span
    off <- sqrt(pmax(rowSums(relative^2) - along^2, 0))
    inside <- inside | (off <= region$radius * span & along >= -region$extension * span &
                          along <= (1 + region$extension) * span)
  }
  inside
}
