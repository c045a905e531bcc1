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
