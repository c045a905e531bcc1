# What sliding needs of a template, worked out once for all specimens: energies by set of points.

#' A template and settings, made ready for many specimens
#'
#' @return List: `settings`, `scheme`, `xyz` (matrix with a row a place), `template` (its id and
#'   hash), `radius` (RMS distance of landmarks and curve points from their centre), `nugget` (of
#'   every place), `scale` (of the joint step's energy, NULL where the template has none), `kept`
#'   (environment: sets by name and by what is missing).
#' @noRd
slide_plan <- function(template, settings) {
  points <- template$scheme$points
  xyz <- places_of(template)
  core <- xyz[points$level[!duplicated(points$place)] != "surface" & !is.na(xyz[, 1]), ,
              drop = FALSE]
  radius <- sqrt(mean(rowSums(sweep(core, 2, colMeans(core))^2)))
  # Nuggets of all places as multiples of the settings': 0 of landmarks, and 1, or as the
  # template's standard errors squared
  points <- template$scheme$points
  first <- !duplicated(points$place)
  share <- stats::setNames(rep(1, sum(first)), points$place[first])
  variance <- template$points$se[first]^2
  if (settings$nugget_by == "error" && !all(is.na(variance))) {
    share <- ifelse(is.na(variance), share, variance / stats::median(variance, na.rm = TRUE))
    names(share) <- points$place[first]
  }
  nugget_shares <- replace(share, landmark_keys(template$scheme), 0)
  list(settings = settings, scheme = template$scheme, xyz = xyz, radius = radius,
       template = template_provenance(template$id, xyz),
       nugget = nugget_shares, scale = template$energy_scale,
       kept = new.env(parent = emptyenv()))
}

#' Positions of a shape's places
#' @return Matrix with a row a place (row names), columns x, y, z.
#' @noRd
places_of <- function(shape) {
  place <- shape$scheme$points$place
  first <- !duplicated(place)
  xyz <- columns_of(shape$points, c("x", "y", "z"))[first, , drop = FALSE]
  rownames(xyz) <- place[first]
  xyz
}

#' The first time `make()`, later what it gave
#'
#' @param what What the value depends on: its hash is the key, since R's names end at 10,000 bytes.
#' @noRd
kept <- function(plan, what, make) {
  key <- rlang::hash(what)
  if (is.null(plan$kept[[key]])) assign(key, make(), plan$kept)
  plan$kept[[key]]
}

#' The sets of curves that slide in one energy: one a curve, or one of all
#'
#' @param state As of [slide_state()].
#' @return List of sets: `name`, `curves`, `places` (rows of `b`), `points` (list by curve: the row
#'   of each of its points, NA where missing), `b`. A curve that has nothing to slide, or points
#'   that the template lacks, is in none.
#' @noRd
curve_sets <- function(state, plan) {
  slides <- function(curve) nrow(curve$rows) > 0 &&
    !anyNA(plan$xyz[curve$place[!is.na(curve$s)], 1])
  can <- names(Filter(slides, state$curves))
  groups <- if (plan$settings$energy == "all" && length(can)) list(curves = can) else
    stats::setNames(as.list(can), can)
  fixed <- if (plan$settings$energy != "own") landmark_keys(plan$scheme)
  Map(function(name, group) {
    wanted <- unique(c(unlist(lapply(state$curves[group], `[[`, "place"), use.names = FALSE),
                       fixed))
    absent <- is.na(state$store[wanted, "x"]) | is.na(plan$xyz[wanted, 1])
    kept(plan, list(name, group, wanted[absent]), function() {
      there <- wanted[!absent]
      list(name = name, curves = group, places = there,
           b = set_energy(there, plan, plan$settings$nugget),
           points = lapply(state$curves[group], function(curve) match(curve$place, there)))
    })
  }, names(groups), groups)
}

landmark_keys <- function(scheme) paste0("landmarks|", scheme$landmarks$landmark)

#' The energy's matrix of some places: landmarks without nugget, all others with it
#' @param nugget In radii.
#' @noRd
set_energy <- function(places, plan, nugget) {
  b <- energy_matrix(plan$xyz[places, , drop = FALSE], nugget * plan$radius * plan$nugget[places],
                     plan$settings$rank)
  attr(b, "affine") <- NULL
  b
}
