# Facts of a shape in a batch that are known without reading its file.

#' Facts of a shape that a batch has without reading it
#'
#' @return List: `found`, whether its landmarks were; `lacking`, how many of the scheme's landmarks
#'   are missing, and of how many; `unit` as of [shape_unit()]; `surface`, the key of its mesh;
#'   `marks`, a hash of its landmarks; `red`, the number of its red parts. What is not known is NA.
#' @noRd
told_of <- function(shape) {
  if (is.null(shape)) return(nothing_told)
  if (inherits(shape, "kept_shape")) return(attributes(shape)[names(nothing_told)])
  landmarks <- shape$status$ok[shape$status$level == "landmarks"]
  list(found = has_found(shape), lacking = c(sum(!landmarks), length(landmarks)),
       unit = shape_unit(shape), surface = c(shape$key, NA_character_)[1],
       marks = content_hash(unname(coords(shape, "landmarks"))),
       red = NROW(red_parts(stats::setNames(list(shape), shape$id), quality_limits())))
}

nothing_told <- list(found = FALSE, lacking = c(0L, NA), unit = NA_real_, surface = NA_character_,
                     marks = NA_character_, red = NA_integer_)

#' What a file says that [told_of()] gives; nothing_told where it does not
#' @noRd
as_told <- function(about) {
  told <- Map(function(value, none) {
    if (length(value) != length(none)) return(none)
    storage.mode(value) <- storage.mode(none)
    value
  }, as.list(about)[names(nothing_told)], nothing_told)
  names(told) <- names(nothing_told)
  told
}

#' The elements of a batch as they are, without what makes it one
#' @noRd
plain_list <- function(x) {
  attributes(x) <- list(names = names(x))
  x
}
