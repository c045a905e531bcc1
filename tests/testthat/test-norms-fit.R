# Norms of a small cohort: what they hold, and what is refused.

test_that("a norm has the sizes that it says, and no face", {
  norms <- small_norms()
  expect_s3_class(norms, "shape_norms")
  expect_equal(nrow(norms$points), 35)
  expect_identical(norms$table$name[1:2], c("size", "width"))
  expect_equal(sum(norms$counts$n), 120)
  expect_equal(norms$points$se_norm, rep(0.1, 35), tolerance = 0.05)
  # Nothing in it has as many rows as there are people.
  lengths_of <- function(x) if (is.list(x)) unlist(lapply(x, lengths_of)) else NROW(x)
  expect_false(120 %in% lengths_of(unclass(norms)[names(norms) != "cache"]))
  expect_match(utils::capture.output(print(norms))[1], "<shape_norms> balls: 120 faces")
  expect_output(print(summary(norms)), "sex")
})

# The same faces, each changed by a function of its points (k x 3) and its number.
changed_faces <- function(sample, change, larger = 1) {
  made <- unclass(sample)
  made[] <- unname(lapply(seq_along(made), function(i) {
    shape <- made[[i]]
    shape$points[c("x", "y", "z")] <- as.data.frame(change(point_columns(shape), i))
    shape$points$se <- larger * shape$points$se
    shape
  }))
  structure(made, class = class(sample))
}

test_that("fits do not depend on the session, nor on pose and order of the faces", {
  cohort <- small_cohort(60)
  # Faces of one age: which fold they are in must not go by their order
  cohort$data$age <- pmin(15, pmax(5, round(cohort$data$age)))
  fit <- function(sample, data) {
    norms <- fit_norms(sample, ~ s(age, by = sex), data, table = ball_measurements(),
                       settings = small_settings(), progress = FALSE)
    unclass(norms)[names(norms) != "cache"]
  }
  a <- fit(cohort$sample, cohort$data)
  set.seed(99)
  expect_equal(fit(cohort$sample[60:1], cohort$data[sample(60), ]), a, tolerance = 1e-12)
  turned <- changed_faces(cohort$sample, function(xyz, i) {
    sweep(xyz %*% rotation_about(c(i / 9, 1, -i / 20)), 2, c(i, -5, 3), `+`)
  })
  expect_gt(abs(turned[[2]]$points$x[1] - cohort$sample[[2]]$points$x[1]), 1)
  b <- fit(turned, cohort$data)
  # Coefficients are rounded, so that the last digit of one in a thousand may differ.
  expect_equal(b$points, a$points, tolerance = 1e-4)
  expect_equal(b$table, a$table, tolerance = 1e-2)
  expect_equal(b$limits, a$limits, tolerance = 1e-2)
  expect_equal(b$surface$kernel, a$surface$kernel, tolerance = 1e-2)
})

test_that("a norm in another unit gives the same z, and settings of another unit are refused", {
  cohort <- small_cohort(60)
  shape <- small_patient()
  looked <- function(by, settings) {
    larger <- changed_faces(cohort$sample, function(xyz, i) by * xyz, by)
    norms <- fit_norms(larger, ~ s(age, by = sex), cohort$data, settings = settings,
                       progress = FALSE)
    shape$points[c("x", "y", "z")] <- as.data.frame(by * point_columns(shape))
    shape$points$se <- by * shape$points$se
    suppressWarnings(assess(shape, norms, 10, "female"))
  }
  plain <- looked(1, small_settings())
  settings <- small_settings()
  for (name in c("radii", "ranges", "bins", "unit")) settings[[name]] <- settings[[name]] / 1000
  metres <- looked(1 / 1000, settings)
  scores <- c("z_map", "z_scan", "z_asymmetry", "d2")
  expect_equal(metres$points[scores], plain$points[scores], tolerance = 5e-3)
  expect_equal(metres$limits, plain$limits, tolerance = 5e-3)
  expect_equal(1000 * metres$points$distance, plain$points$distance, tolerance = 5e-3)
  expect_crestline_error(looked(1 / 1000, small_settings()), c("radii of 12, 18", "0.018", "unit"))
  expect_crestline_error(looked(1e5, small_settings()), c("radii of 12, 18", "unit"))
})

