# Points slid along curves and over patches until they are homologous to those of a template.

#' Slide the semilandmarks of a shape against a template
#'
#' First, semilandmarks of curves slide along their own curve. Each moves to the place with the
#' least bending energy from the template (plus a strain of the spacings). Landmarks do not move,
#' nor do the ends of curves at landmarks. An end at which the scheme trims a curve slides along the
#' whole curve.
#'
#' Then points of curves and patches slide together over the surface, in one energy (the joint step;
#' not with `slide_settings(curves = "held")`). They start at the thin-plate warp of the template by
#' the landmarks, moved onto the mesh. The measured ridges and valleys attract their points across
#' the ridge; the weight comes from their standard errors. A curve that is far from its points does
#' not attract them, as it runs along another feature. Plane cuts mark no feature, and attract no
#' points. Points of curves that were given to [fit_shape()] (`curves`) do not move. `offset` is the
#' distance of a homologous point from the measured curve; [quality()] grades by it. The curves
#' themselves (`paths`) do not change.
#'
#' In both steps points move in turn, each towards its minimiser, until none moves. The sum of
#' energy, strain and attraction therefore never increases. Points keep their order, and never leave
#' the mesh. [crestline-package] has a glossary.
#'
#' Points that only the template or only the shape has are left out of the energy. Missing points
#' remain NA. Points that coincide by construction still coincide.
#'
#' After the curves have slid, the patches are cut again between them (see [fit_shape()]). Some
#' points of patches lie on a curve without being points of it. They move with the curve, and keep
#' their share of the distance between their neighbours.
#'
#' @param shape A `shape`, as of [fit_shape()].
#' @param template A `shape` of the same scheme, such as of [symmetrise()], or a `shape_sample` of
#'   [homologise()]. With a sample, a new specimen is slid against the sample's template, as the
#'   specimens of the sample were. The other scans are not needed.
#' @param settings [slide_settings()]. If `template` is a sample, the default are the settings of
#'   the sample.
#' @template measured-on
#' @return The `shape` with slid points (`se` is interpolated along the curve), and
#'   * column `offset` of `points`, after the joint step: distance of a curve's point from the
#'     measured curve, across it, in the unit of the mesh. It is positive to the curve's left as
#'     seen from outside, and NA for landmarks and insides of patches;
#'   * column `offset` of `checks`, after the joint step: its root mean square over each curve, in
#'     radii of the template;
#'   * `sliding`: data frame with a row for each set of points that share an energy. Columns: `part`
#'     (the curve, "curves", "joint", "surface", or the patch), `level`, `points` (number of sliding
#'     points), `sweeps`, `converged`, `energy_before`, `energy_after`, `longest` (largest distance
#'     that a point has slid). Energies are in the unit of the mesh (squared for the joint step),
#'     distances too. `longest` is taken along the curve or straight; in the joint step, from the
#'     point's place on its curve or patch;
#'   * `trace`: list with a data frame for each of these parts. Columns are `sweep` (0: the start),
#'     `energy`, `strain` (for the joint step, the attraction of the curves), and `longest` (largest
#'     slide of that sweep).
#' @section Errors: of class `crestline_error`: the shapes have different schemes, or the shape has
#'   no specimen and none is given. Of class `crestline_wrong_mesh`: the specimen has another mesh
#'   than the shape.
#' @section Warnings: of class `crestline_red_parts`: parts are red, and are used as they are.
#' @templateVar where section 4
#' @template paper
#' @details The defaults differ from the paper's choices, which are `slide_settings("paper")`.
#' @seealso [slide_settings()], [homologise()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' shape <- fit_shape(face, face_scheme())
#' slid <- slide(shape, symmetrise(shape))
#' head(slid$sliding)
#' }
#' @export
slide <- function(shape, template, settings = slide_settings(), specimen = shape$specimen) {
  check_given()
  check_class(shape, "shape", "shape", "fit_shape()")
  if (inherits(template, "shape_sample")) {
    validate(template)
    if (missing(settings)) settings <- settings_of_sample(template)
    template <- template$template
  }
  check_class(template, "shape", "template", "symmetrise()")
  check_class(settings, "slide_settings", "settings", "slide_settings()")
  check_same_scheme(shape, template)
  specimen <- kept_specimen(shape, specimen)
  warn_red(red_parts(stats::setNames(list(shape), shape$id), quality_limits()), "slide",
           "quality(shape) has the reasons. Mend the scan or its landmarks, or do not use them.")
  plan <- slide_plan(template, settings)
  state <- slide_state(shape, settings)
  cut <- cut_between_slid(shape, state, slide_curves(state, plan), specimen)
  start <- if (slides_free(settings)) joint_start(shape, cut$store, plan, specimen)
  if (is.null(plan$scale) && !is.null(start)) plan$scale <- energy_scale(list(start))
  finish_slide(shape, cut, start, plan, specimen)
}

#' The settings that a sample was slid by
#' @noRd
settings_of_sample <- function(sample) {
  kept <- sample$provenance$settings$slide
  do.call(slide_settings, kept[names(kept) %in% names(slide_settings())])
}

