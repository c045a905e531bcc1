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
  check_dots(..., known = names(formals(specimen))[-(1:3)])
  check_file(file, "reading")
  if (is.null(id)) id <- sub("[.][^.]*$", "", unpacked_name(file))
  id <- check_id(id)
  beside <- if (is.character(landmarks) && length(landmarks) == 1 && is.null(dim(landmarks))) landmarks else NA_character_
  from_files(specimen(read_mesh(file, id), landmarks_of(landmarks, id), id, ...), file, beside)
}
