# Landmarks found on a raw scan: the template laid on it, bent onto it, and its landmarks carried
# over.

#' Find the landmarks of a raw scan
#'
#' Finds the landmarks of a template on a scan. The scan is brought to the template's unit (a power
#' of ten). The template's nose tip is placed on every prominent part of the scan, in many
#' rotations. The starts that match best are fitted. If no fit is good, starts at the strongest caps
#' and cups follow. The template is then deformed onto the scan, by points that are closest in
#' position and curvature. Each of its landmarks moves to the closest point of the mesh. The result
#' does not depend on the scan's pose, nor on the orientation of its triangles. The scan may show
#' more than the object, or lack parts of it. [crestline-package] has a glossary.
#'
#' @template bare-mesh
#' @param template A [landmark_template()], or a [specimen()] with landmarks, of which one is made.
#'   Default: the template of the face.
#' @template bare-id
#' @param settings Of [find_settings()].
#' @param unit Factor from the mesh's unit to the template's. `NULL`: the power of ten that brings
#'   their diagonals closest to each other. If the scan does not agree with the template in that
#'   unit, other units are tried. `match$unit_known` is then FALSE, and also if the object is much
#'   larger or smaller than the template (setting `unit_apart`). `match$unit` then makes the object
#'   as large as the template, which is right to about 10 % for faces.
#' @param threads Number of threads of [curvature()].
#' @return The [specimen()] with `landmarks` (those that are absent NA) and
#'   * `placing`: data frame with a row for each landmark; lengths in the unit of the mesh. Columns:
#'     * `landmark`;
#'     * `state`: "found"; "predicted" (the template marks it so: it is placed by the positions of
#'       the others, perhaps off the mesh); or "absent" (the scan has no surface there);
#'     * `confidence`: from 0 to 1, doubtful below 0.5. It is 1 / (1 + (`moved` / a)^2 + (`residual`
#'       / b)^2 + (`sd` / c)^2), where a, b and c are the settings `moved`, `off` and `vague`. If
#'       the verdict is "perhaps", it is at most the setting `unsure`. With a template of your own
#'       whose score is above the setting `poor`, it is multiplied by (1 - score) / (1 - `poor`);
#'     * `moved`: distance between the positions with and without curvature;
#'     * `sd`: standard deviation that missing parts of the scan add;
#'     * `residual`: mean distance of the deformed template from the scan near the landmark;
#'     * `lost`: share of the template near the landmark that has no counterpart on the scan;
#'     * `x`, `y`, `z`: the position, of absent landmarks too;
#'   * `match`: a list:
#'     * `score`: 0 if the undeformed template fits the scan, 1 if it fits nowhere;
#'     * `agree`: mean correlation of the deformed template's curvature with the scan's (1: equal,
#'       0: unrelated), lowered if the scan's curvature varies less;
#'     * `verdict`: "face" or "perhaps", by `agree` and the setting of that name. NA for a template
#'       of your own, as the limits were measured on faces;
#'     * `unit`: factor to the template's unit; `unit_known`: FALSE if that is a guess, see the
#'       argument `unit`; `scale`: factor of the template;
#'     * `rotation`: 3 x 3, from the template to the scan;
#'     * `inverted`: TRUE if the triangles faced inwards;
#'     * `doubtful`: TRUE if the share of found landmarks with low confidence is above the setting
#'       `wrong`;
#'     * `template`.
#' @section Errors: of class `crestline_error`, stage "landmarks". Either nothing in the scan
#'   resembles the template (the score is above the setting `refuse`), or the scan is no face
#'   (`agree` is below the first limit).
#' @section Warnings: of class `crestline_guessed_unit`: `match$unit` is a guess. Also of class
#'   `crestline_doubtful_placing`, for three reasons. The scan is perhaps
#'   no face; or `agree` is below the first limit with a template of your own; or most landmarks
#'   have low confidence (settings `low`, `wrong`). Most likely the scan does not show the object,
#'   or not enough of it. [quality()] then grades nothing green. A single landmark with low
#'   confidence gives no warning. `print()` names it, and [quality()] grades it, and the curves that
#'   end there, amber.
#' @templateVar where sections 1 and 7 (which take landmarks as given)
#' @template paper
#' @section Keeping the result: `saveRDS(specimen, file)` keeps the specimen with its states and
#'   confidences. [write_landmarks()] writes the positions only.
#' @seealso [landmark_template()], [calibrate_template()], [check_placing()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' face <- find_landmarks(humface, id = "humface")
#' face$placing
#' plot(face, "plain", engine = "picture", labels = TRUE)
#' }
#' @export
find_landmarks <- function(mesh, template = face_template(), id = NULL, settings = find_settings(),
                           unit = NULL,
                           threads = getOption("crestline.threads", 1L)) {
  check_given()
  check_surface(mesh, "mesh")
  threads <- check_threads(threads)
  check_class(settings, "find_settings", "settings", "find_settings()")
  template <- check_template(template)
  scan <- validate(mesh)
  if (!inherits(mesh, "specimen")) {
    scan <- suppressWarnings(specimen(mesh, id = id), classes = "crestline_warning")
  }
  prepared <- prepared_template(template, settings, threads)
  laid <- laid_template(prepared, template, scan, settings, threads, unit)
  expressed <- expressed_pose(prepared, laid, prepared$settings)
  laid <- expressed$laid
  placed <- carried_landmarks(expressed$template, template, scan, laid)
  if (laid$inverted) {
    turned <- specimen(turn_faces(scan$mesh, seq_len(ncol(scan$mesh$it))), id = scan$id,
                       outward = "keep")
    scan <- with_fields(turned, file = scan$file)
  }
  doubt <- placing_doubt(placed, settings$low)
  size <- if (laid$unit_known) laid$pose[13] else 1
  match <- c(laid[c("score", "agree", "verdict")],
             list(unit = laid$unit * size / laid$pose[13], unit_known = laid$unit_known))
  found <- with_placing(scan, placed, c(match, list(
    scale = size, rotation = matrix(laid$pose[1:9], 3), inverted = laid$inverted,
    doubtful = doubt$share > settings$wrong, template = template$id
  )))
  warn_doubtful(found, doubt, settings)
  warn_bare_piece(found)
  found
}

