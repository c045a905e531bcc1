# A small norm: 120 simulated balls with 35 surface points.

small_template <- function() symmetrise(argument_objects()$shapes[[1]])

small_settings <- function() {
  norm_settings(components = 3, radii = c(12, 18), ranges = c(10, 30),
                bins = c(0, 0.01, 10, 20, 30, 45, 70), folds = 2)
}

small_cohort <- function(n = 120, ..., seed = 1) {
  simulate_cohort(n, ages = c(5, 15), template = small_template(), seed = seed, ...)
}

small_norms <- local({
  made <- NULL
  function() {
    if (is.null(made)) {
      cohort <- small_cohort()
      made <<- fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data,
                         table = ball_measurements(), about = list(name = "balls"),
                         settings = small_settings(), progress = FALSE)
    }
    made
  }
})

# One new ball of 10 years.
small_patient <- function(..., seed = 5, settings = cohort_settings()) {
  simulate_cohort(1, data = data.frame(age = 10, sex = "female"), template = small_template(),
                  seed = seed, settings = settings, ...)$sample[[1]]
}

# The kernels of the three co-ordinates as one matrix.
block_kernel <- function(field) {
  k <- nrow(field$points)
  whole <- matrix(0, 3 * k, 3 * k)
  for (axis in 1:3) {
    rows <- (axis - 1) * k + seq_len(k)
    whole[rows, rows] <- axis_kernels(field)[[axis]] + diag(1e-6, k)
  }
  whole
}

# A field of a norm on points in a box, and its whole correlation, written out.
flat_field <- function(mirrored = c(0, 0), k = 30, seed = 1) {
  with_seed(seed, {
    points <- cbind(stats::runif(k, 0, 40), stats::runif(k, 0, 40), stats::runif(k, 0, 10))
    list(points = points, normal = matrix(rep(c(0, 0, 1), each = k), k),
         sd = stats::runif(3 * k, 0.5, 2),
         vectors = qr.Q(qr(matrix(stats::rnorm(6 * k), ncol = 2))),
         values = c(20, 5), kernel = c(0.1, 0.3, 0.4), mirrored = mirrored, ranges = c(3, 12))
  })
}

dense_correlation <- function(field, extra = 0, free = 1e6) {
  distance <- as.matrix(stats::dist(field$points))
  k <- nrow(distance)
  whole <- field$vectors %*% (field$values * t(field$vectors)) +
    free * tcrossprod(pose_directions(field)) + diag(rep_len(extra, 3 * k) + 1e-6)
  for (axis in 1:3) {
    own <- field$kernel[2] * exp(-distance^2 / 18) + field$kernel[3] * exp(-distance^2 / 288) +
      diag(field$kernel[1], k)
    for (i in seq_len(k)) for (j in seq_len(k)) {
      squares <- sum((field$points[i, ] - c(-1, 1, 1) * field$points[j, ])^2)
      own[i, j] <- own[i, j] + (if (axis == 1) -1 else 1) *
        sum(field$mirrored * exp(-squares / (2 * c(3, 12)^2)))
    }
    rows <- (axis - 1) * k + seq_len(k)
    whole[rows, rows] <- whole[rows, rows] + 0.8 * cov2cor(own)
  }
  whole
}
