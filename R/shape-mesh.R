# The surface of a shape as a mesh.

#' The surface of a shape as a mesh
#'
#' Makes a mesh of the scheme's triangles between the shape's surface points. With `dense` it is
#' denser, for a smooth picture of the specimen. All new points lie on the specimen's mesh.
#'
#' With `dense = k` every side of the model's quads is divided into k pieces at equal chords. A side
#' that is part of a curve is divided along the curve, unless that would turn a triangle over. Other
#' sides are divided along the shortest plane cut between their ends. Inside a quad, cuts join
#' opposite sides. So a patch of 19 x 5 points has 37 x 9 points with `dense = 2`, and the model's
#' own points are among them. Neighbouring patches share the points of their common sides: the
#' surface has no further borders. See [patch_mesh()] for one patch with any number of columns and
#' rows.
#'
#' @template shape
#' @param parts Triangles of the scheme: "model", or names of optional parts, or both.
#' @param specimen The [specimen()] that the shape was measured on. Needed if `dense` is above 1.
#' @param dense Number of pieces into which every side of a quad is divided; a whole number.
#' @param measuring Settings of the cuts: `column_angle`, `column_angles`, `column_reach` of
#'   [shape_settings()]. Its other fields are not used here.
#' @param ... These three, the former form. They give a message of class `crestline_deprecated`.
#' @return A `mesh3d` with normals. `vb` (4 x k) has a vertex for every place that has triangles, in
#'   the unit of the specimen's mesh. The model's points come first, in the order of `coords(x,
#'   "surface")`. `it` (3 x m) has the triangles, outward; triangles with a missing point are left
#'   out. Attributes:
#'   * `row`: row of every vertex in `coords(x, "surface")`; NA for the points between;
#'   * `points`: data frame `x`, `y`, `z`, `face`, `w1`, `w2`, `w3` of the vertices on the
#'     specimen's mesh;
#'   * `group`: patch or strip of every triangle, as in the scheme's `triangles`.
#' @section Errors: of class `crestline_error`: the scheme has no such part, no triangle is left, or
#'   `dense` is above 1 without a specimen. Warnings of class `crestline_warning` of a denser
#'   surface give the number of triangles that are lost at holes. They also name the parts with
#'   triangles that are turned over.
#' @template glossary
#' @seealso [fit_shape()]; [write_mesh()] to save it
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' shape <- fit_shape(face, face_scheme(), ridge_settings(error = FALSE))
#' shape_mesh(shape)
#' draw_surface(shape_mesh(shape, specimen = face, dense = 2), engine = "picture")
#' }
#' @export
shape_mesh <- function(x, parts = "model", specimen = NULL, dense = 1,
                       measuring = shape_settings(), ...) {
  check_given()
  column <- column_settings(measuring_with_former(measuring, ...))
  parts <- check_names(parts, "parts")
  check_class(x, "shape", "x", "fit_shape()")
  dense <- check_count(dense, "dense", upper = 1000)
  if (!is.null(specimen)) {
    check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  }
  triangles <- whole_triangles(x, parts)
  check_memory(3 * nrow(triangles) * as.numeric(dense)^2 * 10, dense, "dense")
  corners <- as.matrix(triangles[c("v1", "v2", "v3")])
  if (dense == 1) {
    row <- sort(unique(as.vector(corners)))
    points <- x$points[x$points$level == "surface", mesh_columns][row, ]
    return(surface_mesh(points, row, matrix(match(t(corners), row), 3), triangles$group))
  }
  check_class(specimen, "specimen", "specimen",
              "specimen() or read_specimen(): a denser surface needs it")
  check_shape_on(x, specimen)
  quads <- whole_quads(x, parts)
  divided <- divide_quads(x, specimen, quads, dense, column)
  there <- !is.na(divided$points$x)
  whole <- colSums(matrix(there[divided$it], 3)) == 3
  if (!all(whole)) warn_left_out(sum(!whole), length(whole), x$id)
  used <- sort(unique(as.vector(divided$it[, whole])))
  mesh <- surface_mesh(divided$points[used, mesh_columns], divided$points$row[used],
                       matrix(match(divided$it[, whole], used), 3),
                       quads$group[divided$quad[whole]])
  warn_turned(mesh, specimen$mesh, x$id)
  mesh
}

#' The triangles of some parts of a shape's surface that have all their points
#' @noRd
whole_triangles <- function(x, parts) {
  check_choices(parts, unique(c("model", x$scheme$triangles$part)), "parts")
  triangles <- triangles_there(x$scheme$triangles, x$points, parts)
  if (nrow(triangles) == 0) {
    crestline_abort("no triangle of the surface has all its points.",
                    "See `status` for what is missing.",
                    stage = "shape", id = x$id)
  }
  triangles
}

#' The quads of those triangles; a quad with one corner missing is a triangle, with a corner twice
#' @noRd
whole_quads <- function(x, parts) {
  quads <- scheme_quads(x$scheme$patches, x$scheme$strips, x$scheme$points)
  quads <- quads[quads$part %in% parts, ]
  there <- !is.na(coords(x, "surface")[, 1])
  quads$b <- ifelse(there[quads$b], quads$b, quads$a)
  quads$d <- ifelse(there[quads$d], quads$d, quads$c)
  different <- (quads$a != quads$b & quads$b != quads$c) | (quads$c != quads$d & quads$d != quads$a)
  quads[there[quads$a] & there[quads$c] & quads$a != quads$c & different, ]
}

surface_mesh <- function(points, row, it, group) {
  rownames(points) <- NULL
  mesh <- rgl::mesh3d(vertices = unname(rbind(t(as.matrix(points[c("x", "y", "z")])), 1)),
                      triangles = it)
  structure(with_normals(mesh), row = row, points = points, group = group)
}

warn_left_out <- function(n, of, id) {
  crestline_warn(sprintf(paste("%d of %d triangles of the denser surface are left out: no cut",
                               "leads to their points."),
                         n, of),
                 paste("Fill the holes of the specimen there, or try a greater `column_angle`",
                       "or `column_reach`."),
                 stage = "shape", id = id)
}

warn_turned <- function(dense, scan, id) {
  normals <- t(path_normals(scan, attr(dense, "points")))
  turned <- flipped_triangles(t(dense$vb[1:3, ]), dense$it, normals)
  if (!length(turned)) return(invisible())
  crestline_warn(sprintf("%d of %d triangles of the denser surface are turned over: in %s.",
                         length(turned), ncol(dense$it),
                         shorten(unique(attr(dense, "group")[turned]))),
                 "Look there: a curve may swing aside, or two curves all but meet.",
                 stage = "shape", id = id)
}

#' @exportS3Method
written_mesh.shape <- function(x, parts) shape_mesh(x, parts)
