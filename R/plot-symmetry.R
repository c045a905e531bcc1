# Where the shapes of a sample are asymmetric, and where they vary.

#' Plot the symmetric and the asymmetric part of a sample
#'
#' @param x A `symmetry_parts`, as [symmetry_parts()] returns it.
#' @param what Kind of map on the symmetric mean. "directional": the mean asymmetry. On a surface it
#'   is the distance of the mean shape from the symmetric mean along the normal, outward positive;
#'   without triangles the distance. "symmetric", "asymmetric": root mean square displacement of the
#'   specimens' parts from their own mean. The asymmetric map shows fluctuating asymmetry.
#' @param level Level. NULL: the first with triangles, if there is one, else the first.
#' @param engine,view,legend,main As in [plot.group_comparison()].
#' @param ... `limits` and `palette`: range of the colours (two numbers, in the unit of the meshes),
#'   and colours; `length_unit`: name of the unit of lengths, for the legend; arguments of
#'   [draw_surface()].
#' @return The scene of [draw_surface()], or without triangles and with another engine than "widget"
#'   a data frame of the drawn points; invisibly, if it is not a widget.
#' @section Errors: of class `crestline_error`: there is no such level.
#' @template glossary
#' @seealso [symmetry_parts()], [plot.group_comparison()]
#' @examples
#' ball <- Rvcg::vcgSphere(3)
#' xyz <- t(ball$vb[1:3, ])
#' mirrored <- Rvcg::vcgKDtree(xyz, xyz %*% diag(c(-1, 1, 1)), 1)$index[, 1]
#' right <- which(mirrored > seq_along(mirrored))
#' bump <- exp(-20 * rowSums(sweep(xyz, 2, c(0.6, 0, 0.8))^2))
#' balls <- lapply(1:8, function(i) xyz * (1 + 0.1 * rnorm(1) * xyz[, 2]^2 + 0.05 * bump))
#' names(balls) <- paste0("s", 1:8)
#' aligned <- align(simplify2array(balls), "ball", triangles = ball$it)
#' parts <- symmetry_parts(aligned, pairs = cbind(right, mirrored[right]), n_perm = 99)
#' plot(parts, engine = "picture")
#' @export
plot.symmetry_parts <- function(x, what = c("directional", "symmetric", "asymmetric"), level = NULL,
                                engine = drawing_engine(), view = "front",
                                legend = TRUE, main = NULL, ...) {
  validate(x)
  what <- check_choice(what, c("directional", "symmetric", "asymmetric"), "what")
  engine <- check_engine(engine)
  check_flags(legend)
  given <- map_arguments(...)
  level <- level_of_map(x$symmetric, level, TRUE)
  one <- x[[if (what == "asymmetric") "asymmetric" else "symmetric"]][[level]]
  size <- if (isFALSE(one$scale)) 1 else mean(one$size)
  mean <- x$symmetric[[level]]$mean
  signed <- what == "directional" && !is.null(one$triangles)
  value <- if (signed) {
    rowSums(x$directional[[level]] * point_normals(mean, one$triangles))
  } else if (what == "directional") {
    sqrt(rowSums(x$directional[[level]]^2))
  } else {
    off <- one$coords - as.vector(rowMeans(one$coords, dims = 2))
    size * sqrt(rowSums(rowMeans(off^2, dims = 2)))
  }
  at <- as.data.frame(size * mean)
  names(at) <- c("x", "y", "z")[seq_along(at)]
  points <- data.frame(level = level, point = rownames(mean), at, value = value, p_adjusted = NA,
                       row.names = NULL)
  words <- sprintf(switch(what, directional = "directional asymmetry (%s)",
                          symmetric = "symmetric variation (%s), root mean square",
                          asymmetric = "fluctuating asymmetry (%s), root mean square"), level)
  shown(draw_map(points, value, signed, one$triangles, if (is.null(main)) words else main, given,
                 engine, view, legend))
}
