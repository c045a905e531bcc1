# Specimens from files: the format by the extension.

#' Read a specimen from mesh and landmark files
#'
#' PLY (ascii and binary of both byte orders; any numeric types, polygons, colours of the vertices), OBJ
#' (polygons, negative indices, colours of the vertices, and the texture images that its `.mtl` file names, jpg or
#' png, sampled at the vertices) and STL (ascii and binary; equal vertices merged). Co-ordinates are read in
#' double precision.
#'
#' @param file Path of a `.ply`, `.obj` or `.stl` file.
#' @param landmarks Path of a landmark file, see [read_landmarks()], or landmarks as for [specimen()].
#' @param id Name of the specimen; the file's name without extension unless given.
#' @param ... Further arguments of [specimen()].
#' @return A [specimen()]. Errors are of class `crestline_error`, name the specimen and say what to do.
#' @examples
#' file <- tempfile(fileext = ".ply")
#' Rvcg::vcgPlyWrite(Rvcg::vcgSphere(2), file)
#' read_specimen(file, id = "ball")
#' @export
read_specimen <- function(file, landmarks = NULL, id = NULL, ...) {
  check_given()
  check_dots(..., known = names(formals(specimen))[-(1:3)])
  check_file(file, "reading")
  if (is.null(id)) id <- sub("[.][^.]*$", "", basename(file))
  id <- check_id(id)
  if (is.character(landmarks) && length(landmarks) == 1 && is.null(dim(landmarks))) {
    landmarks <- read_landmarks(landmarks)
  }
  specimen(read_mesh(file, id), landmarks, id, ...)
}

mesh_readers <- function() list(ply = read_ply, obj = read_obj, stl = read_stl)

# A mesh3d as the file has it, unchecked.
read_mesh <- function(file, id) {
  reader <- mesh_readers()[[file_extension(file)]]
  if (is.null(reader)) {
    refuse_file(file, "the format is not known by its extension",
                id, paste0("Known: ", paste0(".", names(mesh_readers()), collapse = ", "), "."))
  }
  tryCatch(reader(file, id), error = function(e) {
    if (inherits(e, "crestline_error")) stop(e)
    refuse_file(file, iconv(conditionMessage(e), "", "UTF-8", sub = "byte"), id)
  })
}

refuse_file <- function(file, reason, id, remedy = "The file is damaged or cut short: export or copy it again.") {
  crestline_abort(sprintf("%s cannot be read: %s.", basename(file), reason), remedy,
                  stage = "reading", id = id, class = "crestline_mesh_error", call = NULL)
}

# `vertex` n x 3, `corner` the 1-based vertex numbers of all polygons in turn, `sides` how many each has.
mesh_of_polygons <- function(vertex, corner, sides, colour = NULL) {
  mesh <- list(vb = rbind(t(vertex), 1), it = matrix(as.integer(corner[fan_corners(sides)]), 3))
  if (!is.null(colour)) mesh$material <- list(color = colour)
  structure(mesh, class = "mesh3d")
}

# Places, in the run of all corners, of the triangles of each polygon's fan about its first corner.
fan_corners <- function(sides) {
  first <- cumsum(c(0, sides))[seq_along(sides)] + 1
  fan <- pmax(sides - 2, 0)
  start <- rep(first, fan)
  step <- sequence(fan)
  as.vector(rbind(start, start + step, start + step + 1))
}
