# Points slid along curves and over patches until they are homologous to those of a template.

#' Slide the points of a shape until they are homologous to a template's
#'
#' Points of curves slide along their own curve, then points of patches over the surface. Each goes
#' to where the bending energy from the template (plus a strain of the spacings) is least. Landmarks
#' do not move, nor do the ends of curves at landmarks. An end at which the scheme cuts a curve off
#' slides along the whole curve too. Points are taken in turn, each to its exact minimiser, until
#' none moves. So the energy never rises. Points keep their order and a gap, and never leave the
#' mesh. [crestline-package] has a glossary.
#'
#' Points that only the template has, or only the shape, are left out of the energy. Missing points
#' stay NA. Points that coincide by construction still do.
#'
#' After the curves have slid, the patches are cut anew between them (see [fit_shape()]). Points of
#' patches that lie on curves without being points of theirs go along: at the same share of the way
#' between their neighbours.
#'
#' @param shape A `shape`, as of [fit_shape()].
#' @param template A `shape` of the same scheme, such as of [symmetrise()], or the `template` of
#'   [homologise()].
#' @param settings [slide_settings()].
#' @param specimen The [specimen()] that the shape was measured on.
#' @return The `shape` with its points slid (`se` goes along), and besides:
#'   * `sliding`: data frame, a row a set of points that share an energy (`part`: the curve,
#'     "curves", "surface", or the patch): `level`, `points` (that slide), `sweeps`, `converged`,
#'     `energy_before`, `energy_after` (unit of the mesh), `longest` (largest distance that a point
#'     has slid, along its curve, or straight);
#'   * `trace`: list by the same parts of data frames `sweep` (0: the start), `energy`, `strain`,
#'     `longest` (slide of that sweep).
#' @section Errors: of class `crestline_error`: shapes of different schemes; a shape that does not
#'   keep its specimen; of class `crestline_wrong_mesh`: a specimen with another mesh than the
#'   shape's.
#' @references The paper, section 4. Where the default departs from it: `slide_settings("paper")`.
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
  check_class(template, "shape", "template", "symmetrise()")
  check_class(settings, "slide_settings", "settings", "slide_settings()")
  check_same_scheme(shape, template)
  specimen <- kept_specimen(shape, specimen)
  plan <- slide_plan(template, settings)
  state <- slide_state(shape, settings)
  cut <- cut_between_slid(shape, state, slide_curves(state, plan), specimen)
  finish_slide(shape, cut, plan, specimen)
}

check_same_scheme <- function(shape, template, call = rlang::caller_env()) {
  if (identical(shape$scheme$points, template$scheme$points)) return(invisible())
  crestline_abort(sprintf("its scheme, %s, is not that of %s, %s.", shape$scheme$name, template$id,
                          template$scheme$name),
                  "Measure all specimens by one scheme.", stage = "slide", id = shape$id,
                  call = call)
}

kept_specimen <- function(shape, specimen, call = rlang::caller_env()) {
  if (inherits(specimen, "specimen")) {
    check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()", call)
    return(specimen_of_shape(shape, specimen))
  }
  problem <- if (is.null(specimen)) "the shape does not keep its specimen." else
    sprintf("`specimen` is %s.", describe_value(specimen))
  crestline_abort(problem, "Give the `specimen` that it was measured on.", stage = "slide",
                  id = shape$id, call = call)
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
  scan$column <- c(shape$column, follow = TRUE)
  list(fits = fits, specimen = specimen, scan = scan, scheme = shape$scheme)
}

#' Surface points slid, and the record
#' @param cut As of [cut_between_slid()].
#' @noRd
finish_slide <- function(shape, cut, plan, specimen) {
  cutting <- cutting_of(shape, cut$fits, specimen)
  surface <- slide_surface(cut$store, cutting, plan)
  shape <- with_tracks(with_places(shape, surface$store), cut$curves$s, cutting)
  shape$sliding <- rbind(cut$curves$sliding, surface$sliding)
  shape$trace <- c(cut$curves$trace, surface$trace)
  shape$provenance$template <- plan$template
  shape$provenance$settings$slide <- lapply(unclass(plan$settings), identity)
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
#'   [slider_rows()])).
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
  list(id = shape$id, store = store, curves = curves)
}

curve_state <- function(track, place, settings) {
  path <- track$path
  n <- length(place)
  nodes <- columns_of(path, c("s", "x", "y", "z", "face"))
  nodes[track$off, "face"] <- 0
  free_end <- track$cut && settings$cut_ends == "slide"
  slides <- seq_len(n) < n & (seq_len(n) > 1 | free_end)
  rows <- slider_rows(track$s, slides, track$kept / (n - 1), attr(path, "length"), settings)
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
  slid <- cpp_slide_on_tracks(set$b, state$store[set$places, c("x", "y", "z"), drop = FALSE],
                              lapply(curves, `[[`, "track"),
                              rows, settings$strain * mean(diag(set$b)), settings$sweeps)
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
    at <- curve$rows[, "point"]
    if (!length(at)) next
    store[curve$place[at], mesh_columns] <- columns_of(place_along(mesh, curve$path, s[[name]][at]))
    se <- store[curve$place, "se"]
    known <- !is.na(se) & !is.na(curve$s)
    if (sum(known) > 1) store[curve$place[at],
                              "se"] <- stats::approx(curve$s[known], se[known], s[[name]][at],
                                                     rule = 2)$y
  }
  store
}