#' The template laid on a scan, or an error where it does not fit
#' @return List as of [settled_pose()], with `verdict` (NA for a template without one).
#' @noRd
laid_template <- function(prepared, template, scan, settings, threads, unit = NULL) {
  given <- !is.null(unit)
  unit <- if (!given) {
    10^round(log10(specimen_size(template$specimen) / specimen_size(scan)))
  } else {
    check_number(unit, "unit", lower = 0, open = TRUE)
  }
  laid <- c(settled_pose(prepared, scan, unit, prepared$settings, threads), unit_known = TRUE)
  if (!given && laid$agree < settings$agree[2]) {
    laid <- swept_pose(prepared, scan, laid, prepared$settings, threads)
  }
  if (!given && abs(log(laid$pose[13])) > log(settings$unit_apart)) laid$unit_known <- FALSE
  laid$verdict <- if (template$judged) verdict_of(laid$agree, settings$agree) else NA_character_
  remedy <- sprintf(
    paste0("Is it the object, and whole enough? Its lengths were multiplied by ",
           "%g: else give `unit`, or place the landmarks by hand."),
    laid$unit
  )
  if (laid$score > settings$refuse) {
    refuse_landmarks(sprintf("nothing on it is like the template %s (score %.2f, at most %.2f).",
                             template$id, laid$score, settings$refuse), remedy, scan$id)
  }
  if (laid$verdict %in% "none") {
    refuse_landmarks(sprintf("nothing on it is a %s (agreement %.2f, at least %.2f).",
                             template$id, laid$agree, settings$agree[1]), remedy, scan$id)
  }
  laid
}

