# A measured shape as a scene that 3D Slicer opens in one go.

#' Write a shape for 3D Slicer
#'
#' Writes a folder with a scene. 3D Slicer opens all of it in one go: drop `scene.mrml` on Slicer's
#' window, or choose it by *Add Data*. All files are in the frame LPS, Slicer's default.
#'
#' * `scene.mrml`: the scene, which names the other files;
#' * `model.vtk`: the surface of the shape, with scalars by vertex: `se`, the standard error (unit
#'   of the mesh; -1 where there is none), and those of `values`. The first of `values` is shown as
#'   colours, without `values` the standard error;
#' * `scan.vtk`: the surface of the specimen, if it is given; half transparent;
#' * `landmarks.mrk.json`: landmarks, black;
#' * `curves`, a folder: a file for each curve, named after it, in the colour of its grade
#'   ([quality()]): green, amber or red.
#'
#' A folder that was written before is written anew: files of the former scene that the new one does
#' not have are removed. Other files are kept.
#'
#' The scene was checked against the sources of Slicer (5.13) and against its published scenes. It
#' was not opened in Slicer itself.
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
  dir.create(file.path(dir, "curves"), showWarnings = FALSE)
  at <- function(name) file.path(dir, name)
  nodes <- list()
  if (any(x$status$level == "surface" & x$status$ok)) {
    model <- shape_mesh(x, parts)
    scalars <- model_scalars(x, attr(model, "row"), values)
    write_vtk(model, scalars, at("model.vtk"))
    nodes <- list(model_node("model.vtk", paste(x$id, "model"), "#E3CDB8", 1,
                             scalars[c(names(values), "se")[1]]))
  }
  if (!is.null(specimen)) {
    write_vtk(specimen$mesh, list(), at("scan.vtk"))
    nodes <- c(nodes, list(model_node("scan.vtk", paste(x$id, "scan"), "#C8C8C8", 0.5)))
  }
  marks <- coords(x, "landmarks")
  said <- provenance_comments(provenance_of(x))
  write_mrkjson(mrkjson_list(marks, "Fiducial", paste(x$id, "landmarks"), rownames(marks),
                             list(frame = "LPS"), "#000000"), said, at("landmarks.mrk.json"))
  nodes <- c(nodes, list(markups_node("landmarks.mrk.json", paste(x$id, "landmarks"), "Fiducial",
                                      "#000000")))
  curves <- graded_curves(x)
  for (one in curves) write_mrkjson(one$list, said, at(one$node$file))
  nodes <- c(nodes, unname(lapply(curves, `[[`, "node")))
  files <- vapply(nodes, `[[`, "", "file")
  former <- c("model.vtk", "scan.vtk", "curves.mrk.json",
              file.path("curves", list.files(at("curves"), "[.]mrk[.]json$")))
  unlink(at(setdiff(former, files)), expand = FALSE)
  write_content(charToRaw(enc2utf8(scene_xml(nodes))), at("scene.mrml"))
  invisible(at(c("scene.mrml", files)))
}

#' The scalars of the vertices of a model; -1 where there are none
#' @noRd
model_scalars <- function(shape, row, values) {
  row[is.na(row)] <- 0
  se <- shape$points$se[shape$points$level == "surface"]
  lapply(c(list(se = ifelse(is.na(se), -1, se)), values), function(value) {
    ifelse(row > 0, value[pmax(row, 1)], -1)
  })
}

#' Every curve as a list of Slicer's, in the colour of its grade, and as a node of the scene
#' @return List by curve: `list` (as of [mrkjson_list()]), `node`.
#' @noRd
graded_curves <- function(shape) {
  curves <- written_landmarks(shape)$curves
  graded <- quality(shape)
  graded <- graded[graded$level == "curves", ]
  grade <- as.character(graded$grade[match(names(curves), graded$part)])
  Map(function(curve, name, word, colour) {
    type <- if (attr(curve, "closed")) "ClosedCurve" else "Curve"
    file <- file.path("curves", paste0(word, ".mrk.json"))
    list(list = mrkjson_list(curve, type, name, sprintf("%s-%d", name, seq_len(nrow(curve))),
                             list(frame = "LPS"), colour),
         node = markups_node(file, name, type, colour))
  }, curves, names(curves), file_words(names(curves)), grade_colours[grade])
}

