# A scheme's tables in a folder of CSV files.

#' Read a scheme from a folder
#'
#' @param dir Folder with `landmarks.csv` and `curves.csv`. It may also have `patches.csv`,
#'   `pairs.csv`, `strips.csv`, `definitions.csv` and `tracks.csv`. Each file has a header line and
#'   the columns of the table in [curve_scheme()]; cells may be empty. Fields are separated by
#'   commas, tabs or semicolons; with semicolons, decimals may be points or commas. A row with more
#'   or fewer cells than the header is refused.
#' @param name Name of the scheme, one string. Default: the folder's name.
#' @return As [curve_scheme()].
#' @section Errors: of class `crestline_scheme_error`: the folder or a file does not exist or cannot
#'   be read, or a table has mistakes (see [curve_scheme()]). The error names the file.
#' @section Warnings: of class `crestline_unread_table`: a table is missing, and a file has nearly
#'   its name (`pair.csv`).
#' @template glossary
#' @seealso [write_scheme()]
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
  file <- vapply(tables, scheme_file, "", dir)
  warn_near_tables(dir, file)
  assembled_scheme(lapply(file, read_scheme_table), name,
                   labels = stats::setNames(basename(file), tables))
}

#' The file of a table, in any case of its letters
#' @noRd
scheme_file <- function(table, dir) {
  name <- paste0(table, ".csv")
  found <- list.files(dir)
  found <- found[tolower(found) == name]
  if (length(found) > 1) {
    crestline_abort(sprintf("there are several files of the table %s: %s.", table, shorten(found)),
                    "Leave one of them.", stage = "scheme", class = "crestline_scheme_error",
                    call = NULL)
  }
  file.path(dir, c(found, name)[1])
}

#' A warning of files whose names are nearly those of tables that are not there
#'
#' @param letters Most letters by which the names differ.
#' @noRd
warn_near_tables <- function(dir, file, letters = 2) {
  other <- setdiff(list.files(dir, "[.]csv$", ignore.case = TRUE), basename(file))
  absent <- basename(file)[!file.exists(file)]
  near <- other[rowSums(utils::adist(other, absent, ignore.case = TRUE) <= letters) > 0]
  if (length(near)) {
    crestline_warn(sprintf("%s in %s is no table of a scheme, and not read.", shorten(near), dir),
                   sprintf("The tables are %s.", toString(basename(file))), stage = "scheme",
                   class = "crestline_unread_table")
  }
}

#' @return Data frame of text; `NULL` where there is no such file and none is needed.
#' @noRd
read_scheme_table <- function(file) {
  if (!file.exists(file) && !tolower(basename(file)) %in% c("landmarks.csv", "curves.csv")) {
    return(NULL)
  }
  check_file(file, "scheme", "dir")
  check_stored(file, "scheme")
  refuse <- function(problem, line = NULL) {
    where <- paste0(basename(file), if (!is.null(line)) sprintf(", line %d", as.integer(line)))
    crestline_abort(sprintf("%s cannot be read: %s.", where, problem),
                    "Give a header line and commas between the cells.",
                    stage = "scheme", class = "crestline_scheme_error", call = NULL)
  }
  table <- text_table(file_lines(file), refuse)
  columns <- scheme_columns[[sub("[.]csv$", "", tolower(basename(file)))]]
  numeric <- names(Filter(function(column) column$type %in% c("number", "count"), columns))
  decimal_points(table, intersect(numeric, names(table)), refuse)
}
