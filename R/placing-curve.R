# Curves that a person draws on a specimen: knots, joined by cuts, laid onto the ridge on request.

#' Which curve of a review is drawn now; none: a click places landmarks
#' @noRd
choose_curve <- function(review, name) {
  known <- review$fitting$scheme$curves$curve
  if (!name %in% known) return(review)
  review$pen <- if (identical(review$pen, name)) character() else name
  review$selected <- character()
  with_said(review, "")
}

#' Put a knot of the chosen curve on a place of the mesh
#'
#' It goes between the two neighbours between which it makes the curve least longer, so that knots
#' may come in any order.
#' @param point One row of [surface_points()].
#' @noRd
add_knot <- function(review, point) {
  knot <- unlist(unclass(point)[mesh_columns])
  line <- review$drawn[[review$pen]]
  row <- curve_row(review, review$pen)
  ends <- knot_ends(review, row)
  at <- knot_place(rbind(ends$from, line$knots, ends$to), knot, closed_curves(row),
                   c(!is.null(ends$from), !is.null(ends$to)))
  before <- seq_len(NROW(line$knots)) <= at - !is.null(ends$from)
  knots <- rbind(line$knots[before, , drop = FALSE], knot, line$knots[!before, , drop = FALSE])
  with_knots(review, knots, "point set")
}

#' After how many of the stops of a line a new one makes it least longer
#'
#' @param held Whether the line has to begin at its first stop, and to end at its last.
#' @noRd
knot_place <- function(stops, knot, closed, held) {
  n <- NROW(stops)
  if (n == 0) return(0)
  away <- row_lengths(sweep(stops[, 1:3, drop = FALSE], 2, knot[1:3]))
  after <- seq_len(n)
  following <- c(after[-1], if (closed) 1 else NA)
  between <- row_lengths(stops[after, 1:3, drop = FALSE] - stops[following, 1:3, drop = FALSE])
  cost <- away + away[following] - between
  if (!closed) cost[n] <- if (held[2]) Inf else away[n]
  cost <- c(if (closed || held[1]) Inf else away[1], cost)
  if (all(is.infinite(cost))) return(n)
  # Of equal ones the last, so that clicks along a line go on where it ends
  max(which(cost <= min(cost))) - 1
}

#' Another place for a knot of the chosen curve; NULL takes it away
#' @noRd
move_knot <- function(review, i, point) {
  knots <- review$drawn[[review$pen]]$knots
  if (is.na(i) || !i %in% seq_len(NROW(knots))) return(review)
  if (is.null(point)) return(with_knots(review, knots[-i, , drop = FALSE], "point removed"))
  knots[i, ] <- unlist(unclass(point)[mesh_columns])
  with_knots(review, knots, "point moved")
}

#' The chosen curve without all that was drawn of it: it is found by curvature or a cut again
#' @noRd
erase_curve <- function(review) {
  if (!any(names(review$drawn) %in% review$pen)) {
    return(with_said(review, "Choose a drawn curve first."))
  }
  after <- review_step(review, review$pen, "curves", "erased")
  after$drawn[[review$pen]] <- NULL
  with_said(after, sprintf("%s is no longer drawn.", review$pen))
}

with_knots <- function(review, knots, action) {
  name <- review$pen
  rownames(knots) <- NULL
  if (!nrow(knots)) return(erase_curve(review))
  colnames(knots) <- mesh_columns
  after <- review_step(review, name, "curves", action)
  line <- joined_line(after, name, knots)
  after$drawn[[name]] <- line
  with_said(after, line_words(name, line))
}

#' The line through knots, and the landmarks at its ends that there are
#'
#' @return List: `knots`; `path` (`mesh_path`; NULL as long as there is none); `snapped`; `problem`;
#'   `kind` of the curve.
#' @noRd
joined_line <- function(review, name, knots) {
  row <- curve_row(review, name)
  scan <- drawing_scan(review)
  stops <- line_stops(review, row, knots)
  line <- list(knots = knots, path = NULL, snapped = FALSE, problem = NA_character_,
               kind = row$kind)
  if (nrow(stops) < 2) return(line)
  joined <- join_knots(stops, scan)
  line$path <- joined$path
  if (closed_curves(row) && !is.null(line$path)) attr(line$path, "closed") <- TRUE
  if (!is.null(joined$problem)) line$problem <- sub("\\.$", "", joined$problem)
  line
}

