# Two visits of one person: what has changed, against the errors of both scans.

#' Compare two visits of one person
#'
#' Lays the second shape on the first without scaling, and gives the change of surface points,
#' patches, curves and measurements with its standard error. A change is called if it is more than
#' the errors of both scans explain.
#'
#' The registration is robust by default (Tukey's weights): points that changed do not pull the
#' rest. With `unchanged`, the points of these patches alone are used, by least squares. The change
#' of a point is along its normal on the first visit. Growth between the visits is not subtracted.
#'
#' The smallest detectable change is \eqn{1.96 \sqrt{se_1^2 + se_2^2}}. The family-wise limit over
#' all surface points is the 95 % quantile of the largest standardised error. For independent errors
#' it has a closed form; otherwise errors are drawn whose correlation at distance d is
#' \eqn{\exp(-d^2 / (2 range^2))}.
#'
#' @param before,after Shapes of one scheme, slid against one template ([slide()]).
#' @param error Standard error of a co-ordinate of a point at one visit, in the unit of the mesh. It
#'   is used for points without `se`. `NULL`: these are not assessed. [repeatability()] and
#'   [scan_noise()] measure it.
#' @param unchanged Names of patches that did not change. `NULL`: not known.
#' @param table Measurements, as in [measurements()]. `NULL`: those of the face for its scheme.
#' @param settings [visit_settings()].
#' @return Object of class `visit_comparison`, a list:
#'   * `points`: data frame with a row for each curve and surface point: `level`, `part`, `point`,
#'     `x`, `y`, `z` (first visit), `change` (along the normal, outward positive), `se`,
#'     `detectable`, all in the unit of the mesh; `score` (change over se), `called` (surface
#'     points: beyond the family-wise limit);
#'   * `parts`: data frame with a row for each curve and patch: `level`, `part`, `change` (mean),
#'     `se`, `detectable`, `p`, `p_holm`, `called`;
#'   * `measurements`: data frame: `measurement`, `before`, `after`, `change`, `se`, `detectable`,
#'     `p`, `p_holm`, `unit`;
#'   * `limit` (of the scores), `weights` (of the registration, by surface point), `converged`,
#'     `robust` (whether the registration was), `ids`, `alpha` (1 - `level` of the settings), `unit`
#'     (of lengths: "mm" for [face_scheme()], otherwise "unit"), `triangles` (3 x m, rows of the
#'     surface points), `front` (3 x 3 rotation to the front of the first visit), `provenance`.
#'
#'   `as.data.frame()` gives `points`.
#' @section Errors: of class `crestline_error`: the shapes have different schemes, or fewer than
#'   three points in common; `unchanged` names no patch; the sizes differ as units do (5 times).
#' @section Warnings: of class `crestline_not_converged`: the weights still change after the last
#'   round. Of class `crestline_not_slid`: a measured shape was not slid. Of class
#'   `crestline_red_parts`: parts of a shape are red.
#' @template glossary
#' @template experimental
#' @seealso [assess()], [repeatability()]
#' @examples
#' \donttest{
#' lesion <- data.frame(height = 3, radius = 15, visit = 2)
#' cohort <- simulate_cohort(1, lesions = lesion, visits = 2, seed = 1)
#' compare_visits(cohort$sample[[1]], cohort$second[[1]])
#' }
#' @export
compare_visits <- function(before, after, error = NULL, unchanged = NULL, table = NULL,
                           settings = visit_settings()) {
  check_given()
  check_class(before, "shape", "before", "slide()")
  check_class(after, "shape", "after", "slide()")
  check_class(settings, "visit_settings", "settings", "visit_settings()")
  check_same_scheme(after, before)
  if (!is.null(error)) error <- check_number(error, "error", lower = 0, open = TRUE)
  scheme <- before$scheme
  table <- norm_measurements(table, scheme)
  surface <- before$points$level == "surface"
  if (!is.null(unchanged)) {
    unchanged <- check_choices(unchanged, unique(before$points$part[surface]), "unchanged")
  }
  used <- surface & (is.null(unchanged) | before$points$part %in% unchanged)
  for (shape in list(before, after)) warn_unready(shape, "visits")
  fit <- lay_visit(before, after, used, is.null(unchanged), error, settings)
  points <- changed_points(before, after, fit$laid, error)
  limit <- visit_limit(points[points$level == "surface", ], settings)
  points$called <- points$level == "surface" & !is.na(points$score) & abs(points$score) > limit
  structure(list(points = points, parts = changed_parts(points, settings),
                 measurements = changed_measurements(before, after, table, error), limit = limit,
                 weights = fit$weights, converged = fit$converged, ids = c(before$id, after$id),
                 alpha = 1 - settings$level, robust = is.null(unchanged),
                 unit = length_unit(scheme_hash(scheme)),
                 triangles = model_triangles(scheme, FALSE),
                 front = own_pose(coords(before, "landmarks"), scheme),
                 provenance = shapes_provenance(list(before, after))),
            class = "visit_comparison")
}

