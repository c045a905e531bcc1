# Closed forms here are those of pooled spread; test-analysis-spread.R has the others.
compare_quietly <- function(..., progress = FALSE, equal_spread = TRUE) {
  comparing(..., progress = progress, equal_spread = equal_spread)
}

test_row_of <- function(compared, test) compared$tests[compared$tests$test == test, ]

test_that("size is tested by Student's t", {
  data <- grouped_sample(c(8, 11))
  data$x <- data$x * rep(with_seed(3, runif(19, 1, 1.4)), each = 36)
  compared <- compare_quietly(data$x, data$group, n_perm = 2000, seed = 1, tests = "size")
  size <- align(data$x)$size
  theirs <- t.test(size[1:8], size[9:19], var.equal = TRUE)
  expect_equal(compared$tests$statistic, theirs$statistic[["t"]], tolerance = 1e-10)
  expect_equal(compared$tests$p_parametric, theirs$p.value, tolerance = 1e-10)
  # The permutation's p-value is near it: within four standard errors of 2,000 draws.
  p <- theirs$p.value
  expect_lt(abs(compared$tests$p_value - p), 4 * sqrt(p * (1 - p) / 2000) + 0.01)
})

test_that("the distance of means and Goodall's F are those of the aligned shapes", {
  data <- grouped_sample(c(8, 11), effect = 0.05)
  compared <- compare_quietly(data$x, data$group, seed = 1, n_perm = 50, tests = "shape")
  flat <- t(matrix(align(data$x)$coords, 36))
  means <- rowsum(flat, data$group) / c(8, 11)
  expect_equal(compared$tests$statistic, sqrt(sum((means[1, ] - means[2, ])^2)), tolerance = 1e-10)
  three <- factor(rep(c("a", "b", "c"), c(6, 6, 7)))
  compared <- compare_quietly(data$x, three, seed = 1, n_perm = 50, tests = "shape")
  fit <- lm(flat ~ three)
  within <- sum(residuals(fit)^2)
  between <- sum(sweep(flat, 2, colMeans(flat))^2) - within
  expect_equal(compared$tests$statistic, (between / 2) / (within / 16), tolerance = 1e-8)
  expect_equal(compared$tests$share, between / (between + within), tolerance = 1e-8)
})

test_that("T2 is its closed form, on the scores of the first components", {
  data <- grouped_sample(c(9, 12), effect = 0.03)
  compared <- compare_quietly(data$x, data$group, components = 4, seed = 1, n_perm = 50,
                              tests = "T2")
  x <- prcomp(t(matrix(align(data$x)$coords, 36)))$x[, 1:4]
  a <- x[1:9, ]
  b <- x[10:21, ]
  pooled <- (8 * cov(a) + 11 * cov(b)) / 19
  off <- colMeans(a) - colMeans(b)
  t2 <- 9 * 12 / 21 * drop(off %*% solve(pooled, off))
  expect_equal(compared$tests$statistic, t2, tolerance = 1e-8)
  expect_equal(compared$tests$p_parametric, pf(t2 * 16 / (19 * 4), 4, 16, lower.tail = FALSE),
               tolerance = 1e-8)
  three <- factor(rep(c("a", "b", "c"), 7))
  compared <- compare_quietly(data$x, three, components = 4, seed = 1, n_perm = 50,
                              tests = c("T2", "components"))
  theirs <- summary(manova(x ~ three), test = "Hotelling-Lawley")$stats
  expect_equal(test_row_of(compared, "T2")$statistic, 18 * theirs[1, "Hotelling-Lawley"],
               tolerance = 1e-8)
  expect_equal(test_row_of(compared, "T2")$p_parametric, theirs[1, "Pr(>F)"], tolerance = 1e-8)
  one <- anova(lm(x[, 2] ~ three))
  expect_equal(test_row_of(compared, "PC2")$statistic, one$`F value`[1], tolerance = 1e-8)
  expect_equal(test_row_of(compared, "PC2")$p_parametric, one$`Pr(>F)`[1], tolerance = 1e-8)
})

