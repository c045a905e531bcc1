# Configurations of points that have no surface: curves and landmarks from one side.

#' Points of configurations as one sees them
#'
#' @param shapes List of k x d matrices, d 2 or 3.
#' @return List of k x 2 matrices, with the depth as third column where d is 3.
#' @noRd
seen_configurations <- function(shapes, view) {
  rotation <- view_rotation(view)
  lapply(shapes, function(xyz) if (ncol(xyz) == 3) xyz %*% t(rotation) else xyz)
}

#' Rows of every curve of a level, of which neighbours are joined by lines
#' @noRd
curve_rows <- function(names, level) {
  if (!identical(level, "curves")) return(list())
  part <- sub(" [^ ]+$", "", names)
  split(seq_along(names), factor(part, unique(part)))
}

#' An empty plot of equal scale that holds configurations
#' @noRd
configuration_window <- function(seen, margin = 2, right = 0.5) {
  all <- do.call(rbind, lapply(seen, function(xy) xy[, 1:2, drop = FALSE]))
  old <- graphics::par(mar = c(0.5, 0.5, margin, right))
  graphics::plot.new()
  graphics::plot.window(range(all[, 1], na.rm = TRUE), range(all[, 2], na.rm = TRUE), asp = 1)
  old
}

draw_configuration <- function(xy, rows, colour, size = 0.8, width = 2) {
  for (own in rows) graphics::lines(xy[own, 1:2, drop = FALSE], col = colour, lwd = width)
  graphics::points(xy[, 1:2, drop = FALSE], pch = 16, col = colour, cex = size)
}

#' Some configurations laid over each other, each in its colour
#' @param shapes Named list; the names are the legend.
#' @noRd
plot_configurations <- function(shapes, level, colour, view, legend, title) {
  seen <- seen_configurations(shapes, view)
  old <- configuration_window(seen)
  on.exit(graphics::par(old))
  rows <- curve_rows(rownames(shapes[[1]]), level)
  size <- if (length(rows)) 0.5 else 0.9
  Map(function(xy, colour) draw_configuration(xy, rows, colour, size), seen,
      rep_len(colour, length(seen)))
  if (legend) {
    graphics::legend("bottomleft", names(shapes), pch = 16, col = colour, bty = "n", cex = 0.8)
  }
  graphics::title(title, font.main = 1, cex.main = 0.9)
  invisible(seen)
}

#' A scene without a surface, that holds configurations
#'
#' @param more Dots of `draw_surface()`.
#' @noRd
configuration_scene <- function(shapes, view, more) {
  all <- with_depth(do.call(rbind, unname(shapes)))
  new_widget_scene(points_frame(all), view_rotation(view),
                   do.call(settings_of, c(list("widget"), more), quote = TRUE))
}

#' Configurations over each other as such a scene, each a layer
#' @noRd
configurations_scene <- function(shapes, level, colour, view, legend, title, ...) {
  scene <- configuration_scene(shapes, view, list(...))
  colour <- rep_len(colour, length(shapes))
  for (i in seq_along(shapes)) {
    add_configuration(in_layer(scene, names(shapes)[i]), shapes[[i]], level, colour[i])
  }
  if (legend) draw_key(scene, stats::setNames(colour, names(shapes)))
  draw_title(scene, title)
}

#' One configuration in the layer of a scene, named by both
#' @noRd
add_configuration <- function(scene, xyz, level, colour, width = 2) {
  xyz <- with_depth(xyz)
  rows <- curve_rows(rownames(xyz), level)
  for (own in rows) draw_lines(scene, xyz[own, , drop = FALSE], colour, width)
  draw_points(scene, xyz, colour, if (length(rows)) 0.5 else 1,
              name = if (!is.null(rownames(xyz))) paste0(rownames(xyz), ", ", scene$drawn$layer))
}

