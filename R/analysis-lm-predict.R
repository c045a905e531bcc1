# The shapes that a linear model expects.

#' Predict shapes by a linear model
#'
#' Gives the expected configuration for each row of new values. Examples are the mean face at an age
#' of 12 and of 40, or the mean face of each sex at the same size.
#'
#' @param object A `shape_lm`, as [shape_lm()] returns it.
#' @param newdata Data frame with the model's variables, a row for each shape. `size` is the
#'   centroid size of this level; levels have different sizes. Its row names become the names of the
#'   shapes. `NULL`: the fitted shapes of the sample.
#' @param level Level of the model. `NULL`: its first level.
#' @param as "array", or "mesh" for a list of `mesh3d`; the level must have triangles.
#' @param size Centroid size of the shapes, in the unit of the meshes. "mean": the mean size of the
#'   sample. "fitted": the `size` of `newdata` if it is in the formula, else the geometric mean size
#'   that the same terms predict. Or a number (1: unit size). Ignored if the alignment kept sizes.
#' @param ... Ignored.
#' @return A k x 3 x m array with the names of the points and shapes, or a list of m meshes, as of
#'   [shape_at()]. [draw_surface()] draws a mesh.
#' @section Errors: of class `crestline_error`:
#'   * `newdata` lacks a variable, has a missing value, or has a level of a factor that the sample
#'     lacks;
#'   * the sample has no data for a combination of values;
#'   * the level has no triangles for a mesh.
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
size_at <- function(size, x, newdata, model, aligned) {
  if (is.numeric(size)) return(check_number(size, "size", lower = 0, open = TRUE))
  if (check_choice(size, c("mean", "fitted"), "size") == "mean") return(mean(aligned$size))
  if ("size" %in% model$variables) {
    return(if (is.null(newdata)) aligned$size else newdata$size)
  }
  beta <- qr.coef(qr(model$matrix, tol = 1e-7), log(unname(aligned$size)))
  beta[is.na(beta)] <- 0
  exp(drop(x %*% beta))
}
