# Every curve of a scheme on one specimen: found, cut off where the scheme says so, spaced.

#' Fit the curves of a scheme
#'
#' @param fits List by name of curve of the records that there are, NULL where there is none.
#' @param open Logical, which curves are to be found.
#' @param scan As of [prepare_scan()].
#' @param tick Called after every curve.
#' @return List by name of curve of [new_record()]s, before they are cut off.
#' @noRd
fit_whole_curves <- function(fits, open, scan, tick) {
  rows <- unclass(scan$scheme$curves)
  for (i in scheme_plan(scan$scheme)$order) {
    if (!open[i]) next
    row <- lapply(rows, `[`, i)
    found <- curve_record(row_job(row, row$from, scan, fits), !is.na(row$cut_share))
    # A curve that is to be cut off, and whose ends no cut joins: as much of it as the mesh has.
    near <- if (is.null(found$path) && !is.na(row$cut_share)) scan_place(scan, row$to)
    target <- if (!is.null(near) && !failed(near)) far_target(row$from, scan)
    far_end <- if (!is.null(target)) way_out(scan, near, target$at)
    if (!is.null(far_end)) {
      followed <- sprintf("%s: followed towards %s as far as the mesh goes", found$reason,
                          target$name)
      found <- curve_record(row_job(row, far_end, scan, fits), TRUE)
      found$followed <- followed
      found <- add_note(found, followed)
    }
    fits[[i]] <- found
    tick()
  }
  fits
}

#' Curves cut off where the scheme says so, without what lies on bridges
#'
#' @param whole As of [fit_whole_curves()].
#' @param cut_scale As in [fit_shape()].
#' @noRd
finished_curves <- function(whole, open, scan, cut_scale) {
  whole[open] <- cut_curves(scan, scan$scheme$curves[open, ], whole[open], cut_scale)
  lapply(whole, function(fit) {
    lost <- which(fit$points$face > scan$faces)
    if (!length(lost)) return(fit)
    fit$points[lost, setdiff(names(fit$points), "s")] <- NA
    add_note(fit, sprintf("%d of %d points missing: they lie in a hole of the mesh", length(lost),
                          nrow(fit$points)))
  })
}

#' Curves fitted with the expected tracks of the scheme, and again without where these are of other
#' objects
#'
#' @param scan As of [prepare_scan()].
#' @param tick Called after every curve.
#' @param fit Function of a scan and `tick`, which gives fits.
#' @noRd
by_own_tracks <- function(scan, tick, fit) {
  fits <- fit(scan, tick)
  scheme <- scan$scheme
  if (!NROW(scheme$tracks)) return(fits)
  foreign <- foreign_tracks(scheme,
                            track_departures(scheme, lapply(fits, `[[`, "path"), scan$landmarks))
  if (is.null(foreign)) return(fits)
  crestline_warn(
    sprintf("%d of %d curves leave their expected tracks, which are not used: %s.",
            length(foreign$off), foreign$of, shorten(foreign$off)),
    paste("The tracks may be of another population, or landmarks are wrong. Learn tracks from",
          "specimens like this one, see learn_tracks()."),
    stage = "curves", id = scan$id, class = "crestline_foreign_tracks"
  )
  scan$scheme["tracks"] <- list(NULL)
  fit(scan, function() NULL)
}

#' A curve as a record; in place of a ridge or valley that could not be estimated the shortest cut,
#' or the reason alone
#'
#' @param job As of [row_job()].
#' @param cut Whether it is to be cut off, so that it need not begin on a ridge.
#' @noRd
curve_record <- function(job, cut = FALSE) {
  # Curvature is estimated where the search asks for it: it alone can fail on the way.
  curve <- as_value(trace_curve(job))
  problem <- if (failed(curve)) sub("\\.$", "", curve$problem)
  if (failed(curve) && job$type != "plane" && !isTRUE(job$ends$closed)) {
    job$type <- job$route <- "plane"
    job[c("source", "regions")] <- list(NULL)
    job$search <- if (!failed(job$ends)) job$ends$scan$search
    curve <- trace_curve(job)
  }
  if (failed(curve)) return(new_record(reason = problem))
  record <- new_record(
    points = curve$points[c(mesh_columns, "s", "se")], path = curve$path, length = curve$length,
    strength = curve$strength, contrast = curve_contrast(curve), se = curve$se,
    se_max = largest(curve$points$se),
    competing = c(attr(curve$reference, "competing"), NA)[1], determined = curve$determined,
    reason = curve$reason, noise_factor = curve$noise_factor,
    remark = if (curve$type == "plane") NA_character_ else curve_remark(curve, c(cut, FALSE))
  )
  if (is.null(problem)) return(record)
  record$reason <- paste("the shortest cut instead:", problem)
  record$determined <- FALSE
  record
}

