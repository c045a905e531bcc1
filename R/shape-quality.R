# How far every part of a shape can be trusted: what was measured, a grade, and why.

#' Quality of measured specimens
#'
#' Grades every landmark, curve and patch: green (no doubt), amber (look at it), red (do not use it
#' as it is). The grade has four sources:
#'
#' * the fit: curvature does not determine the curve, another path is as good, or points are
#'   missing;
#' * the mesh near the part: noise, spikes, holes, coarse triangles (see `checks` of [fit_shape()]);
#' * the mirror image of the part's partner, if the scheme has pairs;
#' * the lengths in the other specimens, if there are several.
#'
#' Grades are passed on. The points of a patch depend on the curves that bound it. The patch is at
#' least amber if one of these is not green. A curve is at least amber if it ends on a landmark that
#' is predicted or was found with little confidence. It is red if it ends on a landmark that looks
#' exchanged with another. If most found landmarks have little confidence, nothing is green.
#' [crestline-package] has a glossary.
#'
#' `quality()` does not detect a wrong landmark that was placed by hand, unless lengths, symmetry or
#' the order of landmarks show it. It does not detect a smooth error of the scan. A curve along the
#' wrong feature can be detected in a sample of [homologise()], and in a shape of [slide()]. There a
#' curve is amber if its homologous points lie far beside it (limit `offset`).
#'
#' @section What to do with amber and red parts: Look at the part in a picture, such as those of
#'   [quality_report()] or `plot(shape, specimen)`. Move its landmarks if they are wrong
#'   ([review_landmarks()], or `specimen$landmarks`), clean the mesh if it is at fault, and fit the
#'   shape again. A part that is still red is better left out. `homologise(red = "leave out")` makes
#'   it missing in that specimen. For one shape, use the rows of `as.data.frame(shape)` whose `part`
#'   and `level` are not red. Leave out a curve of all specimens if it is red in most, or measure it
#'   as a "plane" curve (`kind` of [curve_scheme()]). Use an amber part if the picture is right. If
#'   trimmed curves are too short on many scans, measure all specimens with one smaller `cut_scale`,
#'   as by `fit_shapes(x, scheme, measuring = shape_settings(cut_scale = 0.8))`.
#' @param x A `shape`, as [fit_shape()] returns it, or a list of shapes. Names of the list, if any,
#'   name the specimens. `NULL` in the list stands for a specimen that could not be measured.
#' @param limits [quality_limits()].
#' @param others Further shapes of the same scheme. Their lengths are compared with those of `x`.
#'   Use an earlier sample if `x` is one new specimen.
#' @return Data frame of class `shape_quality`, a row for each specimen and part:
#'   * `specimen`, `part`, `level` ("landmarks", "curves", "surface"), `kind`, `length`, `strength`,
#'     `contrast`, `se`, `competing`: as in `status` of [fit_shape()];
#'   * `z`: robust z-score of a curve's length, relative to the specimen's size, by the median and
#'     MAD of the other specimens. NA with fewer than `limits$others` others, and for trimmed
#'     curves;
#'   * `asymmetry`: greatest distance of a curve from the mirror image of its partner between their
#'     ends, as a share of its length. A curve without a partner is compared with its own mirror
#'     image. NA if the scheme has no pairs;
#'   * `missing`, `cut`, `bridged`, `faults`, `roughness` (degrees): as in `checks` of
#'     [fit_shape()];
#'   * `offset`: root mean square distance of a curve from its homologous points, across it, in
#'     radii of the template. NA if the shape was not slid with free curve points;
#'   * `track`: greatest distance of a curve from its expected track, in spreads. NA if the scheme
#'     has no tracks, see [learn_tracks()];
#'   * `noise_factor`: as in `status` of [fit_shape()];
#'   * `coarse`: mean edge of the triangles along a curve in radii of its curvature estimate;
#'     `border`, `spike`: distances as shares of the part's size;
#'   * `grade`: ordered factor green < amber < red;
#'   * `why`: the reason, as text; NA if the part is green.
#'
#'   A specimen that could not be measured has one row with level "specimen", red, with the reason
#'   of the failure. A specimen with warnings (see [warnings_of()]) has such a row too, amber.
#'   `print()` gives the counts, the worst parts, the specimens whose landmarks were found and not
#'   placed by hand, and the noise factor F with its meaning. `as.data.frame()` shows the rows.
#'   `summary()` gives a data frame with a row for each specimen: `specimen`, `green`, `amber`,
#'   `red`
#'   (numbers of parts), `landmarks` ("found" or "placed"; NA if it could not be measured), and
#'   `noise_factor`: F of the specimen, the median over its ridges and valleys.
#'
#'   F near 1: the noise is independent from vertex to vertex. F = 9: the noise is correlated along
#'   the mesh, or fine relief counts as noise. The standard errors are then 3 times those of
#'   independent noise. On good faces F is 3 to 79 (three real scans: 24, 49 and 79). F is no fault
#'   and has no grade.
#' @section Reasons and what to do: `print()` of several specimens counts the parts by kind of
#'   reason:
#'
#'   * not measured: See [failures()]. Then `fit_shapes(batch, ...)` measures it again.
#'   * a landmark looks exchanged with another: Rename the two landmarks, and measure again.
#'   * a landmark was found with doubt, or predicted: Look at it, and move it:
#'     [review_landmarks()].
#'   * a curve that bounds the patch is not green: Look at that curve; the patch follows it.
#'   * a landmark is off the surface: Place it anew, or set it to NA.
#'   * cut short: The scan or a curve is too short for the trimmed length. The share
#'     is the part of the curve's typical length that the scheme keeps. Measure all specimens with
#'     one `cut_scale`, by `measuring = shape_settings(cut_scale = )` of [fit_shapes()], no greater
#'     than the least share that is reported.
#'   * points or landmarks are missing: Place the landmark, or scan again. The other parts are not
#'     affected.
#'   * uncertain across the curve: The ridge is broad or the scan is noisy there. Look at the
#'     curve; average it over specimens, or leave it out.
#'   * no clear ridge or valley: The surface is flat there. The curve is a straight cut, and is
#'     not a feature of its own.
#'   * another path is nearly as good: Look whether the curve follows the feature that you mean.
#'   * hardly stronger than beside it: As above.
#'   * length unlike the others': Look at its two landmarks first, then at the curve.
#'   * unlike the other side: Look at both sides. The face may be asymmetric.
#'   * the surface is rough: Hair, noise or folds. Leave the part out, or scan again.
#'   * the mesh is coarse: Use the scan before it was decimated.
#'   * runs over a hole; beside a border or hole: Look whether the scan is sound there.
#'   * beside a spike or fold: Four triangles there are bent by more than 30 degrees. It may be a
#'     fault of the scan, or a true fold, as at the corner of a lid. Look at the picture. At a true
#'     fold the points of the curve that are far from it can be used.
#'   * along another feature than in the sample: Look at it beside the others; leave it out if it
#'     is another feature.
#'   * off its expected track: As above.
#'   * flipped, doubled or crossing triangles: Take care with areas and volumes of the patch.
#'
#'   Distances in radii are shares of the curve's radius in the scheme (mm for
#'   [face_scheme()]). `se` and `length` are in the unit of the mesh.
#' @section Errors: of class `crestline_error`: `x` has no shapes.
#' @seealso [quality_report()] for a page with pictures.
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' graded <- quality(fit_shape(face, face_scheme()))
#' graded
#' graded[graded$grade > "green", c("part", "grade", "why")]
#' }
#' @concept how good is a measurement
#' @export
quality <- function(x, limits = quality_limits(), others = NULL) {
  check_given()
  if (inherits(x, "curve")) {
    refuse_argument("x", x, paste("quality() grades shapes of fit_shape(). A curve has its own",
                                  "verdict: `determined`, `reason` and `se`; plot(x)."))
  }
  check_class(limits, "quality_limits", "limits", "quality_limits()")
  if (inherits(x, "shape_sample")) validate(x)
  shapes <- measures_of(x, "x")
  measured <- Filter(Negate(is.null), shapes)
  other <- if (!is.null(others)) {
    Filter(Negate(is.null), measures_of(others, "others"))
  }
  scores <- sample_scores(measured, other, limits)
  said <- lapply(measured, `[[`, "said")
  said <- said[lengths(said) > 0]
  noted <- specimen_rows(names(said), "amber", vapply(said, function(one) {
    paste(sub("[.]$", "", one), collapse = "; ")
  }, ""))
  failed <- attr(x, "failed")
  lost <- setdiff(names(shapes), names(measured))
  # Specimens that could not be measured
  reason <- vapply(failed[lost], function(one) {
    if (is.null(one$message)) "" else sub("[.]$", "", paste0(": ", one$message, " ", one$remedy))
  }, "")
  lost <- specimen_rows(lost, "red", paste0(rep("it was not measured", length(lost)), reason))
  table <- rbind(graded_measures(measured, scores, limits), noted, lost)
  at <- match(table$specimen, names(shapes))
  if (is.unsorted(at)) table <- table[order(at), ]
  rownames(table) <- NULL
  found <- vapply(measured, `[[`, NA, "found")
  structure(table, found = names(measured)[found], rows = nrow(table),
            class = c("shape_quality", "data.frame"))
}

