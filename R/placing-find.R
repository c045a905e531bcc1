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
#' Landmarks that a specimen has already are kept as they are. The others are found with them: three
#' or more give a start of their own, and those that the template has take part in the deformation
#' (setting `placed`). Landmarks that were found or predicted before are found again. To find all of
#' them anew, give `specimen$mesh`.
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
#'   as large as the template, which is right to about 12 % for faces.
#' @param threads Number of threads of [curvature()].
#' @return The [specimen()] with `landmarks` (those that are absent NA) and
#'   * `placing`: data frame with a row for each landmark; lengths in the unit of the mesh. Columns:
#'     * `landmark`;
#'     * `state`: "found"; "placed" (the specimen had it before); "predicted" (the template marks it
#'       so: it is placed by the positions of the others, perhaps off the mesh); or "absent" (the
#'       scan has no surface there). Where a face has ears, the predicted tragion is put where a
#'       patch of an ear fits best (setting `ear`); it is still some 5 mm off, and "predicted";
#'     * `confidence`: from 0 to 1, doubtful below 0.5. It is 1 / (1 + (`moved` / a)^2 + (`residual`
#'       / b)^2 + (`sd` / c)^2), where a, b and c are the settings `moved`, `off` and `vague`. The
#'       corners and the middle of the mouth share their doubt (setting `shared_doubt`). If
#'       the verdict is "perhaps", it is at most the setting `unsure`. With a template of your own
#'       whose score is above the setting `poor`, it is multiplied by (1 - score) / (1 - `poor`).
#'       NA for a placed landmark, or 1 / (1 + (`residual` / b)^2) if it contradicts the others;
#'     * `moved`: distance between the positions with and without curvature;
#'     * `sd`: standard deviation that missing parts of the scan add;
#'     * `residual`: mean distance of the deformed template from the scan near the landmark. For a
#'       placed landmark: its distance from where it would be found without it;
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
#' @section Warnings: of class `crestline_contrary_landmarks`: landmarks that the specimen has are
#'   farther from where they are found than the setting `contrary`. They are named and kept, but
#'   have no say. Of class `crestline_guessed_unit`: `match$unit` is a guess. Also of class
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
#' @seealso [landmark_template()], [calibrate_template()], [check_placing()], [second_opinion()]
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
  kept <- kept_landmarks(scan)
  prepared <- prepared_template(template, settings, threads)
  laid <- laid_template(prepared, template, scan, settings, threads, unit, kept)
  expressed <- expressed_pose(prepared, laid, prepared$settings)
  laid <- expressed$laid
  if (laid$verdict %in% "perhaps" && laid$agree >= settings$agree[2]) laid$verdict <- "face"
  placed <- placed_landmarks(expressed$template, template, scan, laid, kept)
  if (laid$inverted) {
    scan <- turned_inside_out(scan)
    placed[face_columns] <- NULL
  }
  doubt <- placing_doubt(placed, settings$low)
  size <- if (laid$unit_known) laid$pose[13] * laid$asked / laid$unit else 1
  match <- c(laid[c("score", "agree", "verdict")],
             list(unit = laid$unit * size / laid$pose[13], unit_known = laid$unit_known))
  found <- with_placing(scan, placed, c(match, list(
    scale = size, rotation = matrix(laid$pose[1:9], 3), inverted = laid$inverted,
    doubtful = doubt$share > settings$wrong, template = template$id
  )), kept)
  warn_doubtful(found, doubt, settings)
  warn_contrary(found)
  warn_bare_piece(found)
  found
}

#' A scan whose triangles faced inwards
#' @noRd
turned_inside_out <- function(scan) {
  turned <- specimen(turn_faces(scan$mesh, seq_len(ncol(scan$mesh$it))), id = scan$id,
                     outward = "keep")
  with_fields(turned, file = scan$file, landmarks = scan$landmarks, origin = origin_of(scan))
}

