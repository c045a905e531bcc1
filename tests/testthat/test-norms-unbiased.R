# Measurements of a norm's faces less what errors of their points add.

test_that("what is taken off a face does not depend on the others, nor on their order", {
  cohort <- small_cohort(20, settings = cohort_settings(noise = 1))
  shapes <- unname(cohort$sample$shapes)
  plan <- measurement_plan(ball_measurements(), cohort$sample$template$scheme)
  all <- unbiased_values(shapes, plan)
  expect_equal(unbiased_values(shapes[20:1], plan), all[20:1, ])
  expect_equal(unbiased_values(shapes[c(9, 4)], plan), all[c(9, 4), ])
  # Draws of faces do not go together
  expect_false(any(duplicated(vapply(c("a", "b", "A", "\u00e4"), id_seed, 0L))))
  expect_identical(id_seed(iconv("\u00e4", "UTF-8", "latin1")), id_seed("\u00e4"))
})

test_that("faces without errors among others that have some are told", {
  cohort <- small_cohort(8, settings = cohort_settings(noise = 1))
  shapes <- unname(cohort$sample$shapes)
  plan <- measurement_plan(ball_measurements(), cohort$sample$template$scheme)
  bare <- lapply(shapes, function(shape) {
    shape$points$se <- NA_real_
    shape
  })
  expect_silent(all <- unbiased_values(shapes, plan))
  expect_silent(plain <- unbiased_values(bare, plan))
  expect_gt(max(abs(all - plain)), 0.01)
  expect_warning(mixed <- unbiased_values(c(shapes[1:6], bare[7:8]), plan),
                 paste0("2 faces: ", shapes[[7]]$id, ", ", shapes[[8]]$id),
                 class = "crestline_norm_doubt")
  expect_equal(mixed, rbind(all[1:6, ], plain[7:8, ]))
})
