# Where two means differ: signed distance as colours, the significant region outlined.

#' @param ... Fields of [map_look()], and arguments of [draw_surface()].
#' @noRd
plot_map <- function(x, level, engine, view, legend, main, ...) {
  given <- map_arguments(...)
  look <- given$look
  points <- x$points[x$points$level == level, ]
  if (is.null(points) || !nrow(points)) {
    crestline_abort("points were not compared.", "Give compare_groups() `tests` with \"points\".",
                    stage = "picture",
                    call = NULL)
  }
  aligned <- x$aligned[[level]]
  points$p_adjusted <- held_p(points, look$adjust, aligned$weights)
  found <- sum(points$p_adjusted <= look$significance, na.rm = TRUE)
  surface <- !is.null(aligned$triangles)
  words <- sprintf(
    "%s\n%s: %s < %g (%d of %d points)",
    if (surface) {
      sprintf("%s less %s along the normal", levels(x$group)[2], levels(x$group)[1])
    } else {
      "distance between the means"
    },
    if (surface) "outlined" else "ringed", held_words[[look$adjust]], look$significance, found,
    sum(!is.na(points$p_adjusted))
  )
  draw_map(points, if (surface) points$distance else points$displacement, surface,
           aligned$triangles, if (is.null(main)) words else main, given, engine, view, legend)
}

#' Values of points as colours: on the surface, or on the points where there are no triangles
#'
#' @param points Data frame `point`, `x`, `y`, `z`, `level`, `p_adjusted`.
#' @param value A number a point.
#' @param signed Whether values have a sign: colours are then symmetric about 0, else they begin at
#'   0 and take the upper half of the palette.
#' @param given As of [map_arguments()].
#' @noRd
draw_map <- function(points, value, signed, triangles, title, given, engine, view, legend) {
  look <- given$look
  limits <- look$limits
  palette <- look$palette
  at <- as.matrix(points[intersect(c("x", "y", "z"), names(points))])
  rownames(at) <- points$point
  view <- posed_view(view, at)
  if (is.null(limits)) limits <- c(-signed, 1) * max(abs(value), na.rm = TRUE)
  if (limits[2] <= limits[1]) limits <- limits[1] + c(0, 1)
  if (!signed) palette <- utils::tail(palette, ceiling(length(palette) / 2))
  if (is.null(triangles)) {
    if (engine == "widget") {
      look[c("limits", "palette")] <- list(limits, palette)
      return(points_scene(points, value, look, view, legend, title, given$more))
    }
    return(invisible(points_map(points, value, limits, palette, look$significance, view, legend,
                                title, look$length_unit)))
  }
  mesh <- points_mesh(as.matrix(points[c("x", "y", "z")]), triangles)
  row <- attr(mesh, "row")
  colours <- surface_colours(mesh, value[row], palette, limits)
  settings <- given$more
  if (engine == "picture") {
    old <- graphics::par(mar = c(0.5, 0.5, 2, if (legend) 5 else 0.5))
    on.exit(graphics::par(old))
    # More light from all sides, so that shade hides no colour.
    settings <- utils::modifyList(list(ambient = 0.6, gloss = 0.03), settings)
  }
  scene <- do.call(draw_surface, c(list(mesh, colours, view, engine), settings), quote = TRUE)
  outline <- level_lines(mesh, log(points$p_adjusted[row]), log(look$significance))
  if (nrow(outline)) scene <- draw_lines(in_layer(scene, "outline"), outline, "black", 2)
  if (legend) map_legend(scene, palette, limits, look$length_unit)
  draw_title(scene, title, font.main = 1, cex.main = 0.8)
  shown(scene)
}

#' How a map looks, and the arguments of [draw_surface()] beside that
#'
#' @param ... The dots of a `plot()`.
#' @return List: `look`, as of [map_look()]; `more`, the other arguments.
#' @noRd
map_arguments <- function(...) {
  given <- list(...)
  own <- names(given) %in% names(formals(map_look))
  list(look = do.call(map_look, given[own], quote = TRUE), more = given[!own])
}

map_look <- function(significance = 0.05, limits = NULL,
                     palette = grDevices::hcl.colors(21, "Blue-Red"),
                     adjust = c("fwe", "fdr", "none"), length_unit = "unit of the meshes") {
  if (!is.null(limits)) limits <- check_numbers(limits, "limits", n = 2)
  list(significance = check_number(significance, "significance", 0, 1),
       limits = limits, palette = check_colour(palette, "palette"),
       adjust = check_choice(adjust, c("fwe", "fdr", "none"), "adjust"),
       length_unit = check_text(length_unit, "length_unit"))
}

#' What is held, as a title names it
#' @noRd
held_words <- c(fwe = "family-wise p", fdr = "false discovery rate", none = "p of each point")

