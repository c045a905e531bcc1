# Section 5.2 of the paper: distance of estimated ridges to the true ones, our settings beside the paper's.
# Rscript bench/ridge-study.R [seeds = 20]
library(crestline)

seeds <- as.integer(c(commandArgs(TRUE), 20)[1])

presets <- list(crestline = ridge_settings(), paper = ridge_settings("paper"))

run <- function(label, ...) {
  rows <- lapply(names(presets), function(name) {
    study <- ridge_study(presets[[name]], n = seeds, progress = TRUE, ...)
    cbind(what = label, settings = name, study)
  })
  do.call(rbind, rows)
}

study <- rbind(
  run("clean", noise = 0),
  run("clean, two passes", noise = 0, b = c(1, 2), passes = 2),
  run("noise 0.01", noise = 0.01),
  run("noise 0.05", noise = 0.05),
  run("clean, landmarks off by 0.1", noise = 0, b = c(1, 2), landmark_error = 0.1),
  run("noise 0.05, landmarks off by 0.1", noise = 0.05, b = c(1, 2), landmark_error = 0.1)
)

by_cell <- function(values, digits, label) {
  cat("\n", label, "\n", sep = "")
  table <- tapply(values, list(study$what, study$settings, paste0("b=", study$b, " a=", study$a)), mean, na.rm = TRUE)
  for (name in names(presets)) {
    cat(name, "\n")
    print(round(table[unique(study$what), name, ], digits), na.print = "")
  }
}

by_cell(study$distance, 2, "Mean distance to the true ridge, in spacings")
by_cell(study$se, 2, "Median standard error, in spacings")
by_cell(study$determined, 2, "Share of curves determined by curvature")

sharp <- study[study$b >= 1, ]
cat("\nMean over a and b in (1, 2), in spacings; the determined curves; converged; seconds a curve\n")
summary <- aggregate(cbind(distance, converged, seconds) ~ what + settings, sharp, mean)
certain <- aggregate(distance ~ what + settings, sharp[sharp$determined %in% TRUE, ], mean)
names(certain)[3] <- "distance_determined"
print(merge(summary, certain, all.x = TRUE), digits = 3, row.names = FALSE)
cat("\nFailed:", sum(!is.na(study$error)), "of", nrow(study), "\n")
print(table(study$error))
print(R.version.string)
