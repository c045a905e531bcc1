# Tolerances with names, and expectations that say what they mean.

tolerances <- list(
  rounding = 1e-12,   # double precision, numbers of order 1
  single = 1e-6,      # what passed through single precision, relative
  invariance = 1e-6   # share of the object's size, the issue's row "invariance"
)

# Points with faces and weights are exactly where their weights say, inside their faces.
expect_on_mesh <- function(points, mesh, tolerance = tolerances$rounding) {
  points <- as.data.frame(points)
  weight <- as.matrix(points[c("w1", "w2", "w3")])
  corner <- function(i) t(mesh$vb[1:3, mesh$it[i, points$face], drop = FALSE])
  placed <- weight[, 1] * corner(1) + weight[, 2] * corner(2) + weight[, 3] * corner(3)
  size <- max(abs(mesh$vb[1:3, ]))
  testthat::expect_lte(max(abs(as.matrix(points[c("x", "y", "z")]) - placed)), tolerance * size)
  testthat::expect_lte(max(abs(rowSums(weight) - 1)), tolerance)
  testthat::expect_true(all(weight >= -tolerance))
  invisible(points)
}

# An error of ours that carries its parts and whose text has all the given words.
expect_crestline_error <- function(object, words = character(), id = NULL) {
  # Most of the time of an error is its backtrace, which nobody reads here.
  rlang::local_options("rlang:::disable_trace_capture" = TRUE)
  error <- testthat::expect_error(object, class = "crestline_error")
  text <- conditionMessage(error)
  for (word in words) testthat::expect_match(text, word, fixed = TRUE)
  testthat::expect_true(nzchar(error$remedy) && nzchar(error$stage))
  if (!is.null(id)) testthat::expect_equal(error$id, id)
  invisible(error)
}

# The count of one check in a specimen's report.
report_count <- function(specimen, check) specimen$report$count[specimen$report$check == check]

# A flat n x n grid of unit squares, each cut in two, in the order of expand.grid, normals to +z;
# `z` a function of x and y.
grid_mesh <- function(n = 5, z = function(x, y) 0 * x) {
  at <- expand.grid(x = seq_len(n) - 1, y = seq_len(n) - 1)
  low <- as.vector(outer(seq_len(n - 1), (seq_len(n - 1) - 1) * n, "+"))
  it <- cbind(rbind(low, low + 1, low + n), rbind(low + 1, low + n + 1, low + n))
  structure(list(vb = rbind(at$x, at$y, z(at$x, at$y), 1), it = matrix(as.integer(it), 3)),
            class = "mesh3d")
}

# The ball of Rvcg: closed, radius 1, outward.
ball_mesh <- function(subdivision = 2) {
  ball <- Rvcg::vcgSphere(subdivision)
  structure(list(vb = ball$vb, it = ball$it), class = "mesh3d")
}
