# Every curve of a scheme on one specimen: found, cut off where the scheme says so, spaced.

#' A curve of a scheme on one specimen: all its fields are declared here
#'
#' @param points Data frame of n rows: x, y, z, face, w1, w2, w3, s, se; NA where the mesh ends
#'   before; NULL where the curve failed.
#' @param path,length,strength,contrast,se,se_max,competing,determined Of the curve.
#' @param reason What there is to say, NA where nothing.
#' @param cut Of curves that are cut off: their share of the length asked for.
#' @param guessed Of these: whether way or length did without a landmark on the mesh.
#' @param track Of these: list of the whole `path`, `start` (arc length there of the first point),
#'   `kept` (length asked for).
#' @param followed Of these: what it was followed towards, NA where it was joined to both ends.
#' @noRd
new_record <- function(points = NULL, path = NULL, length = NA_real_, strength = NA_real_,
                       contrast = NA_real_, se = NA_real_, se_max = NA_real_,
                       competing = NA_real_, determined = NA, reason = NA_character_,
                       cut = NA_real_, guessed = NA, track = NULL, followed = NA_character_) {
  list(points = points, path = path, length = length, strength = strength, contrast = contrast,
       se = se, se_max = se_max, competing = competing, determined = determined, reason = reason,
       cut = cut, guessed = guessed, track = track, followed = followed)
}

#' Fit the curves of a scheme
#'
#' @param scan As of [prepare_scan()].
#' @param scheme,cut_scale As in [fit_shape()].
#' @param given Records of curves that are not to be found, see [given_fits()].
#' @param tick Called after every curve.
#' @return List by name of curve of [new_record()]s.
#' @noRd
fit_scheme_curves <- function(scan, scheme, given, cut_scale, tick) {
  curves <- scheme$curves
  whole <- stats::setNames(vector("list", nrow(curves)), curves$curve)
  whole[names(given)] <- given
  open <- !curves$curve %in% names(given)
  whole <- fit_whole_curves(whole, open, scan, scheme, tick)
  finished_curves(whole, open, scan, scheme, cut_scale)
}

#' Curves before they are cut off
#'
#' @param fits List by name of curve of the records that there are.
#' @param open Logical, which are to be found.
#' @noRd
fit_whole_curves <- function(fits, open, scan, scheme, tick) {
  for (i in fitting_order(scheme$curves)) {
    if (!open[i]) next
    fits[[i]] <- fit_or_follow(as.list(scheme$curves[i, ]), scan, scheme$pairs, fits)
    tick()
  }
  fits
}

#' Curves cut off where the scheme says so, without what lies on bridges
#' @noRd
finished_curves <- function(whole, open, scan, scheme, cut_scale) {
  whole[open] <- cut_curves(scan, scheme$curves[open, ], scheme$pairs, whole[open], cut_scale)
  lapply(whole, without_bridges, scan$faces)
}

#' A curve; where no cut joins its ends and it is to be cut off, as much of it as the mesh has
#'
#' @param row Row of the curves table, a list.
#' @param fits Records of the curves before.
#' @noRd
fit_or_follow <- function(row, scan, pairs, fits) {
  found <- fit_or_cut(row, scan, fits)
  far <- if (is.null(found$path) && !is.na(row$cut_share)) far_end(row, scan, pairs)
  if (is.null(far)) return(found)
  row$from <- far$end
  followed <- sprintf("%s: followed towards %s as far as the mesh goes", found$reason, far$name)
  found <- fit_or_cut(row, scan, fits)
  found$followed <- followed
  add_note(found, followed)
}

#' A curve, or the shortest cut in place of a ridge or valley that could not be estimated, or the
#' reason alone
#' @noRd
fit_or_cut <- function(row, scan, fits) {
  found <- fit_scheme_curve(row, scan, fits)
  if (!failed(found)) return(found)
  problem <- sub("\\.$", "", found$problem)
  if (row$kind == "plane") return(new_record(reason = problem))
  row$kind <- "plane"
  cut <- fit_scheme_curve(row, scan, fits)
  if (failed(cut)) return(new_record(reason = problem))
  cut$reason <- paste("the shortest cut instead:", problem)
  cut$determined <- FALSE
  cut
}

#' A curve comes after the one whose side it keeps to
#' @noRd
fitting_order <- function(curves) {
  before <- match(curves$side_of, curves$curve)
  depth <- integer(nrow(curves))
  at <- before
  while (!all(is.na(at))) {
    depth <- depth + !is.na(at)
    at <- before[at]
  }
  order(depth)
}

#' One curve of a scheme as a record, or a failure
#' @noRd
fit_scheme_curve <- function(row, scan, fits) {
  curved <- row$kind != "plane"
  source <- if (curved) scan$sources[[as.character(row$radius)]]
  if (curved && !is.na(row$side_of)) source <- on_side(source, row, scan, fits[[row$side_of]])
  if (failed(source)) return(source)
  ends <- scan_ends(scan, row$from, row$to)
  if (failed(ends)) return(ends)
  job <- curve_job(row$kind, row$n, end_name(row$from), row$to, scan$settings, scan$passes,
                   row$radius, row$width, source, if (curved) row_regions(row, scan),
                   c(row$trust_from, row$trust_to), row$angle_limit)
  # Curvature is estimated where the search asks for it: it alone can fail on the way.
  curve <- as_value(trace_curve(scan, ends, job))
  if (failed(curve)) return(curve)
  new_record(points = curve$points[c(mesh_columns, "s", "se")], path = curve$path,
             length = curve$length, strength = curve$strength, contrast = curve_contrast(curve),
             se = curve$se, se_max = largest(curve$points$se),
             competing = c(attr(curve$reference, "competing"), NA)[1],
             determined = curve$determined, reason = curve$reason)
}

#' The regions of a row, NULL where it has none
#' @noRd
row_regions <- function(row, scan) {
  regions <- list(
    if (!is.na(row$keep_away_from)) {
      structure(list(from = row$keep_away_from, to = row$keep_away_to,
                     radius = row$keep_away_radius, extension = row$keep_away_extension),
                class = "keep_away")
    },
    if (!is.na(row$keep_side_from)) {
      structure(list(from = row$keep_side_from, to = row$keep_side_to,
                     towards = row$keep_side_towards), class = "keep_side")
    }
  )
  regions <- Filter(Negate(is.null), regions)
  locate <- function(name, end) {
    at <- scan_place(scan, name)
    if (failed(at)) at else at[c("x", "y", "z")]
  }
  if (length(regions)) located_regions(regions, scan, locate)
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

#' A curve without its points on bridges over holes
#'
#' @param faces Number of faces that are not bridges.
#' @noRd
without_bridges <- function(fit, faces) {
  lost <- which(fit$points$face > faces)
  if (!length(lost)) return(fit)
  fit$points[lost, setdiff(names(fit$points), "s")] <- NA
  add_note(fit, sprintf("%d of %d points missing: they lie in a hole of the mesh", length(lost),
                        nrow(fit$points)))
}
