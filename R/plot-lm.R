# Pictures of a linear model: where a term acts, and how far each specimen follows it.

#' Plot a linear model of shape
#'
#' @param x A `shape_lm`, as [shape_lm()] returns it.
#' @param what Kind of picture. "map": the effect of a term, as colours on the mean. For a term with
#'   one degree of freedom the colours show the effect of one unit along the surface normal, outward
#'   positive. For other terms, and for levels without triangles, they show the root mean square
#'   displacement. The significant region is outlined; without triangles significant points are
#'   ringed. "scores": the regression score of every specimen on the term, against the term's
#'   variable. It is the component of the shape in the direction of the term's effect (Drake and
#'   Klingenberg 2008).
#' @param term Name of a term. NULL: the first.
#' @param level Level. NULL: the first; for "map" the first with triangles, if there is one.
#' @param unit For "map": number of units of the term whose effect is shown, such as 10 for 10
#'   years.
#' @param engine,view,legend,main As in [plot.group_comparison()].
#' @param ... For "map" those of [plot.group_comparison()], `adjust` too. For "scores" those of
#'   [graphics::plot.default()].
#' @return Invisibly: the scene of [draw_surface()], or for "scores" a data frame with `variable`
#'   and `score` of each specimen.
#' @section Errors: of class `crestline_error`: there is no such term or level, or the points were
#'   not tested.
#' @template glossary
#' @references Drake and Klingenberg (2008) The pace of morphological change: historical
#'   transformation of skull shape in St Bernard dogs, *Proceedings of the Royal Society B* 275,
#'   71-76.
#' @seealso [shape_lm()]
#' @examples
#' ball <- Rvcg::vcgSphere(3)
#' xyz <- t(ball$vb[1:3, ])
#' bump <- exp(-20 * rowSums(sweep(xyz, 2, c(0, 0, 1))^2))
#' people <- data.frame(id = paste0("s", 1:20), age = 1:20, sex = rep(c("F", "M"), 10))
#' balls <- lapply(1:20, function(i) xyz * (1 + 0.03 * rnorm(1) * xyz[, 1]^2 + i / 200 * bump))
#' aligned <- align(simplify2array(setNames(balls, people$id)), "ball", triangles = ball$it)
#' model <- shape_lm(aligned, ~ sex + age, people, n_perm = 199, seed = 1,
#'                   settings = model_settings(components = 3))
#' plot(model, "map", "age", unit = 10, engine = "picture", view = c(0.4, 0.3))
#' plot(model, "scores", "age")
#' @export
plot.shape_lm <- function(x, what = c("map", "scores"), term = NULL, level = NULL, unit = 1,
                          engine = drawing_engine(), view = "front",
                          legend = TRUE, main = NULL, ...) {
  validate(x)
  what <- check_choice(what, c("map", "scores"), "what")
  engine <- check_engine(engine)
  check_flags(legend)
  terms <- attr(x$models[[1]]$terms, "term.labels")
  term <- if (is.null(term)) terms[1] else check_choice(term, terms, "term")
  level <- level_of_map(x$aligned, level, what == "map")
  if (what == "scores") return(invisible(plot_lm_scores(x, term, level, main, ...)))
  given <- map_arguments(...)
  significance <- given$look$significance
  unit <- check_number(unit, "unit")
  points <- x$points[x$points$level %in% level & x$points$term %in% term, ]
  if (!NROW(points)) {
    crestline_abort("points were not tested.", "Give shape_lm() `tests` with \"points\".",
                    stage = "picture", call = NULL)
  }
  triangles <- x$aligned[[level]]$triangles
  signed <- any(!is.na(points$distance))
  adjust <- given$look$adjust
  points$p_adjusted <- held_p(points, adjust, x$aligned[[level]]$weights)
  found <- sum(points$p_adjusted <= significance, na.rm = TRUE)
  words <- sprintf("%s, %s\n%s: %s < %g (%d of %d points)", term,
                   if (signed) sprintf("along the normal for %g", unit) else
                     "root mean square displacement",
                   if (is.null(triangles)) "ringed" else "outlined", held_words[[adjust]],
                   significance, found, nrow(points))
  draw_map(points, if (signed) points$distance * unit else points$displacement, signed, triangles,
           if (is.null(main)) words else main, given, engine, view, legend)
}

#' The level that is asked for; of a map the first with triangles, if there is one
#' @param aligned List by level.
#' @noRd
level_of_map <- function(aligned, level, map) {
  levels <- names(aligned)
  if (!is.null(level)) return(check_choice(level, levels, "level"))
  surfaces <- levels[!vapply(aligned, function(one) is.null(one$triangles), NA)]
  c(if (map) surfaces, levels)[1]
}

plot_lm_scores <- function(x, term, level, main, ...) {
  model <- x$models[[level]]
  aligned <- x$aligned[[level]]
  at <- model$assign == match(term, attr(model$terms, "term.labels"))
  beta <- model$coefficients[at, , drop = FALSE]
  beta[is.na(beta)] <- 0
  axis <- colSums(beta * apply(model$matrix[, at, drop = FALSE], 2, stats::sd))
  weight <- rep(aligned$weights, ncol(aligned$mean))
  flat <- matrix(aligned$coords, length(aligned$mean))
  score <- colSums((flat - rowMeans(flat)) * axis * weight) / sqrt(sum(axis^2 * weight))
  frame <- model$frame
  variable <- if (term %in% names(frame) && is.null(dim(frame[[term]]))) frame[[term]] else
    drop(model$matrix[, at, drop = FALSE] %*% rep(1, sum(at)))
  test <- x$tests[x$tests$level == level & x$tests$term == term & x$tests$test == "shape", ]
  title <- if (!is.null(main)) {
    main
  } else {
    paste(c(paste0(term, " (", level, ")"), if (NROW(test)) {
            sprintf("R2 %.3f, p %s", test$share, format.pval(test$p_value, digits = 2, eps = 1e-4))
          }),
          collapse = ", ")
  }
  old <- graphics::par(mar = c(4, 5, 2.5, 0.6), mgp = c(2.3, 0.6, 0))
  on.exit(graphics::par(old))
  group <- if (!is.numeric(variable)) factor(variable)
  if (is.null(group)) {
    drawn_or_refused(
      graphics::plot(variable, score, xlab = term, ylab = "", las = 1, pch = 16, ...)
    )
  } else {
    box_panel(score, group, "", grDevices::hcl.colors(nlevels(group), "Dark 3"), ...)
    graphics::title(xlab = term)
  }
  graphics::title(ylab = "regression score", line = 3.6)
  graphics::title(title, font.main = 1, cex.main = 1)
  data.frame(variable = variable, score = score, row.names = names(aligned))
}
