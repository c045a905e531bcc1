# Linear models, discriminants and scores: level and power of tests and maps with covariates,
# allometry, leaving one out, new faces, speed. bench/models.md has the tables.
#
#   Rscript bench/models.R [maps] [allometry] [out] [new] [signs] [speed] [memory]
#     [published] [samples]
#
# samples: a number, 500 by default (200 for `out`). Results are kept in CRESTLINE_BENCH (a folder)
# as they come, where it is set. new, signs: CRESTLINE_SHARED. published: shapes; geomorph and
# RRPP (R 4.5).

library(crestline)

args <- commandArgs(TRUE)
samples <- as.integer(c(grep("^[0-9]+$", args, value = TRUE), 500)[1])
wanted <- setdiff(args, samples)
if (!length(wanted)) wanted <- c("maps", "allometry", "out", "new", "speed", "published")
quiet <- function(code) suppressWarnings(suppressMessages(code))

# Each seed's row, from the file of a run that was cut short where there is one.
by_seed <- function(what, n, one) {
  folder <- Sys.getenv("CRESTLINE_BENCH")
  file <- if (nzchar(folder)) file.path(folder, paste0("models-", what, ".rds"))
  rows <- if (!is.null(file) && file.exists(file)) readRDS(file) else list()
  for (seed in setdiff(seq_len(n), seq_along(rows))) {
    rows[[seed]] <- quiet(one(seed))
    if (!is.null(file) && seed %% 10 == 0) saveRDS(rows, file)
  }
  do.call(rbind, rows[seq_len(n)])
}
shares <- function(x, digits = 3) print(round(colMeans(x <= 0.05), digits))

# The template's surface, coarse enough for many samples: about 300 points with triangles.
coarse_face <- function(points = 300) {
  template <- simulate_faces(1, scan = NULL, seed = 1)$template
  mesh <- Rvcg::vcgQEdecim(template$mesh, tarface = 2 * points, silent = TRUE)
  face <- list(xyz = t(mesh$vb[1:3, ]), it = mesh$it)
  # The step of brow and cheek by 1 mm.
  face$field <- true_effect(simulate_faces(2, effect = 1, scan = NULL, seed = 1, progress = FALSE),
                            face$xyz)
  face
}

least <- function(p) min(p, na.rm = TRUE)

# ---- maps: age acts at brow and cheek, sex does not; the sexes differ in age ----

# Faces of simulate_faces(), both groups alike; age (5 to 40) moves brow and cheek by `effect` mm
# over its range. Age and sex go together: women are older on average.
aged_faces <- function(n, effect, seed, face) {
  drawn <- simulate_faces(n, effect = 0, size_effect = 0, scan = NULL, seed = seed,
                          progress = FALSE)
  set.seed(seed)
  sex <- rep(c("F", "M"), length.out = n)
  age <- 5 + 35 * rbeta(n, ifelse(sex == "F", 2, 1.2), ifelse(sex == "F", 1.2, 2))
  x <- true_points(drawn, face$xyz)
  x <- x + outer(face$field, effect * (age - 22.5) / 35)
  dimnames(x) <- list(seq_len(nrow(face$xyz)), c("x", "y", "z"), drawn$covariates$id)
  list(aligned = align(x, "face", triangles = face$it),
       data = data.frame(id = drawn$covariates$id, age = age, sex = sex),
       there = sqrt(rowSums(face$field^2)))
}

maps <- function() {
  face <- coarse_face()
  one <- function(seed) {
    made <- aged_faces(40, 6, seed, face)
    model <- shape_lm(made$aligned, ~ age + sex, made$data, n_perm = 199, seed = seed,
                      settings = model_settings(ss = "II", components = 5))
    alone <- compare_groups(made$aligned, setNames(made$data$sex, made$data$id), n_perm = 199,
                            seed = seed,
                            settings = comparison_settings(components = 5,
                                                           tests = c("shape", "points")))
    of <- function(term, test) {
      model$tests$p_value[model$tests$term == term & model$tests$test == test]
    }
    points <- function(term) model$points[model$points$term == term, ]
    found <- points("age")$p_adjusted <= 0.05
    c(sex_points = least(points("sex")$p_adjusted), sex_shape = of("sex", "shape"),
      sex_manova = of("sex", "manova"), sex_size = of("sex", "size"),
      sex_pc = min(model$tests$p_adjusted[model$tests$term == "sex" &
                                          grepl("PC", model$tests$test)]),
      age_points = least(points("age")$p_adjusted), age_shape = of("age", "shape"),
      age_manova = of("age", "manova"), without_age_shape = alone$tests$p_value[1],
      without_age_points = least(alone$points$p_adjusted),
      top_there = made$there[which.max(abs(points("age")$statistic))] > 0,
      found_there = mean(found[made$there > 0.5], na.rm = TRUE),
      found_elsewhere = mean(found[made$there == 0], na.rm = TRUE))
  }
  rows <- by_seed("maps", samples, one)
  cat("\nage moves brow and cheek by 6 mm over its range, sex does nothing; 40 faces,", samples,
      "samples\n")
  cat("share with p <= 0.05:\n")
  shares(rows[, 1:10])
  cat("greatest statistic of age lies in the effect:", mean(rows[, "top_there"]),
      "; points found where it is above half:", mean(rows[, "found_there"]), "; where it is 0:",
      mean(rows[, "found_elsewhere"]), "\n")
}

