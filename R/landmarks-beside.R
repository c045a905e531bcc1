# Which landmarks belong to which mesh: the file beside it, or a set of many by the specimen's id.

#' The landmark file beside a mesh
#'
#' Of its name with or without extension, in any format of [read_landmarks()] and in any case of the
#' extension, or as MeshLab names picked points. A `.json` that holds no markups is none.
#'
#' @param file Path of the mesh.
#' @param listing Of its folder, see [folder_listing()].
#' @return Path, "" where there is none. Refused where two files differ: landmarks, or their places
#'   by more than the tolerance.
#' @noRd
landmarks_beside <- function(file, listing = folder_listing(dirname(file))) {
  # All of them; where none has the mesh's name exactly, those that differ in case and are not of
  # another mesh
  stem <- sub("[.][^.]*$", "", basename(file))
  known <- c(paste0(".", tolower(names(landmark_formats()))), ".json", "_picked_points.pp")
  known <- c(known, paste0(".", file_extension(file), known))
  meshes <- paste0(".", names(mesh_readers()))
  name <- unlist(mget(paste0(tolower(stem), unique(c(known, meshes))), listing,
                      ifnotfound = list(NULL)), use.names = FALSE)
  own <- substr(name, 1, nchar(stem))
  end <- tolower(substring(name, nchar(stem) + 1))
  meant <- if (stem %in% own[end %in% known]) stem else setdiff(own, own[end %in% meshes])
  fits <- end %in% known & own %in% meant
  name <- name[fits][order(match(end[fits], known))]
  beside <- if (dirname(file) == "." && !startsWith(file, "./")) name else
    file.path(dirname(file), name)
  beside <- beside[vapply(beside, is_landmark_file, NA)]
  if (length(beside) < 2) return(c(beside, "")[1])
  sets <- lapply(beside, read_landmarks)
  differs <- which(!vapply(sets[-1], same_landmarks, NA, sets[[1]]))
  if (length(differs)) {
    two <- basename(beside[c(1, differs[1] + 1)])
    refuse_landmarks(
      sprintf("two landmark files of %s differ: %s and %s.", basename(file), two[1], two[2]),
      "Delete or rename the wrong one, or name the right one as `landmarks`.", id = NULL
    )
  }
  beside[1]
}

#' The names of the files of a folder, by what they are in small letters: so that a folder of many
#' thousands is read once for all of them
#' @return Environment.
#' @noRd
folder_listing <- function(dir) {
  name <- list.files(dir, all.files = TRUE)
  list2env(split(name, tolower(name)), parent = emptyenv())
}

#' Landmarks of some specimens, by their ids
#'
#' @param landmarks One file of several specimens (TPS, NTS, .landmarkAscii, CSV with a column of
#'   specimens), a folder of landmark files, paths of one file each, a list of k x 3 matrices (or
#'   data frames, or specimens) by name, a k x 3 x n array with names, or a data frame with a column
#'   of specimens.
#' @param ids Ids of the specimens.
#' @param ... Further arguments of [read_landmarks()].
#' @return List by id: a k x 3 matrix, or the path of the specimen's own file; NULL where there is
#'   none. The attribute `problem` (character by id) says why: nothing of its name (with near
#'   names), or two that differ; NA where all is well. Refused where no specimen has landmarks, and
#'   where they have no names and there are several specimens.
#' @noRd
landmarks_for <- function(landmarks, ids, ...) {
  source <- landmark_source(landmarks, ids, ...)
  if (length(ids) == 1 && length(source$sets) == 1 &&
      (is.null(names(source$sets)) || isTRUE(source$file))) {
    tell_other_name(c(names(source$sets), source$alias), source$what, ids)
    return(for_ids(source$sets, ids, NA))
  }
  if (is.null(names(source$sets))) {
    refuse_landmarks(
      sprintf("%s has %s without names of specimens, for %s.", source$what,
              amount(length(source$sets), "set"), amount(length(ids), "specimen")),
      sprintf("Name them by the specimens: %s.", shorten(ids)), id = NULL
    )
  }
  place <- id_places(ids, names(source$sets))
  if (!is.null(source$alias) && !any(lengths(place))) place <- id_places(ids, source$alias)
  problem <- unlist(Map(function(id, place) {
    # Why a specimen has no landmarks among some sets, NA where it has
    if (!length(place)) {
      return(sprintf("%s has no landmarks of %s. %s", source$what, id,
                     near_names(id, unique(names(source$sets)))))
    }
    if (same_sets(source$sets[place])) return(NA_character_)
    file <- Filter(is.character, source$sets[place])
    from <- if (length(file)) paste0(": ", shorten(basename(unlist(file))))
    paste0(source$what, " has different landmarks of ", id, from, ".")
  }, ids, place))
  if (!any(is.na(problem))) {
    refuse_landmarks(
      if (length(ids) == 1) problem[[1]] else
        sprintf("%s has no landmarks of %s.", source$what, shorten(ids)),
      if (any(lengths(place))) "Leave one of them." else
        sprintf("It has those of %s. Name them alike.", shorten(names(source$sets))), id = NULL
    )
  }
  sets <- vector("list", length(ids))
  fine <- is.na(problem)
  sets[fine] <- source$sets[vapply(place[fine], `[`, 1L, 1L)]
  for_ids(sets, ids, problem)
}

