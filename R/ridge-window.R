# The window about a reference path, with the strengths in it and their smooth surface.

#' The window about a path: co-ordinates, strengths and their smooth surface
#'
#' @param mix Share of the principal curvature in the strength.
#' @return List: `coordinates`, `strengths` (as of [window_strength()]), `scale` (their mean near
#'   the path), `surface`, `path` and `reference` (both the path), `share` (0), `found` (FALSE).
#'   Where there is no such curvature by the path it has a `reason` and no `surface`. Or a failure.
#' @noRd
ridge_window <- function(scan, path, job, mix = 0) {
  settings <- job$settings
  half <- min(job$width, settings$window * job$radius)
  coordinates <- near_path(scan, path, half, job$radius)
  strength <- window_strength(scan, coordinates, job, attr(path, "trusted"), mix)
  scale <- core_strength(coordinates, strength, settings$core * job$radius, attr(path, "trusted"))
  window <- list(coordinates = coordinates, strengths = strength, scale = scale, path = path,
                 reference = path, share = 0, found = FALSE)
  if (!is.finite(scale) || scale <= 0) {
    window$reason <- sprintf("there is no %s curvature by the reference path", job$type)
    return(window)
  }
  window$surface <- smooth_strength(coordinates, strength$value, settings)
  if (failed(window$surface)) window$surface else window
}

#' Strength at the vertices inside a window as the settings define it
#'
#' @param trusted Arc lengths of the part of the path beside which strength counts, as 0 elsewhere;
#'   NULL: all of it.
#' @param mix Share of the principal curvature where the settings take that across the path.
#' @return List with entries for the rows of `coordinates`, NA where curvature was not estimated:
#'   `value` (also NA where left out), `direction` (n x 3, across the path, or principal where that
#'   counts for more), `sigma`; `rows` (where it was estimated), `cell` (of every row, the place in
#'   `rows` of the one that stands for it, NA outside the window); and `cap`.
#' @noRd
window_strength <- function(scan, coordinates, job, trusted = NULL, mix = 0) {
  settings <- job$settings
  type <- job$type
  thinned <- thinned_rows(coordinates, settings$vertices)
  rows <- thinned$rows
  curved <- job$source(coordinates$vertex[rows])
  across <- cross_rows(curved$normal,
                       columns_of(coordinates, c("tx", "ty", "tz"))[rows, , drop = FALSE])
  across <- across / sqrt(rowSums(across^2))
  lost <- if (is.null(job$regions)) FALSE else
    is_kept_away(job$regions, t(scan$vb[1:3, coordinates$vertex[rows], drop = FALSE]))
  s <- coordinates$s[rows]
  if (!is.null(trusted)) lost <- lost | s < trusted[1] | s > trusted[2]
  capped <- function(value) {
    # No direction is across a path where it runs along the normal, or stands still.
    value[is.nan(value)] <- NA
    value[lost] <- 0
    if (settings$wrong_sign == "drop") value[value == 0] <- NA
    cap <- settings$cap * stats::quantile(value, settings$cap_quantile, na.rm = TRUE, names = FALSE)
    list(value = pmin(value, cap), cap = cap)
  }
  mix <- if (settings$strength == "principal") 1 else mix
  parts <- list(if (mix < 1) capped(strength_at(curved, type, across = across)),
                if (mix > 0) capped(strength_at(curved, type)))
  mixed <- function(name) {
    if (mix == 0) return(parts[[1]][[name]])
    if (mix == 1) return(parts[[2]][[name]])
    (1 - mix) * parts[[1]][[name]] + mix * parts[[2]][[name]]
  }
  own <- if (type == "ridge") curved$direction2 else curved$direction1
  direction <- matrix(NA_real_, nrow(coordinates), 3)
  direction[rows, ] <- if (mix > 0.5) own else across
  all_rows <- function(x) replace(rep(NA_real_, nrow(coordinates)), rows, x)
  list(value = all_rows(mixed("value")), direction = direction, sigma = all_rows(curved$sigma),
       rows = rows, cell = thinned$cell, cap = mixed("cap"))
}

#' The rows inside a window; where there are more than `most`, the one nearest to the centre of each
#' of as many square cells
#'
#' @return List: `rows`; `cell`, for every row of `coordinates` the place in `rows` of the one that
#'   stands for it, NA outside.
#' @noRd
thinned_rows <- function(coordinates, most) {
  inside <- which(coordinates$inside)
  cell <- rep(NA_integer_, nrow(coordinates))
  if (length(inside) <= most) {
    cell[inside] <- seq_along(inside)
    return(list(rows = inside, cell = cell))
  }
  length <- attr(coordinates, "length")
  width <- attr(coordinates, "width")
  columns <- ceiling(sqrt(most * length / (2 * width)))
  half <- ceiling(most / columns / 2)
  along <- coordinates$s[inside] / length * columns
  across <- coordinates$d[inside] / width * half
  own <- floor(along) * (2 * half + 2) + floor(across)
  off <- (along - floor(along) - 0.5)^2 + (across - floor(across) - 0.5)^2
  nearest <- order(own, off)
  first <- nearest[!duplicated(own[nearest])]
  cell[inside] <- match(own, own[first])
  list(rows = inside[first], cell = cell)
}

#' Mean strength near a path
#'
#' @param trusted Arc lengths of the part of the path that counts; NULL: all of it.
#' @noRd
core_strength <- function(coordinates, strength, distance, trusted = NULL) {
  near <- abs(coordinates$d[strength$rows]) <= distance
  if (!is.null(trusted)) {
    s <- coordinates$s[strength$rows]
    near <- near & s >= trusted[1] & s <= trusted[2]
  }
  value <- strength$value[strength$rows[near]]
  value[is.na(value)] <- 0
  if (length(value)) mean(value) else NA_real_
}
