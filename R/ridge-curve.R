#' Ridge or valley curve between two landmarks
#'
#' Finds the crest line between two landmarks: the curve of strongest curvature near a first path
#' that joins them. It has five stages, and the value has the result of each:
#'
#' * [reference_path()] finds a reference path between the landmarks;
#' * [path_coordinates()] gives co-ordinates (s, d) along and across this path;
#' * [curvature_surface()] fits a smooth surface of curvature over (s, d);
#' * [ridge_line()] finds the ridge line of this surface;
#' * [lift()] carries the line back to the mesh.
#'
#' [crestline-package] has a glossary.
#'
#' @inheritParams reference_path
#' @param type `"ridge"`, `"valley"`, or `"plane"` for the shortest cut.
#' @param radius Radius of the curvature estimates, in the unit of the mesh; not needed for
#'   `"plane"`. On faces, 10 mm for broad features (the paper: 10 mm) and 5 mm for lips, nose and
#'   eyes (our choice). Or a [curvature()] of the specimen (of `settings$order`), if you have it; it
#'   has its radius. Otherwise curvature is estimated in the region where the curve may lie, by
#'   `getOption("crestline.threads", 1)` threads.
#' @param width Half width of the window: the greatest distance of the curve from the reference
#'   path, in the unit of the mesh. It is limited to `settings$window` radii. Not needed for
#'   `"plane"`.
#' @param n Number of points (semilandmarks), both ends included. The straight distances between
#'   neighbours are equal. The points of a closed curve go once round. The first is its place
#'   nearest to the landmark; the last stands before it.
#' @param settings [ridge_settings()].
#' @param route Where the curve may run, and where curvature counts: as of [curve_route()].
#' @param ... Fields of [curve_route()], such as `keep_away`, which need no `route = `. Former
#'   arguments `passes`, `curvature` and `threads` give a message of class `crestline_deprecated`.
#' @return Object of class `curve`, a list:
#'   * `points`: data frame with n rows, which `as.data.frame()` gives; lengths in the unit of the
#'     mesh. Columns: `point`, `s` (arc length along the curve), `x`, `y`, `z`, `d` (signed distance
#'     from the reference path), `se` (standard error across the curve; 0 at the
#'     landmarks, which are taken as exact), `face`, `w1`, `w2`, `w3`.
#'     If no ridge was found, the points lie on the reference path, and `d` is NA;
#'   * `path`: the whole curve, a `mesh_path`; `length`: its length; `length_se`: the standard error
#'     of the length;
#'   * `reference` (`mesh_path`), `coordinates`, `surface`, `line`: results of the stages of the
#'     last pass. A plane curve has only `reference`; the others are `NULL`. The reference of a
#'     second pass is the curve of the first. `line$kernel` is the half width of the kernel, in the
#'     unit of the mesh. `line$strength` and `line$strength_se` are the smooth strength at `line$s`
#'     and its standard error, in 1 / unit;
#'   * `share`: share of the second pass in the curve; 0 with one pass;
#'   * `noise_factor`: variance of the strengths about their smooth surface, as a multiple of the
#'     variance under independent noise; at least 1 (no unit). Noise that is correlated along the
#'     mesh raises it, and so does fine relief. It is 1 if the noise is known;
#'   * `strength`: mean strength along the curve, 1 / unit; `strength_se`: its standard error;
#'     `scale`: nu0, the mean strength near the reference path;
#'   * `se`: median standard error; `converged`: whether all iterations converged;
#'   * `determined`: whether curvature determines the curve; `NA` for plane curves and without
#'     standard errors. If it is `FALSE`, the plane path (`reference`, or `type = "plane"`) is the
#'     safer choice. `reason` gives the cause:
#'     * the radius exceeds `settings$widest` times the distance of the landmarks, as it does where
#'       it is in another unit than the mesh;
#'     * the curve is longer than `settings$detour` times that distance;
#'     * the median standard error exceeds `settings$undetermined` radii;
#'     * the curve runs along the edge of the window;
#'     * the curvature is fainter than `settings$faint`;
#'     * the line cannot be lifted onto the mesh;
#'     * the path has no such curvature near it;
#'     * of `path = "crest"`: the curve runs twice over. Of a closed curve: it closed in on itself,
#'       or it is much longer than its stops are apart. The limits are those of [path_settings()];
#'   * `closed`: whether the curve ends where it begins;
#'   * `beside`: distances of the two landmarks from the nearest ridge or valley, across that, in
#'     the unit of the mesh. Beyond `settings$beside` radii the curve has a hook at that end. NA if
#'     no ridge is within the width there, if it is fainter than `settings$faint`, or if curvature
#'     is not trusted there;
#'   * `id`, `from`, `to`, `type`, `radius`, `width`, `settings`, `passes`;
#'   * `key`: key of the mesh. Functions that draw or use the curve refuse another mesh.
#' @section Standard error: `se` is the standard deviation of the curve's position across itself,
#'   over repeated scans of the mesh. Without a repeat scan, the noise is first taken to be
#'   independent at each vertex. Every scanner also has smooth noise. Smooth noise leaves small
#'   residuals in each local fit, but it makes the strengths scatter. The variance is therefore
#'   multiplied by `noise_factor`.
#'
#'   Coverage was measured on simulated ridges with noise 0.01 (b = 1 and 2; 36 curves each). With
#'   independent noise the crest lies within two standard errors at 98 % or more of the places. With
#'   noise correlated over one, two and three spacings it does at 83, 66 and 59 % for b = 1. For b =
#'   2 the figures are 98, 91 and 89 %. On blunt ridges the factor sees only part of such noise.
#'
#'   Fine relief counts as noise too. On three clean real scans the median factor of the curves is
#'   24, 49 and 79, and the band is too wide. Two scans of one subject separate noise from relief.
#'   With [ridge_settings()]`(noise = )` of [scan_noise()] the standard error follows the measured
#'   noise. On the same surfaces, with the `direction` of the noise, the crest is within the band at
#'   91, 90 and 91 % of the places for b = 1, and at 96, 95 and 91 % for b = 2 (curves of three
#'   bends; with the true noise 90 to 98 %). A small scan holds few patches of smooth noise. The
#'   standard error is then wider by Student's distribution: two of them hold what two hold of the
#'   normal distribution. A wider radius adds a bias that the standard error does not include.
#'   `vignette("how-good", "crestline")` has the tables.
#' @section Curves that bow, curves that close: With `path = "crest"` or a `via` the reference path
#'   is a path of least cost, see [reference_path()]. Where `from` is `to` and there is a `via` on
#'   the other side, the curve is closed. Its stops only say which crest is meant, and have no say
#'   in where it runs. Smooth surface, ridge line and standard error then go round without a seam.
#'   Long curves get more B-splines and a looser ridge line, see `basis_most` in [ridge_settings()].
#'
#'   The path itself moves with noise at wavelengths below eight radii, and may take another crest
#'   that is as good. The standard error does not know of either, so that its band is too narrow
#'   where noise is high.
#' @section Errors: of class `crestline_error`: a landmark is missing, no path joins the landmarks,
#'   or an argument is wrong. The error names the specimen, the stage and the remedy. Unlike
#'   [fit_shape()], `ridge_curve()` does not bridge holes. A hole that no plane cut passes is such
#'   an error. If a cut passes beside it, the curve may run round it; `determined` is FALSE if it so
#'   reaches the edge of the window.
#' @section Curvature along a curve: `predict(curve$surface, s, d)` at the points' `s` and `d` gives
#'   the smoothed strength, whose mean is `strength`. [curvature()] gives the principal curvatures
#'   at the vertices, without smoothing along the curve. The orders of the local fits differ:
#'   `order = "adaptive cubic"` here, `"adaptive"` in [curvature()]. Report which you took.
#' @section Errors of length and strength: `length_se`, `strength_se` and `line$strength_se` follow
#'   from the same noise by the delta method. Errors of neighbouring places are correlated, and this
#'   is part of them. `length_se` has two parts: the moves of the curve across itself, and their
#'   bias. The landmarks are taken as exact. Noise also makes every path over a mesh a little
#'   longer. This bias is not in `length_se`, nor is the bias of curvature at a wide radius in
#'   `strength_se`.
#' @section Warnings: of class `crestline_undetermined`: curvature does not determine the curve. The
#'   warning of a rival by [reference_path()], and of a wide radius by [curvature()], can occur too.
#' @templateVar where section 3
#' @template paper
#' @examples
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' lip <- ridge_curve(face, "chL", "st", "valley", radius = 5, width = 6, n = 9)
#' lip
#' as.data.frame(lip)
#' @concept crest lines
#' @concept standard error of a curve
#' @export
ridge_curve <- function(specimen, from, to, type = c("ridge", "valley", "plane"), radius, width, n,
                        settings = ridge_settings(), route = curve_route(), ...) {
  check_given(if (identical(type, "plane")) c("radius", "width"))
  check_surface(specimen, "specimen")
  check_ends(from = from, to = to)
  type <- check_choice(type, c("ridge", "valley", "plane"), "type")
  n <- check_count(n, "n", lower = 2)
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  check_class(route, "curve_route", "route", "curve_route()")
  fields <- list(settings = "passes", route = names(route))
  asked <- path_arguments(list(settings = settings, route = route), fields, ..., silent = "route")
  asked$route[c("path", "via")] <- check_route(asked$route$path, asked$route$via, type)
  if (type != "plane") {
    check_number(radius_of(radius), "radius", lower = 0, open = TRUE)
    width <- check_number(width, "width", lower = 0, open = TRUE)
  }
  id <- if (inherits(specimen, "specimen")) specimen$id
  doing <- sprintf("%s from %s to %s", type, end_name(from), end_name(to))
  curve <- in_context(id = id, doing = doing, code = {
    ends <- located_ends(specimen, walkable(specimen), from, to, asked$route$via)
    job <- curve_job(ends, type, n, asked$settings, route = asked$route)
    if (type != "plane") {
      job[c("radius", "width")] <- list(radius_of(radius), width)
      job$source <- source_at(radius, asked, specimen, job$settings$order)
      job$regions <- located_regions(asked$route$keep_away, region_locator(specimen), id)
    }
    trace_curve(job)
  })
  warn_rival(curve$reference, c(curve$from, curve$to), id)
  warn_undetermined(curve)
  if (type != "plane" && !isFALSE(curve$determined)) warn_wide_radius(curve$radius, specimen)
  curve
}

