# Points moved along the surface to the nearest ridge, valley, cap or cup.

#' Snap points to a ridge, valley, cap or cup
#'
#' Moves each point along the surface to the nearest ridge or valley, or to the nearest cap or cup,
#' within `reach`. A landmark beside its crest makes a hook at the end of a curve. Snapped to the
#' crest it does not.
#'
#' The place on a ridge is found by local fits of the strength (half width: half a radius). It is a
#' place where the strength has its maximum across the ridge, and of these the nearest to the point.
#' Only the part of the surface that is joined to the point within `reach` counts, so that points on
#' a thin wall stay on their side.
#'
#' @param mesh A [specimen()], or a `mesh3d` with outward normals.
#' @param points Names of landmarks of the specimen, or positions in the unit of the mesh: n x 3
#'   matrix, or data frame with columns `x`, `y`, `z`. Positions are first put on the surface. NULL:
#'   all landmarks of the specimen.
#' @param to "ridge", "valley", "cap", "cup", or "surface": the closest place of the surface.
#' @param radius Radius of the curvature, in the unit of the mesh; not needed for "surface".
#' @param reach Greatest distance along the surface, in the unit of the mesh; not needed for
#'   "surface".
#' @param faint As in [suggest_landmarks()].
#' @inheritParams curvature
#' @return Data frame with a row for each point, named as the points are. Lengths are in the unit of
#'   the mesh:
#'   * `to`; `found` (logical);
#'   * `distance`: length of the straight cut along the surface from the point to its new place (for
#'     "surface": straight distance). NA if none was found;
#'   * `strength`: curvature of the sought kind there, 1 / unit; NA for "surface";
#'   * `x`, `y`, `z`, `face`, `w1`, `w2`, `w3`: the new place, on the mesh; the point itself, put on
#'     the surface, if none was found;
#'   * `reason`: why none was found; NA if one was.
#'
#'   The specimen is not changed. Take the places over by `specimen$landmarks[rownames(found), ] <-
#'   as.matrix(found[c("x", "y", "z")])`.
#' @section Warnings: of class `crestline_unsnapped`: points that found none, by name. Of class
#'   `crestline_wide_radius`: `radius` or `reach` is most likely in another unit, see [curvature()].
#' @section Errors: of class `crestline_error`: there is no landmark of a name, or an argument is
#'   wrong.
#' @template glossary
#' @seealso [suggest_landmarks()], [refine_landmarks()]
#' @examples
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' snap(face, c("chL", "chR"), "valley", radius = 5, reach = 5)
#' @export
snap <- function(mesh, points = NULL, to = c("ridge", "valley", "cap", "cup", "surface"), radius,
                 reach, faint = 0.05, threads = getOption("crestline.threads", 1L)) {
  free <- identical(to, "surface")
  check_given(if (free) c("radius", "reach"))
  check_surface(mesh, "mesh")
  to <- check_choice(to, c("ridge", "valley", "cap", "cup", "surface"), "to")
  faint <- check_number(faint, "faint", 0)
  threads <- check_threads(threads)
  at <- points_to_snap(mesh, points)
  scan <- walkable(mesh)
  place <- surface_points(scan, at)
  if (to == "surface") {
    off <- row_lengths(as.matrix(place[c("x", "y", "z")]) - at)
    return(snapped_table(at, to, place, off, rep(NA_real_, nrow(at)), is.na(off)))
  }
  radius <- check_number(radius, "radius", 0, open = TRUE)
  reach <- check_number(reach, "reach", 0, open = TRUE)
  source <- known_curvature(NULL, mesh, radius, threads, "adaptive cubic")
  warn_wide_radius(radius, mesh)
  warn_wide_radius(reach, mesh, "reach")
  found <- lapply(seq_len(nrow(at)), function(i) {
    if (!is.na(place$face[i])) snapped_place(scan, place[i, ], to, radius, reach, faint, source)
  })
  none <- vapply(found, is.null, NA)
  place[!none, ] <- do.call(rbind, lapply(found[!none], `[[`, "place"))
  value <- function(name) vapply(found, function(x) if (is.null(x)) NA_real_ else x[[name]], 0)
  table <- snapped_table(at, to, place, value("distance"), value("strength"), none)
  none <- rownames(table)[!table$found & !is.na(table$x)]
  if (length(none)) {
    crestline_warn(sprintf("no %s within %.3g of %s.", to, reach, shorten(none)),
                   "They are where they were. Look at them, or give a larger `reach`.",
                   stage = "snap", id = scan$id, class = "crestline_unsnapped")
  }
  table
}

