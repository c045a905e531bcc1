# The scale of the shape index (the paper's Fig. 1).

#' Plot the scale of the shape index
#'
#' Draws nine small surfaces, one for each of Koenderink and van Doorn's categories, above the
#' continuous scale of colours with their names. It is the upper part of Fig. 1 of the paper. The
#' surfaces have equal curvedness and are seen from outside.
#'
#' @param curvedness Curvedness of the small surfaces times half their side (no unit).
#' @param spacing Distance between the surfaces' centres, in halves of their side.
#' @param turn,tilt How far they are turned about their normal, and the normal tilted to the viewer,
#'   in radians.
#' @param palette As in [shape_colours()].
#' @param ... Passed to [picture_settings()].
#' @return The scale, invisibly: a data frame with nine rows and columns `category`, `index`,
#'   `colour`.
#' @inherit shape_index references
#' @template glossary
#' @templateVar where Fig. 1
#' @template paper
#' @examples
#' plot_shape_scale()
#' @export
plot_shape_scale <- function(curvedness = 0.45, spacing = 3, turn = 0.35, tilt = 0.85,
                             palette = NULL, ...) {
  curvedness <- check_number(curvedness, "curvedness", 0, open = TRUE)
  spacing <- check_number(spacing, "spacing", 0, open = TRUE)
  turn <- check_number(turn, "turn")
  tilt <- check_number(tilt, "tilt")
  scale <- shape_scale(check_shape_palette(palette))
  spin <- rbind(c(cos(turn), -sin(turn), 0), c(sin(turn), cos(turn), 0), c(0, 0, 1))
  rotation <- view_rotation(c(0, -tilt)) %*% spin
  centres <- spacing * (seq_len(nrow(scale)) - 1)
  patches <- lapply(seq_len(nrow(scale)), function(i) {
    patch <- shape_patch(scale$index[i], curvedness)
    placed <- function(x) sweep(x %*% t(rotation), 2, c(centres[i], 0, 0), "+")
    list(vertices = placed(patch$vertices), it = patch$it + nrow(patch$vertices) * (i - 1L),
         lines = placed(patch$lines))
  })
  mesh <- rgl::tmesh3d(t(do.call(rbind, lapply(patches, `[[`, "vertices"))),
                       do.call(cbind, lapply(patches, `[[`, "it")), homogeneous = FALSE)
  old <- graphics::par(mar = c(6, 0.5, 0.5, 0.5))
  on.exit(graphics::par(old))
  scene <- draw_surface(mesh, rep(scale$colour, each = nrow(patches[[1]]$vertices)),
                        engine = "picture", ...)
  for (patch in patches) draw_lines(scene, patch$lines, "#00000080", width = 0.6)
  scale_bar(scale, centres)
  invisible(scale)
}

# The square of side 2 of z = (k1 x^2 + k2 y^2) / 2 with the given shape index, its normals to z >
# 0, and every `every`th line of its grid.
shape_patch <- function(index, curvedness, cells = 32, every = 4) {
  k1 <- curvedness * (cos(index * pi / 2) - sin(index * pi / 2))
  k2 <- curvedness * (-cos(index * pi / 2) - sin(index * pi / 2))
  surface <- function(x, y) cbind(x, y, (k1 * x^2 + k2 * y^2) / 2)
  side <- seq(-1, 1, length.out = cells + 1)
  grid <- expand.grid(x = side, y = side)
  corner <- which(grid$x < 1 & grid$y < 1)
  it <- cbind(rbind(corner, corner + 1L, corner + cells + 2L),
              rbind(corner, corner + cells + 2L, corner + cells + 1L))
  lines <- lapply(side[seq(1, cells + 1, by = every)],
                  function(at) rbind(surface(side, at), NA, surface(at, side), NA))
  list(vertices = surface(grid$x, grid$y), it = it, lines = do.call(rbind, lines))
}

# The continuous scale below the surfaces, which stand at x; names and limits under it.
scale_bar <- function(scale, x, below = 1.3, height = 0.4) {
  low <- graphics::par("usr")[3] - below - height
  old <- graphics::par(xpd = NA)
  on.exit(graphics::par(old))
  ramp <- shape_colours(seq(-1, 1, length.out = 400), palette = scale$colour)
  graphics::rasterImage(t(as.matrix(ramp)), min(x), low, max(x), low + height)
  graphics::rect(min(x), low, max(x), low + height, border = "grey40", lwd = 0.5)
  graphics::text(x, low + 1.6 * height, gsub(" ", "\n", scale$category), cex = 0.8, pos = 3,
                 offset = 0)
  graphics::text(x, low, format(scale$index), cex = 0.8, pos = 1)
}
