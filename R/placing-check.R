# Whether found landmarks can be trusted, and the picture that shows them.

#' Check found landmarks, or refuse the specimen
#'
#' Measurements from wrong landmarks look normal. This function stops with an error that names the
#' specimen if too many of its found landmarks are doubtful. With `picture` it saves a picture of
#' the landmarks. [fit_shapes()] calls it for meshes without landmarks. `plot(specimen, what =
#' "placing")` draws the picture.
#'
#' @param specimen A [specimen()] of [find_landmarks()].
#' @param least Least confidence of a found landmark (0 to 1); below it the landmark is doubtful.
#' @param doubtful Greatest share of the found landmarks that may be doubtful.
#' @param picture Path of a `.png` file that is written if the specimen is refused. NULL: none.
#' @return The specimen, unchanged. Doubtful landmarks are not removed.
#' @section Errors: of class `crestline_placing_error` (a `crestline_error`): too many landmarks are
#'   doubtful. The error gives the specimen's name, the landmarks, and the picture's path.
#' @template glossary
#' @seealso [find_landmarks()]; [plot.specimen()] for the picture; [review_landmarks()] to correct
#'   landmarks by hand
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' face <- find_landmarks(humface, id = "humface")
#' check_placing(face)
#' plot(face, what = "placing")
#' }
#' @export
check_placing <- function(specimen, least = 0.5, doubtful = 0, picture = NULL) {
  check_given()
  least <- check_number(least, "least", 0, 1)
  doubtful <- check_number(doubtful, "doubtful", 0, 1)
  placing <- placing_of(specimen)
  if (!is.null(picture)) check_path_to_write(picture, "picture", "png")
  found <- placing$state %in% c("found", "placed")
  low <- found & !is.na(placing$confidence) & placing$confidence < least
  if (any(found) && sum(low) <= doubtful * sum(found)) return(specimen)
  if (!is.null(picture)) write_placing(specimen, picture, least)
  named <- paste0(placing$landmark[low], " (", round(placing$confidence[low], 2), ")")
  problem <- if (any(found)) {
    sprintf("%d of %d found landmarks are doubtful: %s.", sum(low), sum(found), shorten(named))
  } else {
    "none of its landmarks was found."
  }
  remedy <- paste0("Correct them (review_landmarks()), calibrate the template ",
                   "(calibrate_template()), or allow more (`doubtful`).")
  crestline_abort(problem, paste0(if (!is.null(picture)) sprintf("Look at %s. ", picture), remedy),
                  stage = "landmarks", id = specimen$id,
                  class = c("crestline_placing_error", "crestline_landmark_error"), call = NULL)
}

placing_of <- function(specimen) {
  check_class(specimen, "specimen", "specimen", "find_landmarks()")
  if (is.null(specimen$placing)) {
    crestline_abort("the landmarks of `specimen` were not found but given.",
                    "Give a specimen of find_landmarks().", stage = "landmarks",
                    id = specimen$id)
  }
  specimen$placing
}

#' The landmarks of find_landmarks() from several sides, by their confidence
#'
#' @param views Directions to look from: how far the viewer goes round to the subject's left, in
#'   radians, in the frame of the template.
#' @return The specimen, invisibly.
#' @noRd
draw_placing <- function(specimen, least = 0.5, views = c(-0.7, 0, 0.7), ..., engine = "picture") {
  least <- check_number(least, "least", 0, 1)
  views <- check_numbers(views, "views")
  placing <- placing_of(specimen)
  at <- as.matrix(placing[c("x", "y", "z")])
  sure <- placing$state == "placed" & is.na(placing$confidence) |
    placing$state %in% c("found", "placed") & placing$confidence >= least
  colour <- ifelse(placing$state == "predicted", "#3060C0", ifelse(sure, "#1B9E77", "#C8102E"))
  title <- sprintf("%s: score %.2f", specimen$id, specimen$match$score)
  engine <- check_engine(engine)
  if (engine == "widget") {
    scene <- draw_surface(specimen$mesh, "#E3CDB8", t(specimen$match$rotation), engine, ...)
    words <- sprintf("%s: %s, confidence %.2f", placing$landmark, placing$state, placing$confidence)
    draw_points(in_layer(scene, "landmarks"), at, colour, labels = placing$landmark, name = words)
    draw_key(scene, c(found = "#1B9E77", doubtful = "#C8102E", predicted = "#3060C0"))
    return(draw_title(scene, title))
  }
  old <- graphics::par(mfrow = c(1, length(views)), mar = c(0.5, 0.5, 2, 0.5))
  on.exit(graphics::par(old))
  for (round in views) {
    turn <- rbind(c(cos(round), 0, -sin(round)), c(0, 1, 0), c(sin(round), 0, cos(round)))
    scene <- draw_surface(specimen$mesh, "#E3CDB8", turn %*% t(specimen$match$rotation), "picture",
                          ...)
    for (one in unique(colour)) {
      draw_points(scene, at[colour == one, , drop = FALSE], one, halo = "white",
                  labels = placing$landmark[colour == one])
    }
    if (round == views[1]) graphics::title(title, adj = 0)
  }
  invisible(specimen)
}

write_placing <- function(specimen, file, least, size = c(1800, 750)) {
  grDevices::png(file, size[1], size[2], res = 120)
  on.exit(grDevices::dev.off())
  draw_placing(specimen, least)
}
