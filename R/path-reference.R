#' Reference path: the plane cut that gathers most curvature
#'
#' Finds a path between two points along which the sought curvature is strong. All plane cuts are
#' tried, at every angle and both ways round, that are not much longer than the shortest. The result
#' is the cut with the greatest length-weighted mean strength; for `type = "plane"`, the shortest
#' cut. A coarse grid of angles is tried first, then a finer one about each local optimum.
#'
#' The strength is that of the principal curvature. For a valley it is `k1` where k1 is
#' positive and the shape index negative. For a ridge it is `-k2` where k2 is negative and
#' the shape index positive. Elsewhere it is 0.
#'
#' @param specimen A [specimen()] (or a `mesh3d` with positions for `from` and `to`).
#' @inheritParams plane_path
#' @param type `"ridge"`, `"valley"`, or `"plane"` for the shortest cut.
#' @param radius Radius of the curvature estimates, in the unit of the mesh. Not needed for
#'   `"plane"`. Or a [curvature()] of the mesh, if you have it; it has its radius. Otherwise
#'   curvature is estimated in the region of the cuts, by `getOption("crestline.threads", 1)`
#'   threads.
#' @param keep_away Region where curvature is ignored, as of [keep_away()] or [keep_side()], or a
#'   list of regions. `NULL`: none.
#' @param settings Constants of the search, as of [path_settings()].
#' @param path `"plane"`: the best plane cut. `"crest"`: the path of least cost along the feature,
#'   for a ridge or valley that bows away from every plane through its ends (see below).
#' @param via Places on the way, in order: names of landmarks, or positions (three co-ordinates, a k
#'   x 3 matrix, or a list of both). With `via` the path is `"crest"`. If `from` and `to` are one
#'   landmark, the path is closed, and needs a `via` on the other side.
#' @param ... Fields of [path_settings()], and `curvature` and `threads`, the former form. They give
#'   a message of class `crestline_deprecated`.
#' @return A `mesh_path` as of [plane_path()], with these attributes besides:
#'   * `type`;
#'   * `criterion`: mean strength in 1 / unit, or for `"plane"` the length in the unit of the mesh;
#'   * `optima`: data frame with a row for every local optimum, the path's own first, then in order
#'     of the criterion: `angle` (radians), `side`, `criterion`, `length`;
#'   * `competing`: criterion of the best optimum that runs elsewhere, as a share of the path's (for
#'     lengths the inverse); NA if there is none.
#' @section Paths of least cost: The cost of a unit of length is f / (f + rho). Here rho is the
#'   radius times the strength, and f is the setting `floor`. The path of least cost runs over the
#'   edges and triangles of the mesh. It is then smoothed at a wavelength of 8 radii (`smoothing`).
#'   With `via` it is found once more within 2 radii (`corridor`), without the stops: a `via` beside
#'   the crest does no harm.
#'
#'   A closed path begins at its place nearest to `from`. It runs in the order of the stops. With
#'   one `via` it runs anticlockwise as seen from outside. Give two `via` if the surface
#'   along it faces all round, as on the rim of a torus.
#'
#'   On faces the plane cut is the better choice: a faint feature loses to stronger ones beside it.
#'   `competing` is the cost of the path as a share of that of the best other path. `optima` and
#'   `angle` are absent. Of a closed path `competing` is no sign of the right loop:
#'   the other path has to pass the same stops. On a skull it was 0.03 to 0.40 of right loops, and
#'   0.16 of a wrong one. `determined` of [ridge_curve()] is `FALSE` for a wrong loop if it runs
#'   twice over, closes in on itself, or is much longer than its stops are apart.
#' @section Errors: of class `crestline_path_error`: no plane cut joins the points; a closed path
#'   has no `via`.
#' @section Warnings: of class `crestline_rival_path`: another optimum is nearly as good; the
#'   warning names both angles. Of class `crestline_wide_radius`: the radius exceeds `widest` times
#'   the distance of the ends (see [path_settings()]), or much of the mesh (see [curvature()]). It
#'   is most likely in another unit.
#' @template glossary
#' @templateVar where section 3.1
#' @template paper
#' @examples
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' path <- reference_path(face, "chL", "st", "valley", radius = 5)
#' path
#' attr(path, "criterion")
#' head(as.data.frame(path), 3)
#' @export
reference_path <- function(specimen, from, to, type = c("ridge", "valley", "plane"), radius,
                           keep_away = NULL, settings = path_settings(),
                           path = c("plane", "crest"), via = NULL, ...) {
  check_given("radius")
  check_surface(specimen, "specimen")
  check_class(settings, "path_settings", "settings", "path_settings()")
  asked <- path_arguments(list(settings = settings), list(settings = names(settings)), ...)
  check_ends(from = from, to = to)
  keep_away <- check_regions(keep_away)
  type <- check_choice(type, c("ridge", "valley", "plane"), "type")
  route <- check_route(path, via, type)
  if (missing(radius)) radius <- asked$curvature
  settings <- asked$settings
  strength <- if (type != "plane") {
    source <- source_at(radius, asked, specimen, settings$order)
    radius <- radius_of(radius)
    id <- mesh_of(specimen)$id
    regions <- in_context(located_regions(keep_away, region_locator(specimen), id), id)
    path_strength(source, type, regions, as_mesh(specimen))
  }
  scan <- walkable(specimen)
  ends <- located_ends(specimen, scan, from, to, route$via)
  found <- if (route$path == "crest") find_crest else find_reference
  path <- in_context(found(ends, type, strength, radius, settings), scan$id)
  if (type != "plane") {
    doubt <- radius_doubt(radius, ends, path, settings$widest)
    if (is.na(doubt)) warn_wide_radius(radius, specimen) else
      crestline_warn(paste0(doubt, "."), wide_radius_remedy, stage = "reference path", id = scan$id,
                     class = "crestline_wide_radius")
  }
  warn_rival(path, ends$names, scan$id, settings$rival)
  path
}

