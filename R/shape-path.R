# What the curves and patches of a shape do with paths: shortest cuts near the surface's normal, parts of paths, joins.

#' Best plane cut among angles about the surface's normal
#'
#' @param surface As of [walkable()].
#' @param ends As of [path_ends()].
#' @param limit Greatest angle in radians between the plane and that of the mean of the normals at the ends.
#' @param angles Number of angles.
#' @param reach Cuts stay within this share of the ends' distance from the straight line between them.
#' @param strength At the vertices: the cut with the greatest mean strength; the shortest where empty.
#' @param longest Cuts may be this many times as long as the shortest, where there is strength.
#' @return `mesh_path`; error of class `crestline_path_error` where no cut joins the ends.
#' @noRd
limited_cut <- function(surface, ends, limit, angles, reach, strength = numeric(), longest = Inf) {
  axis <- cut_axis(surface, ends)
  angle <- seq(-limit, limit, length.out = angles)
  normals <- plane_normal(axis, angle)
  found <- cpp_plane_cuts(surface$xyz, surface$it, surface$twin, ends$from, ends$to, normals, rep(0L, angles),
                          reach * axis$span, strength)
  if (all(is.na(found$length))) abort_cut(found$end[ceiling(angles / 2)], ends, surface$id)
  best <- if (length(strength)) {
    which.max(ifelse(found$length <= longest * min(found$length, na.rm = TRUE), found$strength, NA))
  } else {
    which.min(found$length)
  }
  cut <- cpp_plane_path(surface$xyz, surface$it, surface$twin, ends$from, ends$to, normals[, best], 0,
                        reach * axis$span)
  new_path(cut$points, ends, angle = angle[best], side = 0)
}

mesh_columns <- c("x", "y", "z", "face", "w1", "w2", "w3")

#' The part of a path between two arc lengths; run backwards where the first is the greater
#' @noRd
part_of_path <- function(mesh, path, from, to) {
  range <- pmin(pmax(sort(c(from, to)), 0), attr(path, "length"))
  between <- as.data.frame(path)[path$s > range[1] & path$s < range[2], mesh_columns]
  ends <- place_along(mesh, path, range)[mesh_columns]
  part <- path_through(rbind(ends[1, ], between, ends[2, ]))
  if (from > to) reversed_path(mesh, part) else part
}

#' A path run backwards: the face of a point is that of the segment that ends there
#' @noRd
reversed_path <- function(mesh, path) {
  n <- nrow(path)
  back <- as.data.frame(path)[n:1, mesh_columns]
  back$face[-1] <- path$face[n:2]
  back[2:n, c("w1", "w2", "w3")] <- weights_in_faces(mesh, back$face[-1], as.matrix(back[-1, c("x", "y", "z")]))
  path_through(back)
}

#' A path through points that follow one another on the mesh
#' @noRd
path_through <- function(points) {
  step <- sqrt(rowSums(diff(as.matrix(points[c("x", "y", "z")]))^2))
  points <- cbind(s = c(0, cumsum(step)), points)
  points <- points[c(TRUE, step[-length(step)] > 0, TRUE)[seq_len(nrow(points))], ]
  rownames(points) <- NULL
  structure(points, length = sum(step), class = c("mesh_path", "data.frame"))
}