test_that("held-out faces of a new cohort are beyond limits as often as the level says", {
  norms <- small_norms()
  fresh <- small_cohort(90, seed = 8)
  range <- norms$ages[match(fresh$data$sex, norms$ages$sex), ]
  inside <- fresh$data$age > range$from & fresh$data$age < range$to &
    effective_faces(norms, fresh$data$age, fresh$data$sex) > 10
  verdicts <- lapply(which(inside), function(i) {
    suppressWarnings(assess(fresh$sample[[i]], norms, fresh$data$age[i], fresh$data$sex[i]))
  })
  p <- sapply(verdicts, function(one) one$verdicts$p)
  rownames(p) <- verdicts[[1]]$verdicts$family
  rate <- rowMeans(p <= 0.05)
  expect_true(all(rate < 0.16), label = toString(round(rate, 3)))
  z <- sapply(verdicts, function(one) one$values$z)
  expect_equal(mean(abs(z) <= 1.96), 0.95, tolerance = 0.025)
})

test_that("p is 1 - level at a quantile, falls, and goes on beyond the last", {
  quantiles <- c(1, 1.5, 2, 2.3, 2.6, 3)
  expect_equal(tail_p(quantiles, quantiles), 1 - limit_levels())
  grid <- tail_p(seq(0, 6, 0.1), quantiles)
  expect_true(all(diff(grid) < 0))
  expect_equal(grid[1], 1)
})

test_that("skew values are made normal", {
  z <- with_seed(1, as.vector(scale(stats::rgamma(2000, 2))))
  skew <- skew_table(cbind(z, with_seed(2, stats::rnorm(2000))))
  expect_false(is.na(skew$skew_1[1]))
  expect_true(is.na(skew$skew_1[2]))
  # A skewness of 0.2 alone puts 0.031 beyond 1.96 above.
  mild <- with_seed(3, as.vector(scale(stats::rgamma(2000, 100))))
  expect_false(is.na(skew_table(cbind(mild))$skew_1))
  straight <- straightened(cbind(z, 0), skew)[, 1]
  expect_equal(c(mean(straight > 1.96), mean(straight < -1.96)), c(0.025, 0.025), tolerance = 0.5)
  expect_lt(mean(z < -1.96), 0.005)
  expect_true(all(diff(straight[order(z)]) > 0))
})

test_that("rules of privacy are kept", {
  cohort <- small_cohort(60)
  share <- function(...) {
    fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data, share = TRUE, progress = FALSE, ...)
  }
  expect_crestline_error(share(settings = small_settings()), c("3 components", "at most 1"))
  few <- small_settings()
  few$components <- 1L
  expect_crestline_error(share(settings = few), c("lone person", "least 5", "person "))
  counts <- data.frame(sex = "f", from = 3:8, to = 4:9, n = c(6, 1, 2, 3, 7, 2))
  merged <- merged_counts(counts)
  expect_true(all(merged$n >= 5) && sum(merged$n) == 21)
  expect_equal(merged$to[-nrow(merged)], merged$from[-1])
  figures <- privacy_figures(data.frame(components = rep(c(8, 2), c(3, 2)), member = 1:5,
                                        stranger = c(4, 5, 6, 3, 6)))
  expect_equal(figures$components, c(8, 2))
  expect_equal(figures$auc, c(1, 0.5))
  expect_equal(figures$ratio, sqrt(c(14 / 77, 41 / 45)), tolerance = 1e-3)
})

test_that("a person who is in a sample many times is seen", {
  y <- with_seed(1, matrix(stats::rnorm(40 * 90), 40))
  expect_gt(closest_faces(y)$ratio, 0.5)
  expect_null(check_copies(closest_faces(y), paste0("f", 1:40)))
  copied <- y[c(1:40, rep(7, 100), 9), ] + with_seed(2, stats::rnorm(141 * 90, 0, 0.05))
  found <- closest_faces(copied)
  expect_lt(found$ratio, 0.1)
  expect_crestline_error(check_copies(found, paste0("f", 1:141)), c("copies", "f41", "and 91 more"))
  # The same in another unit
  expect_equal(closest_faces(1e8 * copied)$ratio, found$ratio)
})

