# A scheme's tables in a folder of CSV files.

#' Read a scheme from a folder
#'
#' @param dir Folder with `landmarks.csv`, `curves.csv` and, where there are such, `patches.csv`, `pairs.csv`,
#'   `strips.csv` and `definitions.csv`: comma-separated, a header line, the columns of [curve_scheme()], empty cells for what is not given.
#' @param name Name of the scheme; the folder's unless given.
#' @return As [curve_scheme()].
#' @section Errors: as [curve_scheme()], with the file's name for the table's; also for a folder or file that is
#'   not there or cannot be read.
#' @examples
#' face <- read_scheme(system.file("extdata", "face_scheme", package = "crestline"))
#' head(as.data.frame(face, "curves"))
#' @export
read_scheme <- function(dir, name = basename(dir)) {
  check_given()
  if (!missing(name)) name <- check_text(name, "name")
  if (!is_path(dir) || !dir.exists(dir)) {
    crestline_abort(sprintf("`dir`: there is no folder %s.", describe_value(dir)),
                    sprintf("Check the path; the working directory is %s.", getwd()),
                    stage = "scheme", class = "crestline_scheme_error", call = NULL)
  }
  tables <- names(scheme_columns)
  file <- stats::setNames(file.path(dir, paste0(tables, ".csv")), tables)
  build_scheme(lapply(file, read_scheme_table), name, labels = stats::setNames(basename(file), tables))
}

#' @return Data frame of text; `NULL` where there is no such file and none is needed.
#' @noRd
read_scheme_table <- function(file) {
  if (!file.exists(file) && !basename(file) %in% c("landmarks.csv", "curves.csv")) return(NULL)
  check_file(file, "scheme", "dir")
  tryCatch(
    utils::read.csv(text = file_lines(file), colClasses = "character", na.strings = "", strip.white = TRUE,
                    check.names = FALSE),
    error = function(e) {
      crestline_abort(sprintf("%s cannot be read: %s.", basename(file), conditionMessage(e)),
                      "Give a header line and commas between the cells.", stage = "scheme",
                      class = "crestline_scheme_error", call = NULL)
    }
  )
}