test_that("components can be a share of the variance, and never too many", {
  data <- grouped_sample(c(5, 5))
  share <- cumsum(shape_pca(align(data$x))$share)
  counted <- function(components)
    unname(compare_quietly(data$x, data$group, components = components, n_perm = 19,
                           tests = "T2")$components)
  expect_equal(counted(share[3]), 3)
  expect_equal(counted(share[3] + 1e-6), 4)
  expect_equal(counted(50), 7)
})

test_that("few regroupings are all taken: the p-values of every one", {
  data <- grouped_sample(c(3, 4), effect = 0.05, seed = 3)
  compared <- compare_quietly(data$x, data$group, components = 2, exact = 35)
  expect_true(compared$exact)
  expect_equal(compared$n_perm, 34)
  aligned <- align(data$x)
  flat <- t(matrix(aligned$coords, 36))
  pca <- prcomp(flat)$x
  distance <- function(first) sqrt(sum((colMeans(flat[first, ]) - colMeans(flat[-first, ]))^2))
  t_of <- function(y) function(first) abs(t.test(y[first], y[-first], var.equal = TRUE)$statistic)
  p_of <- function(statistic) {
    all <- combn(7, 3, statistic)
    mean(all >= all[1] * (1 - 1e-10))
  }
  expect_equal(test_row_of(compared, "mean shape")$p_value, p_of(distance))
  expect_equal(test_row_of(compared, "size t")$p_value, p_of(t_of(aligned$size)))
  expect_equal(test_row_of(compared, "PC2")$p_value, p_of(t_of(pca[, 2])))
  # Adjusted by the greatest over the two components.
  most <- combn(7, 3, function(first) max(t_of(pca[, 1])(first), t_of(pca[, 2])(first)))
  own <- t_of(pca[, 2])(1:3)
  expect_equal(test_row_of(compared, "PC2")$p_adjusted, mean(most >= own * (1 - 1e-10)))
  three <- compare_quietly(data$x, c(1, 1, 2, 2, 3, 3, 3), exact = 210, tests = "size")
  expect_equal(three$n_perm, 209)
  expect_equal(anyDuplicated(t(all_regroupings(c(1, 1, 2, 2, 3, 3, 3)))), 0)
})

test_that("statistics of many regroupings are the same block by block", {
  data <- grouped_sample(c(5, 6))
  labels <- regroupings(data$group, 60, 0, seed = 1)$labels
  y <- t(matrix(align(data$x)$coords, 36))
  y <- sweep(y, 2, colMeans(y))
  between <- function(about) {
    function(part) group_squares(about, cbind(rowSums(y^2)), part, FALSE)$between
  }
  each <- squared_sums(list(y))
  whole <- between(each)(labels)
  expect_equal(by_block(labels, between(each), 7), whole)
  # All variables together: from inner products, and from the sums of the groups.
  spread <- list(equal = TRUE, lost = 0)
  aligned <- align(data$x)
  expect_equal(whole_shape(aligned, labels, spread)$between, cbind(rowSums(whole)))
  few <- as_aligned(aligned$coords[1:3, , ], aligned$size)
  expect_equal(whole_shape(few, labels, spread)$between,
               cbind(rowSums(whole[, c(1:3, 13:15, 25:27)])))
  few <- y[, 1:4]
  apart <- group_squares(squared_sums(list(few)), few^2, labels[, 1, drop = FALSE], TRUE)
  within <- lapply(split(as.data.frame(few), data$group), function(own) {
    rbind(diag(var(own)) * (nrow(own) - 1))
  })
  expect_equal(apart$within, unname(within), ignore_attr = TRUE)
  expect_equal(all_regroupings(c(2L, 1L, 2L))[, 1], c(2, 1, 2))
})

