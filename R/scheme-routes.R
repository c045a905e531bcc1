# How the curves of a scheme get from end to end: by plane cuts, along a crest, or once round.

#' The landmarks that a cell of `via` names, in order; none where it is empty
#' @noRd
via_names <- function(cell) if (is.null(cell) || is.na(cell)) character() else mirror_names(cell)

#' Problems of the columns `path` and `via`, and of closed curves
#' @noRd
check_routes <- function(curves, known) {
  closed <- closed_curves(curves)
  stops <- lapply(curves$via, via_names)
  unknown <- lapply(seq_along(stops), function(row) {
    found <- unknown_names(stops[[row]], known, "via", "landmark")
    own <- intersect(stops[[row]], unlist(curves[row, c("from", "to")]))
    twice <- if (anyDuplicated(stops[[row]])) "names a landmark twice"
    text <- c(found$text, sprintf("names %s, which is an end of the curve", own), twice)
    problem(rep(row, length(text)), "via", text)
  })
  crest <- !is.na(curves$via) | curves$path %in% "crest"
  only_open <- c("cut_share", "trust_from", "trust_to")
  whole <- list(cut_share = NA, trust_from = 0, trust_to = 1)
  refused <- lapply(only_open, function(column) {
    given <- !is.na(curves[[column]]) & !curves[[column]] %in% whole[[column]]
    problem(which(closed & given), column, "is given, but a closed curve has no ends")
  })
  do.call(rbind, c(
    unknown, refused,
    list(
      problem(which(closed & is.na(curves$via)), "to",
              paste("is the same landmark as from: a closed curve needs a `via`, a landmark on its",
                    "other side")),
      problem(which(closed & curves$n < 3), "n", "is below 3, and the curve is closed"),
      problem(which(!is.na(curves$via) & curves$path %in% "plane"), "path",
              "is plane, but there is a via: only paths along a crest have stops"),
      problem(which(crest & curves$kind %in% "plane"), "path",
              "is crest, but a plane curve has none"),
      problem(which(crest & !is.na(curves$angle_limit)), "angle_limit",
              "is given, but the path is no plane cut")
    )
  ))
}

#' Which curves run backwards in the mirror image
#'
#' An open one whose ends are exchanged does. A closed one with one `via` runs anticlockwise as seen
#' from outside, and so does its partner, which makes it clockwise in the mirror; with more it runs
#' by their order.
#' @return Logical, by row of the curves.
#' @noRd
mirrored_backwards <- function(curves, pairs) {
  other <- match(partner_of(curves$curve, pairs, "curves"), curves$curve)
  exchanged <- partner_of(curves$from, pairs, "landmarks") != curves$from[other]
  closed <- closed_curves(curves)
  against <- vapply(seq_len(nrow(curves)), function(i) {
    stops <- partner_of(via_names(curves$via[i]), pairs, "landmarks")
    length(stops) < 2 || !identical(stops, via_names(curves$via[other[i]]))
  }, NA)
  ifelse(closed, against, exchanged)
}

#' Numbers of a curve's points in the order of its mirror image
#' @noRd
mirrored_points <- function(n, backwards, closed) {
  if (!backwards) seq_len(n) else if (closed) c(1, rev(seq_len(n)[-1])) else rev(seq_len(n))
}