#' Positions with names, from names of landmarks or positions
#' @noRd
points_to_snap <- function(mesh, points) {
  known <- if (inherits(mesh, "specimen")) mesh$landmarks
  if (is.null(points)) points <- rownames(known)
  if (is.character(points) && length(points)) {
    wrong <- setdiff(points, rownames(known))
    if (length(wrong)) {
      refuse_landmarks(sprintf("`points`: there is no landmark %s.", describe_value(wrong)),
                       near_names(wrong[1], rownames(known)), mesh_of(mesh)$id)
    }
    return(known[points, , drop = FALSE])
  }
  at <- point_matrix(points, "points")
  storage.mode(at) <- "double"
  if (any(is.infinite(at))) refuse_argument("points", points, "Mark what is missing as NA.")
  if (is.null(rownames(at))) rownames(at) <- paste("point", seq_len(nrow(at)), recycle0 = TRUE)
  at
}

snapped_table <- function(at, to, place, distance, strength, none) {
  gone <- is.na(at[, 1] + at[, 2] + at[, 3])
  reason <- rep(NA_character_, nrow(at))
  reason[none] <- sprintf("there is no %s within reach", to)
  reason[gone] <- "the point is missing (NA)"
  table <- data.frame(to = rep(to, nrow(at)), found = !none & !gone, distance = distance,
                      strength = strength, unclass(place)[mesh_columns], reason = reason)
  rownames(table) <- make.unique(rownames(at))
  table
}

#' The nearest place of the sought kind; NULL where there is none within reach
#'
#' @param place One row of [surface_points()].
#' @param source Curvature as of [known_curvature()].
#' @param width Half width of the local fits, in radii: half of it sees one ridge, and the wider one
#'   of caps and cups is that of [refine_landmarks()].
#' @return List: `place` (row of points on the mesh), `distance`, `strength`.
#' @noRd
snapped_place <- function(scan, place, to, radius, reach, faint, source,
                          width = c(ridge = 0.5, valley = 0.5, cap = 0.75, cup = 0.75)) {
  near <- joined_part(scan, place, reach + radius)
  if (is.null(near)) return(NULL)
  curved <- source(near$vertex)
  value <- switch(to, cap = -curved$k1, cup = curved$k2, strength_at(curved, to))
  own <- which(!is.na(value))
  field <- list(at = near$at[own, , drop = FALSE], value = value[own],
                normal = curved$normal[own, , drop = FALSE], dimensions = 2)
  start <- unlist(place[c("x", "y", "z")])
  tried <- which(field$value > faint / radius & near$distance[own] <= reach + radius / 2)
  across <- switch(to, ridge = curved$direction2[own, , drop = FALSE],
                   valley = curved$direction1[own, , drop = FALSE])
  tried <- crest_vertices(field, tried, across, radius / 2)
  best <- NULL
  for (row in tried[order(near$distance[own][tried])]) {
    # The vertices come by their distance: once past the best place, none is nearer.
    if (!is.null(best) && near$distance[own][row] > best$distance + radius / 2) break
    at <- if (is.null(across)) settled_peak(field, field$at[row, ], width[[to]] * radius) else
      nearest_on_crest(field, field$at[row, ], start, width[[to]] * radius)
    if (is.null(at) || at$value <= faint / radius) next
    # The closest place of a part of a mesh, with its face in the mesh
    found <- surface_points(list(vb = rbind(t(near$at), 1), it = near$it), matrix(at$at, 1))
    found$face <- near$face[found$face]
    on <- found
    distance <- way_along(scan, place, on)
    if (distance <= reach && (is.null(best) || distance < best$distance)) {
      best <- list(place = on, distance = distance, strength = at$value)
    }
  }
  best
}

