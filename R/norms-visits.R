# Two visits of one person: what has changed, against the errors of both scans.

#' Compare two visits of one person
#'
#' Lays the second shape on the first without scaling, and gives the change of surface points,
#' patches, curves and measurements with its standard error. A change is called if it is more than
#' the errors of both scans explain.
#'
#' The registration is robust by default (Tukey's weights): points that changed do not pull the
#' rest. With `unchanged`, the points of these patches alone are used, by least squares. The change
#' of a point is along its normal on the first visit.
#'
#' With `norms`, the growth that they expect between the two ages is subtracted: the first visit is
#' moved to the second age as if size, measurements and every point kept their z, and the second
#' visit is compared with that. The standard error of this growth by the norm is added. A person's
#' own growth differs from that. A norm of people who were seen once does not show by how much, so
#' that it is not in the errors. Points of curves that are not on the surface grow as the nearest
#' surface point.
#'
#' The smallest detectable change of a point is \eqn{t \sqrt{se_1^2 + se_2^2}}, less what laying
#' the visits on each other takes up. t is 1.96; for errors of [visit_errors()] it is Student's
#' quantile. Errors of a co-ordinate at distance d have the correlation
#' \eqn{share \exp(-d^2 / (2 range^2))}; along the normals it is smaller where these turn. Means of
#' curves and patches have the standard error that follows. The family-wise limit over all surface
#' points is the 95 % quantile of the largest standardised error. For independent errors it has a
#' closed form; otherwise errors are drawn.
#'
#' @param before,after Shapes of one scheme, slid against one template ([slide()]).
#' @param error A number: standard error of a co-ordinate of a point at one visit, in the unit of
#'   the mesh. It is used for points without `se`, or with 0; [repeatability()] and [scan_noise()]
#'   measure it. Or errors from repeated scans, see [visit_errors()]: they replace `se` of all
#'   points, and `range` and `share` of the settings. `NULL`: points without `se` are not assessed.
#' @param unchanged Names of patches that did not change. `NULL`: not known.
#' @param table Measurements, as in [measurements()]. `NULL`: those of the face for its scheme.
#' @param norms A `shape_norms` whose expected growth is subtracted, as of [fit_norms()]. `NULL`:
#'   growth is not subtracted.
#' @param ages Two numbers: the ages at both visits, the first not above the second, in the unit of
#'   the norm's ages.
#' @param sex As in [assess()].
#' @param settings [visit_settings()].
#' @return Object of class `visit_comparison`, a list:
#'   * `points`: data frame with a row for each curve and surface point: `level`, `part`, `point`,
#'     `x`, `y`, `z` (first visit), `growth` (expected, along the normal; 0 without `norms`),
#'     `se_growth` (its standard error, part of `se`), `change` (along the normal, outward positive,
#'     without growth), `se`, `detectable` (from which change on a point that was chosen
#'     beforehand has p < 0.05), all in the unit of the mesh; `df` (degrees of freedom of the errors
#'     of [visit_errors()]; otherwise Inf), `score` (change over `se`, with `df` as the normal
#'     number of the same probability), `called` (surface points: beyond the family-wise limit);
#'   * `parts`: data frame with a row for each curve and patch: `level`, `part`, `change` (mean),
#'     `se`, `detectable`, `p`, `p_holm`, `called`;
#'   * `measurements`: data frame: `measurement`, `before`, `after` (both less the `bias` of
#'     [measurements()] where it is known of both), `growth`, `change` (without growth; NA if the
#'     norm has not this measurement), `se`, `detectable`, `p`, `p_holm`, `unit`;
#'   * `limit` (of the scores), `weights` (of the registration, by surface point), `converged`,
#'     `robust` (whether the registration was), `ids`, `alpha` (1 - `level` of the settings), `unit`
#'     (of lengths: "mm" for [face_scheme()], otherwise "unit"), `triangles` (3 x m, rows of the
#'     surface points), `growth` (in words; `NULL` if none is subtracted), `front` (3 x 3
#'     rotation to the front of the first visit), `provenance`.
#'
#'   `as.data.frame()` gives `points`.
#' @section Errors: of class `crestline_error`: the shapes have different schemes, or fewer than
#'   three points in common; `unchanged` names no patch; the sizes differ as units do (5 times);
#'   the second is a mirror image of the first; the norm is of another scheme, or does not have
#'   these ages; `error` has names of landmarks.
#' @section Warnings: of class `crestline_not_converged`: the weights still change after the last
#'   round. Of class `crestline_visit_doubt`: more than half of the surface points changed, so that
#'   the registration may be wrong: another person, unit or expression, or a child that grew. Of
#'   class `crestline_not_slid`: a measured shape was not slid. Of class
#'   `crestline_red_parts`: parts of a shape are red.
#' @template glossary
#' @template experimental
#' @seealso [plot.visit_comparison()], its page [write_page()], [assess()], [visit_errors()],
#'   [repeatability()]
#' @examples
#' \donttest{
#' lesion <- data.frame(height = 3, radius = 15, visit = 2)
#' cohort <- simulate_cohort(1, lesions = lesion, visits = 2, seed = 1)
#' compare_visits(cohort$sample[[1]], cohort$second[[1]])
#' }
#' @export
compare_visits <- function(before, after, error = NULL, unchanged = NULL, table = NULL,
                           norms = NULL, ages = NULL, sex = NULL, settings = visit_settings()) {
  check_given()
  check_class(before, "shape", "before", "slide()")
  check_class(after, "shape", "after", "slide()")
  check_class(settings, "visit_settings", "settings", "visit_settings()")
  check_same_scheme(after, before)
  known <- visits_with_errors(before, after, error, settings)
  growth <- checked_growth(known, norms, ages, sex)
  scheme <- before$scheme
  table <- norm_measurements(table, scheme)
  surface <- before$points$level == "surface"
  if (!is.null(unchanged)) {
    unchanged <- check_choices(unchanged, unique(before$points$part[surface]), "unchanged")
  }
  used <- surface & (is.null(unchanged) | before$points$part %in% unchanged)
  for (shape in list(before, after)) warn_unready(shape, "visits")
  known$grown <- known$before
  if (!is.null(growth)) {
    known$grown$points[c("x", "y", "z")] <- point_columns(before) + growth$move
  }
  fit <- lay_visit(known$grown, known$after, used, is.null(unchanged), known$error, settings)
  covariance <- change_covariance(known, fit$weight)
  points <- changed_points(known, fit$laid, diag(covariance), growth$se)
  assessed <- points$level == "surface" & !is.na(points$score)
  limit <- visit_limit(covariance[assessed, assessed, drop = FALSE], known$settings)
  points$called <- assessed & abs(points$score) > limit
  if (is.null(unchanged)) warn_most_changed(points$called, assessed, growth, after$id)
  unit <- length_unit(scheme_hash(scheme))
  structure(list(points = points, parts = changed_parts(points, covariance, known$settings),
                 measurements = changed_measurements(known, table, growth, unit), limit = limit,
                 weights = fit$weight[surface], converged = fit$converged,
                 ids = c(before$id, after$id), alpha = 1 - settings$level,
                 robust = is.null(unchanged), growth = growth$words, unit = unit,
                 triangles = model_triangles(scheme, FALSE),
                 front = own_pose(coords(before, "landmarks"), scheme),
                 provenance = shapes_provenance(list(before, after))),
            class = "visit_comparison")
}