#' Warn where the answer as a whole is in doubt
#' @param doubt Of [placing_doubt()].
#' @noRd
warn_doubtful <- function(found, doubt, settings) {
  match <- found$match
  if (isFALSE(match$unit_known)) {
    crestline_warn(
      sprintf("its unit is a guess: its lengths were multiplied by %.3g.", match$unit),
      "The object is then as large as the template, faces to about 10 %. Better give `unit`.",
      stage = "landmarks", id = found$id, class = "crestline_guessed_unit"
    )
  }
  remedy <- paste("Is it the object, and whole enough? Look at plot(specimen, what = \"placing\");",
                  "place the landmarks by hand (place_landmarks()),",
                  "or calibrate the template (calibrate_template()).")
  said <- if (match$verdict %in% "perhaps") {
    sprintf("perhaps it is no %s (agreement %.2f, of one that surely is at least %.2f).",
            match$template, match$agree, settings$agree[2])
  } else if (is.na(match$verdict) && match$agree < settings$agree[1]) {
    sprintf("its curvature hardly agrees with the template %s (%.2f, at least %.2f).",
            match$template, match$agree, settings$agree[1])
  } else if (match$doubtful) {
    many <- if (doubt$of) {
      sprintf("%d of %d found landmarks have little confidence", length(doubt$names), doubt$of)
    } else {
      "no landmark was found"
    }
    sprintf("the template %s lies badly on it: %s.", match$template, many)
  }
  if (!is.null(said)) {
    crestline_warn(said, remedy, stage = "landmarks", id = found$id,
                   class = "crestline_doubtful_placing")
  }
}

#' A specimen with landmarks as they were placed
#' @noRd
with_placing <- function(scan, placing, match) {
  at <- as.matrix(placing[c("x", "y", "z")])
  at[placing$state == "absent", ] <- NA
  rownames(at) <- placing$landmark
  on <- placing$state == "found"
  placed <- check_landmarks(at[on, , drop = FALSE], scan$mesh, scan$id, Inf, character())
  scan$landmarks <- at
  scan$landmarks[on, ] <- placed$landmarks
  scan$geometry[c("landmarks", "located")] <- placed[c("landmarks", "located")]
  scan$placing <- placing
  scan$match <- match
  with_origin(scan, placing$landmark, ifelse(placing$state == "absent", NA, placing$state))
}

#' The template's landmarks carried to a scan, with what speaks for each
#' @return Data frame as `placing` of [find_landmarks()].
#' @noRd
carried_landmarks <- function(prepared, template, scan, laid) {
  settings <- prepared$settings
  local <- cloud_in_frame(laid$cloud, laid$pose)
  bent <- fit_warp(prepared, local, settings, settings$weight)
  n <- ncol(prepared$xyz)
  own <- prepared$landmarks
  to_scan <- function(xyz) from_frame(xyz, laid)
  carried <- lapply(list(bent, laid$plain),
                    function(fit) to_scan(fit$moved[-seq_len(n), , drop = FALSE]))
  places <- columns_of(surface_points(scan$mesh, do.call(rbind, carried)), c("x", "y", "z"))
  with_curvature <- seq_len(nrow(own))
  at <- places[with_curvature, , drop = FALSE]
  rownames(at) <- rownames(own)
  length <- laid$unit / laid$pose[13]
  moved <- row_lengths(at - places[-with_curvature, , drop = FALSE]) * length
  here <- local_evidence(prepared, local, bent, settings)
  residual <- pmax(here$residual, row_lengths(at - carried[[1]]) * length)
  sd <- sqrt(pmax(bent$sd^2 - prepared$sd^2, 0))
  found <- data.frame(landmark = rownames(own),
                      state = ifelse(here$lost > settings$lost, "absent", "found"),
                      confidence = placing_confidence(moved, residual, sd, laid, settings),
                      moved = moved / length, sd = sd / length, residual = residual / length,
                      lost = here$lost,
                      x = at[, 1], y = at[, 2], z = at[, 3], row.names = NULL)
  found$confidence[found$state == "absent"] <- NA
  if (!nrow(template$predicted)) return(found)
  rbind(found, predicted_landmarks(template, found, to_scan))
}