test_that("tests of some points at a time are those of all", {
  data <- grouped_sample(c(12, 9), 0.05)
  own <- list(surface = align(data$x, triangles = four_triangles()), curves = align(data$x))
  people <- data.frame(id = names(own$curves), age = seq_len(21))
  compare <- function() {
    list(compare_groups(own, data$group, n_perm = 30, seed = 1,
                        settings = comparison_settings(components = 2))[c("tests", "points")],
         shape_lm(own, ~ age, people, n_perm = 30, seed = 1)[c("tests", "points")])
  }
  whole <- compare()
  expect_length(point_chunks(own$curves), 1)
  with_chunks(200, {
    expect_length(asNamespace("crestline")$point_chunks(own$curves), 4)
    expect_equal(compare(), whole, tolerance = 1e-10)
  })
})

test_that("p-values on given permutations are those of the definition, and RRPP's", {
  data <- grouped_sample(c(8, 9), effect = 0.02)
  orders <- with_seed(5, replicate(199, sample(17)))
  compared <- compare_quietly(data$x, data$group, permutations = orders, tests = c("shape", "size"))
  aligned <- align(data$x)
  flat <- t(matrix(aligned$coords, 36))
  distance <- function(order) {
    sum((colMeans(flat[order, ][1:8, ]) - colMeans(flat[order, ][9:17, ]))^2)
  }
  all <- c(distance(1:17), apply(orders, 2, distance))
  expect_equal(test_row_of(compared, "mean shape")$p_value, mean(all >= all[1]))
  skip_if_not_installed("RRPP")
  theirs <- RRPP:::perm.index(17, 199, seed = 3)
  compared <- compare_quietly(data$x, data$group, permutations = theirs, tests = c("shape", "size"))
  frame <- RRPP::rrpp.data.frame(y = flat, size = unname(aligned$size), group = data$group)
  fit <- RRPP::lm.rrpp(y ~ group, data = frame, iter = 199, seed = 3)
  expect_equal(test_row_of(compared, "mean shape")$p_value, anova(fit)$table[1, "Pr(>F)"])
  fit <- RRPP::lm.rrpp(size ~ group, data = frame, iter = 199, seed = 3)
  expect_equal(test_row_of(compared, "size t")$p_value, anova(fit)$table[1, "Pr(>F)"])
})

test_that("a seed gives the same answer and leaves the session's stream alone", {
  data <- grouped_sample()
  set.seed(4)
  before <- .Random.seed
  one <- compare_quietly(data$x, data$group, n_perm = 99, seed = 7)
  expect_identical(.Random.seed, before)
  expect_identical(compare_quietly(data$x, data$group, n_perm = 99, seed = 7)$tests, one$tests)
  other <- compare_quietly(data$x, data$group, n_perm = 99)
  expect_false(identical(.Random.seed, before))
  set.seed(4)
  expect_identical(compare_quietly(data$x, data$group, n_perm = 99)$tests, other$tests)
})

test_that("the answer does not depend on the names and order of specimens, unit or pose", {
  data <- grouped_sample(c(4, 4), effect = 0.05)
  x <- array(data$x, dim(data$x), list(NULL, NULL, letters[1:8]))
  group <- setNames(data$group, letters[1:8])
  one <- compare_quietly(x, group, components = 3)
  order <- c(5, 2, 8, 1, 3, 4, 7, 6)
  other <- compare_quietly(1000 * x[, , order], group[8:1], components = 3)
  # Bootstrap samples are drawn anew.
  drawn <- c("lower", "upper")
  expect_equal(other$tests[setdiff(names(one$tests), drawn)],
               one$tests[setdiff(names(one$tests), drawn)], tolerance = 1e-6)
  expect_equal(other$points$displacement, 1000 * one$points$displacement, tolerance = 1e-8)
})