#' Why a radius seems to be in another unit than the mesh, NA where it does not
#'
#' A ball that is as large as the distance of a path's ends holds more than the path's feature.
#' @param path From one end to the other; a path of least cost may be much longer than its ends are
#'   apart.
#' @param widest As in [path_settings()].
#' @noRd
radius_doubt <- function(radius, ends, path, widest) {
  bowed <- is.null(ends$span) || !is.null(ends$via)
  span <- if (bowed) attr(path, "length") else ends$span
  # A bowed path that was not found has no length.
  if (is.null(span) || radius <= widest * span) return(NA_character_)
  sprintf("its radius, %.3g, is %.2g times %s, %.3g, as of another unit than the mesh", radius,
          radius / span, if (bowed) "its length" else "the distance of its ends", span)
}

wide_radius_remedy <- paste("Give `radius` and `width` in the unit of the mesh, or read the",
                            "specimen with `rescale` (10 turns cm into mm).")

#' What the dots of [reference_path()] and [ridge_curve()] change
#'
#' @param objects,fields,silent As in [with_former()].
#' @return The objects, with `curvature` (or NULL) and `threads`, as were arguments formerly.
#' @noRd
path_arguments <- function(objects, fields, ..., silent = character()) {
  check_dots(..., known = c(unlist(fields), "curvature", "threads"))
  given <- list(...)
  today <- c(curvature = "radius = <the curvature>", threads = "options(crestline.threads = )")
  for (name in intersect(names(given), names(today))) inform_former(paste(name, "="), today[[name]])
  threads <- if (is.null(given$threads)) getOption("crestline.threads", 1L) else given$threads
  c(with_former(objects, fields, given, silent),
    list(curvature = given$curvature, threads = check_threads(threads)))
}

#' Curvature of a radius, or what is given in its place
#'
#' @param radius A number, or a [curvature()].
#' @param asked As of [path_arguments()].
#' @noRd
source_at <- function(radius, asked, specimen, order) {
  given <- inherits(radius, "curvature")
  check_number(radius_of(radius), "radius", lower = 0, open = TRUE)
  known_curvature(if (given) radius else asked$curvature, specimen, radius, asked$threads, order)
}

radius_of <- function(radius) if (inherits(radius, "curvature")) attr(radius, "radius") else radius

