# A measured shape as a folder that 3D Slicer opens in one go.

#' Write a shape for 3D Slicer
#'
#' Writes a folder that 3D Slicer opens in one go: drop it on Slicer's window, or choose it by *Add
#' Data, Choose Directory to Add*. All files are in the frame LPS, Slicer's default.
#'
#' * `model.vtk`: the surface of the shape, with scalars by vertex: `se`, the standard error (unit
#'   of the mesh; -1 where there is none), and those of `values`;
#' * `scan.vtk`: the surface of the specimen, if it is given;
#' * `landmarks.mrk.json`: landmarks, black;
#' * `curves.mrk.json`: each curve by name, in the colour of its grade ([quality()]): green, amber
#'   or red.
#'
#' @template shape
#' @param dir Path of the folder. It is made if it is not there.
#' @param specimen The [specimen()] that the shape was measured on, or `NULL`.
#' @param values Named list of numbers for each surface point of the shape, such as the distances of
#'   a comparison. They become scalars of the model.
#' @param parts Parts of the surface, as in [shape_mesh()].
#' @return The paths of the files, invisibly.
#' @section Errors: of class `crestline_error`: the folder cannot be made; `values` are not one
#'   number for each surface point.
#' @template glossary
#' @seealso [write_landmarks()], [write_mesh()], [write_glb()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' dir <- tempfile("slicer")
#' print(basename(write_slicer(fit_shape(face, face_scheme()), dir)))
#' unlink(dir, recursive = TRUE)
#' }
#' @export
write_slicer <- function(x, dir, specimen = NULL, values = list(), parts = "model") {
  check_given()
  check_class(x, "shape", "x", "fit_shape()")
  if (!is.null(specimen)) {
    check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
    check_shape_on(x, specimen)
  }
  check_scalars(values, sum(x$points$level == "surface"))
  dir <- made_folder(dir)
  at <- function(name) file.path(dir, name)
  written <- character()
  if (any(x$status$level == "surface" & x$status$ok)) {
    model <- shape_mesh(x, parts)
    row <- attr(model, "row")
    row[is.na(row)] <- 0
    se <- x$points$se[x$points$level == "surface"]
    scalars <- lapply(c(list(se = ifelse(is.na(se), -1, se)), values), function(value) {
      ifelse(row > 0, value[pmax(row, 1)], -1)
    })
    write_vtk(model, scalars, at("model.vtk"))
    written <- at("model.vtk")
  }
  if (!is.null(specimen)) {
    write_vtk(specimen$mesh, list(), at("scan.vtk"))
    written <- c(written, at("scan.vtk"))
  }
  marks <- coords(x, "landmarks")
  lps <- list(frame = "LPS")
  said <- provenance_comments(provenance_of(x))
  write_mrkjson(mrkjson_list(marks, "Fiducial", x$id, rownames(marks), lps, "#000000"), said,
                at("landmarks.mrk.json"))
  write_mrkjson(graded_curves(x, lps), said, at("curves.mrk.json"))
  invisible(c(written, at(c("landmarks.mrk.json", "curves.mrk.json"))))
}

#' Every curve as a list of Slicer's, in the colour of its grade
#' @noRd
graded_curves <- function(shape, options) {
  curves <- written_landmarks(shape)$curves
  graded <- quality(shape)
  graded <- graded[graded$level == "curves", ]
  grade <- as.character(graded$grade[match(names(curves), graded$part)])
  unlist(Map(function(curve, name, colour) {
    mrkjson_list(curve, if (attr(curve, "closed")) "ClosedCurve" else "Curve", name,
                 sprintf("%s-%d", name, seq_len(nrow(curve))), options, colour)
  }, curves, names(curves), grade_colours[grade]), use.names = FALSE)
}

check_scalars <- function(values, n) {
  named <- is.list(values) && !is.data.frame(values) && length(values) == length(names(values)) &&
    all(grepl("^[A-Za-z][A-Za-z0-9_]*$", names(values)))
  if (length(values) && !named) {
    refuse_argument("values", values, "Give a list with names of letters and digits.")
  }
  for (name in names(values)) {
    one <- values[[name]]
    if (!is.numeric(one) || length(one) != n || any(!is.finite(one))) {
      remedy <- sprintf("Give %d finite numbers as %s: one a surface point.", n, name)
      refuse_argument("values", one, remedy)
    }
  }
  values
}

#' The path of a folder that is there or was made
#' @noRd
made_folder <- function(dir) {
  check_text(dir, "dir")
  if (!nzchar(dir) || nchar(dir, "bytes") > 4000 ||
      !dir.exists(dir) && !suppressWarnings(dir.create(dir, recursive = TRUE))) {
    crestline_abort("`dir` is no folder and cannot be made.",
                    "Check its path, and the right to write there.", stage = "writing")
  }
  dir
}

#' A mesh with scalars of its vertices as VTK's legacy text, in the frame LPS
#' @noRd
write_vtk <- function(mesh, scalars, file) {
  rows <- function(x) apply(x, 2, paste, collapse = " ")
  number <- function(x) format(x, digits = 9, trim = TRUE)
  n <- ncol(mesh$vb)
  m <- ncol(mesh$it)
  values <- unlist(Map(function(name, value) {
    c(sprintf("SCALARS %s double 1", name), "LOOKUP_TABLE default", number(value))
  }, names(scalars), scalars), use.names = FALSE)
  xyz <- matrix(number(mesh$vb[1:3, ]), 3)
  lines <- c("# vtk DataFile Version 3.0", "crestline SPACE=LPS", "ASCII", "DATASET POLYDATA",
             sprintf("POINTS %d double", n), rows(xyz), sprintf("POLYGONS %d %d", m, 4 * m),
             paste("3", rows(mesh$it - 1L)),
             if (length(values)) c(sprintf("POINT_DATA %d", n), values))
  write_content(charToRaw(paste0(paste(lines, collapse = "\n"), "\n")), file)
}
