# Where groups differ: a test at every point, with the family of all points controlled.

#' Tests at every point
#'
#' On a surface the displacement along the mean surface's normal, elsewhere all co-ordinates of the
#' point together. Some points are worked out at a time.
#'
#' @param aligned An `aligned`.
#' @param labels n x B matrix of group numbers.
#' @param spread As in [observed_f()].
#' @param blocks List of its columns, as of [permutation_blocks()].
#' @param tick Called once a block.
#' @param known Of [sums_in_files()], NULL of a sample in memory.
#' @return Data frame, a row a point: `point`, `x`, `y`, `z`, `distance`, `displacement`,
#'   `statistic`, `p_value`, `p_adjusted`.
#' @noRd
point_tests <- function(aligned, labels, spread, blocks, tick, known = NULL) {
  along <- !is.null(aligned$triangles)
  chunks <- point_chunks(aligned)
  each <- lapply(chunks, function(rows) {
    if (!is.null(known)) return(tests_of_sums(known, rows, labels, spread))
    chunk_of_tests(test_variables(aligned, rows, along), labels, spread, blocks,
                   if (rows[1] == 1) tick else function() NULL)
  })
  joined <- function(what) unlist(lapply(each, `[[`, what))
  family <- do.call(pmax, c(lapply(each, `[[`, "family"), na.rm = TRUE))
  described <- point_table(aligned, labels[, 1], along, known)
  f <- joined("f")
  described$statistic <- if (along && max(labels) == 2) sqrt(f) * sign(described$distance) else f
  described$p_value <- joined("as_great") / ncol(labels)
  described$p_adjusted <- vapply(
    joined("observed"), function(value) mean(family >= value * (1 - 1e-10)), 0
  )
  described
}

#' The tests of some points
#'
#' @param y List of n x k matrices, over which squares are summed.
#' @return List: `observed` and `as_great` (k: scores, and counts of regroupings with as great
#'   ones), `family` (B: greatest scores), `f` (k).
#' @noRd
chunk_of_tests <- function(y, labels, spread, blocks, tick) {
  squares <- 0
  for (part in y) squares <- squares + part^2
  dimensions <- effective_dimensions(y)
  scores <- function(columns) {
    spread_scores(squared_sums(y), squares, labels[, columns, drop = FALSE], spread$equal,
                  dimensions)$score
  }
  observed <- scores(1)
  as_great <- 0
  family <- numeric()
  for (columns in blocks) {
    score <- scores(columns)
    as_great <- as_great + colSums(score >= rep(observed * (1 - 1e-10), each = nrow(score)))
    family <- c(family, greatest_by_row(score))
    tick()
  }
  list(observed = observed[1, ], as_great = as_great, family = family,
       f = observed_f(squared_sums(y), squares, labels[, 1], spread)$f)
}

#' The tests of some points from sums
#' @param rows Which points.
#' @return As [chunk_of_tests()].
#' @noRd
tests_of_sums <- function(sums, rows, labels, spread) {
  sizes <- tabulate(labels[, 1])
  squared <- function(one) {
    tested <- tested_of_block(one, sums$normals, nrow(sums$own[[1]]))
    Reduce(`+`, lapply(tested, function(part) t(part[rows, , drop = FALSE])^2))
  }
  own <- vector("list", length(sizes))
  own[-which.max(sizes)] <- lapply(sums$own, function(one) t(one[rows, , drop = FALSE]))
  directions <- sqrt(length(sums$products))
  product <- function(a, b) sums$products[[(a - 1) * directions + b]][rows]
  all <- Reduce(`+`, lapply(seq_len(directions), function(a) product(a, a)))
  found <- split_squares(of_groups(sums$sums, squared, sizes), if (!spread$equal) own, all, sizes)
  score <- scores_of_squares(found, all, sizes, spread$equal,
                             dimensions_of_products(product, directions))$score
  observed <- score[1, ]
  as_great <- colSums(score >= rep(observed * (1 - 1e-10), each = nrow(score)))
  list(observed = observed, as_great = as_great, family = greatest_by_row(score),
       f = f_of_squares(found, all, sizes, spread)$f)
}

greatest_by_row <- function(x) do.call(pmax, c(as.data.frame(x), na.rm = TRUE))

#' Where the points are and how far apart the means, in the unit of the meshes
#' @noRd
point_table <- function(aligned, code, along, known) {
  size <- if (isFALSE(aligned$scale)) 1 else mean(aligned$size)
  at <- as.data.frame(aligned$mean * size)
  names(at) <- c("x", "y", "z")[seq_along(at)]
  distance <- displacement <- rep(NA_real_, nrow(at))
  if (max(code) == 2) {
    off <- if (is.null(known)) mean_differences(aligned, code) else
      differences_of_sums(known, tabulate(code), aligned$mean)
    off <- off * size
    displacement <- sqrt(rowSums(off^2))
    if (along) distance <- rowSums(off * point_normals(aligned$mean, aligned$triangles))
  }
  data.frame(point = rownames(aligned$mean), at, distance = unname(distance),
             displacement = unname(displacement),
             row.names = NULL)
}

#' Second group's mean minus the first's, k x d
#' @noRd
mean_differences <- function(aligned, code) {
  mean_shape_of(aligned, code == 2) - mean_shape_of(aligned, code == 1)
}

mean_shape_of <- function(aligned, chosen) {
  weighted_shape(aligned, chosen / sum(chosen))
}

#' What some points are tested by: a list of one n x k matrix, displacements from the mean along its
#' normals, or of a matrix a co-ordinate; centred
#' @param rows As in [columns_of_points()].
#' @noRd
test_variables <- function(aligned, rows, along) {
  each <- columns_of_points(aligned, rows)
  if (!along) return(each)
  normal <- point_normals(aligned$mean, aligned$triangles)[rows, , drop = FALSE]
  off <- 0
  for (d in 1:3) off <- off + each[[d]] * rep(normal[, d], each = length(aligned))
  list(off)
}

#' Normals along which the points are tested, NULL without triangles
#' @noRd
tested_normals <- function(aligned) {
  if (!is.null(aligned$triangles)) point_normals(aligned$mean, aligned$triangles)
}

#' Unit normals of points, by the areas of their triangles, k x 3, NA where there are none
#' @noRd
point_normals <- function(xyz, triangles) {
  a <- xyz[triangles[1, ], , drop = FALSE]
  u <- xyz[triangles[2, ], , drop = FALSE] - a
  v <- xyz[triangles[3, ], , drop = FALSE] - a
  cross <- cbind(u[, 2] * v[, 3] - u[, 3] * v[, 2], u[, 3] * v[, 1] - u[, 1] * v[, 3],
                 u[, 1] * v[, 2] - u[, 2] * v[, 1])
  corner <- factor(triangles, seq_len(nrow(xyz)))
  sums <- vapply(1:3,
                 function(d) as.vector(tapply(
                   rep(cross[, d], each = 3), corner, sum, default = NA
                 )),
                 numeric(nrow(xyz)))
  sums / sqrt(rowSums(sums^2))
}
