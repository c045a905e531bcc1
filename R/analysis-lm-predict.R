# The shapes that a linear model expects.

#' The shapes that a linear model expects
#'
#' Gives the expected configuration for each row of new values: the mean face at an age of 12 and of
#' 40, or of each sex at the same size.
#'
#' @param object A `shape_lm`, as [shape_lm()] returns it.
#' @param newdata Data frame with the model's variables, a row a shape. Its row names become those
#'   of the shapes. `NULL`: the fitted shapes of the sample.
#' @param level Level; the first.
#' @param as "array", or "mesh": a list of `mesh3d`, where the level has triangles.
#' @param size Size of the shapes: "mean" (mean centroid size of the sample), "fitted" (the `size`
#'   of `newdata` if it is in the formula, else the geometric mean size that the same terms expect),
#'   or a number (1: unit size). Ignored where the alignment kept sizes.
#' @param ... Ignored.
#' @return A k x 3 x m array with the names of the points; or a list of m meshes, as of
#'   [shape_at()].
#' @section Errors: of class `crestline_error`: a variable that `newdata` lacks or that is missing
#'   in it, a level of a factor that the sample has not, a combination of values for which the
#'   sample has nothing, no triangles for a mesh.
#' @template glossary
#' @seealso [shape_lm()], [write_mesh()], [plot.shape_lm()]
#' @inherit shape_lm examples
#' @export
predict.shape_lm <- function(object, newdata = NULL, level = NULL, as = c("array", "mesh"),
                             size = "mean", ...) {
  check_method_dots(...)
  validate(object)
  as <- check_choice(as, c("array", "mesh"), "as")
  level <- if (is.null(level)) names(object$models)[1] else
    check_choice(level, names(object$models), "level")
  aligned <- object$aligned[[level]]
  model <- object$models[[level]]
  if (!is.null(newdata)) check_table(newdata, "newdata")
  x <- if (is.null(newdata)) model$matrix else model_at(model, newdata)
  beta <- model$coefficients
  beta[is.na(beta)] <- 0
  shapes <- array(t(x %*% beta), c(dim(aligned$mean), nrow(x)),
                  c(dimnames(aligned$mean), list(rownames(x))))
  if (!isFALSE(aligned$scale)) {
    shapes <- shapes * rep(size_at(size, x, newdata, model, aligned), each = length(aligned$mean))
  }
  if (as == "array") return(shapes)
  each <- lapply(seq_len(nrow(x)), function(i) points_mesh(
    unnamed_slice(shapes, i), aligned$triangles
  ))
  stats::setNames(each, rownames(x))
}

#' Sizes of predicted shapes
#' @noRd
size_at <- function(size, x, newdata, model, aligned, call = rlang::caller_env()) {
  if (is.numeric(size)) return(check_number(size, "size", lower = 0, open = TRUE, call = call))
  if (check_choice(size, c("mean", "fitted"), "size", call) == "mean") return(mean(aligned$size))
  if ("size" %in% model$variables) {
    return(if (is.null(newdata)) aligned$size else newdata$size)
  }
  beta <- qr.coef(qr(model$matrix, tol = 1e-7), log(unname(aligned$size)))
  beta[is.na(beta)] <- 0
  exp(drop(x %*% beta))
}
