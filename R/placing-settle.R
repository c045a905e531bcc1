# How a scan comes to its pose: which starts are tried, in which order, until one is good.

#' The template laid on a scan
#'
#' Tried in turn, until a pose is accepted: starts at every proud place; the same smaller and
#' larger; the same on the scan turned inside out. What is not accepted may agree with the scan even
#' so, as a wide smile does. Where it does not agree by the setting `sure`, the strongest caps and
#' cups are tried, which finds a face without a nose, or without a side; for templates on which the
#' limits were not measured they are tried always.
#'
#' @param unit Factor on the scan's lengths.
#' @param start A further start, as of [kept_start()].
#' @return List: `pose`, `score`, `misfit`, `rests` as of [best_pose()], `inverted`, `cloud`,
#'   `unit`, `plain` (the bend without curvature, see [fit_warp()]), `agree` (see [agreement()]).
#' @noRd
settled_pose <- function(template, scan, unit, settings, threads, start = NULL) {
  cloud <- in_context(with_curvature(scan_cloud(scan, unit, settings), settings, threads), scan$id,
                      "looking for landmarks")
  laid <- c(no_pose(), list(inverted = FALSE, cloud = cloud, unit = unit))
  tries <- list(list(FALSE, 1), list(FALSE, settings$start_scales),
                list(TRUE, c(0.9, 1.1)))
  for (one in tries) {
    seen <- if (one[[1]]) inverted_cloud(cloud) else cloud
    starts <- cbind(proud_starts(template, seen, one[[2]], settings), start)
    laid <- better_pose(laid, best_pose(template, seen, starts, settings$start_reach, settings),
                        one[[1]], seen)
    if (accepted_pose(template, laid, settings)) break
  }
  laid <- agreed_pose(template, laid, settings)
  good <- laid$agree >= settings$sure || accepted_pose(template, laid, settings)
  if (template$judged && good) return(laid)
  likely <- template$judged && laid$agree >= settings$agree[2]
  senses <- if (likely) laid$inverted else c(FALSE, TRUE)
  cloud <- with_anchors(cloud, settings, threads)
  by_anchors <- anchored_pose(template, cloud, laid, senses, settings)
  if (by_anchors$misfit < laid$misfit) agreed_pose(template, by_anchors, settings) else laid
}

#' What is laid, or a pose of less misfit in its place
#' @noRd
better_pose <- function(laid, found, inverted, cloud) {
  if (found$misfit >= laid$misfit) return(laid)
  laid[names(found)] <- found
  laid$inverted <- inverted
  laid$cloud <- cloud
  laid
}

#' The best pose by the template's strongest anchor, else by all of them, until it is good
#' @param senses Whether the cloud is turned inside out: what is tried in turn.
#' @noRd
anchored_pose <- function(template, cloud, laid, senses, settings) {
  all <- seq_len(nrow(template$anchors))
  for (inverted in senses) {
    seen <- if (inverted) inverted_cloud(cloud) else cloud
    for (own in list(1, all)) {
      starts <- anchor_starts(template, seen, own, settings)
      laid <- better_pose(laid, best_pose(template, seen, starts, settings$reach[1], settings),
                          inverted, seen)
      if (laid$score <= settings$poor) return(laid)
    }
  }
  laid
}

#' Whether a pose is good enough to look no further: by its score, or by the template's points
#' without a like
#' @noRd
accepted_pose <- function(template, laid, settings) {
  good <- settings$good
  if (laid$score <= good[1]) return(TRUE)
  laid$score <= good[2] &&
    misfit_parts(template, laid$cloud, laid$pose, settings)[["unlike"]] <= settings$unlike
}

#' What is laid, with the bend without curvature and how the scan agrees with that
#' @noRd
agreed_pose <- function(template, laid, settings) {
  local <- cloud_in_frame(laid$cloud, laid$pose)
  laid$plain <- fit_warp(template, local, settings, 0)
  laid$agree <- agreement(template, local, laid$plain, settings)
  laid
}
