# What the mesh is like where the parts of a shape lie: kept with the shape, so that quality() needs
# no mesh.

#' Measure the mesh about every part of a shape
#'
#' A triangle's bend is the angle between its normal and the mean of the normals at its corners: of
#' the order of spacing over radius of curvature on a good mesh, large on noise and spikes.
#'
#' @param shape A `shape` without `checks`, with its specimen.
#' @param scan As of [prepare_scan()].
#' @param fits Curves as of [fit_scheme_curves()].
#' @param faults [surface_faults()] of the shape.
#' @param ends Share of a curve's length at each end whose distance from a border does not count:
#'   landmarks may lie there.
#' @param crumpled Bend in degrees above which a triangle counts as crumpled.
#' @param spike Number of crumpled triangles that make a spike; fewer are there at lips and nostrils
#'   of good scans.
#' @return Data frame, a row for each of `status`, as [fit_shape()] says.
#' @noRd
shape_checks <- function(shape, scan, fits, faults, ends = 0.05, crumpled = 30, spike = 4) {
  status <- shape$status
  mesh <- shape$specimen$mesh
  places <- part_places(shape, fits, ncol(mesh$it), ends)
  bend <- cpp_face_bend(mesh$vb, mesh$normals, mesh$it)
  spiky <- list(vb = mesh$vb, it = mesh$it[, bend > crumpled, drop = FALSE])
  damage <- list(border = border_places(scan), spike = face_centres(spiky))
  checks <- data.frame(part = status$part, level = status$level, missing = missing_share(shape),
                       determined = NA,
                       cut = NA_real_, guessed = NA, bridged = NA_real_, faults = NA_integer_,
                       size = vapply(places, `[[`, 0, "size"))
  curves <- status$level == "curves"
  checks$determined[curves] <- ifelse(shape$scheme$curves$n > 2, fit_values(fits, "determined") > 0,
                                      NA)
  checks$cut[curves] <- fit_values(fits, "cut")
  checks$guessed[curves] <- fit_values(fits, "guessed") > 0
  checks$bridged[curves] <- vapply(fits, function(fit) bridged_share(fit$path, ncol(mesh$it)), 0)
  patches <- status$level == "surface"
  group <- shape$points$part[shape$points$level == "surface"][faults$v1]
  checks$faults[patches] <- tabulate(match(group, status$part[patches]), sum(patches))
  cbind(checks, local_mesh(places, mesh, bend),
        border = damage_distance(places, damage$border, 1, inner = TRUE),
        spike = damage_distance(places, damage$spike, spike))
}

fit_values <- function(fits, name) {
  vapply(fits, function(fit) as.numeric(fit[[name]]), 0, USE.NAMES = FALSE)
}

#' For every point the row of `status` of its part
#' @noRd
part_rows <- function(shape) {
  match(paste(shape$points$level, shape$points$part), paste(shape$status$level, shape$status$part))
}

missing_share <- function(shape) {
  row <- part_rows(shape)
  n <- nrow(shape$status)
  tabulate(row[is.na(shape$points$x)], n) / tabulate(row, n)
}

#' Share of a path's length over bridges; NA without a path
#' @noRd
bridged_share <- function(path, faces) {
  if (is.null(path)) return(NA_real_)
  sum(diff(path$s)[path$face[-1] > faces]) / attr(path, "length")
}

#' Where the mesh is looked at for every part: along the whole path of a curve, at the points of a
#' patch
#'
#' @param fits Curves as of [fit_scheme_curves()].
#' @param faces Number of faces that are not bridges.
#' @param ends As in [shape_checks()].
#' @return List by row of `status`, each a list of `xyz` (k x 3), `face`, `weight`, `inner` (whether
#'   borders count) and `size`: a curve's length; of a patch the diameter of a disc with points as
#'   far from their centroid; NA where there is neither.
#' @noRd
part_places <- function(shape, fits, faces, ends) {
  xyz <- columns_of(shape$points, c("x", "y", "z"))
  row <- part_rows(shape)
  status <- shape$status
  lapply(seq_len(nrow(status)), function(i) {
    if (status$level[i] == "curves") return(path_places(fits[[status$part[i]]]$path, faces, ends))
    at <- which(row == i & !is.na(xyz[, 1]))
    if (status$level[i] == "landmarks" || length(at) < 2) return(path_places(NULL, faces, ends))
    own <- xyz[at, , drop = FALSE]
    list(xyz = own, face = shape$points$face[at], weight = rep(1, length(at)),
         inner = rep(TRUE, length(at)),
         size = sqrt(8 * mean(rowSums(sweep(own, 2, colMeans(own))^2))))
  })
}

path_places <- function(path, faces, ends) {
  if (is.null(path)) {
    return(list(xyz = matrix(0, 0, 3), face = integer(), weight = numeric(), inner = logical(),
                size = NA_real_))
  }
  length <- attr(path, "length")
  weight <- c(0, diff(path$s))
  own <- path$face <= faces
  inner <- path$s >= ends * length & path$s <= (1 - ends) * length
  list(xyz = columns_of(path, c("x", "y", "z"))[own, , drop = FALSE], face = path$face[own],
       weight = weight[own], inner = inner[own],
       size = length)
}

#' Mean bend (degrees) and mean edge of the triangles of every part, weighted as its places
#' @noRd
local_mesh <- function(places, mesh, bend) {
  face <- unique(unlist(lapply(places, `[[`, "face")))
  corner <- face_corners(list(vb = mesh$vb, it = mesh$it[, face, drop = FALSE]))
  edge <- (row_lengths(corner[[2]] - corner[[1]]) + row_lengths(corner[[3]] - corner[[2]]) +
             row_lengths(corner[[1]] - corner[[3]])) / 3
  mean_of <- function(values) {
    vapply(places, function(place) {
      if (length(place$face)) stats::weighted.mean(values[match(place$face, face)],
                                                   place$weight) else NA_real_
    }, 0)
  }
  data.frame(roughness = mean_of(bend[face]), edge = mean_of(edge))
}

#' The vertices of the mesh's borders, and of edges that act as such: n x 3
#' @noRd
border_places <- function(surface) {
  t(surface$vb[1:3, border_vertices(surface$it, surface$twin), drop = FALSE])
}

#' Distance of every part to the `count`-th nearest of some places of damage; Inf where there are
#' fewer
#'
#' @param inner Whether only the inner places of the parts count.
#' @return Numeric, NA for parts without places.
#' @noRd
damage_distance <- function(places, damage, count, inner = FALSE) {
  xyz <- lapply(places,
                function(place) if (inner) place$xyz[place$inner, , drop = FALSE] else place$xyz)
  part <- factor(rep(seq_along(places), vapply(xyz, nrow, 0L)), seq_along(places))
  xyz <- do.call(rbind, xyz)
  distance <- rep(Inf, nrow(xyz))
  if (nrow(damage) >= count && nrow(xyz)) {
    last <- nearest_centres(damage, xyz, count)[, count]
    distance <- row_lengths(xyz - damage[last, , drop = FALSE])
  }
  as.vector(tapply(distance, part, min))
}
