# What sliding needs of a template, worked out once for all specimens: energies by set of points.

#' A template and settings, made ready for many specimens
#'
#' @return List: `settings`, `scheme`, `xyz` (matrix with a row a place), `radius` (RMS distance of landmarks and curve points from
#'   their centre), `kept` (environment: sets by name and by what is missing).
#' @noRd
slide_plan <- function(template, settings) {
  points <- template$scheme$points
  first <- !duplicated(points$place)
  xyz <- as.matrix(template$points[first, c("x", "y", "z")])
  rownames(xyz) <- points$place[first]
  core <- xyz[points$level[first] != "surface" & !is.na(xyz[, 1]), , drop = FALSE]
  radius <- sqrt(mean(rowSums(sweep(core, 2, colMeans(core))^2)))
  list(settings = settings, scheme = template$scheme, xyz = xyz, radius = radius, kept = new.env(parent = emptyenv()))
}

#' The first time `make()`, later what it gave
#' @noRd
kept <- function(plan, key, make) {
  if (is.null(plan$kept[[key]])) assign(key, make(), plan$kept)
  plan$kept[[key]]
}

#' The sets of curves that slide in one energy: one a curve, or one of all
#'
#' @param state As of [slide_state()].
#' @return List of sets: `name`, `curves`, `places` (rows of `b`), `b`, `rows` (matrix for the kernel, without `s` and
#'   `rest`). A curve without inner points, or missing from the template, is in none.
#' @noRd
curve_sets <- function(state, plan) {
  slides <- function(curve) curve$n > 2 && !anyNA(plan$xyz[curve$place, 1])
  can <- names(Filter(slides, state$curves))
  groups <- if (plan$settings$energy == "all" && length(can)) list(curves = can) else stats::setNames(as.list(can), can)
  fixed <- if (plan$settings$energy != "own") landmark_places(plan$scheme)
  absent <- is.na(state$store[fixed, "x"]) | is.na(plan$xyz[fixed, 1])
  Map(function(name, group) {
    key <- paste(c(name, group, fixed[absent]), collapse = "|")
    kept(plan, key, function() new_curve_set(name, state$curves[group], fixed[!absent], plan))
  }, names(groups), groups)
}

landmark_places <- function(scheme) paste0("landmarks|", scheme$landmarks$landmark)

new_curve_set <- function(name, curves, fixed, plan) {
  places <- unique(c(unlist(lapply(curves, `[[`, "place"), use.names = FALSE), fixed))
  rows <- lapply(seq_along(curves), function(i) {
    place <- curves[[i]]$place[-c(1, curves[[i]]$n)]
    cbind(point = match(place, places), path = i, s = NA, link_rows(length(place)), rest = NA)
  })
  list(name = name, curves = names(curves), places = places, b = set_energy(places, plan, plan$settings$nugget),
       rows = stack_rows(rows))
}

#' Neighbours in a row of n sliders, 0 where there is none
#' @noRd
link_rows <- function(n) cbind(before = seq_len(n) - 1, after = c(seq_len(n)[-1], 0))

#' Sliders of several paths, their neighbours counted through
#' @noRd
stack_rows <- function(rows) {
  offset <- cumsum(c(0, vapply(rows, nrow, 0L)))
  do.call(rbind, Map(function(rows, offset) {
    for (side in c("before", "after")) rows[, side] <- ifelse(rows[, side] == 0, 0, rows[, side] + offset)
    rows
  }, rows, offset[seq_along(rows)]))
}

#' The energy's matrix of some places: landmarks without nugget, all others with it
#' @param nugget In radii.
#' @noRd
set_energy <- function(places, plan, nugget) {
  nuggets <- ifelse(places %in% landmark_places(plan$scheme), 0, nugget * plan$radius)
  b <- energy_matrix(plan$xyz[places, , drop = FALSE], nuggets, plan$settings$rank)
  attr(b, "affine") <- NULL
  b
}
