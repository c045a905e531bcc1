# A scheme tried on one specimen: every row with what is wrong beside it.

#' Check a scheme on one specimen
#'
#' Fits every curve and patch of a scheme on one specimen, and lists them with what is wrong beside
#' each and what to do about it. Use it while you write a scheme. `plot()` shows a picture of every
#' row.
#'
#' Beyond the reasons of [quality()] it names two mistakes of a scheme:
#' * a landmark stands beside the ridge or valley that ends on it, by more than `beside` radii: the
#'   curve then has a hook at that end. It names the distance along the surface, as [snap()] has it
#'   (`remark` in `status` of [fit_shape()] has a straight one, which takes no time);
#' * the `width` of a row is more than `settings$window` radii: only so much of it is used.
#'
#' @param scheme A [curve_scheme()].
#' @param specimen A [specimen()] with the scheme's landmarks.
#' @param settings [ridge_settings()] of all curves.
#' @param beside Greatest distance of a landmark from the ridge or valley that ends on it, in radii
#'   of that curve.
#' @param unit As in [fit_shape()].
#' @inheritParams curvature
#' @return Data frame of class `scheme_check`, a row for each curve and patch:
#'   * `part`, `level` ("curves" or "surface"), `kind`;
#'   * `length` (unit of the mesh), `strength` (1 / unit), `se` (median standard error, unit of the
#'     mesh): as in `status` of [fit_shape()];
#'   * `grade`: ordered factor green < amber < red, as of [quality()]; at least amber if a landmark
#'     stands beside its crest;
#'   * `reason`: what is wrong, sentences separated by "; "; NA if nothing is;
#'   * `remedy`: what to do, one sentence for each kind of reason; NA without a reason.
#'
#'   The attribute `shape` is the shape that was fitted.
#' @section Errors: as of [fit_shape()].
#' @template glossary
#' @seealso [build_scheme()], [quality()], [snap()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' check_scheme(face_scheme(), face)
#' }
#' @export
check_scheme <- function(scheme, specimen, settings = ridge_settings(), beside = settings$beside,
                         unit = NULL, threads = getOption("crestline.threads", 1L)) {
  check_given()
  beside <- check_number(beside, "beside", 0)
  shape <- fit_shape(specimen, scheme, settings, unit = unit, threads = threads, progress = FALSE)
  rows <- as.data.frame(quality(shape))
  rows <- rows[rows$level %in% c("curves", "surface"), ]
  said <- row_mistakes(shape, settings, beside, threads)
  hooked <- said$hook[match(rows$part, said$curve)]
  hooked[rows$level == "surface"] <- NA
  wide <- said$wide[match(rows$part, said$curve)]
  wide[rows$level == "surface"] <- NA
  reason <- joined_words(joined_words(rows$why, hooked), wide)
  grade <- rows$grade
  grade[!is.na(hooked) & grade == "green"] <- "amber"
  table <- data.frame(rows[c("part", "level", "kind", "length", "strength", "se")], grade = grade,
                      reason = reason, remedy = vapply(reason, remedy_of, "", USE.NAMES = FALSE),
                      row.names = NULL)
  structure(table, shape = shape, class = c("scheme_check", "data.frame"))
}

joined_words <- function(a, b) ifelse(is.na(a), b, ifelse(is.na(b), a, paste(a, b, sep = "; ")))

#' Mistakes of the rows of curves: landmarks beside their crest, widths that are cut
#'
#' @return Data frame `curve`, `hook`, `wide`; NA where there is none.
#' @noRd
row_mistakes <- function(shape, settings, beside, threads) {
  curves <- shape$scheme$curves
  specimen <- shape$specimen
  scan <- walkable(specimen)
  sources <- list()
  hook <- wide <- rep(NA_character_, nrow(curves))
  for (i in which(curves$kind != "plane")) {
    row <- curves[i, ]
    wide[i] <- cut_width_words(row$kind, row$width, row$radius, settings$window)
    key <- as.character(row$radius)
    if (is.null(sources[[key]])) {
      sources[[key]] <- known_curvature(NULL, specimen, row$radius, threads, settings$order)
    }
    ends <- hooked_ends(row, scan, specimen, sources[[key]], settings, beside)
    if (length(ends)) hook[i] <- paste(ends, collapse = "; ")
  }
  data.frame(curve = curves$curve, hook = hook, wide = wide)
}