#' Measures of many specimens graded, some at a time
#'
#' @param measured As of [to_grade()], by name.
#' @param scores As of [sample_scores()].
#' @param block Specimens at a time.
#' @noRd
graded_measures <- function(measured, scores, limits, block = 500) {
  schemes <- list()
  kind <- vapply(measured, function(one) {
    for (i in seq_along(schemes)) if (identical(schemes[[i]], one$scheme)) return(i)
    schemes[[length(schemes) + 1]] <<- one$scheme
    length(schemes)
  }, 0L)
  some <- lapply(split(seq_along(kind), kind), function(at) {
    split(at, (seq_along(at) - 1) %/% block)
  })
  graded <- lapply(unlist(unname(some), recursive = FALSE), function(at) {
    parts <- rows_together(lapply(measured[at], unpacked_parts), names(measured)[at])
    parts$z <- NA_real_
    curves <- parts$level == "curves"
    own <- scores[at, , drop = FALSE]
    parts$z[curves] <- own[cbind(match(parts$specimen[curves], names(measured)[at]),
                                 match(parts$part[curves], colnames(own)))]
    grade_parts(parts, limits, measured[[at[1]]]$scheme)
  })
  do.call(rbind, unname(graded))
}

#' Tables of the same columns, one below the other, with the name of each as `specimen`
#' @noRd
rows_together <- function(tables, names) {
  columns <- setdiff(names(tables[[1]]), "specimen")
  columns <- lapply(stats::setNames(nm = columns), function(column) {
    unlist(lapply(tables, `[[`, column), use.names = FALSE)
  })
  columns$specimen <- rep(names, vapply(tables, nrow, 0L))
  as.data.frame(columns, optional = TRUE)
}

