# Where a term of a linear model acts: a test at every point and of every part, the family held.

#' Tests of a term at every point, and of every part
#'
#' Points: on a surface the displacement along the mean's normal, elsewhere all co-ordinates of the
#' point together. Parts: the sums of squares of their points together; parts differ in their number
#' of points, so that they are compared by p, not by F.
#'
#' @param aligned An `aligned`.
#' @param span Of [term_spans()].
#' @param part The part of each point, or NULL.
#' @param block Permutations at a time: a block needs block x k numbers a co-ordinate.
#' @return List of two data frames, `points` and `parts` (NULL where points have no parts).
#' @noRd
lm_points <- function(aligned, term, span, orders, part = NULL, block = 250) {
  along <- !is.null(aligned$triangles)
  y <- if (along) normal_displacements(aligned) else coordinate_blocks(aligned)
  as_great <- 0
  family <- numeric()
  of_parts <- NULL
  for (columns in permutation_blocks(ncol(orders), block)) {
    found <- column_squares(y, span, orders[, columns, drop = FALSE])
    f <- (found$own / span$df) / (found$left / span$left)
    f[, is.na(y[[1]][1, ])] <- NA
    if (1 %in% columns) {
      observed <- f[1, ]
      own <- found$own[1, ]
    }
    as_great <- as_great + colSums(f >= rep(observed * (1 - 1e-10), each = nrow(f)))
    family <- c(family, do.call(pmax, c(as.data.frame(f), na.rm = TRUE)))
    if (!is.null(part)) {
      sums <- function(x) t(rowsum(t(x), part, na.rm = TRUE, reorder = FALSE))
      of_parts <- rbind(of_parts, sums(found$own) / span$df / (sums(found$left) / span$left))
    }
  }
  size <- if (isFALSE(aligned$scale)) 1 else mean(aligned$size)
  at <- as.data.frame(aligned$mean * size)
  names(at) <- c("x", "y", "z")[seq_along(at)]
  effect <- term_effect(aligned, span) * size
  signed <- along && !is.null(span$column)
  distance <- if (signed) rowSums(effect * point_normals(aligned$mean, aligned$triangles)) else
    NA_real_
  points <- data.frame(
    term = term, point = rownames(aligned$mean), at, distance = unname(distance),
    displacement = size * sqrt(unname(own) / length(aligned)),
    statistic = if (signed) sqrt(observed) * sign(distance) else observed,
    p_value = as_great / ncol(orders),
    p_adjusted = vapply(observed, function(value) mean(family >= value * (1 - 1e-10)), 0),
    row.names = NULL
  )
  list(points = points, parts = if (!is.null(part)) tests_of_parts(term, span, of_parts, part))
}

#' What one unit of a term's only column moves the points by, k x d; NULL where it has more columns
#' @noRd
term_effect <- function(aligned, span) {
  if (is.null(span$column)) return(NULL)
  own <- span$basis[, 1]
  flat <- matrix(aligned$coords, length(aligned$mean))
  matrix(flat %*% own / sum(own * span$column), nrow(aligned$mean))
}

#' The curve or patch that each point of an alignment lies on; NULL of other levels, and where no
#' sample says it
#' @noRd
parts_of_points <- function(sample, aligned, level) {
  if (!inherits(sample, "shape_sample") || !level %in% c("curves", "surface")) return(NULL)
  points <- sample$template$scheme$points
  at <- match(rownames(aligned$mean), rownames(coords(sample$template, level)))
  points$part[points$level == level][at]
}

#' @param f B x parts.
#' @noRd
tests_of_parts <- function(term, span, f, part) {
  # The share of permutations with as great an F, of each permutation: the family's least is held.
  p <- apply(f, 2, function(x) rank(-x, ties.method = "max")) / nrow(f)
  least <- do.call(pmin, as.data.frame(p))
  data.frame(term = term, part = colnames(f), points = as.vector(table(part)[colnames(f)]),
             statistic = f[1, ], p_value = permutation_p(f),
             p_adjusted = vapply(permutation_p(f), function(own) mean(least <= own + 1e-10), 0),
             row.names = NULL)
}
