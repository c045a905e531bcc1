# A whole specimen measured by a scheme: landmarks, curves, surface, and how each of them went.

#' Measure a specimen by a scheme
#'
#' Finds every curve of the scheme, trims the curves that the scheme cuts off, and spaces the points
#' of all. Then it puts the points of the patches between the curves. If a landmark or curve is
#' missing, only the points that depend on it are NA. `status` gives the reason, see below.
#' [crestline-package] has a glossary.
#'
#' Curvature is estimated once for all curves of one radius. Some ridges and valleys are not
#' determined by curvature, see [ridge_curve()]: they keep their estimate. A window with too few
#' vertices gives no estimate: the curve is then the shortest plane cut. If a trimmed curve is
#' shorter than its share, all trimmed curves are cut at the same smaller multiple of their shares.
#' `reason` names each of these cases.
#'
#' A column of a patch is the shortest plane cut between two points of its bounding curves. Only
#' planes near the surface's normal are tried. The points of a column have equal chords. On a sharp
#' rim the surface normals at the two ends are unreliable. There the patch's `outward` setting (the
#' order of its corners) tells which side is outside, and the cut follows that side. All points lie
#' on the mesh. Points that coincide by construction are stored once and agree exactly. Flipped or
#' crossing triangles of the model are named in the `reason` of the patch at which they begin, see
#' [surface_faults()].
#'
#' @param specimen A [specimen()].
#' @param scheme A [curve_scheme()], such as [face_scheme()].
#' @param settings [ridge_settings()] of all curves; `error = FALSE` saves the time of standard
#'   errors.
#' @param passes As in [ridge_curve()].
#' @param curves Curves drawn by hand or found by other software: a named list (names of the
#'   scheme's curves) of n x 3 matrices, data frames with columns x, y, z, or values of
#'   [ridge_curve()], such as the attribute `curves` of [read_landmarks()]. They may run either way
#'   round. They are put on the mesh (nearest points, joined by cuts), and are neither searched for
#'   nor cut off. Their ends are moved to their landmarks. A curve with as many points as the scheme
#'   asks for keeps them. Any other gets points at equal chords. Curves that are not in the list are
#'   searched for.
#' @param cut_scale Multiplies the length at which trimmed curves are cut (no unit). Use one value
#'   below 1 for all specimens if some scans are too short. It is lowered where a curve is too short
#'   for it.
#' @param bridge Holes up to this size (diagonal of the bounding box, as a share of the object's
#'   size) are bridged by flat triangles, so that curves and columns run on where the surface would
#'   be. Their points there are missing. Curves and columns run round larger holes, and with 0 round
#'   all.
#' @param column_angle Greatest angle in radians between a column's plane and that of the mean of
#'   the surface normals at its ends (the programs of the paper's authors: 45 degrees).
#' @param column_angles Number of planes that are tried for a column (there: 51).
#' @param column_reach A column stays within this share of the distance of its ends from the
#'   straight line between them (there: 1).
#' @param unit Factor from the mesh's unit to that of the scheme's lengths: 1000 for a scan in
#'   metres and [face_scheme()]. NULL: that of [find_landmarks()] where the landmarks were found,
#'   else 1.
#' @param progress Whether to show a progress bar.
#' @inheritParams curvature
#' @return Object of class `shape`, a list:
#'   * `id`: of the specimen;
#'   * `points`: data frame, a row a point in the order of the scheme: `level` ("landmarks",
#'     "curves", "surface"), `part`, `point` (text), `x`, `y`, `z`, `face`, `w1`, `w2`, `w3` (all NA
#'     where missing), `se` (standard error across the curve, in the unit of the mesh; NA where
#'     there is none: landmarks, plane curves, insides of patches);
#'   * `status`: data frame, a row a landmark, curve and patch: `part`, `level`, `kind` ("landmark",
#'     "ridge", "valley", "plane", "patch"), `ok` (whether all its points are there), `reason`
#'     (text, NA where all is well), and of curves `length` (as cut off), `strength` (mean, as
#'     found, 1 / unit), `contrast` (strength over the mean strength beside the curve, in its window
#'     but farther than `settings$core` radii from it: 1, no more than its surroundings), `se`
#'     (median), `competing` (how good the best other reference path is, as a share of the one
#'     chosen: near 1, a rival; NA: none), `se_max` (largest standard error at its points);
#'   * `checks`: data frame, a row for each of `status`, with what [quality()] judges by: `part`,
#'     `level`, `missing` (share of the points); of curves `determined` (by curvature, see
#'     [ridge_curve()]; NA where there is no point but landmarks), `cut` (what was left of a curve
#'     that the scheme cuts off, as a share of what was asked for), `guessed` (TRUE if a trimmed
#'     curve had to be directed or measured without one of its landmarks, see below), `bridged`
#'     (share of its length that lies over holes); of patches `faults` (number of them, see
#'     [surface_faults()]); of both `size` (a curve's length; of a patch the diameter of a disc with
#'     points as far from their centroid), `roughness` (mean angle in degrees between the normals of
#'     its triangles and those at their corners), `edge` (mean edge of its triangles), `border`
#'     (distance to the nearest border that is not bridged, but for the ends of a curve), `spike`
#'     (distance within which there are four triangles with such an angle above 30 degrees); lengths
#'     in the unit of the mesh, Inf where there is none; of landmarks `state` and `confidence` (of
#'     [find_landmarks()], NA where they were given) and `exchanged` (what other landmark it looks
#'     exchanged with, text);
#'   * `paths`: list by curve of `mesh_path`s, as cut off, over holes straight from rim to rim;
#'     `NULL` where it failed;
#'   * `scheme`, its lengths in the unit of the mesh;
#'   * `provenance`: what it came from, see [summary.shape()];
#'   * `key`: of the specimen's mesh, see [specimen()]; what takes a shape and a specimen refuses
#'     another mesh, and one whose vertices or triangles stand in another order, by name (an error
#'     of class `crestline_wrong_mesh`);
#'   * `tracks`, `column`, `specimen`: kept for [slide()], and needed by nothing else
#'     (`shape$specimen <- NULL` makes the shape small).
#'
#'   `as.data.frame(shape)` gives the points; see also [coords()], [shape_mesh()] and
#'   [plot.shape()].
#' @section Missing parts: If a landmark or curve is missing, only the points that depend on it are
#'   NA. `status` gives the reason.
#'   * Where a landmark is absent or NA, the curves that end there and the columns that begin on
#'     them are missing.
#'   * A curve that is cut off (`cut_share`) keeps only the part next to its end `to`, and needs no
#'     more of the mesh. Its other landmark may lie outside the scan (an ear). The curve then runs
#'     towards it as far as the mesh goes: towards the landmark's own co-ordinates where it has any
#'     (`specimen$landmarks["tL", ] <- ...` after [specimen()] lets it lie off the mesh), else
#'     towards the mirror image of its pair. The points keep the places that they would have on the
#'     whole curve. Points beyond the mesh are missing. A smaller `cut_scale` gives all of them a
#'     place.
#'   * Shares are measured between the two landmarks of a pair. On half a face one of them is
#'     missing. Twice the distance of the other from the mirror plane is then taken. The mirror
#'     plane is square to the directions between left and right. Without a whole pair, it runs
#'     through the landmarks of the middle.
#'   * The points inside a hole are missing, see `bridge`. Take triangles that you do not trust out
#'     of the mesh beforehand, such as long ones over unseen parts: then they are a hole.
#' @section Errors: of class `crestline_error`, when specimen or scheme are not what they should be;
#'   of class `crestline_unit_error`, when the landmarks are not about as far apart as those of the
#'   scheme, with the `unit` to give.
#' @section Warnings: of class `crestline_exchanged`, which names landmarks that look exchanged
#'   (`crestline_mirrored`: left and right of all pairs). [quality()] grades them, and the curves
#'   that end there, red. Of class `crestline_unused_landmarks`, when a landmark of the scheme is
#'   missing and the specimen has one of another name that may be meant (`prn` for `pn`, `CHL` for
#'   `chL`).
#' @templateVar where section 4
#' @template paper
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' shape <- fit_shape(face, face_scheme())
#' shape
#' head(coords(shape, "curves"))
#' }
#' @export
fit_shape <- function(specimen, scheme = face_scheme(), settings = ridge_settings(), passes = NULL,
                      curves = NULL, cut_scale = 1, bridge = 0.2,
                      column_angle = pi / 4, column_angles = 51, column_reach = 1, unit = NULL,
                      threads = getOption("crestline.threads", 1L), progress = interactive()) {
  check_given()
  check_flags(progress)
  if (!is.null(passes)) passes <- check_count(passes, "passes", upper = 1000)
  threads <- check_threads(threads)
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  named <- scheme
  if (is.null(unit)) unit <- c(specimen$match$unit, 1)[1]
  scheme <- scheme_in_unit(scheme, unit, specimen)
  check_fits_scheme(specimen, scheme, unit)
  warn_unused_names(specimen, scheme, paste("the scheme", scheme$name))
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  cut_scale <- check_number(cut_scale, "cut_scale", lower = 0, open = TRUE)
  column <- check_column(column_angle, column_angles, column_reach)
  column$bridge <- check_number(bridge, "bridge", 0, 1)
  specimen <- with_located(specimen)
  if (!is.null(specimen$placing)) specimen$placing <- current_placing(specimen)
  scan <- prepare_scan(specimen, scheme, settings, passes, column, threads)
  tick <- progress_ticks(
    progress, nrow(scheme$curves) - length(curves) + nrow(scheme$patches), specimen$id
  )
  given <- if (length(curves)) given_fits(scan, curves)
  slips <- scheme_slips(specimen, scheme)
  fits <- stats::setNames(vector("list", nrow(scheme$curves)), scheme$curves$curve)
  fits[names(given)] <- given
  open <- !names(fits) %in% names(given)
  fits <- finished_curves(fit_whole_curves(fits, open, scan, tick), open, scan, cut_scale)
  patches <- fit_scheme_patches(scan, fits, place_store(scan, fits), tick)
  shape <- new_shape(
    specimen$id, shape_points(scheme, patches$store), shape_status(scan, fits, patches$problems),
    scheme, paths = lapply(fits, function(fit) unbridged_path(fit$path, specimen)),
    tracks = curve_tracks(fits, scan), column = column, specimen = specimen,
    provenance = shape_provenance(specimen, named, unit, scan, cut_scale, names(curves))
  )
  triangles <- triangles_there(scheme$triangles, shape$points, "model")
  faults <- if (nrow(triangles)) {
    faults_among(triangles, shape$points[shape$points$level == "surface", ], specimen$mesh)
  }
  shape <- note_slips(note_faults(shape, faults), slips)
  shape$checks <- cbind(shape_checks(shape, scan, fits, faults),
                        landmark_checks(shape, specimen$placing, slips))
  shape
}

