#' Reference path: the plane cut that gathers most curvature
#'
#' Finds a path between two points along which the sought curvature is strong. It is
#' chosen from all plane cuts, at every angle and both ways round, that are not much
#' longer than the shortest. The cut with the greatest length-weighted mean strength
#' is taken; for `type = "plane"`, the shortest cut. A coarse grid of angles is tried
#' first, then a finer one about each local optimum.
#'
#' The strength is that of the principal curvature. For a valley it is `k1` where k1 is
#' positive and the shape index negative. For a ridge it is `-k2` where k2 is negative and
#' the shape index positive. Elsewhere it is 0.
#'
#' @param specimen A [specimen()] (or a `mesh3d` with positions for `from` and `to`).
#' @inheritParams plane_path
#' @param type `"ridge"`, `"valley"`, or `"plane"` for the shortest cut.
#' @param radius Radius of the curvature estimates, in the unit of the mesh; that of `curvature`
#'   where it is given; not needed for `"plane"`.
#' @param keep_away `NULL`, or region(s) of [keep_away()] or [keep_side()] where curvature is
#'   ignored: one, or a list.
#' @param curvature A `curvature` of the mesh at this radius, where it is already
#'   known; otherwise it is estimated where the cuts may pass.
#' @param reach Cuts stay within this share of the distance between the landmarks
#'   from the straight line between them (the paper: 1/2).
#' @param longest Cuts may be this many times as long as the shortest.
#' @param spacing Strength is taken along a cut at places no further apart than this share of
#'   `radius`.
#' @param angles Number of angles of the coarse grid over a half turn.
#' @param refined Number of angles between the neighbours of each local optimum.
#' @param tie Of local optima within this share of the best the shortest cut is taken: curvature is
#'   not known better than to some per cent, and planes that nearly touch the surface gather it on a
#'   ragged way.
#' @param rival Share within which a second optimum is a rival that is warned of.
#' @param distinct A rival runs further than this share of the path's length from it at some place.
#' @inheritParams curvature
#' @param order As in [curvature()], where that is not given; [ridge_curve()] uses the `order` of
#'   its settings.
#' @return A `mesh_path` as of [plane_path()], with attributes `type`, `criterion` (mean strength in
#'   1 / unit, or length), `optima`: data frame with a row for every local optimum, that of the path
#'   first, then from the best on: `angle` (radians), `side`, `criterion`, `length`; and
#'   `competing`: how good the best of those that run elsewhere is, as a share of the path (for
#'   lengths the other way round), NA where there is none.
#' @section Errors: of class `crestline_path_error`, when no plane cut joins the points.
#' @section Warnings: of class `crestline_rival_path`, when another optimum is
#'   nearly as good; the warning names both angles.
#' @references Vittert, Bowman and Katina (2019), "the paper" (see [crestline-package]), section
#'   3.1.
#' @examples
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' path <- reference_path(face, "chL", "st", "valley", radius = 5)
#' path
#' attr(path, "criterion")
#' head(as.data.frame(path), 3)
#' @export
reference_path <- function(specimen, from, to, type = c("ridge", "valley", "plane"),
                           radius = attr(curvature, "radius"),
                           keep_away = NULL, curvature = NULL, reach = 0.5, longest = 1.25,
                           spacing = 0.25, angles = 60, refined = 21, tie = 0.002,
                           rival = 0.05, distinct = 0.05, order = "adaptive",
                           threads = getOption("crestline.threads", 1L)) {
  check_given()
  check_surface(specimen, "specimen")
  threads <- check_threads(threads)
  reach <- check_reach(reach)
  angles <- check_count(angles, "angles")
  refined <- check_count(refined, "refined")
  if (!identical(longest, Inf)) longest <- check_number(longest, "longest", lower = 1)
  check_shares(spacing, tie, rival, distinct)
  check_ends(from = from, to = to)
  keep_away <- check_regions(keep_away)
  order <- check_order(order)
  type <- check_choice(type, c("ridge", "valley", "plane"), "type")
  surface <- walkable(specimen)
  ends <- path_ends(specimen, surface, from, to)
  axis <- cut_axis(surface, ends)
  rate <- if (type == "plane") {
    function(found) -found$length
  } else {
    check_number(radius, "radius", lower = 0, open = TRUE)
    curvature <- known_curvature(curvature, specimen, radius, threads, order)
    strength <- path_strength(curvature, type, keep_away, specimen)
    function(found) cut_strength(surface, ends, axis, found, reach, spacing * radius, strength)
  }
  measure <- function(angle, side) measure_cuts(surface, ends, axis, angle, side, reach)
  optima <- cut_optima(measure, rate, angles, refined, longest, tie)
  if (nrow(optima) == 0) abort_no_cut(measure(0, 0L)$end, ends, surface$id)
  cut <- function(i) cut_path(surface, ends, axis, optima$angle[i], optima$side[i], reach,
                              type = type)
  path <- cut(1)
  other <- first_elsewhere(path, nrow(optima), cut, distinct)
  if (type == "plane") optima$criterion <- optima$length
  competing <- if (is.na(other)) NA_real_ else optima$criterion[other] / optima$criterion[1]
  if (type == "plane") competing <- 1 / competing
  if (isTRUE(competing >= 1 - rival)) warn_rival(optima[c(1, other), ], ends, surface$id)
  structure(path, criterion = optima$criterion[1], optima = optima, competing = competing)
}

#' Lengths of plane cuts, NA where a cut does not arrive
#' @return Data frame `angle`, `side`, `length`, `end`.
#' @noRd
measure_cuts <- function(surface, ends, axis, angle, side, reach) {
  found <- cpp_plane_cuts(surface$vb, surface$it, surface$twin, ends$from, ends$to,
                          plane_normal(axis, angle), side,
                          reach * axis$span)
  frame_of(list(angle = angle, side = side, length = found$length, end = found$end))
}

