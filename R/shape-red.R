# Red parts of shapes: which there are, and a warning that names them.

#' Red parts that have points, of shapes that were measured on a mesh
#'
#' A part that is red only because points are missing is none: the points that are there are right.
#'
#' @param shapes Named list of shapes.
#' @return Rows of [quality()]; those of landmarks, curves and patches.
#' @noRd
red_parts <- function(shapes, limits) {
  graded <- Filter(function(shape) !is.null(shape$checks), shapes)
  if (!length(graded)) return(NULL)
  limits$missing <- c(Inf, Inf)
  table <- as.data.frame(quality(graded, limits))
  table[table$grade == "red" & table$missing < 1, ]
}

#' Warn of red parts that are used as they are
#'
#' @param parts As of [red_parts()].
#' @noRd
warn_red <- function(parts, stage, remedy, most = 6) {
  if (!NROW(parts)) return(invisible())
  owners <- split(parts$specimen, factor(titled_parts(parts), unique(titled_parts(parts))))
  owners <- owners[order(-lengths(owners))]
  named <- sprintf("%s (%s)", names(owners), vapply(owners, shorten, "", 4))
  crestline_warn(
    sprintf("%s: %s.",
            amount(nrow(parts), "part is red, and is used as it is",
                   "parts are red, and are used as they are"), shorten(named, most)),
    remedy, stage = stage, class = "crestline_red_parts"
  )
}
