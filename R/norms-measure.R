# Measurements of shapes, each with the standard error that follows from its points.

#' Measure distances, angles, lengths, areas and volumes
#'
#' Takes the measurements of a table from a shape, or from all shapes of a sample. Each has the
#' standard error that follows from the standard errors of its points.
#'
#' Standard errors of distances, angles, depths, and of ratios of these, are of first order (the
#' delta method): \eqn{se^2 = J C J'}, where J are the derivatives by the points' co-ordinates and C
#' the covariance of the points. Those of lengths, areas and volumes come from random draws of the
#' points, since errors of neighbouring points of a curve are correlated: the errors across a curve
#' are drawn with correlation \eqn{\exp(-d^2 / (2 range^2))} at distance d along the curve. A curve
#' of kind "plane" has no error of its own; its points follow those of its two ends. Points inside
#' of a patch do not move, as moves along the surface do not change an area.
#'
#' Where at least half of the surface points have a `se` (simulated faces, errors of repeated
#' scans), `se` is that of each co-ordinate of every point, and all points are drawn so. With `range
#' = NULL` the third differences along the curves then show which share of the variance may be
#' independent from point to point; the rest has the correlation \eqn{\exp(-d^2 / (2 range^2))} at
#' distance d, with the median radius of the scheme's curves (without radii: three steps along a
#' curve).
#'
#' Errors also make a measurement larger or smaller on average: independent errors of standard
#' deviation s make a curve whose points are d apart longer by \eqn{2 s^2 / d} a step. `bias` is
#' this mean. Draws with once and twice the variance of the errors are extrapolated to no errors
#' (SIMEX), so that `value - bias` is what a scan without errors would give, on average. [assess()],
#' [fit_norms()] and [compare_visits()] take it off, so that scans of different quality can be
#' compared.
#'
#' @param x A `shape`, as of [fit_shape()] or [slide()], a batch of [fit_shapes()] (without those
#'   that failed), or a `shape_sample`, as of [homologise()].
#' @param table Data frame of measurements, as [face_measurements()] gives it.
#' @param error Standard error of each co-ordinate of a landmark, in the unit of the mesh: one
#'   number, or one for each landmark by name. It is used for landmarks without `se` in the table of
#'   points. `NULL`: they have none, and measurements that need it have `se` NA.
#' @param draws Number of random draws for `bias` and for lengths, areas and volumes. Each is used
#'   with its mirror image. 0: these have `se` NA, and all have `bias` NA.
#' @param range Distance along a curve over which its errors go together, in the unit of the mesh.
#'   `NULL`: the radius of the curve in the scheme, within which its curvature was estimated; where
#'   surface points have errors, see Details. 0: errors of all points are independent.
#' @param seed A whole number for the draws; the random stream of the session is not changed.
#' @return Data frame with a row for each shape and measurement: `id`, `measurement`, `kind`,
#'   `value`, `se` (standard error), `bias` (what errors of the points add to `value` on average; NA
#'   where they are not known), `unit`, `reason` (why `value` or `se` is NA, with what is missing;
#'   otherwise NA). The unit of distances, lengths and depths is "unit", the unit of the mesh; of
#'   areas and volumes "unit^2" and "unit^3"; of angles "degrees"; of ratios "1".
#' @section Errors: of class `crestline_error`: `x` is neither a shape nor a sample, the table has a
#'   name that the scheme has not, or a number is out of its range.
#' @template glossary
#' @references Cook and Stefanski (1994) Simulation-extrapolation estimation in parametric
#'   measurement error models, *Journal of the American Statistical Association* 89, 1314-1328.
#' @seealso [face_measurements()]
#' @examples
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "triangle")
#' shape <- fit_shape(specimen(Rvcg::vcgSphere(4), corners, id = "ball"), scheme, progress = FALSE)
#' table <- data.frame(measurement = c("base", "corner", "edge"),
#'                     kind = c("distance", "angle", "length"),
#'                     of = c("a + b", "a + b + c", "ab"))
#' measurements(shape, table, error = 0.01)
#' @export
measurements <- function(x, table = face_measurements(), error = NULL, draws = 200, range = NULL,
                         seed = 1) {
  check_given()
  x <- measured_ones(x)
  draws <- check_count(draws, "draws", lower = 0)
  if (!is.null(range)) range <- check_number(range, "range", lower = 0)
  seed <- check_seed(seed)
  if (!length(x)) return(no_measurements())
  together <- if (!is.null(range)) list(range = range, share = 1)
  measured_rows(x, table, error, draws, together, seed)
}