#' p-values of points by what is held
#' @param weights k numbers, of the points.
#' @noRd
held_p <- function(points, adjust, weights) {
  switch(adjust, fwe = points$p_adjusted, none = points$p_value,
         fdr = weighted_fdr(points$p_value, weights))
}

#' False discovery rate of weighted hypotheses (Benjamini and Hochberg 1997); with equal weights
#' that of [stats::p.adjust()]
#' @noRd
weighted_fdr <- function(p, weights) {
  known <- which(!is.na(p) & weights > 0)
  order <- known[order(p[known])]
  rate <- p[order] * sum(weights[known]) / cumsum(weights[order])
  p[] <- NA
  p[order] <- pmin(1, rev(cummin(rev(rate))))
  p
}

#' A map of points that have no triangles: seen from `view`, those in front last
#' @noRd
points_map <- function(points, value, limits, palette, significance, view, legend, title,
                       length_unit = NULL) {
  at <- as.matrix(points[intersect(c("x", "y", "z"), names(points))])
  rownames(at) <- points$point
  at <- seen_configurations(list(at), view)[[1]]
  breaks <- seq(limits[1], limits[2], length.out = length(palette) + 1)
  colour <- palette[findInterval(value, breaks, all.inside = TRUE)]
  order <- if (ncol(at) == 3) order(at[, 3]) else seq_len(nrow(at))
  old <- configuration_window(list(at), 2, if (legend) 5 else 0.5)
  on.exit(graphics::par(old))
  for (own in curve_rows(points$point, points$level[1])) {
    graphics::lines(at[own, 1:2, drop = FALSE], col = "grey70")
  }
  found <- points$p_adjusted[order] <= significance
  graphics::points(at[order, 1:2], pch = 21, bg = colour[order], cex = 1.1,
                   col = ifelse(found %in% TRUE, "black", "grey80"),
                   lwd = ifelse(found %in% TRUE, 1.6, 0.4))
  ticks <- scale_ticks(limits)
  if (legend) colour_bar(palette, ticks$at, ticks$labels, title = length_unit)
  graphics::title(title, font.main = 1, cex.main = 0.8)
  points
}

#' The same as a scene: significant points are larger, and black rings become a layer of their own
#'
#' @param look As of [map_look()], with `limits`.
#' @noRd
points_scene <- function(points, value, look, view, legend, title, more) {
  at <- as.matrix(points[intersect(c("x", "y", "z"), names(points))])
  rownames(at) <- points$point
  scene <- configuration_scene(list(at), view, more)
  breaks <- seq(look$limits[1], look$limits[2], length.out = length(look$palette) + 1)
  colour <- look$palette[findInterval(value, breaks, all.inside = TRUE)]
  in_layer(scene, "lines")
  for (own in curve_rows(points$point, points$level[1])) {
    draw_lines(scene, with_depth(at[own, , drop = FALSE]), "grey70", 1)
  }
  in_layer(scene, "points")
  found <- points$p_adjusted <= look$significance & !is.na(points$p_adjusted)
  words <- sprintf("%s: %.3g", points$point, value)
  for (paint in unique(colour)) for (sure in c(FALSE, TRUE)) {
    own <- colour == paint & found == sure
    if (!any(own)) next
    draw_points(scene, with_depth(at[own, , drop = FALSE]), paint, if (sure) 1.6 else 0.9,
                name = words[own])
  }
  if (any(found)) draw_title(scene, paste0(title, "\n(larger points: significant)"))
  else draw_title(scene, title)
  if (legend) map_legend(scene, look$palette, look$limits, look$length_unit)
  scene
}

#' Lines on a mesh where a function of its vertices, linear in every triangle, has a value
#'
#' @param value One number a vertex; triangles with a missing one have no line.
#' @return Matrix of points, three rows a segment: its ends and NA.
#' @noRd
level_lines <- function(mesh, value, at) {
  value <- value - at
  corner <- matrix(value[mesh$it], 3)
  crossed <- which(colSums(is.na(corner)) == 0 & colSums(corner <= 0) %in% 1:2)
  if (!length(crossed)) return(matrix(numeric(), 0, 3))
  corner <- corner[, crossed, drop = FALSE]
  it <- mesh$it[, crossed, drop = FALSE]
  # The corner that is alone on its side of the line.
  low <- corner <= 0
  alone <- max.col(t(low == (rep(colSums(low), each = 3) == 1)), "first")
  cut <- function(shift) {
    other <- (alone - 1 + shift) %% 3 + 1
    i <- cbind(alone, seq_along(alone))
    j <- cbind(other, seq_along(alone))
    share <- corner[i] / (corner[i] - corner[j])
    t(mesh$vb[1:3, it[i], drop = FALSE]) * (1 - share) +
      t(mesh$vb[1:3, it[j], drop = FALSE]) * share
  }
  a <- cut(1)
  segments <- array(NA_real_, c(3, nrow(a), 3))
  segments[1, , ] <- a
  segments[2, , ] <- cut(2)
  matrix(segments, ncol = 3)
}
