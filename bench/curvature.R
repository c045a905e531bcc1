# Error of the curvature estimates on seven closed-form surfaces, orders side by side.
# Rscript bench/curvature.R [radius = 10]   (from the root of the package)
library(crestline)
source("tests/testthat/helper-surfaces.R")

radius <- as.numeric(c(commandArgs(TRUE), 10)[1])
orders <- c("forced", "quadratic", "cubic", "quartic", "adaptive cubic", "adaptive")

# Mean over the surfaces of the median and 95th percentile; k1 in % of the RMS curvedness.
errors <- function(order, noise, border) {
  each <- vapply(closed_forms(), function(form) {
    m <- closed_form_mesh(form, noise = noise)
    at <- which(if (border) m$margin < 0.8 else m$margin > 10)
    found <- curvature_errors(curvature(m$mesh, radius, order = order, vertices = at), m$truth, at)
    unlist(lapply(found, function(e) if (length(e)) quantile(e, c(0.5, 0.95), na.rm = TRUE) else
                         c(NA, NA)))
  }, numeric(6))
  rowMeans(each, na.rm = TRUE)
}

columns <- c("k1 median", "k1 95th", "index median", "index 95th", "direction median",
             "direction 95th")
for (case in list(list("clean, interior", 0, FALSE), list("noise 0.1, interior", 0.1, FALSE),
                  list("clean, border", 0, TRUE), list("noise 0.1, border", 0.1, TRUE))) {
  table <- t(vapply(orders, errors, numeric(6), noise = case[[2]], border = case[[3]]))
  colnames(table) <- columns
  cat("\n", case[[1]], "\n", sep = "")
  print(round(table, 4))
}