#' The template laid on a scan, or an error where it does not fit
#' @param kept As of [kept_landmarks()].
#' @return List as of [settled_pose()], with `verdict` (NA for a template without one).
#' @noRd
laid_template <- function(prepared, template, scan, settings, threads, unit = NULL,
                          kept = scan$landmarks[0, , drop = FALSE]) {
  given <- !is.null(unit)
  unit <- if (!given) {
    10^round(log10(specimen_size(template$specimen) / specimen_size(scan)))
  } else {
    check_number(unit, "unit", lower = 0, open = TRUE)
  }
  start <- kept_start(template, kept * unit, prepared$settings)
  laid <- c(settled_pose(prepared, scan, unit, prepared$settings, threads, start),
            unit_known = TRUE)
  if (!given && laid$agree < settings$agree[2]) {
    laid <- swept_pose(prepared, scan, laid, prepared$settings, threads)
  }
  laid$asked <- unit
  if (!given) laid <- sized_pose(prepared, scan, laid, unit, prepared$settings, threads)
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
      "The object is then as large as the template, faces to about 12 %. Better give `unit`.",
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

#' A specimen with landmarks as they were placed; those that are kept to the last digit
#' @param placing As `placing` of [find_landmarks()]; with the columns of faces and weights too, the
#'   places are not sought again.
#' @noRd
with_placing <- function(scan, placing, match,
                         kept = scan$landmarks[0, , drop = FALSE]) {
  at <- as.matrix(placing[c("x", "y", "z")])
  at[placing$state == "absent", ] <- NA
  rownames(at) <- placing$landmark
  on <- placing$state == "found"
  known <- if (all(face_columns %in% names(placing))) {
    frame_of(lapply(placing[mesh_columns], `[`, on))
  }
  found <- check_landmarks(at[on, , drop = FALSE], scan$mesh, scan$id, Inf, character(),
                           located = known)
  at[on, ] <- found$landmarks
  at[rownames(kept), ] <- kept
  origin <- origin_of(scan)
  scan$landmarks <- at
  scan$report <- report_of_missing(scan$report, at)
  scan$geometry$landmarks <- rbind(found$landmarks, kept)
  scan$geometry$located <- rbind(found$located, surface_points(scan$mesh, kept))
  scan$placing <- placing[setdiff(names(placing), face_columns)]
  scan$match <- match
  scan$origin <- origin
  mine <- !placing$landmark %in% rownames(kept)
  with_origin(scan, placing$landmark[mine],
              ifelse(placing$state == "absent", NA, placing$state)[mine])
}

#' The landmarks of a scan: those that are kept, and with them the others
#'
#' What is kept is compared with what the surface alone gives. Those near it take part in the bend.
#'
#' @return Data frame as of [carried_landmarks()].
#' @noRd
placed_landmarks <- function(prepared, template, scan, laid, kept) {
  found <- carried_landmarks(prepared, template, scan, laid)
  if (!nrow(kept)) return(found)
  settings <- prepared$settings
  length <- laid$unit / laid$pose[13]
  alone <- kept_offsets(kept, found, settings, length)
  good <- kept[!rownames(kept) %in% alone$contrary, , drop = FALSE]
  pins <- warp_pins(prepared, good, laid)
  if (!is.null(pins)) {
    laid$plain <- fit_warp(prepared, cloud_in_frame(laid$cloud, laid$pose), settings, 0, pins)
  }
  found <- carried_landmarks(prepared, template, scan, laid, pins, good)
  with_kept(found, kept, alone, settings, length)
}

#' The template's landmarks carried to a scan, with what speaks for each
#' @param pins As of [warp_pins()]; `kept` (k x 3): what predicts others too.
#' @return Data frame as `placing` of [find_landmarks()], with `face`, `w1`, `w2`, `w3` besides (NA
#'   where a landmark is predicted).
#' @noRd
carried_landmarks <- function(prepared, template, scan, laid, pins = NULL, kept = NULL) {
  settings <- prepared$settings
  local <- cloud_in_frame(laid$cloud, laid$pose)
  bent <- fit_warp(prepared, local, settings, settings$weight, pins)
  n <- ncol(prepared$xyz)
  own <- prepared$landmarks
  to_scan <- function(xyz) from_frame(xyz, laid)
  carried <- lapply(list(bent, laid$plain),
                    function(fit) to_scan(fit$moved[-seq_len(n), , drop = FALSE]))
  located <- surface_points(scan$mesh, do.call(rbind, carried))
  places <- columns_of(located, c("x", "y", "z"))
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
  found[face_columns] <- located[with_curvature, face_columns]
  found <- with_shared_doubt(found, prepared$modes$slit, settings$shared_doubt)
  if (!nrow(template$predicted)) return(found)
  rbind(found, predicted_landmarks(template, found, laid, settings, kept))
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

#' Landmarks with the least confidence of a group in a share of each one's
#' @param names Of the group.
#' @noRd
with_shared_doubt <- function(found, names, share) {
  these <- which(found$landmark %in% names & !is.na(found$confidence))
  if (!length(these)) return(found)
  own <- found$confidence[these]
  found$confidence[these] <- (1 - share) * own + share * min(own)
  found
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

#' Landmarks without a feature of the surface, by a similarity fitted to those that were found
#' @noRd
predicted_landmarks <- function(template, found, laid, settings, kept = NULL) {
  own <- template$predicted
  to <- as.matrix(found[c("x", "y", "z")])
  named <- intersect(found$landmark, rownames(kept))
  to[match(named, found$landmark), ] <- kept[named, ]
  on <- found$state == "found" | found$landmark %in% named
  at <- if (sum(on) < 4) from_frame(own, laid) else {
    by <- similarity(template$landmarks[on, , drop = FALSE], to[on, , drop = FALSE])
    apply_similarity(predicted_places(template, laid, by, settings), by)
  }
  data.frame(landmark = rownames(own), state = "predicted", confidence = NA_real_, moved = NA_real_,
             sd = NA_real_,
             residual = NA_real_, lost = NA_real_, x = at[, 1], y = at[, 2], z = at[, 3],
             face = NA_integer_, w1 = NA_real_, w2 = NA_real_, w3 = NA_real_, row.names = NULL)
}