#' Both visits with their errors: their own, or those of repeated scans
#' @return List: `before`, `after`, `error` (for points without any, or NULL), `settings`,
#'   `together` (as in [place_errors()]), `df` (of the errors of each point; Inf if they are given).
#' @noRd
visits_with_errors <- function(before, after, error, settings) {
  if (!inherits(error, "visit_errors")) {
    if (!is.null(names(error))) {
      refuse_argument("error", error, "Give one number, of all points without `se`.",
                      "of single landmarks")
    }
    if (!is.null(error)) error <- check_number(error, "error", lower = 0, open = TRUE)
    before <- without_zero_errors(before)
    after <- without_zero_errors(after)
    together <- if (settings$range > 0 && has_coordinate_errors(before)) {
      settings[c("range", "share")]
    }
    return(list(before = before, after = after, error = error, settings = settings,
                together = together, df = rep(Inf, nrow(before$points))))
  }
  if (!identical(error$hash, scheme_hash(before$scheme))) {
    crestline_abort("`error` is of another scheme.", "Give repeated scans of this scheme.",
                    stage = "visits")
  }
  settings[c("range", "share")] <- error[c("range", "share")]
  before <- without_zero_errors(with_errors(before, error))
  after <- without_zero_errors(with_errors(after, error))
  list(before = before, after = after, error = NULL, settings = settings,
       together = error[c("range", "share")], df = error$points$df)
}

