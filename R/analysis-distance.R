# Section 5.3 of the paper: how far two sets of curves are apart.

#' Distance between two sets of curves
#'
#' Measures the distance between two sets of curves, curve by curve. The sets may be two
#' measurements of one specimen, or an estimate and its truth. They are compared as they lie, or
#' after Procrustes superimposition of the second on the first by rotation and translation. The
#' superimposition uses all points of all curves together. Sizes are kept unless `scale = TRUE`.
#'
#' The paper matches "each pair of curves" by Procrustes. That can also mean a superimposition of
#' each curve by itself.
#'
#' @param a,b Sets of curves in one unit. Each is a `shape` of [fit_shape()]; or a named list with a
#'   k x 3 matrix for each curve, as of [read_curves()]. A k x 3 matrix with row names "curve
#'   point", as of [coords()], is a set too.
#' @param match "none": the sets are compared as they lie. "procrustes": `b` is first superimposed
#'   on `a`.
#' @param between "points": distances between points of the same number. "curves": distances from
#'   each point of either set to the closest place of the other's polyline. They do not depend on
#'   the number and spacing of the points.
#' @param level Kind of points of shapes: "curves", "landmarks" or "surface".
#' @param scale Whether the superimposition also scales `b` to the size of `a`.
#' @return Data frame of class `curve_distance` with a row for each part of either set. Columns:
#'   `part`, `points` (number of distances), `rms` (root mean square), `mean` and `max`, in the unit
#'   of the curves. Parts that one set lacks are NA. Missing points are left out. Attribute `all`:
#'   such a row for all points together.
#' @section Errors: of class `crestline_error`: an argument is not a set of curves; the sets have no
#'   part in common; numbers of points differ, and points are compared or superimposed.
#' @template glossary
#' @templateVar where section 5.3
#' @template paper
#' @seealso [repeatability()]
#' @examples
#' arc <- function(n, r) {
#'   angle <- seq(0, 1, length.out = n)
#'   cbind(r * cos(angle), r * sin(angle), 0)
#' }
#' curve_distance(list(arc = arc(9, 10)), list(arc = arc(9, 11)))
#' curve_distance(list(arc = arc(9, 10)), list(arc = arc(30, 11)), between = "curves")
#' @export
curve_distance <- function(a, b, match = c("none", "procrustes"), between = c("points", "curves"),
                           level = "curves",
                           scale = FALSE) {
  check_given()
  check_flags(scale)
  level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
  match <- check_choice(match, c("none", "procrustes"), "match")
  between <- check_choice(between, c("points", "curves"), "between")
  if (inherits(a, "shape") && inherits(b, "shape")) warn_cut_scales(list(a = a, b = b), "distance")
  a <- curve_list(a, level, "a")
  b <- curve_list(b, level, "b")
  both <- intersect(names(a), names(b))
  if (!length(both)) {
    crestline_abort(sprintf("`a` (%s) and `b` (%s) have no part in common.", shorten(names(a), 3),
                            shorten(names(b), 3)),
                    "Give the curves the same names.", stage = "distance")
  }
  if (between == "points" || match == "procrustes") check_same_counts(a[both], b[both])
  if (match == "procrustes") b <- laid_curves(b, a, both, scale)
  measure <- switch(between, points = point_distances, curves = nearest_distances)
  apart <- Map(function(x, y) measure(x, y), a[both], b[both])
  parts <- union(names(a), names(b))
  table <- do.call(rbind, lapply(parts, function(part) distance_row(part, apart[[part]])))
  structure(table, all = distance_row("all", unlist(apart)), match = match, between = between,
            class = c("curve_distance", "data.frame"))
}

distance_row <- function(part, distance) {
  distance <- distance[!is.na(distance)]
  known <- length(distance) > 0
  data.frame(part = part, points = length(distance),
             rms = if (known) sqrt(mean(distance^2)) else NA_real_,
             mean = if (known) mean(distance) else NA_real_,
             max = if (known) max(distance) else NA_real_)
}