# ---- allometry: two groups that differ by size only ----

allometry <- function() {
  set.seed(1)
  mean <- matrix(rnorm(90), 30)
  base <- list(mean = array(mean, c(30, 3, 40)), growth = mean * 0.15 * rnorm(30))
  one <- function(seed) {
    set.seed(seed)
    n <- 40
    sex <- rep(c("F", "M"), n / 2)
    size <- exp(rnorm(n, ifelse(sex == "M", 0.1, 0), 0.08))
    x <- base$mean + outer(base$growth, log(size)) + rnorm(length(base$mean), sd = 0.02)
    x <- sweep(x, 3, size, `*`)
    dimnames(x) <- list(NULL, NULL, paste0("s", seq_len(n)))
    aligned <- align(x)
    data <- data.frame(id = paste0("s", seq_len(n)), sex = sex)
    given <- shape_lm(aligned, ~ log(size) + sex, data, n_perm = 199, seed = seed,
                      settings = model_settings(tests = c("shape", "points")))
    alone <- shape_lm(aligned, ~ sex, data, n_perm = 199, seed = seed,
                      settings = model_settings(tests = "shape"))
    # The wrong way: residuals of size as new shapes, tested as if size had never been there.
    y <- t(matrix(aligned$coords, length(aligned$mean)))
    rest <- array(t(resid(lm(y ~ log(aligned$size)))) + as.vector(aligned$mean),
                  dim(aligned$coords), dimnames(aligned$coords))
    wrong <- shape_lm(as_aligned(rest), ~ sex, data, n_perm = 199, seed = seed,
                      settings = model_settings(tests = c("shape", "points")))
    c(alone = alone$tests$p_value, given_size = given$tests$p_value[2],
      given_size_points = min(given$points$p_adjusted[given$points$term == "sex"]),
      residuals = wrong$tests$p_value, residuals_points = min(wrong$points$p_adjusted))
  }
  rows <- by_seed("allometry", samples, one)
  cat("\ntwo groups that differ in size only (10 %),", samples,
      "samples; share with p <= 0.05 for sex:\n")
  shares(rows)
}

# ---- leaving one out: labels without meaning, and an effect ----

out <- function() {
  face <- coarse_face(150)
  one <- function(effect) function(seed) {
    drawn <- simulate_faces(30, effect = effect, size_effect = 0, scan = NULL, seed = seed,
                            progress = FALSE)
    x <- true_points(drawn, face$xyz)
    group <- setNames(drawn$covariates$group, drawn$covariates$id)
    dimnames(x)[[3]] <- names(group)
    fit <- shape_lda(x, group, components = c(2, 4, 6, 8), progress = FALSE)
    # All components and their number from the whole sample, the discriminants alone left one out.
    pca <- shape_pca(align(x))
    seen <- vapply(c(2, 4, 6, 8), function(k) {
      mean(MASS::lda(pca$x[, 1:k, drop = FALSE] / 1e-3, group, CV = TRUE)$class == group)
    }, 0)
    data.frame(right = 1 - fit$error, best_seen = max(seen),
               resubstituted = mean(predict(fit)$class == group))
  }
  n <- min(samples, 200)
  for (effect in c(0, 2)) {
    rows <- by_seed(paste0("out-", effect), n, one(effect))
    cat("\nleaving one out,", n, "samples of 30 faces, effect", effect, "mm: share right\n")
    print(round(colMeans(rows), 3))
    cat("standard error of the first:", signif(sd(rows$right) / sqrt(n), 2), "\n")
  }
}

