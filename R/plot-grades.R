# A shape coloured by how its parts are graded.

#' Draw a shape with the colours of its grades, from several sides, beside each other on the current
#' device
#'
#' Curves are lines, points of patches dots; without the specimen the shape's own surface. Curves
#' that are not green have their names beside them.
#'
#' @param shape A `shape`.
#' @param graded Its rows of [quality()].
#' @param specimen Its `specimen`, or `NULL`.
#' @param round How far the viewer goes round to the object's left, in radians, for each picture.
#' @param width Line width of green curves; the others are half as wide again.
#' @param colour Colour of the surface.
#' @noRd
draw_grades <- function(shape, graded, specimen, round = c(-0.9, 0, 0.9), width = 1.6,
                        colour = "#DDD6CD", size = 0.35) {
  view <- shape_view(shape)
  mesh <- if (is.null(specimen)) own_surface(shape) else specimen$mesh
  known <- shape$points[!is.na(shape$points$x), ]
  old <- graphics::par(mfrow = c(1, length(round)), mar = rep(0.2, 4))
  on.exit(graphics::par(old))
  for (turn in round) {
    scene <- draw_surface(mesh, colour, turned_view(view, turn), "picture", around = known,
                          gloss = 0, margin = 0.04)
    points <- known[known$level == "surface", ]
    grade <- grade_of(graded, points$level, points$part)
    for (name in names(grade_colours)) {
      own <- points[grade == name, ]
      if (nrow(own)) draw_points(scene, own, grade_colours[[name]], size)
    }
    draw_graded_curves(scene, shape, graded, width)
  }
}

#' The shape's own surface, `NULL` where no triangle has all its points
#' @noRd
own_surface <- function(shape) tryCatch(shape_mesh(shape), crestline_error = function(e) NULL)

grade_of <- function(graded, level, part) {
  as.character(graded$grade[match(paste(level, part), paste(graded$level, graded$part))])
}

#' The worst curves on top, with their names below their middles
#'
#' @param most No names where more curves than this are not green: they would hide the picture.
#' @param seen Share of a curve that is to be seen for its name to be there.
#' @noRd
draw_graded_curves <- function(scene, shape, graded, width, most = 12, seen = 0.6, size = 0.8) {
  paths <- Filter(Negate(is.null), shape$paths)
  grade <- grade_of(graded, "curves", names(paths))
  for (name in names(grade_colours)) {
    for (path in paths[grade == name]) {
      draw_lines(scene, path, grade_colours[[name]], width * if (name == "green") 1 else 1.5,
                 halo = "white")
    }
  }
  doubtful <- names(paths)[grade != "green"]
  for (name in if (length(doubtful) <= most) doubtful) {
    if (mean(visible_points(scene, paths[[name]])) < seen) next
    middle <- matrix(points_along(paths[[name]], attr(paths[[name]], "length") / 2), 1)
    # Its name stands below the middle, within the picture.
    at <- drop(view_points(scene, middle))
    on_scene(scene, {
      half <- c(1.05 * graphics::strwidth(name, cex = size, font = 2),
                1.6 * graphics::strheight(name, cex = size)) / 2
      at[2] <- at[2] - 2 * graphics::strheight(name, cex = size)
      at[1:2] <- pmax(pmin(at[1:2], scene$usr[c(2, 4)] - half), scene$usr[c(1, 3)] + half)
      graphics::rect(at[1] - half[1], at[2] - half[2], at[1] + half[1], at[2] + half[2],
                     col = "#FFFFFFC8", border = NA)
      graphics::text(at[1], at[2], name, cex = size,
                     col = grade_colours[[grade_of(graded, "curves", name)]], font = 2)
    })
  }
}

#' The rotation that shows a shape from its front: the mean of its surface's normals to the viewer
#'
#' Upright and level by the left-right pairs of its landmarks (left on the viewer's right); without
#' pairs the longest direction across is up, towards positive y.
#' @noRd
shape_view <- function(shape) {
  points <- as.matrix(shape$points[!is.na(shape$points$x), c("x", "y", "z")])
  # Mean normal of the shape's surface; without one, the normal of the plane through its points, to
  # positive z
  mesh <- own_surface(shape)
  out <- if (!is.null(mesh)) colSums(face_normals(mesh)) else c(0, 0, 0)
  out <- if (any(out != 0)) unit_vector(out) else {
    out <- svd(sweep(points, 2, colMeans(points)), nu = 0, nv = 3)$v[, 3]
    if (out[3] < 0) -out else out
  }
  landmarks <- coords(shape, "landmarks")
  pairs <- shape$scheme$pairs[shape$scheme$pairs$level == "landmarks", ]
  across <- colMeans(landmarks[pairs$left, , drop = FALSE] - landmarks[pairs$right, , drop = FALSE],
                     na.rm = TRUE)
  if (all(is.finite(across)) && any(across != 0)) {
    across <- unit_vector(across)
    up <- unit_vector(cross_product(out, across))
    return(unname(rbind(across, up, cross_product(across, up))))
  }
  flat <- points - tcrossprod(points %*% out, out)
  up <- svd(sweep(flat, 2, colMeans(flat)), nu = 0, nv = 1)$v[, 1]
  if (up[2] < 0) up <- -up
  unname(rbind(cross_product(up, out), up, out))
}

turned_view <- function(view, round) {
  rbind(cos(round) * view[1, ] - sin(round) * view[3, ], view[2, ],
        sin(round) * view[1, ] + cos(round) * view[3, ])
}