#' What is asked of one curve
#'
#' A caller adds `regions` (as of [located_regions()]; a failure is handed on) and `track` (as in
#' [plane_weight()]), where it has them.
#' @param ends As of [path_ends()]; a failure is handed on.
#' @param type,n,settings,radius,width As in [ridge_curve()].
#' @param source Curvature as of [known_curvature()]; NULL for planes.
#' @param route As of [curve_route()].
#' @param angle_limit Of the planes of the reference path, in radians; NA: none.
#' @noRd
curve_job <- function(ends, type, n, settings, radius = NULL, width = NULL, source = NULL,
                      route = curve_route(), angle_limit = NA) {
  search <- if (!failed(ends)) ends$scan$search
  search$reach <- route$reach
  if (type != "plane") search$longest <- settings$longest
  list(ends = ends, type = type, n = n, settings = settings, passes = settings$passes,
       radius = radius, width = width, source = source, regions = NULL, trust = route$trust,
       angle_limit = angle_limit, track = NULL, search = search, route = route$path)
}

#' One curve, without checks and warnings
#'
#' @param job As of [curve_job()].
#' @return A `curve`, or a failure.
#' @noRd
trace_curve <- function(job) {
  for (needed in job[c("ends", "source", "regions")]) if (failed(needed)) return(needed)
  reference <- curve_reference(job)
  if (failed(reference)) return(reference)
  if (job$type == "plane") return(assembled_curve(reference, reference, job))
  path <- trusted_path(job$trust, job$ends$scan, reference)
  if (failed(path)) return(path)
  long <- job
  if (job$route == "crest") {
    long$settings <- long_settings(job$settings, attr(path, "length"), job$radius)
  }
  fit <- fit_passes(job$ends$scan, path, long)
  if (failed(fit)) return(fit)
  fit <- finished_fit(job$ends$scan, fit, job$radius, long$settings)
  assembled_curve(fit$path, fit$reference, job, fit)
}

