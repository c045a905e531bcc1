# How well measurements repeat: variance between specimens, observers and repeats, curve by curve.

#' Repeatability of measurements, curve by curve
#'
#' Estimates variance components, by curve and by point, from specimens that were measured more than
#' once, perhaps by several observers. The components are the variance between specimens, between
#' observers, of their interaction, and of the residual. The intra-class correlation is the share of
#' the variance between specimens.
#'
#' The model has random effects: point = specimen + observer + specimen:observer + residual. It is
#' fitted to each co-ordinate by itself. The variances are summed over the three co-ordinates and
#' averaged over the points of a curve. They are estimated from sequential sums of squares by
#' Henderson's method 3, which allows different numbers of repeats. For equal numbers the estimates
#' are those of the analysis of variance. An estimate below 0 counts as 0. The interaction is in the
#' model if some observer measured some specimen twice, else it is part of the residual. Differences
#' between observers count as error. The correlation is that of agreement: `ICC(1)` without
#' observers, and `ICC(2,1)` with observers. One specimen that was measured several times gives the
#' error only; the variance of specimens and the correlation are NA.
#'
#' @param shapes The N measurements: a list of `shape`s of one scheme, a `shape_batch`, a
#'   `shape_sample`, or a k x 3 x N array with names of points (see `level`). In a list ids may
#'   repeat, and `NULL` stands for a failed measurement.
#' @param specimen N names: the specimen of each measurement. Failed measurements may be included or
#'   left out. A vector with names, or a data frame with a column of names, is matched to the names
#'   of the measurements. A vector without names is taken in their order.
#' @param observer N names, in the same way: the observer of each measurement. `NULL`: observers are
#'   not in the model.
#' @param level Kind of points: "landmarks", "curves", "surface" or, of a sample or an array,
#'   "model". It also decides what is one part. Each landmark is a part by itself. Other points are
#'   one part if their names differ only in the last word, as "midline 1" and "midline 2". An array
#'   says nothing of its level: without `level` its points are taken as curves, with a message, and
#'   points without names as landmarks.
#' @param match Superimposition of the measurements. "specimen": all measurements of a specimen are
#'   in one frame, as on one scan. The mean of each specimen is superimposed on the others by
#'   rotation and translation. "each": every measurement is superimposed on the mean by itself, as
#'   for measurements on different scans. This removes a little of the error. "none": the
#'   measurements are compared as they lie.
#' @return Object of class `repeatability`, a list:
#'   * `parts`: data frame with a row for each part (curve or landmark), and one for all:
#'     * `part`, `points` (number);
#'     * `specimen`, `observer`, `interaction`, `residual`: standard deviations in the unit of the
#'       mesh; NA for effects that are not in the model. They are of the three co-ordinates
#'       together, root mean square over the points;
#'     * `error`: standard deviation of all effects but the specimen, the typical distance of a
#'       measured point from its average place;
#'     * `icc`: intra-class correlation;
#'   * `points`: data frame with the same columns for each point, and its place `x`, `y`, `z` in the
#'     mean;
#'   * `counts`: numbers of `specimens`, `observers`, `measurements`, `failed`;
#'   * `failed`: names (or numbers) of the failed measurements, which are left out;
#'   * `missing`: names of points that some measurement lacks, which are left out;
#'   * `level`: kind of points.
#'
#'   `as.data.frame()` gives `parts`.
#' @section Errors: of class `crestline_error`: there are no measurements; a factor has another
#'   length; no specimen was measured twice; no point is in all measurements.
#' @section Warnings: of class `crestline_failed_measurements`: failed measurements are left out.
#' @template glossary
#' @references Searle, Casella and McCulloch (1992) *Variance Components*, chapters 4 and 5; Shrout
#'   and Fleiss (1979) Intraclass correlations, *Psychological Bulletin* 86, 420-428; Klingenberg
#'   and McIntyre (1998), *Evolution* 52, 1363-1375 (sums over co-ordinates).
#' @seealso [plot.repeatability()], [curve_distance()], [simulate_faces()]
#' @examples
#' # Five specimens with an arc of nine points, each measured three times with an error of 0.1
#' angle <- seq(0, 1, length.out = 9)
#' arc <- function(r) cbind(r * cos(angle), r * sin(angle), 0)
#' specimen <- rep(1:5, each = 3)
#' arcs <- vapply(specimen, function(i) arc(9 + i / 3) + rnorm(27, sd = 0.1), arc(1))
#' rownames(arcs) <- paste("arc", 1:9)
#' repeatability(arcs, specimen, level = "curves")
#' @export
repeatability <- function(shapes, specimen, observer = NULL, level = "curves",
                          match = c("specimen", "each", "none")) {
  check_given()
  match <- check_choice(match, c("specimen", "each", "none"), "match")
  if (inherits(shapes, "shape_batch")) shapes <- as.list(shapes)
  level <- if (is.array(shapes)) level_of_array(shapes, if (!missing(level)) level) else
    check_choice(level, sample_levels, "level")
  failed <- failed_measurements(shapes)
  if (any(failed)) shapes <- shapes[!failed]
  coords <- measured_coords(shapes, level)
  n <- dim(coords)[3]
  ids <- measurement_names(shapes, n)
  specimen <- check_factor(without_failed(specimen, failed), ids, "specimen")
  if (!is.null(observer)) {
    observer <- check_factor(without_failed(observer, failed), ids, "observer")
  }
  gap <- rowSums(is.na(matrix(coords, dim(coords)[1]))) > 0
  missing <- rownames(coords)[gap]
  coords <- coords[!gap, , , drop = FALSE]
  check_repeats(coords, specimen, observer)
  framed <- in_one_frame(
    coords, if (match == "each") factor(seq_len(n)) else specimen, match != "none"
  )
  components <- variance_components(t(matrix(framed, ncol = n)), specimen, observer)
  # Variances of co-ordinates, summed by point: k x 4
  sums <- apply(array(components, c(4, nrow(coords), 3)), c(2, 1), sum)
  each <- structure(sums, dimnames = list(NULL, rownames(components)))
  part <- repeated_parts(rownames(coords), level)
  size <- as.vector(table(part))
  mean <- structure(rowMeans(framed, dims = 2), dimnames = list(NULL, c("x", "y", "z")))
  by_part <- rbind(rowsum(each, part) / size, all = colMeans(each))
  points <- data.frame(point = rownames(coords), part = as.character(part), mean,
                       component_table(each))
  parts <- data.frame(part = rownames(by_part), points = c(size, nrow(coords)),
                      component_table(by_part))
  structure(list(parts = parts, points = points, missing = missing, level = level,
                 failed = names(failed)[failed], counts = c(
                   specimens = nlevels(specimen), observers = nlevels(observer),
                   measurements = n, failed = sum(failed)
                 ),
                 provenance = repeats_provenance(shapes)),
            class = "repeatability")
}

