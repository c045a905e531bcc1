# Scores on discriminants, by group.

#' Plot a discriminant analysis
#'
#' Draws the scores of the specimens on the discriminants, by group. The discriminants were fitted
#' to these specimens, so groups look better separated than new specimens would be. Specimens that
#' cross-validation assigns to a wrong group are ringed. The title has the share of correct
#' assignments.
#'
#' @param x A `shape_lda`, as [shape_lda()] returns it.
#' @param component Numbers of discriminants: two are drawn against each other, one is drawn by
#'   group. NULL: the first two; with two groups the only one.
#' @param colour Colours of the groups.
#' @param labels Whether to write the names of the specimens.
#' @param ellipse As in [plot.shape_pca()]. Not used for one discriminant.
#' @param main Title. `NULL`: the share of correct assignments.
#' @param ... Passed to [graphics::plot.default()], or to [graphics::boxplot()] with one
#'   discriminant.
#' @return The scores that are drawn, invisibly.
#' @section Errors: of class `crestline_error`: there is no such discriminant.
#' @template glossary
#' @seealso [shape_lda()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 20), c(4, 3, 20))
#' shapes <- shapes + rnorm(240, sd = 0.05)
#' sex <- rep(c("F", "M"), each = 10)
#' shapes[1, 3, sex == "M"] <- shapes[1, 3, sex == "M"] + 0.15
#' plot(shape_lda(shapes, sex, components = 3))
#' @export
plot.shape_lda <- function(x, component = NULL, colour = c("#2F7FD1", "#E0553F"), labels = FALSE,
                           ellipse = 0, main = NULL, ...) {
  validate(x)
  check_flags(labels)
  check_colour(colour, "colour")
  ellipse <- check_number(ellipse, "ellipse", 0, 1)
  scores <- predict.shape_lda(x)$x
  if (is.null(component)) component <- seq_len(min(2, ncol(scores)))
  component <- check_numbers(component, "component", lower = 1, upper = ncol(scores))
  group <- x$group
  colour <- if (length(colour) >= nlevels(group)) colour[seq_len(nlevels(group))] else
    grDevices::hcl.colors(nlevels(group), "Dark 3")
  title <- if (!is.null(main)) main else
    sprintf("%s; left out, %d of %d right", x$level, sum(x$specimens$correct), nrow(scores))
  spread <- x$lda$svd^2 / sum(x$lda$svd^2)
  names <- sprintf("LD%d (%.1f %% between groups)", component, 100 * spread[component])
  at <- scores[, component[seq_len(min(2, length(component)))], drop = FALSE]
  if (ncol(at) == 1) {
    drawn <- box_panel(at[, 1], group, title, colour, ...)
    graphics::title(ylab = sprintf("LD%d", component), line = 2.5)
    place <- cbind(as.integer(group) + box_shift(at[, 1], group), at[, 1])
  } else {
    draw_scores(at, group, colour, names, labels = FALSE, ellipse, ...)
    graphics::title(title, font.main = 1, cex.main = 1)
    place <- at
  }
  wrong <- !x$specimens$correct
  graphics::points(place[wrong, , drop = FALSE], pch = 1, cex = 2)
  if (labels) {
    graphics::text(place, rownames(scores), pos = 3, offset = 0.35, cex = 0.6, xpd = NA)
  }
  invisible(at)
}