test_that("points: where the groups differ is found, and the family is controlled as defined", {
  data <- grouped_sample(c(12, 12), effect = 0.3, where = 3, sd = 0.03)
  compared <- compare_quietly(data$x, data$group, n_perm = 400, seed = 1, tests = "points")
  expect_equal(which.min(compared$points$p_value), 3)
  expect_equal(which.max(compared$points$displacement), 3)
  # Alignment spreads a part of it over all points.
  expect_equal(compared$points$displacement[3], 0.3, tolerance = 0.25)
  few <- grouped_sample(c(3, 3), effect = 0.1)
  all <- compare_quietly(few$x, few$group, tests = "points")
  coords <- align(few$x)$coords
  f_of <- function(point, first) {
    y <- t(coords[point, , ])
    group <- factor(seq_len(6) %in% first)
    fit <- lm(y ~ group)
    within <- sum(residuals(fit)^2)
    (sum(sweep(y, 2, colMeans(y))^2) - within) / (within / 4)
  }
  each <- combn(6, 3, function(first) vapply(1:12, f_of, 0, first))
  expect_equal(all$points$statistic, each[, 1], tolerance = 1e-8)
  expect_equal(all$points$p_value, rowMeans(each >= each[, 1] * (1 - 1e-8)))
  most <- apply(each, 2, max)
  expect_equal(all$points$p_adjusted,
               vapply(each[, 1], function(f) mean(most >= f * (1 - 1e-8)), 0))
})

test_that("on a surface the displacement along the normal is tested", {
  data <- grouped_sample(c(10, 10), effect = 0.2, where = 1, k = 6, sd = 0.02)
  it <- four_triangles()
  aligned <- align(data$x, triangles = it)
  compared <- compare_quietly(aligned, data$group, n_perm = 99, seed = 1, tests = "points")
  normal <- point_normals(aligned$mean, it)
  means <- lapply(c("a", "b"), function(g) apply(aligned$coords[, , data$group == g], 1:2, mean))
  signed <- rowSums((means[[2]] - means[[1]]) * normal) * mean(aligned$size)
  expect_equal(compared$points$distance, unname(signed), tolerance = 1e-10)
  y <- apply(aligned$coords, 3, function(one) sum(one[1, ] * normal[1, ]))
  theirs <- t.test(y[data$group == "b"], y[data$group == "a"], var.equal = TRUE)$statistic
  expect_equal(compared$points$statistic[1], theirs[["t"]], tolerance = 1e-8)
  expect_equal(is.na(compared$points$p_value), c(rep(FALSE, 4), TRUE, TRUE))
})

test_that("normals of a ball point outwards", {
  ball <- ball_mesh(3)
  xyz <- t(ball$vb[1:3, ])
  expect_equal(point_normals(xyz, ball$it), xyz, tolerance = 0.01, ignore_attr = TRUE)
})

test_that("no difference is found in 5 % of samples without one", {
  p <- vapply(1:120, function(seed) {
    data <- grouped_sample(c(6, 6), seed = seed)
    tests <- compare_quietly(data$x, data$group, n_perm = 39, exact = 0, components = 3,
                             seed = seed)
    c(test_row_of(tests, "size t")$p_value, test_row_of(tests, "mean shape")$p_value,
      test_row_of(tests, "T2")$p_value, min(tests$tests$p_adjusted[grepl("PC", tests$tests$test)]),
      min(tests$points$p_adjusted))
  }, numeric(5))
  limits <- qbinom(c(0.0005, 0.9995), 120, 0.05)
  rejected <- rowSums(p <= 0.05)
  expect_true(all(rejected >= limits[1] & rejected <= limits[2]))
})

test_that("levels stand side by side", {
  data <- grouped_sample(c(6, 6), effect = 0.1)
  few <- data$x[4:12, , ]
  compared <- compare_quietly(list(all = data$x, few = few), data$group, n_perm = 99, seed = 1,
                              components = 2)
  expect_equal(names(summary(compared)), c("test", "all", "few"))
  few_tests <- compared$tests[compared$tests$level == "few", ]
  expect_equal(summary(compared)$few[2], few_tests$p_value[few_tests$test == "mean shape"])
  expect_identical(as.data.frame(compared), compared$tests)
  text <- capture.output(compared)
  expect_lte(max(nchar(text)), 90)
  expect_match(text[1], "a (6) and b (6); 99 random permutations", fixed = TRUE)
  expect_crestline_error(compare_quietly(list(all = data$x, few = few[, , 12:1][, , -1]),
                                         data$group), "different specimens")
})