test_that("ages between those of the faces count in the rule of ages", {
  norms <- small_norms()
  norms$ages[c("from", "to")] <- list(9, 11)
  least <- min(effective_faces(norms, seq(9, 11, 0.1), rep("female", 21)),
               effective_faces(norms, seq(9, 11, 0.1), rep("male", 21)))
  expect_null(check_shared_ages(norms, least - 0.01))
  expect_crestline_error(check_shared_ages(norms, least + 0.01), c("the mean is decided by", "gap"))
})

test_that("what is refused for privacy says what helps", {
  norms <- small_norms()
  norms$privacy <- list(ratio = 0.94, auc = 0.58, least = 12)
  fewer <- data.frame(components = c(20, 15, 10), ratio = c(0.94, 0.96, 0.97),
                      auc = c(0.58, 0.57, 0.55))
  expect_crestline_error(check_shared(norms, fewer), c("0.940", "components = 15", "0.960"))
  expect_crestline_error(check_shared(norms, fewer[1, ]), "do not help")
  norms$privacy$ratio <- 0.96
  expect_message(check_shared(norms), "0.960")
  norms$privacy$least <- 9
  expect_crestline_error(check_shared(norms), c("9 faces", "share = TRUE"))
})

test_that("ages of a shared norm are cut where few faces are effective", {
  norms <- small_norms()
  people <- list(age = c(5, 6, 9, 10, 12, 15), group = factor(rep("female", 6)))
  effective <- effective_faces(norms, people$age, people$group)
  least <- sort(effective)[3] - 1e-6
  own <- norms$ages$sex == "female"
  expect_message(cut <- keep_shared_ages(norms, people, least), "Ages of female cut")
  kept <- range(people$age[effective >= least])
  expect_equal(unlist(cut$ages[own, c("from", "to")]), kept, ignore_attr = TRUE)
  expect_equal(cut$ages[!own, ], norms$ages[!own, ])
  expect_equal(cut$privacy$least, sort(effective)[3], tolerance = 1e-3)
  # A sex of which no age would be left is not cut, and counts.
  people <- list(age = c(10, 9, 10, 11), group = factor(c("female", "male", "male", "male")))
  effective <- effective_faces(norms, people$age, people$group)
  least <- effective[1] + 1
  expect_gt(min(effective[-1]), least)
  both <- suppressMessages(keep_shared_ages(norms, people, least))
  expect_equal(both$ages[own, ], norms$ages[own, ])
  expect_equal(both$privacy$least, effective[1], tolerance = 1e-3)
})

test_that("what cannot be a norm is refused by name", {
  cohort <- small_cohort(60)
  fit <- function(formula = ~ s(age, by = sex), data = cohort$data, ...) {
    fit_norms(cohort$sample, formula, data, settings = small_settings(), progress = FALSE, ...)
  }
  expect_crestline_error(fit(~ age), c("`formula`", "s(age, by = sex)"))
  expect_crestline_error(fit(~ s(years)), "`years`")
  expect_crestline_error(fit_norms(cohort$sample[1:30], data = cohort$data, progress = FALSE),
                         "at least 20")
  expect_crestline_error(fit(about = list(owner = "me")), "`about`")
  expect_crestline_error(fit(table = data.frame(a = 1)), "`table`")
  expect_crestline_error(norm_settings(radii = 0), "`radii`")
  noisy <- unclass(cohort$sample)
  noisy[[3]]$points$se <- 100
  expect_crestline_error(
    fit_norms(structure(noisy, class = class(cohort$sample)), data = cohort$data,
              settings = small_settings(), progress = FALSE),
    c("size of person 03", "not larger than what its errors add")
  )
})

test_that("without an asymmetric part no side tells of the other", {
  cohort <- small_cohort(60)
  made <- norm_data(cohort$sample, NULL, 1e-3)
  made$people <- norm_people(~ s(age), cohort$data, names(cohort$sample))
  plan <- norm_plan(small_settings(), made$people)
  expect_identical(fit_parts(made, 1:60, plan)$surface$partner, made$points$partner)
  made$off <- NULL
  parts <- fit_parts(made, 1:60, plan)
  expect_null(parts$surface$partner)
  expect_equal(parts$surface$mirrored, c(0, 0))
  expect_null(parts$asymmetry)
})
