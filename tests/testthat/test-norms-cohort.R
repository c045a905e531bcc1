# Simulated cohorts: their truth.

test_that("the mean of many faces is the expected face, and their spread is as set", {
  template <- symmetrise(argument_objects()$shapes[[1]])
  people <- data.frame(age = rep(12, 400), sex = rep(c("female", "male"), each = 200))
  settings <- cohort_settings(turn = 0, shift = 0, noise = 0, skew = 0)
  cohort <- simulate_cohort(400, data = people, template = template, settings = settings, seed = 1)
  own <- sapply(cohort$sample, function(shape) places_of(shape) / 1)
  for (sex in c("female", "male")) {
    expected <- cohort$expected(12, sex)
    chosen <- cohort$data$sex == sex
    expect_lt(max(abs(rowMeans(own[, chosen]) - as.vector(expected))), 1)
  }
  model <- cohort_model(template, settings)
  sd <- sqrt(sum(settings$variation$sd^2)) * shape_spread(12, FALSE)
  shape <- own[, 1:200] / rep(cohort$data$size[1:200], each = nrow(own))
  off_middle <- rep(abs(model$places[, 1]) > 20, 3)
  expect_equal(mean(apply(shape[off_middle, ], 1, stats::sd)), sd, tolerance = 0.1)
  expect_equal(stats::sd(log(cohort$data$size[1:200])), 0.03 * (1 + 1 / 6), tolerance = 0.15)
})

test_that("a lesion is where and as high as it is said", {
  template <- symmetrise(argument_objects()$shapes[[1]])
  settings <- cohort_settings(turn = 0, shift = 0)
  point <- rownames(coords(template, "surface"))[18]
  draw <- function(lesions, ...) {
    simulate_cohort(3, lesions = lesions, template = template, settings = settings, seed = 4, ...)
  }
  plain <- draw(NULL)
  with <- draw(data.frame(height = 3, radius = 15, point = point))
  step <- coords(with$sample[[2]], "surface") - coords(plain$sample[[2]], "surface")
  distance <- as.vector(as.matrix(stats::dist(coords(template, "surface")))[18, ])
  expect_equal(sqrt(rowSums(step^2)), 3 * (1 - pmin(distance / 15, 1)^2)^3,
               ignore_attr = TRUE, tolerance = 1e-6)
  expect_identical(with$lesions$point, rep(point, 3))
  late <- draw(data.frame(height = 3, radius = 15, point = point, visit = 2), visits = 2)
  expect_equal(coords(late$sample[[1]]), coords(plain$sample[[1]]))
  expect_gt(max(abs(coords(late$second[[1]], "surface") - coords(late$sample[[1]], "surface"))), 2)
})

test_that("faces grow, are measured with error, and lose points in holes", {
  template <- symmetrise(argument_objects()$shapes[[1]])
  size <- mean_size
  expect_gt(size(20, TRUE), size(20, FALSE))
  expect_gt(size(13, FALSE) / size(11, FALSE), size(13, TRUE) / size(11, TRUE))
  people <- data.frame(age = 10, sex = "female")
  same <- function(...) {
    simulate_cohort(1, data = people, template = template, seed = 2,
                    settings = cohort_settings(turn = 0, shift = 0, ...))$sample[[1]]
  }
  error <- places_of(same()) - places_of(same(noise = 0))
  expect_equal(stats::sd(error), 0.1, tolerance = 0.2)
  expect_equal(unique(same()$points$se), 0.1)
  holed <- same(holes = 1, hole_radius = 15)
  expect_true(anyNA(holed$points$x) && !all(is.na(holed$points$x)))
  expect_true(all(is.na(holed$points$se[is.na(holed$points$x)])))
})

test_that("a cohort says that it is simulated, and refuses what it cannot draw", {
  template <- symmetrise(argument_objects()$shapes[[1]])
  cohort <- simulate_cohort(4, template = template, seed = 1)
  expect_match(utils::capture.output(print(cohort))[1], "simulated.*no data of people")
  expect_s3_class(validate(cohort$sample), "shape_sample")
  expect_identical(cohort$data, simulate_cohort(4, template = template, seed = 1)$data)
  expect_crestline_error(simulate_cohort(2, data = data.frame(age = 1), template = template),
                         "`data`")
  expect_crestline_error(simulate_cohort(2, lesions = data.frame(height = 1), template = template),
                         "`radius`")
  expect_crestline_error(cohort_settings(symmetric = 2), "symmetric")
})
