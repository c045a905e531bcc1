# Linear models of shape against lm(), manova(), a plain loop, and RRPP where it is installed.

people <- function(n = 24, seed = 1) {
  with_seed(seed, data.frame(id = paste0("s", seq_len(n)), age = stats::runif(n, 5, 40),
                             sex = rep(c("F", "M"), length.out = n),
                             site = rep(c("a", "b", "c"), length.out = n, each = 2)))
}

modelled_sample <- function(data, per_year = 0.004, k = 10, seed = 2) {
  with_seed(seed, {
    x <- array(matrix(stats::rnorm(3 * k), k), c(k, 3, nrow(data)))
    x <- x + stats::rnorm(length(x), sd = 0.05)
  })
  x[1, 3, ] <- x[1, 3, ] + per_year * data$age
  dimnames(x) <- list(paste0("p", seq_len(k)), c("x", "y", "z"), data$id)
  align(x)
}

flat_rows <- function(aligned) t(matrix(aligned$coords, length(aligned$mean)))

test_that("squares and F of the whole shape are those of a plain Freedman-Lane loop", {
  data <- people()
  aligned <- modelled_sample(data)
  y <- scale(flat_rows(aligned), scale = FALSE)
  orders <- with_seed(4, replicate(20, sample.int(24)))
  model <- shape_lm(aligned, ~ age * sex, data,
                    settings = model_settings(tests = "shape", permutations = orders))
  hat <- function(formula) {
    x <- model.matrix(formula, data)
    x %*% solve(crossprod(x), t(x))
  }
  nested <- list(~ 1, ~ age, ~ age + sex, ~ age * sex)
  for (j in 1:3) {
    without <- hat(nested[[j]])
    added <- hat(nested[[j + 1]]) - without
    full <- hat(nested[[4]])
    one <- function(order) {
      e <- y - without %*% y
      z <- without %*% y + e[order, ]
      c(sum((added %*% z)^2), sum((z - full %*% z)^2))
    }
    each <- apply(cbind(1:24, orders), 2, one)
    f <- each[1, ] / (each[2, ] / 20)
    expect_equal(model$tests$squares[j], each[1, 1], tolerance = 1e-10)
    expect_equal(model$tests$statistic[j], f[1], tolerance = 1e-10)
    expect_equal(model$tests$p_value[j], mean(f >= f[1] * (1 - 1e-10)))
  }
})

test_that("size and components are those of lm(), components together those of manova()", {
  data <- people()
  aligned <- modelled_sample(data)
  model <- shape_lm(aligned, ~ site + poly(age, 2), data, n_perm = 19,
                    settings = model_settings(components = 4,
                                              tests = c("size", "components", "manova")))
  scores <- shape_pca(aligned)$x[, 1:4]
  rows <- function(test) model$tests[model$tests$test == test, ]
  size <- anova(lm(aligned$size ~ site + poly(age, 2), data))
  expect_equal(rows("size")$statistic, size$`F value`[1:2], tolerance = 1e-8)
  expect_equal(rows("size")$p_parametric, size$`Pr(>F)`[1:2], tolerance = 1e-8)
  second <- anova(lm(scores[, 2] ~ site + poly(age, 2), data))
  expect_equal(rows("PC2")$squares, second$`Sum Sq`[1:2], tolerance = 1e-8)
  expect_equal(rows("PC2")$df, c(2, 2))
  together <- summary(manova(scores ~ site + poly(age, 2), data))$stats
  expect_equal(rows("manova")$statistic, unname(together[1:2, "Pillai"]), tolerance = 1e-8)
  expect_equal(rows("manova")$p_parametric, unname(together[1:2, "Pr(>F)"]), tolerance = 1e-8)
})

test_that("types II and III are those of nested and of one-term-less models", {
  data <- people(25)
  aligned <- modelled_sample(data)
  y <- flat_rows(aligned)
  left <- function(formula) {
    sum(qr.resid(qr(model.matrix(formula, data)), y)^2)
  }
  fit <- function(ss) {
    shape_lm(aligned, ~ age * sex, data, n_perm = 19,
             settings = model_settings(tests = "shape", ss = ss,
                                       contrasts = list(sex = "contr.sum")))$tests$squares
  }
  second <- c(left(~ sex) - left(~ age + sex), left(~ age) - left(~ age + sex),
              left(~ age + sex) - left(~ age * sex))
  expect_equal(fit("II"), second, tolerance = 1e-8)
  x <- model.matrix(~ age * sex, data, list(sex = "contr.sum"))
  without <- vapply(2:4, function(j) sum(qr.resid(qr(x[, -j]), y)^2), 0)
  expect_equal(fit("III"), without - left(~ age * sex), tolerance = 1e-8)
  expect_warning(shape_lm(aligned, ~ age * sex, data, n_perm = 19,
                          settings = model_settings(tests = "shape", ss = "III")),
                 class = "crestline_contrasts")
})

