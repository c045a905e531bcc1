# What stands beside a scene: title, key of colours, scale of values. rgl's window has none of them.

#' Titles, keys and scales of a scene
#'
#' @param colours Named colours: what each stands for is its name.
#' @param ramp Colours from bottom to top; `labels` at shares `at` of the way.
#' @noRd
draw_title <- function(scene, title, ...) UseMethod("draw_title")
draw_key <- function(scene, colours, ...) UseMethod("draw_key")
draw_bar <- function(scene, ramp, at, labels, title = NULL) UseMethod("draw_bar")

#' @exportS3Method
draw_title.rgl_scene <- function(scene, title, ...) invisible(scene)
#' @exportS3Method
draw_key.rgl_scene <- function(scene, colours, ...) invisible(scene)
#' @exportS3Method
draw_bar.rgl_scene <- function(scene, ramp, at, labels, title = NULL) invisible(scene)

#' @exportS3Method
draw_title.widget_scene <- function(scene, title, ...) {
  if (!is.null(title)) assign("title", title, envir = scene$drawn)
  scene
}

#' @exportS3Method
draw_key.widget_scene <- function(scene, colours, ...) add_to(scene, "key", colours)

#' @exportS3Method
draw_bar.widget_scene <- function(scene, ramp, at, labels, title = NULL) {
  bar <- list(ramp = ramp, at = at, labels = labels, title = title)
  assign("bar", bar, envir = scene$drawn)
  scene
}

#' @exportS3Method
draw_title.picture_scene <- function(scene, title, ...) {
  if (!is.null(title)) graphics::title(title, ...)
  invisible(scene)
}

#' @exportS3Method
draw_key.picture_scene <- function(scene, colours, ..., width = 2) {
  on_scene(scene, graphics::legend("bottomleft", names(colours), col = colours, lwd = width,
                                   bty = "n", cex = 0.8, ...))
}

#' @exportS3Method
draw_bar.picture_scene <- function(scene, ramp, at, labels, title = NULL) {
  on_scene(scene, colour_bar(ramp, at, labels, title = title))
}

# An upright bar of colours in the right margin, from the first at the bottom; labels at shares `at`
# of its height; what they are above it.
colour_bar <- function(ramp, at, labels, share = 0.6, width = 0.8, title = NULL) {
  line <- diff(graphics::grconvertX(0:1, "lines", "user"))
  usr <- graphics::par("usr")
  left <- usr[2] + 0.3 * line
  middle <- mean(usr[3:4])
  half <- share * (usr[4] - usr[3]) / 2
  old <- graphics::par(xpd = NA)
  on.exit(graphics::par(old))
  graphics::rasterImage(as.matrix(rev(ramp)), left, middle - half, left + width * line,
                        middle + half)
  graphics::rect(left, middle - half, left + width * line, middle + half, border = "grey40",
                 lwd = 0.5)
  graphics::text(left + width * line, middle - half + 2 * half * at, labels, pos = 4, offset = 0.3,
                 cex = 0.75)
  if (!is.null(title)) {
    graphics::text(left, middle + half + 0.4 * line, paste(strwrap(title, 12), collapse = "\n"),
                   adj = c(0, 0), cex = 0.75)
  }
}

map_legend <- function(scene, palette, limits, title = NULL) {
  ticks <- scale_ticks(limits)
  draw_bar(scene, palette, ticks$at, ticks$labels, title)
}

#' Round values of a scale, at shares of the way between its limits
#' @noRd
scale_ticks <- function(limits) {
  at <- pretty(limits, 5)
  at <- at[at >= limits[1] & at <= limits[2]]
  list(at = (at - limits[1]) / diff(limits), labels = format(at))
}
