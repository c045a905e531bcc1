#' Reference path: the plane cut that gathers most curvature
#'
#' Of all plane cuts between two points, at every angle and both ways round, the
#' one with the greatest length-weighted mean strength of the sought curvature,
#' among those not much longer than the shortest; or, for `type = "plane"`, the
#' shortest cut. A coarse grid of angles is followed by a finer one about each
#' local optimum.
#'
#' The strength here is that of the principal curvature: a valley's positive
#' `k1` where the shape index is negative, a ridge's `-k2` where it is positive, 0 elsewhere.
#'
#' @param specimen A [specimen()] (or a `mesh3d` with positions for `from` and `to`).
#' @inheritParams plane_path
#' @param type `"ridge"`, `"valley"`, or `"plane"` for the shortest cut.
#' @param radius Radius of the curvature estimates, in the unit of the mesh; not needed for `"plane"`.
#' @param keep_away `NULL`, or region(s) of [keep_away()] where strength counts as 0.
#' @param curvature A `curvature` of the mesh at this radius, where it is already
#'   known; otherwise it is estimated where the cuts may pass.
#' @param reach Cuts stay within this share of the distance between the landmarks
#'   from the straight line between them (the paper: 1/2).
#' @param longest Cuts may be this many times as long as the shortest.
#' @param angles Number of angles of the coarse grid over a half turn.
#' @param refined Number of angles between the neighbours of each local optimum.
#' @param rival Share within which a second optimum is a rival that is warned of.
#' @param distinct A rival runs further than this share of the path's length from it at some place.
#' @inheritParams curvature
#' @param ... Further arguments of [curvature()], where it is not given; [ridge_curve()] uses the `order` of its settings.
#' @return A `mesh_path` as of [plane_path()], with attributes `type`, `criterion`
#'   (mean strength in 1 / unit, or length), and `optima`: data frame with a row for every local
#'   optimum, best first: `angle` (radians), `side`, `criterion`, `length`.
#' @section Errors: of class `crestline_path_error`, when no plane cut joins the points.
#' @section Warnings: of class `crestline_rival_path`, when another optimum is
#'   nearly as good; the warning names both angles.
#' @references Vittert, Bowman and Katina (2019), "the paper" (see [crestline-package]), section 3.1.
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
                           keep_away = NULL, curvature = NULL, reach = 0.5, longest = 1.25,
                           angles = 60, refined = 21, rival = 0.05, distinct = 0.05,
                           threads = getOption("crestline.threads", 1L), ...) {
  type <- check_choice(type, c("ridge", "valley", "plane"), "type")
  surface <- walkable(specimen)
  ends <- path_ends(specimen, surface, from, to)
  axis <- cut_axis(surface, ends)
  strength <- numeric()
  if (type != "plane") {
    curvature <- known_curvature(curvature, specimen, radius,
                                 near_segment(surface, ends, reach * axis$span + radius), threads, ...)
    strength <- path_strength(curvature, type, keep_away, specimen, surface)
  }
  cuts <- function(angle, side) {
    found <- cpp_plane_cuts(surface$xyz, surface$it, surface$twin, ends$from, ends$to,
                            plane_normal(axis, angle), side, reach * axis$span, strength)
    data.frame(angle = angle, side = side, length = found$length,
               criterion = if (type == "plane") -found$length else found$strength, end = found$end)
  }
  optima <- cut_optima(cuts, angles, refined, longest)
  if (nrow(optima) == 0) abort_no_cut(cuts(0, 0L)$end, ends, surface$id)
  cut <- function(optimum) {
    found <- cpp_plane_path(surface$xyz, surface$it, surface$twin, ends$from, ends$to,
                            plane_normal(axis, optimum$angle), optimum$side, reach * axis$span)
    new_path(found$points, ends, angle = optimum$angle, side = optimum$side, type = type)
  }
  path <- cut(optima[1, ])
  warn_rival(optima, path, cut, rival, distinct, ends, surface$id)
  if (type == "plane") optima$criterion <- optima$length
  structure(path, criterion = optima$criterion[1], optima = optima)
}

