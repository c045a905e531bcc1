# Landmarks in files: the format by the file's extension, one file of code a format.

#' Read and write landmarks
#'
#' The format goes by the file's extension. `.csv`: a header line; the name in a column `name`,
#' `landmark` or `label` (any case, otherwise the first column that is not a number), the
#' co-ordinates in `x`, `y`, `z`, in any order, other columns ignored. A missing landmark has NA or
#' nothing in its co-ordinates.
#'
#' @param file Path of the file.
#' @param x k x 3 numeric matrix with row names (missing landmarks NA), or a [specimen()].
#' @return `read_landmarks()`: k x 3 numeric matrix with row names and columns `x`, `y`, `z`, in the
#'   file's unit and order. `write_landmarks()`: `file`, invisibly. Co-ordinates are written with 15
#'   digits. Errors are of class `crestline_error` and name file and remedy.
#' @examples
#' file <- tempfile(fileext = ".csv")
#' write_landmarks(rbind(pn = c(0, 1, 2), sn = c(NA, NA, NA)), file)
#' read_landmarks(file)
#' @export
read_landmarks <- function(file) {
  check_file(file, "landmarks")
  landmark_format(file)$read(file)
}

#' @rdname read_landmarks
#' @export
write_landmarks <- function(x, file) {
  if (inherits(x, "specimen")) x <- x$landmarks
  landmark_format(file)$write(as_landmarks(x), file)
  invisible(file)
}

# Every format: list(read = function(file), write = function(x, file)).
landmark_formats <- function() list(csv = list(read = read_landmarks_csv, write = write_landmarks_csv))

landmark_format <- function(file) {
  format <- landmark_formats()[[file_extension(file)]]
  if (is.null(format)) {
    crestline_abort(
      sprintf("no landmark format has the extension of %s.", basename(file)),
      paste0("Known: ", paste0(".", names(landmark_formats()), collapse = ", "), "."),
      stage = "landmarks", call = NULL
    )
  }
  format
}

file_extension <- function(file) tolower(sub("^.*[.]|^[^.]*$", "", basename(file)))

check_file <- function(file, stage) {
  if (!is.character(file) || length(file) != 1 || is.na(file)) {
    crestline_abort(sprintf("`file` is %s.", describe_value(file)), "Give the path of one file.",
                    stage = stage, call = NULL)
  }
  if (!file.exists(file) || dir.exists(file)) {
    crestline_abort(sprintf("there is no file %s.", file),
                    sprintf("Check the path; the working directory is %s.", getwd()),
                    stage = stage, call = NULL)
  }
}
