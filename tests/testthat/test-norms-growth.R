# Growth that is subtracted between two visits.

grown_visits <- function(gap) {
  simulate_cohort(1, data = data.frame(age = 8, sex = "female"), template = small_template(),
                  visits = 2, seed = 4, settings = cohort_settings(gap = gap))
}

test_that("growth takes most of the change of a child away, and no growth nothing", {
  made <- grown_visits(3)
  shapes <- list(made$sample[[1]], made$second[[1]])
  plain <- compare_visits(shapes[[1]], shapes[[2]], table = ball_measurements())
  grown <- suppressWarnings(compare_visits(
    shapes[[1]], shapes[[2]], table = ball_measurements(), norms = small_norms(), ages = c(8, 11),
    sex = "female"
  ))
  rms <- function(x) sqrt(mean(x$points$change[x$points$level == "surface"]^2))
  expect_lt(rms(grown), 0.5 * rms(plain))
  expect_gt(min(grown$points$se[grown$points$level == "surface"]), min(plain$points$se))
  expect_match(paste(utils::capture.output(print(grown)), collapse = " "),
               "from 8 to 11 years, expected by balls, 120 faces, subtracted")
  same <- suppressWarnings(compare_visits(
    shapes[[1]], shapes[[2]], table = ball_measurements(), norms = small_norms(), ages = c(8, 8),
    sex = "female"
  ))
  expect_equal(same$points$change, plain$points$change, tolerance = 1e-6)
  expect_equal(same$points$se_growth, numeric(nrow(same$points)))
  expect_equal(same$measurements$change, plain$measurements$change, tolerance = 1e-8)
})

test_that("a face that keeps its z is expected where it is", {
  norms <- small_norms()
  shape <- small_patient()
  grown <- suppressWarnings(expected_growth(list(before = shape), norms, c(10, 13), "female"))
  later <- shape
  later$points[c("x", "y", "z")] <- point_columns(shape) + grown$move
  # Errors grow with it, so that they add the same to size and lengths
  later$points$se <- shape$points$se * exp(grown$values$later[1] - grown$values$now[1])
  a <- suppressWarnings(assess(shape, norms, age = 10, sex = "female"))
  b <- suppressWarnings(assess(later, norms, age = 13, sex = "female"))
  expect_equal(b$values$value[1], exp(grown$values$later[1]), tolerance = 1e-8)
  # z holds the norm's own error too, which is another at the other age: some 3 % of z here
  expect_lt(abs(b$values$z[1] / a$values$z[1] - 1), 0.05)
  expect_gt(stats::cor(b$points$z_map, a$points$z_map), 0.98)
})

test_that("ages without norms, and ages beyond them, are refused", {
  shape <- small_patient()
  expect_crestline_error(compare_visits(shape, shape, ages = c(8, 9)), "`ages`")
  expect_crestline_error(suppressWarnings(
    compare_visits(shape, shape, norms = small_norms(), ages = c(8, 50), sex = "female")
  ), "range")
  expect_crestline_error(
    compare_visits(shape, shape, norms = small_norms(), ages = c(11, 9), sex = "female"),
    c("`ages`", "exchanged")
  )
  expect_crestline_error(compare_visits(shape, shape, norms = small_norms(), sex = "female"),
                         "`ages`")
})