check_same_scheme <- function(shape, template) {
  if (!identical(shape$scheme$points, template$scheme$points)) {
    crestline_abort(sprintf("its scheme, %s, is not that of %s, %s.", shape$scheme$name,
                            template$id, template$scheme$name),
                    "Measure all specimens by one scheme.", stage = "slide", id = shape$id)
  }
  check_same_unit(shape, template)
}

kept_specimen <- function(shape, specimen) {
  if (inherits(specimen, "specimen")) {
    check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
    return(specimen_of_shape(shape, specimen))
  }
  problem <- if (is.null(specimen)) "the shape does not keep its specimen." else
    sprintf("`specimen` is %s.", describe_value(specimen))
  crestline_abort(problem, "Give the `specimen` that it was measured on.", stage = "slide",
                  id = shape$id)
}

#' A specimen after a check that it is the shape's own
#' @noRd
specimen_of_shape <- function(shape, specimen) {
  validate(specimen)
  check_shape_on(shape, specimen)
  specimen
}

#' The patches cut anew between slid curves
#'
#' @param curves As of [slide_curves()].
#' @return List: `curves`, `fits` (slid curves as [fit_scheme_patches()] takes them), `store` (all
#'   places).
#' @noRd
cut_between_slid <- function(shape, state, curves, specimen) {
  cutting <- cutting_of(shape, NULL, specimen)
  check_tracks(shape, cutting$scan)
  fits <- Map(function(s, curve) list(points = data.frame(s = s), path = curve$path), curves$s,
              state$curves)
  cutting$fits <- fits
  list(curves = curves, fits = fits,
       store = between_curves(cutting, curves_placed(state, curves$s, specimen$mesh)))
}

#' @return List: `fits`, `specimen`, `scheme`, and the `scan` with its holes bridged, as
#'   [fit_scheme_patches()] takes it.
#' @noRd
cutting_of <- function(shape, fits, specimen) {
  scan <- walkable(bridge_holes(specimen, shape$column$bridge))
  scan$faces <- ncol(specimen$mesh$it)
  scan$scheme <- shape$scheme
  scan$column <- c(shape$column, follow = TRUE)
  list(fits = fits, specimen = specimen, scan = scan, scheme = shape$scheme)
}

#' Surface points slid, and the record
#' @param cut As of [cut_between_slid()].
#' @param start As of [joint_start()]; NULL where curve points stay on their curves.
#' @noRd
finish_slide <- function(shape, cut, start, plan, specimen) {
  cutting <- cutting_of(shape, cut$fits, specimen)
  surface <- if (is.null(start)) slide_surface(cut$store, cutting, plan) else
    slide_joint(shape, cut, start, plan, specimen)
  shape <- with_tracks(with_places(shape, surface$store), cut$curves$s, cutting)
  shape$sliding <- rbind(cut$curves$sliding, surface$sliding)
  shape$trace <- c(cut$curves$trace, surface$trace)
  shape <- with_offsets(shape, surface$offset, plan$radius)
  shape$provenance$template <- plan$template
  shape$provenance$settings$slide <- lapply(unclass(plan$settings), identity)
  shape
}

#' A shape with the offsets of its curve points from their own curves, and of every curve their root
#' mean square in radii of the template; without them where curve points stay on their curves
#' @param offset By place; NULL where there is none.
#' @noRd
with_offsets <- function(shape, offset, radius) {
  shape$points$offset <- if (!is.null(offset)) {
    ifelse(shape$points$level == "curves", offset[shape$scheme$points$place], NA)
  }
  if (is.null(shape$checks)) return(shape)
  shape$checks$offset <- if (!is.null(offset)) {
    own <- split(shape$points$offset, paste(shape$points$level, shape$points$part))
    rms <- vapply(own, function(x) sqrt(mean(x^2, na.rm = TRUE)), 0) / radius
    rms <- unname(rms[paste(shape$checks$level, shape$checks$part)])
    ifelse(shape$checks$level == "curves" & !is.nan(rms), rms, NA)
  }
  shape
}

#' A shape with its points as in a store of places
#' @noRd
with_places <- function(shape, store) {
  points <- store[shape$scheme$points$place, ]
  shape$points[colnames(points)] <- as.data.frame(points, row.names = FALSE)
  shape$points$face <- as.integer(shape$points$face)
  shape
}

#' A shape with its curves' points at new places of their tracks; the paths of cut ends that have
#' slid are as long as that
#' @noRd
with_tracks <- function(shape, s, cutting) {
  for (name in names(s)) {
    track <- shape$tracks[[name]]
    if (is_closed(track$path)) {
      shape$tracks[[name]]$s <- from_seam(track$path, s[[name]])
      next
    }
    moved <- !identical(min(s[[name]], na.rm = TRUE), min(track$s, na.rm = TRUE))
    shape$tracks[[name]]$s <- s[[name]]
    if (!moved) next
    length <- attr(track$path, "length")
    path <- part_of_path(cutting$scan, track$path, min(s[[name]], na.rm = TRUE), length)
    shape$paths[[name]] <- unbridged_path(path, cutting$specimen)
    shape$status$length[shape$status$level == "curves" &
                        shape$status$part == name] <- attr(path, "length")
  }
  shape
}