#' A standard error of 0 is none: every change would be called
#' @noRd
without_zero_errors <- function(shape) {
  shape$points$se[which(shape$points$se == 0)] <- NA
  shape
}

#' Most of the face has changed: the registration takes most of it to be as it was
#' @noRd
warn_most_changed <- function(called, assessed, growth, id) {
  share <- if (any(assessed)) mean(called[assessed]) else 0
  if (share <= 0.5) return(invisible())
  crestline_warn(sprintf("%.0f %% of the surface points changed; the registration needs %s.",
                         100 * share, "that most did not"),
                 paste0("See whether both visits are of one person and in one unit",
                        if (is.null(growth)) " (a child grows: give `norms`)",
                        ", or name `unchanged` patches."),
                 stage = "visits", id = id, class = "crestline_visit_doubt")
}

#' Settings of the comparison of two visits
#'
#' @param tukey Residual, in robust standard deviations, beyond which a point has no weight in the
#'   registration.
#' @param rounds,tolerance Most rounds of the registration; it ends when no weight changes by more.
#' @param range,share Distance over which errors go together, in the unit of the mesh (0: points are
#'   independent), and the share of their variance that does. See [visit_errors()].
#' @param draws Number of drawn errors for the family-wise limit.
#' @param level Probability that no unchanged point is called.
#' @param seed Seed of these draws; the random stream of the session is not changed.
#' @param ... Nothing: an unknown name is an error.
#' @return A list of these settings, of class `visit_settings`.
#' @section Errors: of class `crestline_error`: a value is out of its range.
#' @template glossary
#' @template experimental
#' @seealso [compare_visits()]
#' @examples
#' visit_settings(range = 8)
#' @export
visit_settings <- function(tukey = 4.685, rounds = 100L, tolerance = 1e-4, range = 0,
                           share = 1, draws = 1000L, level = 0.95, seed = 1L, ...) {
  new_settings("visit_settings", check_visit_settings, list(...))
}

check_visit_settings <- function(settings) {
  settings$tukey <- check_number(settings$tukey, "tukey", lower = 0, open = TRUE)
  settings$rounds <- check_count(settings$rounds, "rounds")
  settings$tolerance <- check_number(settings$tolerance, "tolerance", lower = 0)
  settings$range <- check_number(settings$range, "range", lower = 0)
  settings$share <- check_number(settings$share, "share", 0, 1)
  settings$draws <- check_count(settings$draws, "draws", lower = 100)
  settings$level <- check_number(settings$level, "level", 0, 1, open = TRUE)
  settings$seed <- check_seed(settings$seed)
  settings
}

#' @export
print.visit_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<visit_settings> of compare_visits()")
}

