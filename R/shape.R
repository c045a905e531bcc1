# What a shape gives: its points by level, its surface as a mesh, a summary.

#' A shape from its parts: all its fields are declared here, NULL until they are filled
#'
#' @param id,points,status,checks,paths,scheme,tracks,column,specimen As in the value of [fit_shape()].
#' @param key Of [mesh_key()]: of the mesh that the faces of its points and paths are numbers of; NULL of a template, whose points
#'   lie on no mesh.
#' @param placing Of its specimen; NULL where landmarks were placed by hand.
#' @param warnings Data frame `stage`, `class`, `problem`, `remedy`: what was warned of.
#' @param provenance List: what came from where.
#' @param sliding,trace Of [slide()].
#' @noRd
new_shape <- function(id, points, status, scheme, checks = NULL, paths = list(), tracks = NULL, column = NULL,
                      specimen = NULL, key = if (!is.null(specimen)) specimen_key(specimen), placing = specimen$placing, warnings = no_warnings(),
                      provenance = list(), sliding = NULL, trace = NULL) {
  structure(
    list(id = id, points = points, status = status, checks = checks, paths = paths, scheme = scheme, tracks = tracks,
         column = column, specimen = specimen, key = key, placing = placing, warnings = warnings, provenance = provenance,
         sliding = sliding, trace = trace),
    class = "shape"
  )
}

#' Refuse a shape that lacks fields, or whose points are not those of its scheme
#' @noRd
validate_shape <- function(x) {
  refuse <- function(problem) {
    crestline_abort(problem, "Give a shape as fit_shape() or slide() returns it, whole.", stage = "shape",
                    id = if (is.list(x) && is.character(x$id) && length(x$id) == 1) x$id, call = NULL)
  }
  fields <- c("id", "points", "status", "paths", "scheme")
  if (!is.list(x) || !all(fields %in% names(x))) refuse(sprintf("a shape has the fields %s.", shorten(fields)))
  if (!inherits(x$scheme, "curve_scheme")) refuse("the shape's `scheme` is none.")
  validate(x$scheme)
  points <- x$points
  named <- c("level", "part", "point")
  own <- is.data.frame(points) && !is.null(place_columns(points)) && is_error(points$se) &&
    all(vapply(named, function(name) identical(as.vector(points[[name]]), as.vector(x$scheme$points[[name]])), NA))
  if (!own) refuse("its `points` are not those of its scheme: a row was added or lost, or a column changed.")
  if (!is.list(x$paths) || !is.data.frame(x$status)) refuse("its `paths` or `status` are not what they were.")
  invisible(x)
}

#' @exportS3Method
validate.shape <- function(x) validate_shape(x)

#' Key of the mesh of a shape; of one that an older version kept worked out from its specimen, where it has that
#' @noRd
shape_key <- function(x) {
  if (!is.null(x$key)) return(x$key)
  if (inherits(x$specimen, "specimen")) specimen_key(x$specimen)
}

#' Refuse a shape that was not measured on a specimen's mesh, or that was changed since
#'
#' @noRd
check_shape_on <- function(shape, specimen, call = rlang::caller_env()) {
  if (is.null(shape_key(shape)) && all(is.na(shape$points$face))) {
    crestline_abort("its points lie on no mesh.", "Give a shape that fit_shape() measured, not a template or a mean.",
                    stage = "shape", id = shape$id, class = "crestline_wrong_mesh", call = call)
  }
  name <- paste("the shape", shape$id)
  check_same_mesh(shape, specimen, name)
  known <- passed_mesh(specimen$mesh, specimen$id)
  check_places(shape$points, known, name, specimen$id)
  for (path in Filter(Negate(is.null), shape$paths)) {
    validate(path)
    check_places(path, known, name, specimen$id)
  }
  invisible(shape)
}

#' Co-ordinates of a shape
#'
#' @param x A `shape`, as [fit_shape()] returns it.
#' @param level "landmarks", "curves" or "surface".
#' @param ... Ignored.
#' @return k x 3 matrix with columns x, y, z and row names "part point" (of landmarks: their names), NA where missing; in
#'   the unit of the mesh.
#' @section Errors: of class `crestline_error`, for another level.
#' @seealso [fit_shape()]
#' @examples
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "triangle")
#' shape <- fit_shape(specimen(Rvcg::vcgSphere(4), corners, id = "ball"), scheme, progress = FALSE)
#' coords(shape, "landmarks")
#' head(coords(shape, "curves"), 3)
#' @export
coords <- function(x, level, ...) {
  check_given()
  check_class(x, "shape", "x", "fit_shape()")
  UseMethod("coords")
}

#' @rdname coords
#' @export
coords.shape <- function(x, level, ...) {
  check_method_dots(..., known = "level")
  level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
  points <- x$points[x$points$level == level, ]
  names <- if (level == "landmarks") points$part else paste(points$part, points$point)
  structure(as.matrix(points[c("x", "y", "z")]), dimnames = list(names, c("x", "y", "z")))
}