#' A set of curves as a named list of k x 3 matrices
#' @noRd
curve_list <- function(x, level, name) {
  if (inherits(x, "shape")) {
    check_class(x, "shape", name, "fit_shape()")
    level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
    own <- x$points[x$points$level == level, ]
    return(split_rows(as.matrix(own[c("x", "y", "z")]), own$part))
  }
  if (is.matrix(x) && is.numeric(x) && ncol(x) == 3 && !is.null(rownames(x))) {
    part <- sub(" [^ ]*$", "", rownames(x))
    number <- suppressWarnings(as.numeric(sub("^.* ", "", rownames(x))))
    order <- if (anyNA(number)) seq_along(part) else order(match(part, part), number)
    return(split_rows(x[order, , drop = FALSE], part[order]))
  }
  fine <- is.list(x) && length(x) && !is.null(names(x)) && !anyDuplicated(names(x)) &&
    all(vapply(x, function(one) is.matrix(one) && is.numeric(one) && ncol(one) == 3, NA))
  if (!fine) {
    crestline_abort(sprintf("`%s` is %s.", name, describe_value(x)),
                    paste("Give a shape, a named list of k x 3 matrices, or a matrix with row",
                          "names \"curve point\"."),
                    stage = "distance")
  }
  x
}

split_rows <- function(xyz, part) {
  rows <- split(seq_len(nrow(xyz)), factor(part, unique(part)))
  lapply(rows, function(row) xyz[row, , drop = FALSE])
}

check_same_counts <- function(a, b) {
  differ <- which(vapply(a, nrow, 0L) != vapply(b, nrow, 0L))
  if (length(differ)) {
    i <- differ[1]
    crestline_abort(sprintf("%s has %d points in `a` and %d in `b`.", names(a)[i], nrow(a[[i]]),
                            nrow(b[[i]])),
                    "Give as many, or use between = \"curves\" without matching.",
                    stage = "distance")
  }
}

#' The curves of b laid onto those of a by the parts that both have
#' @noRd
laid_curves <- function(b, a, both, scale) {
  lay <- superimposition(do.call(rbind, b[both]), do.call(rbind, a[both]), scale)
  lapply(b, lay)
}

point_distances <- function(a, b) row_lengths(unname(a - b))

#' From the points of each of two polylines to the nearest place of the other
#' @noRd
nearest_distances <- function(a, b) {
  a <- known_rows(a)
  b <- known_rows(b)
  if (!nrow(a) || !nrow(b)) return(NA_real_)
  c(nearest_on_polyline(a, b)$distance, nearest_on_polyline(b, a)$distance)
}

#' @export
print.curve_distance <- function(x, most = 12, digits = 3, ...) {
  check_method_dots(..., known = c("most", "digits"))
  check_most(most)
  printed(x, {
    all <- attr(x, "all")
    whole <- !is.null(all) && all(c("part", "rms", "mean", "max") %in% names(x))
    if (!whole) return(invisible(print(as.data.frame(x), digits = digits, ...)))
    how <- paste0(c(points = "points of the same number",
                    curves = "nearest places")[[attr(x, "between")]],
                  if (attr(x, "match") == "procrustes") ", b laid onto a")
    cat("<curve_distance> ", amount(sum(!is.na(x$rms)), "part"), ", ", how, "\n", sep = "")
    worst <- utils::head(x[order(-x$rms), ], most)
    shown <- rbind(as.data.frame(worst), all)
    numbers <- c("rms", "mean", "max")
    shown[numbers] <- signif(shown[numbers], digits)
    print.data.frame(shown, row.names = FALSE)
    if (nrow(x) > most) cat("and", nrow(x) - most, "nearer or missing parts in as.data.frame()\n")
    invisible(x)
  })
}

#' @export
as.data.frame.curve_distance <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  attributes(x)[c("all", "match", "between")] <- NULL
  class(x) <- "data.frame"
  x
}

known_rows <- function(x) x[!is.na(x[, 1]), , drop = FALSE]