# ---- simpop: landmarks, and every or some vertices ----

simpop <- function(vertices = NULL) {
  folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
  placed <- read.csv(file.path(folder, "landmarks.csv"))
  ids <- unique(placed$id)
  marks <- simplify2array(lapply(ids,
                                 function(id) as.matrix(placed[placed$id == id, c("x", "y", "z")])))
  dimnames(marks) <- list(unique(placed$landmark), c("x", "y", "z"), ids)
  dense <- simplify2array(lapply(ids, function(id) {
    mesh <- Rvcg::vcgImport(file.path(folder, paste0(id, ".ply")), readcolor = FALSE, silent = TRUE)
    count <- min(vertices, ncol(mesh$vb))
    t(mesh$vb[1:3, round(seq(1, ncol(mesh$vb), length.out = count))])
  }))
  dimnames(dense) <- list(NULL, c("x", "y", "z"), ids)
  list(landmarks = marks, vertices = dense)
}

# ---- new faces: each left out, its scores against those in the whole sample ----

new <- function() {
  for (x in simpop()) {
    whole <- shape_pca(quiet(align(x)))
    own <- max(abs(predict(whole, x) - whole$x))
    off <- t(vapply(seq_len(dim(x)[3]), function(i) {
      part <- shape_pca(quiet(align(x[, , -i])))
      score <- predict(part, x[, , i])
      turn <- sign(colSums(part$rotation[, 1:5] * whole$rotation[, 1:5]))
      c(abs(score[1, 1:5] * turn - whole$x[i, 1:5]) / whole$sdev[1:5],
        outside = unname(attr(score, "outside")))
    }, numeric(6)))
    cat("\nnew faces, ", dim(x)[1], " points: own scores differ by ", signif(own, 2),
        "; left out, median |difference| in sd of PC1 to PC5, and share outside:\n", sep = "")
    print(round(apply(off, 2, median), 3))
  }
}

# ---- signs: each face of simpop left out, which of the first five components turn round ----

signs <- function() {
  for (x in simpop(1500)) {
    whole <- shape_pca(quiet(align(x)))
    found <- lapply(seq_len(dim(x)[3]), function(i) {
      part <- shape_pca(quiet(align(x[, , -i])))
      r <- cor(part$x[, 1:8], whole$x[-i, 1:5])
      # Another component is nearer: exchanged. The same with the other sign: turned.
      c(exchanged = sum(apply(abs(r), 2, which.max) != 1:5),
        turned = sum(apply(abs(r), 2, which.max) == 1:5 & diag(r[1:5, ]) < 0))
    })
    cat("\nsigns, ", dim(x)[1], " points, of ", 5 * dim(x)[3], " components:\n", sep = "")
    print(Reduce(`+`, found))
  }
}

# ---- speed ----

speed <- function() {
  set.seed(1)
  base <- matrix(rnorm(3 * 922), 922)
  shapes <- function(n) {
    x <- array(base, c(922, 3, n)) + rnorm(3 * 922 * n, sd = 0.02)
    dimnames(x)[[3]] <- paste0("s", seq_len(n))
    quiet(align(x))
  }
  row <- function(what, code, times = 3) {
    code <- substitute(code)
    frame <- parent.frame()
    each <- replicate(times, {
      gc()
      time <- system.time(eval(code, frame))
      sum(time[c("user.self", "sys.self")])
    })
    cat(sprintf("%-60s %.2f s (least of %d)\n", what, min(each), times))
  }
  a <- shapes(250)
  data <- data.frame(id = names(a), age = runif(250), sex = rep(c("F", "M"), 125))
  fit <- function(aligned, tests, data) {
    shape_lm(aligned, ~ age + sex + log(size), data, seed = 1,
             settings = model_settings(tests = tests))
  }
  cat("\nshape_lm(~ age + sex + log(size)), 1,000 permutations, processor seconds\n")
  row("250 x 922, whole shape", fit(a, "shape", data))
  row("250 x 922, whole shape, manova, ten components",
      fit(a, c("shape", "manova", "components"), data))
  row("250 x 922, points (all co-ordinates)", fit(a, "points", data))
  row("250 x 922, all tests", fit(a, model_settings()$tests, data))
  group <- setNames(data$sex, data$id)
  for (tests in list("shape", comparison_settings()$tests)) {
    row(paste("250 x 922, compare_groups(),", if (length(tests) == 1) tests else "all"),
        quiet(compare_groups(a, group, seed = 1, settings = comparison_settings(tests = tests))))
  }
  if (requireNamespace("RRPP", quietly = TRUE)) {
    frame <- RRPP::rrpp.data.frame(y = t(matrix(a$coords, 3 * 922)), age = data$age,
                                   sex = factor(data$sex), size = a$size)
    row("250 x 922, RRPP::lm.rrpp(), whole shape",
        RRPP::lm.rrpp(y ~ age + sex + log(size), data = frame, iter = 999, print.progress = FALSE),
        1)
  }
  rm(a)
  big <- shapes(2000)
  data <- data.frame(id = names(big), age = runif(2000), sex = rep(c("F", "M"), 1000))
  row("2,000 x 922, whole shape", fit(big, "shape", data), 1)
}

