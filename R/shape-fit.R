# A whole specimen measured by a scheme: landmarks, curves, surface, and how each of them went.

#' Measure a specimen by a scheme
#'
#' Finds every curve of the scheme, trims the curves that the scheme cuts off, and puts
#' semilandmarks on all of them. Then it puts the semilandmarks of the patches between the curves.
#' If a landmark or curve is missing, only the points that depend on it are NA. `status` gives the
#' reason, see below. [crestline-package] has a glossary.
#'
#' Curvature is estimated once for all curves of one radius. Ridges and valleys that curvature does
#' not determine keep their estimate, see [ridge_curve()]. A window with too few vertices gives no
#' estimate; the curve is then the shortest plane cut. If a trimmed curve is shorter than its share,
#' all trimmed curves are cut at the same smaller multiple of their shares. `reason` names each of
#' these cases.
#'
#' A column of a patch is the shortest plane cut between two points of its bounding curves. Only
#' planes near the surface's normal are tried. The points of a column have equal chords. On a sharp
#' rim the surface normals at the two ends are unreliable. There the column `outward` of the
#' scheme's table of patches determines the outer side, and the cut follows that side. All points
#' lie on the mesh. Points that coincide by construction are stored once and agree exactly. If
#' triangles of the model are flipped or cross, the `reason` of the patch of their first corner
#' names them, see [surface_faults()].
#'
#' @param specimen A [specimen()].
#' @param scheme A [curve_scheme()], such as [face_scheme()].
#' @param settings [ridge_settings()] of all curves. `ridge_settings(error = FALSE)` omits standard
#'   errors and saves their time.
#' @param curves Curves that were drawn by hand or found by other software. A list with names of the
#'   scheme's curves, in the unit of the mesh. Its elements are n x 3 matrices, data frames with
#'   columns `x`, `y`, `z`, or values of [ridge_curve()]. [read_curves()] gives such a list. The
#'   curves may run in either direction. They are moved onto the mesh: closest points, joined by
#'   cuts. Their ends are moved to their landmarks. They are not trimmed. A curve with the number of
#'   points of the scheme keeps its points; any other curve gets points at equal chords. Curves that
#'   are not in the list are found by curvature or cuts as usual. NULL: the curves that were drawn
#'   on the page of [digitise()], if the specimen has any; `list()` ignores them. Their `reason` is
#'   "drawn by hand", with observer and time.
#' @param measuring How curves are cut off, holes bridged and columns cut: as of
#'   [shape_settings()].
#' @param unit Factor from the mesh's unit to the unit of the scheme's lengths: 1000 for a scan in
#'   metres and [face_scheme()]. The co-ordinates of the shape stay in the mesh's unit. To bring one
#'   specimen to the unit of the others, use `rescale` of [read_specimen()] instead. NULL: the
#'   factor of [find_landmarks()] if it found the landmarks, else 1.
#' @template progress
#' @inheritParams curvature
#' @param ... Fields of [shape_settings()], and `passes`, the former form. They give a message of
#'   class `crestline_deprecated`.
#' @return Object of class `shape`, a list:
#'   * `id`: of the specimen;
#'   * `points`: data frame with a row for each point, in the order of the scheme. Columns:
#'     * `level` ("landmarks", "curves", "surface"), `part`, `point` (text);
#'     * `x`, `y`, `z`, `face`, `w1`, `w2`, `w3`: the place; NA for a missing point;
#'     * `se`: standard error across the curve, in the unit of the mesh; NA for landmarks, plane
#'       curves and the insides of patches;
#'   * `status`: data frame with a row for each landmark, curve and patch. Columns are `part`,
#'     `level`, `kind` ("landmark", "ridge", "valley", "plane", "patch"), `ok` (TRUE if it has all
#'     its points), and `reason` (text; NA without a problem). For curves it has also
#'     * `length`: after trimming, in the unit of the mesh;
#'     * `strength`: mean strength before trimming, 1 / unit;
#'     * `contrast`: strength over the mean strength beside the curve, in its window but farther
#'       than `settings$core` radii from it. 1: no stronger than its surroundings;
#'     * `se`, `se_max`: median and largest standard error at its points, in the unit of the mesh;
#'     * `competing`: criterion of the best other reference path, as a share of the chosen path's.
#'       Near 1: a rival. NA: no other path;
#'     * `noise_factor`: of [ridge_curve()]. The median over the curves describes the scan:
#'       `print()` and [quality()] give it;
#'     * `remark`: what the scheme could say better. Only a part of the `width` is used
#'       (`settings$window`), or a landmark stands beside the ridge or valley that ends on it, by
#'       more than `settings$beside` radii. NA: nothing. No grade depends on it;
#'   * `checks`: data frame with a row for each row of `status`; [quality()] grades by it. Lengths
#'     are in the unit of the mesh. Columns for all parts are `part`, `level` and `missing` (share
#'     of the points). Columns for curves only:
#'     * `determined`: see [ridge_curve()]; NA if the curve has no points besides landmarks;
#'     * `cut`: length of a trimmed curve, as a share of the length in the scheme;
#'     * `guessed`: TRUE if a trimmed curve had to be directed or measured without one of its
#'       landmarks, see below;
#'     * `bridged`: share of the length that lies over holes.
#'
#'     Columns for curves and patches:
#'     * `size`: length of a curve; for a patch the diameter of a disc whose points are on average
#'       as far from their centroid;
#'     * `roughness`: mean angle in degrees between the normals of its triangles and those at their
#'       corners;
#'     * `edge`: mean edge length of its triangles;
#'     * `border`: distance to the closest border that is not bridged, or Inf; the ends of a curve
#'       do not count;
#'     * `spike`: distance within which there are four triangles with such an angle above 30
#'       degrees, or Inf.
#'
#'     `faults` is the number of faults of a patch, see [surface_faults()]. Landmarks have `state`
#'     and `confidence` (of [find_landmarks()]; NA for given landmarks), and `exchanged` (text: the
#'     landmark that it looks exchanged with);
#'   * `paths`: named list with the `mesh_path` of each curve, after trimming; over holes it is
#'     straight from rim to rim. `NULL` for a curve that failed;
#'   * `scheme`, its lengths in the unit of the mesh;
#'   * `provenance`: versions, scheme, mesh, landmarks and settings, see [summary.shape()];
#'   * `key`: key of the specimen's mesh, see [specimen()]. Functions of a shape and a specimen
#'     refuse another mesh, and a mesh whose vertices or triangles are in another order (error of
#'     class `crestline_wrong_mesh`);
#'   * `tracks`, `column`, `specimen`: for [slide()] only. `shape$specimen <- NULL` makes the shape
#'     small.
#'
#'   `as.data.frame(shape)` gives the points; see also [coords()], [shape_mesh()] and
#'   [plot.shape()].
#' @section Missing parts: If a landmark or curve is missing, only the points that depend on it are
#'   NA. `status` gives the reason.
#'   * If a landmark is absent or NA, the curves that end there and the columns that begin on them
#'     are missing.
#'   * A trimmed curve (`cut_share`) keeps only the part next to its end `to`, and needs no more of
#'     the mesh. Its other landmark may lie outside the scan (an ear). The curve then runs towards
#'     that landmark to the border of the mesh. The direction is that of the landmark's
#'     co-ordinates, if it has any. These may lie off the mesh, if they are set after [specimen()]:
#'     `specimen$landmarks <- rbind(specimen$landmarks, tL = c(x, y, z))`. Otherwise the direction
#'     is that of the mirror image of its pair. The points keep their places on the whole curve;
#'     points beyond the mesh are missing. With a smaller `cut_scale` all points lie on the mesh.
#'   * Scans of faces without ears lack tL, tR, oiL and oiR, and the curves that run to them.
#'     [find_landmarks()] predicts these landmarks. Add them to your own: `ears <-
#'     find_landmarks(face)$landmarks[c("tL", "tR", "oiL", "oiR"), ]`, then `face$landmarks <-
#'     rbind(face$landmarks, ears)`.
#'   * Shares are measured between the two landmarks of a pair. On half a face one of them is
#'     missing. The length is then twice the distance of the other from the mirror plane. The mirror
#'     plane is perpendicular to the directions between left and right. Without a whole pair, it
#'     runs through the midline landmarks.
#'   * The points inside a hole are missing, see `bridge` of [shape_settings()]. Remove triangles
#'     that you do not trust from the mesh first, such as long ones over unseen parts. They then
#'     count as a hole.
#' @section Errors: of class `crestline_error`: an argument is not of the class it should be, or the
#'   specimen has no landmarks. Of class `crestline_unit_error`: the distances between landmarks
#'   differ from the scheme's by a factor, as in another unit. The error gives the `unit` to use.
#' @section Warnings: of class `crestline_exchanged`: landmarks look exchanged
#'   (`crestline_mirrored`: left and right of all pairs). [quality()] grades them, and the curves
#'   that end there, red. Of class `crestline_unused_landmarks`: a landmark of the scheme is
#'   missing, and the specimen has one of a similar name (`prn` for `pn`, `CHL` for `chL`). Of class
#'   `crestline_foreign_tracks`: a quarter of the curves, and at least three, leave the scheme's
#'   expected tracks ([learn_tracks()]) by more than four spreads. The curves are then measured
#'   without these.
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
fit_shape <- function(specimen, scheme = face_scheme(), settings = ridge_settings(), curves = NULL,
                      measuring = shape_settings(), unit = NULL,
                      threads = getOption("crestline.threads", 1L), progress = interactive(), ...) {
  check_given()
  check_flags(progress)
  threads <- check_threads(threads)
  check_class(specimen, "specimen", "specimen",
              "specimen(), read_specimen() or, without landmarks, find_landmarks()")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  check_class(measuring, "shape_settings", "measuring", "shape_settings()")
  check_dots(..., known = unlist(former_fit_fields()))
  asked <- with_former(list(settings = settings, measuring = measuring), former_fit_fields(),
                       list(...))
  named <- scheme
  if (is.null(unit)) unit <- c(specimen$match$unit, 1)[1]
  scheme <- scheme_in_unit(scheme, unit, specimen)
  check_fits_scheme(specimen, scheme, unit)
  warn_unused_names(specimen, scheme, paste("the scheme", scheme$name))
  specimen <- with_located(specimen)
  if (!is.null(specimen$placing)) specimen$placing <- current_placing(specimen)
  column <- column_settings(asked$measuring)
  if (is.null(curves)) curves <- specimen$drawn
  scan <- prepare_scan(specimen, scheme, asked$settings, column, threads)
  tick <- progress_ticks(
    progress, nrow(scheme$curves) - length(curves) + nrow(scheme$patches), specimen$id
  )
  fits <- given_fits(scan, curves)
  open <- vapply(fits, is.null, NA)
  fits <- by_own_tracks(scan, tick, function(scan, tick) {
    finished_curves(fit_whole_curves(fits, open, scan, tick), open, scan,
                    asked$measuring$cut_scale)
  })
  patches <- fit_scheme_patches(scan, fits, place_store(scan, fits), tick)
  shape <- new_shape(
    specimen$id, shape_points(scheme, patches$store), shape_status(scan, fits, patches$problems),
    scheme, paths = lapply(fits, function(fit) unbridged_path(fit$path, specimen)),
    tracks = curve_tracks(fits, scan), column = column, specimen = specimen,
    provenance = shape_provenance(scan, named, unit, asked$measuring, names(curves))
  )
  with_checks(shape, scan, fits)
}

