test_that("presets differ where the paper does", {
  paper <- slide_settings("paper")
  expect_equal(paper[c("energy", "nugget", "strain", "cut_ends", "surface", "surface_energy")],
               list(energy = "own", nugget = 0, strain = 0, cut_ends = "stay", surface = "transect",
                     surface_energy = "patch"))
  expect_equal(slide_settings(strain = 2)$strain, 2)
  expect_output(print(slide_settings()), "nugget = 0.35")
})

test_that("settings are checked by name and value", {
  expect_crestline_error(slide_settings(stiffness = 1), c("stiffness", "strain"))
  expect_crestline_error(slide_settings("paper", 3), "no setting")
  expect_crestline_error(slide_settings(nugget = -1), "nugget")
  expect_crestline_error(slide_settings(gap = 0.7), "gap")
  expect_crestline_error(slide_settings(surface = "plane"), c("mesh", "transect"))
  expect_crestline_error(slide_settings(sweeps = 0), "sweeps")
})