#' The places of a shape, and the curves that can slide
#'
#' @return List: `id`; `store` (matrix with a row a place: x, y, z, face, w1, w2, w3, se); `curves`
#'   (list by name: `place`, `n`, `s` (NA where missing), `path` (`mesh_path`), `track` (matrix s,
#'   x, y, z, face; face 0 over holes), `kept` (length that the scheme keeps), `rows` (of
#'   [slider_rows()])); `off` (whether curve points had left their curves; in `store` they are back,
#'   but for `face` and weights).
#' @noRd
slide_state <- function(shape, settings) {
  points <- shape$points
  place <- shape$scheme$points$place
  first <- !duplicated(place)
  store <- columns_of(points, c(mesh_columns, "se"))[first, ]
  rownames(store) <- place[first]
  of_curve <- split(place[points$level == "curves"], points$part[points$level == "curves"])
  curves <- Map(function(track, name) curve_state(track, of_curve[[name]], settings), shape$tracks,
                names(shape$tracks))
  off <- !is.null(points$offset)
  for (curve in if (off) curves) {
    at <- off_landmarks(curve)
    store[curve$place[at], c("x", "y", "z")] <- points_along(curve$path,
                                                             within_path(curve$path, curve$s[at]))
  }
  list(id = shape$id, store = store, curves = curves, off = off)
}

#' Numbers of a curve's points that are there, and no landmarks
#' @noRd
off_landmarks <- function(curve) which(!is.na(curve$s) & grepl("^curves", curve$place))

curve_state <- function(track, place, settings) {
  path <- track$path
  n <- length(place)
  nodes <- columns_of(path, c("s", "x", "y", "z", "face"))
  nodes[track$off, "face"] <- 0
  free_end <- track$cut && settings$cut_ends == "slide"
  closed <- is_closed(path)
  slides <- closed | seq_len(n) < n & (seq_len(n) > 1 | free_end)
  spacing <- track$kept / (if (closed) n else n - 1)
  rows <- slider_rows(track$s, slides, spacing, attr(path, "length"), settings, closed)
  if (closed) nodes <- unrolled_track(nodes)
  list(place = place, n = n, s = track$s, path = path, track = nodes, kept = track$kept,
       rows = rows)
}

#' Slide all curves of a specimen
#'
#' @return List: `s` (list by curve), `x` (matrix of all places, those of curves slid), `sliding`,
#'   `trace` as in [slide()].
#' @noRd
slide_curves <- function(state, plan) {
  x <- state$store[, c("x", "y", "z")]
  s <- lapply(state$curves, `[[`, "s")
  trace <- list()
  for (set in curve_sets(state, plan)) {
    slid <- slide_set(set, state, plan)
    s[set$curves] <- slid$s
    x[set$places, ] <- slid$x
    trace[[set$name]] <- slid$trace
  }
  longest <- vapply(names(s),
                    function(name) max(0, abs(s[[name]] - state$curves[[name]]$s), na.rm = TRUE), 0)
  list(s = s, x = x, trace = lapply(trace, trace_table),
       sliding = sliding_table(trace, "curves", longest))
}

slide_set <- function(set, state, plan) {
  settings <- plan$settings
  curves <- state$curves[set$curves]
  rows <- stack_rows(Map(function(curve, points) {
    curve$rows[, "point"] <- points[curve$rows[, "point"]]
    curve$rows
  }, curves, set$points))
  slid <- cpp_slide_on_tracks(
    set$b, state$store[set$places, c("x", "y", "z"), drop = FALSE], lapply(curves, `[[`, "track"),
    rows, settings$strain * mean(diag(set$b)), settings$sweeps
  )
  own <- split(slid$s, factor(rows[, "track"], seq_along(curves)))
  s <- Map(function(curve, own) replace(curve$s, curve$rows[, "point"], own), curves, own)
  list(s = s, x = slid$x, trace = c(slid$trace, points = nrow(rows)))
}

#' The store of places with those of the curves at new arc lengths, on the mesh
#' @noRd
curves_placed <- function(state, s, mesh) {
  store <- state$store
  for (name in names(s)) {
    curve <- state$curves[[name]]
    at <- if (state$off) off_landmarks(curve) else curve$rows[, "point"]
    if (!length(at)) next
    there <- place_along(mesh, curve$path, within_path(curve$path, s[[name]][at]))
    store[curve$place[at], mesh_columns] <- columns_of(there)
    se <- store[curve$place, "se"]
    known <- !is.na(se) & !is.na(curve$s)
    if (sum(known) > 1) store[curve$place[at],
                              "se"] <- stats::approx(curve$s[known], se[known], s[[name]][at],
                                                     rule = 2)$y
  }
  store
}