#' Say that the only set of a file is of another specimen by its name there; not where the file has
#' the specimen's name, and not of a name that only counts
#' @noRd
tell_other_name <- function(names, file, id) {
  known <- c(names, sub(id_extension(), "", file, ignore.case = TRUE))
  counts <- grepl("^[0-9]*$", names)
  if (all(counts) || length(id_places(id, known)[[1]])) return(invisible())
  crestline_inform(sprintf(
    "%s has landmarks of %s. They are taken for %s.", file, shorten(names[!counts]), id
  ))
}

#' Landmarks of one specimen, as [specimen()] takes them
#' @noRd
landmarks_of <- function(landmarks, id) {
  by_id <- if (is.data.frame(landmarks)) {
    any(is_key_column(setdiff(tolower(names(landmarks)), c("name", "landmark", "label"))))
  } else if (is.matrix(landmarks)) {
    FALSE
  } else {
    is.character(landmarks) || is.list(landmarks) || length(dim(landmarks)) == 3
  }
  if (!by_id) return(landmarks)
  found <- landmarks_for(landmarks, id)[[1]]
  if (is.character(found)) landmarks_of(read_landmarks(found), id) else found
}

for_ids <- function(sets, ids, problem) {
  problem <- stats::setNames(rep_len(problem, length(ids)), ids)
  structure(stats::setNames(sets, ids), problem = problem)
}

#' What landmarks there are, by name
#' @return List: `sets` (matrices or paths; no names where the specimens have none), `what` (what it
#'   is called), `alias` (other names or NULL), `file` (whether it is one file).
#' @noRd
landmark_source <- function(landmarks, ids, ...) {
  if (is.character(landmarks) && is.null(dim(landmarks)) && length(landmarks)) {
    if (length(unique(landmarks)) > 1) {
      return(list(sets = paths_by_name(landmarks, ids), what = "`landmarks`"))
    }
    file <- unname(landmarks[1])
    if (isTRUE(dir.exists(file))) {
      paths <- landmark_folder(file)
      return(list(sets = stats::setNames(as.list(paths), names(paths)), what = file))
    }
    found <- read_sets(file, ...)
    sets <- if (is.matrix(found)) list(found) else found
    if (isTRUE(attr(found, "numbered"))) names(sets) <- NULL
    twice <- c(attr(found, "twice"), NA)[1]
    what <- paste0(basename(file), if (!is.na(twice)) sprintf(" (ID=%s is there twice)", twice))
    return(list(sets = sets, what = what, alias = attr(found, "alias"), file = TRUE))
  }
  list(sets = given_sets(landmarks), what = "`landmarks`")
}

#' Several paths: by their names, else by those of the files. Where no file has a specimen's name
#' they are taken in order, and that is said; refused where the order contradicts the names in the
#' files'
#' @noRd
paths_by_name <- function(landmarks, ids) {
  if (!is.null(names(landmarks))) return(as.list(landmarks))
  stem <- sub(id_extension(), "", basename(landmarks), ignore.case = TRUE)
  if (any(lengths(id_places(ids, stem)) > 0) || length(landmarks) != length(ids)) {
    return(stats::setNames(as.list(landmarks), stem))
  }
  within <- lapply(sub("^.*/", "", plain_id(ids)), function(id) {
    which(grepl(id, tolower(stem), fixed = TRUE))
  })
  other <- which(mapply(function(at, i) length(at) == 1 && at != i, within, seq_along(ids)))
  if (length(other)) {
    at <- other[1]
    refuse_landmarks(
      sprintf("`landmarks` has %s in the place of %s.", basename(landmarks[at]), ids[at]),
      "Put them in the order of the specimens, or give them the specimens' names.", id = NULL
    )
  }
  crestline_inform(paste0(
    "`landmarks` are taken in the order of the specimens, ", basename(landmarks[1]), " for ",
    ids[1], " and so on."
  ))
  stats::setNames(as.list(landmarks), ids)
}

#' Sets given in R as a list of matrices by name
#' @noRd
given_sets <- function(x) {
  if (is.data.frame(x)) {
    # Landmarks of a data frame as of a file
    refuse <- function(problem, line = NULL) {
      refuse_landmarks(sprintf("the table of landmarks cannot be read: %s.", problem),
                       "Give the columns name, x, y, z, and one of the specimens.", id = NULL)
    }
    text <- lapply(x, function(column) {
      if (is.double(column)) number_text(column, "") else as.character(column)
    })
    text <- lapply(text, function(column) replace(column, is.na(column), ""))
    table <- structure(text, names = trimws(names(x)), row.names = seq_len(nrow(x)),
                       class = "data.frame")
    found <- csv_sets(structure(table, line = seq_len(nrow(x)), sep = ","), "the table",
                      list(frame = "LPS"), refuse)
    return(if (is.matrix(found)) list(found) else found)
  }
  if (is.array(x) && length(dim(x)) == 3) return(array_sets(x))
  if (is.matrix(x) || inherits(x, "specimen")) x <- list(x)
  if (!is.list(x) || !length(x)) {
    crestline_abort(sprintf("`landmarks` is %s.", describe_value(x)),
                    "Give a file, a folder, or a list of matrices or an array by name of specimen.",
                    stage = "arguments", call = NULL)
  }
  specimen <- vapply(x, inherits, NA, "specimen")
  if (is.null(names(x)) && all(specimen)) names(x) <- vapply(x, `[[`, "", "id")
  if (!is.null(names(x)) && !all(nzchar(names(x)))) {
    refuse_landmarks("some of the list `landmarks` have no name.", "Name each by its specimen.",
                     id = NULL)
  }
  x[specimen] <- lapply(x[specimen], `[[`, "landmarks")
  lapply(x, function(one) if (is.character(one)) one else as_landmarks(one))
}