#' The part of each point: a landmark by itself, a curve or a line of a patch by its name
#' @noRd
repeated_parts <- function(points, level) {
  part <- if (level == "landmarks") points else sub(" [^ ]*$", "", points)
  factor(part, unique(part))
}

#' The level of an array, which says nothing of it
#' @param level As it was given, NULL where it was not.
#' @noRd
level_of_array <- function(coords, level) {
  if (!is.null(level)) return(check_choice(level, sample_levels, "level"))
  if (is.null(rownames(coords))) return("landmarks")
  part <- table(repeated_parts(rownames(coords), "curves"))
  part <- part[part > 1]
  if (length(part)) {
    crestline_inform(sprintf(paste(
      "Points whose names differ only in the last word are taken as one curve: %s. If they are",
      "landmarks, give level = \"landmarks\"."
    ), shorten(sprintf("%s (%d points)", names(part), part), 3)))
  }
  "curves"
}

repeats_provenance <- function(shapes) {
  if (inherits(shapes, "shape_sample")) whole_provenance(shapes) else
    if (is.list(shapes)) shapes_provenance(shapes) else made_with()
}

#' @rdname provenance
#' @export
summary.repeatability <- function(object, ...) new_summary(printed_lines(object), object$provenance)

#' Which measurements of a list failed, with a warning that names them
#'
#' @return Logical by measurement, named; of length 0 where the measurements are no list.
#' @noRd
failed_measurements <- function(shapes) {
  if (!is.list(shapes) || inherits(shapes, "shape_sample")) return(logical())
  failed <- vapply(shapes, is.null, NA)
  if (is.null(names(failed))) names(failed) <- seq_along(failed)
  if (any(failed)) {
    crestline_warn(sprintf("%s of %s failed and %s left out: %s.", sum(failed),
                           amount(length(failed), "measurement"),
                           if (sum(failed) == 1) "is" else "are", shorten(names(failed)[failed])),
                   paste("See failures() of the batch; the specimens and observers that are",
                         "left may be unbalanced."),
                   stage = "repeatability", class = "crestline_failed_measurements")
  }
  failed
}

