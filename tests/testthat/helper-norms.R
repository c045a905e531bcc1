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
