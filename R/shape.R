# What a shape gives: its points by level, its surface as a mesh, a summary.

#' Co-ordinates of a shape
#'
#' @param x A `shape`, as [fit_shape()] returns it.
#' @param level "landmarks", "curves" or "surface".
#' @param ... Ignored.
#' @return k x 3 matrix with columns x, y, z and row names "part point" (of landmarks: their names), NA where missing; in
#'   the unit of the mesh.
#' @section Errors: of class `crestline_error`, for another level.
#' @seealso [fit_shape()], with an example
#' @export
coords <- function(x, level, ...) UseMethod("coords")

#' @rdname coords
#' @export
coords.shape <- function(x, level, ...) {
  level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
  points <- x$points[x$points$level == level, ]
  names <- if (level == "landmarks") points$part else paste(points$part, points$point)
  structure(as.matrix(points[c("x", "y", "z")]), dimnames = list(names, c("x", "y", "z")))
}

#' The surface of a shape as a mesh
#'
#' @param x A `shape`, as [fit_shape()] returns it.
#' @param parts Which triangles of the scheme: "model", and names of optional parts.
#' @return A `mesh3d` with normals: `vb` 4 x k, a vertex for every place that has triangles, and `it` 3 x m. Triangles
#'   with a missing point are left out. Attribute `row`: the row of every vertex among the shape's surface points, as in
#'   `coords(x, "surface")`.
#' @section Errors: of class `crestline_error`, when the scheme has no such part, or no triangle is left.
#' @seealso [fit_shape()], with an example
#' @export
shape_mesh <- function(x, parts = "model") {
  check_class(x, "shape", "x", "fit_shape()")
  triangles <- x$scheme$triangles
  for (part in parts) check_choice(part, unique(c("model", triangles$part)), "parts")
  at <- coords(x, "surface")
  corners <- as.matrix(triangles[triangles$part %in% parts, c("v1", "v2", "v3")])
  whole <- rowSums(matrix(is.na(at[corners, 1]), ncol = 3)) == 0
  if (!any(whole)) {
    crestline_abort("no triangle of the surface has all its points.", "See `status` for what is missing.",
                    stage = "shape", id = x$id)
  }
  corners <- corners[whole, , drop = FALSE]
  row <- sort(unique(as.vector(corners)))
  mesh <- rgl::mesh3d(vertices = unname(rbind(t(at[row, , drop = FALSE]), 1)),
                      triangles = matrix(match(t(corners), row), 3))
  structure(with_normals(mesh), row = row)
}

#' @export
as.data.frame.shape <- function(x, row.names = NULL, optional = FALSE, ...) x$points

#' @export
print.shape <- function(x, most = 8, ...) {
  cat("<shape> ", x$id, ", by the scheme ", x$scheme$name, "\n", sep = "")
  for (level in c("landmarks", "curves", "surface")) {
    points <- x$points[x$points$level == level, ]
    status <- x$status[x$status$level == level, ]
    what <- switch(level, surface = "patches", level)
    if (nrow(status)) cat("  ", sum(status$ok), " of ", nrow(status), " ", what, if (level != "landmarks") {
      sprintf(" with %d of %d points", sum(!is.na(points$x)), nrow(points))
    }, "\n", sep = "")
  }
  said <- x$status[!is.na(x$status$reason), ]
  for (i in utils::head(seq_len(nrow(said)), most)) {
    cat(strwrap(paste0("- ", said$part[i], ": ", said$reason[i]), width = 80, exdent = 4), sep = "\n")
  }
  if (nrow(said) > most) cat("- and", nrow(said) - most, "more in status\n")
  invisible(x)
}
