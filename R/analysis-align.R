# Generalised Procrustes alignment of a sample.

#' Align a sample (generalised Procrustes analysis)
#'
#' Generalised Procrustes analysis centres, scales and rotates every configuration so that the sum
#' of squared distances from their mean is least. For complete configurations, mean and sizes equal
#' those of `geomorph::gpagen()` (`scale = TRUE`) and of `Morpho::procSym()` (its default is
#' `scale = "full"`), iterated to convergence. [crestline-package] has a glossary.
#'
#' A first alignment leaves missing points out. Then `missing = "estimate"` estimates them by a
#' thin-plate spline, with least bending energy. The spline maps the mean of the first alignment
#' onto the points that the specimen has; the missing points are the images of those of the mean.
#' `"drop"` leaves these points out of all specimens. Points that every specimen lacks, such as
#' those at the ears, are always left out, with a message.
#'
#' @param sample A `shape_sample`, as [homologise()] returns it; a k x 3 x n array of homologous
#'   points (k x 2 x n for flat configurations), missing points NA; or a sample in files, as of
#'   [open_sample()].
#' @param level Kind of points: "landmarks" (the default), "curves", "surface", or "model" (all
#'   three, each place once). For an array it is only a name. The default of [coords()] is "curves".
#' @param scale `TRUE`: every configuration gets unit centroid size (partial Procrustes). `"full"`:
#'   it is scaled by the factor that brings it closest to the mean (full Procrustes). `FALSE`: sizes
#'   are kept, for size and shape together.
#' @param weights Weights of the points (no unit). `NULL`: all points have equal weights. "area":
#'   the weight is the area of the surface nearest to the point, a third of the area of its
#'   triangles on the mean. This needs level "surface" or "model", or `triangles`; points without
#'   triangles have no weight. "places": points that coincide, such as the common end of two curves,
#'   count as one. Or k numbers of at least 0.
#' @param missing Treatment of missing points: "estimate", "drop" or "stop" (an error).
#' @param tangent TRUE: scaled configurations are projected onto the tangent space of the shape
#'   space at the mean.
#' @param triangles Triangles of an array's surface, for pictures and areas: 3 x m matrix of row
#'   numbers of points.
#' @param limits Limits above which [align()] warns, as of [sample_limits()].
#' @param settings When the rounds end, as of [align_settings()].
#' @param ... Fields of [align_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return Object of class `aligned`, a list:
#'   * `coords`: k x 3 x n array of the aligned configurations, with the names of points and
#'     specimens. Without unit if scaled, else in the unit of the meshes;
#'   * `mean`: k x 3 matrix, their mean, in the pose of the sample's template (of an array: its
#'     first complete configuration);
#'   * `size`: n centroid sizes before scaling, in the unit of the meshes. Centroid size is the root
#'     of the (weighted) sum of squared distances from the (weighted) centre;
#'   * `weights`: k, of mean 1; `scale`, `tangent`, `level`;
#'   * `missing`: data frame with a row for each missing point: `id`, `point`, `action`
#'     ("estimated", "dropped");
#'   * `moved`: greatest change of a co-ordinate of the mean, by round;
#'   * `triangles`: 3 x m, rows of `mean`, or `NULL`;
#'   * `settings`, `reference`, `provenance`: the arguments, the configuration that gives the pose
#'     of `mean`, and the origin of the data, see [summary.aligned()].
#'
#'   A sample in files gives an `aligned` whose co-ordinates are in files too. It has all fields but
#'   `coords`, and is not subset. [shape_pca()], [compare_groups()] and [shape_lm()] take it.
#'
#'   `aligned[ids]` aligns these specimens again, see [aligned]. `as.data.frame()` gives a data
#'   frame with a row for each specimen: `id`, `size`, `distance` (Procrustes distance from the
#'   mean, in the unit of `coords`), `missing` (number of missing points).
#' @section Errors: of class `crestline_error`: `sample` is not such an array, has fewer than two
#'   specimens, or has a name twice; a specimen has too few points; points are missing with
#'   `missing = "stop"`.
#' @section Samples in files: [align()] reads the files once a round, and writes the aligned points
#'   to the folder `dir` of [align_settings()]. If points are estimated, it reads them up to 50
#'   times more. The first mean is then the template's, or without a template the first specimen
#'   that has all points. Warnings concern sizes, twins, specimens far from the mean and estimated
#'   points, not single points far from those of the others.
#' @section Warnings: of class `crestline_not_converged`: the mean still moves after the last round.
#'   Of class `crestline_sample_doubt`: a specimen or point exceeds one of the [sample_limits()].
#'   Its classes are
#'   * `crestline_far`: a specimen is far from the others;
#'   * `crestline_point`: some points of a specimen are far from those of the others;
#'   * `crestline_size`: sizes differ as between two units;
#'   * `crestline_twin`: two specimens have the same co-ordinates;
#'   * `crestline_estimated`: a point is estimated for too many specimens, or too many points for
#'     one specimen;
#'   * `crestline_beyond`: points are estimated far from those that the specimen has.
#' @references Gower (1975) Generalized Procrustes analysis, *Psychometrika* 40, 33-51; Dryden and
#'   Mardia (2016) *Statistical Shape Analysis*, chapter 7; Gunz, Mitteroecker, Neubauer, Weber and
#'   Bookstein (2009) Principles for the virtual reconstruction of hominin crania, *Journal of Human
#'   Evolution* 57, 48-62 (missing points).
#' @templateVar where sections 4 and 5.3
#' @template paper
#' @seealso [aligned] for the specimens of an alignment; [shape_pca()], [compare_groups()],
#'   [as_geomorph()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' shapes <- shapes + rnorm(120, sd = 0.05)
#' aligned <- align(shapes)
#' aligned
#' head(as.data.frame(aligned))
#' @export
align <- function(sample, level = c("landmarks", "curves", "surface", "model"), scale = TRUE,
                  weights = NULL, missing = c("estimate", "drop", "stop"), tangent = TRUE,
                  triangles = NULL, limits = sample_limits(), settings = align_settings(), ...) {
  check_given()
  check_flags(tangent)
  missing <- check_choice(missing, c("estimate", "drop", "stop"), "missing")
  check_scaling(scale)
  check_class(settings, "align_settings", "settings", "align_settings()")
  settings <- settings_with_former(settings, "align_settings", ...)
  folder <- settings$dir
  settings <- list(scale = scale, weights = weights, missing = missing, tangent = isTRUE(tangent),
                   tolerance = settings$tolerance, rounds = settings$rounds)
  check_class(limits, "sample_limits", "limits", "sample_limits()")
  aligned_of(sample, level, triangles, settings, limits, folder)
}

