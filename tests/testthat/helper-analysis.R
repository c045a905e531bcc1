# Samples with a known mean, and comparisons of configurations up to pose.

# n noisy, turned, moved and scaled copies of k random points, an array k x d x n.
posed_sample <- function(k = 12, n = 15, sd = 0.05, seed = 1, dim = 3) {
  with_seed(seed, {
    base <- matrix(stats::rnorm(k * dim), k)
    each <- lapply(seq_len(n), function(i) {
      turn <- qr.Q(qr(matrix(stats::rnorm(dim^2), dim)))
      turn[, 1] <- turn[, 1] * sign(det(turn))
      shape <- base + stats::rnorm(k * dim, sd = sd)
      sweep(stats::runif(1, 0.5, 2) * shape %*% turn, 2, stats::rnorm(dim, sd = 10), `+`)
    })
    array(unlist(each), c(k, dim, n))
  })
}

# Points x co-ordinates of two groups whose means differ by `effect` at the points `where`, along z.
grouped_sample <- function(n = c(10, 10), effect = 0, where = 1:3, k = 12, sd = 0.05, seed = 1) {
  group <- factor(rep(c("a", "b"), n))
  x <- posed_sample(k, sum(n), 0, seed)
  with_seed(seed + 1000, {
    base <- matrix(stats::rnorm(3 * k), k)
    x[] <- as.vector(base) + stats::rnorm(length(x), sd = sd)
  })
  x[where, 3, group == "b"] <- x[where, 3, group == "b"] + effect
  list(x = x, group = group)
}

# Greatest distance of co-ordinates after the best move and turn.
apart <- function(a, b) max(abs(laid_onto(unname(a), unname(b), FALSE) - unname(b)))

# A tetrahedral mesh's triangles of the first four points.
four_triangles <- function() cbind(c(1, 2, 3), c(1, 4, 2), c(2, 4, 3), c(1, 3, 4))

# `code` with no more numbers in a chunk of points than `most`.
with_chunks <- function(most, code) {
  space <- asNamespace("crestline")
  own <- small <- get("point_chunks", space)
  formals(small)$most <- most
  put <- function(value) {
    unlockBinding("point_chunks", space)
    assign("point_chunks", value, space)
    lockBinding("point_chunks", space)
  }
  on.exit(put(own))
  put(small)
  force(code)
}

# Some fields of two objects are the same numbers, to 1e-9 of the greatest of each.
expect_alike <- function(object, expected, fields, tolerance = 1e-9) {
  for (field in fields) {
    testthat::expect_equal(object[[field]], expected[[field]], tolerance = tolerance,
                           label = field)
  }
}
