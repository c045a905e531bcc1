# Specimens from files: the format by the extension.

#' Read a specimen from mesh and landmark files
#'
#' PLY (ascii and binary of both byte orders; any numeric types, polygons, colours of the vertices), OBJ
#' (polygons, negative indices, colours of the vertices, and the texture images that its `.mtl` file names, jpg or
#' png, sampled at the vertices) and STL (ascii and binary; equal vertices merged). Co-ordinates are read in
#' double precision.
#'
#' Files may have lines that end in LF, CR or both, a byte-order mark or two bytes a sign, and any
#' system's spelling of NaN. OBJ lines may go on behind a backslash and end in a comment. PLY headers
#' may be long, and triangle strips are read. Decimal commas are refused.
#'
#' A warning of class `crestline_file_warning` names a file whose header disagrees with its content or
#' that seems cut short.
#'
#' @param file Path of a `.ply`, `.obj` or `.stl` file, also packed by gzip (`.ply.gz`).
#' @param landmarks Path of a landmark file, see [read_landmarks()], or landmarks as for
#'   [specimen()]. Of a file or folder of several specimens, a list of matrices or a k x 3 x n array
#'   those of the name `id` are taken.
#' @param id Name of the specimen; the file's name without extension (and `.gz`) unless given.
#' @param ... Further arguments of [specimen()].
#' @return A [specimen()]. Errors are of class `crestline_error`, name the specimen and say what to do.
#' @examples
#' file <- tempfile(fileext = ".ply")
#' Rvcg::vcgPlyWrite(Rvcg::vcgSphere(2), file)
#' read_specimen(file, id = "ball")
#' @export
read_specimen <- function(file, landmarks = NULL, id = NULL, ...) {
  check_given()
  check_file(file, "reading")
  if (is.null(id)) id <- sub("[.][^.]*$", "", unpacked_name(file))
  id <- check_id(id)
  beside <- if (is.character(landmarks) && length(landmarks) == 1 && is.null(dim(landmarks))) landmarks else NA_character_
  from_files(specimen(read_mesh(file, id), landmarks_of(landmarks, id), id, ...), file, beside)
}

mesh_readers <- function() list(ply = read_ply, obj = read_obj, stl = read_stl)

# The name of a file without folder and without ".gz".
unpacked_name <- function(file) sub("[.]gz$", "", basename(file), ignore.case = TRUE)

# A mesh3d as the file has it, unchecked.
read_mesh <- function(file, id) {
  reader <- mesh_readers()[[file_extension(unpacked_name(file))]]
  if (is.null(reader)) {
    refuse_file(file, "the format is not known by its extension",
                id, paste0("Known: ", paste0(".", names(mesh_readers()), collapse = ", "), "."))
  }
  check_stored(file, "reading", id, unpacks = "gzip")
  mesh <- tryCatch(reader(file, id), error = function(e) {
    if (inherits(e, "crestline_error")) stop(e)
    refuse_file(file, iconv(conditionMessage(e), "", "UTF-8", sub = "byte"), id)
  })
  if (!is.null(mesh$short)) {
    warn_file(file, sprintf("has %d polygons with fewer than three corners", mesh$short),
              "Look whether the surface is whole: the header's numbers may be wrong, or export it again.", id)
  }
  mesh
}

refuse_file <- function(file, reason, id, remedy = "The file is damaged or cut short: export or copy it again.") {
  crestline_abort(sprintf("%s cannot be read: %s.", basename(file), reason), remedy,
                  stage = "reading", id = id, class = "crestline_mesh_error", call = NULL)
}

# `vertex` n x 3, `corner` the 1-based vertex numbers of all polygons in turn, `sides` how many each has.
# A corner that is no whole number is NA, which the door refuses.
mesh_of_polygons <- function(vertex, corner, sides, colour = NULL) {
  corner <- corner[fan_corners(sides)]
  if (is.double(corner)) corner[corner != round(corner) | abs(corner) > .Machine$integer.max] <- NA
  mesh <- list(vb = rbind(t(vertex), 1), it = matrix(as.integer(corner), 3))
  if (!is.null(colour)) mesh$material <- list(color = colour)
  if (any(sides < 3)) mesh$short <- sum(sides < 3)
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