#' A reference path without checks and warnings, or a failure
#'
#' @param ends As of [path_ends()]; a failure is handed on.
#' @param strength As of [path_strength()]; not used for planes.
#' @param radius Of the curvature.
#' @param search As of [path_settings()].
#' @param weight Function of angles: what the criterion of optima is multiplied by before they are
#'   compared. It does not move them.
#' @return As [reference_path()].
#' @noRd
find_reference <- function(ends, type, strength, radius, search, weight = function(angle) 1) {
  if (failed(ends)) return(ends)
  rate <- if (type == "plane") {
    function(found) -found$length
  } else {
    function(found) cut_strength(ends, found, search$reach, search$spacing * radius, strength)
  }
  measure <- function(angle, side, limit = Inf) {
    measure_cuts(ends, angle, side, search$reach, search$longest, limit)
  }
  optima <- cut_optima(measure, rate, search, weight)
  if (nrow(optima) == 0) {
    return(no_result(
      sprintf("no plane cut joins %s and %s (at angle 0 it ends: %s).", ends$names[1],
              ends$names[2], measure(0, 0L)$end),
      paste("Look for a hole between the landmarks: ridge_curve() crosses none, fit_shape()",
            "bridges small ones. Raise `reach` if the feature bends far out."),
      "reference path", ends$scan$id, "crestline_path_error"
    ))
  }
  cut <- function(i) cut_path(ends, optima$angle[i], optima$side[i], search$reach, type = type)
  path <- cut(1)
  elsewhere <- Find(
    function(i) path_distance(cut(i), path) > search$distinct * attr(path, "length"),
    seq_len(nrow(optima))[-1]
  )
  other <- if (is.null(elsewhere)) NA_integer_ else elsewhere
  if (type == "plane") optima$criterion <- optima$length
  structure(path, criterion = optima$criterion[1], optima = optima,
            competing = shares_of_first(optima, type)[other])
}

#' How good optima are, as shares of the first
#' @noRd
shares_of_first <- function(optima, type) {
  share <- optima$criterion / optima$criterion[1]
  if (type == "plane") 1 / share else share
}

#' Best plane cut among angles about the surface's normal, or a failure
#'
#' @param limit Greatest angle in radians between the plane and that of the mean of the normals at
#'   the ends.
#' @param angles Number of angles.
#' @param reach Cuts stay within this share of the ends' distance from the straight line between
#'   them.
#' @param rate Function of measured cuts that are at most `longest` times as long as the shortest:
#'   the greatest counts.
#' @noRd
limited_cut <- function(ends, limit, angles, reach, rate = function(found) -found$length,
                        longest = 1) {
  if (failed(ends)) return(ends)
  found <- measure_cuts(ends, seq(-limit, limit, length.out = angles), rep(0L, angles), reach,
                        longest)
  if (all(is.na(found$length))) return(failed_cut(found$end[ceiling(angles / 2)], ends))
  allowed <- found[which(found$length <= longest * min(found$length, na.rm = TRUE)), ]
  cut_path(ends, allowed$angle[which.max(rate(allowed))], 0, reach)
}

#' Lengths of plane cuts, NA where a cut does not arrive
#'
#' @param longest,limit A cut is given up, as too far, where it is longer than `limit`, or may be
#'   where it is longer than `longest` times the shortest. The straightest are tried first.
#' @return Data frame `angle`, `side`, `length`, `end`.
#' @noRd
measure_cuts <- function(ends, angle, side, reach, longest = Inf, limit = Inf) {
  scan <- ends$scan
  first <- order(side, abs(angle))
  found <- cpp_plane_cuts(
    scan$vb, scan$it, scan$twin, ends$from, ends$to, plane_normal(ends, angle[first]), side[first],
    reach * ends$span, longest, limit
  )
  back <- order(first)
  frame_of(list(angle = angle, side = side, length = found$length[back], end = found$end[back]))
}

#' Mean strength along plane cuts, at places no further apart than `step`
#'
#' @param found Cuts as of [measure_cuts()], all arrived.
#' @param strength Function of vertices.
#' @noRd
cut_strength <- function(ends, found, reach, step, strength) {
  if (nrow(found) == 0) return(numeric())
  scan <- ends$scan
  at <- cpp_cut_weights(scan$vb, scan$it, scan$twin, ends$from, ends$to,
                        plane_normal(ends, found$angle), found$side, reach * ends$span, step)
  vertex <- unique(at$vertex)
  value <- strength(vertex)[match(at$vertex, vertex)]
  as.vector(rowsum(at$weight * value, at$cut, reorder = FALSE))
}