#' Lines of what is not green: each part of one specimen; of several each specimen as a whole, and
#' each kind of reason with its count
#' @noRd
worst_lines <- function(x, several) {
  worst <- x[x$grade > "green", ]
  whole <- worst$level == "specimen"
  worst <- worst[order(!whole, -as.integer(worst$grade)), ]
  worst <- worst[!is.na(worst$grade), ]
  of <- paste0(" of ", worst$specimen)
  if (!several) {
    # Parts with one reason share a line
    said <- paste(worst$grade, worst$why)
    parts <- tapply(titled_parts(worst), factor(said, unique(said)), shorten, 6)
    once <- worst[!duplicated(said), ]
    return(sprintf("%s: %s: %s", once$grade, parts, once$why))
  }
  lines <- sprintf("%s: %s%s: %s", worst$grade, worst$part, of, worst$why)
  c(lines[seq_len(sum(whole))], reason_lines(worst[worst$level != "specimen", ]))
}

#' Whether landmarks of a shape were found by [find_landmarks()], and not all corrected by hand
#' since
#' @noRd
has_found <- function(shape) any(shape$placing$state == "found")

#' What a function gives of each shape, by name; NULL for those that failed. Of a batch one shape at
#' a time is in memory
#' @param x As of [named_shapes()].
#' @param f Function of a shape and its name.
#' @noRd
each_shape <- function(x, f, name = "x") {
  batch <- inherits(x, "shape_batch") && length(x)
  if (!batch) x <- named_shapes(x, name)
  lapply(stats::setNames(nm = names(x)), function(one) {
    shape <- x[[one]]
    if (!is.null(shape)) f(check_class(shape, "shape", name, "fit_shape()"), one)
  })
}