#' An alignment as such a scene: all specimens as dots, the mean and the farthest by name
#'
#' @param far Numbers of the farthest specimens; `words`: what the legend says of them.
#' @noRd
alignment_scene <- function(x, far, words, colour, view, legend, title) {
  shapes <- lapply(as.list(x), with_depth)
  scene <- configuration_scene(shapes, view, list())
  most <- max(1, scene$drawn$settings$points %/% nrow(x$mean))
  some <- unique(round(seq(1, length(x), length.out = min(most, length(x)))))
  if (length(some) < length(x)) {
    add_to(scene, "notes", sprintf("Shown are %d of the %d specimens, and the farthest.",
                                   length(some), length(x)))
  }
  draw_points(in_layer(scene, "specimens"), unname(do.call(rbind, shapes[some])), "grey50", 0.6)
  add_configuration(in_layer(scene, "mean"), x$mean, x$level, "black")
  for (i in seq_along(far)) {
    add_configuration(in_layer(scene, names(x)[far[i]]), shapes[[far[i]]], x$level, colour[i], 1.5)
  }
  if (legend) draw_key(scene, stats::setNames(c("black", colour), c("mean", words)))
  draw_title(scene, title)
}

#' Plot an alignment
#'
#' Draws all specimens over their mean. The farthest are coloured and named.
#'
#' @param x An `aligned`, as [align()] returns it, or a `shape_sample`, which is aligned first.
#' @param level Level of a `shape_sample` that is aligned, as in [align()].
#' @param most Number of the farthest specimens that are named.
#' @param colour Colours of the farthest specimens.
#' @param view Direction of view, as in [draw_surface()].
#' @param legend Whether to draw the legend: ids and Procrustes distances from the mean (without
#'   unit; with `scale = FALSE` in the unit of the meshes).
#' @param main Title. `NULL`: the number of specimens and the level.
#' @param engine "widget" for a scene that turns in the browser, "picture" for base graphics. See
#'   [draw_surface()]. "rgl" draws as "picture".
#' @param ... For a `shape_sample`: arguments of [align()]. Otherwise ignored.
#' @return Invisibly: data frame of the named specimens, the farthest first, with the columns of
#'   `as.data.frame()` (see [align()]). With `engine = "widget"` the scene. Of many specimens the
#'   scene shows some as dots, see `points` of [widget_settings()], and the page says so.
#' @section Errors: of class `crestline_error`: `x` is not an `aligned`, or `most` is not a number
#'   of specimens.
#' @template glossary
#' @seealso [align()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' plot(align(shapes + rnorm(120, sd = 0.05)), engine = "picture")
#' @export
plot.aligned <- function(x, most = 3, colour = grDevices::hcl.colors(most, "Dark 3"),
                         view = "front", legend = TRUE, main = NULL, engine = drawing_engine(),
                         ...) {
  check_method_dots(...)
  validate(x)
  engine <- check_engine(engine)
  most <- min(check_count(most, "most"), length(x))
  colour <- rep_len(check_colour(colour, "colour"), most)
  check_flags(legend)
  main <- check_text(main, "main", null = TRUE)
  table <- as.data.frame(x)
  far <- order(table$distance, decreasing = TRUE)[seq_len(most)]
  words <- sprintf("%s (%.3g)", table$id[far], table$distance[far])
  title <- sprintf("%s over their mean (%s), the farthest named", amount(length(x), "specimen"),
                   x$level)
  if (!is.null(main)) title <- main
  view <- posed_view(view, x$mean)
  if (engine == "widget") return(alignment_scene(x, far, words, colour, view, legend, title))
  seen <- seen_configurations(c(unname(as.list(x)), list(x$mean)), view)
  old <- configuration_window(seen)
  on.exit(graphics::par(old))
  rows <- curve_rows(rownames(x$mean), x$level)
  for (xy in seen[seq_along(x)]) {
    graphics::points(xy[, 1:2], pch = 16, cex = 0.35, col = "#80808080")
  }
  draw_configuration(seen[[length(seen)]], rows, "black", if (length(rows)) 0.3 else 0.7, 1.2)
  for (i in seq_along(far)) {
    draw_configuration(seen[[far[i]]], rows, colour[i], 0.55, 1)
  }
  if (legend) {
    graphics::legend("bottomleft", c("mean", words), pch = 16, col = c("black", colour), bty = "n",
                     cex = 0.8)
  }
  graphics::title(title, font.main = 1, cex.main = 0.9)
  invisible(table[far, ])
}

#' @rdname plot.aligned
#' @export
plot.shape_sample <- function(x, level = "curves", most = 3,
                              colour = grDevices::hcl.colors(most, "Dark 3"), view = "front",
                              legend = TRUE, main = NULL, engine = drawing_engine(), ...) {
  check_class(x, "shape_sample", "x", "homologise()")
  plot.aligned(align(x, level, ...), most, colour, view, legend, main, engine)
}
