# Pictures of an assessment.

test_that("a distance is in the unit of the assessment, z in none", {
  skip_if_not_installed("htmlwidgets")
  found <- suppressWarnings(assess(small_patient(), small_norms(), 10, "female"))
  title <- function(what, unit) {
    found$unit <- unit
    plot(found, what, engine = "widget")$drawn$bar$title
  }
  expect_match(title("map", "unit"), "z")
  expect_match(title("distance", "unit"), "unit of the mesh", fixed = TRUE)
  expect_match(title("distance", "mm"), "mm$")
  expect_match(title("healed", "mm"), "mm$")
})

test_that("what is within the limit does not fill the scale of colours", {
  skip_if_not_installed("htmlwidgets")
  found <- suppressWarnings(assess(small_patient(), small_norms(), 10, "female"))
  found$points$z_map <- found$points$z_map / 100
  last <- function(...) max(as.numeric(plot(found, ..., engine = "widget")$drawn$bar$labels))
  expect_gt(last("map"), 1)
  expect_lte(last("map"), found$limits[["map"]])
  expect_lt(last("map", limits = c(-0.1, 0.1)), 0.11)
})
