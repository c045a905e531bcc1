# Landmarks in files: the format by the file's extension, one file of code a format.

#' Read and write landmarks and curves
#'
#' The file's extension, in upper or lower case, gives the format. Files are read as UTF-8 or
#' UTF-16, else as Latin 1. They are written in UTF-8, with all digits of a number. Landmarks that
#' are written are read back identically, except where the list below says otherwise.
#'
#' | extension | from | specimens in a file | curves |
#' |---|---|---|---|
#' | `.csv` | tables | one; several are read | yes |
#' | `.pts` | IDAV Landmark, Checkpoint | one | open, by number |
#' | `.tps` | tpsDig and kin | several | yes |
#' | `.nts`, `.dta` | NTSYS, IDAV Landmark | several | no; a shape's as points |
#' | `.landmarkAscii` | Amira, Avizo | several | no; a shape's as points |
#' | `.fcsv` | 3D Slicer | one | no; a shape's as points |
#' | `.mrk.json` | 3D Slicer | one | yes |
#' | `.pp` | MeshLab | one | no; a shape's as points |
#' | `.ckpt` | Checkpoint | one, read only | no |
#'
#' * `.csv`: fields are separated by commas, tabs or semicolons; with semicolons, decimals may be
#'   points or commas. There is a header line. The name is in a column `name`, `landmark` or
#'   `label`, otherwise in the first column that is not a number. The co-ordinates are in columns
#'   `x`, `y`, `z`, in any order. Tables that 3D Slicer exports have `r`, `a`, `s` or `l`, `p`, `s`
#'   in their place; `defined` 0 marks a missing landmark. A row with a name in a column `curve` is
#'   a point of that curve. A column `point` gives the order of the points. A curve is closed if its
#'   column `closed` is TRUE. A column that names specimens (`specimen`, `subject`, `file`, `scan`,
#'   ...; `id` if landmarks repeat) gives a list of specimens. Other columns are ignored. A missing
#'   landmark has NA or an empty field. A row with more or fewer fields than the header is refused.
#'   A line `sep=;`, comments (#) above the header, empty rows and columns, and a separator at the
#'   end of all rows are ignored.
#' * `.pts`: names may have spaces. `C000-001` is a point of curve `C000`. Curves of other names get
#'   numbers, and closed ones are opened, with a warning.
#' * `.tps`: `CURVES=` are open, `OUTLINES=` closed. The format has no names of landmarks and
#'   curves, so they are stored in `COMMENT=` lines. A specimen's name is its `ID=`, else its
#'   `IMAGE=`, else its number. Negative co-ordinates are numbers, not missing. [read_specimen()]
#'   takes a file of one specimen whatever this name is, with a message if both this name and the
#'   file's are not the specimen's.
#' * `.nts`, `.dta`: the header gives a code for missing values. The code is used if the header
#'   announces missing values, or if all co-ordinates of a point have it. Names of landmarks are
#'   stored in a comment.
#' * `.landmarkAscii`: sets of co-ordinates are specimens. Names are stored among the parameters,
#'   and missing landmarks are NaN. Not every program reads these.
#' * `.fcsv`: points in another state than "defined" are missing. Names are the labels, else the
#'   ids.
#' * `.mrk.json`: all lists of the file are read. Fiducial lists are landmarks. If two lists share
#'   labels, the list's name is put before the label. Curve, ClosedCurve, Line and Angle are curves
#'   of control points. Lists of other types are left out with a warning. Numbers stay in the file's
#'   unit.
#' * `.pp`: a point that is not active is missing.
#' * `.ckpt`: single points are read, in the file's unit. Points of curves and patches are left out
#'   with a warning.
#'
#' The provenance of a specimen or shape (see [summary.specimen()]) is written to formats in which
#' other programs ignore it. In `.tps` it is in `COMMENT=`, in `.nts` and `.dta` in comment lines,
#' in `.mrk.json` in a field `provenance`. The formats `.csv`, `.pts`, `.fcsv`, `.landmarkAscii` and
#' `.pp` do not get it, as it would disturb some programs.
#'
#' Other programs: MorphoJ and tpsDig read `.tps`. They skip curves, so write all points as
#' landmarks: `write_landmarks(as.array(sample, "curves"), "curves.tps")`. An `aligned` is written
#' as it is, mostly with unit size; its sizes (`aligned$size`) are not written. A table of all
#' points of a sample is `write.csv(as.data.frame(sample), "sample.csv")`.
#'
#' If `file` is a folder, all its landmark files are read. Each specimen is named after its file. In
#' a file of several specimens the names in the file are used. Two files of one specimen must agree.
#' Empty and compressed files, pipes and devices are refused before they are opened.
#'
#' The landmarks and curves of a `shape` are written; missing points are written as missing. If the
#' format has no curves, their points are written as landmarks with a warning. Their names are
#' "curve point", as in [coords()]. `curves = list()` leaves the curves out. [read_curves()] reads
#' curves by name from all formats.
#'
#' @param file Path of the file. `read_landmarks()` also takes the path of a folder.
#' @param frame Frame of the co-ordinates, for the formats of 3D Slicer only. The frames "LPS"
#'   (left, posterior, superior) and "RAS" (right, anterior, superior) differ in the signs of x and
#'   y. Slicer saves meshes in "LPS" by default; its scene is in "RAS". `read_landmarks()` turns the
#'   co-ordinates into this frame; "file" leaves the numbers as they are. `write_landmarks()` writes
#'   the frame of `x` into the file.
#' @param missing Number that stands for a missing co-ordinate in `.pts` files. A point is missing
#'   if all three co-ordinates are this number.
#' @param scale Whether the co-ordinates of a `.tps` file are multiplied by `SCALE=`. A file in
#'   which only some specimens have one is refused.
#' @param x Landmarks: a k x 3 numeric matrix with row names (missing landmarks NA), a data frame
#'   with columns `name`, `x`, `y`, `z`, a [specimen()], or a `shape` of [fit_shape()]. NULL: no
#'   landmarks. Formats of several specimens also take a list of these, a k x 3 x n array, a
#'   `shape_sample`, a `shape_batch` or an `aligned`.
#' @param curves Curves that are written: a named list of n x 3 matrices, of data frames with
#'   columns `x`, `y`, `z`, or of values of [ridge_curve()]. The attribute `closed` of a matrix is
#'   TRUE for a closed curve. NULL: the curves of the shape, or the attribute `curves` of `x`, if
#'   there is one. `list()`: none.
#' @return `read_landmarks()`: k x 3 numeric matrix with row names and columns `x`, `y`, `z`, in the
#'   file's unit and order. A missing landmark has three NA. Points of two-dimensional files have
#'   z = 0. Landmarks without a name are numbered. If the file has curves, the attribute `curves`
#'   has them: a named list of n x 3 matrices, each with the attribute `closed`. A folder, or a file
#'   of several specimens, gives a named list of such matrices. A file of one specimen gives a
#'   matrix without the specimen's name. `write_landmarks()`: `file`,
#'   invisibly. Errors are of class `crestline_landmark_error`; they name the file, the line and
#'   the remedy.
#' @template glossary
#' @examples
#' file <- tempfile(fileext = ".csv")
#' write_landmarks(rbind(pn = c(0, 1, 2), sn = c(NA, NA, NA)), file)
#' read_landmarks(file)
#'
#' slicer <- tempfile(fileext = ".mrk.json")
#' rim <- structure(rbind(c(0, 0, 0), c(1, 0, 0), c(0, 1, 0)), closed = TRUE)
#' write_landmarks(rbind(pn = c(0, 1, 2)), slicer, curves = list(rim = rim))
#' read_landmarks(slicer)
#' @export
read_landmarks <- function(file, frame = c("LPS", "RAS", "file"), missing = 9999, scale = TRUE) {
  check_given()
  check_flags(scale)
  if (is.character(file) && length(file) == 1 && isTRUE(dir.exists(file))) {
    return(read_landmark_folder(file, frame = frame, missing = missing, scale = scale))
  }
  found <- read_sets(file, frame, missing, scale)
  if (is.matrix(found)) return(found)
  attr(found, "numbered") <- attr(found, "alias") <- attr(found, "twice") <- NULL
  if (length(found) == 1) found[[1]] else found
}