#' Where a measured shape came from, see [summary.shape()]
#'
#' @param scheme As it was given, before its lengths were brought to the unit of the mesh.
#' @param unit Factor that its lengths were divided by.
#' @param scan As of [prepare_scan()].
#' @param given Names of the curves that were given.
#' @noRd
shape_provenance <- function(specimen, scheme, unit, scan, cut_scale, given) {
  origin <- origin_of(specimen)
  column <- scan$column
  fit <- list(passes = scan$passes, cut_scale = cut_scale, bridge = column$bridge,
              column_angle = column$angle, column_angles = column$angles,
              column_reach = column$reach, given = as.character(given))
  c(made_with(), list(
    scheme = c(scheme_provenance(scheme), unit = unit), mesh = mesh_provenance(specimen),
    landmarks = origin[origin$landmark %in% scheme$landmarks$landmark, ],
    settings = list(ridge = lapply(unclass(scan$settings), identity), fit = fit)
  ))
}

progress_ticks <- function(progress, n, id) {
  if (!progress) return(function() NULL)
  bar <- cli::cli_progress_bar(paste("Measuring", id), total = n, .envir = parent.frame())
  function() cli::cli_progress_update(id = bar)
}

#' Every place of a scheme, those of landmarks and curves filled in
#'
#' @return Matrix, a row a place (row names), columns x, y, z, face, w1, w2, w3, se.
#' @noRd
place_store <- function(scan, fits) {
  scheme <- scan$scheme
  plan <- scheme_plan(scheme)
  store <- matrix(NA_real_, length(plan$places), 8,
                  dimnames = list(plan$places, c(mesh_columns, "se")))
  store[plan$at[scheme$points$level == "landmarks"], mesh_columns] <- scan$points
  found <- Filter(function(fit) !is.null(fit$points), fits)
  if (!length(found)) return(store)
  values <- do.call(rbind,
                    lapply(found, function(fit) columns_of(fit$points, c(mesh_columns, "se"))))
  place <- plan$at[scheme$points$level == "curves" & scheme$points$part %in% names(found)]
  first <- !duplicated(place)
  fill_store(store, place[first], values[first, , drop = FALSE])
}

