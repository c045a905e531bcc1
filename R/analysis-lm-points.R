# Where a term of a linear model acts: a test at every point and of every part, the family held.

#' Tests of all terms at every point, and of every part
#'
#' Points: on a surface the displacement along the mean's normal, elsewhere all co-ordinates of the
#' point together. Parts: the sums of squares of their points together; parts differ in their number
#' of points, so that they are compared by p, not by F.
#'
#' @param aligned An `aligned`.
#' @param spans Of [term_spans()].
#' @param part The part of each point, or NULL.
#' @param block Permutations at a time: a block needs block x k numbers a co-ordinate and term.
#' @return List by term of two data frames, `points` and `parts` (NULL where points have no parts).
#' @noRd
lm_points <- function(aligned, spans, orders, part = NULL, block = 250) {
  along <- !is.null(aligned$triangles)
  blocks <- permutation_blocks(ncol(orders), block)
  each <- lapply(point_chunks(aligned), function(rows) {
    y <- test_variables(aligned, rows, along)
    absent <- is.na(y[[1]][1, ])
    found <- lapply(spans, function(span) list(as_great = 0))
    for (columns in blocks) {
      squares <- column_squares(y, spans, orders[, columns, drop = FALSE])
      found <- Map(add_block, found, squares, spans, list(absent), list(part[rows]))
    }
    found
  })
  lapply(stats::setNames(nm = names(spans)), function(term) {
    own <- joined_chunks(lapply(each, `[[`, term))
    list(points = lm_point_table(aligned, term, spans[[term]], own, along, ncol(orders)),
         parts = if (!is.null(part)) tests_of_parts(term, spans[[term]], own, part))
  })
}

#' What is kept of the permutations so far, and of some more
#'
#' @param kept List: `observed` (F by point), `own` (squares), `as_great` (counts), `family`
#'   (greatest F by permutation), `part_own`, `part_left` (squares by permutation and part).
#' @param squares Of [column_squares()], for one term.
#' @noRd
add_block <- function(kept, squares, span, absent, part) {
  f <- (squares$own / span$df) / (squares$left / span$left)
  f[, absent] <- NA
  if (is.null(kept$observed)) {
    kept$observed <- f[1, ]
    kept$own <- squares$own[1, ]
  }
  kept$as_great <- kept$as_great +
    colSums(f >= rep(kept$observed * (1 - 1e-10), each = nrow(f)))
  kept$family <- c(kept$family, do.call(pmax, c(as.data.frame(f), na.rm = TRUE)))
  if (!is.null(part)) {
    sums <- function(x) t(rowsum(t(x), part, na.rm = TRUE, reorder = FALSE))
    kept$part_own <- rbind(kept$part_own, sums(squares$own))
    kept$part_left <- rbind(kept$part_left, sums(squares$left))
  }
  kept
}

#' What was kept of several chunks of points, as of all points
#' @noRd
joined_chunks <- function(each) {
  if (length(each) == 1) return(each[[1]])
  joined <- function(what) unlist(lapply(each, `[[`, what))
  summed <- function(what) {
    all <- do.call(cbind, lapply(each, `[[`, what))
    if (!is.null(all)) t(rowsum(t(all), colnames(all), reorder = FALSE))
  }
  list(observed = joined("observed"), own = joined("own"), as_great = joined("as_great"),
       family = do.call(pmax, c(lapply(each, `[[`, "family"), na.rm = TRUE)),
       part_own = summed("part_own"), part_left = summed("part_left"))
}

#' @param found Of [add_block()].
#' @noRd
lm_point_table <- function(aligned, term, span, found, along, permutations) {
  size <- if (isFALSE(aligned$scale)) 1 else mean(aligned$size)
  at <- as.data.frame(aligned$mean * size)
  names(at) <- c("x", "y", "z")[seq_along(at)]
  effect <- term_effect(aligned, span) * size
  signed <- along && !is.null(span$column)
  distance <- if (signed) rowSums(effect * point_normals(aligned$mean, aligned$triangles)) else
    NA_real_
  observed <- found$observed
  data.frame(
    term = term, point = rownames(aligned$mean), at, distance = unname(distance),
    displacement = size * sqrt(unname(found$own) / length(aligned)),
    statistic = if (signed) sqrt(observed) * sign(distance) else observed,
    p_value = found$as_great / permutations,
    p_adjusted = vapply(observed, function(value) {
      mean(found$family >= value * (1 - 1e-10))
    }, 0),
    row.names = NULL
  )
}

#' What one unit of a term's only column moves the points by, k x d; NULL where it has more columns
#' @noRd
term_effect <- function(aligned, span) {
  if (is.null(span$column)) return(NULL)
  own <- span$basis[, 1]
  unname(weighted_shape(aligned, own / sum(own * span$column)))
}

#' The curve or patch that each point of an alignment lies on; NULL of other levels, and where no
#' sample says it
#' @noRd
parts_of_points <- function(sample, aligned, level) {
  if (!has_scheme(sample) || !level %in% c("curves", "surface")) return(NULL)
  points <- sample$template$scheme$points
  at <- match(rownames(aligned$mean), rownames(coords(sample$template, level)))
  points$part[points$level == level][at]
}

#' @param found As of [add_block()].
#' @noRd
tests_of_parts <- function(term, span, found, part) {
  f <- found$part_own / span$df / (found$part_left / span$left)
  # The share of permutations with as great an F, of each permutation: the family's least is held.
  p <- apply(f, 2, function(x) rank(-x, ties.method = "max")) / nrow(f)
  least <- do.call(pmin, as.data.frame(p))
  data.frame(term = term, part = colnames(f), points = as.vector(table(part)[colnames(f)]),
             statistic = f[1, ], p_value = permutation_p(f),
             p_adjusted = vapply(permutation_p(f), function(own) mean(least <= own + 1e-10), 0),
             row.names = NULL)
}
