# Errors from repeated scans.

repeated <- function(n, ..., seed = 3) {
  people <- data.frame(age = rep(20, n), sex = "female")
  made <- simulate_cohort(n, data = people, template = small_template(), visits = 2, seed = seed,
                          settings = cohort_settings(...))
  visit_errors(c(as.list(made$sample), as.list(made$second)), rep(names(made$sample), 2))
}

test_that("the standard error of repeats is that of the simulated noise", {
  free <- repeated(60, noise = 0.3)
  surface <- free$points$se[free$points$level == "surface"]
  # Laying on each other takes six of 3 x 35 parts.
  expect_equal(sqrt(mean(surface^2)), 0.3 * sqrt(1 - 6 / 105), tolerance = 0.05)
  expect_lt(free$share, 0.3)
  marks <- free$points$se[free$points$level == "landmarks"]
  expect_equal(sqrt(mean(marks^2)), 0.3, tolerance = 0.2)
  expect_equal(free$counts, c(persons = 60, shapes = 120, df = 60))
  few <- repeated(3, noise = 0.3)
  own <- few$points[few$points$level == "surface", ]
  expect_lte(length(unique(own$se)), length(unique(own$part)))
})

test_that("share and range of the correlation are found", {
  xyz <- as.matrix(expand.grid(x = 1:12, y = 1:12, z = 0)) * 4
  distance <- as.matrix(stats::dist(xyz))
  root <- chol(0.6 * exp(-distance^2 / (2 * 8^2)) + diag(0.4, 144))
  e <- with_seed(2, matrix(stats::rnorm(144 * 200), 200)) %*% root
  normal <- matrix(c(0, 0, 1), 144, 3, byrow = TRUE)
  fit <- function(e, normal) {
    error_correlation(e, rep(1, 144), rep(200, 144), xyz, normal, repeat_settings())
  }
  found <- fit(e, normal)
  expect_equal(found$share, 0.6, tolerance = 0.1)
  expect_equal(found$range, 8, tolerance = 0.15)
  none <- with_seed(4, matrix(stats::rnorm(144 * 200), 200))
  expect_lt(fit(none, normal)$share, 0.05)
  # Of normals that turn, the errors of co-ordinates go together by more than those along them.
  turn <- xyz[, 1] / 20
  bent <- cbind(sin(turn), 0, cos(turn))
  along <- Reduce(`+`, lapply(c(1, 3), function(d) {
    with_seed(d, matrix(stats::rnorm(144 * 200), 200)) %*% root * rep(bent[, d], each = 200)
  }))
  expect_equal(fit(along, bent)$share, 0.6, tolerance = 0.12)
  expect_equal(fit(along, bent)$range, 8, tolerance = 0.2)
})

test_that("visits are compared with the errors of repeats, and wrong ones are refused", {
  errors <- repeated(40, noise = 0.2)
  shape <- small_patient()
  found <- suppressWarnings(compare_visits(shape, small_patient(seed = 6), error = errors))
  own <- errors$points[errors$points$level != "landmarks", ]
  # Laying on each other takes up a little.
  expect_equal(found$points$se, sqrt(2) * own$se, tolerance = 0.1)
  strange <- errors
  strange$hash <- "another"
  expect_crestline_error(compare_visits(shape, shape, error = strange), "another scheme")
  expect_crestline_error(visit_errors(list(shape)), "twice")
  expect_crestline_error(visit_errors(list(shape, shape), c("a", "b")), "twice")
})

test_that("variances of few repeats are drawn together, as much as they are alike", {
  # The means of variances that chance alone makes differ, and of such as differ by themselves
  df <- rep(6, 400)
  alike <- 0.04 * with_seed(1, stats::rchisq(400, 6)) / 6
  found <- prior_variance(alike, df)
  expect_equal(found$variance, 0.04, tolerance = 0.05)
  expect_gt(found$df, 60)
  true <- 0.04 * 10 / with_seed(2, stats::rchisq(400, 10))
  found <- prior_variance(true * with_seed(3, stats::rchisq(400, 6)) / 6, df)
  expect_equal(found$df, 10, tolerance = 0.35)
  expect_equal(found$variance, 0.04, tolerance = 0.1)
  expect_identical(prior_variance(alike[1:2], df[1:2]), list(variance = 0, df = 0))
  # Differences that are hardly more than chance need no number that no computer has
  half <- rep(3, 3)
  off <- c(-1, 0, 1) * sqrt(mean(trigamma(half)) + 1e-12)
  expect_identical(prior_variance(exp(off + digamma(half) - log(half)), 2 * half)$df, Inf)
  few <- repeated(3, noise = 0.3)
  surface <- few$points[few$points$level == "surface", ]
  expect_true(all(surface$df > 3))
  expect_lt(diff(range(surface$se)), 0.15)
  expect_equal(unique(repeated(40, noise = 0.3)$points$df), 40)
})

test_that("a change is judged by the degrees of freedom of its error", {
  expect_equal(normal_score(c(-3, 2, 0), c(5, Inf, 4)),
               c(stats::qnorm(stats::pt(-3, 5)), 2, 0))
  expect_equal(normal_score(60, 3), -stats::qnorm(stats::pt(-60, 3)))
  expect_identical(normal_score(NA_real_, 3), NA_real_)
})
