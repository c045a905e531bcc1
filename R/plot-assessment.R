# One face against a norm as a picture: its maps on its own surface.

#' Plot a face against its norms
#'
#' Draws the face of an assessment, coloured by one of its maps. Places beyond the limit of the map
#' are outlined. The surface is grey where points are missing in the scan; it is made up there by
#' its surroundings.
#'
#' @param x An `assessment`, as of [assess()].
#' @param what "map": z of each point; "scan": z of the scan, the radius that gives most; "healed":
#'   the distance that healing took away; "distance": the distance from the expected face; both in
#'   the unit of the mesh; "asymmetry": z of the asymmetry scan, on one side.
#' @param limits Two numbers: the values of the first and the last colour. `NULL`: symmetric about
#'   0, as far as the largest value, and of a z at least to the limit of the map.
#' @param palette Colours from the lowest to the highest value.
#' @param view As in [plot.shape()].
#' @param main Title; `NULL`: one that names the map.
#' @param engine See [draw_surface()].
#' @param legend TRUE: a scale of the colours.
#' @param ... Settings of the picture, see [picture_settings()].
#' @return `x`, invisibly; with the engine "widget" the scene.
#' @section Errors: of class `crestline_error`: an argument is out of its range, or the norm has no
#'   asymmetry.
#' @template glossary
#' @template experimental
#' @seealso [assess()]
#' @examples
#' \donttest{
#' cohort <- simulate_cohort(120, ages = c(5, 15), seed = 1)
#' norms <- fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data,
#'                    settings = norm_settings(folds = 2))
#' people <- data.frame(age = 10, sex = "female")
#' patient <- simulate_cohort(1, data = people, lesions = data.frame(height = 6, radius = 15),
#'                            seed = 2)
#' plot(assess(patient$sample[[1]], norms, age = 10, sex = "female"), "scan")
#' }
#' @export
plot.assessment <- function(x, what = c("map", "scan", "healed", "distance", "asymmetry"),
                            limits = NULL, palette = c("#2166AC", "#F7F7F7", "#B2182B"),
                            view = "front", main = NULL, engine = drawing_engine(),
                            legend = TRUE, ...) {
  check_class(x, "assessment", "x", "assess()")
  names <- c("map", "scan", "healed", "distance", "asymmetry")
  what <- check_choice(what, names, "what")
  engine <- check_engine(engine)
  check_flags(legend)
  if (!is.null(limits)) limits <- check_numbers(limits, "limits", 2)
  palette <- grDevices::colorRampPalette(check_colour(palette, "palette"))(101)
  points <- x$points
  value <- points[[switch(what, map = "z_map", scan = "z_scan", asymmetry = "z_asymmetry", what)]]
  if (all(is.na(value))) {
    crestline_abort(sprintf("there is no map \"%s\".", what), "Choose another of `what`.",
                    stage = "picture", id = x$id, call = NULL)
  }
  most <- if (what %in% names(x$limits)) x$limits[[what]] else Inf
  if (is.null(limits) && is.finite(most)) {
    limits <- c(-1, 1) * max(abs(value), most, na.rm = TRUE)
  }
  # The outline is where p_adjusted crosses 0.5: 0.25 beyond the limit, 1 elsewhere.
  points$p_adjusted <- ifelse(!is.na(value) & abs(value) > most, 0.25, 1)
  title <- c(map = "z of each point", scan = "does each place fit the rest of the face: z",
             healed = "taken away by healing", distance = "distance from the expected face",
             asymmetry = "asymmetry against the norm's: z")[[what]]
  if (is.null(main)) main <- sprintf("%s\n%s", x$id, title)
  unit <- if (!what %in% c("healed", "distance")) "z" else
    if (x$unit == "unit") "unit of the mesh" else x$unit
  look <- list(significance = 0.5, limits = limits, palette = palette, length_unit = unit)
  scene <- draw_map(points, value, TRUE, x$triangles, main, list(look = look, more = list(...)),
                    engine, view, legend)
  if (engine == "widget") scene else invisible(x)
}
