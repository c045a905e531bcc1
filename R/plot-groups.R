# Pictures of a comparison of groups: boxplots, mean shapes, where they differ.

#' Plot a comparison of groups
#'
#' @param x A `group_comparison`, as [compare_groups()] returns it.
#' @param what Kind of picture. "boxes": boxplots of centroid size and of scores by group, with all
#'   specimens as points and the means as diamonds (the paper's Fig. 9, upper). "means": the two
#'   mean shapes, superimposed, of equal size, transparent in two colours (Fig. 9, lower). "map":
#'   the signed distance between the means along the normal, as colours on the mean surface. It is
#'   positive where the second mean is outside the first. The significant region is outlined. Levels
#'   without a surface (landmarks, curves) are drawn as points and lines. "means" then shows the
#'   means of all groups. "map" shows the distance between the means of two groups, and rings
#'   significant points.
#' @param level Level. NULL: the first level with a surface for pictures of shapes, else the first
#'   level.
#' @param colour Colours of the groups.
#' @param engine,view As in [plot.specimen()] and [draw_surface()].
#' @param ... Further arguments of each kind, see below.
#' @param legend Whether to draw a legend (not by "rgl").
#' @param main Title; `NULL` for the p-value. That of a single component is adjusted for their
#'   number, as by `print()`.
#' @section Further arguments: Of "boxes":
#'   * `components`: numbers of the components (1, 2 and 3 by default);
#'   * those of [graphics::boxplot()].
#'
#'   Of "means":
#'   * `opacity` of the nearer surface, 0.5 to 1 ("picture"), or of both surfaces ("rgl"); 0.8 by
#'     default;
#'   * those of [draw_surface()].
#'
#'   Of "map":
#'   * `significance`: significance level of the outline (0 to 1; 0.05 by default);
#'   * `adjust`: error rate that the level controls. "fwe" (the default): the family-wise error, by
#'     the greatest statistic over all points. "fdr": the false discovery rate
#'     ([stats::p.adjust()], Benjamini and Hochberg 1995). If the alignment has weights, it is the
#'     rate by weight, such as area (Benjamini and Hochberg 1997). It needs many permutations: no
#'     point can be significant if the least p-value times the number of points exceeds the level,
#'     unless many points have that p-value. "none": the error of each single point;
#'   * `limits`, `palette`: range of the distances (two numbers, unit of the meshes; symmetric about
#'     0 by default), and colours;
#'   * `length_unit`: name of the unit of lengths, for the legend;
#'   * those of [draw_surface()]. There is more `ambient` light by default, as shade would hide
#'     colours.
#' @return Invisibly, if it is not a widget. "boxes": list with the value of [graphics::boxplot()]
#'   for each panel. "means", "map": the scene of [draw_surface()].
#' @section Errors: of class `crestline_error`: there is no such level; a map, or mean surfaces, are
#'   asked for more than two groups.
#' @template glossary
#' @templateVar where Fig. 9
#' @template paper
#' @references Benjamini and Hochberg (1995) Controlling the false discovery rate, *Journal of the
#'   Royal Statistical Society B* 57, 289-300; (1997) Multiple hypotheses testing with weights,
#'   *Scandinavian Journal of Statistics* 24, 407-418.
#' @seealso [compare_groups()]
#' @examples
#' ball <- Rvcg::vcgSphere(3)
#' xyz <- t(ball$vb[1:3, ])
#' balls <- lapply(1:20, function(i) {
#'   bump <- exp(-20 * rowSums(sweep(xyz, 2, c(0, 0, 1))^2))
#'   xyz * (1 + 0.03 * rnorm(1) * xyz[, 1]^2 + (i > 10) * 0.05 * bump)
#' })
#' aligned <- align(simplify2array(balls), "ball", triangles = ball$it)
#' compared <- compare_groups(aligned, rep(c("A", "B"), each = 10), n_perm = 200, seed = 1)
#' plot(compared)
#' plot(compared, "map", engine = "picture", view = c(0.4, 0.3))
#' @export
plot.group_comparison <- function(x, what = c("boxes", "means", "map"), level = NULL,
                                  colour = c("#2F7FD1", "#E0553F"),
                                  engine = drawing_engine(), view = "front",
                                  legend = TRUE, main = NULL, ...) {
  validate(x)
  what <- check_choice(what, c("boxes", "means", "map"), "what")
  check_colour(colour, "colour")
  check_flags(legend)
  engine <- check_engine(engine)
  level <- level_to_plot(x, level, what)
  groups <- nlevels(x$group)
  colour <- if (length(colour) >= groups) colour[seq_len(groups)] else
    grDevices::hcl.colors(groups, "Dark 3")
  drawn <- switch(what, boxes = plot_boxes(x, level, colour, main, ...),
                  means = plot_means(x, level, colour, engine, view, legend, main, ...),
                  map = plot_map(x, level, engine, view, legend, main, ...))
  shown(drawn)
}