#' The second visit laid on the first, rigidly
#'
#' @param used Rows of the points that the registration may use.
#' @param robust Whether points that moved more than others lose their weight.
#' @return List: `laid` (matrix of all points), `weight` (of each, NA where not used), `converged`.
#' @noRd
lay_visit <- function(before, after, used, robust, error, settings) {
  a <- point_columns(before)
  b <- point_columns(after)
  used <- which(used & !is.na(a[, 1]) & !is.na(b[, 1]))
  if (length(used) < 3) {
    crestline_abort("the two visits have fewer than three of these points in common.",
                    "Measure them again, or name other `unchanged` patches.", stage = "visits",
                    id = after$id)
  }
  spread <- function(x) sqrt(sum(sweep(x, 2, colMeans(x))^2))
  check_size_ratio(spread(b[used, ]) / spread(a[used, ]), paste("the first visit,", before$id),
                   after$id, "visits")
  check_not_mirrored(b[used, ], a[used, ], paste("the first visit,", before$id), after$id,
                     "visits")
  se <- visit_error(before, after, error)[used]
  own <- if (anyNA(se)) rep(1, length(used)) else se
  weight <- rep(1, length(used))
  converged <- !robust
  for (round in seq_len(if (robust) settings$rounds else 1)) {
    move <- weighted_move(b[used, ], a[used, ], weight)
    if (!robust) break
    off <- row_lengths(move(b[used, ]) - a[used, ]) / own
    # 1.538: the median length of three standard normal numbers; 1e-6 of an error is rounding
    share <- off / (settings$tukey * max(stats::median(off) / 1.538, 1e-6))
    new <- ifelse(share < 1, (1 - share^2)^2, 0)
    moved <- max(abs(new - weight))
    weight <- new
    if (moved < settings$tolerance) converged <- TRUE
    if (converged) break
  }
  if (!converged) {
    crestline_warn(sprintf("after %d rounds weights still change by %.2g.", settings$rounds, moved),
                   "Give more `rounds`, or `unchanged` patches.", stage = "visits", id = after$id,
                   class = "crestline_not_converged")
  }
  list(laid = move(b), weight = replace(rep(NA_real_, nrow(a)), used, weight),
       converged = converged)
}

#' Standard errors of the change of points, NA where one of the visits has none
#' @noRd
visit_error <- function(before, after, error) {
  own <- function(shape) {
    se <- shape$points$se
    if (!is.null(error)) se[is.na(se)] <- error
    se
  }
  sqrt(own(before)^2 + own(after)^2)
}

#' Covariance of the errors of change along the normals, curve and surface points
#'
#' Errors of a co-ordinate go together at two points as `together_at()` says; along two normals by
#' their product less. The registration takes up what is rigid in them: of errors e, weights W and
#' the derivatives J of a rigid motion, e - J (J'WJ)^-1 J'We is left.
#'
#' @param known As in [changed_points()].
#' @param weight Of each point in the registration, NA where it is not used.
#' @return Matrix, NA for points without errors.
#' @noRd
change_covariance <- function(known, weight) {
  own <- which(known$before$points$level != "landmarks")
  xyz <- point_columns(known$before)[own, ]
  normal <- row_normals(known$before)[own, ]
  se <- visit_error(known$before, known$after, known$error)[own]
  there <- which(!is.na(se) & !is.na(xyz[, 1]))
  empty <- matrix(NA_real_, length(own), length(own))
  if (!length(there)) return(empty)
  normal <- normal[there, , drop = FALSE]
  xyz <- xyz[there, , drop = FALSE]
  errors <- together_at(xyz, known$settings) * outer(se[there], se[there])
  along <- errors * tcrossprod(normal)
  w <- weight[own][there]
  w[is.na(w)] <- 0
  if (sum(w > 0) >= 3) along <- along - taken_up(xyz, normal, errors, w)
  empty[there, there] <- along
  empty
}

