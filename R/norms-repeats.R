# Errors of points and their correlation from scans that were repeated.

#' Errors of measurement from repeated scans
#'
#' Measures the standard errors of points, and how they go together, from people who were scanned
#' and measured twice or more while nothing changed. [compare_visits()] takes the result as `error`.
#'
#' All scans of a person are laid on each other by least squares, without scaling. The standard
#' error of a curve or surface point is that along the normal; that of a landmark is the root mean
#' square of its three co-ordinates. The correlation of a co-ordinate at two surface points at
#' distance d is fitted as \eqn{share \exp(-d^2 / (2 range^2))}; the rest of the variance is
#' independent. It is fitted to products of errors along the normals, over the cosine between these.
#'
#' With fewer than `pool` degrees of freedom all points of a curve or patch get one variance. A few
#' repeats say little of a single patch. Its variance is therefore drawn towards that of all parts
#' of its level, the more so the less these differ (Smyth). [compare_visits()] judges changes by
#' Student's distribution with the degrees of freedom that result.
#'
#' @param shapes Two or more shapes of one scheme: a list of `shape`s, or a `shape_sample`.
#' @param specimen A name for each shape: the person. `NULL`: all are of one person.
#' @param pool Degrees of freedom (shapes less persons) from which on every point has a standard
#'   error of its own.
#' @param settings [repeat_settings()].
#' @return Object of class `visit_errors`, a list:
#'   * `points`: data frame with a row for each point of the scheme: `level`, `part`, `point`, `se`
#'     (of one scan, in the unit of the mesh; NA where a point was never measured twice), `df` (its
#'     degrees of freedom, with those that it has from other parts);
#'   * `range` (in the unit of the mesh) and `share` of the correlation; 0 and 0 if none is seen;
#'   * `counts`: numbers of `persons` and `shapes`, degrees of freedom `df`.
#'
#'   `as.data.frame()` gives `points`.
#' @section Errors: of class `crestline_error`: no person has two shapes; the schemes differ.
#' @template glossary
#' @template experimental
#' @seealso [compare_visits()], [repeatability()]
#' @references Smyth (2004) Linear models and empirical Bayes methods for assessing differential
#'   expression, *Statistical Applications in Genetics and Molecular Biology* 3, 3.
#' @examples
#' \donttest{
#' people <- data.frame(age = rep(20, 5), sex = "female")
#' cohort <- simulate_cohort(5, data = people, visits = 2, seed = 1)
#' both <- c(as.list(cohort$sample), as.list(cohort$second))
#' visit_errors(both, rep(names(cohort$sample), 2))
#' }
#' @export
visit_errors <- function(shapes, specimen = NULL, pool = 30, settings = repeat_settings()) {
  check_given()
  check_class(settings, "repeat_settings", "settings", "repeat_settings()")
  if (inherits(shapes, "shape_sample")) shapes <- shapes$shapes
  shapes <- check_list(shapes, "shape", "shapes", "fit_shape() or homologise()")
  for (shape in shapes) check_same_scheme(shape, shapes[[1]])
  pool <- check_number(pool, "pool", lower = 1)
  ids <- if (is.null(names(shapes))) as.character(seq_along(shapes)) else names(shapes)
  specimen <- if (is.null(specimen)) factor(rep("one", length(shapes))) else
    check_factor(specimen, ids, "specimen")
  if (max(table(specimen)) < 2) {
    crestline_abort("no person was measured twice.", "Give repeated scans of one person or more.",
                    stage = "visits")
  }
  persons <- Filter(function(own) length(own) > 1, split(seq_along(shapes), specimen))
  each <- lapply(persons, function(own) repeat_deviations(unname(shapes[own]), settings$rounds))
  along <- do.call(rbind, lapply(each, `[[`, "along"))
  df <- colSums(!is.na(along)) - Reduce(`+`, lapply(each, `[[`, "seen"))
  variance <- colSums(along^2, na.rm = TRUE) / ifelse(df > 0, df, NA)
  points <- shapes[[1]]$points[c("level", "part", "point")]
  most <- length(unlist(persons)) - length(persons)
  if (most < pool) {
    variance <- stats::ave(variance, points$level, points$part,
                           FUN = function(x) mean(x, na.rm = TRUE))
    variance[df == 0 | is.nan(variance)] <- NA
  }
  first <- shapes[[persons[[1]][1]]]
  at <- list(xyz = point_columns(first), normal = row_normals(first))
  surface <- points$level == "surface"
  together <- error_correlation(along[, surface], sqrt(variance)[surface], df[surface],
                                at$xyz[surface, ], at$normal[surface, ], settings)
  found <- data.frame(variance = variance, df = df)
  if (most < pool) found <- moderated_variances(variance, df, points, at, together)
  structure(c(list(points = data.frame(points, se = sqrt(found$variance), df = found$df,
                                       row.names = NULL)), together,
              list(counts = c(persons = length(persons), shapes = length(unlist(persons)),
                              df = most), hash = scheme_hash(shapes[[1]]$scheme))),
            class = "visit_errors")
}

