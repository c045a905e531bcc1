# Curves that come with a specimen, drawn by hand or by other software: laid onto its mesh, not
# searched for.

#' Fits of the curves that are given
#'
#' @param specimen The specimen with its holes bridged, `scan` as it is.
#' @param curves As in [fit_shape()].
#' @param column As of [fit_scheme_patches()].
#' @return Named list of the given curves, each as of [fit_scheme_curves()].
#' @noRd
given_fits <- function(specimen, scan, scheme, curves, column) {
  for (name in names(curves)) {
    if (inherits(curves[[name]], "curve")) check_curve_on(curves[[name]], scan,
                                                          sprintf("`curves`: %s", name))
  }
  curves <- as_curves(curves)
  unknown <- unknown_names(names(curves), scheme$curves$curve, "curve", "curve")
  if (nrow(unknown)) {
    crestline_abort(sprintf("`curves` holds what the scheme %s has not: %s.", scheme$name,
                            shorten(unknown$text)),
                    "Name the curves as the scheme does: as.data.frame(scheme)$curve.",
                    stage = "curves", id = specimen$id, call = NULL)
  }
  surface <- walkable(specimen)
  Map(function(xyz, name) {
    row <- scheme$curves[scheme$curves$curve == name, ]
    tryCatch(given_fit(row, xyz, specimen, surface, column),
             crestline_error = function(e) list(reason = paste("as given:", e$problem)))
  }, curves, names(curves))
}

#' One given curve: its points on the mesh, its ends at the landmarks, joined by cuts
#'
#' @param tolerance Greatest distance of a point from the mesh, as in [specimen()].
#' @noRd
given_fit <- function(row, xyz, specimen, surface, column, tolerance = 0.01) {
  xyz <- xyz[!is.na(rowSums(xyz)), , drop = FALSE]
  xyz <- xyz[c(TRUE, row_lengths(diff(xyz)) > 0), , drop = FALSE]
  if (nrow(xyz) < 2) return(list(reason = "as given: it has fewer than two points"))
  ends <- list(from = if (is.na(row$cut_share)) known_point(specimen, row$from),
               to = known_point(specimen, row$to))
  if (runs_backwards(xyz, ends)) xyz <- xyz[nrow(xyz):1, , drop = FALSE]
  knots <- surface_points(specimen$mesh, xyz)
  place <- as.matrix(knots[c("x", "y", "z")])
  off <- row_lengths(place - xyz)
  knots[off > tolerance * specimen_size(specimen) | c(row_lengths(diff(place)) == 0, FALSE), ] <- NA
  if (!is.null(ends$from)) knots[1, ] <- ends$from
  if (!is.null(ends$to)) knots[nrow(knots), ] <- ends$to
  joined <- join_knots(as.matrix(knots), specimen, surface, column)
  own <- nrow(knots) == row$n
  if (is.null(joined$path) || joined$first > 1 &&
      !own) return(list(reason = paste("as given:", joined$problem)))
  points <- if (own) data.frame(knots, s = joined$s) else
    resample_path(specimen$mesh, joined$path, row$n)
  points[seq_len(joined$first - 1), ] <- NA
  said <- sprintf("as given: points up to %.2g from the mesh", max(off[joined$first:nrow(xyz)]))
  if (joined$first > 1) said <- sprintf("%s; it begins at point %d of %d: %s", said, joined$first,
                                        row$n, joined$problem)
  list(points = cbind(points[c(mesh_columns, "s")], se = NA_real_), path = joined$path,
       length = attr(joined$path, "length"), strength = NA_real_, contrast = NA_real_,
       se = NA_real_,
       se_max = NA_real_, competing = NA_real_, determined = NA, reason = said)
}

#' Whether the ends of points lie nearer to their landmarks when run backwards
#' @noRd
runs_backwards <- function(xyz, ends) {
  from <- function(end, row) if (is.null(end)) 0 else
    sqrt(sum((unlist(end[c("x", "y", "z")]) - xyz[row, ])^2))
  n <- nrow(xyz)
  from(ends$from, n) + from(ends$to, 1) < from(ends$from, 1) + from(ends$to, n)
}

#' A path through knots on the mesh: shortest cuts near the surface's normal from each to the next
#'
#' @param knots k x 7 matrix, rows of NA where there is no place on the mesh.
#' @return List: `path` (NULL where none can be joined to the last knot); `first`, the first knot
#'   that can; `s`, arc length at every knot, NA before the first; `problem`, why there is no more,
#'   NULL where all are joined.
#' @noRd
join_knots <- function(knots, specimen, surface, column) {
  last <- nrow(knots)
  pieces <- vector("list", last - 1)
  length <- numeric(last - 1)
  problem <- NULL
  first <- 1
  for (i in rev(seq_len(last - 1))) {
    piece <- tryCatch(join_two(knots[i, ], knots[i + 1, ], specimen, surface, column),
                      crestline_error = identity)
    if (inherits(piece, "condition")) {
      problem <- piece$problem
      first <- i + 1
      break
    }
    if (is.null(piece)) next
    pieces[[i]] <- piece
    length[i] <- attr(piece, "length")
  }
  s <- c(0, cumsum(length))
  s[seq_len(first - 1)] <- NA
  rows <- lapply(Filter(Negate(is.null), pieces),
                 function(piece) as.data.frame(piece)[mesh_columns])
  list(path = if (length(rows)) path_through(do.call(rbind, rows), surface), first = first, s = s,
       problem = problem)
}

#' A cut from one knot to the next, NULL where they are one place
#' @noRd
join_two <- function(from, to, specimen, surface, column) {
  if (anyNA(c(from, to))) crestline_abort("a point is not on the mesh.",
                                          "Trace the curve on this mesh.", stage = "curves")
  if (any(from[1:3] != to[1:3])) cut_between(from, to, specimen, surface, column)
}
