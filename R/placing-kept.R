# Landmarks that a specimen brings along: kept as they are, and used to find the others.

#' The landmarks of a specimen that no machine has found
#' @return k x 3, complete rows only.
#' @noRd
kept_landmarks <- function(scan) {
  origin <- origin_of(scan)
  by_machine <- origin$landmark[origin$how %in% c("found", "predicted")]
  at <- scan$landmarks[!rownames(scan$landmarks) %in% by_machine, , drop = FALSE]
  at[stats::complete.cases(at), , drop = FALSE]
}

#' A start by the landmarks that are kept: the similarity that takes the template's to them
#'
#' @param kept k x 3, in the template's unit.
#' @param flat Least second singular value of their places, as a share of the first: below it they
#'   are on a line, and the rotation about it is not determined.
#' @return 13 x 1, or 13 x 0 where there are fewer than three, or their scale is beyond the setting
#'   `loose`.
#' @noRd
kept_start <- function(template, kept, settings, flat = 0.1) {
  own <- rbind(template$landmarks, template$predicted)
  names <- intersect(rownames(own), rownames(kept))
  none <- matrix(0, 13, 0)
  if (length(names) < 3) return(none)
  to <- kept[names, , drop = FALSE]
  spread <- svd(sweep(to, 2, colMeans(to)), 0, 0)$d
  by <- similarity(own[names, , drop = FALSE], to)
  within <- by$scale >= settings$loose[1] && by$scale <= settings$loose[2]
  if (spread[2] < flat * spread[1] || !within) return(none)
  cbind(c(by$rotation, by$shift, by$scale))
}

#' Kept landmarks as the bend of the template takes them
#'
#' @param prepared As of [prepared_template()].
#' @param kept k x 3, on the scan.
#' @return List: `row` (of the basis), `by` (k x 3, how far the template's are to be moved),
#'   `weight` (1 / length squared); NULL where there is none of the template's.
#' @noRd
warp_pins <- function(prepared, kept, laid) {
  names <- intersect(rownames(prepared$landmarks), rownames(kept))
  if (!length(names)) return(NULL)
  at <- into_frame(kept[names, , drop = FALSE], laid)
  list(row = ncol(prepared$xyz) + match(names, rownames(prepared$landmarks)),
       by = at - prepared$landmarks[names, , drop = FALSE],
       weight = prepared$settings$placed / prepared$settings$error^2)
}

#' Distances of kept landmarks from where the surface alone puts them
#'
#' @param found As of [carried_landmarks()].
#' @param length Factor from the scan's lengths to the template's.
#' @return List: `off` (by name, in the scan's unit; NA where the template has none of that name),
#'   `contrary` (names of those beyond the setting of that name).
#' @noRd
kept_offsets <- function(kept, found, settings, length) {
  row <- match(rownames(kept), found$landmark)
  off <- row_lengths(kept - as.matrix(found[row, c("x", "y", "z")]))
  names(off) <- rownames(kept)
  limit <- settings$contrary[1 + (found$state[row] %in% "predicted")]
  list(off = off, contrary = names(off)[which(off * length > limit)])
}

#' The table of placing with the kept landmarks in it
#'
#' @param found As of [carried_landmarks()].
#' @param alone As of [kept_offsets()].
#' @noRd
with_kept <- function(found, kept, alone, settings, length) {
  for (name in rownames(kept)) {
    found <- moved_placing(found, name, kept[name, ])
    row <- match(name, found$landmark)
    found$residual[row] <- alone$off[[name]]
    if (name %in% alone$contrary) {
      found$confidence[row] <- 1 / (1 + (alone$off[[name]] * length / settings$off)^2)
    }
  }
  found
}

#' Warn of kept landmarks that contradict what was found
#' @noRd
warn_contrary <- function(found) {
  placing <- found$placing
  these <- which(placing$state == "placed" & !is.na(placing$confidence))
  if (!length(these)) return(invisible())
  named <- sprintf("%s (%.3g off)", placing$landmark[these], placing$residual[these])
  crestline_warn(
    sprintf("landmarks that it has contradict the %s that was found: %s.", found$match$template,
            shorten(named)),
    paste("They are kept, and the others were found without them. Are they on the right side, and",
          "rightly named? Look at plot(specimen, what = \"placing\")."),
    stage = "landmarks", id = found$id, class = "crestline_contrary_landmarks"
  )
}