test_that("many specimens of few points come to the same values by the other algebra", {
  data <- people(40)
  aligned <- modelled_sample(data, k = 4)
  wide <- array(0, c(74, 3, 40), list(NULL, NULL, names(aligned)))
  wide[1:4, , ] <- aligned$coords
  model <- level_model(model_terms(~ age + sex), as.list(data), aligned)
  spans <- term_spans(model, "I")
  orders <- cbind(1:40, with_seed(1, replicate(5, sample.int(40))))
  storage.mode(orders) <- "integer"
  few <- shape_scores(aligned, spans, orders)
  many <- shape_scores(as_aligned(wide, aligned$size), spans, orders)
  expect_equal(few, many, tolerance = 1e-10)
})

test_that("a size effect of two groups is no effect of group given size", {
  data <- people(40)
  x <- with_seed(9, array(matrix(rnorm(30), 10), c(10, 3, 40)) + rnorm(1200, sd = 0.02))
  dimnames(x)[[3]] <- data$id
  size <- ifelse(data$sex == "M", 1.2, 1) * with_seed(3, exp(rnorm(40, sd = 0.05)))
  x[2, 1, ] <- x[2, 1, ] + size
  x <- x * rep(size, each = 30)
  aligned <- suppressWarnings(align(x))
  alone <- shape_lm(aligned, ~ sex, data, seed = 1, settings = model_settings(tests = "shape"))
  given <- shape_lm(aligned, ~ log(size) + sex, data, seed = 1,
                    settings = model_settings(tests = "shape"))
  expect_lt(alone$tests$p_value, 0.01)
  expect_gt(given$tests$p_value[2], 0.05)
})

test_that("a term is found at its place by point, and nowhere else", {
  data <- people(40)
  aligned <- modelled_sample(data, 0.01)
  model <- shape_lm(aligned, ~ sex + age, data, seed = 1,
                    settings = model_settings(tests = "points"))
  of_age <- model$points[model$points$term == "age", ]
  expect_equal(of_age$point[which.max(of_age$statistic)], "p1")
  expect_lte(of_age$p_adjusted[1], 0.01)
  expect_true(all(model$points$p_adjusted >= model$points$p_value - 1e-12))
  y <- lapply(1:3, function(d) aligned$coords[1, d, ])
  each <- vapply(y, function(one) anova(lm(one ~ sex + age, data))$`Sum Sq`, numeric(3))
  sums <- rowSums(each)
  expect_equal(of_age$statistic[1], sums[2] / (sums[3] / 37), tolerance = 1e-8)
})

test_that("a map's distance is the regression coefficient along the normal, in the meshes' unit", {
  ball <- Rvcg::vcgSphere(2)
  xyz <- t(ball$vb[1:3, ]) * 50
  data <- people(16)
  balls <- simplify2array(lapply(1:16, function(i) {
    xyz * (1 + 0.001 * data$age[i] * exp(-((xyz[, 1] - 50) / 10)^2)) +
      with_seed(i, rnorm(length(xyz), sd = 0.01))
  }))
  dimnames(balls)[[3]] <- data$id
  aligned <- align(balls, "ball", triangles = ball$it)
  model <- shape_lm(aligned, ~ age, data, n_perm = 19, settings = model_settings(tests = "points"))
  top <- which.max(xyz[, 1])
  normal <- point_normals(aligned$mean, aligned$triangles)[top, ]
  along <- colSums(aligned$coords[top, , ] * normal) * mean(aligned$size)
  expect_equal(model$points$distance[top], unname(coef(lm(along ~ data$age))[2]), tolerance = 1e-8)
  expect_equal(model$points$distance[top], 0.05, tolerance = 0.1)
  file <- tempfile(fileext = ".png")
  grDevices::png(file)
  plot(model, "map", "age", unit = 10, engine = "picture")
  drawn <- plot(model, "scores")
  grDevices::dev.off()
  expect_equal(nrow(drawn), 16)
  expect_gt(file.size(file), 1000)
})

