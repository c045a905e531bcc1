# Measurement error: by curve, and where it is.

#' Plot repeatability
#'
#' Draws two panels. The left panel has the error of each part, in the unit of the mesh. The
#' standard deviation between specimens is behind it (grey), and the intra-class correlation beside
#' it. The right panel has the mean points, coloured by their error. The points of a curve are
#' joined by a line, landmarks are not. For one specimen only the error
#' is drawn. With `engine = "widget"` the mean points turn in the browser, and the left panel is not
#' drawn.
#'
#' @param x A `repeatability`, as [repeatability()] returns it.
#' @param view Direction of view of the right panel, as in [draw_surface()].
#' @param most Greatest number of parts in the left panel; those of the greatest error are shown.
#' @param palette Colours from no error to the greatest.
#' @param size Diameter of the points, as `cex` of [graphics::par()].
#' @param engine "picture" for base graphics, "widget" for a scene of the mean points. See
#'   [draw_surface()]. "rgl" draws as "picture".
#' @param ... Passed to [graphics::plot.default()] of the left panel, or with "widget" to
#'   [widget_settings()].
#' @return `x`, invisibly; with the engine "widget" the scene.
#' @template glossary
#' @seealso [repeatability()]
#' @examples
#' angle <- seq(0, 1, length.out = 9)
#' arc <- function(r) cbind(r * cos(angle), r * sin(angle), 0)
#' specimen <- rep(1:5, each = 3)
#' arcs <- vapply(specimen, function(i) arc(9 + i / 3) + rnorm(27, sd = angle / 5), arc(1))
#' rownames(arcs) <- paste("arc", 1:9)
#' plot(repeatability(arcs, specimen, level = "curves"))
#' @export
plot.repeatability <- function(x, view = "front", most = 40,
                               palette = grDevices::hcl.colors(64, "YlOrRd", rev = TRUE)[10:64],
                               size = 0.9, engine = "picture", ...) {
  check_most(most)
  if (check_engine(engine) == "widget") return(repeatability_scene(x, view, palette, size, ...))
  old <- graphics::par("mar", "mgp", "las")
  on.exit({
    graphics::layout(1)
    graphics::par(old)
  })
  graphics::layout(t(1:2), widths = c(1.15, 1))
  plot_part_errors(x, most, palette, ...)
  at <- as.matrix(x$points[c("x", "y", "z")])
  rownames(at) <- x$points$point
  # The mean points from one side, coloured by error
  rotation <- posed_view(view, at)
  graphics::par(mar = c(3.2, 0.5, 1.5, 4))
  flat <- as.matrix(x$points[c("x", "y", "z")]) %*% t(rotation)
  graphics::plot.new()
  graphics::plot.window(range(flat[, 1]), range(flat[, 2]), asp = 1)
  for (own in joined_points(x)) graphics::lines(flat[own, 1:2, drop = FALSE], col = "grey70")
  front <- order(x$points$error)
  graphics::points(flat[front, 1:2], pch = 16, cex = size,
                   col = error_colours(x$points$error, x, palette)[front])
  colour_bar(palette, c(0, 0.5, 1), signif(c(0, 0.5, 1) * max(x$points$error), 2),
             title = "unit of the meshes")
  invisible(x)
}

#' Rows of points that a line joins: those of a curve
#' @return List of integers.
#' @noRd
joined_points <- function(x) {
  if (identical(x$level, "landmarks")) return(list())
  split(seq_len(nrow(x$points)), factor(x$points$part, unique(x$points$part)))
}

#' The mean points as a scene, coloured by error
#' @noRd
repeatability_scene <- function(x, view, palette, size, ...) {
  at <- as.matrix(x$points[c("x", "y", "z")])
  rownames(at) <- x$points$point
  scene <- configuration_scene(list(at), posed_view(view, at), list(...))
  for (own in joined_points(x)) draw_lines(scene, at[own, , drop = FALSE], "grey70", 2)
  draw_points(scene, at, error_colours(x$points$error, x, palette), size,
              name = sprintf("%s: %.3g", x$points$point, x$points$error))
  map_legend(scene, palette, c(0, max(x$points$error)), "unit of the meshes")
}

#' Error by part as dots, specimens' standard deviation as a bar behind
#' @noRd
plot_part_errors <- function(x, most, palette, ...) {
  parts <- utils::head(x$parts, -1)
  parts <- utils::head(parts[order(-parts$error), ], most)
  at <- rev(seq_len(nrow(parts)))
  scale <- min(0.8, 26 / nrow(parts))
  name_width <- 0.9 * scale * max(nchar(parts$part)) * 0.52 + 1
  graphics::par(mar = c(3.2, name_width, 1.5, 3), mgp = c(2, 0.6, 0), las = 1)
  several <- x$counts[["specimens"]] > 1
  top <- max(parts$error, if (several) parts$specimen)
  drawn_or_refused(graphics::plot(
    NA, xlim = c(0, top * 1.02), ylim = c(0.5, nrow(parts) + 0.5), yaxt = "n", ylab = "",
    xaxs = "i", bty = "n", xlab = "standard deviation of a point (unit of the meshes)", ...
  ))
  if (several) graphics::rect(0, at - 0.35, parts$specimen, at + 0.35, col = "grey88", border = NA)
  colour <- error_colours(parts$error, x, palette)
  graphics::segments(0, at, parts$error, at, col = colour, lwd = 2)
  graphics::points(parts$error, at, pch = 21, bg = colour, col = "grey20", cex = 0.9)
  graphics::axis(2, at, parts$part, tick = FALSE, cex.axis = scale, line = -0.3)
  if (!several) return(invisible())
  graphics::axis(4, at, sprintf("%.2f", parts$icc), tick = FALSE, cex.axis = scale, line = -0.6)
  graphics::mtext("ICC", 4, line = 0.4, at = nrow(parts) + 1, cex = 0.8)
  graphics::legend("topleft", c("error", "between specimens"), horiz = TRUE, xpd = NA,
                   inset = c(0, -0.05),
                   pch = c(21, 15), pt.bg = palette[length(palette) / 2],
                   col = c("grey20", "grey88"), pt.cex = c(1, 1.6), bty = "n", cex = 0.8)
}

error_colours <- function(error, x, palette) {
  ramp_colours(error / max(x$points$error, .Machine$double.xmin), palette, "grey50")
}