level_to_plot <- function(x, level, what) {
  has_surface <- vapply(x$aligned, function(one) !is.null(one$triangles), NA)
  possible <- names(x$aligned)[order(what != "boxes" & !has_surface)]
  level <- if (is.null(level)) possible[1] else check_choice(level, possible, "level")
  if (nlevels(x$group) != 2 && (what == "map" || what == "means" && has_surface[[level]])) {
    crestline_abort(sprintf("there are %d groups.", nlevels(x$group)),
                    "Compare two, or plot \"boxes\".", stage = "picture")
  }
  level
}

plot_boxes <- function(x, level, colour, main, ..., components = 1:3) {
  compared <- in_design(x$aligned[[level]], x$design)
  on.exit(forget_units(compared, x$aligned[[level]]))
  pca <- x$pca[[level]]
  if (is.null(pca)) pca <- shape_pca(compared)
  components <- intersect(components, seq_along(pca$sdev))
  panels <- c(list("centroid size" = compared$size), stats::setNames(
    lapply(components, function(j) pca$x[, j]),
    sprintf("PC%d (%.0f %%)", components, 100 * pca$share[components])
  ))
  tests <- c(intersect(c("size t", "size F"), x$tests$test)[1], paste0("PC", components))
  old <- graphics::par(mfrow = grDevices::n2mfrow(length(panels))[2:1], mar = c(2.5, 3, 2.8, 0.6),
                       mgp = c(2, 0.6, 0))
  on.exit(graphics::par(old), add = TRUE)
  invisible(Map(function(y, name, test) {
    title <- paste(c(if (is.null(main)) name else paste(main, name, sep = ": "),
                     p_value_of(x, level, test)),
                   collapse = ", ")
    box_panel(y, x$design$group, title, colour, ...)
  }, panels, names(panels), tests))
}

# One boxplot: points beside each other where they would hide each other, the means as diamonds.
box_panel <- function(y, group, title, colour, ...) {
  drawn <- drawn_or_refused(graphics::boxplot(
    y ~ group, outline = FALSE, ylim = range(y), col = grDevices::adjustcolor(colour, 0.25),
    border = colour, xlab = "", ylab = "", las = 1, boxwex = 0.55, ...
  ))
  graphics::title(title, font.main = 1, cex.main = 1)
  graphics::points(as.integer(group) + box_shift(y, group), y, pch = 16, cex = 0.9,
                   col = grDevices::adjustcolor(colour[as.integer(group)], 0.7))
  graphics::points(seq_len(nlevels(group)), tapply(y, group, mean), pch = 23, cex = 1.5,
                   bg = "white", col = colour, lwd = 2)
  drawn
}

# How far each point of a boxplot stands beside the middle of its box, by rank.
box_shift <- function(y, group) {
  stats::ave(rank(y, ties.method = "first"), group,
             FUN = function(r) ((rank(r) * 0.618) %% 1 - 0.5) * 0.3)
}