#' Whether something is a sample or an array, to be aligned
#' @noRd
is_unaligned <- function(x) {
  inherits(x, "shape_sample") || inherits(x, "sample_files") || is.array(x) && length(dim(x)) == 3
}

#' Say which points of a sample are taken where no level is given
#' @noRd
say_level <- function(sample) {
  if (!inherits(sample, c("shape_sample", "sample_files")) || is.null(sample$template)) {
    return(invisible())
  }
  count <- function(level) nrow(level_places(sample$template, level))
  crestline_inform(sprintf(paste("The %d landmarks are taken. Give level = \"curves\" for %d",
                                 "points of curves."), count("landmarks"), count("curves")))
}

#' The alignment of a sample in memory, or in files
#' @noRd
aligned_of <- function(sample, level, triangles, settings, limits, folder) {
  UseMethod("aligned_of")
}

aligned_of.default <- function(sample, level, triangles, settings, limits, folder) {
  aligned <- align_configurations(configurations(sample, level, triangles), settings)
  attr(aligned, "provenance") <- aligned_provenance(sample, settings)
  warn_of_doubts(aligned, limits)
}

#' @param given As of [configurations()].
#' @param settings List of arguments of [align()]: `scale`, `weights`, `missing`, `tangent`,
#'   `tolerance`, `rounds`.
#' @noRd
align_configurations <- function(given, settings) {
  scaling <- check_scaling(settings$scale)
  whole <- complete_configurations(given, settings$missing)
  weight <- point_weights(settings$weights, whole)
  if (is.numeric(settings$weights)) settings$weights <- settings$weights[whole$kept]
  fit <- fit_alignment(whole, weight, scaling, settings$tolerance, settings$rounds)
  check_extent(fit$size)
  if (!fit$converged) warn_alignment(settings$rounds, utils::tail(fit$moved, 1))
  projected <- settings$tangent && scaling > 0
  coords <- if (projected) tangent_projection(fit$coords, fit$mean, weight) else fit$coords
  validate_aligned(new_aligned(
    coords, fit$mean, fit$size, weight, whole$places, settings$scale, projected, given$level,
    whole$missing, fit$moved, whole$triangles, settings, whole$reference
  ))
}

#' Onto the plane that touches the sphere of unit size at the mean
#' @noRd
tangent_projection <- function(coords, mean, weight) {
  flat <- matrix(coords, length(mean))
  off <- 1 - drop(crossprod(flat, as.vector(mean * weight)))
  array(flat + outer(as.vector(mean), off), dim(coords), dimnames(coords))
}