#' What a rigid registration takes of the covariance along the normals
#' @param errors Covariance of a co-ordinate, k x k; `w` weights.
#' @noRd
taken_up <- function(xyz, normal, errors, w) {
  x <- sweep(xyz, 2, colSums(xyz * w) / sum(w))
  # Turns by shifts of the size of the object: the unit of the mesh does not matter
  x <- x / sqrt(sum(w * x^2) / sum(w))
  one <- rep(1, nrow(x))
  zero <- 0 * one
  # How each co-ordinate moves with three shifts and three turns
  move <- list(cbind(one, zero, zero, zero, x[, 3], -x[, 2]),
               cbind(zero, one, zero, -x[, 3], zero, x[, 1]),
               cbind(zero, zero, one, x[, 2], -x[, 1], zero))
  inner <- solve(Reduce(`+`, lapply(move, function(j) crossprod(j, j * w))))
  spread <- lapply(move, function(j) errors %*% (j * w))
  motion <- inner %*% Reduce(`+`, Map(function(j, s) crossprod(j * w, s), move, spread)) %*% inner
  along <- Reduce(`+`, lapply(1:3, function(d) normal[, d] * move[[d]]))
  both <- Reduce(`+`, lapply(1:3, function(d) normal[, d] * spread[[d]])) %*% inner
  cross <- tcrossprod(both, along)
  cross + t(cross) - along %*% motion %*% t(along)
}

#' Change of the points along the normals of the first visit
#'
#' @param known List: `before`, `after`, `grown` (the first visit at the second age), `error`,
#'   `settings`.
#' @param variance Of the errors of the scans, of curve and surface points.
#' @param se_growth Standard error of the growth along the normals by row, or NULL.
#' @noRd
changed_points <- function(known, laid, variance, se_growth = NULL) {
  points <- known$before$points
  normal <- row_normals(known$before)
  at <- point_columns(known$grown)
  change <- row_products(laid - at, normal)
  if (is.null(se_growth)) se_growth <- numeric(nrow(points))
  found <- data.frame(points[c("level", "part", "point", "x", "y", "z")],
                      growth = row_products(at - point_columns(known$before), normal),
                      se_growth = se_growth, change = change)
  found$df <- known$df
  found <- found[found$level != "landmarks", ]
  found$se <- sqrt(variance + found$se_growth^2)
  found$detectable <- stats::qt(0.975, found$df) * found$se
  found$score <- normal_score(found$change / found$se, found$df)
  rownames(found) <- NULL
  found
}

#' The family-wise limit of scores: the quantile of the largest of many errors
#' @param covariance Of the surface points that are assessed.
#' @noRd
visit_limit <- function(covariance, settings) {
  k <- nrow(covariance)
  if (!k) return(NA_real_)
  if (settings$range == 0 || settings$share == 0) {
    return(stats::qnorm((1 + settings$level^(1 / k)) / 2))
  }
  root <- chol(stats::cov2cor(covariance) + diag(1e-6, k))
  largest <- with_seed(settings$seed, vapply(seq_len(settings$draws), function(i) {
    max(abs(crossprod(root, stats::rnorm(k))))
  }, 0))
  stats::quantile(largest, settings$level, names = FALSE)
}

#' From which change on points are called: the limit is of scores, see [normal_score()]
#' @param points Data frame: `se`, `df`.
#' @noRd
called_from <- function(limit, points) {
  -stats::qt(stats::pnorm(-limit, log.p = TRUE), points$df, log.p = TRUE) * points$se
}

#' Mean change of curves and patches, with correlated errors of its points
#' @param covariance Of [change_covariance()].
#' @noRd
changed_parts <- function(points, covariance, settings) {
  key <- paste(points$level, points$part)
  each <- lapply(split(seq_along(key), factor(key, unique(key))), function(rows) {
    known <- rows[!is.na(points$score[rows])]
    # Growth is wrong alike at all points of a part.
    se <- if (length(known)) {
      sqrt(max(0, mean(covariance[known, known])) + mean(points$se_growth[known])^2)
    } else NA
    change <- if (length(known)) mean(points$change[known]) else NA_real_
    df <- stats::median(points$df[known])
    data.frame(level = points$level[rows[1]], part = points$part[rows[1]], change = change,
               se = se, detectable = stats::qt(0.975, df) * se,
               p = 2 * stats::pt(-abs(change / se), df))
  })
  parts <- do.call(rbind, unname(each))
  parts$p_holm <- stats::p.adjust(parts$p, "holm")
  parts$called <- !is.na(parts$p_holm) & parts$p_holm <= 1 - settings$level
  parts
}

