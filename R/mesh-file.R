# Meshes from and to files: the format by the file's extension, one file of code a format.

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
              paste0("Look whether the surface is whole: the header's numbers may be wrong, or ",
                     "export it again."), id)
  }
  mesh
}

mesh_readers <- function() list(ply = read_ply, obj = read_obj, stl = read_stl)

#' Write a mesh, or the surface of a shape
#'
#' Writes a PLY, OBJ or STL file for other programs. [read_specimen()] reads it back with the same
#' vertices in the same order, to the last bit, and the same triangles and colours. STL is the
#' exception, see below.
#'
#' | extension | numbers | colours of vertices | values of vertices |
#' |---|---|---|---|
#' | `.ply` | double precision | yes | property `quality` |
#' | `.obj` | as many digits as give them back | yes, behind the co-ordinates | no |
#' | `.stl` | single precision, with `ascii` as in `.obj` | no | no |
#'
#' * `.ply`: binary (little endian) or ascii. MeshLab and CloudCompare show `quality` as a scalar
#'   field. The mesh of [shape_mesh()] has a property `row` too. It gives the row of each vertex in
#'   `coords(shape, "surface")`, and 0 for the points between them. The format has no names of
#'   points; `rownames(coords(shape, "surface"))[row]` gives them.
#' * `.obj`: text, colours as numbers from 0 to 1.
#' * `.stl`: triangles without shared vertices; reading merges equal ones, in the order of the
#'   triangles.
#' * `.ply` and `.obj` of a specimen or a shape have its provenance (see [summary.specimen()]) in
#'   comment lines; `.stl` has no place for it.
#'
#' Co-ordinates are written as they stand, in the mesh's unit. 3D Slicer reads meshes in the frame
#' LPS by default. The default of [write_landmarks()] is the same.
#'
#' @param x A `shape` (its surface, see [shape_mesh()]), a [specimen()], or a `mesh3d` such as a
#'   denser surface of [shape_mesh()].
#' @param file Path of the file, ending in `.ply`, `.obj` or `.stl`.
#' @param colour Colours of the vertices. NULL: the natural colours, if the mesh has any. Colours:
#'   one, or one for each vertex. Numbers: one for each vertex, or one for each surface point of a
#'   shape; `palette` turns them into colours. "patch": one colour for each patch of a shape; the
#'   strips between patches are grey. "se": the standard errors of a shape's surface points, in the
#'   unit of the mesh; NA inside patches.
#' @param parts Parts of a shape's surface that are written, as in [shape_mesh()].
#' @param palette Two or more colours, from the least number to the greatest, evenly spaced.
#' @param limits Two numbers: the values at the ends of the palette. NULL: the range of the numbers.
#'   Numbers beyond a limit get the colour of that end.
#' @param missing Colour where the number is NA.
#' @param ascii Whether `.ply` and `.stl` are written as text, not binary.
#' @return `file`, invisibly.
#' @section Errors: of class `crestline_error`, for an unknown extension, a file that cannot be
#'   written, a mesh without triangles, or colours whose number does not match the vertices. STL has
#'   no colours: if you ask for them, you get a warning of class `crestline_format_warning`.
#' @template glossary
#' @seealso [shape_mesh()], [write_landmarks()] for the points, [write_page()] for the browser
#' @examples
#' file <- tempfile(fileext = ".ply")
#' ball <- Rvcg::vcgSphere(2)
#' write_mesh(ball, file, colour = ball$vb[3, ])
#' read_specimen(file)
#' unlink(file)
#' @export
write_mesh <- function(x, file, colour = NULL, parts = "model",
                       palette = grDevices::hcl.colors(11, "Viridis"),
                       limits = NULL, missing = "#BEBEBE", ascii = FALSE) {
  check_given()
  check_flags(ascii)
  palette <- check_colour(palette, "palette")
  missing <- check_colour(missing, "missing")
  parts <- check_names(parts, "parts")
  if (!is.null(limits)) limits <- check_numbers(limits, "limits", 2)
  if (!is_path(file)) refuse_no_path(file, "writing")
  write <- mesh_writers()[[file_extension(file)]]
  if (is.null(write)) {
    refuse_writing(file, "the format is not known by its extension",
                   paste0("Known: ", paste0(".", names(mesh_writers()), collapse = ", "), "."))
  }
  shape <- if (inherits(x, "shape")) x
  mesh <- written_mesh(x, parts)
  painted <- painted_mesh(mesh, colour, shape, palette, limits, missing)
  painted$comments <- c("written by crestline", comment_lines(x))
  write(painted, file, ascii)
  if (!is.null(colour) && identical(file_extension(file), "stl")) {
    crestline_warn(sprintf("%s: .stl has no colours: they are left out.", basename(file)),
                   "Write a .ply or .obj file.",
                   stage = "writing", class = "crestline_format_warning")
  }
  invisible(file)
}

mesh_writers <- function() list(ply = write_ply, obj = write_obj, stl = write_stl)

#' A mesh of triangles, each corner a vertex that is there, with the attributes of [shape_mesh()]
#' @noRd
written_mesh <- function(x, parts) UseMethod("written_mesh")

#' @exportS3Method
written_mesh.default <- function(x, parts) {
  if (inherits(x, "specimen")) {
    return(as_mesh(check_class(x, "specimen", "x", "specimen() or read_specimen()")))
  }
  check_class(x, "mesh3d", "x", "fit_shape(), specimen(), or `Rvcg::vcgImport()`")
  mesh <- as_mesh(split_quads(as_plain_mesh(x, NULL)$mesh, NULL)$mesh)
  structure(mesh, row = attr(x, "row"), group = attr(x, "group"))
}

#' What the formats hold of a mesh
#'
#' @param shape The `shape` whose surface it is, or NULL.
#' @return List: `xyz` (n x 3), `it` (m x 3), `rgb` (n x 3, 0 to 255; NULL where there is no
#'   colour), `value` (n numbers or NULL), `row` (n rows of surface points or NULL).
#' @noRd
painted_mesh <- function(mesh, colour, shape, palette, limits, missing) {
  n <- ncol(mesh$vb)
  row <- attr(mesh, "row")
  if (identical(colour, "se")) {
    if (is.null(shape)) {
      crestline_abort("`colour` is \"se\", but `x` is no shape.",
                      "Give a shape, or numbers of your own.", stage = "writing",
                      call = NULL)
    }
    colour <- as.numeric(shape$points$se[shape$points$level == "surface"])
  }
  by_row <- is.numeric(colour) && !is.null(shape) &&
    length(colour) == sum(shape$points$level == "surface")
  if (by_row) colour <- colour[row]
  value <- if (is.numeric(colour)) {
    if (length(colour) != n) {
      crestline_abort(sprintf("`colour` has %d numbers for %d vertices.", length(colour), n),
                      "Give one for each vertex.",
                      stage = "writing", call = NULL)
    }
    colour
  }
  hex <- if (is.null(colour)) vertex_colours(mesh) else
    surface_colours(mesh, colour, palette, limits, missing)
  list(xyz = t(mesh$vb[1:3, , drop = FALSE]), it = matrix(as.integer(t(mesh$it)), ncol = 3),
       value = value, row = row,
       rgb = if (!is.null(hex)) t(grDevices::col2rgb(hex)))
}
