# The unit of a scan that comes without one: what size makes it most like the template.

#' The template laid on a scan in the unit in which they agree most
#'
#' Units are tried that bring the scan to each of the settings' `diagonals`, on clouds without
#' curvature. The best, and a second one that scores nearly as well, are fitted with it.
#'
#' @param laid As of [settled_pose()], in the unit that was tried first.
#' @return The same, with `unit_known`: FALSE where another unit than the first agrees better.
#' @noRd
swept_pose <- function(template, scan, laid, settings, threads) {
  laid$unit_known <- TRUE
  units <- settings$diagonals / specimen_size(scan)
  units <- units[abs(log(units / laid$unit)) > log(settings$size_apart)]
  quick <- lapply(units, function(unit) {
    cloud <- scan_cloud(scan, unit, settings)
    starts <- proud_starts(template, cloud, 1, settings)
    found <- best_pose(template, cloud, starts, settings$start_reach, settings)
    c(found, list(inverted = FALSE, cloud = cloud, unit = unit, unit_known = FALSE))
  })
  score <- vapply(quick, `[[`, 0, "score")
  near <- which(score <= min(score, 1) + settings$score_apart & score < 1)
  for (i in utils::head(near[order(score[near])], 2)) {
    one <- quick[[i]]
    one$cloud <- tryCatch(with_curvature(one$cloud, settings, threads),
                          crestline_error = function(e) NULL)
    if (is.null(one$cloud)) next
    found <- rested_pose(template, one$cloud, utils::modifyList(one["pose"], list(misfit = Inf)),
                         settings)
    one[names(found)] <- found
    one <- agreed_pose(template, one, settings)
    if (one$agree > laid$agree) laid <- one
  }
  laid
}

#' What is laid, again in the unit that makes the object as large as the template, where it is much
#' larger or smaller and the agreement not sure
#'
#' Cells, balls and reaches are lengths of the template: a unit that is 1.4 times off makes them as
#' wrong.
#'
#' @param laid As of [settled_pose()], with `unit_known`.
#' @param asked The unit that was tried first.
#' @return The same; `unit_known` is FALSE where the object is larger or smaller than the template
#'   by more than the setting `unit_apart`.
#' @noRd
sized_pose <- function(template, scan, laid, asked, settings, threads) {
  coarse <- !laid$unit_known || abs(log(laid$pose[13])) > log(settings$resized)
  if (coarse && laid$agree >= settings$agree[1] && laid$agree < settings$sure) {
    again <- settled_pose(template, scan, laid$unit / laid$pose[13], settings, threads)
    if (again$agree > laid$agree) laid[names(again)] <- again
  }
  factor <- laid$unit / laid$pose[13] / asked
  laid$unit_known <- laid$unit_known && abs(log(factor)) <= log(settings$unit_apart)
  laid
}