#' @param together As in [place_errors()].
#' @noRd
measured_rows <- function(shapes, table, error, draws, together, seed = 1) {
  scheme <- shapes[[1]]$scheme
  plan <- measurement_plan(table, scheme)
  error <- check_landmark_error(error, scheme)
  each <- lapply(unname(shapes), function(shape) {
    measured_shape(shape, plan, error, draws, together, seed)
  })
  rows <- do.call(rbind, each)
  rownames(rows) <- NULL
  rows
}

#' The shapes of what [measurements()] takes; of a batch those that were measured
#' @noRd
measured_ones <- function(x) {
  if (inherits(x, "shape_batch")) {
    if (nrow(failures(x))) {
      crestline_inform(sprintf("without %s that failed: %s.",
                               amount(nrow(failures(x)), "specimen"), shorten(failures(x)$id)))
    }
    return(Filter(Negate(is.null), as.list(x)))
  }
  if (inherits(x, "shape_sample")) {
    validate(x)
    return(x$shapes)
  }
  check_class(x, "shape", "x", "fit_shape(), fit_shapes() or homologise()")
  list(x)
}

no_measurements <- function() {
  data.frame(id = character(), measurement = character(), kind = character(), value = numeric(),
             se = numeric(), bias = numeric(), unit = character(), reason = character())
}

#' @return Numbers by landmark, NA where unknown.
#' @noRd
check_landmark_error <- function(error, scheme) {
  landmark <- scheme$landmarks$landmark
  known <- stats::setNames(rep(NA_real_, length(landmark)), landmark)
  if (is.null(error)) return(known)
  names <- names(error)
  many <- if (is.null(names)) 1 else NULL
  error <- check_numbers(error, "error", many, lower = 0)
  strange <- setdiff(names, landmark)
  if (length(strange)) {
    refuse_argument("error", error, "Name landmarks of the scheme.",
                    sprintf("of a landmark \"%s\" that the scheme has not", strange[1]))
  }
  known[if (is.null(names)) landmark else names] <- error
  known
}

#' The measurements of one shape with their standard errors
#' @param together As in [place_errors()].
#' @noRd
measured_shape <- function(shape, plan, error, draws, together, seed) {
  xyz <- places_of(shape)
  value <- measure_places(plan, array(xyz, c(dim(xyz), 1)))[, 1]
  spread <- place_errors(shape, error, together, unique(unlist(plan_rows(plan))))
  se <- delta_errors(plan, xyz, spread$se)
  # Which measurements need draws: lengths, areas, volumes, and ratios of them
  drawn <- plan_text(plan, "kind") %in% c("length", "area", "volume")
  for (i in seq_along(plan)) if (plan[[i]]$kind == "ratio") drawn[i] <- any(drawn[plan[[i]]$of])
  found <- if (draws > 0) drawn_errors(plan, xyz, value, spread, draws, seed) else
    list(se = rep(NA_real_, length(plan)), bias = rep(NA_real_, length(plan)))
  se[drawn] <- found$se[drawn]
  reason <- rep(NA_character_, length(plan))
  reason[is.na(se)] <- "no standard error of its points: give that of a landmark as `error`"
  reason[drawn & draws == 0] <- "no draws"
  lost <- which(is.na(value))
  reason[lost] <- vapply(lost, missing_words, "", plan, xyz, shape$scheme)
  data.frame(id = shape$id, measurement = names(plan), kind = plan_text(plan, "kind"),
             value = value, se = ifelse(is.na(value), NA_real_, se), bias = unname(found$bias),
             unit = plan_text(plan, "unit"), reason = reason)
}

#' Which landmarks, curves or patches a measurement lacks
#' @noRd
missing_words <- function(i, plan, xyz, scheme, most = 3) {
  step <- plan[[i]]
  at <- unlist(c(step[c("at", "base", "lines", "triangles")],
                 lapply(plan[step$of], `[`, c("at", "base", "lines", "triangles"))))
  lost <- unique(at[is.na(xyz[at, 1])])
  place <- match(scheme$points$place, unique(scheme$points$place))
  # A place of several parts is first that of its landmark
  part <- unique(scheme$points$part[match(lost, place)])
  if (length(part)) sprintf("points are missing: %s", shorten(part, most)) else
    "it cannot be computed from its points"
}

plan_text <- function(plan, name) vapply(plan, `[[`, "", name, USE.NAMES = FALSE)
