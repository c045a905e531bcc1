# From what on a part of a shape is graded amber or red.

#' Limits of the quality report
#'
#' All limits of [quality()]. Each limit has two values, `c(amber, red)`. A part is amber above the
#' first and red above the second. If small values are bad, it is amber and red below them. `Inf`
#' switches a limit off (`-Inf` if small values are bad). No limit depends on the unit of the mesh.
#'
#' The defaults were chosen on 26 good scans and on scans that were spoiled on purpose (holes,
#' spikes, noise, decimation). Of the points that were more than 3 mm off, 99.9 % were graded amber
#' or red. Of the parts of good whole faces, up to 4.3 % were. Scans that end before the ears have
#' more, as trimmed curves are then too short.
#'
#' @param ... Nothing: limits are given by name, and an unknown name is an error.
#' @param missing Share of the part's points that are missing.
#' @param se,se_max Median and largest standard error across a curve, in radii of its curvature
#'   estimate (above 0.2, the setting `undetermined` of [ridge_settings()], a curve counts as not
#'   determined). The standard error includes the noise factor, which takes fine relief for noise.
#'   So the limits are from good faces (three scans, 23 and 19 simulated ones; 628 ridges and
#'   valleys). Of these curves 1.1 % have a median standard error above 0.2, and none above 0.4.
#'   0.2 % have a largest one above 1; above 0.8, the former limit, it is 3.3 %.
#' @param doubtful Share of the found landmarks whose confidence is below the first limit of
#'   `confidence`. It applies to all parts of a specimen.
#' @param confidence Confidence of a landmark that [find_landmarks()] found. It also applies to the
#'   curves that end there. Small values are bad.
#' @param competing Criterion of the best other reference path, as a share of the chosen path's.
#' @param z Size of the z-score of the length against other specimens.
#' @param asymmetry Greatest distance of a curve from the mirror image of its partner, as a share of
#'   its length.
#' @param roughness Mean angle in degrees between the normals of the triangles along the part and
#'   those at their corners (good scans: below 10).
#' @param coarse Mean edge of the triangles along a ridge or valley, in radii of its curvature
#'   estimate.
#' @param bridged Share of a curve's length that lies over holes.
#' @param offset Root mean square distance of a curve's homologous points from the measured curve,
#'   across it, in radii of the template (1/19 is 3 mm on a face). It exists for shapes that were
#'   slid. A large value can mean that the curve runs along another feature than on the other
#'   specimens. On ten simulated faces of another population it detects 8 of 29 such curves that
#'   no other limit detects. It also flags 3 of 230 correct curves.
#' @param track Greatest distance of a curve from its expected track, in spreads. It exists if the
#'   scheme has tracks, see [learn_tracks()].
#' @param faults Number of flipped, doubled or crossing triangles of a patch.
#' @param contrast Mean strength along a curve over the mean strength beside it. Small values are
#'   bad.
#' @param cut Length of a trimmed curve, as a share of the length that the scheme asks for. Small
#'   values are bad.
#' @param border Distance from a border of the mesh or of a hole, as a share of the part's size (a
#'   curve's length, the diameter of a patch). Small values are bad.
#' @param spike Distance within which there are four crumpled triangles (bent by more than 30
#'   degrees), as a share of the part's size. Small values are bad.
#' @param undetermined Grade of curves that curvature does not determine: "green", "amber" or "red".
#' @param guessed Grade of trimmed curves that had to be directed or measured without one of their
#'   landmarks (see [fit_shape()]): "green", "amber" or "red".
#' @param exchanged Grade of landmarks that look exchanged with another, and of the curves that end
#'   there: "green", "amber" or "red".
#' @param predicted Grade of landmarks that [find_landmarks()] predicts (those at the ears: 10 mm
#'   off on average), and of the curves that end there: "green", "amber" or "red".
#' @param others Least number of other specimens for a z-score.
#' @param spread Least spread of a length across specimens for z-scores, as a share of the length.
#'   It avoids flags in a sample of nearly equal specimens.
#' @return List of class `quality_limits`.
#' @section Errors: of class `crestline_error`: a name is not that of a limit, or two values are in
#'   the wrong order.
#' @template glossary
#' @examples
#' quality_limits(z = c(3, 4), faults = c(Inf, Inf))
#' @export
quality_limits <- function(..., missing = c(0, 0.2), se = c(0.2, 0.4), se_max = c(1, Inf),
                           doubtful = c(0.6, Inf), confidence = c(0.5, -Inf),
                           competing = c(0.97, Inf), z = c(5, 8), asymmetry = c(0.1, 0.3),
                           roughness = c(12, 20), coarse = c(0.6, 1), bridged = c(0.02, 0.2),
                           offset = c(1 / 19, Inf), track = c(4, Inf), faults = c(0, Inf),
                           contrast = c(1.2, 0.9), cut = c(0.98, 0.7),
                           border = c(0.04, 0.005), spike = c(0.07, 0.02),
                           undetermined = "amber", guessed = "amber", exchanged = "red",
                           predicted = "amber", others = 10L, spread = 0.01) {
  new_settings("quality_limits", check_limits, list(...), noun = "limit")
}

check_limits <- function(limits) {
  graded <- c("undetermined", "guessed", "exchanged", "predicted")
  for (name in setdiff(names(limits), c(graded, "others", "spread"))) {
    limits[[name]] <- check_limit(limits[[name]], name, name %in% small_is_bad)
  }
  for (name in graded) limits[[name]] <- check_choice(limits[[name]], grades, name)
  limits$others <- check_count(limits$others, "others", lower = 2)
  limits$spread <- check_number(limits$spread, "spread", lower = 0)
  limits
}

grades <- c("green", "amber", "red")
small_is_bad <- c("confidence", "contrast", "cut", "border", "spike")

check_limit <- function(x, name, falling) {
  ordered <- is.numeric(x) && length(x) == 2 && !anyNA(x) &&
    (if (falling) x[1] >= x[2] else x[1] <= x[2])
  if (!ordered) {
    crestline_abort(sprintf("`%s` is %s.", name, describe_value(x)),
                    sprintf("Give two numbers, c(amber, red), the second %s.",
                            if (falling) "no greater" else "no smaller"),
                    stage = "arguments")
  }
  as.numeric(x)
}

#' @export
print.quality_limits <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat("<quality_limits> amber, red\n")
    pairs <- x[lengths(x) == 2]
    side <- ifelse(names(pairs) %in% small_is_bad, "below", "above")
    cat(sprintf("  %-10s %s %g, %g\n", names(pairs), side, vapply(pairs, `[`, 0, 1),
                vapply(pairs, `[`, 0, 2)), sep = "")
    cat(sprintf("  not determined by curvature: %s; without a landmark on the mesh: %s\n",
                x$undetermined, x$guessed))
    cat(sprintf("  landmarks exchanged: %s; predicted: %s\n", x$exchanged, x$predicted))
    cat(sprintf("  z-scores against at least %d others, with a spread of at least %g\n", x$others,
                x$spread))
    invisible(x)
  })
}