#' Settings of the comparison of two visits
#'
#' @param tukey Residual, in robust standard deviations, beyond which a point has no weight in the
#'   registration.
#' @param rounds,tolerance Most rounds of the registration; it ends when no weight changes by more.
#' @param range Distance over which errors go together, in the unit of the mesh. 0: independent
#'   points.
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
                           draws = 1000L, level = 0.95, seed = 1L, ...) {
  new_settings("visit_settings", check_visit_settings, list(...))
}

check_visit_settings <- function(settings) {
  settings$tukey <- check_number(settings$tukey, "tukey", lower = 0, open = TRUE)
  settings$rounds <- check_count(settings$rounds, "rounds")
  settings$tolerance <- check_number(settings$tolerance, "tolerance", lower = 0)
  settings$range <- check_number(settings$range, "range", lower = 0)
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

point_columns <- function(shape) as.matrix(shape$points[c("x", "y", "z")])

#' The second visit laid on the first, rigidly
#'
#' @param used Rows of the points that the registration may use.
#' @param robust Whether points that moved more than others lose their weight.
#' @return List: `laid` (matrix of all points), `weights` (of the surface points), `converged`.
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
  se <- visit_error(before, after, error)[used]
  own <- if (anyNA(se)) rep(1, length(used)) else se
  weight <- rep(1, length(used))
  converged <- !robust
  for (round in seq_len(if (robust) settings$rounds else 1)) {
    move <- weighted_move(b[used, ], a[used, ], weight)
    if (!robust) break
    off <- row_lengths(move(b[used, ]) - a[used, ]) / own
    # 1.538: the median length of three standard normal numbers
    share <- off / (settings$tukey * max(stats::median(off) / 1.538, 1e-12))
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
  all <- rep(NA_real_, nrow(a))
  all[used] <- weight
  list(laid = move(b), weights = all[before$points$level == "surface"], converged = converged)
}

#' The rigid motion that lays points on others by weighted least squares, a function
#' @noRd
weighted_move <- function(x, y, weight) {
  weight <- weight / sum(weight)
  from <- colSums(x * weight)
  to <- colSums(y * weight)
  turn <- nearest_rotation(sweep(x, 2, from) * weight, sweep(y, 2, to))$rotation
  function(points) sweep(sweep(points, 2, from) %*% turn, 2, to, `+`)
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

changed_points <- function(before, after, laid, error) {
  points <- before$points
  scheme <- before$scheme
  normal <- place_normals(places_of(before), scheme)
  normal <- normal[match(scheme$points$place, unique(scheme$points$place)), , drop = FALSE]
  change <- row_products(laid - point_columns(before), normal)
  se <- visit_error(before, after, error)
  found <- data.frame(points[c("level", "part", "point", "x", "y", "z")], change = change, se = se,
                      detectable = 1.96 * se, score = change / se)
  found <- found[found$level != "landmarks", ]
  rownames(found) <- NULL
  found
}

#' The family-wise limit of scores: the quantile of the largest of many errors
#' @noRd
visit_limit <- function(points, settings) {
  known <- points[!is.na(points$score), c("x", "y", "z")]
  k <- nrow(known)
  if (!k) return(NA_real_)
  if (settings$range == 0) return(stats::qnorm((1 + settings$level^(1 / k)) / 2))
  root <- chol(together_at(known, settings$range) + diag(1e-6, k))
  largest <- with_seed(settings$seed, vapply(seq_len(settings$draws), function(i) {
    max(abs(crossprod(root, stats::rnorm(k))))
  }, 0))
  stats::quantile(largest, settings$level, names = FALSE)
}

#' Correlation of errors between points
#' @noRd
together_at <- function(xyz, range) {
  if (range == 0) return(diag(nrow(xyz)))
  exp(-as.matrix(stats::dist(xyz))^2 / (2 * range^2))
}

#' Mean change of curves and patches, with correlated errors of its points
#' @noRd
changed_parts <- function(points, settings) {
  key <- paste(points$level, points$part)
  each <- lapply(split(points, factor(key, unique(key))), function(own) {
    known <- own[!is.na(own$score), ]
    n <- nrow(known)
    together <- together_at(known[c("x", "y", "z")], settings$range)
    se <- if (n) sqrt(sum(outer(known$se, known$se) * together)) / n else NA_real_
    change <- if (n) mean(known$change) else NA_real_
    data.frame(level = own$level[1], part = own$part[1], change = change, se = se,
               detectable = 1.96 * se, p = 2 * stats::pnorm(-abs(change / se)))
  })
  parts <- do.call(rbind, unname(each))
  parts$p_holm <- stats::p.adjust(parts$p, "holm")
  parts$called <- !is.na(parts$p_holm) & parts$p_holm <= 1 - settings$level
  parts
}

changed_measurements <- function(before, after, table, error) {
  if (is.null(table)) return(NULL)
  a <- measurements(before, table, error = error)
  b <- measurements(after, table, error = error)
  se <- sqrt(a$se^2 + b$se^2)
  change <- b$value - a$value
  p <- 2 * stats::pnorm(-abs(change / se))
  data.frame(measurement = a$measurement, before = a$value, after = b$value, change = change,
             se = se, detectable = 1.96 * se, p = p, p_holm = stats::p.adjust(p, "holm"),
             unit = a$unit)
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
    cat("<visit_comparison> ", x$ids[2], " against ", x$ids[1], "\n", sep = "")
    cat(sprintf("  %d of %d surface points changed (|score| above %.2f, family-wise)\n",
                sum(surface$called), sum(!is.na(surface$score)), x$limit))
    lost <- sum(is.na(surface$score))
    if (lost) cat(sprintf("  not assessed, as missing or without `error`: %d\n", lost))
    best <- surface[which.max(abs(surface$change)), ]
    if (nrow(best)) {
      cat(sprintf("  largest change %.3g +- %.2g at %s %s (detectable from %.2g)\n", best$change,
                  best$se, best$part, best$point, best$detectable))
    }
    called <- x$parts[x$parts$called, ]
    called <- called[order(-abs(called$change / called$se)), ]
    for (i in seq_len(min(most, nrow(called)))) {
      cat(sprintf("  %s: mean change %.3g +- %.2g\n", called$part[i], called$change[i],
                  called$se[i]))
    }
    found <- x$measurements[which(x$measurements$p_holm <= x$alpha), ]
    for (i in seq_len(min(most, NROW(found)))) {
      cat(sprintf("  %s: %.4g to %.4g, change %.3g +- %.2g\n", found$measurement[i],
                  found$before[i], found$after[i], found$change[i], found$se[i]))
    }
    invisible(x)
  })
}