#' Mean strength along plane cuts, at places no further apart than `step`
#'
#' @param found Cuts as of [measure_cuts()], all arrived.
#' @param strength Function of vertices.
#' @noRd
cut_strength <- function(surface, ends, axis, found, reach, step, strength) {
  if (nrow(found) == 0) return(numeric())
  at <- cpp_cut_weights(surface$vb, surface$it, surface$twin, ends$from, ends$to,
                        plane_normal(axis, found$angle),
                        found$side, reach * axis$span, step)
  vertex <- unique(at$vertex)
  value <- strength(vertex)[match(at$vertex, vertex)]
  as.vector(rowsum(at$weight * value, at$cut, reorder = FALSE))
}

#' Local optima of the criterion over angle and side, refined, best first
#'
#' @param measure Function of angles and sides, as [measure_cuts()].
#' @param rate Function of measured cuts that gives their criterion.
#' @param digits Criteria that agree to this many significant digits are equal: on a straight
#'   feature many planes cut one line. Of equal cuts the shortest counts, then the straightest in.
#' @noRd
cut_optima <- function(measure, rate, angles, refined, longest, tie, digits = 8) {
  step <- pi / angles
  coarse <- measure(rep(-pi / 2 + step * seq_len(angles), 2), rep(0:1, each = angles))
  if (all(is.na(coarse$length))) return(data.frame())
  rated <- rater(rate, longest * min(coarse$length, na.rm = TRUE), digits)
  coarse <- rated(coarse)
  on_side <- split(seq_len(2 * angles), coarse$side)
  peaks <- unlist(lapply(on_side, function(side) {
    vapply(circular_peaks(coarse$level[side]), function(run) best_cut(coarse, side[run]), 0L)
  }), use.names = FALSE)
  around <- step * seq(-1, 1, length.out = refined)
  fine <- rated(measure(rep(coarse$angle[peaks], each = refined) + around,
                        rep(coarse$side[peaks], each = refined)))
  all <- Map(c, lapply(coarse, `[`, peaks), fine)
  of_peak <- c(seq_along(peaks), rep(seq_along(peaks), each = refined))
  best <- vapply(split(seq_along(of_peak), of_peak), function(near) best_cut(all, near), 0L)
  all$angle <- wrap_angle(all$angle)
  tied <- all$level[best] >= max(all$level[best]) - tie * abs(max(all$level[best]))
  best <- best[order(!tied, ifelse(tied, 0, -all$level[best]), all$extent[best], -all$level[best],
                     abs(all$angle[best]))]
  best <- best[!duplicated(round(cbind(all$angle, all$side)[best, , drop = FALSE], 6))]
  frame_of(lapply(all[c("angle", "side", "criterion", "length")], `[`, best))
}

#' A function that gives measured cuts, as a list, their criterion, and the rounded criterion and
#' length they are compared by
#' @noRd
rater <- function(rate, limit, digits) {
  function(found) {
    allowed <- which(found$length <= limit)
    criterion <- rep(NA_real_, length(found$length))
    criterion[allowed] <- rate(frame_of(lapply(unclass(found), `[`, allowed)))
    level <- signif(criterion, digits)
    level[is.na(level)] <- -Inf
    c(unclass(found)[c("angle", "side", "length")],
      list(criterion = criterion, level = level, extent = signif(found$length, digits)))
  }
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
#' @param curvature As of [known_curvature()].
#' @noRd
path_strength <- function(curvature, type, keep_away, specimen) {
  vb <- as_mesh(specimen)$vb
  function(vertices) {
    strength <- strength_at(curvature(vertices), type)
    strength[is.na(strength)] <- 0
    if (is.null(keep_away)) return(strength)
    some <- which(strength > 0)
    strength[some][is_kept_away(keep_away, specimen, t(vb[1:3, vertices[some], drop = FALSE]))] <- 0
    strength
  }
}

#' Curvature as a function of vertices: the one that was given, after a check, or estimated where it
#' is asked for
#' @noRd
known_curvature <- function(curvature, specimen, radius, threads, order = "adaptive") {
  # A source of curvature, as of curvature_source(), not any function.
  if (is.function(curvature) && identical(names(formals(curvature)), "vertices")) return(curvature)
  if (is.null(curvature)) return(curvature_source(specimen, radius, order, threads))
  check_curvature_on(curvature, specimen)
  function(vertices) curvature_rows(curvature, vertices)
}

abort_no_cut <- function(end, ends, id) {
  crestline_abort(
    sprintf("no plane cut joins %s and %s (at angle 0 it ends: %s).", ends$names[1], ends$names[2],
            end),
    "Look for a hole between the landmarks, or raise `reach` if the feature bends far out.",
    stage = "reference path", id = id, class = "crestline_path_error"
  )
}

#' The best of the other optima that runs elsewhere, NA where none does
#'
#' @param cut Function of an optimum's row that gives its path.
#' @noRd
first_elsewhere <- function(path, count, cut, distinct) {
  for (i in seq_len(count)[-1]) {
    if (path_distance(cut(i), path) > distinct * attr(path, "length")) return(i)
  }
  NA_integer_
}

#' Warn of a second cut nearly as good that runs elsewhere
#'
#' @param two The two rows of `optima`.
#' @noRd
warn_rival <- function(two, ends, id) {
  degrees <- two$angle * 180 / pi
  crestline_warn(
    sprintf("two cuts from %s to %s are nearly as good: at %.0f and %.0f degrees (%.3g and %.3g).",
            ends$names[1], ends$names[2], degrees[1], degrees[2], two$criterion[1],
            two$criterion[2]),
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
