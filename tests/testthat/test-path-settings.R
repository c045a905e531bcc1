test_that("search settings are checked by name and value", {
  expect_crestline_error(path_settings(far = 1), c("\"far\"", "longest"))
  expect_crestline_error(path_settings(longest = 0.9), "`longest`")
  expect_crestline_error(path_settings(angles = 2.5), "`angles`")
  expect_crestline_error(path_settings(tie = -1), "`tie`")
  expect_crestline_error(path_settings(order = "fifth"), "`order`")
  expect_crestline_error(path_settings(reach = 0), "`reach`")
  expect_identical(path_settings(longest = Inf, reach = Inf)$longest, Inf)
  expect_output(print(path_settings(rival = 0.3)), "<path_settings> of reference_path()",
                fixed = TRUE)
})

test_that("search constants as arguments of their own still work, with a message", {
  bent <- bent_ridge()
  rlang::reset_message_verbosity("crestline: longest =")
  expect_message(former <- reference_path(bent, "a", "b", "ridge", 4, longest = 1.1),
                 "path_settings(longest = )", fixed = TRUE, class = "crestline_deprecated")
  today <- reference_path(bent, "a", "b", "ridge", 4, settings = path_settings(longest = 1.1))
  expect_identical(former, today)
  expect_crestline_error(reference_path(bent, "a", "b", "plane", longst = 1),
                         c("`longst`", "longest"))
  expect_crestline_error(reference_path(bent, "a", "b", "plane", longest = 0), "`longest`")
  expect_crestline_error(reference_path(bent, "a", "b", "plane", settings = list()),
                         c("`settings`", "path_settings()"))
})