#' What an argument `sample` gives
#'
#' @return List: `coords` (k x d x n with names), `reference` (k x d: where the result is laid, or
#'   `NULL`), `triangles` (3 x m or `NULL`), `places` (k: points that coincide share one), `level`.
#' @noRd
configurations <- function(sample, level, triangles = NULL) {
  if (inherits(sample, "shape_sample")) {
    check_class(sample, "shape_sample", "sample", "homologise()")
    level <- check_choice(level, sample_levels, "level")
    scheme <- sample$template$scheme
    whole <- level == "model"
    coords <- as.array(sample, level)
    if (level %in% c("surface", "model") &&
        is.null(triangles)) triangles <- model_triangles(scheme, whole)
    reference <- level_places(sample$template, level)
    places <- if (whole) rownames(reference) else scheme$points$place[scheme$points$level == level]
  } else {
    coords <- named_array(check_array(sample))
    level <- if (is.character(level) && length(level) == 1) level else "points"
    reference <- NULL
    places <- dimnames(coords)[[1]]
  }
  ids <- dimnames(coords)[[3]]
  if (length(ids) < 2) {
    crestline_abort(sprintf("there is %s specimen%s.", if (length(ids)) "one" else "no",
                            if (length(ids)) " only" else ""),
                    "Give two or more.", stage = "align")
  }
  list(coords = coords, reference = reference,
       triangles = check_triangles(triangles, dim(coords)[1]),
       places = places, level = level)
}

#' Triangles of a scheme between its surface points, or between all its places
#' @noRd
model_triangles <- function(scheme, by_place) {
  own <- t(as.matrix(scheme$triangles[scheme$triangles$part == "model", c("v1", "v2", "v3")]))
  if (!ncol(own)) return(NULL)
  place <- scheme$points$place
  if (by_place) own[] <- match(place[scheme$points$level == "surface"], unique(place))[own]
  unname(own)
}

#' A third of the area of every point's triangles
#' @noRd
point_areas <- function(xyz, triangles) {
  a <- xyz[triangles[1, ], , drop = FALSE]
  u <- xyz[triangles[2, ], , drop = FALSE] - a
  v <- xyz[triangles[3, ], , drop = FALSE] - a
  area <- sqrt(pmax(0, rowSums(u^2) * rowSums(v^2) - rowSums(u * v)^2)) / 2
  as.vector(tapply(rep(area / 3, each = 3), factor(triangles, seq_len(nrow(xyz))), sum,
                   default = 0))
}

#' The Procrustes mean that areas are taken on
#' @noRd
mean_of_sizes <- function(whole, tolerance = 1e-6, rounds = 100) {
  fit_alignment(whole, rep(1, dim(whole$coords)[1]), 1L, tolerance, rounds)$mean
}

check_extent <- function(size) {
  at <- which(!(size > 0))
  if (length(at)) {
    crestline_abort("all its points in `sample` coincide.", "Leave this specimen out.",
                    stage = "align", id = names(size)[at[1]])
  }
}

warn_alignment <- function(rounds, moved) {
  crestline_warn(sprintf("after %d rounds the mean still moves, by %.2g of its size.", rounds,
                         moved),
                 "Give more `rounds`, or a larger `tolerance`.", stage = "align",
                 class = "crestline_not_converged")
}

#' @rdname align
#' @param x An `aligned`.
#' @param row.names,optional Ignored.
#' @export
as.data.frame.aligned <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  off <- sweep(x$coords, 1:2, x$mean)
  distance <- sqrt(colSums(matrix(off^2 * x$weights, length(x$mean))))
  ids <- dimnames(x$coords)[[3]]
  data.frame(id = ids, size = unname(x$size), distance = distance,
             missing = as.vector(table(factor(x$missing$id, ids))))
}

#' @export
print.aligned <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    n <- length(x)
    scaled <- if (isTRUE(x$scale)) "unit centroid size" else "full Procrustes scaling"
    cat("<aligned> ", amount(n, "specimen"), ", ", nrow(x$mean), " points (", x$level, "), ",
        if (isFALSE(x$scale)) "sizes kept" else scaled,
        if (x$tangent) ", in tangent space", "\n", sep = "")
    table <- as.data.frame(x)
    cat(sprintf("  centroid size %.4g (%.4g to %.4g)\n", mean(table$size), min(table$size),
                max(table$size)))
    cat(sprintf("  distance from the mean %.3g (root mean square; largest %.3g, %s)\n",
                sqrt(mean(table$distance^2)),
                max(table$distance), table$id[which.max(table$distance)]))
    for (line in missing_lines(x$missing)) cat(strwrap(line, indent = 2, exdent = 4), sep = "\n")
    invisible(x)
  })
}
