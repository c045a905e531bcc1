# What errors of points add to measurements, and how they go together.

# Mean distance between two points d apart whose co-ordinates have independent errors s: that of a
# noncentral chi distribution with three degrees of freedom (closed form).
mean_distance <- function(d, s) {
  s <- sqrt(2) * s
  s * sqrt(2 / pi) * exp(-d^2 / (2 * s^2)) + (d + s^2 / d) * (2 * stats::pnorm(d / s) - 1)
}

# Drawn errors of a polyline whose points have the error s in every direction.
drawn_length <- function(xyz, s, draws, share = 0, range = 1) {
  plan <- list(line = list(kind = "length", lines = list(seq_len(nrow(xyz)))))
  value <- measure_places(plan, array(xyz, c(dim(xyz), 1)))[, 1]
  every <- list(se = rep(s, nrow(xyz)), share = share, range = range)
  c(value = unname(value), unlist(drawn_errors(plan, xyz, value, list(every = every), draws, 1)))
}

test_that("what independent errors add to a straight line and to a circle has a closed form", {
  angle <- seq(0, 2 * pi, length.out = 61)
  lines <- list(cbind(2 * 0:60, 0, 0), cbind(20 * cos(angle), 20 * sin(angle), 0))
  for (xyz in lines) {
    d <- sqrt(sum((xyz[2, ] - xyz[1, ])^2))
    added <- function(s) 60 * (mean_distance(d, s) - d)
    for (s in c(0.2, 0.5)) {
      found <- drawn_length(xyz, s, 400)
      # Means at once and twice the variance, extrapolated to none
      expect_equal(found[["bias"]], 3 * added(s) - added(sqrt(2) * s), tolerance = 0.03)
      # To first order 2 s^2 / d a step
      expect_equal(found[["bias"]], 60 * 2 * s^2 / d, tolerance = 0.15)
    }
  }
})

test_that("less what errors add, a noisy line has the length of the true one", {
  xyz <- cbind(2 * 0:40, 3 * sin(0:40 / 6), 0)
  true <- drawn_length(xyz, 0, 1)[["value"]]
  s <- 0.5
  each <- with_seed(1, replicate(60, drawn_length(xyz + stats::rnorm(length(xyz), 0, s), s, 10)))
  expect_gt(mean(each["value", ]), 1.1 * true)
  expect_equal(mean(each["value", ] - each["bias", ]), true, tolerance = 0.015)
  # Errors that go together over the whole line add next to nothing
  expect_lt(drawn_length(xyz, s, 200, share = 1, range = 100)[["bias"]], 0.001 * true)
})

test_that("areas have it too", {
  at <- as.matrix(expand.grid(x = 0:9, y = 0:9, z = 0))
  corner <- which(at[, 1] < 9 & at[, 2] < 9)
  plan <- list(flat = list(kind = "area", triangles = cbind(
    rbind(corner, corner + 1, corner + 11), rbind(corner, corner + 11, corner + 10)
  )))
  noisy <- with_seed(2, replicate(40, {
    xyz <- at + stats::rnorm(length(at), 0, 0.1)
    value <- measure_places(plan, array(xyz, c(dim(xyz), 1)))[, 1]
    spread <- list(every = list(se = rep(0.1, 100), share = 0, range = 1))
    c(value, value - drawn_errors(plan, xyz, value, spread, 10, 1)$bias)
  }))
  expect_gt(mean(noisy[1, ]), 82)
  expect_equal(mean(noisy[2, ]), 81, tolerance = 0.005)
})

test_that("curves show whether errors are independent from point to point", {
  made <- function(range) {
    simulate_cohort(10, data = data.frame(age = rep(10, 10), sex = "female"), seed = 1,
                    template = small_template(),
                    settings = cohort_settings(noise = 1, noise_range = range))$sample$shapes
  }
  expect_equal(independent_share(made(0)), 1)
  expect_lt(independent_share(made(40)), 0.5)
  # A shape whose surface points have no errors has those of its curves, across them, alone
  shape <- made(0)[[1]]
  expect_equal(shared_errors(list(shape))$share, 0)
  shape$points$se[shape$points$level == "surface"] <- NA
  expect_null(shared_errors(list(shape)))
})

test_that("measurements() gives what errors add, in any pose", {
  shape <- small_patient(settings = cohort_settings(noise = 1))
  found <- measurements(shape, ball_measurements(), range = 0, draws = 400)
  rows <- shape$points$level == "curves" & shape$points$part %in% c("top", "bottom")
  steps <- lapply(split(which(rows), shape$points$part[rows]), function(own) {
    xyz <- as.matrix(shape$points[own, c("x", "y", "z")])
    cbind(sqrt(rowSums(diff(xyz)^2)), shape$points$se[own[-1]])
  })
  steps <- do.call(rbind, steps)
  expect_equal(found$bias[found$measurement == "arc"], sum(2 * steps[, 2]^2 / steps[, 1]),
               tolerance = 0.1)
  turned <- shape
  turned$points[c("x", "y", "z")] <- as.data.frame(
    sweep(point_columns(shape) %*% rotation_about(c(1, 2, -1)), 2, c(5, 6, 7))
  )
  expect_equal(measurements(turned, ball_measurements(), range = 0, draws = 400), found,
               tolerance = 1e-7)
  expect_true(all(is.na(measurements(shape, ball_measurements(), draws = 0)$bias)))
  bare <- shape
  bare$points$se <- NA_real_
  expect_true(all(is.na(measurements(bare, ball_measurements())$bias)))
})

test_that("a shape without points has no measurements, and that is said", {
  shape <- small_patient()
  shape$points[c("x", "y", "z")] <- NA_real_
  found <- measurements(shape, ball_measurements(), error = 0.1)
  expect_true(all(is.na(found[c("value", "se", "bias")])))
  expect_match(found$reason[1], "points are missing")
})
