# Whether the triangles of a shape's surface lie as they should.

#' Faults of a shape's surface
#'
#' Lists the triangles that face into the specimen, that are there twice, or that pass through one
#' another.
#'
#' @param x A `shape`, as [fit_shape()] returns it.
#' @param specimen The `specimen` it was measured on.
#' @param parts Parts of the surface, as in [shape_mesh()].
#' @return Data frame, a row a fault (none: no fault): `fault` ("flipped": the triangle's normal is
#'   more than 90 degrees from the specimen's normals at its corners; "doubled"; "crossing"),
#'   `group` (the patch or strip of the triangle, as in the scheme's `triangles`), `v1`, `v2`, `v3`
#'   (rows of the surface points), and for crossings `other` (group of the triangle that it passes
#'   through).
#' @section Errors: as [shape_mesh()]; of class `crestline_wrong_mesh`, for a specimen with another
#'   mesh.
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
  row <- attr(shape_mesh(x, parts), "row")
  at <- x$points[x$points$level == "surface", ]
  triangles <- x$scheme$triangles[x$scheme$triangles$part %in% parts, ]
  it <- t(as.matrix(triangles[c("v1", "v2", "v3")]))
  whole <- colSums(matrix(it %in% row, 3)) == 3
  triangles <- triangles[whole, ]
  it <- it[, whole, drop = FALSE]
  xyz <- as.matrix(at[c("x", "y", "z")])
  normals <- matrix(NA_real_, nrow(at), 3)
  normals[row, ] <- t(path_normals(specimen$mesh, at[row, ]))
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

flipped_triangles <- function(xyz, it, normals) {
  corner <- function(x, i) x[it[i, ], , drop = FALSE]
  own <- cross_rows(corner(xyz, 2) - corner(xyz, 1), corner(xyz, 3) - corner(xyz, 1))
  which(rowSums(own * (corner(normals, 1) + corner(normals, 2) + corner(normals, 3))) < 0)
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
  pairs <- overlapping_boxes(do.call(pmin, corner), do.call(pmax, corner))
  shared <- Reduce(`+`, lapply(1:3, function(i) is_corner(it, it[i, pairs[, 1]], pairs[, 2])))
  pairs <- pairs[shared < 2, , drop = FALSE]
  pairs <- pairs[straddles(xyz, it, pairs[, 1], pairs[, 2]) &
                 straddles(xyz, it, pairs[, 2], pairs[, 1]), , drop = FALSE]
  pairs[pierces(xyz, it, pairs[, 1], pairs[, 2]) | pierces(xyz, it, pairs[, 2], pairs[, 1]), ,
        drop = FALSE]
}

#' Pairs of boxes that overlap, found along the first axis
#'
#' @param low,high n x 3.
#' @return Matrix of two columns, the smaller index first.
#' @noRd
overlapping_boxes <- function(low, high) {
  along <- order(low[, 1])
  reached <- findInterval(high[along, 1], low[along, 1])
  count <- reached - seq_along(along)
  first <- rep(seq_along(along), count)
  second <- first + sequence(count)
  pairs <- cbind(along[first], along[second])
  for (axis in 2:3) {
    apart <- low[pairs[, 1], axis] > high[pairs[, 2],
                                          axis] | low[pairs[, 2], axis] > high[pairs[, 1], axis]
    pairs <- pairs[!apart, , drop = FALSE]
  }
  cbind(pmin(pairs[, 1], pairs[, 2]), pmax(pairs[, 1], pairs[, 2]))
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
