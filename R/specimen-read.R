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
#'   matrices or a k x 3 x n array is searched for the specimen `id`. With an observer's folder of
#'   [digitise()], or a table in it, the specimen gets the curves that were drawn there too. NULL:
#'   none.
#' @param id Name of the specimen, one string. NULL: the file's name without its extension (and
#'   without `.gz`).
#' @param names Names of landmarks to change, as a named character vector: `c(prn = "pn")` renames
#'   the landmark `prn` of the file to `pn`. A file without names, such as most TPS files, gives the
#'   landmarks the numbers "1", "2", ... as names: there `names` may also be a plain character
#'   vector of the names of all landmarks, in the order of the file. A warning lists the names that
#'   the specimen does not have; if it has none of them, that is an error.
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
  if (!is.null(names)) {
    whole <- function(x) is.character(x) && !anyNA(x) && all(nzchar(x)) && !anyDuplicated(x)
    if (!whole(names) || is.object(names) || !(is.null(names(names)) || whole(names(names)))) {
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
  found <- landmarks_of(landmarks, id)
  own <- renamed_landmarks(as_landmarks(found, id), names, id)
  one <- from_files(specimen(read_mesh(file, id), own, id, ...), file, beside)
  with_desk_curves(one, own_table(beside, id), names(attr(found, "curves")))
}

#' The file of a specimen's own landmarks in a folder; a path of a file is itself
#' @noRd
own_table <- function(path, id) {
  if (is.na(path) || !dir.exists(path)) return(path)
  own <- landmarks_for(path, id)[[1]]
  if (is.character(own)) own else NA_character_
}

#' Landmarks with some names changed; a new name must not be another landmark's
#'
#' @param names By the old names, or all in the order of landmarks that have numbers.
#' @noRd
renamed_landmarks <- function(landmarks, names, id) {
  name <- rownames(landmarks)
  if (!length(name)) return(landmarks)
  if (!is.null(names) && is.null(names(names))) {
    if (!identical(name, as.character(seq_along(name))) || length(names) != length(name)) {
      refuse_landmarks(
        sprintf("`names` has %s without old ones, for %s.", amount(length(names), "name"),
                amount(length(name), "landmark")),
        sprintf(paste("Name each by its old name, as in c(%s = \"%s\"). Names in the order of the",
                      "file suit a file without names, all landmarks of it."),
                if (make.names(name[1]) == name[1]) name[1] else paste0("`", name[1], "`"),
                names[1]), id
      )
    }
    names <- stats::setNames(names, name)
  }
  changed <- name %in% names(names)
  check_new_names(names, name, id)
  name[changed] <- names[name[changed]]
  twice <- unique(name[duplicated(name)])
  if (length(twice)) {
    refuse_landmarks(sprintf("`names` gives two landmarks the name %s.", shorten(twice)),
                     "Leave out the landmark that has the name already, or rename it too.", id)
  }
  rownames(landmarks) <- name
  landmarks
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
