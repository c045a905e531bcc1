# A mesh from the polygons of a file.

# `vertex` n x 3, `corner` the 1-based vertex numbers of all polygons in turn, `sides` how many each
# has. A corner that is no whole number is NA, which the door refuses.
mesh_of_polygons <- function(vertex, corner, sides, colour = NULL) {
  corner <- corner[fan_corners(sides)]
  if (is.double(corner)) corner[corner != round(corner) | abs(corner) > .Machine$integer.max] <- NA
  mesh <- list(vb = rbind(t(vertex), 1), it = matrix(as.integer(corner), 3))
  if (!is.null(colour)) mesh$material <- list(color = colour)
  if (any(sides < 3)) mesh$short <- sum(sides < 3)
  structure(mesh, class = "mesh3d")
}

# Places, in the run of all corners, of the triangles of each polygon's fan about its first corner.
fan_corners <- function(sides) {
  first <- cumsum(c(0, sides))[seq_along(sides)] + 1
  fan <- pmax(sides - 2, 0)
  start <- rep(first, fan)
  step <- sequence(fan)
  as.vector(rbind(start, start + step, start + step + 1))
}