test_that("what cannot be compared is refused", {
  data <- grouped_sample(c(3, 3))
  expect_crestline_error(compare_quietly(data$x, rep("a", 6)), "one group")
  expect_crestline_error(compare_quietly(data$x, c("a", "b", "b", "b", "b", "b")),
                         "\"a\" has one specimen")
  expect_crestline_error(compare_quietly(data$x, c("a", "b")), "2 values for 6")
  expect_crestline_error(compare_quietly(data$x, c("a", "a", "b", "b", "b", NA)), "missing for 6")
  expect_crestline_error(compare_quietly(data$x, setNames(data$group, letters[1:6])),
                         "no value for 1, 2")
  expect_crestline_error(compare_quietly(data$x, data$group, tests = "t"), "`tests`")
  expect_crestline_error(compare_quietly(data$x, data$group, components = 0), "`components`")
  expect_crestline_error(compare_quietly(data$x, data$group, permutations = diag(6)),
                         "`permutations`")
})

test_that("groups go to specimens by name, from a vector or a table, in any order", {
  data <- grouped_sample(c(3, 3))
  x <- data$x
  dimnames(x)[[3]] <- paste0("s", 1:6)
  by_name <- setNames(as.character(data$group), dimnames(x)[[3]])
  turned <- by_name[c(4, 6, 2, 1, 3, 5)]
  expected <- factor(by_name)
  group_of <- function(group) suppressWarnings(
    compare_quietly(x, group, n_perm = 19, tests = "size")$group, "crestline_few_permutations"
  )
  expect_equal(group_of(turned), expected)
  expect_equal(group_of(setNames(turned, toupper(names(turned)))), expected)
  expect_equal(group_of(data.frame(Specimen = paste0(names(turned), ".ply"), group = turned)),
               expected)
  expect_crestline_error(group_of(setNames(turned, sub("s1", "t1", names(turned)))),
                         c("no value for s1", "s1, s2", "t1"))
  expect_crestline_error(group_of(c(turned, s1 = "other")), "2 different values for s1")
  expect_crestline_error(group_of(replace(by_name, 1, " A")), "differ by blanks or case only")
  expect_crestline_error(group_of(replace(by_name, 2, " ")), "`group` is missing for s2")
  expect_message(group_of(unname(by_name)), "in the order of the specimens")
})

test_that("effects stand beside p: Cohen's d, distance less its null mean, shares, Z", {
  data <- grouped_sample(c(8, 11), effect = 0.05)
  data$x <- data$x * rep(with_seed(3, runif(19, 1, 1.4)), each = 36)
  tests <- compare_quietly(data$x, data$group, n_perm = 199, exact = 0, seed = 1)$tests
  row <- function(test) tests[tests$test == test, ]
  size <- align(data$x)$size
  first <- data$group == "a"
  pooled <- (7 * var(size[first]) + 10 * var(size[!first])) / 17
  d <- (mean(size[first]) - mean(size[!first])) / sqrt(pooled)
  expect_equal(row("size t")$effect, d, tolerance = 1e-10)
  expect_equal(row("size t")$share, summary(lm(size ~ data$group))$r.squared, tolerance = 1e-10)
  expect_true(all(tests$lower <= tests$effect & tests$effect <= tests$upper, na.rm = TRUE))
  flat <- t(matrix(align(data$x)$coords, 36))
  labels <- regroupings(data$group, 199, 0, seed = 1)$labels
  distance <- apply(labels, 2, function(code) {
    sqrt(sum((colMeans(flat[code == 1, ]) - colMeans(flat[code == 2, ]))^2))
  })
  shape <- row("mean shape")
  expect_equal(shape$effect, distance[1] - mean(distance), tolerance = 1e-8)
  share <- distance^2 * 88 / 19 / sum(sweep(flat, 2, colMeans(flat))^2)
  expect_equal(shape$z, effect_z(share / (1 - share)), tolerance = 1e-6)
})

