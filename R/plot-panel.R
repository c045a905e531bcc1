# The plane of arc length and distance in which the ridge is sought (the paper's Fig. 3).

#' The plane of arc length and distance in which a curve was found
#'
#' @param x,... See [plot.curve()], where the arguments are described.
#' @return The grid, invisibly: a list of `s`, `d` and `strength`, a matrix with a row for each `s`,
#'   NA beyond the data.
#' @noRd
draw_panel <- function(x, points = TRUE, grid = c(300, 200),
                       palette = grDevices::hcl.colors(80, "YlOrBr", rev = TRUE)[1:60],
                       contours = 8, colour = "#16218C", main = NULL, ...) {
  check_flags(points)
  palette <- check_colour(palette, "palette")
  colour <- check_colour(colour, "colour")
  contours <- check_count(contours, "contours", upper = 1000)
  grid <- check_size(check_numbers(grid, "grid", 2, lower = 2), "grid")
  main <- check_text(main, "main", null = TRUE)
  if (is.null(x$line)) {
    crestline_abort(sprintf(paste0("the curve from %s to %s was not found by curvature, so it has ",
                                   "no panel."),
                            x$from, x$to),
                    "Plot a ridge or valley that was found.", stage = "picture", id = x$id)
  }
  x$coordinates <- x$coordinates[x$coordinates$inside, ]
  panel <- panel_grid(x, grid)
  if (is.null(main)) main <- paste0(x$type, ", ", x$from, " to ", x$to)
  graphics::image(panel$s, panel$d, panel$strength, col = palette, asp = 1, axes = FALSE,
                  main = main, xlab = "", ylab = "", ...)
  # Axes that stand at the panel's edges, wherever equal scale leaves room in the plot.
  line <- c(diff(graphics::grconvertX(0:1, "lines", "user")),
            diff(graphics::grconvertY(0:1, "lines", "user")))
  left <- min(panel$s)
  bottom <- min(panel$d)
  graphics::axis(1, pretty(panel$s), pos = bottom)
  graphics::axis(2, pretty(panel$d), pos = left, las = 1)
  graphics::text(mean(range(panel$s)), bottom - 3 * line[2], "s, along the reference path",
                 xpd = NA)
  graphics::text(left - 3 * line[1], mean(range(panel$d)), "d, distance from it", srt = 90,
                 xpd = NA)
  if (points) {
    graphics::points(x$coordinates$s, x$coordinates$d, pch = 16, cex = 0.25, col = "#00000060")
  }
  graphics::contour(panel$s, panel$d, panel$strength, nlevels = contours, add = TRUE,
                    drawlabels = FALSE, col = "#8B5A2B")
  graphics::segments(0, 0, max(panel$s), 0, lty = 2, lwd = 1.5, col = "grey20")
  draw_panel_ridge(x, colour)
  invisible(panel)
}

# The smoothed strength on a grid, NA where the data do not reach: beyond their least and greatest d
# near the same s.
panel_grid <- function(x, grid, each = 15, most = 30) {
  s <- seq(0, max(x$line$s), length.out = grid[1])
  d <- seq(min(x$coordinates$d), max(x$coordinates$d), length.out = grid[2])
  cells <- expand.grid(s = s, d = d)
  strength <- matrix(stats::predict(x$surface, cells$s, cells$d), length(s))
  # Least and greatest d of the data about each s, from equal stretches of s that hold `each`
  # vertices in the mean, at most `most`.
  stretches <- min(max(nrow(x$coordinates) %/% each, 2), most)
  breaks <- seq(min(s), max(s), length.out = stretches + 1)
  stretch <- findInterval(x$coordinates$s, breaks, all.inside = TRUE)
  ends <- vapply(split(x$coordinates$d, factor(stretch, seq_len(stretches))),
                 function(d) if (length(d)) range(d) else c(0, 0), numeric(2))
  middle <- (breaks[-1] + breaks[-length(breaks)]) / 2
  reach <- list(low = stats::approx(middle, ends[1, ], s, rule = 2)$y,
                high = stats::approx(middle, ends[2, ], s, rule = 2)$y)
  strength[outer(reach$low, d, ">") | outer(reach$high, d, "<")] <- NA
  list(s = s, d = d, strength = strength)
}

draw_panel_ridge <- function(x, colour, multiple = 2, opacity = 0.25) {
  line <- x$line
  if (!is.null(line$se) && !anyNA(line$se)) {
    graphics::polygon(c(line$s, rev(line$s)),
                      c(line$alpha + multiple * line$se, rev(line$alpha - multiple * line$se)),
                      col = grDevices::adjustcolor(colour, opacity), border = colour, lwd = 0.7)
  }
  graphics::lines(line$s, line$alpha, col = colour, lwd = 2.5)
}