#' The reference path of a curve, among all cuts or those at small angles to the surface's normal;
#' where a person drew it, the drawn line
#' @noRd
curve_reference <- function(job) {
  if (!is.null(job$drawn)) return(job$drawn)
  ends <- job$ends
  search <- job$search
  strength <- if (job$type != "plane") {
    path_strength(job$source, job$type, job$regions, ends$scan)
  }
  if (job$route == "crest") return(find_crest(ends, job$type, strength, job$radius, search))
  weight <- plane_weight(job$track, ends)
  if (is.na(job$angle_limit)) {
    return(find_reference(ends, job$type, strength, job$radius, search, weight))
  }
  if (is.null(strength)) {
    return(limited_cut(ends, job$angle_limit, search$limited, search$reach))
  }
  rate <- function(found) {
    weight(found$angle) *
      cut_strength(ends, found, search$reach, search$spacing * job$radius, strength)
  }
  limited_cut(ends, job$angle_limit, search$limited, search$reach, rate, search$longest)
}

#' The one place where a curve comes together
#'
#' @param job As of [curve_job()].
#' @param fit As of [fit_passes()]; NULL for plane curves.
#' @noRd
assembled_curve <- function(path, reference, job, fit = NULL) {
  scan <- job$ends$scan
  path <- begun_as(scan, path, job$ends)
  placed <- spaced_points(scan, path, job$n)
  along <- along_reference(placed, path, reference)
  on_line <- function(values) {
    if (!isTRUE(fit$found) || all(is.na(values))) rep(NA_real_, job$n) else
      stats::approx(fit$line$s, values, along, rule = 2)$y
  }
  d <- if (job$type == "plane") numeric(job$n) else on_line(fit$line$alpha)
  points <- frame_of(c(list(point = seq_len(job$n)), unclass(placed)[c("s", "x", "y", "z")],
                       list(d = d, se = on_line(fit$line$se)),
                       unclass(placed)[c("face", "w1", "w2", "w3")]))
  new_curve(points, path, reference, job, judge_curve(job, fit),
            coordinates = fit$coordinates, surface = fit$surface, line = fit$line,
            strength = mean_strength(scan, path, fit), scale = fit$scale,
            converged = !isFALSE(fit$line$converged) && !isFALSE(fit$surface$converged),
            even = attr(placed, "converged"), share = if (!is.null(fit)) fit$share,
            errors = fit[c("noise_factor", "length_se", "strength_se")])
}