#' Variances of parts drawn towards that of their level
#'
#' Errors at neighbouring points go together, so that a part has fewer degrees of freedom than its
#' points: of n points with the correlations r, those of one point times \eqn{n^2 / \sum r^2}.
#'
#' @param variance,df Of each point; the variance is that of its part.
#' @param points Data frame `level`, `part`.
#' @param at List `xyz`, `normal` (k x 3).
#' @param together List `range`, `share`.
#' @return Data frame by point: `variance`, `df`.
#' @noRd
moderated_variances <- function(variance, df, points, at, together) {
  found <- data.frame(variance = variance, df = ifelse(is.na(variance), NA, df))
  key <- paste(points$level, points$part)
  known <- which(!is.na(variance) & !is.na(at$xyz[, 1]))
  parts <- split(known, factor(key[known], unique(key[known])))
  own_df <- vapply(parts, function(rows) {
    r <- together_at(at$xyz[rows, , drop = FALSE], together)
    if (points$level[rows[1]] != "landmarks") r <- r * tcrossprod(at$normal[rows, , drop = FALSE])
    mean(df[rows]) * length(rows)^2 / sum(r^2) * if (points$level[rows[1]] == "landmarks") 3 else 1
  }, 0)
  own <- vapply(parts, function(rows) variance[rows[1]], 0)
  level <- points$level[vapply(parts, `[`, 0L, 1)]
  for (one in unique(level)) {
    of <- which(level == one)
    prior <- prior_variance(own[of], own_df[of])
    weight <- if (is.infinite(prior$df)) 1 else prior$df / (prior$df + own_df[of])
    rows <- unlist(parts[of])
    count <- lengths(parts[of])
    found$variance[rows] <- rep(weight * prior$variance + (1 - weight) * own[of], count)
    # Not more than all parts have together
    found$df[rows] <- rep(pmin(prior$df + own_df[of], sum(own_df[of])), count)
  }
  found
}

#' The distribution that variances are drawn from: its scale and degrees of freedom (Smyth)
#'
#' @param variance,df Of each part.
#' @param fewest Number of parts from which on they tell of each other.
#' @return List: `variance`, `df` (0: nothing is known; Inf: they differ by no more than chance).
#' @noRd
prior_variance <- function(variance, df, fewest = 3) {
  ok <- is.finite(variance) & variance > 0 & df > 0
  if (sum(ok) < fewest) return(list(variance = 0, df = 0))
  half <- df[ok] / 2
  off <- log(variance[ok]) - digamma(half) + log(half)
  left <- stats::var(off) - mean(trigamma(half))
  # Logarithms from few degrees of freedom to as many as make no difference
  reach <- c(-20, 20)
  if (left <= trigamma(exp(reach[2]))) return(list(variance = exp(mean(off)), df = Inf))
  prior <- exp(stats::uniroot(function(x) log(trigamma(exp(x))) - log(left), reach)$root)
  list(variance = exp(mean(off) + digamma(prior) - log(prior)), df = 2 * prior)
}

#' Settings of errors from repeated scans
#'
#' @param rounds How often the scans of a person are laid on their mean.
#' @param bins,reach The correlation is fitted to its means in so many bins of distance, up to this
#'   share of the greatest distance between points. Points farther apart do not determine a range.
#' @param least Least shared part of the variance for which a range is given. A share of 0.02
#'   makes the standard error of the mean of 20 points a sixth larger.
#' @param fewest Number of surface points, seen in all scans, from which on a correlation is fitted.
#' @param ... Nothing: an unknown name is an error.
#' @return A list of these settings, of class `repeat_settings`.
#' @section Errors: of class `crestline_error`: a value is out of its range.
#' @template glossary
#' @template experimental
#' @seealso [visit_errors()]
#' @examples
#' repeat_settings(bins = 10)
#' @export
repeat_settings <- function(rounds = 3L, bins = 15L, reach = 0.25, least = 0.02, fewest = 10L,
                            ...) {
  new_settings("repeat_settings", check_repeat_settings, list(...))
}

check_repeat_settings <- function(settings) {
  settings$rounds <- check_count(settings$rounds, "rounds")
  settings$bins <- check_count(settings$bins, "bins", lower = 2)
  settings$reach <- check_number(settings$reach, "reach", 0, 1, open = TRUE)
  settings$least <- check_number(settings$least, "least", 0, 1)
  settings$fewest <- check_count(settings$fewest, "fewest", lower = 3)
  settings
}

#' @export
print.repeat_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<repeat_settings> of visit_errors()")
}

