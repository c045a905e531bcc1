# What is known beforehand of where a path runs: an expected track with its spread.

#' How well planes agree with an expected track
#'
#' A weak prior on the angle: of the distances of the expected places from the plane, in spreads,
#' the mean square counts beyond that of the best of `angles` planes, since no plane holds a bent
#' track. The weight has the long tail of Student's distribution with one degree of freedom, so that
#' a track that does not fit the object cannot prevail over a surface that is clear (O'Hagan 1979,
#' J. R. Stat. Soc. B 41, 358-367).
#'
#' @param track List: `xyz` (k x 3, expected places), `across` (k x 3, unit vectors along the
#'   surface and across the track), `spread` (k); in the unit of the mesh. NULL: none.
#' @param ends As of [path_ends()].
#' @param weak Number of spreads at which a plane counts two thirds as much.
#' @param angles Number of planes.
#' @return Function of angles in radians: weights in (0, 1], all 1 without a track.
#' @noRd
plane_weight <- function(track, ends, weak = 4, angles = 180) {
  if (is.null(track)) return(function(angle) 1)
  off <- sweep(track$xyz, 2, ends$exact[1, 1:3])
  square <- function(angle) colMeans((off %*% plane_normal(ends, angle) / track$spread)^2)
  least <- min(square(pi * seq_len(angles) / angles))
  function(angle) 1 / (1 + pmax(square(angle) - least, 0) / (2 * weak^2))
}

#' Offsets of a path from the places of an expected track, across it
#'
#' @param track As in [plane_weight()].
#' @param line The path, n x 3.
#' @param open Whether the path is cut off at its start: places that are nearest to it have no
#'   offset.
#' @return One number a place, in the unit of the mesh, positive along `across`; NA without offset.
#' @noRd
track_offsets <- function(track, line, open = FALSE) {
  near <- nearest_on_polyline(track$xyz, line)
  step <- line[pmin(near$segment + 1, nrow(line)), , drop = FALSE] - line[near$segment, ]
  place <- line[near$segment, , drop = FALSE] + near$share * step
  beyond <- open & near$segment == 1 & near$share == 0
  ifelse(beyond, NA, row_products(place - track$xyz, track$across))
}
