# Coverage of the band of two standard errors, at the inner points of simulated ridges, b >= 1.
# Rscript bench/standard-error.R [simulations = 200]
library(crestline)

simulations <- as.integer(c(commandArgs(TRUE), 200)[1])

# Error across: signed distance of the fitted curve from the true ridge, and from the curve fitted
# to the same surface without noise (which leaves the bias out).
one <- function(a, b, noise, seed, radius, correlation, settings) {
  fit <- function(noise, settings) {
    surface <- simulate_ridge(a, b, noise = noise, seed = seed, correlation = correlation)
    curve <- suppressWarnings(ridge_curve(surface, "from", "to", "ridge", radius,
                                          width = 0.4, n = 21, settings = settings))
    list(curve = curve, truth = attr(surface, "truth"))
  }
  noisy <- fit(noise, settings)
  clean <- fit(0, ridge_settings(error = FALSE))
  inner <- 2:20
  points <- noisy$curve$points[inner, ]
  bare <- as.matrix(clean$curve$points[c("x", "y", "z")])
  data.frame(a, b, noise, radius, correlation, seed, point = inner, se = points$se,
             determined = noisy$curve$determined,
             error = crestline:::ridge_offset(points, noisy$truth),
             without_bias = crestline:::ridge_offset(points, bare))
}

study <- function(cells, settings = ridge_settings()) {
  rows <- lapply(seq_len(nrow(cells)), function(i) {
    tryCatch(do.call(one, c(cells[i, ], list(settings = settings))), error = function(e) NULL)
  })
  do.call(rbind, rows)
}

report <- function(label, results) {
  covered <- function(error, rows) mean(abs(error[rows]) <= 2 * results$se[rows])
  sure <- results$determined
  cat(
    sprintf(paste("%-34s %.3f   determined %.3f (%3.0f %%)   error from the noise-free fit %.3f  ",
                  "rms error / rms se %.2f\n"), label,
            covered(results$error, TRUE), covered(results$error, sure), 100 * mean(sure),
            covered(results$without_bias, TRUE), sqrt(mean(results$error^2) / mean(results$se^2))))
}

a <- c(0, 0.25, 0.5)
full <- expand.grid(seed = seq_len(simulations), a = a, b = c(1, 2), noise = c(0.01, 0.05),
                    radius = 0.25, correlation = 0)
results <- study(full)
cat("Coverage of |error across| <= 2 se (nominal 0.95)\n")
report("all", results)
for (noise in c(0.01, 0.05)) for (b in c(1, 2)) {
  report(sprintf("noise %g, b = %g", noise, b), results[results$noise == noise & results$b == b, ])
}
for (bend in a) report(sprintf("a = %g", bend), results[results$a == bend, ])

some <- ceiling(simulations / 4)
wide <- expand.grid(seed = seq_len(some), a = a, b = c(1, 2), noise = 0.01, radius = 0.5,
                    correlation = 0)
report("radius 0.5, noise 0.01", study(wide))
smooth <- expand.grid(seed = seq_len(some), a = a, b = c(1, 2), noise = 0.01, radius = 0.25,
                      correlation = 3)
report("noise correlated over 3 steps", study(smooth))
