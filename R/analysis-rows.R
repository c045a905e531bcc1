# Matrices of specimens by variables, as statistics need them.

#' Aligned configurations as rows: a specimen each, columns centred and multiplied
#'
#' One array is made, none on the way.
#'
#' @param aligned An `aligned`.
#' @param factor What the columns of each point are multiplied by: k, or one for all.
#' @param dimension Which co-ordinates of every point.
#' @return n x q, q the co-ordinates, point by point and then dimension by dimension.
#' @noRd
shape_rows <- function(aligned, factor = sqrt(aligned$weights),
                       dimension = seq_len(ncol(aligned$mean))) {
  k <- nrow(aligned$mean)
  cpp_centred_rows(numbers_by_specimen(aligned), (dimension[1] - 1L) * k + 1L,
                   rep(rep_len(as.double(factor), k), length(dimension)))
}

#' The specimens as matrices of doubles, without an array of all
#' @noRd
numbers_by_specimen <- function(aligned) {
  each <- as.list(aligned)
  whole <- !vapply(each, is.double, NA)
  each[whole] <- lapply(each[whole], `storage.mode<-`, "double")
  each
}

#' Sum of the specimens, each times its weight
#' @return k x d matrix.
#' @noRd
weighted_shape <- function(aligned, weight) {
  matrix(cpp_weighted_sum(numbers_by_specimen(aligned), as.double(weight)), nrow(aligned$mean),
         dimnames = dimnames(aligned$mean))
}

#' Squares of all entries by row, about the mean of the row's group
#'
#' @param y n x q, columns centred.
#' @param code Group numbers; the mean of all is 0.
#' @noRd
squares_by_row <- function(y, code = NULL) {
  if (is.null(code)) {
    return(cpp_squared_distances(y, matrix(0, 1, ncol(y)), rep(1L, nrow(y))))
  }
  cpp_squared_distances(y, rowsum(y, code) / tabulate(code), code)
}