#' The part of a mesh that is joined to a place within a distance along the surface
#'
#' @return List: `vertex` (numbers in the mesh), `at` (n x 3), `distance` (along the surface), `it`
#'   and `face` (triangles, by numbers in `vertex` and in the mesh); NULL where there is none.
#' @noRd
joined_part <- function(scan, place, within) {
  at <- t(scan$vb[1:3, , drop = FALSE])
  # Along the surface is never shorter than straight: only this part is walked.
  ball <- row_lengths(sweep(at, 2, unlist(place[c("x", "y", "z")]))) <= within
  ball[scan$it[, place$face]] <- TRUE
  face <- which(ball[scan$it[1, ]] & ball[scan$it[2, ]] & ball[scan$it[3, ]])
  vertex <- which(ball)
  small <- list(vb = scan$vb[, vertex, drop = FALSE],
                it = matrix(match(scan$it[, face], vertex), 3))
  own <- place
  own$face <- match(place$face, face)
  distance <- as.vector(geodesic_distances(small, own))
  if (!any(distance <= within)) return(NULL)
  joined <- is.finite(distance)
  kept <- joined[small$it[1, ]] & joined[small$it[2, ]] & joined[small$it[3, ]]
  number <- cumsum(joined)
  list(vertex = vertex[joined], at = at[vertex[joined], , drop = FALSE],
       distance = distance[joined], it = matrix(number[small$it[, kept]], 3), face = face[kept])
}

#' Vertices that none exceeds: across the ridge within a distance, or all round
#'
#' @param across Directions across the ridge, n x 3; NULL: all round.
#' @param cone Least cosine of a direction that counts as across.
#' @noRd
crest_vertices <- function(field, tried, across, within, cone = 0.7) {
  is_top <- function(row) {
    step <- sweep(field$at, 2, field$at[row, ])
    length <- row_lengths(step)
    near <- length <= within
    if (!is.null(across)) near <- near & abs(drop(step %*% across[row, ])) >= cone * length
    all(field$value[near] <= field$value[row])
  }
  tried[vapply(tried, is_top, NA)]
}

#' The place on a crest that is nearest to a point: the fits' maximum across it, and along it the
#' foot of the point
#'
#' @param longest,tolerance,steps As in [settled_place()].
#' @return List `at`, `value`; NULL where the fits have no crest, or the steps do not settle.
#' @noRd
nearest_on_crest <- function(field, at, point, width, longest = 0.5, tolerance = 1e-4,
                             steps = 60) {
  settled_place(field, at, width, function(fit, at, longest) {
    bend <- eigen(fit$hessian, symmetric = TRUE)
    if (bend$values[2] >= 0) return(NULL)
    # Across: Newton's step to the maximum. Along: towards the point.
    across <- bend$vectors[, 2]
    along <- bend$vectors[, 1]
    towards <- drop(crossprod(fit$frame[, 1:2], point - at))
    -across * sum(fit$gradient * across) / bend$values[2] + along * sum(towards * along)
  }, longest, tolerance, steps)
}

#' Length of the straight cut from one place to another; of the straight line where there is none
#' @noRd
way_along <- function(scan, from, to) {
  ends <- path_ends(scan, rbind(unlist(from[mesh_columns]), unlist(to[mesh_columns])),
                    c("point", "place"))
  path <- if (!failed(ends)) cut_path(ends, 0, 0, 1)
  if (is.null(path) || failed(path)) {
    sqrt(sum((unlist(from[c("x", "y", "z")]) - unlist(to[c("x", "y", "z")]))^2))
  } else {
    attr(path, "length")
  }
}