#' What grading takes of each shape, by name; NULL for those that failed
#' @noRd
measures_of <- function(x, name) UseMethod("measures_of")

#' @exportS3Method
measures_of.default <- function(x, name) each_shape(x, to_grade, name)

#' What grading takes of a shape
#' @return List: `parts` (as of [part_measures()], or packed), `scheme`, `said` (its warnings),
#'   `lengths` (of curves with a score), `found` (whether landmarks were).
#' @noRd
to_grade <- function(shape, name) {
  parts <- part_measures(shape, name)
  list(parts = parts, scheme = shape$scheme, said = unique(shape$warnings$problem),
       lengths = scored_lengths(parts, shape$scheme), found = has_found(shape))
}

#' Lengths of curves as they are compared with the others': none of those that the scheme cuts off
#' @noRd
scored_lengths <- function(parts, scheme) {
  curves <- parts[["level"]] == "curves"
  stats::setNames(ifelse(is.na(scheme$curves$cut_share), parts[["length"]][curves], NA),
                  parts[["part"]][curves])
}

#' Measures as bytes, and again: whose they are, their scheme and their scores are elsewhere
#' @noRd
pack_measures <- function(one) {
  one$parts[c("specimen", "z")] <- NULL
  memCompress(serialize(one[c("parts", "said", "found")], NULL), "gzip")
}

unpack_measures <- function(packed) unserialize(memDecompress(packed, "gzip"))

unpacked_parts <- function(one) if (is.raw(one$parts)) unpack_measures(one$parts)$parts else
  one$parts

#' A list of shapes by name of specimen; every name once
#' @noRd
named_shapes <- function(x, name = "x") {
  if (inherits(x, c("shape_batch", "shape_sample"))) x <- as.list(x)
  if (inherits(x, "shape")) x <- list(x)
  if (!is.list(x) || length(x) == 0) check_class(x, "shape", name, "fit_shape()")
  for (shape in Filter(Negate(is.null), x)) check_class(shape, "shape", name, "fit_shape()")
  given <- if (is.null(names(x))) character(length(x)) else names(x)
  own <- vapply(x, function(shape) if (is.null(shape)) NA_character_ else shape$id, "")
  own <- ifelse(is.na(own), paste("specimen", seq_along(x)), own)
  stats::setNames(x, make.unique(ifelse(is.na(given) | given == "", own, given), sep = " "))
}

