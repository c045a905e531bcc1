# Two visits as a picture: the change of each point on the surface of the first.

#' Plot the change between two visits
#'
#' Draws the surface of the first visit, coloured by the change along its normal. Points that
#' changed beyond the family-wise limit are outlined. Where a point is missing at one of the visits,
#' the surface is grey; where it is missing at the first, there is none.
#'
#' @param x A `visit_comparison`, as of [compare_visits()].
#' @param what "change": along the normal, outward positive, in the unit of the mesh; "score":
#'   change over its standard error.
#' @param limits Two numbers: the values of the first and the last colour. `NULL`: symmetric about
#'   0, as far as the largest value, and at least to the family-wise limit (of a change: that many
#'   median standard errors), so that errors alone do not fill the scale.
#' @param palette Colours from the lowest to the highest value.
#' @param view As in [plot.shape()]; "front" is the front of the first visit.
#' @param main Title; `NULL`: one that names the visits.
#' @param engine See [draw_surface()].
#' @param legend TRUE: a scale of the colours.
#' @param ... Settings of the picture, see [picture_settings()].
#' @return `x`, invisibly; with the engine "widget" the scene.
#' @section Errors: of class `crestline_error`: an argument is out of its range; no point was
#'   assessed (score); the scheme has no surface.
#' @template glossary
#' @template experimental
#' @seealso [compare_visits()]; its page: [write_page()]
#' @examples
#' \donttest{
#' lesion <- data.frame(height = 3, radius = 15, visit = 2)
#' cohort <- simulate_cohort(1, lesions = lesion, visits = 2, seed = 1)
#' plot(compare_visits(cohort$sample[[1]], cohort$second[[1]]))
#' }
#' @export
plot.visit_comparison <- function(x, what = c("change", "score"), limits = NULL,
                                  palette = c("#2166AC", "#F7F7F7", "#B2182B"), view = "front",
                                  main = NULL, engine = drawing_engine(), legend = TRUE, ...) {
  check_class(x, "visit_comparison", "x", "compare_visits()")
  what <- check_choice(what, c("change", "score"), "what")
  engine <- check_engine(engine)
  check_flags(legend)
  if (!is.null(limits)) limits <- check_numbers(limits, "limits", 2)
  palette <- grDevices::colorRampPalette(check_colour(palette, "palette"))(101)
  points <- x$points[x$points$level == "surface", ]
  if (all(is.na(points[[what]]))) {
    crestline_abort(sprintf("no point of the surface has a %s.", what),
                    if (what != "score") "Compare visits whose scheme has a surface." else
                      "Give compare_visits() an `error`, or plot the change.",
                    stage = "picture", id = x$ids[2], call = NULL)
  }
  if (is.null(limits)) {
    least <- x$limit * if (what == "score") 1 else stats::median(points$se, na.rm = TRUE)
    limits <- c(-1, 1) * max(abs(points[[what]]), least, na.rm = TRUE)
  }
  # The outline is where p_adjusted crosses 0.5: 0.25 beyond the limit, 1 elsewhere
  points$p_adjusted <- ifelse(points$called, 0.25, 1)
  if (is.null(main)) {
    main <- sprintf("%s less %s\n%s", x$ids[2], x$ids[1],
                    c(change = "change along the normal", score = "change over its error")[[what]])
  }
  unit <- if (what == "score") "standard errors" else
    if (x$unit == "unit") "unit of the mesh" else x$unit
  look <- list(significance = 0.5, limits = limits, palette = palette, length_unit = unit)
  scene <- draw_map(points, points[[what]], TRUE, x$triangles, main,
                    list(look = look, more = list(...)), engine,
                    if (identical(view, "front")) x$front else view, legend)
  if (engine == "widget") scene else invisible(x)
}