#' A closed curve begins at its place nearest to its landmark; an open one as it does
#' @noRd
begun_as <- function(scan, path, ends) {
  if (!is_closed(path)) return(path)
  begun_at(scan, path, nearest_along(path, ends$exact[1, 1:3]))
}

#' Points of a curve at equal chords; those of a closed one end before its first
#' @noRd
spaced_points <- function(scan, path, n) {
  if (!is_closed(path)) return(resample_path(scan, path, n))
  placed <- resample_path(scan, path, n + 1)
  structure(placed[seq_len(n), ], converged = attr(placed, "converged"))
}

#' Where points of a curve are along its reference path
#' @noRd
along_reference <- function(placed, path, reference) {
  if (!is_closed(path)) return(placed$s / attr(path, "length") * attr(reference, "length"))
  xyz <- function(at) t(columns_of(at, c("x", "y", "z")))
  line <- without_stubs(reference)
  cpp_path_coordinates(xyz(placed), xyz(line), matrix(1, 3, nrow(line)), TRUE)$s
}

#' A curve from its parts: all its fields are declared here
#'
#' @param points,path,reference,coordinates,surface,line,strength,scale,converged As in the value of
#'   [ridge_curve()].
#' @param job As of [curve_job()].
#' @param verdict List of `se`, `determined`, `reason`, `beside`.
#' @param even Whether its points stand at equal chords.
#' @param errors List of `noise_factor`, `length_se` and `strength_se`, `NULL` where there is none.
#' @noRd
new_curve <- function(points, path, reference, job, verdict, coordinates = NULL,
                      surface = NULL, line = NULL,
                      strength = NA_real_, scale = NULL, converged = TRUE, even = TRUE,
                      share = NULL, errors = NULL) {
  error <- function(name) if (is.null(errors[[name]])) NA_real_ else errors[[name]]
  structure(
    list(points = points, path = path, length = attr(path, "length"), reference = reference,
         coordinates = coordinates,
         surface = surface, line = line, strength = strength, scale = scale, se = verdict$se,
         determined = verdict$determined, reason = verdict$reason, id = job$ends$scan$id,
         from = job$ends$names[1], to = job$ends$names[2],
         type = job$type, settings = job$settings, passes = job$passes, radius = job$radius,
         width = job$width,
         key = job$ends$scan$key, converged = converged, even = even, share = share,
         noise_factor = error("noise_factor"), length_se = error("length_se"),
         strength_se = error("strength_se"), closed = is_closed(path), beside = verdict$beside),
    class = "curve"
  )
}