#' One matrix, or a named list of them whose attributes say whether the names are but numbers of
#' ours (`numbered`), and other names (`alias`)
#' @noRd
read_sets <- function(file, frame = "LPS", missing = 9999, scale = TRUE) {
  check_file(file, "landmarks")
  options <- list(frame = check_choice(frame, c("LPS", "RAS", "file"), "frame"),
                  missing = check_number(missing, "missing"), scale = isTRUE(scale))
  format <- landmark_format(file)
  check_stored(file, "landmarks")
  found <- format$read(file, options)
  # Refuses a file in which a specimen's name stands over different landmarks
  if (!is.matrix(found)) {
    for (name in unique(names(found)[duplicated(names(found))])) {
      if (same_sets(found[names(found) == name])) next
      refuse_landmark_file(file,
                           sprintf("the specimen %s is there twice with different landmarks", name),
                           "Give each specimen a name of its own, or leave one of them.")
    }
  }
  found
}

#' @rdname read_landmarks
#' @export
write_landmarks <- function(x, file, curves = NULL, frame = c("LPS", "RAS"), missing = 9999) {
  check_given()
  if (is.null(x) && is.null(curves)) {
    refuse_argument("x", x, "Give landmarks, a specimen or a shape.")
  }
  format <- landmark_format(file)
  if (is.null(format$write)) {
    refuse_landmark_file(file, "this format is read, not written",
                         "Write a .pts file, which Checkpoint reads.")
  }
  options <- list(frame = check_choice(frame, c("LPS", "RAS"), "frame"),
                  missing = check_number(missing, "missing"))
  sets <- written_sets(x, curves, file)
  has_shape <- inherits(x, "shape") || is.list(x) && any(vapply(x, inherits, TRUE, "shape"))
  if (!format$curves && has_shape) sets <- curves_as_points(sets, file)
  with_curves <- vapply(sets, function(x) length(attr(x, "curves")) > 0, TRUE)
  if (length(sets) > 1 && !format$several) {
    refuse_landmark_file(file, sprintf("the format holds one specimen, not %d", length(sets)),
                         paste("Write a file for each, or a .tps, .nts, .dta or .landmarkAscii",
                               "file. A table of all: write.csv(as.data.frame(x), file)."))
  }
  if (any(with_curves) && !format$curves) {
    refuse_landmark_file(
      file, "the format holds no curves",
      paste0("Write a .mrk.json, .tps, .pts or .csv file, or leave them out ",
             "with curves = list().")
    )
  }
  name <- c(names(sets), unlist(lapply(sets, function(x) c(rownames(x), names(attr(x, "curves"))))))
  wrong <- anyDuplicated(names(sets)) > 0 || any(grepl("[\r\n]", name) | !nzchar(name))
  if (wrong || any(names(sets) != trimws(names(sets)))) {
    refuse_landmark_file(
      file, "a name is empty or holds a line break, or two specimens have the same",
      paste0("Give every specimen, landmark and curve a name of its own, in ",
             "one line, no blanks at the ends.")
    )
  }
  format$write(sets, file, options)
  invisible(file)
}