#' What a row of the curves table asks for, as of [curve_job()]; what is not there are failures
#'
#' @param from Its first end: a landmark, or a place on the mesh.
#' @noRd
row_job <- function(row, from, scan, fits) {
  # A scheme of a former version, whose curves all go by plane cuts
  if (is.null(row$path)) row[c("path", "via")] <- list("plane", NA_character_)
  via <- lapply(via_names(row$via), function(name) scan_place(scan, name))
  places <- c(list(if (is.character(from)) scan_place(scan, from) else from,
                   scan_place(scan, row$to)), via)
  lost <- Find(failed, places)
  ends <- if (is.null(lost)) path_ends(scan, do.call(rbind, places[1:2]),
                                       c(end_name(from), row$to), do.call(rbind, via))
  route <- curve_route()
  route$trust <- c(row$trust_from, row$trust_to)
  route$path <- row$path
  job <- curve_job(if (is.null(lost)) ends else lost, row$kind, row$n, scan$settings, row$radius,
                   row$width, route = route, angle_limit = row$angle_limit)
  if (row$kind == "plane") return(job)
  job$source <- scan$sources[[as.character(row$radius)]]
  if (!is.na(row$side_of)) job$source <- on_side(job$source, row, scan, fits[[row$side_of]])
  # The regions of a row, NULL where it has none
  region <- function(class, fields) {
    if (is.na(row[[paste0(class, "_from")]])) return(NULL)
    structure(stats::setNames(row[paste0(class, "_", fields)], fields), class = class)
  }
  regions <- list(region("keep_away", c("from", "to", "radius", "extension")),
                  region("keep_side", c("from", "to", "towards")))
  locate <- function(name, end) {
    at <- scan_place(scan, name)
    if (failed(at)) at else at[c("x", "y", "z")]
  }
  regions <- Filter(Negate(is.null), regions)
  job$regions <- if (length(regions)) located_regions(regions, locate, scan$id)
  if (is.character(from)) job$track <- expected_track(scan$scheme, row, scan$landmarks)
  job
}

#' Curvature with none on the wrong side of another curve
#' @noRd
on_side <- function(source, row, scan, other) {
  if (is.null(other$path)) {
    return(no_result(sprintf("the curve whose side it keeps to, %s, was not found.", row$side_of),
                       "Mend that curve first.", "curves", scan$id, "crestline_path_error"))
  }
  reach <- attr(other$path, "length") / 2 + row$radius
  near <- near_path(scan, other$path, reach, row$radius)
  wrong <- if (row$side == "left") near$d <= 0 else near$d >= 0
  without_curvature(source, near$vertex[wrong])
}

#' Curvature with none at some vertices
#' @noRd
without_curvature <- function(source, vertex) {
  force(source)
  function(vertices) {
    curved <- source(vertices)
    none <- vertices %in% vertex & !is.na(curved$k1)
    curved$k1[none] <- 0
    curved$k2[none] <- 0
    curved
  }
}

# The curves of a scheme while landmarks move: fitted anew are those that a move touches.

#' Begin to fit the curves of a scheme again and again
#'
#' @param specimen,scheme,settings,bridge,threads As in [fit_shape()].
#' @return List: `scheme`, `scan` of
#'   [prepare_scan()] (its sources of curvature keep what they have estimated), `whole` and `fits`
#'   (by curve, before and after they are cut off; as yet none).
#' @noRd
begin_fitting <- function(specimen, scheme, settings, bridge, threads) {
  none <- stats::setNames(vector("list", nrow(scheme$curves)), scheme$curves$curve)
  column <- list(bridge = bridge)
  list(scheme = scheme, scan = prepare_scan(specimen, scheme, settings, column, threads),
       whole = none, fits = none)
}