# ---- memory: 5,000 specimens, each test by itself and all ----

# `peak`: what the heap grew by, garbage included, as a multiple of the array.
memory <- function(n = 5000) {
  set.seed(1)
  base <- matrix(rnorm(3 * 922), 922)
  x <- array(rnorm(3 * 922 * n, sd = 0.02), c(922, 3, n), list(NULL, NULL, paste0("s", seq_len(n))))
  for (i in seq_len(n)) x[, , i] <- x[, , i] + base
  array <- as.numeric(object.size(x)) / 2^20
  row <- function(what, code) {
    before <- sum(gc(reset = TRUE)[, 2])
    time <- sum(system.time(code)[1:2])
    cat(sprintf("%-36s %5.1f s, peak %.1f arrays\n", what, time, (sum(gc()[, 6]) - before) / array))
  }
  cat("\n", n, " x 922, an array of ", round(array), " MB; processor seconds\n", sep = "")
  row("align()", aligned <- quiet(align(x)))
  rm(x)
  group <- setNames(rep(c("a", "b"), length.out = n), names(aligned))
  for (tests in c(as.list(comparison_settings()$tests), list(comparison_settings()$tests))) {
    row(paste("compare_groups()", if (length(tests) == 1) tests else "all"),
        quiet(compare_groups(aligned, group, seed = 1,
                             settings = comparison_settings(tests = tests))))
  }
  data <- data.frame(id = names(aligned), age = runif(n), sex = group)
  for (tests in c(as.list(model_settings()$tests), list(model_settings()$tests))) {
    row(paste("shape_lm(), three terms,", if (length(tests) == 1) tests else "all"),
        quiet(shape_lm(aligned, ~ age + sex + log(size), data, seed = 1,
                       settings = model_settings(tests = tests))))
  }
  row("shape_pca(), ten components", shape_pca(aligned, components = 10))
  status <- "/proc/self/status"
  if (file.exists(status)) cat(grep("VmHWM", readLines(status), value = TRUE), "\n")
}

# ---- published examples, with covariates: geomorph's, and the gorillas of shapes ----

named <- function(x) {
  if (is.null(dimnames(x)[[3]])) dimnames(x) <- list(NULL, NULL, paste0("s", seq_len(dim(x)[3])))
  x
}

# Ours beside RRPP on the same permutations where it is installed, else beside lm() of every
# co-ordinate, type I.
compare <- function(what, coords, size, formula, data, ss = "I") {
  aligned <- as_aligned(coords, size)
  rows <- data.frame(id = names(aligned), data)
  with_rrpp <- requireNamespace("RRPP", quietly = TRUE)
  set.seed(1)
  orders <- if (with_rrpp) RRPP:::perm.index(dim(coords)[3], 999, seed = 1) else
    replicate(999, sample.int(dim(coords)[3]))
  settings <- model_settings(tests = "shape", permutations = orders, ss = ss)
  ours <- quiet(shape_lm(aligned, formula, rows, settings = settings))$tests
  k <- seq_len(nrow(ours))
  y <- t(matrix(aligned$coords, length(aligned$mean)))
  frame <- c(list(y = y, size = unname(aligned$size)), lapply(data, identity))
  if (with_rrpp) {
    theirs <- RRPP::lm.rrpp(update(formula, y ~ .), iter = 999, seed = 1, print.progress = FALSE,
                            data = do.call(RRPP::rrpp.data.frame, frame), SS.type = ss)
    table <- anova(theirs)$table[k, ]
    names(table)[7] <- "p"
  } else {
    left <- vapply(c(0, k), function(count) {
      terms <- attr(terms(formula), "term.labels")[seq_len(count)]
      sum(resid(lm(reformulate(c("1", terms), "y"), frame))^2)
    }, 0)
    df <- df.residual(lm(update(formula, y ~ .), frame))
    table <- data.frame(SS = -diff(left), F = -diff(left) / ours$df / (left[length(left)] / df),
                        Z = NA, p = NA)
  }
  cat(sprintf("\n%s, type %s, beside %s. Greatest difference: SS %.1e, F %.1e (relative), %s\n",
              what, ss, if (with_rrpp) "RRPP" else "lm()", max(abs(ours$squares / table$SS - 1)),
              max(abs(ours$statistic / table$F - 1)),
              sprintf("Z %.1e, p %.1e", max(abs(ours$z - table$Z)),
                      max(abs(ours$p_value - table$p)))))
  print(data.frame(ours[c("term", "df")], signif(ours[c("squares", "share", "statistic", "z")], 5),
                   p_value = ours$p_value), row.names = FALSE)
}

