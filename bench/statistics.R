# Statistics: speed beside the peers, agreement with them, calibration, what each level sees of the
# dense mesh.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/statistics.R [speed] [agreement] [calibration]
#   [simpop]
#
# speed and agreement take geomorph, RRPP and Morpho where they are installed. simpop: the 23 faces,
# their dense meshes in correspondence; the sample of their shapes is made first, half a minute.

library(crestline)

inner <- function(name) getFromNamespace(name, "crestline")
shared <- Sys.getenv("CRESTLINE_SHARED")
wanted <- commandArgs(TRUE)
if (!length(wanted)) wanted <- c("speed", "agreement", "calibration", "simpop")
have <- function(package) requireNamespace(package, quietly = TRUE)
quiet <- function(code) {
  invisible(utils::capture.output(value <- suppressWarnings(suppressMessages(code))))
  value
}

# ---- speed ----

# n shapes of k points: a random base, smooth differences, noise, pose and size; two groups.
many_shapes <- function(k = 922, n = 250, seed = 1) {
  set.seed(seed)
  base <- matrix(rnorm(3 * k), k)
  modes <- replicate(8, base %*% matrix(rnorm(9, sd = 0.03), 3), simplify = FALSE)
  array(unlist(lapply(seq_len(n), function(i) {
    shape <- base + Reduce(`+`, Map(`*`, modes, rnorm(8))) + rnorm(3 * k, sd = 0.02)
    sweep(runif(1, 0.8, 1.2) * shape %*% qr.Q(qr(matrix(rnorm(9), 3))) * 100, 2,
          rnorm(3, sd = 50), `+`)
  })), c(k, 3, n))
}

# User seconds of this process: the least and the median of some runs.
seconds <- function(what, code, times = 5) {
  code <- substitute(code)
  frame <- parent.frame()
  each <- replicate(times, {
    gc()
    time <- system.time(quiet(eval(code, frame)))
    time[["user.self"]] + time[["sys.self"]]
  })
  data.frame(what = what, median = median(each), least = min(each), runs = times)
}

speed <- function() {
  x <- many_shapes()
  group <- factor(rep(c("F", "M"), 125))
  aligned <- align(x)
  flat <- t(matrix(aligned$coords, 3 * 922))
  rows <- list(seconds("align()", align(x)), seconds("shape_pca()", shape_pca(aligned)),
               seconds("compare_groups(), mean shape",
                       compare_groups(aligned, group, seed = 1, equal_spread = TRUE,
                                      settings = comparison_settings(tests = "shape"))),
               seconds("compare_groups(), size, T2, ten components",
                       compare_groups(aligned, group, seed = 1, equal_spread = TRUE,
                                      settings = comparison_settings(
                                        tests = c("size", "T2", "components")))),
               seconds("compare_groups(), 922 points, all co-ordinates",
                       compare_groups(aligned, group, seed = 1, equal_spread = TRUE,
                                      settings = comparison_settings(tests = "points")), 3))
  if (have("Morpho")) {
    rows <- c(rows, list(seconds("Morpho::procSym()", Morpho::procSym(x), 3),
                         seconds("Morpho::ProcGPA()", Morpho::ProcGPA(x, CSinit = TRUE), 3),
                         seconds("Morpho::permudist()",
                                 Morpho::permudist(flat, group, rounds = 1000), 1)))
  }
  if (have("geomorph") && have("RRPP")) {
    frame <- list(coords = aligned$coords, y = flat, group = group)
    rows <- c(rows,
              list(seconds("geomorph::gpagen()", geomorph::gpagen(x, print.progress = FALSE), 3),
                   seconds("RRPP::lm.rrpp(turbo = TRUE)",
                           RRPP::lm.rrpp(y ~ group, data = frame, iter = 999, turbo = TRUE), 3),
                   seconds("RRPP::lm.rrpp()",
                           RRPP::lm.rrpp(y ~ group, data = frame, iter = 999), 1),
                   seconds("geomorph::procD.lm()",
                           geomorph::procD.lm(coords ~ group, data = frame, iter = 999), 3)))
  }
  cat("250 shapes of 922 points, two groups, 1,000 permutations, user and system seconds\n")
  print(format(do.call(rbind, rows), digits = 3), row.names = FALSE)
}

# ---- agreement ----

# Greatest distance of co-ordinates once laid onto each other.
apart <- function(a, b) {
  flat <- function(x) cbind(unname(x), if (ncol(x) == 2) 0)
  max(abs(inner("laid_onto")(flat(a), flat(b), FALSE) - flat(b)))
}