#' Local optima of the criterion over angle and side, refined, best first
#'
#' @param measure Function of angles, sides and a limit, as [measure_cuts()].
#' @param rate Function of measured cuts that gives their criterion.
#' @param weight As in [find_reference()].
#' @param digits Criteria that agree to this many significant digits are equal: on a straight
#'   feature many planes cut one line. Of equal cuts the shortest counts, then the straightest in.
#' @noRd
cut_optima <- function(measure, rate, search, weight = function(angle) 1, digits = 8) {
  angles <- search$angles
  step <- pi / angles
  coarse <- measure(rep(-pi / 2 + step * seq_len(angles), 2), rep(0:1, each = angles))
  if (all(is.na(coarse$length))) return(data.frame())
  # A function that gives measured cuts, as a list, their criterion, and the rounded criterion and
  # length they are compared by
  limit <- search$longest * min(coarse$length, na.rm = TRUE)
  rated <- function(found) {
    allowed <- which(found$length <= limit)
    criterion <- rep(NA_real_, length(found$length))
    criterion[allowed] <- rate(frame_of(lapply(unclass(found), `[`, allowed)))
    level <- signif(criterion, digits)
    level[is.na(level)] <- -Inf
    c(unclass(found)[c("angle", "side", "length")],
      list(criterion = criterion, level = level, extent = signif(found$length, digits)))
  }
  coarse <- rated(coarse)
  on_side <- split(seq_len(2 * angles), coarse$side)
  peaks <- unlist(lapply(on_side, function(side) {
    vapply(circular_peaks(coarse$level[side]), function(run) best_cut(coarse, side[run]), 0L)
  }), use.names = FALSE)
  around <- step * seq(-1, 1, length.out = search$refined)
  fine <- rated(measure(rep(coarse$angle[peaks], each = search$refined) + around,
                        rep(coarse$side[peaks], each = search$refined), limit))
  all <- Map(c, lapply(coarse, `[`, peaks), fine)
  of_peak <- c(seq_along(peaks), rep(seq_along(peaks), each = search$refined))
  best <- vapply(split(seq_along(of_peak), of_peak), function(near) best_cut(all, near), 0L)
  all$angle <- wrap_angle(all$angle)
  all[c("criterion", "level")] <- lapply(all[c("criterion", "level")], `*`, weight(all$angle))
  tied <- all$level[best] >= max(all$level[best]) - search$tie * abs(max(all$level[best]))
  best <- best[order(!tied, ifelse(tied, 0, -all$level[best]), all$extent[best], -all$level[best],
                     abs(all$angle[best]))]
  best <- best[!duplicated(round(cbind(all$angle, all$side)[best, , drop = FALSE], 6))]
  frame_of(lapply(all[c("angle", "side", "criterion", "length")], `[`, best))
}

#' Of some cuts the one with the greatest criterion, least length, smallest angle
#' @noRd
best_cut <- function(found,
                     at) at[order(-found$level[at], found$extent[at], abs(found$angle[at]))[1]]

#' Runs of equal values round a circle that are higher than what lies on both sides
#'
#' @return List of index vectors; one with all finite values where these are all equal.
#' @noRd
circular_peaks <- function(x) {
  n <- length(x)
  if (length(unique(x[is.finite(x)])) == 1) return(list(which(is.finite(x))))
  before <- c(x[n], x[-n])
  runs <- lapply(which(is.finite(x) & x > before), function(first) {
    ahead <- (first + seq_len(n) - 2) %% n + 1
    run <- ahead[seq_len(which(x[ahead] != x[first])[1] - 1)]
    if (x[run[length(run)] %% n + 1] < x[first]) run
  })
  Filter(length, runs)
}

# Into (-pi/2, pi/2].
wrap_angle <- function(angle) angle - pi * ceiling(angle / pi - 0.5)

#' Strength of the principal curvature as a function of vertices, 0 where it is not known or not
#' wanted
#'
#' @param source Curvature as of [known_curvature()].
#' @param regions As of [located_regions()].
#' @param mesh With `vb`.
#' @noRd
path_strength <- function(source, type, regions, mesh) {
  vb <- mesh$vb
  function(vertices) {
    strength <- strength_at(source(vertices), type)
    strength[is.na(strength)] <- 0
    if (is.null(regions)) return(strength)
    some <- which(strength > 0)
    strength[some][is_kept_away(regions, t(vb[1:3, vertices[some], drop = FALSE]))] <- 0
    strength
  }
}

