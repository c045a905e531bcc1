# Errors of points and their correlation from scans that were repeated.

#' Errors of measurement from repeated scans
#'
#' Measures the standard errors of points, and how they go together, from people who were scanned
#' and measured twice or more while nothing changed. [compare_visits()] takes the result as `error`.
#'
#' All scans of a person are laid on each other by least squares, without scaling. The standard
#' error of a curve or surface point is that along the normal; that of a landmark is the root mean
#' square of its three co-ordinates. With fewer than `pool` degrees of freedom all points of a curve
#' or patch get their root mean square. The correlation of surface points at distance d is fitted as
#' \eqn{share \exp(-d^2 / (2 range^2))}; the rest of the variance is independent.
#'
#' @param shapes Two or more shapes of one scheme: a list of `shape`s, or a `shape_sample`.
#' @param specimen A name for each shape: the person. `NULL`: all are of one person.
#' @param pool Degrees of freedom (shapes less persons) from which on every point has a standard
#'   error of its own.
#' @return Object of class `visit_errors`, a list:
#'   * `points`: data frame with a row for each point of the scheme: `level`, `part`, `point`, `se`
#'     (of one scan, in the unit of the mesh; NA where a point was never measured twice);
#'   * `range` (in the unit of the mesh) and `share` of the correlation; 0 and 0 if none is seen;
#'   * `counts`: numbers of `persons` and `shapes`, degrees of freedom `df`.
#'
#'   `as.data.frame()` gives `points`.
#' @section Errors: of class `crestline_error`: no person has two shapes; the schemes differ.
#' @template glossary
#' @template experimental
#' @seealso [compare_visits()], [repeatability()]
#' @examples
#' \donttest{
#' people <- data.frame(age = rep(20, 5), sex = "female")
#' cohort <- simulate_cohort(5, data = people, visits = 2, seed = 1)
#' both <- c(as.list(cohort$sample), as.list(cohort$second))
#' visit_errors(both, rep(names(cohort$sample), 2))
#' }
#' @export
visit_errors <- function(shapes, specimen = NULL, pool = 30) {
  check_given()
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
  each <- lapply(persons, function(own) repeat_deviations(unname(shapes[own])))
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
  se <- sqrt(variance)
  surface <- points$level == "surface"
  together <- error_correlation(along[, surface], se[surface],
                                point_columns(shapes[[persons[[1]][1]]])[surface, ], df[surface])
  structure(c(list(points = data.frame(points, se = se, row.names = NULL)), together,
              list(counts = c(persons = length(persons), shapes = length(unlist(persons)),
                              df = most), hash = scheme_hash(shapes[[1]]$scheme))),
            class = "visit_errors")
}

#' Deviations of a person's scans from their mean: along the normals, of landmarks their lengths
#' over root 3
#'
#' @return List: `along` (scans x points), `seen` (1 for each point with any).
#' @noRd
repeat_deviations <- function(shapes, rounds = 3) {
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
#' @param along Deviations, scans x points.
#' @param bins Number of bins of distance, up to a quarter of the extent.
#' @return List: `range`, `share`.
#' @noRd
error_correlation <- function(along, se, xyz, df, bins = 15) {
  none <- list(range = 0, share = 0)
  whole <- which(colSums(is.na(along)) == 0 & is.finite(se) & se > 0)
  if (length(whole) < 10) return(none)
  e <- along[, whole] / rep(se[whole], each = nrow(along))
  distance <- as.matrix(stats::dist(xyz[whole, ]))
  upper <- upper.tri(distance)
  product <- (crossprod(e) / df[whole][1])[upper]
  d <- distance[upper]
  near <- d < max(d) / 4
  bin <- cut(d[near], seq(0, max(d) / 4, length.out = bins + 1))
  mean_of <- function(x) as.vector(tapply(x[near], bin, mean))
  at <- mean_of(d)
  value <- mean_of(product)
  weight <- as.vector(table(bin))
  ok <- weight > 0
  found <- lapply(max(d) * 2^seq(-7, -1, 0.125), function(range) {
    x <- exp(-at[ok]^2 / (2 * range^2))
    share <- min(1, max(0, sum(weight[ok] * x * value[ok]) / sum(weight[ok] * x^2)))
    list(range = range, share = share, left = sum(weight[ok] * (value[ok] - share * x)^2))
  })
  best <- found[[which.min(vapply(found, `[[`, 0, "left"))]]
  if (best$share < 0.02) none else best[c("range", "share")]
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