#' What a scene says of one model
#'
#' @param scalar Named list of one: the scalars that are shown as colours; NULL: none.
#' @return List: `file`, `name`, `tag` (of the node, its display and its storage), `display` (named
#'   texts).
#' @noRd
model_node <- function(file, name, colour, opacity, scalar = NULL) {
  range <- if (length(scalar)) range(c(0, scalar[[1]]))
  shown <- if (length(scalar)) {
    c(scalarVisibility = "true", activeScalarName = names(scalar), scalarRangeFlag = "UseManual",
      scalarRange = sprintf("%.9g %.9g", range[1], range[2]),
      colorNodeID = "vtkMRMLColorTableNodeFileViridis.txt")
  } else c(scalarVisibility = "false")
  list(file = file, name = name, tag = c("Model", "ModelDisplay", "ModelStorage"),
       display = c(color = scene_colour(colour), opacity = format(opacity), visibility = "true",
                   backfaceCulling = "false", shown))
}

#' The same of one list of points
#' @param type Of the list, as Slicer names it.
#' @noRd
markups_node <- function(file, name, type, colour) {
  points <- type == "Fiducial"
  list(file = file, name = name,
       tag = c(paste0("Markups", type), if (points) "MarkupsFiducialDisplay" else "MarkupsDisplay",
               "MarkupsJsonStorage"),
       display = c(color = scene_colour(colour), selectedColor = scene_colour(colour),
                   visibility = "true", pointLabelsVisibility = if (points) "true" else "false"))
}

scene_colour <- function(colour) {
  paste(format(round(grDevices::col2rgb(colour)[, 1] / 255, 4), trim = TRUE), collapse = " ")
}

#' A scene of nodes, each with its display and its file
#' @noRd
scene_xml <- function(nodes) {
  encode <- function(x) {
    for (sign in list(c("&", "&amp;"), c("<", "&lt;"), c(">", "&gt;"), c("\"", "&quot;"))) {
      x <- gsub(sign[1], sign[2], x, fixed = TRUE)
    }
    gsub("[[:cntrl:]]+", " ", x)
  }
  element <- function(tag, attributes) {
    sprintf("<%s %s></%s>", tag,
            paste0(names(attributes), "=\"", encode(attributes), "\"", collapse = " "), tag)
  }
  each <- unlist(lapply(seq_along(nodes), function(i) {
    node <- nodes[[i]]
    id <- sprintf("vtkMRML%sNode%d", node$tag, i)
    # Slicer decodes these signs of an address and no others
    address <- gsub("'", "%27", gsub(" ", "%20", gsub("%", "%25", node$file, fixed = TRUE),
                                     fixed = TRUE), fixed = TRUE)
    c(element(node$tag[3], c(id = id[3], name = paste(node$name, "file"), fileName = address,
                             coordinateSystem = "LPS")),
      element(node$tag[2], c(id = id[2], name = paste(node$name, "display"), node$display)),
      element(node$tag[1], c(id = id[1], name = node$name, storageNodeRef = id[3],
                             displayNodeRef = id[2])))
  }))
  paste0(paste(c("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", "<MRML>", each,
                 "</MRML>"), collapse = "\n"), "\n")
}

check_scalars <- function(values, n) {
  named <- is.list(values) && !is.data.frame(values) && length(values) == length(names(values)) &&
    all(grepl("^[A-Za-z][A-Za-z0-9_]*$", names(values)))
  if (!is.list(values) || length(values) && !named) {
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
