# A whole shape: its curves on the specimen, or its surface as a model.

#' Plot a shape
#'
#' Draws the curves and landmarks of a shape on its specimen, with bands of two standard errors at
#' their points. Or draws the points of its patches as a surface with the edges of its triangles.
#'
#' @template shape
#' @param specimen The [specimen()] that the shape was measured on. NULL: the shape's own surface is
#'   drawn.
#' @param parts Parts of the surface, as in [shape_mesh()].
#' @param colour Colours of curves, named "ridge", "valley" and "plane"; by default red, blue and
#'   black.
#' @param surface With a specimen: quantity that its colours show, as `colour` of [plot.specimen()].
#'   For the shape's own surface: one colour; a colour or a number for each surface point, or for
#'   each vertex of [shape_mesh()]; or "patch" for one colour for each patch. Numbers have a scale
#'   of colours in the right margin (not by "rgl").
#' @param legend Whether to draw the scale of colours and the key of the curves (not by "rgl").
#' @param engine,view As in [plot.specimen()] and [draw_surface()].
#' @param ... Further arguments, each with a default:
#'   * `band`: whether to draw the bands (TRUE);
#'   * `points`: whether to draw the points of the curves (TRUE);
#'   * `patches`: whether to draw the points of the surface, small, on the specimen (as `points`);
#'   * `width`: line width of curves (2);
#'   * `palette`: colours of numbers, from the least to the greatest, and `unit`, what they are, for
#'     the legend; with a specimen the `palette` of [plot.specimen()];
#'   * `edges`: colour of the edges of the shape's own surface, NA for none;
#'   * those of [plot.specimen()] and [draw_surface()].
#' @return The scene of [draw_surface()], invisibly.
#' @template glossary
#' @seealso [fit_shape()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' shape <- fit_shape(face, face_scheme())
#' plot(shape, face, engine = "picture")
#' plot(shape, engine = "picture")
#' }
#' @export
plot.shape <- function(x, specimen = NULL, parts = "model", colour = kind_colours,
                       surface = if (is.null(specimen)) "#E3CDB8" else "shape index",
                       legend = TRUE, engine = drawing_engine(),
                       view = "front", ...) {
  check_class(x, "shape", "x", "fit_shape()")
  view <- posed_view(view, coords(x, "landmarks"), x$scheme)
  given <- list(...)
  own <- names(given) %in% names(formals(shape_look))
  look <- do.call(shape_look, given[own], quote = TRUE)
  more <- c(list(engine = engine, view = view, legend = legend), given[!own])
  if (is.null(specimen)) {
    model <- shape_mesh(x, parts)
    # Values of all surface points, as write_mesh() takes them: those that have triangles.
    every <- length(surface) > 1 && length(surface) == sum(x$points$level == "surface")
    if (every) surface <- surface[attr(model, "row")]
    if (identical(engine, "picture") && is.null(given$around)) more$around <- shown_places(x, model)
    scene <- do.call(draw_values, c(list(model, surface, look$edges), more), quote = TRUE)
  } else {
    check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
    check_shape_on(x, specimen)
    scene <- do.call(plot, c(list(specimen, surface, landmarks = FALSE), more),
                     quote = TRUE)
  }
  patch <- x$points[x$points$level == "surface" & !is.na(x$points$x), ]
  if (look$patches && !is.null(specimen) && nrow(patch)) {
    scene <- draw_points(in_layer(scene, "surface points"), patch, "white", 0.35, "#40404080",
                         name = paste(patch$part, patch$point))
  }
  scene <- draw_shape_curves(scene, x, if (look$band) specimen, colour, look$width, look$points)
  marks <- coords(x, "landmarks")
  scene <- draw_points(in_layer(scene, "landmarks"), marks[!is.na(marks[, 1]), , drop = FALSE],
                       "black", halo = "white")
  if (legend && !is.null(specimen)) draw_key(scene, unlist(colour), width = look$width)
  shown(scene)
}

#' All that a picture of a shape's own surface is to hold, n x 3: curves may rise above the patches
#' @noRd
shown_places <- function(x, model) {
  paths <- lapply(Filter(Negate(is.null), x$paths), columns_of, c("x", "y", "z"))
  marks <- coords(x, "landmarks")
  rows <- c(list(t(model$vb[1:3, ]), marks[!is.na(marks[, 1]), , drop = FALSE]), paths)
  unname(do.call(rbind, lapply(rows, unname)))
}