gorillas <- function() {
  utils::data("gorf.dat", "gorm.dat", package = "shapes", envir = environment())
  x <- named(array(c(gorf.dat, gorm.dat), c(8, 2, 59)))
  aligned <- quiet(align(x))
  data <- list(sex = rep(c("f", "m"), c(30, 29)))
  for (formula in c(~ log(size) + sex, ~ log(size) * sex)) {
    compare(paste("gorillas", deparse1(formula)), aligned$coords, aligned$size, formula, data)
  }
}

published <- function() {
  if (requireNamespace("shapes", quietly = TRUE)) gorillas()
  if (!requireNamespace("geomorph", quietly = TRUE))
    return(cat("\npublished: geomorph is not installed\n"))
  utils::data("plethodon", "pupfish", "scallops", "mosquito", package = "geomorph",
              envir = environment())
  gpa <- geomorph::gpagen(named(plethodon$land), print.progress = FALSE)
  data <- list(species = plethodon$species, site = plethodon$site)
  for (formula in c(~ species * site, ~ log(size) + species * site)) {
    compare(paste("plethodon", deparse1(formula)), gpa$coords, gpa$Csize, formula, data)
  }
  data <- list(Sex = pupfish$Sex, Pop = pupfish$Pop)
  fish <- function(...) {
    compare(..., coords = named(pupfish$coords), size = unname(pupfish$CS), data = data)
  }
  fish("pupfish log(size)", formula = ~ log(size))
  fish("pupfish log(size) + Sex + Pop", formula = ~ log(size) + Sex + Pop)
  fish("pupfish log(size) + Sex * Pop", formula = ~ log(size) + Sex * Pop)
  fish("pupfish log(size) + Sex * Pop", formula = ~ log(size) + Sex * Pop, ss = "II")
  fish("pupfish log(size) * Sex * Pop", formula = ~ log(size) * Sex * Pop, ss = "III")
  gpa <- geomorph::gpagen(named(mosquito$wingshape), print.progress = FALSE)
  compare("mosquito ind * side", gpa$coords, gpa$Csize, ~ ind * side,
          list(ind = factor(mosquito$ind), side = factor(mosquito$side)))
  symmetric_scallops(scallops)
}

symmetric_scallops <- function(scallops) {
  first <- geomorph::gpagen(named(scallops$coorddata), Proj = FALSE, print.progress = FALSE)
  theirs <- geomorph::bilat.symmetry(first, ind = scallops$ind, object.sym = TRUE, iter = 99,
                                     land.pairs = scallops$land.pairs, print.progress = FALSE)
  x <- named(scallops$coorddata)
  rownames(x) <- seq_len(nrow(x))
  pairs <- matrix(as.character(scallops$land.pairs), ncol = 2)
  ours <- quiet(symmetry_parts(x, pairs = pairs))$tests
  k <- seq_len(nrow(ours))
  cat(sprintf("\nscallops, object symmetry. Greatest relative difference: SS %.1e, F %.1e\n",
              max(abs(ours$squares / theirs$shape.anova$SS[k] - 1), na.rm = TRUE),
              max(abs(ours$statistic / theirs$shape.anova$F[k] - 1), na.rm = TRUE)))
  print(theirs$shape.anova)
  print(ours)
}

for (what in wanted) get(what)()