#' What is known of every part of one shape, before it is judged
#'
#' @return Data frame as [quality()] says, without `grade` and `why`, with `reason`, `determined`,
#'   `guessed`, `size`, `free` (whether a curve has points between its landmarks), `radius` (of a
#'   curve), `se_max`, and `state`, `confidence` and `exchanged` (of a landmark).
#' @noRd
part_measures <- function(shape, name) {
  status <- shape$status
  checks <- shape$checks
  row <- match(status$part, shape$scheme$curves$curve)
  row[status$level != "curves"] <- NA
  asymmetry <- curve_asymmetry(shape)[row]
  radius <- shape$scheme$curves$radius[row]
  data.frame(
    specimen = rep(name, nrow(status)),
    status[c("part", "level", "kind", "length", "strength", "contrast", "se", "competing")],
    z = NA_real_, asymmetry = unname(asymmetry) / checks$size,
    checks[c("missing", "cut", "bridged", "faults", "roughness")],
    coarse = checks$edge / radius, border = checks$border / checks$size,
    spike = checks$spike / checks$size, offset = recorded(checks, "offset", NA_real_),
    track = recorded(checks, "track", NA_real_),
    noise_factor = recorded(status, "noise_factor", NA_real_),
    reason = status$reason, checks[c("determined", "guessed", "size")],
    free = shape$scheme$curves$n[row] > 2,
    radius = radius, se_max = recorded(status, "se_max", NA_real_),
    state = recorded(checks, "state", NA_character_),
    confidence = recorded(checks, "confidence", NA_real_),
    exchanged = recorded(checks, "exchanged", NA_character_),
    row.names = NULL
  )
}

#' A column of a table, or its replacement in shapes of former versions
#' @noRd
recorded <- function(table, name, none) if (is.null(table[[name]])) rep(none, nrow(table)) else
  table[[name]]

#' Scores of the lengths of curves, specimens x curves
#'
#' A curve that the scheme cuts off is as long as the landmarks that say so want it: it has no
#' score.
#' @noRd
sample_scores <- function(shapes, others, limits) {
  lengths <- lapply(c(shapes, others), `[[`, "lengths")
  curves <- unique(unlist(lapply(lengths, names)))
  lengths <- matrix(vapply(lengths, function(x) x[curves], numeric(length(curves))),
                    ncol = length(curves), byrow = TRUE)
  scores <- length_scores(lengths, limits$others, limits$spread)
  dimnames(scores) <- list(c(names(shapes), rep("", length(others))), curves)
  scores[seq_along(shapes), , drop = FALSE]
}

#' Rows of specimens as a whole; NULL where there are none
#' @noRd
specimen_rows <- function(names, grade, why) {
  if (!length(names)) return(NULL)
  said <- list(specimen = names, part = "whole specimen", level = "specimen", kind = "specimen",
               why = unname(why))
  rows <- stats::setNames(rep(list(NA_real_), length(quality_columns)), quality_columns)
  rows[names(said)] <- said
  rows$grade <- factor(grade, grades, ordered = TRUE)
  rows$faults <- NA_integer_
  as.data.frame(rows)
}

#' @export
as.data.frame.shape_quality <- function(x, ...) {
  check_method_dots(...)
  structure(x, class = "data.frame")
}

#' @export
summary.shape_quality <- function(object, ...) {
  check_method_dots(...)
  specimen <- factor(object$specimen, unique(object$specimen))
  counts <- table(specimen, object$grade)
  counted <- data.frame(specimen = levels(specimen), green = as.vector(counts[, "green"]),
                        amber = as.vector(counts[, "amber"]), red = as.vector(counts[, "red"]))
  found <- attr(object, "found")
  if (!is.null(found)) counted$landmarks <- landmarks_came(counted$specimen, object)
  if (!is.null(object$noise_factor)) {
    counted$noise_factor <- as.vector(tapply(object$noise_factor, specimen, specimen_noise))
  }
  counted
}

#' How the landmarks of specimens came: "found", "placed", NA where they were not measured
#' @noRd
landmarks_came <- function(specimens, table) {
  lost <- table$specimen[table$level == "specimen" & table$grade == "red"]
  ifelse(specimens %in% attr(table, "found"), "found", ifelse(specimens %in% lost, NA, "placed"))
}

