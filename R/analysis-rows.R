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

#' The co-ordinates of some points, one matrix a dimension, columns centred and multiplied
#'
#' @param rows Whole numbers in a row: which points.
#' @param factor As in [shape_rows()], of these points.
#' @return List of d matrices, n x the number of points.
#' @noRd
columns_of_points <- function(aligned, rows, factor = 1) UseMethod("columns_of_points")

columns_of_points.aligned <- function(aligned, rows, factor = 1) {
  k <- nrow(aligned$mean)
  each <- numbers_by_specimen(aligned)
  by <- rep_len(as.double(factor), length(rows))
  lapply(seq_len(ncol(aligned$mean)), function(d) {
    cpp_centred_rows(each, (d - 1L) * k + rows[1], by)
  })
}

#' Points taken at a time, so that no more than some of the numbers are made anew
#' @param most Greatest number of numbers: 16 MB, and of files 160 MB, as each chunk opens all
#'   files.
#' @return List of rows of points.
#' @noRd
point_chunks <- function(aligned, most = if (inherits(aligned, "aligned_files")) 2e7 else 2e6) {
  size <- max(1, floor(most / (length(aligned) * ncol(aligned$mean))))
  permutation_blocks(nrow(aligned$mean), size)
}

#' Sum of a function of all co-ordinates, some points at a time
#'
#' @param f Function of an n x q matrix, columns centred and of the weights of the alignment.
#' @return Sum of its values over the points; of lists, by member.
#' @noRd
over_points <- function(aligned, f, weights = aligned$weights) {
  root <- sqrt(weights)
  add <- function(a, b) if (is.list(a)) Map(`+`, a, b) else a + b
  found <- NULL
  for (rows in point_chunks(aligned)) {
    own <- f(do.call(cbind, columns_of_points(aligned, rows, root[rows])))
    found <- if (is.null(found)) own else add(found, own)
  }
  found
}

#' Inner products of the specimens, summed in place: one n x n matrix is made, and parts of it
#'
#' @param block Specimens at a time.
#' @return n x n.
#' @noRd
inner_products <- function(aligned, block = 500) {
  n <- length(aligned)
  root <- sqrt(aligned$weights)
  blocks <- permutation_blocks(n, block)
  gram <- matrix(0, n, n)
  for (rows in point_chunks(aligned)) {
    for (y in columns_of_points(aligned, rows, root[rows])) {
      for (own in blocks) {
        before <- seq_len(max(own))
        # Of the first block the symmetric product, which costs half.
        later <- if (own[1] > 1) y[own, , drop = FALSE]
        gram[before, own] <- gram[before, own] + tcrossprod(y[before, , drop = FALSE], later)
      }
    }
  }
  for (own in blocks[-1]) {
    before <- seq_len(min(own) - 1)
    gram[own, before] <- t(gram[before, own])
  }
  gram
}

#' Sum of the squares of a matrix, some columns at a time
#' @noRd
sum_of_squares <- function(x, block = 500) {
  sum(vapply(permutation_blocks(ncol(x), block), function(columns) sum(x[, columns]^2), 0))
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
weighted_shape <- function(aligned, weight) UseMethod("weighted_shape")

weighted_shape.aligned <- function(aligned, weight) {
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