#' @param unit Of lengths, in place of "unit".
#' @param draws As in [measurements()].
#' @noRd
changed_measurements <- function(known, table, growth, unit, draws = 200) {
  if (is.null(table)) return(NULL)
  a <- measured_rows(list(known$before), table, known$error, draws, known$together)
  b <- measured_rows(list(known$after), table, known$error, draws, known$together)
  # A worse scan makes curves longer: what errors add is no change.
  both <- !is.na(a$bias) & !is.na(b$bias)
  before <- a$value - ifelse(both, a$bias, 0)
  after <- b$value - ifelse(both, b$bias, 0)
  grown <- if (is.null(growth)) list(growth = 0, se = 0) else measured_growth(a$measurement, growth)
  se <- sqrt(a$se^2 + b$se^2 + grown$se^2)
  change <- after - before - grown$growth
  # The errors of all points that it needs: those of the surface are most
  df <- stats::median(known$df, na.rm = TRUE)
  p <- 2 * stats::pt(-abs(change / se), df)
  data.frame(measurement = a$measurement, before = before, after = after,
             growth = grown$growth, change = change, se = se,
             detectable = stats::qt(0.975, df) * se, p = p,
             p_holm = stats::p.adjust(p, "holm"), unit = sub("^unit", unit, a$unit))
}

#' @export
as.data.frame.visit_comparison <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$points
}

#' @export
print.visit_comparison <- function(x, most = 6, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  printed(x, {
    surface <- x$points[x$points$level == "surface", ]
    unit <- if (x$unit == "unit") "" else paste0(" ", x$unit)
    cat("<visit_comparison> ", x$ids[2], " against ", x$ids[1], "\n", sep = "")
    cat(sprintf("  %d of %d surface points changed (|score| above %.2f, family-wise)\n",
                sum(surface$called), sum(!is.na(surface$score)), x$limit))
    if (length(x$growth)) {
      cat("  growth ", x$growth, "\n  one person's growth differs from that: not in the errors\n",
          sep = "")
    }
    lost <- sum(is.na(surface$score))
    if (lost) cat(sprintf("  not assessed, as missing or without `error`: %d\n", lost))
    best <- surface[which.max(abs(surface$change)), ]
    if (nrow(best)) {
      known <- if (is.na(best$se)) c("", "") else
        sprintf(c(" +- %.2g", " (called from %.2g)"), c(best$se, called_from(x$limit, best)))
      cat(sprintf("  largest change %.3g%s%s at %s %s%s\n", best$change, known[1], unit, best$part,
                  best$point, known[2]))
    }
    called <- x$parts[x$parts$called, ]
    called <- called[order(-abs(called$change / called$se)), ]
    for (i in seq_len(min(most, nrow(called)))) {
      cat(sprintf("  %s%s: mean change %.3g +- %.2g%s\n", called$part[i],
                  if (called$level[i] == "curves") " (curve)" else " (patch)", called$change[i],
                  called$se[i], unit))
    }
    found <- x$measurements[which(x$measurements$p_holm <= x$alpha), ]
    for (i in seq_len(min(most, NROW(found)))) {
      own <- found$unit[i]
      cat(sprintf("  %s: %.4g to %.4g, change %.3g +- %.2g%s\n", found$measurement[i],
                  found$before[i], found$after[i], found$change[i], found$se[i],
                  if (own %in% c("1", "unit")) "" else paste0(" ", own)))
    }
    invisible(x)
  })
}
