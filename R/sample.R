# A sample: shapes of many specimens made homologous.

new_sample <- function(shapes, template, convergence) {
  shapes <- lapply(shapes, function(shape) {
    shape$specimen <- NULL
    shape
  })
  structure(list(shapes = shapes, template = template, convergence = convergence, missing = missing_parts(shapes)),
            class = "shape_sample")
}

missing_parts <- function(shapes) {
  each <- lapply(shapes, function(shape) {
    absent <- shape$points[is.na(shape$points$x), ]
    parts <- unique(absent[c("level", "part")])
    count <- mapply(function(level, part) sum(absent$level == level & absent$part == part), parts$level, parts$part)
    data.frame(id = rep(shape$id, nrow(parts)), parts, points = as.integer(count))
  })
  each <- do.call(rbind, each)
  rownames(each) <- NULL
  each
}

#' Co-ordinates of a sample
#'
#' @param x A `shape_sample`, as [homologise()] returns it.
#' @param level "landmarks", "curves" or "surface".
#' @param ... Ignored.
#' @return k x 3 x n array with the names of points ("part point"; of landmarks: their names), x, y, z and specimens; NA
#'   where missing; in the unit of the meshes, where each specimen lies.
#' @section Errors: of class `crestline_error`, for another level.
#' @seealso [homologise()]
#' @examples
#' \donttest{
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "triangle")
#' shapes <- lapply(c(1, 1.1, 1.2), function(width) {
#'   ball <- Rvcg::vcgSphere(4)
#'   ball$vb[1, ] <- width * ball$vb[1, ]
#'   wide <- specimen(ball, corners %*% diag(c(width, 1, 1)), id = paste("ball", width))
#'   fit_shape(wide, scheme, progress = FALSE)
#' })
#' sample <- homologise(shapes, progress = FALSE)
#' dim(as.array(sample, "curves"))
#' }
#' @exportS3Method
as.array.shape_sample <- function(x, level = c("landmarks", "curves", "surface"), ...) {
  check_method_dots(..., known = "level")
  level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
  each <- lapply(x$shapes, coords, level)
  array(unlist(each), c(dim(each[[1]]), length(each)), c(dimnames(each[[1]]), list(names(each))))
}

#' @rdname as.array.shape_sample
#' @param row.names,optional Ignored.
#' @return `as.data.frame()`: a row a specimen and point: `id`, and the columns of a shape's `points`.
#' @export
as.data.frame.shape_sample <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  each <- lapply(x$shapes, function(shape) cbind(id = shape$id, shape$points))
  each <- do.call(rbind, unname(each))
  rownames(each) <- NULL
  each
}

#' @export
print.shape_sample <- function(x, ...) {
  check_method_dots(...)
  points <- x$template$points
  count <- vapply(c("landmarks", "curves", "surface"), function(level) sum(points$level == level), 0L)
  cat("<shape_sample> ", amount(length(x$shapes), "specimen"), ", by the scheme ", x$template$scheme$name, "\n", sep = "")
  cat("  ", count[["landmarks"]], " landmarks, ", count[["curves"]], " curve points, ", count[["surface"]],
      " surface points\n", sep = "")
  if (!is.null(x$convergence)) {
    last <- x$convergence[nrow(x$convergence), ]
    cat(sprintf("  template: mean after %s, moved by %.2g in the last (%.2g at most)\n", amount(last$round, "round"),
                last$movement, last$largest))
  }
  if (nrow(x$missing)) {
    cat(strwrap(paste0("missing: ", amount(sum(x$missing$points), "point"), " of ", shorten(unique(x$missing$id), 8)),
                indent = 2, exdent = 4), sep = "\n")
  }
  invisible(x)
}