#' Values by measurement of those that are there, where those that failed are counted too
#' @noRd
without_failed <- function(x, failed) if (is.null(names(x)) && length(x) == length(failed)) {
  x[!failed]
} else {
  x
}

#' Names of the measurements: of the list or array, else the shapes' ids where each has its own;
#' else numbers
#' @noRd
measurement_names <- function(shapes, n) {
  name <- if (is.array(shapes)) dimnames(shapes)[[3]] else
    if (inherits(shapes, "shape_sample")) names(shapes$shapes) else
    names(shapes)
  if (is.null(name) && is.list(shapes)) name <- vapply(shapes, `[[`, "", "id")
  if (is.null(name) || anyDuplicated(name)) as.character(seq_len(n)) else name
}

#' Measurements as a k x 3 x N array
#' @noRd
measured_coords <- function(shapes, level) {
  if (inherits(shapes, "shape_sample")) return(as.array(shapes, level))
  if (is.list(shapes) && length(shapes) && all(vapply(shapes, inherits, NA, "shape"))) {
    for (shape in shapes) check_same_scheme(shape, shapes[[1]])
    each <- lapply(shapes, coords, level)
    return(array(unlist(each), c(dim(each[[1]]), length(each)), c(dimnames(each[[1]]), list(NULL))))
  }
  if (!is.array(shapes) || length(dim(shapes)) != 3 || !is.numeric(shapes) || dim(shapes)[2] != 3) {
    crestline_abort(sprintf("`shapes` is %s.", describe_value(shapes)),
                    "Give a list of shapes, or a k x 3 x N array.",
                    stage = "arguments")
  }
  if (is.null(rownames(shapes))) rownames(shapes) <- paste("point", seq_len(nrow(shapes)))
  shapes
}

check_factor <- function(x, ids, name) {
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "arguments"
  )
  bad <- !is.atomic(x) || is.null(names(x)) && length(x) != length(ids) || anyNA(x)
  if (bad && !is.data.frame(x)) {
    fail(sprintf("`%s` is %s, for %s.", name, describe_value(x),
                 amount(length(ids), "measurement")),
         "Give a name for each measurement.")
  }
  if (is.matrix(x)) x <- as.vector(x)
  x <- factor(trimws(by_specimen(x, ids, name, fail)))
  alike <- alike_levels(levels(x))
  if (length(alike)) {
    fail(sprintf("`%s` has %s, which differ by blanks or case only.", name,
                 paste0("\"", alike, "\"", collapse = " and ")),
         "Give them one name.")
  }
  x
}

check_repeats <- function(coords, specimen, observer) {
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "repeatability"
  )
  if (!nrow(coords)) {
    fail("no point is in all measurements.", "Leave out the measurements that lack most.")
  }
  if (nlevels(specimen) == length(specimen)) {
    fail("no specimen was measured twice.", "Give repeated measurements.")
  }
  if (!is.null(observer) && nlevels(observer) < 2) {
    fail("there is one observer only.", "Leave `observer` out, or give two or more.")
  }
}

#' Measurements laid together, by units that move as one
#'
#' @param unit Factor: measurements that keep their places to each other.
#' @return Array as `coords`; sizes are kept.
#' @noRd
in_one_frame <- function(coords, unit, wanted, tolerance = 1e-10, rounds = 100) {
  if (!wanted) return(coords)
  own <- lapply(split(seq_along(unit), unit),
                function(i) rowMeans(coords[, , i, drop = FALSE], dims = 2))
  mean <- own[[1]]
  for (round in seq_len(rounds)) {
    next_mean <- mean_of(lapply(own, laid_onto, mean, scale = FALSE))
    moved <- max(abs(next_mean - mean))
    mean <- next_mean
    if (moved < tolerance * sqrt(sum(sweep(mean, 2, colMeans(mean))^2))) break
  }
  lay <- lapply(own, superimposition, mean, scale = FALSE)
  for (i in seq_along(unit)) coords[, , i] <- lay[[unit[i]]](coords[, , i])
  coords
}