#' Fit those curves anew that a moved landmark touches
#'
#' @param fitting As of [begin_fitting()].
#' @param specimen The specimen with its landmarks as they are now.
#' @param moved Names of the landmarks that have moved, NULL for all curves.
#' @param progress Function of the number of curves to be fitted, which gives a function that is
#'   called after each.
#' @return `fitting`, with `fits` as [fit_shape()] has them for this specimen, and `refitted`, the
#'   names of the curves that were fitted anew.
#' @noRd
refit_curves <- function(fitting, specimen, moved = NULL, progress = function(n) function() NULL) {
  scheme <- fitting$scheme
  touched <- touched_curves(scheme$curves, moved, fitting$whole, scheme$tracks$curve)
  scan <- fitting$scan
  scan$specimen <- specimen
  scan$bridged <- with_landmarks_of(scan$bridged, specimen)
  placed <- scan_landmarks(scan)
  scan[names(placed)] <- placed
  fitting$scan <- scan
  every <- rep(TRUE, nrow(scheme$curves))
  fitting$fits <- by_own_tracks(scan, progress(sum(touched)), function(scan, tick) {
    fitting$whole <<- fit_whole_curves(fitting$whole, touched, scan, tick)
    finished_curves(fitting$whole, every, scan, 1)
  })
  fitting$refitted <- scheme$curves$curve[touched]
  fitting
}

#' Fit the curves of a scheme that has changed: those whose rows are new or differ
#'
#' @param before As of [begin_fitting()], of the scheme as it was; NULL: none.
#' @param after As of [begin_fitting()], of the scheme as it is.
#' @param progress As in [refit_curves()].
#' @return As [refit_curves()].
#' @noRd
grow_fitting <- function(before, after, progress = function(n) function() NULL) {
  known <- intersect(names(after$scan$sources), names(before$scan$sources))
  after$scan$sources[known] <- before$scan$sources[known]
  rows <- after$scheme$curves
  same <- vapply(seq_len(nrow(rows)), function(i) {
    at <- match(rows$curve[i], before$scheme$curves$curve)
    !is.na(at) && identical(lapply(rows[i, ], identity),
                            lapply(before$scheme$curves[at, names(rows)], identity))
  }, NA)
  # Whether a track is of other objects depends on all curves.
  same <- same & !rows$curve %in% after$scheme$tracks$curve
  after$whole[same] <- before$whole[rows$curve[same]]
  after$fits <- by_own_tracks(after$scan, progress(sum(!same)), function(scan, tick) {
    after$whole <<- fit_whole_curves(after$whole, !same, scan, tick)
    finished_curves(after$whole, rep(TRUE, nrow(rows)), scan, 1)
  })
  after$refitted <- rows$curve[!same]
  after
}

with_landmarks_of <- function(bridged, specimen) {
  bridged$landmarks <- specimen$landmarks
  bridged$geometry[c("landmarks", "located")] <- specimen$geometry[c("landmarks", "located")]
  bridged
}

#' Which curves depend on landmarks that have moved
#'
#' A curve depends on the landmarks of its ends, regions and sides, and of the curve whose side it
#' keeps to. An expected track depends on all landmarks. So does a curve that is followed towards a
#' landmark that is not on the mesh: the mirror plane gives the direction.
#' @param whole Fits as they are, before they are cut off.
#' @param tracked Names of the curves with an expected track.
#' @return Logical, by row of `curves`.
#' @noRd
touched_curves <- function(curves, moved, whole, tracked = NULL) {
  if (is.null(moved)) return(rep(TRUE, nrow(curves)))
  by_name <- c("from", "to", "keep_away_from", "keep_away_to", "keep_side_from", "keep_side_to",
               "keep_side_towards")
  named <- Reduce(`|`, lapply(curves[by_name], `%in%`, moved)) |
    vapply(curves$via, function(cell) any(via_names(cell) %in% moved), NA, USE.NAMES = FALSE)
  unsettled <- vapply(whole, function(fit) is.null(fit$path) || !is.na(fit$followed), NA)
  touched <- named | unsettled & !is.na(curves$cut_share) |
    curves$curve %in% tracked & length(moved)
  for (i in fitting_order(curves)) {
    if (curves$side_of[i] %in% curves$curve[touched]) touched[i] <- TRUE
  }
  touched
}

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

#' How far the points of a given curve were from the mesh; "on the mesh" as far as numbers hold
#'
#' @param off Greatest distance. @param rounding Of co-ordinates, as a share of their size.
#' @noRd
given_reason <- function(off, scan, rounding = 1e-12) {
  size <- max(abs(scan$specimen$mesh$vb[1:3, ]))
  if (off <= rounding * size) return("as given: points on the mesh")
  sprintf("as given: points up to %.2g from the mesh", off)
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
  said <- given_reason(max(off[joined$first:nrow(xyz)]), scan)
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
             reason = given_reason(max(off), scan))
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