#' Knots with the ends of a line, a k x 7 matrix; those of a closed line end where they begin
#' @noRd
line_stops <- function(review, row, knots) {
  if (closed_curves(row)) return(rbind(knots, knots[1, ]))
  ends <- knot_ends(review, row)
  rbind(ends$from, knots, ends$to)
}

#' The landmarks at the ends of a curve, as far as they are on the mesh; a curve that is cut off
#' begins where it was drawn
#' @noRd
knot_ends <- function(review, row) {
  if (closed_curves(row)) return(list())
  place <- function(name) {
    at <- as_value(found_landmark(review$specimen, name))
    if (!failed(at)) unlist(unclass(at)[mesh_columns])
  }
  list(from = if (is.na(row$cut_share)) place(row$from), to = place(row$to))
}

curve_row <- function(review, name) {
  curves <- review$fitting$scheme$curves
  curves[match(name, curves$curve), ]
}

#' The mesh on which lines are joined
#' @noRd
drawing_scan <- function(review) {
  scan <- review$fitting$scan
  scan$column <- column_settings(shape_settings())
  scan
}

#' Lay the chosen curve onto the ridge or valley beside it
#'
#' The window of the scheme's `width` runs along the drawn line, not along a cut between landmarks:
#' the line says which ridge is meant, and curvature where it runs.
#' @noRd
snap_line <- function(review) {
  name <- review$pen
  line <- review$drawn[[c(name, "")[1]]]
  if (is.null(line$path)) {
    return(with_said(review, "Choose a curve, and click along it on the surface first."))
  }
  found <- snapped_line(review, name, line)
  if (failed(found)) return(with_said(review, paste(found$problem, found$remedy)))
  after <- review_step(review, name, "curves", "snapped")
  after$drawn[[name]] <- found
  with_said(after, line_words(name, found))
}

#' A line on its ridge or valley, or a failure
#' @noRd
snapped_line <- function(review, name, line) {
  row <- as.list(curve_row(review, name))
  scan <- drawing_scan(review)
  if (row$kind == "plane" || is_closed(line$path)) {
    return(no_result(sprintf("%s is %s.", name, if (row$kind == "plane")
      "a plane cut by its scheme, which has no ridge" else "closed"),
      "It stays as it was drawn.", "curves"))
  }
  stops <- columns_of(line$path)[c(1, nrow(line$path)), ]
  ends <- path_ends(scan, stops, c(row$from, row$to))
  job <- curve_job(ends, row$kind, row$n, scan$settings, row$radius, row$width,
                   scan$sources[[as.character(row$radius)]])
  job$drawn <- nearer_line(line$path, row, scan)
  curve <- as_value(trace_curve(job))
  if (failed(curve)) return(curve)
  if (all(is.na(curve$points$d))) {
    return(no_result(sprintf("There is no %s beside %s: %s.", row$kind, name, curve$reason),
                     "It stays as it was drawn.", "curves"))
  }
  line$doubt <- snap_doubt(curve, line$path, row$radius)
  line$path <- curve$path
  line$snapped <- TRUE
  line
}

#' Why a snapped line is doubtful: the ridge is not clear there, or the line went far or got a kink
#'
#' @param drawn Path as it was drawn.
#' @param far Distance from the drawn line, in radii, beyond which it is doubted.
#' @param sharp Turn within half a radius, in degrees, that is a kink where the drawn line has none.
#' @return Text, NA without a doubt.
#' @noRd
snap_doubt <- function(curve, drawn, radius, far = 0.5, sharp = 60) {
  places <- function(path) {
    at <- columns_of(path, c("x", "y", "z"))
    along <- c(0, cumsum(row_lengths(diff(at))))
    n <- max(4, ceiling(4 * along[length(along)] / radius))
    apply(at, 2, function(v) stats::approx(along, v, n = n + 1, ties = "ordered")$y)
  }
  turn <- function(at) {
    step <- diff(at, lag = 2)
    if (nrow(step) < 3) return(0)
    one <- step[seq_len(nrow(step) - 2), , drop = FALSE]
    two <- step[-(1:2), , drop = FALSE]
    cosine <- row_products(one, two) / (row_lengths(one) * row_lengths(two))
    # A step that ends where it began: the line turns back there
    cosine[is.nan(cosine)] <- -1
    max(180 / pi * acos(pmin(1, pmax(-1, cosine))))
  }
  before <- places(drawn)
  after <- places(curve$path)
  off <- max(apply(after, 1, function(at) sqrt(min(colSums((t(before) - at)^2)))))
  kink <- turn(after)
  said <- c(if (curve$determined %in% FALSE) curve$reason,
            if (off > far * radius) sprintf("it went %.2g from where it was drawn", off),
            if (kink > sharp && kink > turn(before)) sprintf("it has a kink of %.0f degrees", kink))
  if (length(said)) paste(said, collapse = "; ") else NA_character_
}

