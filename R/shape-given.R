# Curves that come with a specimen, drawn by hand or by other software: laid onto its mesh, not
# searched for.

#' Records of the curves that are given
#'
#' @param scan As of [prepare_scan()].
#' @param curves As in [fit_shape()].
#' @return List by name of all curves of the scheme, NULL for those that are not given.
#' @noRd
given_fits <- function(scan, curves) {
  specimen <- scan$specimen
  scheme <- scan$scheme
  fits <- stats::setNames(vector("list", nrow(scheme$curves)), scheme$curves$curve)
  if (!length(curves)) return(fits)
  for (name in names(curves)) {
    if (inherits(curves[[name]], "curve")) {
      check_curve_on(curves[[name]], specimen, sprintf("`curves`: %s", name))
    }
  }
  hand <- vapply(curves, function(one) !is.null(attr(one, "drawn")), NA)
  said <- vapply(curves[hand], attr, "", "drawn")
  curves <- as_curves(curves)
  unknown <- unknown_names(names(curves), scheme$curves$curve, "curve", "curve")
  if (nrow(unknown)) {
    crestline_abort(sprintf("`curves` holds what the scheme %s has not: %s.", scheme$name,
                            shorten(unknown$text)),
                    "Name the curves as the scheme does: as.data.frame(scheme)$curve.",
                    stage = "curves", id = specimen$id, call = NULL)
  }
  tolerance <- 0.01 * specimen_size(specimen)
  fits[names(curves)] <- Map(function(xyz, name) {
    row <- scheme$curves[scheme$curves$curve == name, ]
    if (closed_curves(row)) return(given_loop(row, xyz, scan, tolerance))
    given_fit(scheme$curves[scheme$curves$curve == name, ], xyz, scan, tolerance)
  }, curves, names(curves))
  for (name in names(said)) {
    fits[[name]]$reason <- sub("^as given", said[[name]], fits[[name]]$reason)
  }
  fits
}

#' One given curve: its points on the mesh, its ends at the landmarks, joined by cuts
#'
#' @param tolerance Greatest distance of a point from the mesh, in its unit.
#' @noRd
given_fit <- function(row, xyz, scan, tolerance) {
  xyz <- xyz[!is.na(rowSums(xyz)), , drop = FALSE]
  xyz <- xyz[c(TRUE, row_lengths(diff(xyz)) > 0), , drop = FALSE]
  if (nrow(xyz) < 2) return(new_record(reason = "as given: it has fewer than two points"))
  ends <- list(from = if (is.na(row$cut_share)) scan_place(scan, row$from),
               to = scan_place(scan, row$to))
  ends <- Filter(Negate(failed), ends)
  if (runs_backwards(xyz, ends)) xyz <- xyz[rev(seq_len(nrow(xyz))), , drop = FALSE]
  knots <- surface_points(scan, xyz)
  place <- as.matrix(knots[c("x", "y", "z")])
  off <- row_lengths(place - xyz)
  knots[off > tolerance | c(row_lengths(diff(place)) == 0, FALSE), ] <- NA
  if (!is.null(ends$from)) knots[1, ] <- ends$from
  if (!is.null(ends$to)) knots[nrow(knots), ] <- ends$to
  joined <- join_knots(as.matrix(knots), scan)
  own <- nrow(knots) == row$n
  if (is.null(joined$path) || joined$first > 1 && !own) {
    return(new_record(reason = paste("as given:", joined$problem)))
  }
  points <- if (own) data.frame(knots, s = joined$s) else resample_path(scan, joined$path, row$n)
  points[seq_len(joined$first - 1), ] <- NA
  said <- sprintf("as given: points up to %.2g from the mesh", max(off[joined$first:nrow(xyz)]))
  if (joined$first > 1) {
    said <- sprintf("%s; it begins at point %d of %d: %s", said, joined$first, row$n,
                    joined$problem)
  }
  new_record(points = cbind(points[c(mesh_columns, "s")], se = NA_real_), path = joined$path,
             length = attr(joined$path, "length"), reason = said)
}

