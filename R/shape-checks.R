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
  damage <- list(border = t(scan$vb[1:3, border_vertices(scan$it, scan$twin), drop = FALSE]),
                 spike = Reduce(`+`, face_corners(spiky)) / 3)
  checks <- data.frame(part = status$part, level = status$level, missing = missing_share(shape),
                       determined = NA,
                       cut = NA_real_, guessed = NA, bridged = NA_real_, faults = NA_integer_,
                       size = vapply(places, `[[`, 0, "size"))
  curves <- status$level == "curves"
  checks$determined[curves] <- ifelse(
    shape$scheme$curves$n > 2, fit_values(fits, "determined") > 0, NA
  )
  checks$cut[curves] <- fit_values(fits, "cut")
  checks$guessed[curves] <- fit_values(fits, "guessed") > 0
  checks$bridged[curves] <- vapply(fits, function(fit) {
    # Share of a path's length over bridges; NA without a path
    path <- fit$path
    if (is.null(path)) return(NA_real_)
    sum(diff(path$s)[path$face[-1] > ncol(mesh$it)]) / attr(path, "length")
  }, 0)
  checks$track <- NA_real_
  checks$track[curves] <- track_departures(shape$scheme, lapply(fits, `[[`, "path"), scan$landmarks)
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
      if (length(place$face)) {
        stats::weighted.mean(values[match(place$face, face)], place$weight)
      } else {
        NA_real_
      }
    }, 0)
  }
  data.frame(roughness = mean_of(bend[face]), edge = mean_of(edge))
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

# Whether the triangles of a shape's surface lie as they should.

#' Faults of a shape's surface
#'
#' Lists the triangles of a shape's surface that face into the specimen, that are double, or that
#' cross one another.
#'
#' @template shape
#' @template measured-on
#' @param parts Parts of the surface, as in [shape_mesh()].
#' @return Data frame with a row for each fault; without faults it has no row. Columns: `fault`
#'   ("flipped", "doubled" or "crossing"), `group` (patch or strip of the triangle), `v1`, `v2`,
#'   `v3` (rows of the surface points), `other` (group of the other triangle of a crossing). A
#'   triangle is flipped if its normal is more than 90 degrees from the specimen's normals at its
#'   corners.
#' @section Errors: those of [shape_mesh()]; of class `crestline_wrong_mesh`: the specimen has
#'   another mesh.
#' @template glossary
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' surface_faults(fit_shape(face, face_scheme()), face)
#' }
#' @export
surface_faults <- function(x, specimen, parts = "model") {
  check_given()
  check_class(x, "shape", "x", "fit_shape()")
  parts <- check_names(parts, "parts")
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  check_shape_on(x, specimen)
  triangles <- whole_triangles(x, parts)
  faults_among(triangles, x$points[x$points$level == "surface", ], specimen$mesh)
}

#' Faults among triangles, without checks
#'
#' @param triangles Rows of the scheme's triangles, all their corners there.
#' @param at The surface points.
#' @return As [surface_faults()].
#' @noRd
faults_among <- function(triangles, at, mesh) {
  it <- t(as.matrix(triangles[c("v1", "v2", "v3")]))
  row <- sort(unique(as.vector(it)))
  xyz <- as.matrix(at[c("x", "y", "z")])
  normals <- matrix(NA_real_, nrow(at), 3)
  normals[row, ] <- t(path_normals(mesh, at[row, ]))
  pairs <- crossing_pairs(xyz, it)
  least <- pmin(it[1, ], it[2, ], it[3, ])
  most <- pmax(it[1, ], it[2, ], it[3, ])
  sorted <- paste(least, colSums(it) - least - most, most)
  fault <- function(rows, name, other = NA_character_) {
    data.frame(fault = rep(name, length(rows)), triangles[rows, c("group", "v1", "v2", "v3")],
               other = rep(other, length.out = length(rows)))
  }
  found <- rbind(fault(flipped_triangles(xyz, it, normals), "flipped"),
                 fault(which(duplicated(sorted)), "doubled"),
                 fault(pairs[, 1], "crossing", triangles$group[pairs[, 2]]))
  rownames(found) <- NULL
  found
}

#' Pairs of triangles of which an edge of one passes through the other; those that share an edge are
#' not looked at
#'
#' @param xyz n x 3.
#' @param it 3 x m.
#' @return Matrix of two columns.
#' @noRd
crossing_pairs <- function(xyz, it) {
  corner <- lapply(1:3, function(i) xyz[it[i, ], , drop = FALSE])
  # Pairs of boxes that overlap, found along the first axis
  low <- do.call(pmin, corner)
  high <- do.call(pmax, corner)
  along <- order(low[, 1])
  reached <- findInterval(high[along, 1], low[along, 1])
  count <- reached - seq_along(along)
  first <- rep(seq_along(along), count)
  second <- first + sequence(count)
  pairs <- cbind(along[first], along[second])
  for (axis in 2:3) {
    apart <- low[pairs[, 1], axis] > high[pairs[, 2], axis] | low[pairs[, 2], axis] > high[
      pairs[, 1], axis
    ]
    pairs <- pairs[!apart, , drop = FALSE]
  }
  pairs <- cbind(pmin(pairs[, 1], pairs[, 2]), pmax(pairs[, 1], pairs[, 2]))
  shared <- Reduce(`+`, lapply(1:3, function(i) is_corner(it, it[i, pairs[, 1]], pairs[, 2])))
  pairs <- pairs[shared < 2, , drop = FALSE]
  pairs <- pairs[straddles(xyz, it, pairs[, 1], pairs[, 2]), , drop = FALSE]
  pairs <- pairs[straddles(xyz, it, pairs[, 2], pairs[, 1]), , drop = FALSE]
  pairs[pierces(xyz, it, pairs[, 1], pairs[, 2]) | pierces(xyz, it, pairs[, 2], pairs[, 1]), ,
        drop = FALSE]
}

is_corner <- function(it, vertex, triangle) {
  it[1, triangle] == vertex | it[2, triangle] == vertex | it[3, triangle] == vertex
}

#' Whether one triangle lies on both sides of the other's plane
#' @noRd
straddles <- function(xyz, it, one, other) {
  a <- xyz[it[1, other], , drop = FALSE]
  normal <- cross_rows(xyz[it[2, other], , drop = FALSE] - a, xyz[it[3, other], , drop = FALSE] - a)
  height <- lapply(1:3, function(i) row_products(normal, xyz[it[i, one], , drop = FALSE] - a))
  do.call(pmin, height) < 0 & do.call(pmax, height) > 0
}

#' Whether an edge of one triangle, of those that do not end at the other, passes through the other
#' @noRd
pierces <- function(xyz, it, one, other) {
  a <- xyz[it[1, other], , drop = FALSE]
  b <- xyz[it[2, other], , drop = FALSE]
  c <- xyz[it[3, other], , drop = FALSE]
  normal <- cross_rows(b - a, c - a)
  edge <- function(i, j) {
    p <- xyz[it[i, one], , drop = FALSE]
    q <- xyz[it[j, one], , drop = FALSE]
    above <- rowSums(normal * (p - a))
    below <- rowSums(normal * (q - a))
    meets <- !is_corner(it, it[i, one], other) & !is_corner(it, it[j, one],
                                                            other) & above * below < 0
    place <- p + (above / (above - below)) * (q - p)
    meets & !is.na(foot_in_triangles(place, a, b, c)[, 1])
  }
  edge(1, 2) | edge(2, 3) | edge(3, 1)
}