#' Local optima of the criterion over angle and side, refined, best first
#'
#' @param digits Criteria that agree to this many significant digits are equal: on a straight feature many
#'   planes cut one line. Of equal cuts the shortest counts, then the straightest in.
#' @noRd
cut_optima <- function(cuts, angles, refined, longest, digits = 8) {
  step <- pi / angles
  grid <- -pi / 2 + step * seq_len(angles)
  coarse <- rbind(cuts(grid, rep(0L, angles)), cuts(grid, rep(1L, angles)))
  shortest <- suppressWarnings(min(coarse$length, na.rm = TRUE))
  admit <- function(found) {
    found$level <- signif(found$criterion, digits)
    found$extent <- signif(found$length, digits)
    found$level[is.na(found$level) | found$length > longest * shortest] <- -Inf
    found
  }
  coarse <- admit(coarse)
  peaks <- unlist(lapply(split(coarse, coarse$side), function(side) {
    lapply(circular_peaks(side$level), function(run) best_cuts(side[run, ])[1, ])
  }), recursive = FALSE)
  best <- lapply(peaks, function(peak) {
    fine <- peak$angle + step * seq(-1, 1, length.out = refined)
    best_cuts(rbind(peak, admit(cuts(fine, rep(peak$side, refined)))))[1, ]
  })
  if (length(best) == 0) return(data.frame())
  best <- do.call(rbind, best)
  best$angle <- wrap_angle(best$angle)
  best <- best_cuts(best)[c("angle", "side", "criterion", "length")]
  best <- best[!duplicated(round(best[c("angle", "side")], 6)), ]
  rownames(best) <- NULL
  best
}

#' Cuts in order: greatest criterion, least length, smallest angle
#' @noRd
best_cuts <- function(found) found[order(-found$level, found$extent, abs(found$angle)), ]

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

#' Strength of the principal curvature at the vertices, 0 where it is not known or not wanted
#' @noRd
path_strength <- function(curvature, type, keep_away, specimen, surface) {
  strength <- strength_at(curvature, type)
  strength[is.na(strength)] <- 0
  if (is.null(keep_away)) return(strength)
  some <- which(strength > 0)
  strength[some][is_kept_away(keep_away, specimen, t(surface$xyz[, some, drop = FALSE]))] <- 0
  strength
}

#' Vertices within a distance of the straight segment between the ends, on their piece
#' @noRd
near_segment <- function(surface, ends, distance) {
  a <- unlist(ends$exact[1, c("x", "y", "z")])
  axis <- unlist(ends$exact[2, c("x", "y", "z")]) - a
  relative <- surface$xyz - a
  along <- pmin(pmax(as.vector(axis %*% relative) / sum(axis^2), 0), 1)
  near <- colSums((relative - outer(axis, along))^2) <= distance^2
  own <- logical(length(near))
  own[surface$it[, surface$piece == surface$piece[ends$exact$face[1]]]] <- TRUE
  which(near & own)
}

#' The curvature that was given, after a check, or estimated at the vertices that need it
#'
#' `vertices` is a promise: it costs nothing where the curvature is given.
#' @noRd
known_curvature <- function(curvature, specimen, radius, vertices, threads, ...) {
  if (is.null(curvature)) {
    return(crestline::curvature(specimen, radius, threads = threads, vertices = vertices, ...))
  }
  check_class(curvature, "curvature", "curvature", "curvature()")
  n <- ncol(as_mesh(specimen)$vb)
  if (length(curvature$k1) != n) {
    crestline_abort(sprintf("`curvature` has %d vertices, the mesh %d.", length(curvature$k1), n),
                    "Give the curvature of this specimen's own mesh: curvature(specimen, radius).",
                    stage = "curvature", id = specimen$id)
  }
  curvature
}

abort_no_cut <- function(end, ends, id) {
  crestline_abort(
    sprintf("no plane cut joins %s and %s (at angle 0 it ends: %s).", ends$names[1], ends$names[2], end),
    "Look for a hole between the landmarks, or raise `reach` if the feature bends far out.",
    stage = "reference path", id = id, class = "crestline_path_error"
  )
}

#' Warn of a second cut nearly as good that runs elsewhere
#'
#' @param cut Function of one row of `optima` that gives its path.
#' @noRd
warn_rival <- function(optima, path, cut, rival, distinct, ends, id) {
  best <- optima[1, ]
  near <- which(optima$criterion >= best$criterion - rival * abs(best$criterion))[-1]
  apart <- vapply(near, function(i) path_distance(cut(optima[i, ]), path), 0)
  near <- near[apart > distinct * attr(path, "length")]
  if (length(near) == 0) return(invisible())
  other <- optima[near[1], ]
  crestline_warn(
    sprintf("two cuts from %s to %s are nearly as good: at %.0f and %.0f degrees (%.3g and %.3g).",
            ends$names[1], ends$names[2], best$angle * 180 / pi, other$angle * 180 / pi,
            abs(best$criterion), abs(other$criterion)),
    "Look at both with plane_path(); keep_away() rules one out.",
    stage = "reference path", id = id, class = "crestline_rival_path"
  )
}

#' Greatest distance of the points of one path from another
#' @noRd
path_distance <- function(from, to) {
  xyz <- function(path) t(as.matrix(path[c("x", "y", "z")]))
  max(abs(cpp_path_coordinates(xyz(from), xyz(to), matrix(1, 3, nrow(to)))$d))
}
