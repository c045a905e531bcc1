# Points slid along curves and over patches until they are homologous to those of a template.

#' Slide the points of a shape until they are homologous to a template's
#'
#' Points of curves slide along their own curve, then points of patches over the surface, each to where the bending energy from
#' the template (and a strain of the spacings) is least; landmarks and the ends of curves stay. One point at a time is taken to its exact
#' minimiser, in turn, until none moves: the energy never rises, and points keep their order and a gap. Points never leave
#' the mesh.
#'
#' What is in the template but not in the shape, or the other way round, is left out of the energy; points that are missing
#' stay NA. Points that coincide by construction still do.
#'
#' After the curves have slid, the patches are cut anew between them (see [fit_shape()]). Points of patches that lie on curves without being points of
#' theirs go along: at the same share of the way between their neighbours.
#'
#' @param shape A `shape`, as of [fit_shape()].
#' @param template A `shape` of the same scheme, such as of [symmetrise()], or the `template` of [homologise()].
#' @param settings [slide_settings()].
#' @param specimen The [specimen()] that the shape was measured on.
#' @return The `shape` with its points slid (`se` goes along), and besides:
#'   * `sliding`: data frame, a row a set of points that share an energy (`part`: the curve, "curves", "surface", or the patch): `level`, `points` (that
#'     slide), `sweeps`, `converged`, `energy_before`, `energy_after` (unit of the mesh), `longest` (largest distance that a point has
#'     slid, along its curve, or straight);
#'   * `trace`: list by the same parts of data frames `sweep` (0: the start), `energy`, `strain`, `longest` (slide of that sweep).
#' @section Errors: of class `crestline_error`: shapes of different schemes; a shape that does not keep its specimen.
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
  check_class(shape, "shape", "shape", "fit_shape()")
  check_class(template, "shape", "template", "symmetrise()")
  check_class(settings, "slide_settings", "settings", "slide_settings()")
  check_same_scheme(shape, template)
  specimen <- kept_specimen(shape, specimen)
  plan <- slide_plan(template, settings)
  state <- slide_state(shape)
  cut <- cut_between_slid(shape, state, slide_curves(state, plan), specimen)
  finish_slide(shape, cut, plan, specimen)
}

check_same_scheme <- function(shape, template, call = rlang::caller_env()) {
  if (identical(shape$scheme$points, template$scheme$points)) return(invisible())
  crestline_abort(sprintf("its scheme, %s, is not that of %s, %s.", shape$scheme$name, template$id, template$scheme$name),
                  "Measure all specimens by one scheme.", stage = "slide", id = shape$id, call = call)
}

kept_specimen <- function(shape, specimen, call = rlang::caller_env()) {
  if (inherits(specimen, "specimen")) return(specimen)
  crestline_abort(if (is.null(specimen)) "the shape does not keep its specimen." else sprintf("`specimen` is %s.", describe_value(specimen)),
                  "Give the `specimen` that it was measured on.", stage = "slide", id = shape$id, call = call)
}

#' The patches cut anew between slid curves
#'
#' @param curves As of [slide_curves()].
#' @return List: `curves`, `fits` (see [slid_fits()]), `store` (all places).
#' @noRd
cut_between_slid <- function(shape, state, curves, specimen) {
  fits <- slid_fits(state, curves$s)
  store <- curves_placed(state, curves$s, specimen$mesh)
  list(curves = curves, fits = fits, store = between_curves(cutting_of(shape, fits, specimen), store))
}

cutting_of <- function(shape, fits, specimen) {
  list(fits = fits, column = c(shape$column, follow = TRUE), specimen = specimen, scheme = shape$scheme)
}

#' Surface points slid, and the record
#' @param cut As of [cut_between_slid()].
#' @noRd
finish_slide <- function(shape, cut, plan, specimen) {
  surface <- slide_surface(cut$store, cutting_of(shape, cut$fits, specimen), plan)
  shape <- with_places(shape, surface$store)
  shape$sliding <- rbind(cut$curves$sliding, surface$sliding)
  shape$trace <- c(cut$curves$trace, surface$trace)
  shape
}

#' Slid curves as [fit_scheme_patches()] takes them
#' @noRd
slid_fits <- function(state, s) {
  Map(function(s, curve) list(points = data.frame(s = s), path = curve$path), s, state$curves[names(s)])
}

#' A shape with its points as in a store of places
#' @noRd
with_places <- function(shape, store) {
  points <- store[shape$scheme$points$place, ]
  shape$points[colnames(points)] <- as.data.frame(points, row.names = FALSE)
  shape$points$face <- as.integer(shape$points$face)
  shape
}

