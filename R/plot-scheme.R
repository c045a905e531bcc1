# Pictures that help to write a scheme: suggested landmarks, and every row of a scheme.

#' Plot suggested landmarks
#'
#' Draws the surface by its shape index with the places of [suggest_landmarks()] and their names.
#' Caps are red, cups green, crossings violet and ends black.
#'
#' @param x Suggestions, as [suggest_landmarks()] returns them.
#' @param mesh The specimen or mesh that they were suggested for.
#' @param surface Quantity that the colours of the surface show, as `colour` of [plot.specimen()].
#' @param ... Arguments of [plot.specimen()], such as `view`, `engine` and `legend`, and of
#'   [draw_surface()].
#' @return The scene of [draw_surface()]; invisibly, if it is not a widget.
#' @section Errors: of class `crestline_wrong_mesh`: the suggestions belong to another mesh.
#' @template glossary
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' plot(suggest_landmarks(humface, 10), humface, engine = "picture")
#' }
#' @export
plot.suggested_landmarks <- function(x, mesh, surface = "shape index", ...) {
  check_given()
  check_class(x, "suggested_landmarks", "x", "suggest_landmarks()")
  check_surface(mesh, "mesh")
  check_same_mesh(x, mesh, "`x`")
  if (!inherits(mesh, "specimen")) mesh <- specimen(mesh, outward = "keep", debris = 0)
  scene <- plot(mesh, surface, landmarks = FALSE, radius = attr(x, "radius"), ...)
  colour <- c(cap = "#C8102E", cup = "#1B9E77", crossing = "#3060C0", end = "#202020")
  for (kind in intersect(names(colour), x$kind)) {
    own <- as.data.frame(x)[x$kind == kind, ]
    scene <- draw_points(scene, own, colour[[kind]], halo = "white", labels = own$landmark)
  }
  shown(scene)
}

#' Plot the rows of a scheme that was checked
#'
#' Draws a picture of every curve and patch that [check_scheme()] fitted: the surface about it, its
#' band of two standard errors, its points and its landmarks. The title has the colour of its grade.
#'
#' @param x Value of [check_scheme()].
#' @param parts Names of the curves and patches that are drawn. NULL: all.
#' @param columns Number of pictures in a row. NULL: as many as rows, about.
#' @param margin As of [picture_settings()].
#' @param engine "picture": a picture of every part. "widget": one scene that turns in the browser,
#'   with a tick for every part, in the colour of its grade. See [draw_surface()]. "rgl" draws as
#'   "picture".
#' @param ... Arguments of [draw_surface()], such as `view`.
#' @return `x`, invisibly; with the engine "widget" the scene.
#' @section Errors: of class `crestline_error`: there is no part of a name.
#' @template glossary
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' checked <- check_scheme(face_scheme(), face)
#' plot(checked, parts = checked$part[1:4])
#' }
#' @export
plot.scheme_check <- function(x, parts = NULL, columns = NULL, margin = 0.3, engine = "picture",
                              ...) {
  check_class(x, "scheme_check", "x", "check_scheme()")
  engine <- check_engine(engine)
  if (is.null(parts)) parts <- unique(x$part)
  parts <- check_choices(parts, unique(x$part), "parts")
  rows <- which(x$part %in% parts)
  if (engine == "widget") return(scheme_scene(x[rows, ], attr(x, "shape"), ...))
  if (is.null(columns)) columns <- ceiling(sqrt(length(rows)))
  columns <- check_count(columns, "columns")
  old <- graphics::par(mfrow = c(ceiling(length(rows) / columns), columns),
                       mar = c(0.2, 0.2, 1.2, 0.2))
  on.exit(graphics::par(old))
  for (i in rows) draw_scheme_row(x[i, ], attr(x, "shape"), margin, ...)
  invisible(x)
}

#' All rows as one scene, each a layer
#' @noRd
scheme_scene <- function(rows, shape, ..., view = "front") {
  marks <- shape$specimen$landmarks
  scene <- draw_surface(shape$specimen, "#E3CDB8", posed_view(view, marks), "widget", ...)
  draw_landmarks(scene, marks, FALSE)
  for (i in seq_len(nrow(rows))) {
    in_layer(scene, rows$part[i])
    colour <- grade_colours[[as.character(rows$grade[i])]]
    path <- if (rows$level[i] == "curves") shape$paths[[rows$part[i]]]
    if (!is.null(path)) draw_lines(scene, path, colour, 3, name = rows$part[i])
    own <- shape$points[shape$points$level == rows$level[i] & shape$points$part == rows$part[i] &
                          !is.na(shape$points$x), ]
    if (nrow(own)) draw_points(scene, own, colour, 0.5, name = paste(own$part, own$point))
  }
  draw_key(scene, grade_colours[names(grade_colours) %in% rows$grade])
}

#' One row of a scheme: the surface about it, and what was found
#' @noRd
draw_scheme_row <- function(row, shape, margin, ..., view = "front") {
  specimen <- shape$specimen
  own <- shape$points[shape$points$level == row$level & shape$points$part == row$part &
                      !is.na(shape$points$x), ]
  title <- function() {
    graphics::title(row$part, cex.main = 0.8, col.main = grade_colours[[as.character(row$grade)]])
  }
  if (!nrow(own)) {
    graphics::plot.new()
    graphics::text(0.5, 0.5, "not there")
    return(title())
  }
  scene <- draw_surface(specimen, "#E3CDB8", posed_view(view, specimen$landmarks), "picture",
                        around = own, margin = margin, ...)
  one <- shape
  curves <- if (row$level == "curves") row$part else bounding_curves(row$part, shape$scheme)
  one$paths <- shape$paths[intersect(names(shape$paths), curves)]
  if (row$level == "surface") scene <- draw_points(scene, own, "white", 0.4, "#404040A0")
  scene <- draw_shape_curves(scene, one, specimen, kind_colours, 2, row$level == "curves")
  marks <- specimen$landmarks[!is.na(specimen$landmarks[, 1]), , drop = FALSE]
  marks <- marks[is_shown(scene, marks), , drop = FALSE]
  if (nrow(marks)) draw_points(scene, marks, "black", 0.8, "white", labels = rownames(marks))
  title()
}

#' Which points lie within the frame of a picture
#' @noRd
is_shown <- function(scene, x) {
  at <- view_points(scene, x)
  at[, 1] >= scene$usr[1] & at[, 1] <= scene$usr[2] & at[, 2] >= scene$usr[3] &
    at[, 2] <= scene$usr[4]
}
