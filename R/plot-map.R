# Where two means differ: signed distance as colours, the significant region outlined.

plot_map <- function(x, level, significance, limits, palette, engine, view, legend, main,
                     ambient = 0.6, gloss = 0.03, ...) {
  significance <- check_number(significance, "significance", 0, 1)
  points <- x$points[x$points$level == level, ]
  if (is.null(points) || !nrow(points)) {
    crestline_abort("points were not compared.", "Give compare_groups() `tests` with \"points\".",
                    stage = "picture",
                    call = NULL)
  }
  mesh <- points_mesh(as.matrix(points[c("x", "y", "z")]), x$aligned[[level]]$triangles)
  row <- attr(mesh, "row")
  distance <- points$distance[row]
  if (is.null(limits)) limits <- c(-1, 1) * max(abs(distance), na.rm = TRUE)
  colours <- surface_colours(mesh, distance, palette, limits)
  if (engine == "picture") {
    old <- graphics::par(mar = c(0.5, 0.5, 2, if (legend) 5 else 0.5))
    on.exit(graphics::par(old))
  }
  scene <- if (engine == "picture") draw_surface(mesh, colours, view, engine, ambient = ambient,
                                                 gloss = gloss, ...) else
    draw_surface(mesh, colours, view, engine, ...)
  outline <- level_lines(mesh, log(points$p_adjusted[row]), log(significance))
  if (nrow(outline)) scene <- draw_lines(scene, outline, "black", 2)
  if (engine == "picture") {
    if (legend) {
      at <- pretty(limits, 5)
      at <- at[at >= limits[1] & at <= limits[2]]
      colour_bar(palette, (at - limits[1]) / diff(limits), format(at))
    }
    found <- sum(points$p_adjusted <= significance, na.rm = TRUE)
    words <- sprintf("%s less %s along the normal; outlined: p < %g (%d of %d points)",
                     levels(x$group)[2],
                     levels(x$group)[1], significance,
                     found, nrow(points))
    graphics::title(if (is.null(main)) words else main, font.main = 1, cex.main = 0.9)
  }
  invisible(scene)
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
    t(mesh$vb[1:3, it[i], drop = FALSE]) * (1 -
                                            share) + t(mesh$vb[1:3, it[j], drop = FALSE]) * share
  }
  a <- cut(1)
  segments <- array(NA_real_, c(3, nrow(a), 3))
  segments[1, , ] <- a
  segments[2, , ] <- cut(2)
  matrix(segments, ncol = 3)
}
