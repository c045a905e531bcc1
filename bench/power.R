# Power of the tests of groups, level by level, on simulated faces whose every point is known.
#
#   Rscript bench/power.R [datasets] [faces] [file]
#
# Each data set is so many faces (half in each group) of simulate_faces() with its defaults but for
# `effect`, and without a difference of size; the same random fields for every effect. Landmarks,
# curves and surface are the true places of the points that fit_shape() finds on the template: what
# is compared is what the levels can see, not how well they are measured. A test rejects where its
# p-value from 499 permutations is at most 0.05; "any point": the least family-wise p-value of all
# points. Writes a row an effect, level and test: `effect` (mm in the middle of the places),
# `level`, `test`, `rejected` (share of data sets), `datasets`, `faces`. The vignette "Sexual
# dimorphism" shows it.

library(crestline)

argument <- commandArgs(TRUE)
datasets <- if (length(argument) > 0) as.integer(argument[1]) else 100L
faces <- if (length(argument) > 1) as.integer(argument[2]) else 40L
file <- if (length(argument) > 2) argument[3] else file.path("vignettes", "power.csv")
effects <- c(0, 0.5, 1, 1.5, 2, 2.5, 3)

template <- simulate_faces(1, scan = NULL, seed = 1)$template
shape <- fit_shape(template, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
triangles <- subset(shape$scheme$triangles, part == "model", c("v1", "v2", "v3"))

rejections <- function(effect, seed) {
  drawn <- simulate_faces(faces, effect, size_effect = 0, scan = NULL, seed = seed)
  places <- function(level) true_points(drawn, coords(shape, level))
  sample <- list(landmarks = align(places("landmarks"), "landmarks"),
                 curves = align(places("curves"), "curves"),
                 surface = align(places("surface"), "surface", triangles = t(as.matrix(triangles))))
  found <- compare_groups(sample, drawn$covariates$group, n_perm = 499, seed = seed,
                          equal_spread = TRUE, progress = FALSE)
  points <- tapply(found$points$p_adjusted, factor(found$points$level, names(sample)), min,
                   na.rm = TRUE)
  tests <- as.data.frame(found)
  tests <- tests[tests$test %in% c("size t", "mean shape", "T2"), c("level", "test", "p_value")]
  rows <- rbind(tests,
                data.frame(level = names(points), test = "any point", p_value = as.vector(points)))
  cbind(effect = effect, rows)
}

rows <- NULL
for (effect in effects) {
  own <- do.call(rbind, lapply(seq_len(datasets), function(seed) rejections(effect, seed)))
  own <- aggregate(cbind(rejected = p_value <= 0.05) ~ effect + level + test, own, mean)
  rows <- rbind(rows, cbind(own, datasets = datasets, faces = faces))
  message("effect ", effect, " mm done")
}
rows <- rows[order(rows$effect, match(rows$test, c("size t", "mean shape", "T2", "any point"))), ]
write.csv(rows, file, row.names = FALSE, quote = FALSE)
rows <- rows[c("effect", "level", "test", "rejected")]
print(reshape(rows, idvar = c("test", "level"), timevar = "effect", direction = "wide"),
      row.names = FALSE)