#' The ends of a curve that stand beside its crest, in words
#'
#' An end where curvature is not trusted, or that is trimmed, need not stand on a crest.
#' @noRd
hooked_ends <- function(row, scan, specimen, source, settings, beside) {
  free <- c(from = row$trust_from > 0 || !is.na(row$cut_share), to = row$trust_to < 1)
  # The stops of a closed curve have no say in where it runs.
  if (closed_curves(row)) return(NULL)
  names <- unlist(row[c("from", "to")])
  unlist(lapply(unique(names[!free]), function(name) {
    place <- as_value(found_landmark(specimen, name))
    if (failed(place)) return(NULL)
    reach <- min(row$width, settings$window * row$radius)
    faint <- settings$faint
    found <- snapped_place(scan, place, row$kind, row$radius, reach, faint, source)
    if (is.null(found)) return(sprintf("no %s within %.3g of landmark %s", row$kind, reach, name))
    if (found$distance <= beside * row$radius) return(NULL)
    sprintf("landmark %s stands %.2g beside the %s", name, found$distance, row$kind)
  }))
}

#' What to do about each kind of reason: the first pattern that fits a sentence counts
#' @noRd
reason_remedies <- c(
  "stands .* beside the" = "Move the landmark onto the crest: snap().",
  "of landmark" = "Move the landmark, or do not trust curvature there: trust_from, trust_to.",
  "of its width is used" = "Give a width of at most so much, or a larger radius.",
  "^bounded by" = "Mend that curve first.",
  "missing|no landmark" = "Place the landmark, or run the curve beside the hole.",
  "triangle" = "Try the other `outward`, fewer rows, or other bounding curves.",
  "edge of the window" = "Give a larger width or radius, or a landmark half-way along the crest.",
  "faint" = "Try a smaller radius; where there is no feature take kind \"plane\".",
  "standard error" = "Try a larger radius, or a landmark half-way along the crest.",
  "another path" = "Look which feature you mean; another radius, a landmark on it, or keep_away.",
  "strength is only" = "Try a smaller radius; kind \"plane\" where there is no feature.",
  "mirror image" = "Look at both sides, and at the landmarks of the pair.",
  "coarse" = "Give a larger radius, or use the mesh before it was decimated.",
  "rough|spike|border|hole" = "Look whether the mesh is sound there.",
  "exchanged" = "Rename the two landmarks."
)

#' Remedies of a reason with several sentences, each once
#' @noRd
remedy_of <- function(reason) {
  if (is.na(reason)) return(NA_character_)
  each <- strsplit(reason, "; ", fixed = TRUE)[[1]]
  remedy <- vapply(each, function(text) {
    fits <- vapply(names(reason_remedies), grepl, NA, x = text)
    c(unname(reason_remedies[fits]), "Look at it in a picture: plot() of this check.")[1]
  }, "")
  paste(unique(remedy), collapse = " ")
}

#' @export
print.scheme_check <- function(x, most = 12, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  needed <- c("part", "kind", "length", "strength", "se", "grade", "reason", "remedy")
  if (!all(needed %in% names(x))) return(invisible(print(as.data.frame(x))))
  printed(x, {
    count <- table(factor(x$grade, grades))
    scheme <- attr(x, "shape")$scheme
    cat(sprintf("<scheme_check> %s on %s: %s\n", scheme$name, attr(x, "shape")$id,
                paste(count, names(count), collapse = ", ")))
    shown <- data.frame(part = substr(x$part, 1, 32), kind = x$kind, length = signif(x$length, 3),
                        strength = signif(x$strength, 3), se = signif(x$se, 2), grade = x$grade)
    print(shown, row.names = FALSE, na.print = "")
    said <- which(!is.na(x$reason))
    said <- said[order(-as.integer(x$grade[said]))]
    for (i in utils::head(said, most)) {
      cat(strwrap(sprintf("%s (%s): %s. %s", x$part[i], x$grade[i], x$reason[i], x$remedy[i]), 80,
                  exdent = 2), sep = "\n")
    }
    if (length(said) > most) {
      cat(sprintf("and %d more: print(x, most = Inf)\n", length(said) - most))
    }
    invisible(x)
  })
}