#' @export
print.shape_quality <- function(x, most = 10, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  printed(x, {
    if (!all(quality_columns %in% names(x))) return(print(as.data.frame(x), ...))
    if (!identical(attr(x, "rows"), nrow(x))) return(print_rows(x, most))
    counts <- summary(x)
    counts <- counts[order(-counts$red, -counts$amber), ]
    cat("<shape_quality> ", amount(nrow(counts), "specimen"), ", ", amount(nrow(x), "part"), ": ",
        paste(table(x$grade), grades, collapse = ", "), "\n", sep = "")
    for (note in quality_notes(x, counts, most)) {
      cat(strwrap(note, indent = 2, exdent = 4, width = 80), sep = "\n")
    }
    if (nrow(counts) > 1) {
      shown <- utils::head(counts, most)
      cat(sprintf("  %s: %d amber, %d red\n", shown$specimen, shown$amber, shown$red), sep = "")
      if (nrow(counts) > most) cat("  and", nrow(counts) - most, "more\n")
    }
    lines <- worst_lines(x, nrow(counts) > 1)
    for (line in utils::head(lines, most)) {
      cat(strwrap(paste("-", line), width = 80, exdent = 4), sep = "\n")
    }
    if (length(lines) > most) {
      cat("- and", length(lines) - most, "more that are not green: print(x, most = Inf)\n")
    }
    invisible(x)
  })
}

#' What holds of all parts: whose landmarks were found, the noise, what could not be compared
#' @noRd
quality_notes <- function(x, counts, most) {
  found <- attr(x, "found")
  noise <- counts$noise_factor[!is.na(counts$noise_factor)]
  c(if (length(found)) {
      sprintf("landmarks found by the template, not placed by hand, of %s: %s",
              amount(length(found), "specimen"), shorten(found, most))
    },
    if (length(noise) == 1) noise_text(noise),
    if (length(noise) > 1) {
      sprintf("%s (median; %.2g to %.2g over the specimens)", noise_text(stats::median(noise)),
              min(noise), max(noise))
    },
    if (nrow(counts) > 1 && all(is.na(x$z))) {
      "lengths of curves are not compared: too few other specimens (`others` of quality_limits())"
    })
}

#' Rows of a table of quality() that were chosen from it: each with its grade and the reason
#' @noRd
print_rows <- function(x, most) {
  cat("<shape_quality> ", amount(nrow(x), "row"), " of the parts of ",
      amount(length(unique(x$specimen)), "specimen"), "\n", sep = "")
  table <- as.data.frame(x)[c("specimen", "part", "level", "grade", "why")]
  table$part <- titled_parts(table)
  print(utils::head(table[setdiff(names(table), "level")], most), row.names = FALSE, right = FALSE)
  if (nrow(x) > most) cat("and", nrow(x) - most, "more: as.data.frame() has all\n")
  invisible(x)
}

# Lengths of many specimens against each other.

#' Robust z-scores of lengths, relative to each specimen's size
#'
#' Tukey's median polish takes the specimen's size and the part's usual length off the logarithms,
#' so that a large specimen is not flagged and one wrong curve does not change its size. What is
#' left of a length is compared with the median and MAD of the others' (not its own).
#'
#' @param lengths Matrix, specimens x parts, NA where missing.
#' @param others Fewest other specimens.
#' @param spread Least spread, as a share of a length.
#' @return Matrix of the same size, NA where there are too few others.
#' @noRd
length_scores <- function(lengths, others, spread) {
  share <- stats::medpolish(log(lengths), trace.iter = FALSE, na.rm = TRUE)$residuals
  score <- function(x) {
    scores <- rep(NA_real_, length(x))
    known <- which(is.finite(x))
    if (length(known) - 1 < others) return(scores)
    own <- x[known]
    centre <- medians_without(own)
    width <- numeric(length(own))
    for (one in unique(centre)) {
      at <- centre == one
      width[at] <- medians_without(abs(own - one))[at]
    }
    # As in mad()
    scores[known] <- (own - centre) / pmax(formals(stats::mad)$constant * width, spread)
    scores
  }
  scores <- matrix(apply(share, 2, score), nrow(lengths))
  dimnames(scores) <- dimnames(lengths)
  scores
}