test_that("predicted shapes are those of lm() for factors, poly() and ns(), at any new value", {
  data <- people()
  aligned <- modelled_sample(data)
  model <- shape_lm(aligned, ~ splines::ns(age, 3) + sex, data, n_perm = 19,
                    settings = model_settings(tests = "shape"))
  new <- data.frame(age = c(12, 39), sex = c("M", "F"), row.names = c("boy", "woman"))
  found <- predict(model, new, size = 1)
  own <- lm(aligned$coords[3, 2, ] ~ splines::ns(age, 3) + sex, data)
  expect_equal(found[3, 2, ], predict(own, new), tolerance = 1e-10)
  expect_equal(predict(model, new) / found, array(mean(aligned$size), dim(found), dimnames(found)))
  size <- lm(log(aligned$size) ~ splines::ns(age, 3) + sex, data)
  fitted <- predict(model, new, size = "fitted")
  expect_equal(unname(apply(fitted / found, 3, mean)), unname(exp(predict(size, new))),
               tolerance = 1e-10)
  expect_error(predict(model, new["age"]), "has no column `sex`", class = "crestline_error")
  expect_error(predict(model, data.frame(age = 9, sex = "X")), class = "crestline_error")
})

test_that("rows of data are matched by name, whatever their order", {
  data <- people()
  aligned <- modelled_sample(data)
  fit <- function(data) shape_lm(aligned, ~ age, data, n_perm = 49, seed = 1,
                                 settings = model_settings(tests = "shape"))$tests
  expect_equal(fit(data[24:1, ]), fit(data))
  age <- data$age
  expect_error(shape_lm(aligned, ~ age), "no column of `data`", class = "crestline_error")
})

test_that("missing values, terms that say nothing and saturated models are named", {
  data <- people()
  aligned <- modelled_sample(data)
  gap <- replace(data, "age", replace(data$age, 3, NA))
  expect_error(shape_lm(aligned, ~ age, gap), "`age` is missing or infinite for s3",
               class = "crestline_error")
  data$again <- 2 * data$age
  expect_error(shape_lm(aligned, ~ age + again, data), "again adds nothing",
               class = "crestline_error")
  expect_error(shape_lm(aligned, ~ id, data), "as many coefficients", class = "crestline_error")
  expect_error(shape_lm(aligned, y ~ age, data), "left-hand side", class = "crestline_error")
  expect_error(shape_lm(aligned, ~ 0 + age, data), "no intercept", class = "crestline_error")
  expect_error(shape_lm(aligned, ~ log(age - 20), data), "missing or infinite",
               class = "crestline_error")
})

test_that("blocks: exchange within them, means of whole ones, no p for what they hold constant", {
  data <- people(24)
  data$person <- rep(letters[1:12], each = 2)
  data$visit <- rep(c("before", "after"), 12)
  data$born <- rep(1:12, each = 2)
  aligned <- modelled_sample(data)
  within <- shape_lm(aligned, ~ person + visit, data, block = data$person, seed = 1,
                     settings = model_settings(tests = "shape")) |> suppressWarnings()
  expect_equal(within$exchange, "within")
  expect_true(is.na(within$tests$p_value[1]))
  # With pairs only the sign of a difference can change.
  difference <- flat_rows(aligned)[c(TRUE, FALSE), ] - flat_rows(aligned)[c(FALSE, TRUE), ]
  signs <- as.matrix(expand.grid(rep(list(c(-1, 1)), 12)))
  each <- rowSums((signs %*% difference)^2)
  exact <- mean(each >= sum(colSums(difference)^2) * (1 - 1e-10))
  expect_equal(within$tests$p_value[2], exact, tolerance = 0.2)
  expect_warning(shape_lm(aligned, ~ born + visit, data, block = data$person, n_perm = 19,
                          settings = model_settings(
                            tests = "shape")), class = "crestline_constant_term")
  whole <- shape_lm(aligned, ~ born, data, block = data$person, n_perm = 19,
                    settings = model_settings(tests = "shape"))
  expect_equal(whole$exchange, "whole")
  expect_equal(whole$left, 10)
})

