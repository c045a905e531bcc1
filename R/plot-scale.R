# The scale of the shape index (the paper's Fig. 1).

#' Plot the scale of the shape index
#'
#' Nine little surfaces, one for each of Koenderink and van Doorn's categories, above the continuous
#' scale of colours with their names: Fig. 1 of the paper. The surfaces are of equal curvedness, seen from outside.
#'
#' @param curvedness Curvedness of the little surfaces times their radius: how bent they are.
#' @param spacing Distance between the surfaces' centres, in their radii.
#' @param view See [draw_surface()].
#' @param ... Passed to [picture_settings()].
#' @return The scale, invisibly: a data frame with nine rows and columns `category`, `index`, `colour`.
#' @inherit shape_index references
#' @examples
#' plot_shape_scale()
#' @export
plot_shape_scale <- function(curvedness = 0.55, spacing = 2.3, view = c(0.5, 0.9), ...) {
  scale <- shape_scale()
  patches <- lapply(seq_len(nrow(scale)), function(i) {
    patch <- shape_patch(scale$index[i], curvedness)
    rbind(view_rotation(view) %*% patch$vb, 1) + c(spacing * (i - 1), 0, 0, 0)
  })
  it <- shape_patch(0, curvedness)$it
  vertices <- ncol(patches[[1]])
  mesh <- rgl::tmesh3d(do.call(cbind, patches),
                       do.call(cbind, lapply(seq_len(nrow(scale)), function(i) it + vertices * (i - 1L))))
  old <- graphics::par(mar = c(5.5, 0.5, 0.5, 0.5))
  on.exit(graphics::par(old))
  draw_surface(mesh, rep(scale$colour, each = vertices), engine = "picture", ...)
  scale_bar(scale, spacing * (seq_len(nrow(scale)) - 1))
  invisible(scale)
}

# A disc of z = (k1 x^2 + k2 y^2) / 2 of radius 1, with the given shape index; its normals have z > 0.
shape_patch <- function(index, curvedness, rings = 24, spokes = 72) {
  k1 <- curvedness * (cos(index * pi / 2) - sin(index * pi / 2))
  k2 <- curvedness * (-cos(index * pi / 2) - sin(index * pi / 2))
  at <- expand.grid(turn = seq_len(spokes) * 2 * pi / spokes, radius = seq_len(rings) / rings)
  x <- c(0, at$radius * cos(at$turn))
  y <- c(0, at$radius * sin(at$turn))
  here <- seq_len(spokes)
  onward <- c(here[-1], 1L)
  band <- lapply(seq_len(rings - 1), function(ring) {
    inner <- 1L + (ring - 1L) * spokes
    outer <- inner + spokes
    cbind(rbind(inner + here, outer + here, outer + onward), rbind(inner + here, outer + onward, inner + onward))
  })
  list(vb = rbind(x, y, (k1 * x^2 + k2 * y^2) / 2), it = cbind(rbind(1L, 1L + here, 1L + onward), do.call(cbind, band)))
}

# The continuous scale below the surfaces, which stand at x; names and limits under it.
scale_bar <- function(scale, x, below = 1.5, height = 0.35) {
  low <- graphics::par("usr")[3] - below - height
  old <- graphics::par(xpd = NA)
  on.exit(graphics::par(old))
  ramp <- shape_colours(seq(-1, 1, length.out = 400))
  graphics::rasterImage(t(as.matrix(ramp)), min(x), low, max(x), low + height)
  graphics::rect(min(x), low, max(x), low + height, border = "grey40", lwd = 0.5)
  graphics::text(x, low + 1.6 * height, gsub(" ", "\n", scale$category), cex = 0.8, pos = 3, offset = 0)
  graphics::text(x, low, format(scale$index), cex = 0.8, pos = 1)
}