test_that("a bootstrap draws within groups, and its interval is the normal one in large samples", {
  code <- rep(1:2, c(300, 500))
  counts <- bootstrap_counts(code, 400, 1)
  expect_equal(unique(colSums(counts[code == 1, ])), 300)
  expect_equal(dim(counts), c(800L, 400L))
  y <- with_seed(2, rnorm(800, code))
  interval <- with_interval(cohen_d(y, code), cohen_d(y, code, counts))
  se <- sqrt(1 / 300 + 1 / 500 + interval[1]^2 / 1600)
  expect_equal(diff(interval[2:3]), 2 * 1.96 * se, tolerance = 0.12)
})

test_that("components of later levels have the sides of the first level's", {
  data <- grouped_sample(c(9, 9), effect = 0.1)
  levels <- list(all = align(data$x), turned = align(data$x[12:1, , ]))
  compared <- compare_quietly(levels, data$group, n_perm = 19, seed = 1, components = 4)
  agree <- colSums(compared$pca$all$x[, 1:4] * compared$pca$turned$x[, 1:4])
  expect_true(all(agree > 0))
  table <- compared$tests[grepl("^PC", compared$tests$test), ]
  expect_equal(table$statistic[1:4], table$statistic[5:8], tolerance = 1e-6)
})

test_that("the least p-value is that of the regroupings, and one above 0.05 is told", {
  made <- grouped_sample(c(5, 5), effect = 2)
  compared <- compare_quietly(made$x, made$group, exact = 1000, tests = "shape")
  expect_equal(compared$least, 2 / choose(10, 5))
  expect_equal(compared$tests$p_value, compared$least)
  expect_output(print(compared), "all 252 regroupings, least p 0.0079")
  expect_warning(compare_quietly(made$x, made$group, n_perm = 9, exact = 0, tests = "shape"),
                 "below 0.1:", class = "crestline_few_permutations")
  few <- grouped_sample(c(2, 2))
  expect_warning(compare_quietly(few$x, few$group, tests = "size"), "below 0.33",
                 class = "crestline_few_permutations")
  # What helps: more specimens where all regroupings are used
  remedy <- function(...) rlang::catch_cnd(compare_quietly(...), "crestline_warning")$remedy
  expect_match(remedy(few$x, few$group, tests = "size"), "more specimens are needed")
  expect_no_match(remedy(few$x, few$group, tests = "size"), "n_perm")
  expect_match(remedy(made$x, made$group, n_perm = 9, exact = 0, tests = "shape"),
               "greater `n_perm`")
})

test_that("components are printed with p-values that are adjusted for their number", {
  made <- grouped_sample(c(8, 8), effect = 0.05)
  compared <- compare_quietly(made$x, made$group, n_perm = 99, components = 4, seed = 1,
                              tests = c("components", "size"))
  own <- compared$tests
  shown <- summary(compared)
  expect_equal(shown$points, own$p_adjusted[match(shown$test, own$test)])
  expect_true(any(own$p_adjusted > own$p_value))
  expect_output(print(compared), "single components: adjusted for their number")
})

test_that("the least p counts the deals that are the observed one under other names", {
  expect_equal(least_p(all_regroupings(c(1L, 1L, 2L, 2L))), 2 / 6)
  expect_equal(least_p(all_regroupings(c(1L, 1L, 2L, 2L, 2L))), 1 / 10)
  expect_equal(least_p(all_regroupings(rep(1:3, each = 2))), 6 / 90)
})