# Every format: read = function(file, options), a matrix or a named list of them; write =
# function(sets, file, options), sets such a list; whether it holds several specimens, and curves.
landmark_formats <- function() {
  nts <- list(read = read_landmarks_nts, write = write_landmarks_nts, several = TRUE,
              curves = FALSE)
  list(csv = list(read = read_landmarks_csv, write = write_landmarks_csv, several = FALSE,
                  curves = TRUE),
       pts = list(read = read_landmarks_pts, write = write_landmarks_pts, several = FALSE,
                  curves = TRUE),
       tps = list(read = read_landmarks_tps, write = write_landmarks_tps, several = TRUE,
                  curves = TRUE),
       nts = nts, dta = nts,
       landmarkAscii = list(
         read = read_landmarks_amira, write = write_landmarks_amira, several = TRUE, curves = FALSE
       ),
       fcsv = list(read = read_landmarks_fcsv, write = write_landmarks_fcsv, several = FALSE,
                   curves = FALSE),
       mrk.json = list(read = read_landmarks_mrkjson, write = write_landmarks_mrkjson,
                       several = FALSE, curves = TRUE),
       pp = list(read = read_landmarks_pp, write = write_landmarks_pp, several = FALSE,
                 curves = FALSE),
       ckpt = list(read = read_landmarks_ckpt, write = NULL, several = FALSE, curves = FALSE))
}