#' What is doubtful of a curve as it is shown: of a snapped line, or of the one that was found
#' @return Text, NA without a doubt or a curve.
#' @noRd
curve_doubt <- function(review, name) {
  line <- review$drawn[[name]]
  if (!is.null(line)) return(c(if (line$snapped) line$doubt, NA_character_)[1])
  fit <- review$fitting$fits[[name]]
  if (is.null(fit$path) || !fit$determined %in% FALSE) NA_character_ else
    sub("[.]$", "", c(fit$reason, NA_character_)[1])
}

#' A drawn line with its kinks taken out: its places, a radius apart, on the crest beside each
#'
#' A window about a line with kinks has folds. Places that have no crest within the width stay.
#' @param faint As in [snap()].
#' @noRd
nearer_line <- function(path, row, scan, faint = formals(crestline::snap)$faint) {
  n <- max(2, ceiling(attr(path, "length") / row$radius))
  at <- place_along(scan, path, attr(path, "length") * seq_len(n - 1) / n)
  source <- scan$sources[[as.character(row$radius)]]
  for (i in seq_len(nrow(at))) {
    found <- snapped_place(scan, at[i, mesh_columns], row$kind, row$radius, row$width, faint,
                           source)
    if (!is.null(found)) at[i, mesh_columns] <- found$place[mesh_columns]
  }
  stops <- columns_of(path)[c(1, rep(NA, n - 1), nrow(path)), ]
  stops[seq_len(n - 1) + 1, ] <- columns_of(at)
  joined <- join_knots(stops, scan)
  if (is.null(joined$path) || joined$first > 1) path else joined$path
}

#' Lines whose end is at a landmark that has moved, joined to it, and snapped again if they were
#' @noRd
follow_lines <- function(review, moved) {
  for (name in names(review$drawn)) {
    row <- curve_row(review, name)
    if (!moved %in% c(row$from, row$to)) next
    before <- review$drawn[[name]]
    line <- joined_line(review, name, before$knots)
    again <- if (before$snapped && !is.null(line$path)) snapped_line(review, name, line)
    review$drawn[[name]] <- if (is.null(again) || failed(again)) line else again
  }
  review
}

#' What there is to say of a drawn line
#' @noRd
line_words <- function(name, line) {
  length <- attr(line$path, "length")
  paste0(name, ": ", amount(nrow(line$knots), "point"),
         if (!is.null(length)) sprintf(", %.4g long", length),
         if (line$snapped) {
           paste(", snapped to the", if (identical(line$kind, "valley")) "valley" else "ridge")
         },
         if (line$snapped && !is.na(c(line$doubt, NA)[1])) "; look at it: undo if it is worse",
         if (!is.na(line$problem)) paste0("; ", line$problem))
}

#' Drawn lines as [fit_shape()] takes them
#'
#' A line gets as many points as its curve in the scheme, at equal chords: they keep their places.
#' @return List by curve of n x 3 matrices with attributes `closed` and `drawn` (text: how).
#' @noRd
drawn_points <- function(review) {
  lines <- Filter(function(line) !is.null(line$path), review$drawn)
  scan <- if (length(lines)) drawing_scan(review)
  stats::setNames(lapply(names(lines), function(name) {
    at <- spaced_points(scan, lines[[name]]$path, curve_row(review, name)$n)
    structure(unname(columns_of(at, c("x", "y", "z"))), dimnames = list(NULL, c("x", "y", "z")),
              closed = is_closed(lines[[name]]$path),
              drawn = drawn_words(name, lines[[name]]$snapped, review$log))
  }), names(lines))
}
