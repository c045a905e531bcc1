test_that("the noise factor of a specimen is the median of its curves', and says what it means", {
  expect_equal(specimen_noise(c(NA, 3, 4, 20)), 4)
  expect_identical(specimen_noise(NULL), NA_real_)
  expect_identical(specimen_noise(c(NA_real_, NA)), NA_real_)
  expect_match(noise_text(9),
               "noise is correlated, or its relief is fine: F = 9; standard errors are 3 times",
               fixed = TRUE)
  expect_match(noise_text(1), "independent from vertex to vertex, or known (F = 1)", fixed = TRUE)
})

test_that("shape, quality and summary give it: more under smooth noise than independent noise", {
  scheme <- curve_scheme(data.frame(landmark = c("from", "to")),
                         data.frame(curve = "crest", from = "from", to = "to", kind = "ridge",
                                    radius = 0.25, width = 0.4, n = 9))
  shapes <- lapply(c(0, 2), function(correlation) {
    suppressWarnings(fit_shape(simulate_ridge(0.25, 1, 0.05, 0.01, 1, correlation = correlation),
                               scheme, progress = FALSE))
  })
  names(shapes) <- c("rough", "smooth")
  factor <- vapply(shapes, function(shape) shape$status$noise_factor[3], 0)
  expect_lt(factor[["rough"]], 4)
  expect_gt(factor[["smooth"]], 20)
  expect_equal(vapply(shapes, function(shape) sum(is.na(shape$status$noise_factor)), 0L),
               c(rough = 2L, smooth = 2L))
  expect_output(print(shapes$smooth), "this scan's noise is correlated")
  graded <- quality(shapes)
  expect_equal(summary(graded)$noise_factor, unname(factor))
  expect_output(print(graded), "median; .* over the specimens")
  old <- shapes$rough
  old$status$noise_factor <- NULL
  expect_true(is.na(summary(quality(old))$noise_factor))
  expect_false(any(grepl("noise: ", capture.output(print(old)))))
})
