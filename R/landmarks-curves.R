# Curves in landmark files: those of a shape, as curves or as named points, and back by name.

#' Read curves from a landmark file, by name
#'
#' Reads the curves of a file that [write_landmarks()] or another program wrote. Some formats have
#' no curves. There `write_landmarks()` stores curves as points named "curve 1", "curve 2", ..., and
#' `read_curves()` makes curves of them again.
#'
#' @param file Path of the file, see [read_landmarks()].
#' @param curves Names of the curves to read; the value has them in this order. NULL: all.
#' @param ... Further arguments of [read_landmarks()].
#' @return Named list with one n x 3 matrix for each curve: columns `x`, `y`, `z`, in the file's
#'   unit; NA in missing points; attribute `closed` (TRUE or FALSE). A file of several specimens
#'   gives a named list of such lists. Argument `curves` of [fit_shape()] takes such curves.
#' @section Errors: of class `crestline_landmark_error`: a curve is not in the file (the error lists
#'   similar names). The errors of [read_landmarks()] can occur too.
#' @template glossary
#' @examples
#' file <- tempfile(fileext = ".csv")
#' lips <- list("upper lip" = rbind(c(0, 1, 2), c(1, 1, 3)),
#'              "lower lip" = rbind(c(0, 0, 2), c(1, 0, 3)))
#' write_landmarks(NULL, file, curves = lips)
#' read_curves(file, "lower lip")
#' @export
read_curves <- function(file, curves = NULL, ...) {
  check_given()
  check_dots(..., known = names(formals(read_landmarks))[-1])
  curves <- check_names(curves, "curves", null = TRUE)
  sets <- read_landmarks(file, ...)
  of_set <- function(set) {
    found <- attr(set, "curves")
    if (is.null(found)) found <- {
      part <- regmatches(rownames(set), regexec("^(.*\\S) ([1-9][0-9]*)$", rownames(set)))
      row <- which(lengths(part) == 3)
      name <- vapply(part[row], `[`, "", 2)
      number <- as.numeric(vapply(part[row], `[`, "", 3))
      rows <- lapply(stats::setNames(nm = unique(name)),
                     function(one) row[name == one][order(number[name == one])])
      whole <- vapply(names(rows),
                      function(one) identical(
                        sort(number[name == one]), as.numeric(seq_along(rows[[one]]))
                      ),
                      NA)
      lapply(rows[whole & lengths(rows) > 1], function(at) landmark_curve(set[at, , drop = FALSE]))
    }
    if (is.null(curves)) return(found)
    absent <- setdiff(curves, names(found))
    if (length(absent)) {
      remedy <- if (length(found)) near_names(absent[1], names(found)) else
        "The file has no curves."
      refuse_landmark_file(file, sprintf("there is no curve %s", shorten(absent)), remedy)
    }
    found[curves]
  }
  if (is.list(sets)) lapply(sets, of_set) else of_set(sets)
}
