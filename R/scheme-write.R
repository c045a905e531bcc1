# A scheme's tables written to a folder of CSV files.

#' Write a scheme to a folder
#'
#' @param scheme A [curve_scheme()].
#' @param dir Path of the folder; it is created if it does not exist. Tables of a scheme in it are
#'   replaced.
#' @return `dir`, invisibly. `read_scheme(dir)` gives the same scheme, with the same numbers.
#' @section Errors: of class `crestline_error`: the folder or a file cannot be written.
#' @template glossary
#' @seealso [read_scheme()], [learn_tracks()]
#' @examples
#' dir <- tempfile()
#' write_scheme(face_scheme(), dir)
#' list.files(dir)
#' @export
write_scheme <- function(scheme, dir) {
  check_given()
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  if (!is_path(dir)) {
    crestline_abort(sprintf("`dir` is %s.", describe_value(dir)), "Give the path of one folder.",
                    stage = "writing")
  }
  if (!dir.exists(dir) && !suppressWarnings(dir.create(dir, recursive = TRUE))) {
    crestline_abort(sprintf("`dir`: %s cannot be made.", dir),
                    "Check the path and the right to write there.", stage = "writing")
  }
  for (name in names(scheme_columns)) {
    # A table of another scheme in this folder is not left to be read with this one.
    file <- scheme_file(name, dir)
    if (NROW(scheme[[name]])) write_content(csv_table(scheme[[name]]), file) else unlink(file)
  }
  invisible(dir)
}

#' A table as lines of CSV, its numbers to the last digit
#' @noRd
csv_table <- function(table) {
  cells <- lapply(table, function(column) {
    if (is.numeric(column)) return(number_text(column, missing = ""))
    ifelse(is.na(column), "", quote_name(as.character(column)))
  })
  enc2utf8(c(paste(quote_name(names(table)), collapse = ","),
             do.call(paste, c(unname(cells), sep = ","))))
}
