# The parts of a norm that are fitted to faces, and what they say of other faces.

#' Fit all parts of a norm to some faces
#'
#' @param data Of [norm_data()], with `people`; `transform` of the values ("log" or "as is").
#' @param rows Rows of the faces.
#' @param plan List: `size`, `size_values`, `components`, and what [fit_field()] takes.
#' @return List: `surface`, `asymmetry` (fields, the second perhaps NULL), `values` (norm of log
#'   size, measurements and scores).
#' @noRd
fit_parts <- function(data, rows, plan) {
  people <- list(age = data$people$age[rows], group = data$people$group[rows])
  points <- as.matrix(data$points[c("x", "y", "z")])
  normal <- as.matrix(data$points[c("nx", "ny", "nz")])
  side <- data$points$side
  surface <- fit_field(data$y[rows, , drop = FALSE], points, normal, people, plan,
                       if (!is.null(data$off)) data$points$partner)
  asymmetry <- if (!is.null(data$off)) {
    fit_field(data$off[rows, , drop = FALSE], points[side, ], normal[side, ], people, plan)
  }
  scores <- field_scores(surface, data$y[rows, , drop = FALSE], people$age, people$group)
  values <- cbind(data$values[rows, , drop = FALSE], scores)
  list(surface = surface, asymmetry = asymmetry,
       values = smooth_columns(values, people$age, people$group, plan$size_values,
                               rep(1e-6, ncol(values))))
}

#' Scores of the components, n x K
#' @noRd
field_scores <- function(field, y, age, group) {
  if (!ncol(field$vectors)) return(matrix(0, nrow(y), 0))
  expected <- expected_columns(field$columns, age, group)
  scores <- ((y - expected$mean) / expected$sd) %*% field$vectors
  colnames(scores) <- paste("component", seq_len(ncol(scores)))
  scores
}

#' What a norm of other faces says of some: no list of it is kept
#'
#' @param scales List `surface`, `asymmetry` of [scan_scale()].
#' @return List: `z` (n x m: of log size, measurements, scores), `map` (n: largest |z| along the
#'   normals), `surface`, `asymmetry`: lists of `t` (list by bump of n x k), `rough` (n: median
#'   squared residual from what the neighbours make expected); of `surface` also `u` (n x 3k).
#' @noRd
hold_out <- function(parts, data, rows, radii, scales) {
  age <- data$people$age[rows]
  group <- data$people$group[rows]
  y <- data$y[rows, , drop = FALSE]
  values <- cbind(data$values[rows, , drop = FALSE], field_scores(parts$surface, y, age, group))
  z <- predicted_z(values, expected_columns(parts$values, age, group))
  along <- normal_part(y, parts$surface$points, parts$surface$normal)
  map <- predicted_z(along, expected_columns(parts$surface$along, age, group))
  list(z = z, map = apply(abs(map), 1, max),
       surface = hold_out_field(parts$surface, y, age, group, radii, scales$surface, keep = TRUE),
       asymmetry = if (!is.null(parts$asymmetry)) {
         hold_out_field(parts$asymmetry, data$off[rows, , drop = FALSE], age, group, radii,
                        scales$asymmetry)
       })
}

hold_out_field <- function(field, y, age, group, radii, scale, keep = FALSE) {
  inverse <- invert_field(field)
  u <- t(field_deviations(field, y, age, group))
  list(t = scan_statistics(field, u, radii, scale, inverse), rough = roughness(inverse, u)$median,
       u = if (keep) t(u))
}

#' How far points are from what all others make expected, over what the norm expects
#'
#' @param u 3k x n.
#' @return List: `median` (n, of the squares), `variance` (3k: of a point given all others).
#' @noRd
roughness <- function(inverse, u) {
  solved <- apply_inverse(inverse, u)
  k <- nrow(inverse$basis) / 3
  own <- inverse_diagonal(inverse)
  list(median = apply(solved^2 / own, 2, stats::median), variance = 1 / own)
}
