# Every curve of a scheme on one specimen: found, cut off where the scheme says so, spaced.

#' Fit the curves of a scheme
#'
#' @param specimen The specimen with its holes bridged, `scan` as it is.
#' @param scheme,settings,passes,threads,cut_scale As in [fit_shape()].
#' @param given Fits of curves that are not to be found, see [given_fits()].
#' @param tick Called after every curve.
#' @return List by name of curve; each a list of `points` (data frame of n rows: x, y, z, face, w1,
#'   w2, w3, s, se; NA where the mesh ends before), `path`, `length`, `strength`, `contrast`, `se`,
#'   `se_max`, `competing`, `determined`, `cut` (of curves that are cut off: their share of the
#'   length asked for), `guessed` (of these: whether way or length did without a landmark on the
#'   mesh), `reason` (NA where there is nothing to say) or, where it failed, of `reason` alone.
#' @noRd
fit_scheme_curves <- function(specimen, scan, scheme, settings, passes, threads, cut_scale, given,
                              tick) {
  curves <- scheme$curves
  sources <- scheme_curvatures(scan, curves, settings, threads)
  whole <- stats::setNames(vector("list", nrow(curves)), curves$curve)
  whole[names(given)] <- given
  open <- !curves$curve %in% names(given)
  whole <- fit_whole_curves(whole, open, specimen, scheme, sources, settings, passes, tick)
  finished_curves(whole, open, specimen, ncol(scan$mesh$it), scheme, cut_scale)
}

#' Curves before they are cut off
#'
#' @param fits List by name of curve of the fits that there are.
#' @param open Logical, which are to be found.
#' @param sources As of [scheme_curvatures()].
#' @noRd
fit_whole_curves <- function(fits, open, specimen, scheme, sources, settings, passes, tick) {
  curves <- scheme$curves
  fit <- function(row) {
    suppressWarnings(fit_scheme_curve(row, specimen, sources, fits, settings, passes),
                     classes = "crestline_warning")
  }
  for (i in fitting_order(curves)) {
    if (!open[i]) next
    fits[[i]] <- fit_or_follow(as.list(curves[i, ]), specimen, scheme$pairs, fit)
    tick()
  }
  fits
}

#' Curves cut off where the scheme says so, without what lies on bridges
#' @noRd
finished_curves <- function(whole, open, specimen, faces, scheme, cut_scale) {
  whole[open] <- cut_curves(specimen, scheme$curves[open, ], scheme$pairs, whole[open], cut_scale)
  lapply(whole, without_bridges, faces)
}

#' A curve; where no cut joins its ends and it is to be cut off, as much of it as the mesh has
#' @noRd
fit_or_follow <- function(row, specimen, pairs, fit) {
  attempt <- function(row) {
    tryCatch(fit(row), crestline_error = function(e) {
      if (is_of_the_call(e)) rlang::cnd_signal(e)
      cut_instead(row, sub("\\.$", "", e$problem), fit)
    })
  }
  found <- attempt(row)
  far <- if (is.null(found$path) && !is.na(row$cut_share)) far_end(row, specimen, pairs)
  if (is.null(far)) return(found)
  row$from <- far$end
  followed <- sprintf("%s: followed towards %s as far as the mesh goes", found$reason, far$name)
  found <- attempt(row)
  found$followed <- followed
  add_note(found, followed)
}

#' Whether an error tells of wrong arguments or objects, which no cut in a curve's place would mend
#' @noRd
is_of_the_call <- function(e) {
  objects <- c("crestline_wrong_mesh", "crestline_mesh_error", "crestline_changed_specimen")
  identical(e$stage, "arguments") || inherits(e, objects)
}

