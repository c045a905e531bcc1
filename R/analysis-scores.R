# Scores of shapes that were not in the sample: each laid onto the sample's mean.

#' Scores of new shapes on the principal components of a sample
#'
#' Superimposes each new shape on the mean of the sample, as [align()] does, and gives its scores.
#' Mean and components of the sample do not change. Shapes of the sample get their own scores.
#'
#' A new face must have the same points: fit it by the same scheme, then slide it against the
#' template of the sample, `slide(shape, sample$template)`. Missing points are estimated from the
#' mean by the thin-plate spline, with a message.
#'
#' @param object A `shape_pca`, as [shape_pca()] returns it.
#' @param newdata A `shape` that was slid against the sample's template; a `shape_sample`; an
#'   `aligned`; one configuration (k x 3 matrix); or an array (k x 3 x m). Points are matched by
#'   name. `NULL`: the scores of the sample. A matrix with 3k columns has aligned co-ordinates, as
#'   for [stats::prcomp()]; it is not superimposed.
#' @param ... Ignored.
#' @return m x r matrix of scores with the names of the shapes. Attribute `outside`: share of each
#'   shape's squared distance from the mean that is outside the space of the components (0 for the
#'   shapes of the sample).
#' @section Errors: of class `crestline_error`: the points are not those of the sample; a shape was
#'   slid against another template, or not at all.
#' @template glossary
#' @seealso [shape_pca()], [slide()], [shape_lda()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' shapes <- shapes + rnorm(120, sd = 0.05)
#' pca <- shape_pca(align(shapes))
#' new <- 3 * shapes[, , 1] + 10
#' predict(pca, new) - pca$x[1, ]
#' @export
predict.shape_pca <- function(object, newdata = NULL, ...) {
  check_method_dots(...)
  validate(object)
  if (is.null(newdata)) return(object$x)
  plain <- (is.matrix(newdata) || is.data.frame(newdata)) && ncol(newdata) == nrow(object$rotation)
  if (plain && ncol(newdata) != ncol(object$mean)) {
    flat <- as.matrix(newdata)
    rows <- rownames(object$rotation)
    if (!is.null(colnames(flat)) && all(rows %in% colnames(flat))) flat <- flat[, rows]
    return(sweep(flat, 2, object$center) %*% object$rotation)
  }
  coords <- new_configurations(newdata, object)
  laid <- laid_onto_mean(coords, object$laid)
  off <- t(matrix(laid, length(object$mean))) - rep(object$center, each = dim(coords)[3])
  scores <- off %*% object$rotation
  dimnames(scores) <- list(dimnames(coords)[[3]], colnames(object$x))
  squared <- drop(off^2 %*% rep(object$weights, ncol(object$mean)))
  outside <- pmax(0, 1 - rowSums(scores^2) / pmax(squared, .Machine$double.xmin))
  structure(scores, outside = stats::setNames(outside, rownames(scores)))
}

#' Configurations of new shapes, their points in the order of the components' and complete
#' @return k x d x m array.
#' @noRd
new_configurations <- function(newdata, pca) {
  if (inherits(newdata, c("shape", "shape_sample"))) check_comparable(newdata, pca)
  coords <- configurations_of(newdata, pca$level)
  fail <- function(problem, remedy, id = NULL) {
    crestline_abort(problem, remedy, stage = "components", id = id)
  }
  points <- rownames(pca$mean)
  absent <- setdiff(points, dimnames(coords)[[1]])
  if (length(absent) || dim(coords)[2] != ncol(pca$mean)) {
    fail(sprintf("`newdata` has not the points of the sample: %s missing.", shorten(absent)),
         sprintf("Give %s with the same names.", amount(length(points), "point")))
  }
  coords <- coords[points, , , drop = FALSE]
  gap <- gaps(coords)
  if (!any(gap)) return(coords)
  crestline_inform(sprintf(
    "points are missing, and estimated from the mean: %s.",
    shorten(sprintf("%d of %s", colSums(gap), colnames(gap))[colSums(gap) > 0])
  ))
  few <- which(colSums(!gap) <= dim(coords)[2] + 1)[1]
  if (!is.na(few)) fail(sprintf("%s only.", amount(sum(!gap[, few]), "point")),
                        "Leave this one out: too few to place the others by.",
                        colnames(gap)[few])
  with_spline_places(coords, pca$mean, gap)
}

#' That measured shapes have the components' level, and were slid against their template
#' @noRd
check_comparable <- function(newdata, pca) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "components")
  }
  if (!pca$level %in% sample_levels) {
    fail(sprintf("the components are of \"%s\", which is no level of a shape.", pca$level),
         "Give an array of the same points.")
  }
  validate(newdata)
  own <- newdata$provenance$template
  known <- pca$provenance$template
  if (!is.null(known) && !identical(own$hash, known$hash)) {
    fail(if (is.null(own)) "`newdata` was not slid." else
      "`newdata` was slid against another template.",
         "Use slide(shape, sample$template), or homologise(shapes, template, rounds = 0).")
  }
}

#' Configurations of a level, of a shape, a sample, an alignment, an array or a matrix
#' @noRd
configurations_of <- function(newdata, level) {
  if (inherits(newdata, c("shape", "shape_sample"))) return(as.array(newdata, level))
  if (inherits(newdata, "aligned")) {
    validate(newdata)
    return(raw_configurations(newdata))
  }
  if (is.matrix(newdata)) {
    newdata <- array(newdata, c(dim(newdata), 1), c(
      if (is.null(dimnames(newdata))) list(NULL, NULL) else dimnames(newdata), list("1")
    ))
  }
  named_array(check_array(newdata, "newdata"))
}

#' Each configuration laid onto a mean, as the alignment laid those of the sample
#'
#' @param onto List: `mean`, `weights`, `scale`, `tangent` of the alignment.
#' @noRd
laid_onto_mean <- function(coords, onto) {
  scaling <- check_scaling(onto$scale)
  mean <- onto$mean
  for (i in seq_len(dim(coords)[3])) {
    fit <- fit_alignment(list(coords = coords[, , i, drop = FALSE], reference = mean),
                         onto$weights, scaling, tolerance = 1e-12, rounds = 10)
    check_extent(fit$size)
    one <- fit$coords[, , 1]
    if (scaling == 2) one <- one * sum(one * mean * onto$weights)
    coords[, , i] <- one
  }
  if (onto$tangent) tangent_projection(coords, mean, onto$weights) else coords
}