#' A shape with its checks, and the reasons of faults and of landmarks that look exchanged
#' @noRd
with_checks <- function(shape, scan, fits) {
  slips <- scheme_slips(scan$specimen, shape$scheme)
  triangles <- triangles_there(shape$scheme$triangles, shape$points, "model")
  faults <- if (nrow(triangles)) {
    faults_among(triangles, shape$points[shape$points$level == "surface", ], scan$specimen$mesh)
  }
  shape <- note_slips(note_faults(shape, faults), slips)
  shape$checks <- cbind(shape_checks(shape, scan, fits, faults),
                        landmark_checks(shape, scan$specimen$placing, slips))
  shape
}

#' Where a measured shape came from, see [summary.shape()]
#'
#' @param scan As of [prepare_scan()].
#' @param scheme As it was given, before its lengths were brought to the unit of the mesh.
#' @param unit Factor that its lengths were divided by.
#' @param given Names of the curves that were given.
#' @noRd
shape_provenance <- function(scan, scheme, unit, measuring, given) {
  origin <- origin_of(scan$specimen)
  c(made_with(), list(
    scheme = c(scheme_provenance(scheme), unit = unit), mesh = mesh_provenance(scan$specimen),
    landmarks = origin[origin$landmark %in% scheme$landmarks$landmark, ],
    settings = list(ridge = lapply(unclass(scan$settings), identity),
                    fit = c(lapply(unclass(measuring), identity),
                            list(given = as.character(given))))
  ))
}

#' Fields of settings that were arguments of [fit_shape()], by the argument of today
#' @noRd
former_fit_fields <- function() {
  list(settings = "passes", measuring = setdiff(names(formals(shape_settings)), "..."))
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
               se_max = rep(NA_real_, length(part)), noise_factor = rep(NA_real_, length(part)),
               remark = rep(NA_character_, length(part)))
  }
  whole <- vapply(fits, function(fit) !is.null(fit$points) && !anyNA(fit$points$x), NA)
  curves <- lines(scheme$curves$curve, "curves", scheme$curves$kind, whole,
                  vapply(fits, `[[`, "", "reason"))
  measures <- c("length", "strength", "contrast", "se", "competing", "se_max", "noise_factor")
  curves[measures] <- lapply(measures, of_curve)
  curves$remark <- vapply(fits, `[[`, "", "remark", USE.NAMES = FALSE)
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