#' The places of a shape, and the curves that can slide: each with its polyline and the places of its points there
#'
#' @return List: `id`; `store` (matrix with a row a place: x, y, z, face, w1, w2, w3, se); `curves` (list by name, of those that are there:
#'   `place`, `s`, `path` (`mesh_path`), `track` (matrix s, x, y, z), `length`, `n`).
#' @noRd
slide_state <- function(shape) {
  points <- shape$points
  place <- shape$scheme$points$place
  first <- !duplicated(place)
  store <- columns_of(points, c(mesh_columns, "se"))[first, ]
  rownames(store) <- place[first]
  of_curve <- split(place[points$level == "curves"], points$part[points$level == "curves"])
  names <- Filter(function(name) is_whole(shape$paths[[name]], store[of_curve[[name]], "x"]), names(shape$paths))
  curves <- lapply(stats::setNames(names, names), function(name) {
    curve_state(shape$paths[[name]], of_curve[[name]], store, name, shape$id)
  })
  list(id = shape$id, store = store, curves = curves)
}

is_whole <- function(path, x) !is.null(path) && !anyNA(x)

curve_state <- function(path, place, store, name, id) {
  track <- columns_of(path, c("s", "x", "y", "z"))
  s <- path_places(track, store[place, c("x", "y", "z"), drop = FALSE])
  s[c(1, length(s))] <- c(0, attr(path, "length"))
  if (any(diff(s) <= 0)) {
    crestline_abort(sprintf("the points of %s are not in order along it.", name), "Fit the shape again.", stage = "slide", id = id)
  }
  list(place = place, s = s, path = path, track = track, length = attr(path, "length"), n = length(s))
}

#' Arc lengths of the places of a polyline that are nearest to points
#' @noRd
path_places <- function(track, xyz) {
  a <- track[-nrow(track), , drop = FALSE]
  step <- diff(track)
  length2 <- pmax(rowSums(step[, -1, drop = FALSE]^2), .Machine$double.xmin)
  apply(xyz, 1, function(p) {
    rel <- rep(p, each = nrow(a)) - a[, -1, drop = FALSE]
    share <- pmin(pmax(rowSums(rel * step[, -1, drop = FALSE]) / length2, 0), 1)
    nearest <- which.min(rowSums((rel - share * step[, -1, drop = FALSE])^2))
    a[nearest, 1] + share[nearest] * step[nearest, 1]
  })
}

#' Slide all curves of a specimen
#'
#' @return List: `s` (list by curve), `x` (matrix of all places, those of curves slid), `sliding`, `trace` as in [slide()].
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
  longest <- vapply(names(s), function(name) max(abs(s[[name]] - state$curves[[name]]$s)), 0)
  list(s = s, x = x, trace = lapply(trace, trace_table), sliding = sliding_table(trace, "curves", longest))
}

slide_set <- function(set, state, plan) {
  settings <- plan$settings
  curves <- state$curves[set$curves]
  rows <- set$rows
  rows[, "s"] <- unlist(lapply(curves, function(curve) curve$s[-c(1, curve$n)]))
  rows[, "rest"] <- (vapply(curves, `[[`, 0, "length") / (vapply(curves, `[[`, 0L, "n") - 1))[rows[, "path"]]
  slid <- cpp_slide_on_paths(set$b, state$store[set$places, c("x", "y", "z"), drop = FALSE], lapply(curves, `[[`, "track"), rows,
                             settings$strain * mean(diag(set$b)), settings$gap, settings$tolerance, settings$sweeps)
  s <- Map(function(curve, inner) c(0, inner, curve$length), curves, split(slid$s, factor(rows[, "path"], seq_along(curves))))
  list(s = s, x = slid$x, trace = c(slid$trace, points = nrow(rows)))
}

trace_table <- function(trace) {
  data.frame(sweep = seq_along(trace$energy) - 1, energy = trace$energy, strain = trace$strain, longest = trace$longest)
}

#' @param longest Of every part, named; of several parts in one set the largest.
#' @noRd
sliding_table <- function(trace, level, longest) {
  of <- function(f, type) vapply(trace, f, type, USE.NAMES = FALSE)
  part <- names(trace)
  data.frame(part = as.character(part), level = rep(level, length(part)), points = of(function(x) x$points, 0L),
             sweeps = of(function(x) length(x$energy) - 1, 0), converged = of(function(x) x$converged, NA),
             energy_before = of(function(x) x$energy[1], 0), energy_after = of(function(x) x$energy[length(x$energy)], 0),
             longest = ifelse(part %in% names(longest), longest[part], max(longest, 0)))
}

#' The store of places with those of the curves at new arc lengths, on the mesh
#' @noRd
curves_placed <- function(state, s, mesh) {
  store <- state$store
  for (name in names(s)) {
    curve <- state$curves[[name]]
    inner <- -c(1, curve$n)
    if (curve$n < 3) next
    placed <- place_along(mesh, curve$path, s[[name]][inner])
    store[curve$place[inner], mesh_columns] <- columns_of(placed)
    se <- store[curve$place, "se"]
    if (!anyNA(se[inner])) store[curve$place[inner], "se"] <- approx_open(curve$s, se, s[[name]][inner])
  }
  store
}

#' Linear interpolation between those values that are not NA
#' @noRd
approx_open <- function(x, y, at) {
  if (sum(!is.na(y)) < 2) return(rep(y[!is.na(y)][1], length(at)))
  stats::approx(x, y, at, rule = 2)$y
}
