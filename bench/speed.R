# Seconds on one thread: curvature, plane cuts, ridge curves.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/speed.R
#
# The median and least of several runs of this process; close other programs first.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
folder <- file.path(shared, "template_male")
face <- suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                       file.path(folder, "landmarks.csv"), id = "template_male"))

row <- function(what, code, times) {
  code <- substitute(code)
  seconds <- replicate(times, system.time(eval(code, parent.frame(2)))[["elapsed"]])
  data.frame(what = what, median = round(stats::median(seconds), 4), least = round(min(seconds), 4),
             runs = times)
}

surface <- crestline:::walkable(face)
ends <- crestline:::located_ends(face, surface, "chL", "chR")
angles <- seq(-pi / 2, pi / 2, length.out = 52)[-1]
cuts <- function() crestline:::measure_cuts(ends, angles, rep(0L, 51), Inf)
curved <- curvature(face, 5, "adaptive cubic")
curve <- function(error) {
  ridge_curve(face, "chL", "st", "valley", curved, 6, 9, ridge_settings(error = error))
}

table <- rbind(
  row("curvature, 10 mm, all vertices, adaptive", curvature(face, 10), 7),
  row("curvature, 10 mm, all vertices, adaptive cubic", curvature(face, 10, "adaptive cubic"), 7),
  row("curvature, 10 mm, all vertices, quadratic", curvature(face, 10, "quadratic"), 7),
  row("51 plane cuts", for (i in 1:10) cuts(), 7),
  row("ridge curve, curvature given, no standard error", for (i in 1:10) curve(FALSE), 7),
  row("ridge curve, curvature given, standard error", for (i in 1:10) curve(TRUE), 7),
  row("ridge curve, curvature of its own region",
      ridge_curve(face, "chL", "st", "valley", 5, 6, 9), 7)
)
tens <- 4:6
table[tens, c("median", "least")] <- table[tens, c("median", "least")] / 10
cat(sprintf("template_male, %d vertices, one thread, seconds\n", ncol(face$mesh$vb)))
print(table, row.names = FALSE)