#' Deviations of a person's scans from their mean: along the normals, of landmarks their lengths
#' over root 3
#'
#' @return List: `along` (scans x points), `seen` (1 for each point with any).
#' @noRd
repeat_deviations <- function(shapes, rounds) {
  first <- point_columns(shapes[[1]])
  each <- lapply(shapes, point_columns)
  mean <- first
  for (round in seq_len(rounds)) {
    each <- lapply(each, function(x) {
      known <- which(!is.na(x[, 1]) & !is.na(mean[, 1]))
      weighted_move(x[known, ], mean[known, ], rep(1, length(known)))(x)
    })
    mean <- rowMeans(array(unlist(each), c(dim(first), length(each))), na.rm = TRUE, dims = 2)
    mean[is.nan(mean)] <- NA
  }
  scheme <- shapes[[1]]$scheme
  normal <- row_normals(shapes[[1]])
  mark <- shapes[[1]]$points$level == "landmarks"
  along <- t(vapply(each, function(x) {
    off <- x - mean
    ifelse(mark, row_lengths(off) / sqrt(3), row_products(off, normal))
  }, numeric(nrow(first))))
  list(along = along, seen = as.numeric(colSums(!is.na(along)) > 0))
}

#' Share and range of the correlation of errors by products of standardised deviations
#'
#' @param along Deviations along the normals, scans x points.
#' @param se,df,xyz,normal Of the points.
#' @param settings [repeat_settings()].
#' @param ranges Ranges that are tried, as shares of the greatest distance.
#' @return List: `range`, `share`.
#' @noRd
error_correlation <- function(along, se, df, xyz, normal, settings, ranges = 2^seq(-7, -1, 0.125)) {
  none <- list(range = 0, share = 0)
  whole <- which(colSums(is.na(along)) == 0 & is.finite(se) & se > 0)
  if (length(whole) < settings$fewest) return(none)
  e <- along[, whole] / rep(se[whole], each = nrow(along))
  distance <- as.matrix(stats::dist(xyz[whole, ]))
  upper <- upper.tri(distance)
  d <- distance[upper]
  near <- d < max(d) * settings$reach
  bin <- cut(d[near], seq(0, max(d) * settings$reach, length.out = settings$bins + 1))
  mean_of <- function(x) as.vector(tapply(x[near], bin, mean))
  at <- mean_of(d)
  value <- mean_of((crossprod(e) / df[whole][1])[upper])
  cosine <- mean_of(tcrossprod(normal[whole, ])[upper])
  weight <- as.vector(table(bin))
  ok <- weight > 0
  found <- lapply(max(d) * ranges, function(range) {
    x <- cosine[ok] * exp(-at[ok]^2 / (2 * range^2))
    share <- sum(weight[ok] * x * value[ok]) / sum(weight[ok] * x^2)
    share <- if (is.finite(share)) min(1, max(0, share)) else 0
    list(range = range, share = share, left = sum(weight[ok] * (value[ok] - share * x)^2))
  })
  best <- found[[which.min(vapply(found, `[[`, 0, "left"))]]
  if (best$share < settings$least) none else best[c("range", "share")]
}

#' Correlation of the errors of a co-ordinate between points
#' @param settings List: `range`, `share`.
#' @noRd
together_at <- function(xyz, settings) {
  n <- nrow(xyz)
  if (settings$range == 0) return(diag(n))
  together <- settings$share * exp(-as.matrix(stats::dist(xyz))^2 / (2 * settings$range^2))
  diag(together) <- 1
  unname(together)
}

#' A standardised change as the normal number of the same probability
#' @param df Degrees of freedom of its standard error.
#' @noRd
normal_score <- function(t, df) {
  z <- stats::qnorm(stats::pt(-abs(t), df, log.p = TRUE), log.p = TRUE)
  ifelse(is.finite(df), -sign(t) * z, t)
}

#' A shape with the errors of repeated scans in place of its own
#' @noRd
with_errors <- function(shape, error) {
  shape$points$se <- ifelse(is.na(shape$points$x), NA, error$points$se)
  shape
}

#' @export
print.visit_errors <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<visit_errors> from %s of %s (%d degrees of freedom)\n",
                amount(x$counts[["shapes"]], "shape"), amount(x$counts[["persons"]], "person"),
                x$counts[["df"]]))
    for (level in unique(x$points$level)) {
      se <- x$points$se[x$points$level == level]
      cat(sprintf("  %s: standard error %.3g (median), %.3g to %.3g\n", level,
                  stats::median(se, na.rm = TRUE), min(se, na.rm = TRUE), max(se, na.rm = TRUE)))
    }
    cat(if (x$share == 0) "  errors of neighbouring points: independent\n" else
      sprintf("  %.0f %% of the variance goes together, over a range of %.3g\n", 100 * x$share,
              x$range))
    invisible(x)
  })
}

#' @export
as.data.frame.visit_errors <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$points
}