#' The shortest cut in place of a ridge or valley that could not be estimated, or the reason alone
#' @noRd
cut_instead <- function(row, problem, fit) {
  failed <- list(reason = problem)
  if (row$kind == "plane") return(failed)
  row$kind <- "plane"
  cut <- tryCatch(fit(row), crestline_error = function(e) {
    if (is_of_the_call(e)) rlang::cnd_signal(e)
    failed
  })
  if (is.null(cut$path)) return(cut)
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

#' Curvature for all curves of one radius, estimated where they ask for it
#'
#' @return List by radius of functions as of [curvature_source()].
#' @noRd
scheme_curvatures <- function(specimen, curves, settings, threads) {
  radius <- unique(curves$radius[curves$kind != "plane"])
  sources <- lapply(radius, function(r) {
    tryCatch({
      source <- curvature_source(specimen, r, settings$order, threads)
      function(vertices) {
        own <- vertices <= ncol(specimen$mesh$vb)
        curvature_rows(source(vertices[own]), ifelse(own, cumsum(own), NA))
      }
    }, crestline_error = function(e) function(vertices) rlang::cnd_signal(e))
  })
  stats::setNames(sources, radius)
}

fit_scheme_curve <- function(row, specimen, sources, fits, settings, passes) {
  curve <- if (row$kind == "plane" && is.na(row$angle_limit)) {
    ridge_curve(specimen, row$from, row$to, "plane", n = row$n)
  } else if (row$kind == "plane") {
    path <- limited_reference(row, specimen, NULL, NULL, settings)
    assembled_curve(specimen, path, path, row$n, about_curve(row, specimen, settings, passes))
  } else {
    fit_curved(row, specimen, sources[[as.character(row$radius)]], fits, settings, passes)
  }
  list(points = curve$points[c(mesh_columns, "s", "se")], path = curve$path, length = curve$length,
       strength = curve$strength, contrast = curve_contrast(curve), se = curve$se,
       se_max = largest(curve$points$se),
       competing = c(attr(curve$reference, "competing"), NA)[1], determined = curve$determined,
       reason = curve$reason)
}

#' A ridge or valley with the constraints of its row
#' @noRd
fit_curved <- function(row, specimen, curvature, fits, settings, passes) {
  away <- kept_away(row)
  if (!is.na(row$side_of)) curvature <- on_side(curvature, row, specimen, fits[[row$side_of]])
  free <- is.na(row$angle_limit) && row$trust_from == 0 && row$trust_to == 1
  if (free) {
    return(ridge_curve(specimen, row$from, row$to, row$kind, row$radius, row$width, row$n, away,
                       settings, passes,
                       curvature))
  }
  path <- if (is.na(row$angle_limit)) {
    reference_path(specimen, row$from, row$to, row$kind, row$radius, away, curvature,
                   longest = settings$longest)
  } else {
    limited_reference(row, specimen, curvature, away, settings)
  }
  about <- about_curve(row, specimen, settings, passes)
  path <- trusted_path(c(row$trust_from, row$trust_to), specimen, path)
  fit <- fit_passes(specimen, path, curvature, away, about)
  assembled_curve(specimen, fit$path, fit$reference, row$n, about, fit)
}

#' The regions of a row, NULL where it has none
#' @noRd
kept_away <- function(row) {
  c(if (!is.na(row$keep_away_from)) {
    list(keep_away(row$keep_away_from, row$keep_away_to, row$keep_away_radius,
                   row$keep_away_extension))
  }, if (!is.na(row$keep_side_from)) list(keep_side(row$keep_side_from, row$keep_side_to,
                                                    row$keep_side_towards)))
}

about_curve <- function(row, specimen, settings, passes) {
  list(id = specimen$id, from = end_name(row$from), to = row$to, type = row$kind,
       settings = settings, passes = passes,
       radius = row$radius, width = row$width)
}

#' Reference path among the angles that a row allows
#'
#' @param angles Number of angles.
#' @param reach,spacing As in [reference_path()].
#' @noRd
limited_reference <- function(row, specimen, curvature, away, settings, angles = 61, reach = 0.5,
                              spacing = 0.25) {
  surface <- walkable(specimen)
  ends <- path_ends(specimen, surface, row$from, row$to)
  if (is.null(curvature)) return(limited_cut(surface, ends, row$angle_limit, angles, reach))
  strength <- path_strength(curvature, row$kind, away, specimen)
  rate <- function(axis, found) cut_strength(surface, ends, axis, found, reach,
                                             spacing * row$radius, strength)
  limited_cut(surface, ends, row$angle_limit, angles, reach, rate, settings$longest)
}

#' Curvature with none on the wrong side of another curve
#' @noRd
on_side <- function(curvature, row, specimen, other) {
  if (is.null(other$path)) {
    crestline_abort(sprintf("the curve whose side it keeps to, %s, was not found.", row$side_of),
                    "Mend that curve first.", stage = "curves", id = specimen$id,
                    class = "crestline_path_error")
  }
  reach <- attr(other$path, "length") / 2 + row$radius
  near <- path_coordinates(specimen, other$path, reach, margin = row$radius)
  wrong <- if (row$side == "left") near$d <= 0 else near$d >= 0
  without_curvature(curvature, near$vertex[wrong])
}

#' Curvature with none at some vertices
#' @noRd
without_curvature <- function(curvature, vertex) {
  force(curvature)
  function(vertices) {
    curved <- curvature(vertices)
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