test_that("answers do not depend on pose, unit or order of the specimens", {
  data <- people()
  x <- modelled_sample(data)$coords
  turn <- qr.Q(qr(matrix(with_seed(5, rnorm(9)), 3)))
  moved <- array(apply(x, 3, function(one) 1000 * one %*% (turn * det(turn)) + 7), dim(x),
                 dimnames(x))
  mixed <- with_seed(6, sample.int(24))
  fit <- function(x) {
    shape_lm(align(x), ~ age + sex, data, n_perm = 19,
             settings = model_settings(components = 3,
                                       tests = c("shape", "components", "manova")))$tests
  }
  columns <- c("term", "test", "df", "squares", "statistic")
  expect_equal(fit(moved)[columns], fit(x)[columns], tolerance = 1e-6)
  expect_equal(fit(x[, , mixed])[columns], fit(x)[columns], tolerance = 1e-6)
})

test_that("squares, F, Z and p are those of RRPP on the same permutations", {
  skip_if_not_installed("RRPP")
  data <- people(30)
  aligned <- modelled_sample(data)
  frame <- RRPP::rrpp.data.frame(y = flat_rows(aligned), age = data$age, sex = factor(data$sex),
                                 site = factor(data$site), size = unname(aligned$size))
  formulas <- list(y ~ age + sex + log(size), y ~ age * sex, y ~ sex * site + age)
  for (formula in formulas) for (ss in c("I", "II", "III")) for (blocked in c(FALSE, TRUE)) {
    block <- if (blocked) frame$site
    theirs <- RRPP::lm.rrpp(formula, data = frame, iter = 199, seed = 1, SS.type = ss,
                            block = block, print.progress = FALSE)
    table <- anova(theirs)$table
    orders <- RRPP:::perm.index(30, 199, block = block, seed = 1)
    ours <- suppressWarnings(shape_lm(aligned, formula[-2], data,
                                      settings = model_settings(tests = "shape", ss = ss,
                                                                permutations = orders)))$tests
    of_terms <- seq_len(nrow(ours))
    expect_equal(ours$df, table$Df[of_terms])
    expect_equal(ours$squares, table$SS[of_terms], tolerance = 1e-8)
    expect_equal(ours$statistic, table$F[of_terms], tolerance = 1e-8)
    expect_equal(ours$z, table$Z[of_terms], tolerance = 1e-8)
    expect_equal(ours$p_value, table[of_terms, 7], tolerance = 1e-12)
  }
})

test_that("tables, print and summary fit", {
  data <- people()
  aligned <- modelled_sample(data)
  model <- shape_lm(list(a = aligned, b = aligned), ~ age + sex, data, n_perm = 19,
                    settings = model_settings(components = 2))
  expect_equal(nrow(as.data.frame(model)), 2 * 2 * 5)
  expect_equal(names(summary(model)), c("term", "test", "a", "b"))
  expect_output(print(model), "whole shape")
  expect_lt(length(capture.output(print(model))), 25)
  expect_s3_class(generics::tidy(model, "points"), "data.frame")
  expect_equal(generics::glance(model)$df.residual, 21)
})

test_that("curves and patches of a sample are tested with the family held", {
  made <- argument_objects()
  sample <- suppressWarnings(homologise(made$shapes, progress = FALSE))
  data <- data.frame(id = names(sample), w = c(1, 3, 2, 5, 4, 7, 6))
  model <- suppressWarnings(shape_lm(sample, ~ w, data, c("curves", "surface"), n_perm = 19,
                                     settings = model_settings(tests = "points")))
  expect_setequal(model$parts$part[model$parts$level == "curves"], made$scheme$curves$curve)
  expect_true(all(model$parts$p_adjusted >= model$parts$p_value - 1e-12))
  expect_equal(sum(model$parts$points[model$parts$level == "curves"]),
               nrow(coords(sample$template, "curves")))
  meshes <- predict(model, data.frame(w = c(1, 7)), "surface", as = "mesh")
  expect_s3_class(meshes[[1]], "mesh3d")
  expect_error(predict(model, data.frame(w = 1), "landmarks"), "level", class = "crestline_error")
  expect_error(predict(model, data.frame(w = 1), "curves", as = "mesh"), "triangles",
               class = "crestline_error")
})