#' Of every value the median of the others
#'
#' There are three at most: without one below the middle, without the middle, without one above.
#' @param x Numeric without NA, two at least.
#' @noRd
medians_without <- function(x) {
  side <- sign(rank(x, ties.method = "first") - (length(x) + 1) / 2)
  values <- vapply(-1:1, function(one) {
    at <- match(one, side)
    if (is.na(at)) NA_real_ else stats::median(x[-at])
  }, 0)
  values[side + 2]
}

# How far a curve is from the mirror image of its partner: what one specimen can say against itself.

#' Asymmetry of every curve of a shape
#'
#' The shape is reflected, left and right exchanged, and laid on itself by its landmarks (rotation
#' and translation). Between the curve and its partner's image only what lies between the ends
#' counts: the ends' own difference, interpolated along the curve, is taken off. A curve that is its
#' own partner is compared with its own image.
#'
#' @param shape A `shape`.
#' @return Numeric by curve of the scheme, in the unit of the mesh: the greatest distance of
#'   corresponding points; NA where one of the two is missing, the scheme has no pairs, or the
#'   landmarks do not fix the image.
#' @noRd
curve_asymmetry <- function(shape) {
  curves <- shape$scheme$curves
  pairs <- shape$scheme$pairs
  none <- stats::setNames(rep(NA_real_, nrow(curves)), curves$curve)
  image <- if (nrow(pairs)) mirror_image(coords(shape, "landmarks"), pairs)
  if (is.null(image)) return(none)
  points <- shape$points[shape$points$level == "curves", ]
  own <- split.data.frame(as.matrix(points[c("x", "y", "z")]), factor(points$part, curves$curve))
  partner <- partner_of(curves$curve, pairs, "curves")
  backwards <- partner_of(curves$from, pairs, "landmarks") != curves$from[match(
    partner, curves$curve
  )]
  for (i in seq_along(none)) {
    mirrored <- image(own[[partner[i]]])
    if (backwards[i]) mirrored <- mirrored[rev(seq_len(nrow(mirrored))), , drop = FALSE]
    none[i] <- bow(mirrored - own[[i]])
  }
  none
}

#' The map to the mirror image of landmarks, best laid on themselves; `NULL` where they do not fix
#' it
#'
#' @param flat Landmarks on a line fix no image: the second singular value as a share of the first.
#' @noRd
mirror_image <- function(landmarks, pairs, flat = 1e-6) {
  flip <- diag(c(-1, 1, 1))
  mirrored <- landmarks[partner_of(rownames(landmarks), pairs, "landmarks"), ,
                        drop = FALSE] %*% flip
  known <- stats::complete.cases(landmarks, mirrored)
  if (sum(known) < 3) return(NULL)
  from <- colMeans(mirrored[known, ])
  to <- colMeans(landmarks[known, ])
  turn <- nearest_rotation(sweep(mirrored[known, ], 2, from), sweep(landmarks[known, ], 2, to))
  if (turn$d[2] <= flat * turn$d[1]) return(NULL)
  function(xyz) sweep(sweep(xyz %*% flip, 2, from) %*% turn$rotation, 2, to, "+")
}

#' Greatest length of differences (n x 3) after those between their first and last are interpolated
#' and taken off
#' @noRd
bow <- function(gap) {
  share <- seq(0, 1, length.out = nrow(gap))
  max(row_lengths(gap - outer(1 - share, gap[1, ]) - outer(share, gap[nrow(gap), ])))
}
