# The curves of a scheme while landmarks move: fitted anew are those that a move touches.

#' Begin to fit the curves of a scheme again and again
#'
#' @param specimen,scheme,settings,bridge,threads As in [fit_shape()].
#' @return List: `scheme`, `bridged` (the specimen with its holes bridged), `scan` of
#'   [prepare_scan()] (its sources of curvature keep what they have estimated), `whole` and `fits`
#'   (by curve, before and after they are cut off; as yet none).
#' @noRd
begin_fitting <- function(specimen, scheme, settings, bridge, threads) {
  none <- stats::setNames(vector("list", nrow(scheme$curves)), scheme$curves$curve)
  column <- list(bridge = bridge)
  list(scheme = scheme, bridged = bridge_holes(specimen, bridge),
       scan = prepare_scan(specimen, scheme, settings, 1, column, threads), whole = none,
       fits = none)
}

#' Fit those curves anew that a moved landmark touches
#'
#' @param fitting As of [begin_fitting()].
#' @param specimen The specimen with its landmarks as they are now.
#' @param moved Names of the landmarks that have moved, NULL for all curves.
#' @param progress Function of the number of curves to be fitted, which gives a function that is
#'   called after each.
#' @return `fitting`, with `fits` as [fit_shape()] has them for this specimen, and `refitted`, the
#'   names of the curves that were fitted anew.
#' @noRd
refit_curves <- function(fitting, specimen, moved = NULL, progress = function(n) function() NULL) {
  scheme <- fitting$scheme
  fitting$bridged <- with_landmarks_of(fitting$bridged, specimen)
  touched <- touched_curves(scheme$curves, moved, fitting$whole)
  placed <- scan_landmarks(specimen, fitting$bridged, scheme)
  fitting$scan[names(placed)] <- placed
  fitting$whole <- fit_whole_curves(fitting$whole, touched, fitting$scan, scheme,
                                    progress(sum(touched)))
  every <- rep(TRUE, nrow(scheme$curves))
  fitting$fits <- finished_curves(fitting$whole, every, fitting$scan, scheme, 1)
  fitting$refitted <- scheme$curves$curve[touched]
  fitting
}

with_landmarks_of <- function(bridged, specimen) {
  bridged$landmarks <- specimen$landmarks
  bridged$geometry[c("landmarks", "located")] <- specimen$geometry[c("landmarks", "located")]
  bridged
}

#' Which curves depend on landmarks that have moved
#'
#' By their ends, their regions and sides, and by the curve whose side they keep to. One that is
#' followed towards a landmark that is not on the mesh depends on all of them: the mirror plane says
#' where that is.
#' @param whole Fits as they are, before they are cut off.
#' @return Logical, by row of `curves`.
#' @noRd
touched_curves <- function(curves, moved, whole) {
  if (is.null(moved)) return(rep(TRUE, nrow(curves)))
  by_name <- c("from", "to", "keep_away_from", "keep_away_to", "keep_side_from", "keep_side_to",
               "keep_side_towards")
  named <- Reduce(`|`, lapply(curves[by_name], `%in%`, moved))
  unsettled <- vapply(whole, function(fit) is.null(fit$path) || !is.na(fit$followed), NA)
  touched <- named | unsettled & !is.na(curves$cut_share)
  for (i in fitting_order(curves)) {
    if (curves$side_of[i] %in% curves$curve[touched]) touched[i] <- TRUE
  }
  touched
}
