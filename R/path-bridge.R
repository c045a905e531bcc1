# Holes of a mesh bridged by flat triangles, for paths to pass over; nothing that is measured may
# lie on them.

#' A specimen with its holes bridged
#'
#' A fan of triangles about its centre is laid over every loop of the border that is not too large.
#' The mesh's own vertices and faces keep their numbers.
#'
#' @param largest Diagonal of the bounding box of a hole, as a share of the object's size
#'   ([mesh_size()]), up to which it is bridged.
#' @return The specimen, with more vertices and faces where there are such holes.
#' @noRd
bridge_holes <- function(specimen, largest) {
  mesh <- specimen$mesh
  corners <- lapply(cpp_border_loops(specimen$geometry$twin),
                    function(loop) simple_loops(mesh$it[loop]))
  corners <- unlist(corners, recursive = FALSE)
  size <- vapply(corners, function(loop) box_diagonal(mesh$vb[1:3, loop, drop = FALSE]), 0)
  holes <- corners[lengths(corners) >= 3 & size > 0 & size <= largest * specimen_size(specimen)]
  if (!length(holes)) return(specimen)
  centre <- ncol(mesh$vb) + seq_along(holes)
  middle <- function(x) vapply(holes, function(loop) rowMeans(x[, loop, drop = FALSE]),
                               numeric(nrow(x)))
  mesh$vb <- cbind(mesh$vb, middle(mesh$vb))
  mesh$normals <- cbind(mesh$normals, middle(mesh$normals))
  fans <- Map(function(loop, centre) rbind(c(loop[-1], loop[1]), loop, centre), holes, centre)
  mesh$it <- unname(cbind(mesh$it, do.call(cbind, fans)))
  storage.mode(mesh$it) <- "integer"
  geometry <- specimen$geometry
  geometry[c("twin", "piece")] <- mesh_topology(mesh)[c("twin", "piece")]
  with_fields(specimen, mesh = mesh, key = passed_mesh(mesh, specimen$id)$key, geometry = geometry)
}

#' A loop of vertices taken apart where it meets itself
#' @return List of loops in which no vertex is twice.
#' @noRd
simple_loops <- function(loop) {
  found <- list()
  while (anyDuplicated(loop)) {
    end <- anyDuplicated(loop)
    start <- max(which(loop[seq_len(end - 1)] == loop[end]))
    found <- c(found, list(loop[start:(end - 1)]))
    loop <- loop[-(start:(end - 1))]
  }
  c(found, list(loop))
}

#' A path without its parts on bridges: straight from rim to rim
#' @noRd
unbridged_path <- function(path, specimen) {
  mesh <- specimen$mesh
  if (is.null(path)) return(NULL)
  attr(path, "key") <- specimen_key(specimen)
  bridge <- path$face > ncol(mesh$it)
  if (!any(bridge)) return(path)
  landing <- which(bridge & !c(bridge[-1], TRUE))
  path[landing, mesh_columns] <- surface_points(mesh, as.matrix(path[landing, c("x", "y", "z")]))
  kept <- sort(c(which(!bridge), landing))
  # Its arc lengths stay those of the way over the bridges, along which it was measured.
  new_mesh_path(lapply(unclass(path)[c("s", mesh_columns)], `[`, kept), attr(path, "length"),
                attr(path, "key"), attr(path, "id"))
}