#' One given closed curve: its points on the mesh, joined by cuts, from that nearest to its landmark
#' on, and in the direction of the scheme
#'
#' @param tolerance As in [given_fit()].
#' @noRd
given_loop <- function(row, xyz, scan, tolerance) {
  xyz <- xyz[!is.na(rowSums(xyz)), , drop = FALSE]
  n <- nrow(xyz)
  if (n > 1 && all(xyz[1, ] == xyz[n, ])) xyz <- xyz[-n, , drop = FALSE]
  n <- nrow(xyz)
  if (n < 3) return(new_record(reason = "as given: it is closed, and has fewer than three points"))
  knots <- columns_of(surface_points(scan, xyz))
  off <- row_lengths(knots[, 1:3] - xyz)
  joined <- if (max(off) > tolerance) {
    list(problem = sprintf("a point is %.2g from the mesh", max(off)))
  } else {
    join_knots(knots[c(seq_len(n), 1), ], scan)
  }
  if (is.null(joined$path) || joined$first > 1) {
    return(new_record(reason = paste("as given:", joined$problem)))
  }
  path <- joined$path
  attr(path, "closed") <- TRUE
  loop <- directed_loop(row, path, scan)
  if (failed(loop)) return(new_record(reason = sub("\\.$", "", loop$problem)))
  placed <- if (n == row$n) {
    # Points of a loop in its order, from the one nearest to its start on
    length <- attr(loop, "length")
    s <- vapply(seq_len(nrow(knots)), function(i) nearest_along(loop, knots[i, 1:3]), 0)
    # A point at the start may come out at the end.
    s[s > length - min(diff(sort(s))) / 2] <- 0
    order <- order(s)
    frame_of(c(list(s = s[order]), lapply(stats::setNames(nm = mesh_columns),
                                          function(name) knots[order, name])))
  } else spaced_points(scan, loop, row$n)
  new_record(points = cbind(placed[c(mesh_columns, "s")], se = NA_real_), path = loop,
             length = attr(loop, "length"),
             reason = sprintf("as given: points up to %.2g from the mesh", max(off)))
}

#' A closed path that begins where it is nearest to the landmark of a scheme's curve, and runs as
#' the scheme has it
#' @noRd
directed_loop <- function(row, path, scan) {
  stops <- lapply(c(row$from, via_names(row$via)), function(name) scan_place(scan, name))
  lost <- Find(failed, stops)
  if (!is.null(lost)) return(lost)
  path <- begun_at(scan, path, nearest_along(path, stops[[1]][1:3]))
  at <- vapply(stops[-1], function(stop) nearest_along(path, stop[1:3]), 0)
  back <- if (length(at) < 2) seen_turn(scan, path) < 0 else sum(diff(at) < 0) > sum(diff(at) > 0)
  if (back) reversed_loop(scan, path) else path
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
join_knots <- function(knots, scan) {
  last <- nrow(knots)
  pieces <- vector("list", last - 1)
  length <- numeric(last - 1)
  problem <- NULL
  first <- 1
  for (i in rev(seq_len(last - 1))) {
    if (anyNA(knots[c(i, i + 1), ])) {
      piece <- no_result("a point is not on the mesh.", "Trace the curve on this mesh.", "curves")
    } else if (any(knots[i, 1:3] != knots[i + 1, 1:3])) {
      piece <- cut_between(knots[i, ], knots[i + 1, ], scan)
    } else {
      next
    }
    if (failed(piece)) {
      problem <- piece$problem
      first <- i + 1
      break
    }
    pieces[[i]] <- piece
    length[i] <- attr(piece, "length")
  }
  s <- c(0, cumsum(length))
  s[seq_len(first - 1)] <- NA
  rows <- lapply(Filter(Negate(is.null), pieces), columns_of)
  list(path = if (length(rows)) path_through(do.call(rbind, rows), scan), first = first, s = s,
       problem = problem)
}