agree_on <- function(name, x) {
  ours <- align(x)
  row <- function(what, value) data.frame(data = name, what = what, difference = value)
  rows <- list()
  if (have("Morpho")) {
    theirs <- quiet(Morpho::procSym(x, scale = FALSE, proctol = 1e-25))
    full <- quiet(Morpho::procSym(x, proctol = 1e-25, tol = 1e-25))
    some <- seq_len(min(10, length(theirs$eigenvalues)))
    rows <- c(rows, list(row("mean, Morpho (scale = FALSE)", apart(ours$mean, theirs$mshape)),
                         row("size, Morpho, relative", max(abs(ours$size / theirs$size - 1))),
                         row("variances of components, Morpho, relative",
                             max(abs(shape_pca(ours)$sdev[some]^2 / theirs$eigenvalues[some] - 1))),
                         row("mean, Morpho (default), ours \"full\"",
                             apart(align(x, scale = "full")$mean, full$mshape))))
  }
  if (have("geomorph")) {
    # PrinAxes = TRUE may mirror the result.
    theirs <- quiet(geomorph::gpagen(x, print.progress = FALSE, tol = 0, PrinAxes = FALSE))
    rows <- c(rows, list(row("mean, geomorph (its 5 rounds)", apart(ours$mean, theirs$consensus)),
                         row("size, geomorph, relative", max(abs(ours$size / theirs$Csize - 1)))))
  }
  do.call(rbind, rows)
}

# p-values on RRPP's own permutations.
agree_on_p <- function(name, x, group, iter = 999) {
  ours <- align(x)
  flat <- t(matrix(ours$coords, length(ours$mean)))
  compared <- compare_groups(ours, group, equal_spread = TRUE,
                             settings = comparison_settings(
                               permutations = RRPP:::perm.index(length(group), iter, seed = 1),
                               tests = c("size", "shape")))
  frame <- list(y = flat, size = unname(ours$size), group = factor(group))
  shape <- anova(RRPP::lm.rrpp(y ~ group, data = frame, iter = iter, seed = 1))$table[1, "Pr(>F)"]
  size <- anova(RRPP::lm.rrpp(size ~ group, data = frame, iter = iter, seed = 1))$table[1, "Pr(>F)"]
  data.frame(data = name, test = compared$tests$test, ours = compared$tests$p_value,
             RRPP = c(size, shape))
}

agreement <- function() {
  data <- list(simulated = list(x = many_shapes(60, 40), group = rep(1:2, 20)))
  data("boneData", package = "Morpho", envir = environment())
  data$boneData <- list(x = boneLM, group = substr(dimnames(boneLM)[[3]], 12, 13))
  if (have("geomorph")) {
    for (name in c("scallops", "pupfish")) {
      data(list = name, package = "geomorph", envir = environment())
    }
    data$scallops <- list(x = scallops$coorddata, group = scallops$ind)
    data$pupfish <- list(x = sweep(pupfish$coords, 3, pupfish$CS, `*`), group = pupfish$Sex)
  }
  print(format(do.call(rbind, Map(function(name, one) agree_on(name, one$x), names(data), data)),
               digits = 2),
        row.names = FALSE)
  if (!have("RRPP")) return(invisible())
  two <- Filter(function(one) length(unique(one$group)) > 1 && min(table(one$group)) > 1, data)
  print(do.call(rbind,
                Map(function(name, one) agree_on_p(name, one$x, one$group), names(two), two)),
        row.names = FALSE)
}

# ---- calibration ----

# Shapes without a difference: a base, correlated and independent differences, sizes.
null_shapes <- function(n, k = 20) {
  base <- matrix(rnorm(3 * k), k)
  modes <- replicate(5, matrix(rnorm(3 * k, sd = 0.05), k), simplify = FALSE)
  array(unlist(lapply(seq_len(n), function(i) {
    exp(rnorm(1, sd = 0.05)) *
      (base + Reduce(`+`, Map(`*`, modes, rt(5, 5))) + rnorm(3 * k, sd = 0.03))
  })), c(k, 3, n))
}

null_p <- function(seed, sizes, n_perm = 1000, exact = n_perm) {
  set.seed(seed)
  x <- null_shapes(sum(sizes))
  group <- rep(c("a", "b", "c")[seq_along(sizes)], sizes)
  it <- rbind(1:18, 2:19, 3:20)
  surface <- align(x, triangles = it)
  compared <- compare_groups(surface, group, n_perm = n_perm, seed = seed, equal_spread = TRUE,
                             settings = comparison_settings(components = 5, exact = exact))
  vectors <- compare_groups(x, group, n_perm = n_perm, seed = seed, equal_spread = TRUE,
                            settings = comparison_settings(tests = "points", exact = exact))
  tests <- compared$tests
  component <- grepl("^PC", tests$test)
  c(size = tests$p_value[1], "size, parametric" = tests$p_parametric[1],
    "mean shape" = tests$p_value[2], T2 = tests$p_value[3],
    "T2, parametric" = tests$p_parametric[3], PC1 = tests$p_value[4],
    "any component" = min(tests$p_adjusted[component]),
    "any point, along normals" = min(compared$points$p_adjusted, na.rm = TRUE),
    "any point" = min(vectors$points$p_adjusted))
}