#' The surface of a shape as a mesh
#'
#' The triangles of the scheme between the shape's surface points; on request denser, for a smooth picture of the
#' specimen, with all new points on its mesh.
#'
#' With `dense` = k every side of the model's quads is divided into k pieces at equal chords: along the curve that it is part
#' of (unless that would turn a triangle over), else along the shortest plane cut between its ends. Inside, cuts join
#' opposite sides. So a patch of 19 x 5 points has 37 x 9 at 2, and the model's own points are among
#' them. Neighbours share the points of their common sides: the surface has the borders of the model and no others. See
#' [patch_mesh()] for a patch by itself, with any number of columns and rows.
#'
#' @param x A `shape`, as [fit_shape()] returns it.
#' @param parts Which triangles of the scheme: "model", and names of optional parts.
#' @param specimen The `specimen` it was measured on; needed where `dense` is above 1.
#' @param dense Whole number: pieces that every side of a quad is divided into.
#' @param column_angle,column_angles,column_reach Of the cuts, as in [fit_shape()].
#' @return A `mesh3d` with normals: `vb` 4 x k, a vertex for every place that has triangles (the model's points first, in the
#'   order of `coords(x, "surface")`), and `it` 3 x m, outward. Triangles with a missing point are left out. Attributes:
#'   `row`, the row of every vertex among the shape's surface points, as in `coords(x, "surface")`, NA of the points
#'   between them; `points`, data frame `x, y, z, face, w1, w2, w3` of the vertices on the specimen's mesh; `group`, the
#'   patch or strip of every triangle, as in the scheme's `triangles`.
#' @section Errors: of class `crestline_error`, when the scheme has no such part, no triangle is left, or `dense` lacks the
#'   specimen. A warning of class `crestline_warning` tells how many triangles a hole of the specimen costs a denser surface.
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
shape_mesh <- function(x, parts = "model", specimen = NULL, dense = 1, column_angle = pi / 4, column_angles = 51,
                       column_reach = 1) {
  check_given()
  parts <- check_names(parts, "parts")
  check_class(x, "shape", "x", "fit_shape()")
  dense <- check_count(dense, "dense", upper = 1000)
  column <- check_column(column_angle, column_angles, column_reach)
  if (!is.null(specimen)) check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  triangles <- whole_triangles(x, parts)
  check_memory(3 * nrow(triangles) * as.numeric(dense)^2 * 10, dense, "dense")
  corners <- as.matrix(triangles[c("v1", "v2", "v3")])
  if (dense == 1) {
    row <- sort(unique(as.vector(corners)))
    points <- x$points[x$points$level == "surface", mesh_columns][row, ]
    return(surface_mesh(points, row, matrix(match(t(corners), row), 3), triangles$group))
  }
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen(): a denser surface needs it")
  check_shape_on(x, specimen)
  quads <- whole_quads(x, parts)
  divided <- divide_quads(x, specimen, quads, dense, column)
  there <- !is.na(divided$points$x)
  whole <- colSums(matrix(there[divided$it], 3)) == 3
  if (!all(whole)) warn_left_out(sum(!whole), length(whole), x$id)
  used <- sort(unique(as.vector(divided$it[, whole])))
  surface_mesh(divided$points[used, mesh_columns], divided$points$row[used], matrix(match(divided$it[, whole], used), 3),
               quads$group[divided$quad[whole]])
}

#' The triangles of some parts of a shape's surface that have all their points
#' @noRd
whole_triangles <- function(x, parts) {
  triangles <- x$scheme$triangles
  check_choices(parts, unique(c("model", triangles$part)), "parts")
  there <- !is.na(coords(x, "surface")[, 1])
  triangles <- triangles[triangles$part %in% parts, ]
  triangles <- triangles[there[triangles$v1] & there[triangles$v2] & there[triangles$v3], ]
  if (nrow(triangles) == 0) {
    crestline_abort("no triangle of the surface has all its points.", "See `status` for what is missing.",
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
  mesh <- rgl::mesh3d(vertices = unname(rbind(t(as.matrix(points[c("x", "y", "z")])), 1)), triangles = it)
  structure(with_normals(mesh), row = row, points = points, group = group)
}

warn_left_out <- function(n, of, id) {
  crestline_warn(sprintf("%d of %d triangles of the denser surface are left out: no cut leads to their points.", n, of),
                 "Fill the holes of the specimen there, or try a greater `column_angle` or `column_reach`.",
                 stage = "shape", id = id)
}

#' @export
as.data.frame.shape <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$points
}

#' @export
print.shape <- function(x, most = 8, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  cat("<shape> ", x$id, ", by the scheme ", x$scheme$name, "\n", sep = "")
  for (level in c("landmarks", "curves", "surface")) {
    points <- x$points[x$points$level == level, ]
    status <- x$status[x$status$level == level, ]
    what <- switch(level, surface = "patches", level)
    if (nrow(status)) cat("  ", sum(status$ok), " of ", nrow(status), " ", what, if (level != "landmarks") {
      sprintf(" with %d of %d points", sum(!is.na(points$x)), nrow(points))
    }, "\n", sep = "")
  }
  print_placing(x$placing)
  said <- x$status[!is.na(x$status$reason), ]
  for (i in utils::head(seq_len(nrow(said)), most)) {
    cat(strwrap(paste0("- ", said$part[i], ": ", said$reason[i]), width = 80, exdent = 4), sep = "\n")
  }
  if (nrow(said) > most) cat("- and", nrow(said) - most, "more in status\n")
  unused <- if (!is.null(x$specimen)) unused_names(x$specimen$landmarks, x$scheme)
  if (!is.null(unused)) unused <- strwrap(paste0("- landmarks ", unused), width = 80, exdent = 4)
  if (length(unused)) cat(unused, sep = "\n")
  invisible(x)
}