#' Refuse a curve without its points or path
#' @noRd
validate_curve <- function(x) {
  path <- if (is.list(x)) x$path
  right <- inherits(path,
                    "mesh_path") && is.data.frame(x$points) && !is.null(place_columns(x$points)) &&
    is.numeric(x$points$s) && is_error(x$points$se)
  if (right) return(validate_mesh_path(path))
  crestline_abort(paste("the curve lacks its path, or points with co-ordinates, faces, weights",
                        "and errors."),
                  "Give a curve as ridge_curve() returns it, whole.", stage = "ridge curve",
                  id = if (is.list(x)) x$id,
                  call = NULL)
}

#' @exportS3Method
validate.curve <- function(x) validate_curve(x)

# Standard errors, all NA where there are none.
is_error <- function(x) is.numeric(x) || is.logical(x) && length(x) && all(is.na(x))

#' Refuse a curve that does not lie on a mesh
#'
#' @param mesh The specimen or mesh that it is to be used with.
#' @noRd
check_curve_on <- function(curve, mesh, name) {
  if (!is.null(curve$key)) check_same_mesh(curve, mesh, name)
  check_path_on(curve$path, mesh, name)
  check_places(curve$points, passed_mesh(as_mesh(mesh), NULL), name, mesh_of(mesh)$id)
}

#' Whether curvature determines the curve, with the reason where not
#' @noRd
judge_curve <- function(job, fit) {
  if (job$type == "plane") {
    return(list(se = NA_real_, determined = NA, reason = NA_character_,
                beside = c(NA_real_, NA_real_)))
  }
  # Distances of the ends from their ridge, NA where curvature is not trusted
  beside <- if (is.null(fit$beside)) c(NA_real_, NA_real_) else
    ifelse(c(job$trust[1] > 0, job$trust[2] < 1), NA_real_, fit$beside)
  se <- if (is.null(fit$line$se)) NA_real_ else
    stats::median(fit$line$se[-c(1, length(fit$line$se))])
  reasons <- c(radius_doubt(job$radius, job$ends, fit$reference, job$settings$widest),
               if (!fit$found) fit$reason else c(course_fault(job, fit), faint_fault(job, fit, se)))
  reason <- c(reasons[!is.na(reasons)], NA_character_)[1]
  list(se = se, determined = if (!is.na(reason)) FALSE else if (is.na(se)) NA else TRUE,
       reason = reason, beside = beside)
}

#' What is wrong with where a curve runs, NA where nothing
#' @noRd
course_fault <- function(job, fit) {
  if (job$route == "crest") {
    fault <- crest_fault(fit$path, job$ends, job$radius, job$search)
    if (!is.na(fault)) return(fault)
  } else if (is.null(job$drawn)) {
    length <- attr(fit$path, "length")
    if (length > job$settings$detour * job$ends$span) {
      return(sprintf("it is %.2g times as long as its ends are apart, more than %g",
                     length / job$ends$span, job$settings$detour))
    }
  }
  if (!fit$line$at_bound) return(NA_character_)
  scan <- job$ends$scan
  window <- fit$coordinates$vertex[fit$coordinates$inside]
  holed <- any(window %in% border_vertices(scan$it, scan$twin))
  paste0("it runs along the edge of the window",
         if (holed) ", in which there is a hole or border of the mesh")
}