test_that("a damaged model is refused by all its methods", {
  data <- people()
  aligned <- modelled_sample(data)
  model <- shape_lm(aligned, ~ age, data, n_perm = 19, settings = model_settings(components = 2))
  calls <- list(as.data.frame, summary, plot, predict, generics::tidy, generics::glance)
  for (part in c("aligned", "models", "formula")) {
    damaged <- structure(unclass(model)[setdiff(names(model), part)], class = "shape_lm")
    for (call in calls) {
      expect_error(utils::capture.output(call(damaged)), class = "crestline_error")
    }
  }
})

test_that("predictions outside of the sample are told, wrong kinds and levels are named", {
  made <- grouped_sample(c(6, 6))
  data <- data.frame(age = 1:12, sex = rep(c("F", "M"), 6), visit = rep(1:3, 4))
  model <- shape_lm(made$x, ~ log(size) + age, data, n_perm = 19, seed = 1,
                    settings = model_settings(tests = "shape"))
  inside <- data.frame(age = 6, size = mean(model$aligned[[1]]$size))
  expect_silent(predict(model, inside))
  expect_warning(predict(model, transform(inside, age = 40)), "age.*40; the sample has 1 to 12",
                 class = "crestline_extrapolated")
  expect_warning(predict(model, transform(inside, size = 100)), "centroid sizes of this level",
                 class = "crestline_extrapolated")
  expect_error(predict(model, data.frame(age = 6)), "centroid sizes of this level are",
               class = "crestline_error")
  expect_error(predict(model, transform(inside, age = "6")), "`age` of `newdata` is",
               class = "crestline_error")
  expect_error(shape_lm(made$x, ~ sex, transform(data, sex = "M")), "`sex` has one level only \\(M",
               class = "crestline_error")
  expect_message(shape_lm(made$x, ~ visit, data, n_perm = 19,
                          settings = model_settings(tests = "shape")), "factor\\(visit\\)",
                 class = "crestline_message")
})

test_that("specimens without a value are named with the way to leave them out", {
  made <- grouped_sample(c(6, 6))
  dimnames(made$x) <- list(NULL, NULL, paste0("s", 1:12))
  data <- data.frame(id = paste0("s", 1:12), age = replace(1:12, 4, NA))
  expect_error(shape_lm(made$x, ~ age, data), "setdiff\\(names\\(sample\\), \"s4\"\\)",
               class = "crestline_error")
  expect_error(shape_lm(made$x, ~ age, data[-4, ]), "or leave the specimen out",
               class = "crestline_error")
})

test_that("exact duplicates do not differ", {
  shape <- with_seed(1, matrix(rnorm(24), 8))
  each <- with_seed(2, replicate(6, shape * runif(1, 1, 2) + rnorm(24, sd = 0.02)))
  data <- data.frame(sex = rep(c("a", "b"), each = 6))
  model <- suppressWarnings(shape_lm(each[, , rep(1:6, 2)], ~ sex, data, n_perm = 99, seed = 1,
                                     settings = model_settings(components = 3)))
  expect_equal(model$tests$squares[model$tests$test != "manova"], rep(0, 5))
  expect_equal(model$tests$p_value, rep(1, 6))
  expect_equal(model$points$p_value, rep(1, 8))
  expect_equal(model$points$p_adjusted, rep(1, 8))
})

test_that("random effects are sent elsewhere; a column of the sample's own name may stand beside", {
  data <- people()
  aligned <- modelled_sample(data)
  fit <- function(formula, data) {
    shape_lm(aligned, formula, data, n_perm = 19, seed = 1,
             settings = model_settings(tests = "shape"))
  }
  for (formula in list(~ age + (1 | site), ~ age + Error(site))) {
    expect_crestline_error(fit(formula, data), c("random effect", "`block`", "lmm.rrpp"))
  }
  expect_s3_class(fit(~ I(age > 20 | sex == "F"), data), "shape_lm")
  measured <- transform(data, size = 1)
  expect_identical(fit(~ age, measured)$tests, fit(~ age, data)$tests)
  expect_crestline_error(fit(~ age + size, measured), "has a column `size`")
  model <- fit(~ splines::ns(age, 3) + sex, data)
  expect_crestline_error(predict(model, data.frame(age = c(10, NA), sex = "F")),
                         "`age` is missing or infinite for 2")
})