calibration <- function(n = 500) {
  designs <- list("12 v 12" = list(c(12, 12), n_perm = 199),
                  "18 v 5" = list(c(18, 5), n_perm = 199),
                  "8, 8, 8" = list(c(8, 8, 8), n_perm = 199),
                  "4 v 5, all 126" = list(c(4, 5), exact = 126))
  p <- lapply(designs, function(design)
    sapply(seq_len(n), function(seed) do.call(null_p, c(list(seed), design))))
  # Attainable level of an exact test of 126 regroupings: 6 / 126.
  rate <- sapply(p, function(one) rowSums(one <= 0.05))
  limits <- qbinom(c(0.005, 0.995), n, 0.05)
  cat(sprintf(paste("rejections at 5 %% of %d samples without a difference; binomial 99 %% limits",
                    "%d to %d\n"), n, limits[1],
              limits[2]))
  print(rate)
}

# ---- simpop ----

simpop_mesh <- function(id) {
  Rvcg::vcgImport(file.path(shared, "simpop", paste0(id, ".ply")), silent = TRUE, clean = FALSE)
}

simpop_sample <- function() {
  table <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
  faces <- lapply(split(table, table$id), function(rows) {
    marks <- `rownames<-`(as.matrix(rows[c("x", "y", "z")]), rows$landmark)
    suppressWarnings(specimen(simpop_mesh(rows$id[1]), marks, id = rows$id[1]))
  })
  shapes <- lapply(faces, function(face)
    suppressWarnings(fit_shape(face, face_scheme(), progress = FALSE,
                               measuring = shape_settings(cut_scale = 0.82))))
  homologise(shapes, progress = FALSE)
}

distances <- function(aligned) {
  flat <- matrix(aligned$coords * rep(sqrt(aligned$weights), length.out = length(aligned$mean)),
                 length(aligned$mean))
  as.vector(dist(t(flat)))
}

simpop <- function() {
  sample <- simpop_sample()
  ids <- names(sample$shapes)
  it <- simpop_mesh(ids[1])$it
  dense <- simplify2array(lapply(ids, function(id) t(simpop_mesh(id)$vb[1:3, ])))
  dimnames(dense) <- list(NULL, c("x", "y", "z"), ids)
  meta <- read.csv(file.path(shared, "simpop", "metadata.csv"))
  sex <- setNames(meta$sex, meta$id)
  levels <- c(lapply(setNames(nm = c("landmarks", "curves", "surface", "model")),
                     function(level) align(sample, level)),
              list("surface, by area" = align(sample, "surface", weights = "area"),
                   dense = align(dense, "dense", triangles = it),
                   "dense, by area" = align(dense, "dense", weights = "area", triangles = it)))
  own <- sapply(levels, distances)
  cat("correlation of Procrustes distances between 23 faces with the dense mesh's\n")
  print(round(cor(own)[, c("dense", "dense, by area")], 3))
  compared <- compare_groups(levels, sex, n_perm = 1999, seed = 1, equal_spread = TRUE)
  cat("p-values, sex (", paste(table(sex), collapse = " v "), ")\n", sep = "")
  print(summary(compared), row.names = FALSE, digits = 2)
  print(compared, most = 0)
  # Where: the surface's points beside the same places of the dense mesh, by the first face's
  # triangles and weights.
  surface <- compared$points[compared$points$level == "surface", ]
  all <- compared$points[compared$points$level == "dense", ]
  places <- sample$shapes[[1]]$points[sample$shapes[[1]]$points$level == "surface", ]
  there <- rowSums(sapply(1:3,
                          function(i) places[[paste0("w", i)]] * all$distance[it[i, places$face]]))
  both <- !is.na(surface$distance)
  cat(sprintf(paste("signed distance between means at %d places, surface v dense: correlation",
                    "%.3f, RMS %.2f v %.2f, difference %.2f mm\n"), sum(both),
              cor(surface$distance[both], there[both]), sqrt(mean(surface$distance[both]^2)),
              sqrt(mean(there[both]^2)), sqrt(mean((surface$distance - there)[both]^2))))
}

for (what in wanted) get(what)()
