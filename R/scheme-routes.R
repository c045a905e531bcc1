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

# Expected tracks of a scheme's curves, brought from the frame of its landmarks onto a specimen.

#' The frame of a curve on one specimen
#'
#' The scheme's typical landmarks are turned onto the specimen's, and then turned on until the line
#' between the curve's ends has the same direction in both.
#'
#' @param typical,landmarks k x 3 with row names, the scheme's and the specimen's.
#' @param from,to Names of the curve's ends.
#' @param flat Landmarks on a line fix no frame: the second singular value as a share of the first.
#' @return List: `turn` (3 x 3: rows of vectors times it turn into the specimen's frame), `origin`
#'   (`from`), `span` (distance of the ends); NULL where the landmarks do not fix it.
#' @noRd
track_frame <- function(typical, landmarks, from, to, flat = 1e-6) {
  landmarks <- landmarks[stats::complete.cases(landmarks), , drop = FALSE]
  both <- intersect(rownames(typical), rownames(landmarks))
  if (length(both) < 3 || !all(c(from, to) %in% both)) return(NULL)
  centred <- lapply(list(typical, landmarks), function(x) scale(x[both, ], scale = FALSE))
  turned <- nearest_rotation(centred[[1]], centred[[2]])
  own <- landmarks[to, ] - landmarks[from, ]
  span <- sqrt(sum(own^2))
  axis <- unit_vector(drop((typical[to, ] - typical[from, ]) %*% turned$rotation))
  if (span == 0 || !all(is.finite(axis)) || turned$d[2] <= flat * turned$d[1]) return(NULL)
  normal <- cross_product(axis, own / span)
  sine <- sqrt(sum(normal^2))
  angle <- atan2(sine, sum(axis * own) / span)
  rest <- if (sine > 0) rotation_about(normal / sine * angle) else diag(3)
  list(turn = turned$rotation %*% t(rest), origin = landmarks[from, ], span = span)
}

#' The expected track of a curve on a specimen, as in [plane_weight()]; NULL where there is none
#'
#' @param row Row of the curves table, a list.
#' @param landmarks The specimen's, k x 3 with row names.
#' @noRd
expected_track <- function(scheme, row, landmarks) {
  known <- scheme$tracks[scheme$tracks$curve %in% row$curve, ]
  if (!NROW(known)) return(NULL)
  frame <- track_frame(typical_landmarks(scheme), landmarks, row$from, row$to)
  if (is.null(frame)) return(NULL)
  turned <- function(columns) columns_of(known, columns) %*% frame$turn
  list(xyz = sweep(frame$span * turned(c("x", "y", "z")), 2, frame$origin, `+`),
       across = turned(c("across_x", "across_y", "across_z")),
       spread = frame$span * known$spread)
}

#' Where the scheme says that landmarks lie on a typical object, k x 3 with row names
#' @noRd
typical_landmarks <- function(scheme) {
  at <- as.matrix(scheme$landmarks[intersect(c("x", "y", "z"), names(scheme$landmarks))])
  if (ncol(at) < 3) return(NULL)
  rownames(at) <- scheme$landmarks$landmark
  at[stats::complete.cases(at), , drop = FALSE]
}

#' Greatest departure of every curve from its expected track, in spreads; NA without a track
#'
#' @param paths List by curve of paths, NULL where there is none.
#' @noRd
track_departures <- function(scheme, paths, landmarks) {
  vapply(seq_len(nrow(scheme$curves)), function(i) {
    row <- as.list(scheme$curves[i, ])
    path <- paths[[row$curve]]
    track <- if (!is.null(path)) expected_track(scheme, row, landmarks)
    if (is.null(track)) return(NA_real_)
    off <- track_offsets(track, columns_of(path, c("x", "y", "z")), !is.na(row$cut_share))
    largest(abs(off) / track$spread)
  }, 0)
}

#' The curves of a specimen that leave their expected tracks, where they are so many that the tracks
#' are of other objects
#'
#' @param away As of [track_departures()].
#' @param spreads A curve leaves its track beyond so many; the limit `track` of [quality_limits()].
#' @param share,fewest From what share of the curves with a track, and from how many. Of 47 faces
#'   with tracks of their own population one had one such curve; of 24 with tracks of another all
#'   had 5 to 8 of 14.
#' @return List: `off` (names), `of` (number of curves with a track); NULL where the tracks fit.
#' @noRd
foreign_tracks <- function(scheme, away, spreads = 4, share = 0.25, fewest = 3) {
  off <- which(away > spreads)
  of <- sum(!is.na(away))
  if (length(off) < max(fewest, share * of)) return(NULL)
  list(off = scheme$curves$curve[off], of = of)
}
