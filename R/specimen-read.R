# Specimens from files: the format by the extension.

#' Read a specimen from mesh and landmark files
#'
#' Reads a mesh file, reads its landmarks, and gives both to [specimen()], which checks them.
#' Co-ordinates are read in double precision. The formats are:
#'
#' * PLY: ascii and binary of both byte orders, with any numeric types, polygons, triangle strips,
#'   colours of the vertices and long headers;
#' * OBJ: polygons, negative indices, colours of the vertices, continued lines and comments. Texture
#'   images that the `.mtl` file names (jpg or png) are sampled at the vertices;
#' * STL: ascii and binary. Equal vertices are merged.
#'
#' Lines may end in LF, CR or both. Text files may have a byte-order mark or be UTF-16, and may
#' spell NaN as any system does. Decimal commas are refused.
#'
#' A warning of class `crestline_file_warning` names the file if its header disagrees with its
#' content, or if it seems cut short.
#'
#' @param file Path of a `.ply`, `.obj` or `.stl` file, also packed by gzip (`.ply.gz`).
#' @param landmarks Path of a landmark file, see [read_landmarks()], or landmarks as for
#'   [specimen()]; in the unit of the mesh. A file or folder of several specimens, a list of
#'   matrices or a k x 3 x n array is searched for the specimen `id`. NULL: none.
#' @param id Name of the specimen, one string. NULL: the file's name without its extension (and
#'   without `.gz`).
#' @param names Names of landmarks to change, as a named character vector: `c(prn = "pn")` renames
#'   the landmark `prn` of the file to `pn`. A warning lists the names that the specimen does not
#'   have; if it has none of them, that is an error.
#' @param ... Further arguments of [specimen()].
#' @return A [specimen()]. Errors are of class `crestline_error`; they name the specimen and the
#'   remedy.
#' @template glossary
#' @examples
#' file <- tempfile(fileext = ".ply")
#' Rvcg::vcgPlyWrite(Rvcg::vcgSphere(2), file)
#' read_specimen(file, id = "ball")
#' @export
read_specimen <- function(file, landmarks = NULL, id = NULL, ..., names = NULL) {
  check_given()
  # New names of landmarks, by the old ones
  if (!is.null(names)) {
    whole <- function(x) is.character(x) && !anyNA(x) && all(nzchar(x)) && !anyDuplicated(x)
    if (!whole(names) || !whole(names(names)) || is.object(names)) {
      refuse_argument("names", names, "Give new names by the old ones, each once: c(prn = \"pn\").")
    }
  }
  check_dots(..., known = names(formals(specimen))[-(1:3)])
  check_file(file, "reading")
  if (inherits(landmarks, "specimen")) {
    check_class(landmarks, "specimen", "landmarks", "specimen() or read_specimen()")
  }
  if (is.null(id)) id <- sub("[.][^.]*$", "", unpacked_name(file))
  id <- check_id(id)
  beside <- if (is.character(landmarks) && length(landmarks) == 1 &&
                is.null(dim(landmarks))) landmarks else NA_character_
  # Landmarks with some names changed; a new name must not be another landmark's
  own <- as_landmarks(landmarks_of(landmarks, id), id)
  name <- rownames(own)
  changed <- name %in% names(names)
  if (length(name)) check_new_names(names, name, id)
  name[changed] <- names[name[changed]]
  twice <- unique(name[duplicated(name)])
  if (length(twice)) {
    refuse_landmarks(sprintf("`names` gives two landmarks the name %s.", shorten(twice)),
                     "Leave out the landmark that has the name already, or rename it too.", id)
  }
  rownames(own) <- name
  from_files(specimen(read_mesh(file, id), own, id, ...), file, beside)
}

#' Warn of new names for landmarks that are not there, as a scan may lack one; refuse them where
#' none is there; say if all landmarks have theirs already
#' @noRd
check_new_names <- function(names, there, id) {
  unknown <- names(names)[!names(names) %in% there & !names %in% there]
  if (length(unknown)) {
    problem <- sprintf("`names` has %s, but there is no such landmark.", shorten(unknown))
    remedy <- near_names(unknown[1], there)
    if (length(unknown) == length(names)) refuse_landmarks(problem, remedy, id)
    crestline_warn(problem, paste(remedy, "If the scan lacks it, this is right."), "landmarks", id)
  }
  if (length(names) && !any(names(names) %in% there)) {
    crestline_inform(sprintf("`names` changes no landmark: there is none named %s.",
                             shorten(names(names))))
  }
}
