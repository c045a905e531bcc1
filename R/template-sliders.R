# Sliders on paths as the kernel takes them, and the tables of what they did.

#' @param longest Of every part, named; of several parts in one set the largest.
#' @noRd
sliding_table <- function(trace, level, longest) {
  of <- function(f, type) vapply(trace, f, type, USE.NAMES = FALSE)
  part <- names(trace)
  data.frame(part = as.character(part), level = rep(level, length(part)),
             points = of(function(x) x$points, 0L),
             sweeps = of(function(x) length(x$energy) - 1, 0),
             converged = of(function(x) x$converged, NA),
             energy_before = of(function(x) x$energy[1], 0),
             energy_after = of(function(x) x$energy[length(x$energy)], 0),
             longest = ifelse(part %in% names(longest), longest[part], max(longest, 0)))
}

trace_table <- function(trace) {
  data.frame(sweep = seq_along(trace$energy) - 1, energy = trace$energy, strain = trace$strain,
             longest = trace$longest)
}

#' Sliders of several paths, their neighbours and tracks counted through
#' @noRd
stack_rows <- function(rows) {
  offset <- cumsum(c(0, vapply(rows, nrow, 0L)))[seq_along(rows)]
  do.call(rbind, unname(Map(function(rows, offset, track) {
    rows[, "track"] <- track
    for (side in c("before", "after")) rows[,
                                            side] <- ifelse(rows[, side] == 0, 0,
                                                            rows[, side] + offset)
    rows
  }, rows, offset, seq_along(rows))))
}

#' Sliders of one path, as the kernel takes them
#'
#' @param s Arc lengths of its points in order, NA where missing.
#' @param slides Which of them slide.
#' @param spacing Spacing at rest between neighbours.
#' @param closed Whether the first and the last are neighbours, across the seam.
#' @return Matrix with a row a slider; `point`: its number on the path.
#' @noRd
slider_rows <- function(s, slides, spacing, length, settings, closed = FALSE) {
  n <- length(s)
  there <- which(!is.na(s))
  at <- which(slides & !is.na(s))
  before <- c(if (closed) utils::tail(there, 1) else NA, there)[match(at, there)]
  after <- c(there, if (closed) there[1] else NA)[match(at, there) + 1]
  turn <- function(across) ifelse(closed & across %in% TRUE, 1, 0)
  number <- function(point) match(point, at, nomatch = 0)
  cbind(point = at, track = rep(1, length(at)), s = s[at], before = number(before),
        after = number(after),
        low = ifelse(is.na(before), 0, s[before]), high = ifelse(is.na(after), length, s[after]),
        rest_before = (at - before + turn(before >= at) * n) * spacing,
        rest_after = (after - at + turn(after <= at) * n) * spacing,
        gap = rep(settings$gap * spacing, length(at)),
        tolerance = rep(settings$tolerance * spacing, length(at)),
        turn_before = turn(before >= at) * length, turn_after = turn(after <= at) * length)
}

#' The nodes of a closed track run through three times, so that points can slide across its seam
#'
#' @param nodes Matrix, columns s, x, y, z, face; its last row is at the place of its first.
#' @noRd
unrolled_track <- function(nodes) {
  length <- nodes[nrow(nodes), "s"]
  turn <- function(by) {
    nodes[, "s"] <- nodes[, "s"] + by * length
    nodes[-1, , drop = FALSE]
  }
  first <- nodes[1, , drop = FALSE]
  first[, "s"] <- -length
  rbind(first, turn(-1), turn(0), turn(1))
}

#' Arc lengths of the points of a closed path, in order, the first as near to the seam as can be
#' @noRd
from_seam <- function(path, s) {
  length <- attr(path, "length")
  s - length * round(stats::na.omit(s)[1] / length)
}