#' Confidence of landmarks, see [find_landmarks()]; lengths in the template's unit
#' @noRd
placing_confidence <- function(moved, residual, sd, laid, settings) {
  each <- 1 / (1 + (moved / settings$moved)^2 + (residual / settings$off)^2 +
                 (sd / settings$vague)^2)
  each[is.na(each)] <- 0
  if (is.na(laid$verdict)) return(each * min(1, (1 - laid$score) / (1 - settings$poor)))
  if (laid$verdict == "face") each else pmin(each, settings$unsure)
}

#' How well the bent template agrees with the scan about each landmark
#' @return Data frame: `residual` (mean distance across the surface), `lost` (share of points
#'   without counterpart).
#' @noRd
local_evidence <- function(prepared, cloud, fit, settings) {
  n <- ncol(prepared$xyz)
  at <- fit$moved[seq_len(n), ]
  to <- t(cloud$xyz[, fit$index, drop = FALSE])
  across <- abs(row_products(to - at, t(cloud$normal[, fit$index, drop = FALSE])))
  along <- sqrt(pmax(fit$residual^2 - across^2, 0))
  gone <- is.na(fit$index) | cloud$border[fit$index] | along > settings$slip * cloud$spacing[1]
  xyz <- t(prepared$xyz)
  each <- apply(prepared$landmarks, 1, function(landmark) {
    gap <- row_lengths(xyz - rep(landmark, each = n))
    about <- gap < max(settings$near, sort(gap)[settings$about])
    c(residual = if (all(gone[about])) NA else mean(across[about & !gone]),
      lost = mean(gone[about]))
  })
  as.data.frame(t(each))
}

#' Landmarks that the surface tells nothing about, by a similarity fitted to those that were found
#' @noRd
predicted_landmarks <- function(template, found, to_scan) {
  own <- template$predicted
  on <- found$state == "found"
  at <- if (sum(on) < 4) to_scan(own) else {
    to <- as.matrix(found[on, c("x", "y", "z")])
    from <- template$landmarks[on, , drop = FALSE]
    apply_similarity(own, similarity(from, to))
  }
  data.frame(landmark = rownames(own), state = "predicted", confidence = NA_real_, moved = NA_real_,
             sd = NA_real_,
             residual = NA_real_, lost = NA_real_, x = at[, 1], y = at[, 2], z = at[, 3],
             row.names = NULL)
}

#' Rotation, scale and shift that take points nearest to others
#' @noRd
similarity <- function(from, to) {
  a <- sweep(from, 2, colMeans(from))
  b <- sweep(to, 2, colMeans(to))
  turn <- nearest_rotation(a, b)
  rotation <- t(turn$rotation)
  scale <- sum(turn$d) / sum(a^2)
  list(rotation = rotation, scale = scale,
       shift = colMeans(to) - scale * drop(rotation %*% colMeans(from)))
}

apply_similarity <- function(xyz, by) {
  moved <- by$scale * xyz %*% t(by$rotation) + rep(by$shift, each = nrow(xyz))
  dimnames(moved) <- dimnames(xyz)
  moved
}

#' Points of the template's frame in that of a scan, and back
#' @noRd
from_frame <- function(xyz, laid) {
  t(laid$pose[13] * matrix(laid$pose[1:9], 3) %*% t(xyz) + laid$pose[10:12]) / laid$unit
}
into_frame <- function(xyz, laid) {
  t(crossprod(matrix(laid$pose[1:9], 3), t(xyz) * laid$unit - laid$pose[10:12])) / laid$pose[13]
}