shape_points <- function(scheme, store) {
  at <- as.data.frame(store[scheme_plan(scheme)$at, ], row.names = FALSE)
  at$face <- as.integer(at$face)
  rownames(at) <- NULL
  cbind(scheme$points[c("level", "part", "point")], at)
}

shape_status <- function(scan, fits, problems) {
  scheme <- scan$scheme
  of_curve <- function(name) {
    vapply(fits, function(fit) if (is.null(fit$path)) NA_real_ else fit[[name]], 0,
           USE.NAMES = FALSE)
  }
  blocks <- split(problems, factor(scheme$patches$patch, unique(scheme$patches$patch)))
  patch_reasons <- vapply(blocks, patch_reason, "")
  lines <- function(part, level, kind, ok, reason) {
    data.frame(part = part, level = rep(level, length(part)), kind = kind, ok = ok, reason = reason,
               length = rep(NA_real_, length(part)), strength = rep(NA_real_, length(part)),
               contrast = rep(NA_real_, length(part)), se = rep(NA_real_, length(part)),
               competing = rep(NA_real_, length(part)),
               se_max = rep(NA_real_, length(part)))
  }
  whole <- vapply(fits, function(fit) !is.null(fit$points) && !anyNA(fit$points$x), NA)
  curves <- lines(scheme$curves$curve, "curves", scheme$curves$kind, whole,
                  vapply(fits, `[[`, "", "reason"))
  measures <- c("length", "strength", "contrast", "se", "competing", "se_max")
  curves[measures] <- lapply(measures, of_curve)
  status <- rbind(
    lines(scheme$landmarks$landmark, "landmarks", rep("landmark", nrow(scheme$landmarks)),
          is.na(scan$reason), scan$reason),
    curves,
    lines(names(blocks), "surface", rep("patch", length(blocks)), is.na(patch_reasons),
          patch_reasons)
  )
  rownames(status) <- NULL
  status
}

#' The status with the faults of the model's triangles, each with the patch of its first corner
#' @noRd
note_faults <- function(shape, faults) {
  if (is.null(faults) || nrow(faults) == 0) return(shape)
  part <- shape$points$part[shape$points$level == "surface"][faults$v1]
  said <- vapply(split(faults$fault, part), function(fault) {
    n <- table(fault)
    paste(sprintf("%d %s triangle%s", n, names(n), ifelse(n > 1, "s", "")), collapse = ", ")
  }, "")
  patch <- shape$status$level == "surface" & shape$status$part %in% names(said)
  before <- shape$status$reason[patch]
  said <- said[shape$status$part[patch]]
  shape$status$reason[patch] <- ifelse(is.na(before), said, paste(before, said, sep = "; "))
  shape
}
