# Centile curves.

test_that("the centile curve of a person's own centile goes through the person's value", {
  norms <- small_norms()
  found <- suppressWarnings(assess(small_patient(), norms, age = 10, sex = "female"))
  values <- found$values[!startsWith(found$values$name, "component "), ]
  for (i in seq_len(nrow(values))) {
    back <- centile_values(norms, i, 10, "female", values$centile[i] / 100)
    expect_equal(back[1, 1, 1], values$value[i], tolerance = 1e-8)
  }
})

test_that("the transformation of a skew column is undone", {
  skew <- data.frame(skew_1 = 0.1, skew_2 = 0.9, skew_3 = 0.4, skew_4 = 1.2)
  z <- c(-2, 0, 1.5)
  expect_equal(as.vector(bent_back(straightened(matrix(z), skew), skew)), z)
  expect_equal(bent_back(1.3, data.frame(skew_1 = NA_real_)), 1.3)
})

test_that("curves are in order, and NA where too few people are effective", {
  chart <- growth_chart(small_norms(), "female", steps = 5)
  size <- matrix(chart$value[chart$name == "size"], 5)
  expect_equal(dim(size), c(5, 5))
  expect_true(all(diff(t(size)) > 0, na.rm = TRUE))
  few <- small_norms()
  few$settings$least <- 1e6
  expect_true(all(is.na(growth_chart(few, "female")$value)))
})

test_that("units are those of the kinds; those of the face are mm", {
  norms <- small_norms()
  unit <- value_units(norms)
  expect_equal(unit[1], "unit")
  expect_true(all(unit[startsWith(norms$table$name, "component ")] == "1"))
  own <- match(norms$measurements$measurement[norms$measurements$kind == "ratio"],
               norms$table$name)
  expect_true(all(unit[own] == "1"))
  expect_equal(length_unit(scheme_hash(face_scheme())), "mm")
})