# The specimens to be written: a named list of matrices, each with its list of checked curves.
written_sets <- function(x, curves, file) {
  # The specimens of an array, a sample, a batch or an alignment, as a list; anything else as it is
  if (inherits(x, "shape_sample")) x <- x$shapes
  if (inherits(x, "shape_batch")) x <- as.list(x)
  if (inherits(x, "aligned")) x <- x$coords
  if (is.array(x) && length(dim(x)) == 3) x <- array_sets(x)
  none <- if (is.list(x) && !is.object(x)) which(vapply(x, is.null, NA))
  if (length(none)) {
    name <- if (is.null(names(x))) none else names(x)[none]
    refuse_landmark_file(file, sprintf("there is nothing of %s", shorten(name)),
                         "Leave out what failed.")
  }
  if (is.null(x) || is.data.frame(x) || is.matrix(x) || inherits(x, c("specimen", "shape")) ||
      !is.list(x)) {
    id <- if (inherits(x, c("specimen", "shape"))) x$id else "1"
    return(stats::setNames(list(written_set(x, curves)), id))
  }
  if (!length(x) || !is.null(curves) && length(x) > 1) {
    refuse_landmark_file(file, "`x`: curves go with one specimen, and there must be one",
                         "Give each matrix of the list its curves as attribute `curves`.")
  }
  sets <- lapply(x, written_set, curves = curves)
  if (is.null(names(x))) {
    is_specimen <- vapply(x, inherits, TRUE, c("specimen", "shape"))
    names(sets) <- if (all(is_specimen)) vapply(x, `[[`, "", "id") else as.character(seq_along(x))
  }
  sets
}

written_set <- function(x, curves) {
  own <- written_landmarks(x)
  if (is.null(curves)) curves <- own$curves
  comments <- comment_lines(x)
  x <- as_landmarks(own$landmarks)
  curves <- as_curves(curves)
  structure(x, curves = if (length(curves)) curves,
            comments = if (length(comments)) paste("provenance,", comments))
}

#' The landmarks and curves of what is written
#' @return List: `landmarks`, `curves` (NULL: none).
#' @noRd
written_landmarks <- function(x) UseMethod("written_landmarks")

#' @exportS3Method
written_landmarks.default <- function(x) list(landmarks = x, curves = attr(x, "curves"))

# A named list of n x 3 matrices, each with attribute `closed`.
as_curves <- function(x) {
  name <- names(x)
  if (length(x) && (!is.list(x) || is.null(name) || anyNA(name) || any(!nzchar(name)) ||
                    anyDuplicated(name))) {
    refuse_landmarks("`curves` is not a list with a name of its own for each.",
                     "Give list(name = n x 3 matrix, ...).", id = NULL)
  }
  Map(as_curve, as.list(x), as.character(name))
}

as_curve <- function(x, name) {
  closed <- isTRUE(attr(x, "closed")) || inherits(x, "curve") && isTRUE(x$closed)
  if (inherits(x, "curve")) x <- as.data.frame(x)
  if (is.data.frame(x) && all(c("x", "y", "z") %in% names(x))) x <- as.matrix(x[c("x", "y", "z")])
  if (!is.numeric(x) || !is.matrix(x) || ncol(x) != 3 || !nrow(x)) {
    refuse_landmarks(
      sprintf(paste0("`curves`: curve %s is %s, not an n x 3 numeric matrix with a ",
                     "row at least."),
              name, describe_shape(x)),
      "Give a matrix with one row a point, or a data frame with x, y, z.", id = NULL
    )
  }
  x[!is.finite(x)] <- NA
  landmark_curve(x, closed)
}

landmark_format <- function(file) {
  if (!is_path(file)) refuse_no_path(file, "landmarks")
  formats <- landmark_formats()
  extension <- sub("^(mrk[.])?json$", "mrk.json", file_extension(file))
  format <- match(extension, tolower(names(formats)))
  if (is.na(format)) {
    first <- if (extension %in% c("gz", "bz2", "xz", "zip")) "Unpack it first. " else
      if (extension %in% c("xlsx", "xls", "ods")) "Save the sheet as CSV. " else
      if (extension == "txt") "Read Morphologika by geomorph::read.morphologika(). "
    crestline_abort(
      sprintf("`file`: no landmark format has the extension of %s.", basename(file)),
      paste0(first, "Known: ", paste0(".", names(formats), collapse = ", "), "."),
      stage = "landmarks", class = "crestline_landmark_error", call = NULL
    )
  }
  formats[[format]]
}

#' Sets whose curves are landmarks named "curve point", as in [coords()]
#' @noRd
curves_as_points <- function(sets, file) {
  curves <- lapply(sets, attr, "curves")
  if (!any(lengths(curves) > 0)) return(sets)
  crestline_warn(
    sprintf("%s: the format has no curves: their points are written as landmarks, %s.",
            basename(file), sprintf("\"%s 1\" and so on", unlist(lapply(curves, names))[1])),
    "read_curves() gives them back; curves = list() leaves them out.", stage = "landmarks",
    class = "crestline_format_warning"
  )
  Map(function(set, curves) {
    names <- paste(rep(names(curves), vapply(curves, nrow, 0L)),
                   unlist(lapply(curves, function(x) seq_len(nrow(x)))))
    points <- do.call(rbind, c(list(set), unname(curves)))
    rownames(points) <- c(rownames(set), names)
    structure(as_landmarks(points), comments = attr(set, "comments"))
  }, sets, curves)
}