#' What is wrong with the curvature that a curve follows, NA where nothing
#'
#' @param se Its median standard error.
#' @noRd
faint_fault <- function(job, fit, se) {
  limit <- job$settings$undetermined * job$radius
  strength <- fit$scale * job$radius
  if (strength < job$settings$faint) {
    sprintf("the curvature by its reference path is faint: times the radius it is %.3g, below %.3g",
            strength, job$settings$faint)
  } else if (is.na(se) && job$settings$error) {
    "its standard error is not known: no strength in its window depends on the heights"
  } else if (!is.na(se) && se > limit) {
    sprintf("its median standard error, %.3g, exceeds %.3g, which is %g radii", se, limit,
            job$settings$undetermined)
  } else {
    NA_character_
  }
}

warn_undetermined <- function(curve) {
  if (!isFALSE(curve$determined)) return(invisible())
  crestline_warn(
    sprintf("the %s from %s to %s is not determined by curvature: %s.", curve$type, curve$from,
            curve$to, curve$reason),
    if (grepl("another unit than the mesh", curve$reason, fixed = TRUE)) wide_radius_remedy else
      if (grepl("a hole or border", curve$reason, fixed = TRUE))
        "Fill the hole, or measure the curve by a scheme: fit_shape() bridges holes." else
      "Use the shortest plane cut (type = \"plane\"), or another radius.",
    stage = "ridge curve", id = curve$id, class = "crestline_undetermined"
  )
}

#' Length-weighted mean along a path of the strength that the curve was fitted to
#'
#' Corners outside the window are left out of a place's mean.
#' @noRd
mean_strength <- function(scan, path, fit) {
  if (is.null(fit)) return(NA_real_)
  corner <- match(scan$it[, path$face], fit$coordinates$vertex)
  stands_in <- matrix(fit$strengths$rows[fit$strengths$cell[corner]], 3)
  inside <- !is.na(stands_in)
  strength <- fit$strengths$value[stands_in]
  strength[is.na(strength)] <- 0
  weight <- rbind(path$w1, path$w2, path$w3) * inside
  at <- colSums(weight * strength) / colSums(weight)
  middle <- (at[-1] + at[-length(at)]) / 2
  stats::weighted.mean(middle, diff(path$s), na.rm = TRUE)
}

#' @export
as.data.frame.curve <- function(x, ...) {
  check_method_dots(...)
  x$points
}

#' @export
print.curve <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<curve> %s from %s to %s%s\n", x$type, x$from, x$to,
                if (is.null(x$id)) "" else paste0(" on ", x$id)))
    cat(sprintf("  %slength %.4g, %d points", if (isTRUE(x$closed)) "closed, " else "", x$length,
                nrow(x$points)))
    if (!is.na(x$strength)) {
      cat(sprintf(", mean strength %.3g, median standard error %.3g", x$strength, x$se))
    }
    remark <- if (x$type != "plane") curve_remark(x) else NA
    verdict <- paste0(if (x$converged) "converged" else "NOT converged",
                      if (!is.na(x$reason)) paste0("; NOT determined by curvature: ", x$reason))
    said <- c(remark[!is.na(remark)], verdict)
    cat("", strwrap(said, width = 80, indent = 2, exdent = 4), sep = "\n")
    invisible(x)
  })
}

#' @exportS3Method
mesh_of.curve <- function(x) list(key = x$key, id = x$id)

# How much a curve's strength stands out from what lies beside it.

#' Contrast of a curve: mean strength along it over mean strength beside it
#'
#' Beside it are the vertices of its window that are farther than `settings$core` radii from the
#' ridge line.
#'
#' @param curve A `curve`.
#' @return One number without unit: 1 where the curve is no stronger than its surroundings, Inf
#'   where these have no such curvature; NA for plane curves and those that were not found.
#' @noRd
curve_contrast <- function(curve) {
  if (is.null(curve$line) || all(is.na(curve$points$d))) return(NA_real_)
  window <- curve$coordinates[curve$surface$rows, ]
  offset <- stats::approx(curve$line$s, curve$line$alpha, window$s, rule = 2)$y
  beside <- abs(window$d - offset) > curve$settings$core * curve$radius
  if (any(beside)) curve$strength / mean(curve$surface$strength[beside]) else NA_real_
}
