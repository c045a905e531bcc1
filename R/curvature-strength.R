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

#' A region where curvature is ignored
#'
#' A feature near the one you want may be sharper, such as the rim of the orbit
#' beside the brow. Curvature is ignored inside a cylinder whose axis joins two
#' landmarks.
#'
#' @param from,to Names of landmarks, or positions (three co-ordinates, in the unit of the mesh).
#' @param radius Radius of the cylinder, as a share of the distance between them.
#' @param extension Length by which the cylinder extends beyond each landmark, as a share of the
#'   distance.
#' @return A `keep_away` object for [reference_path()] and [ridge_curve()].
#' @section Errors: of class `crestline_error` when a share is negative.
#' @template glossary
#' @seealso [keep_side()]
#' @examples
#' keep_away("exL", "enL") # for the left brow ridge of a face
#' @export
keep_away <- function(from, to, radius = 0.7, extension = 0.2) {
  check_given()
  check_ends(from = from, to = to)
  structure(list(from = from, to = to, radius = check_number(radius, "radius", lower = 0),
                 extension = check_number(extension, "extension", lower = 0)), class = "keep_away")
}

#' @export
print.keep_away <- function(x, ...) {
  check_method_dots(...)
  cat(sprintf("<keep_away> %s - %s: radius %g, extension %g of their distance\n",
              end_name(x$from),
              end_name(x$to), x$radius, x$extension))
  invisible(x)
}

#' A side to keep to
#'
#' Use this if two similar features run on either side of a line between two landmarks. An example
#' are the ridges of the upper and the lower eyelid. Curvature on the other side is ignored. The
#' dividing plane contains the two landmarks and is perpendicular to the plane through all three.
#'
#' @param from,to Names of the two landmarks that the line joins, or positions (three co-ordinates,
#'   in the unit of the mesh).
#' @param towards Name of a landmark, or a position, on the side that counts.
#' @return A `keep_side` object, for the argument `keep_away` of [reference_path()] and
#'   [ridge_curve()].
#' @section Errors: of class `crestline_error`, by the function that uses the object, if the three
#'   points lie on one line.
#' @template glossary
#' @seealso [keep_away()]
#' @examples
#' keep_side("exL", "enL", towards = "acL") # for the ridge of the left lower eyelid
#' @export
keep_side <- function(from, to, towards) {
  check_given()
  check_ends(from = from, to = to, towards = towards)
  structure(list(from = from, to = to, towards = towards), class = "keep_side")
}

#' @export
print.keep_side <- function(x, ...) {
  check_method_dots(...)
  cat(sprintf("<keep_side> the side of %s - %s where %s lies\n", end_name(x$from), end_name(x$to),
              end_name(x$towards)))
  invisible(x)
}

#' Regions with their landmarks looked up
#'
#' @param regions `NULL`, a `keep_away` or `keep_side`, or a list of them.
#' @param locate Function of an end and its name in the region that gives three co-ordinates, or a
#'   failure, as of [region_locator()].
#' @param id Of the specimen.
#' @param flat Height of the third point of a `keep_side` above the line, as a share of its length,
#'   at which the three count as lying on a line.
#' @return List of the regions, their ends as co-ordinates; `NULL` where there is none. Or a
#'   failure.
#' @noRd
located_regions <- function(regions, locate, id, flat = 1e-6) {
  if (inherits(regions, c("keep_away", "keep_side"))) regions <- list(regions)
  for (i in seq_along(regions)) {
    region <- regions[[i]]
    ends <- intersect(c("from", "to", "towards"), names(region))
    at <- Map(locate, unclass(region)[ends], ends)
    bad <- Find(failed, at)
    if (!is.null(bad)) return(bad)
    regions[[i]][ends] <- at
    if (!inherits(region, "keep_side")) next
    axis <- at$to - at$from
    up <- height_above(at)
    if (sum(up^2) <= flat^2 * sum(axis^2)) {
      return(no_result(
        sprintf("%s lies on the line from %s to %s.", end_name(region$towards),
                end_name(region$from), end_name(region$to)),
        "Give keep_side() a landmark well beside that line.", "regions", id
      ))
    }
  }
  regions
}

# From the line between the first two ends of a region square up to the third.
height_above <- function(region) {
  axis <- region$to - region$from
  third <- region$towards - region$from
  third - sum(third * axis) / sum(axis^2) * axis
}

#' Which points lie in any of the regions
#'
#' @param regions As of [located_regions()].
#' @param xyz n x 3.
#' @return Logical n.
#' @noRd
is_kept_away <- function(regions, xyz) {
  inside <- logical(nrow(xyz))
  for (region in regions) {
    relative <- sweep(xyz, 2, region$from)
    inside <- inside | if (inherits(region, "keep_side")) {
      as.vector(relative %*% height_above(region)) < 0
    } else {
      axis <- region$to - region$from
      span <- sqrt(sum(axis^2))
      along <- as.vector(relative %*% axis) / span
      off <- sqrt(pmax(rowSums(relative^2) - along^2, 0))
      off <= region$radius * span & along >= -region$extension * span &
        along <= (1 + region$extension) * span
    }
  }
  inside
}
