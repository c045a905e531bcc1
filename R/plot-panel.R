# The plane of arc length and distance in which the ridge is sought (the paper's Fig. 3).

#' Plot the plane in which a curve was found
#'
#' The smoothed strength over arc length s along the reference path and signed distance d from it,
#' with contours, the vertices it was smoothed from, the reference path (d = 0, dashed) and the
#' ridge found (solid), with a band of two standard errors: Fig. 3 of the paper.
#'
#' @param x A `curve`, as [ridge_curve()] returns it.
#' @param points Whether to draw the vertices of the window.
#' @param grid Numbers of grid cells along s and d.
#' @param palette Colours from strength 0 to the greatest.
#' @param contours About how many contour lines.
#' @param colour Colour of the ridge and its band.
#' @param main Title; the ends of the curve where NULL.
#' @param ... Passed to [graphics::image()].
#' @return The grid, invisibly: a list of `s`, `d` and `strength`, a matrix with a row for each `s`, NA beyond the data.
#' @references The paper, Fig. 3; see [crestline-package].
#' @export
plot_panel <- function(x, points = TRUE, grid = c(150, 100), palette = grDevices::hcl.colors(80, "YlOrBr", rev = TRUE)[1:60],
                       contours = 8, colour = "#16218C", main = NULL, ...) {
  check_class(x, "curve", "x", "ridge_curve()")
  panel <- panel_grid(x, grid)
  if (is.null(main)) main <- paste0(x$type, ", ", x$from, " to ", x$to)
  graphics::image(panel$s, panel$d, panel$strength, col = palette, asp = 1, axes = FALSE, main = main,
                  xlab = "s, along the reference path", ylab = "", ...)
  graphics::axis(1, pretty(panel$s))
  graphics::axis(2, pretty(panel$d), pos = min(panel$s), las = 1)
  graphics::text(min(panel$s) - 3 * diff(graphics::grconvertX(0:1, "lines", "user")), mean(range(panel$d)),
                 "d, distance from it", srt = 90, xpd = NA)
  if (points) graphics::points(x$coordinates$s, x$coordinates$d, pch = ".", col = "#00000060")
  graphics::contour(panel$s, panel$d, panel$strength, nlevels = contours, add = TRUE, drawlabels = FALSE, col = "#8B5A2B")
  graphics::segments(0, 0, max(panel$s), 0, lty = 2, lwd = 1.5, col = "grey20")
  draw_panel_ridge(x, colour)
  invisible(panel)
}

# The smoothed strength on a grid, NA where the data do not reach: beyond their least and greatest d near the same s.
panel_grid <- function(x, grid) {
  s <- seq(0, attr(x$coordinates, "length"), length.out = grid[1])
  d <- seq(min(x$coordinates$d), max(x$coordinates$d), length.out = grid[2])
  cells <- expand.grid(s = s, d = d)
  strength <- matrix(predict(x$surface, cells$s, cells$d), length(s))
  reach <- data_reach(x$coordinates, s)
  strength[outer(reach$low, d, ">") | outer(reach$high, d, "<")] <- NA
  list(s = s, d = d, strength = strength)
}

# Least and greatest d of the data about each s, from as many equal stretches of s.
data_reach <- function(coordinates, s, stretches = 30) {
  breaks <- seq(min(s), max(s), length.out = stretches + 1)
  stretch <- findInterval(coordinates$s, breaks, all.inside = TRUE)
  ends <- vapply(split(coordinates$d, factor(stretch, seq_len(stretches))),
                 function(d) if (length(d)) range(d) else c(0, 0), numeric(2))
  middle <- (breaks[-1] + breaks[-length(breaks)]) / 2
  list(low = stats::approx(middle, ends[1, ], s, rule = 2)$y, high = stats::approx(middle, ends[2, ], s, rule = 2)$y)
}

draw_panel_ridge <- function(x, colour, multiple = 2, opacity = 0.25) {
  share <- function(s) s / max(s)
  known <- is.finite(x$points$se)
  if (sum(known) > 1) {
    se <- stats::approx(share(x$points$s)[known], x$points$se[known], share(x$line$s), rule = 2, ties = mean)$y
    graphics::polygon(c(x$line$s, rev(x$line$s)), c(x$line$alpha + multiple * se, rev(x$line$alpha - multiple * se)),
                      col = grDevices::adjustcolor(colour, opacity), border = colour, lwd = 0.7)
  }
  graphics::lines(x$line$s, x$line$alpha, col = colour, lwd = 2.5)
}
