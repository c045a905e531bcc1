test_that("the presets are those of the measurements and of the paper", {
  ours <- ridge_settings()
  expect_s3_class(ours, "ridge_settings")
  expect_identical(attr(ours, "preset"), "crestline")
  expect_equal(
    unlist(ours[c("df", "lambda", "window", "anisotropy", "grid", "cap", "longest", "inflation")]),
               c(df = 20, lambda = 1e-4, window = 1.5, anisotropy = 10, grid = 41, cap = 2,
                 longest = 1.25, inflation = 1.5))
  expect_identical(ours$strength, "across")
  paper <- ridge_settings("paper")
  expect_equal(paper$df, 12)
  expect_equal(paper$lambda, 0.5)
  expect_identical(paper[c("strength", "wrong_sign", "order", "lambda_scale")],
                   list(strength = "principal", wrong_sign = "drop", order = "forced",
                        lambda_scale = "grid"))
  expect_setequal(names(paper), names(ours))
})

test_that("single settings change by name", {
  changed <- ridge_settings("paper", df = 25, error = FALSE)
  expect_equal(changed$df, 25)
  expect_false(changed$error)
  expect_equal(changed$lambda, 0.5)
})

test_that("what is no setting, or no value of one, is refused", {
  expect_crestline_error(ridge_settings(degrees = 3), c("degrees", "Settings are", "df"))
  expect_crestline_error(ridge_settings("crestline", 3), "no setting")
  expect_crestline_error(ridge_settings("ours"), c("ours", "paper"))
  expect_crestline_error(ridge_settings(lambda = -1), "`lambda`")
  expect_crestline_error(ridge_settings(df = 3), c("`df`", "between 4 and 100"))
  expect_crestline_error(ridge_settings(df = 100), "`df`")
  expect_crestline_error(ridge_settings(basis = 10), "`basis`")
  expect_crestline_error(ridge_settings(basis = c(10, 4)), "`basis`")
  expect_crestline_error(ridge_settings(grid = 4), "`grid`")
  expect_crestline_error(ridge_settings(strength = "along"), "`strength`")
  expect_crestline_error(ridge_settings(wrong_sign = "keep"), "`wrong_sign`")
  expect_crestline_error(ridge_settings(lambda_scale = "mm"), "`lambda_scale`")
  expect_crestline_error(ridge_settings(window = NA), "`window`")
  expect_identical(ridge_settings(window = Inf)$window, Inf)
})

test_that("settings print their preset and values", {
  expect_output(print(ridge_settings("paper")), "preset \"paper\"")
  expect_output(print(ridge_settings(df = 33)), "df = 33")
})