#' Variance components by sequential sums of squares (Henderson's method 3)
#'
#' The projections of the terms, each after those before it, are orthogonal; the expected sum of
#' squares of one is sum_k sigma_k^2 |Q' Z_k|^2 over its own and later terms, plus its degrees of
#' freedom times the residual variance.
#'
#' @param y N x m, a column a variable.
#' @return Matrix, a row a term ("specimen", "observer", "interaction", "residual"), a column a
#'   variable: variances, not below 0; NA for terms not in the model, such as the specimen where
#'   there is one.
#' @noRd
variance_components <- function(y, specimen, observer = NULL) {
  terms <- if (nlevels(specimen) > 1) list(specimen = specimen) else list()
  if (!is.null(observer)) {
    terms$observer <- observer
    cell <- interaction(specimen, observer, drop = TRUE)
    if (nlevels(specimen) > 1 && nlevels(cell) < length(cell)) terms$interaction <- cell
  }
  found <- matrix(NA_real_, 4, ncol(y),
                  dimnames = list(c("specimen", "observer", "interaction", "residual"), NULL))
  if (!length(terms)) {
    found["residual", ] <- apply(y, 2, stats::var)
    return(found)
  }
  dummies <- lapply(terms, function(term) outer(as.integer(term), seq_len(nlevels(term)), `==`) + 0)
  spaces <- sequential_spaces(dummies)
  fitted <- lapply(spaces, function(q) crossprod(q, y))
  rest <- sweep(y, 2, colMeans(y)) - Reduce(`+`, Map(`%*%`, spaces, fitted))
  squares <- rbind(t(vapply(fitted, function(part) colSums(part^2), numeric(ncol(y)))),
                   colSums(rest^2))
  df <- vapply(spaces, ncol, 0L)
  expected <- vapply(dummies, function(z) vapply(spaces, function(q) sum(crossprod(q, z)^2), 0),
                     numeric(length(spaces)))
  if (any(df == 0) || sum(df) >= length(specimen) - 1) {
    crestline_abort("specimens, observers and residual cannot be told apart in this design.",
                    paste("Let observers measure the same specimens, some of them twice; or",
                          "leave `observer` out."),
                    stage = "repeatability", call = NULL)
  }
  system <- rbind(cbind(matrix(expected, length(spaces)), df),
                  c(numeric(length(spaces)), length(specimen) - 1 - sum(df)))
  estimate <- pmax(solve(system, squares), 0)
  found[c(names(terms), "residual"), ] <- estimate
  found
}

#' Orthonormal bases of what each term adds to the mean and the terms before it
#' @noRd
sequential_spaces <- function(dummies) {
  before <- matrix(1 / sqrt(nrow(dummies[[1]])), nrow(dummies[[1]]))
  lapply(dummies, function(z) {
    rest <- z - before %*% crossprod(before, z)
    parts <- svd(rest, nv = 0)
    own <- parts$u[, parts$d > 1e-8 * sqrt(nrow(z)), drop = FALSE]
    before <<- cbind(before, own)
    own
  })
}

#' Variances by term as standard deviations, with error and correlation
#' @noRd
component_table <- function(variance) {
  error <- rowSums(variance[, -1, drop = FALSE], na.rm = TRUE)
  all <- variance[, 1] + error
  data.frame(sqrt(variance), error = sqrt(error), icc = ifelse(all > 0, variance[, 1] / all, NA),
             row.names = NULL)
}

#' @export
as.data.frame.repeatability <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$parts
}

#' @export
print.repeatability <- function(x, most = 10, digits = 3, ...) {
  check_method_dots(..., known = c("most", "digits"))
  check_most(most)
  printed(x, {
    count <- x$counts
    cat("<repeatability> ", amount(count[["measurements"]], "measurement"), " of ",
        amount(count[["specimens"]], "specimen"),
        if (count[["observers"]]) paste(" by", amount(count[["observers"]], "observer")), "\n",
        sep = "")
    own <- utils::head(x$parts, -1)
    shown <- rbind(utils::head(own[order(-own$error), ], most), utils::tail(x$parts, 1))
    shown <- shown[colSums(!is.na(shown)) > 0]
    numbers <- intersect(c("specimen", "observer", "interaction", "residual", "error"),
                         names(shown))
    shown[numbers] <- signif(shown[numbers], digits)
    if (!is.null(shown$icc)) shown$icc <- round(shown$icc, digits)
    cat("standard deviations by part, those of the greatest error first\n")
    print.data.frame(shown, row.names = FALSE)
    if (nrow(own) > most) cat("and", nrow(own) - most, "parts with less error in as.data.frame()\n")
    if (length(x$failed)) {
      cat(strwrap(paste0("not measured, left out: ", shorten(x$failed, 6)), 80, exdent = 2),
          sep = "\n")
    }
    if (length(x$missing)) {
      cat(strwrap(paste0("left out, missing somewhere: ", shorten(x$missing, 6)), 80, exdent = 2),
          sep = "\n")
    }
    invisible(x)
  })
}