#' @param ... As of read_sets().
#' @return Named list of matrices: by file, or by the names in a file of several specimens. Two of
#'   one specimen must agree.
#' @noRd
read_landmark_folder <- function(dir, ...) {
  file <- landmark_folder(dir)
  sets <- do.call(c, unname(Map(function(path, name) {
    found <- read_sets(path, ...)
    if (is.matrix(found)) found <- list(found)
    if (isTRUE(attr(found, "numbered"))) names(found) <- paste(name, seq_along(found))
    if (length(found) == 1) names(found) <- name
    found
  }, file, names(file))))
  name <- names(sets)
  for (twice in unique(name[duplicated(name)])) {
    if (!same_sets(sets[name == twice])) {
      from <- basename(file[names(file) == twice])
      from <- if (length(from) > 1) paste0(": ", shorten(from))
      refuse_landmarks(paste0(dir, " has different landmarks of ", twice, from, "."),
                       "Leave one of them.", id = NULL)
    }
  }
  sets[!duplicated(name)]
}

#' The landmark files of a folder, named by specimen
#' @noRd
landmark_folder <- function(dir) {
  file <- list.files(dir, full.names = TRUE)
  known <- paste0("[.](", paste(c(names(landmark_formats()), "json"), collapse = "|"), ")$")
  file <- file[grepl(known, file, ignore.case = TRUE)]
  file <- file[vapply(file, is_landmark_file, NA)]
  if (!length(file)) {
    known <- paste0(".", names(landmark_formats()), collapse = ", ")
    refuse_landmarks(sprintf("the folder %s has no landmark files.", dir),
                     sprintf("Known: %s.", known), id = NULL)
  }
  name <- sub("_picked_points[.]pp$", "", basename(file), ignore.case = TRUE)
  stats::setNames(file, sub(id_extension(), "", name, ignore.case = TRUE))
}

#' Whether a file of a format's extension holds landmarks, as far as other programs use the
#' extension too
#' @noRd
is_landmark_file <- function(file) {
  if (dir.exists(file)) return(FALSE)
  other <- grepl("(?<![.]mrk)[.]json$", tolower(file), perl = TRUE)
  if (!other || !isTRUE(file.size(file) > 0)) return(TRUE)
  content <- tryCatch(jsonlite::parse_json(paste(file_lines(file), collapse = "\n")),
                      error = function(e) NULL)
  is.null(content) || !is.null(names(content)) && "markups" %in% names(content)
}

#' Whether sets, perhaps in files, are all the same
#' @noRd
same_sets <- function(sets) {
  if (length(sets) < 2) return(TRUE)
  sets <- lapply(sets, function(one) if (is.character(one)) read_landmarks(one) else one)
  all(vapply(sets[-1], same_landmarks, NA, sets[[1]]))
}

#' Whether two sets have the same landmarks in the same places
#'
#' @param tolerance Greatest difference of a co-ordinate, as a share of the extent of the landmarks:
#'   formats differ in their digits (Slicer's .fcsv has three behind the point, 5e-6 of a face).
#' @noRd
same_landmarks <- function(a, b, tolerance = 1e-4) {
  if (is.list(a) || is.list(b)) return(identical(a, b))
  if (!setequal(rownames(a), rownames(b))) return(FALSE)
  b <- b[rownames(a), , drop = FALSE]
  if (!identical(is.na(unname(a)), is.na(unname(b)))) return(FALSE)
  extent <- max(abs(sweep(a, 2, colMeans(a, na.rm = TRUE))), 0, na.rm = TRUE)
  max(abs(a - b), 0, na.rm = TRUE) <= tolerance * extent
}

#' The matrices of a k x 3 x n array, by its names of specimens; its points numbered where they have
#' no names
#' @noRd
array_sets <- function(x) {
  point <- if (is.null(dimnames(x)[[1]])) as.character(seq_len(dim(x)[1])) else dimnames(x)[[1]]
  sets <- lapply(seq_len(dim(x)[3]), function(i) {
    matrix(x[, , i], dim(x)[1], dim(x)[2], dimnames = list(point, NULL))
  })
  stats::setNames(sets, dimnames(x)[[3]])
}