#' How the curves and points of a shape look
#' @noRd
shape_look <- function(edges = "#00000070", band = TRUE, points = TRUE, patches = points,
                       width = 2) {
  check_flags(band, points, patches)
  list(edges = edges, band = band, points = points, patches = patches,
       width = check_number(width, "width", lower = 0))
}

#' The curves of a shape, by kind
#'
#' @param specimen The specimen on which bands of standard error are drawn; NULL: none are.
#' @noRd
draw_shape_curves <- function(scene, x, specimen, colour, width, points) {
  kind <- stats::setNames(x$scheme$curves$kind, x$scheme$curves$curve)
  for (name in names(Filter(Negate(is.null), x$paths))) {
    paint <- colour[[kind[[name]]]]
    path <- x$paths[[name]]
    own <- x$points[x$points$level == "curves" & x$points$part == name & !is.na(x$points$x), ]
    if (!is.null(specimen)) {
      s <- arc_lengths_on(path, columns_of(own)[, 1:3, drop = FALSE],
                          1e-6 * mesh_diagonal(specimen$mesh))
      on_curve <- list(path = path, points = data.frame(s = s, se = own$se)[!is.na(s), ])
      scene <- draw_curve_band(in_layer(scene, "bands of error"), on_curve, specimen$mesh, paint)
    }
    scene <- draw_lines(in_layer(scene, "curves"), path, paint, width, halo = "white", name = name)
    if (points) {
      scene <- draw_points(in_layer(scene, "points of curves"), own, paint, 0.28 * width, "white",
                           name = paste(name, own$point))
    }
  }
  scene
}

#' The surface of a shape, with the scale of its colours where these stand for numbers
#' @noRd
draw_values <- function(model, surface, edges, engine, view, legend, ..., palette = NULL,
                        unit = "as given") {
  if (is.null(palette)) palette <- grDevices::hcl.colors(11, "Viridis")
  palette <- check_colour(palette, "palette")
  scaled <- legend && is.numeric(surface) && any(is.finite(surface))
  colour <- surface_colours(model, surface, palette)
  if (!scaled) return(draw_model(model, colour, edges, engine, view, ...))
  if (engine == "picture") {
    old <- graphics::par(mar = c(0.5, 0.5, 0.5, 6))
    on.exit(graphics::par(old))
  }
  scene <- draw_model(model, colour, edges, engine, view, ...)
  limits <- range(surface[is.finite(surface)])
  if (limits[2] <= limits[1]) limits <- limits[1] + 0:1
  map_legend(scene, palette, limits, unit)
}

#' The surface of a shape with the edges of its triangles
#'
#' @param inside Colour of its inside.
#' @noRd
draw_model <- function(mesh, colour, edges, engine, view, ..., inside = "#8C7F76") {
  # A model is open: what is seen of its inside is drawn, or one would look through it at the far
  # side's edges.
  scene <- if (engine == "picture") {
    draw_surface(mesh, colour, view, engine, inside = inside, ...)
  } else {
    draw_surface(mesh, colour, view, engine, ...)
  }
  if (is.na(edges)) scene else draw_edges(in_layer(scene, "triangles"), mesh, edges, 0.5)
}

#' The edges of the triangles of a mesh, each once
#'
#' @param raised How far along the normals they are drawn, as a share of the mesh's diagonal: long
#'   edges run below the surface that their ends lie on.
#' @noRd
draw_edges <- function(scene, mesh, colour, width, raised = 0) {
  side <- cbind(mesh$it[1:2, ], mesh$it[2:3, ], mesh$it[c(3, 1), ])
  side <- unique(t(apply(side, 2, sort)))
  xyz <- t(mesh$vb[1:3, ] + raised * mesh_diagonal(mesh) * mesh$normals[1:3, ])
  ends <- array(c(xyz[side[, 1], ], xyz[side[, 2], ], rep(NA, 3 * nrow(side))), c(nrow(side), 3, 3))
  gaps <- matrix(aperm(ends, c(3, 1, 2)), ncol = 3)
  draw_lines(scene, gaps, colour, width)
}