#' Curvature as a function of vertices: the one that was given, after a check, or estimated where it
#' is asked for
#' @noRd
known_curvature <- function(curvature, specimen, radius, threads, order = "adaptive") {
  # A source of curvature, as of curvature_source(), not any function.
  if (is.function(curvature) && identical(names(formals(curvature)), "vertices")) return(curvature)
  if (is.null(curvature)) {
    mesh <- as_mesh(specimen)
    check_radius(radius, specimen)
    return(curvature_source(mesh, fit_settings(radius, order), threads))
  }
  check_curvature_on(curvature, specimen)
  function(vertices) curvature_rows(curvature, vertices)
}

#' Warn of a second cut nearly as good that runs elsewhere
#'
#' @param path A reference path.
#' @param ends Names of its ends.
#' @noRd
warn_rival <- function(path, ends, id, rival = 0.05) {
  competing <- attr(path, "competing")
  if (!isTRUE(competing >= 1 - rival)) return(invisible())
  optima <- attr(path, "optima")
  if (is.null(optima)) {
    return(crestline_warn(
      sprintf("another path from %s to %s costs nearly as little: %.3g of its cost.", ends[1],
              ends[2], competing),
      "Give a `via` on the right one, or rule the other out with keep_away() or keep_side().",
      stage = "reference path", id = id, class = "crestline_rival_path"
    ))
  }
  share <- shares_of_first(optima, attr(path, "type"))
  two <- optima[c(1, setdiff(which(share == competing), 1)[1]), ]
  degrees <- two$angle * 180 / pi
  crestline_warn(
    sprintf("two cuts from %s to %s are nearly as good: at %.0f and %.0f degrees (%.3g and %.3g).",
            ends[1], ends[2], degrees[1], degrees[2], two$criterion[1], two$criterion[2]),
    "Look at both with plane_path(); keep_away() or keep_side() rules one out.",
    stage = "reference path", id = id, class = "crestline_rival_path"
  )
}

#' Greatest distance of the points of one path from another
#' @noRd
path_distance <- function(from, to) {
  xyz <- function(path) t(columns_of(path, c("x", "y", "z")))
  max(abs(cpp_path_coordinates(xyz(from), xyz(to), matrix(1, 3, nrow(to)))$d))
}

# Parts of paths, and a reference path that is believed in one part only.

#' A reference path with the shortest cuts between the ends of its trusted part and the landmarks
#'
#' @param scan As of [walkable()].
#' @param trust Where the trusted part begins and ends, as shares of the path's length.
#' @return `mesh_path` with the attribute `trusted`, the arc lengths of that part; or a failure.
#' @noRd
trusted_path <- function(trust, scan, path) {
  if (trust[1] <= 0 && trust[2] >= 1) return(path)
  if (is_closed(path)) {
    return(no_result("a closed curve has no ends between which a part of it is trusted.",
                     "Leave out `trust`; keep_away() says where curvature does not count.",
                     "reference path", scan$id, "crestline_path_error"))
  }
  range <- trust * attr(path, "length")
  at <- columns_of(place_along(scan, path, range))
  ends <- columns_of(path)[c(1, nrow(path)), ]
  between <- function(from, to) {
    exact <- rbind(from, to)
    names <- c(end_name(from), end_name(to))
    find_reference(path_ends(scan, exact, names), "plane", NULL, NULL, scan$search)
  }
  parts <- list(
    if (trust[1] > 0) between(ends[1, ], at[1, ]),
    part_of_path(scan, path, range[1], range[2]),
    if (trust[2] < 1) between(at[2, ], ends[2, ])
  )
  bad <- Find(failed, parts)
  if (!is.null(bad)) return(bad)
  lengths <- vapply(parts, function(part) if (is.null(part)) 0 else attr(part, "length"), 0)
  points <- do.call(rbind, lapply(Filter(Negate(is.null), parts), columns_of))
  path_through(points, scan, trusted = cumsum(lengths)[1:2], type = attr(path, "type"),
               optima = attr(path, "optima"), competing = attr(path, "competing"))
}

check_trusted <- function(trust) {
  if (!is.numeric(trust) || length(trust) != 2 || !all(is.finite(trust)) || trust[1] < 0 ||
      trust[2] > 1 || trust[1] >= trust[2]) {
    crestline_abort(sprintf("`trust` is %s.", describe_value(trust)),
                    "Give two rising shares of the path, such as c(0, 0.75).", stage = "arguments")
  }
  trust
}
