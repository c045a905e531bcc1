test_that("members are found by name, number and logical value, and by nothing else", {
  ids <- c("b", "a", "c")
  chosen <- function(i) chosen_members(i, ids, "the sample")
  expect_identical(chosen(c("c", "b")), c(3L, 1L))
  expect_identical(chosen(c(3, 1)), c(3L, 1L))
  expect_identical(chosen(-2), c(1L, 3L))
  expect_identical(chosen(c(0, 2)), 2L)
  expect_identical(chosen(c(TRUE, FALSE, TRUE)), c(1L, 3L))
  expect_identical(chosen(c(c = TRUE, b = FALSE, a = TRUE)), c(2L, 3L))
  expect_identical(chosen(factor("a")), 2L)
  expect_identical(chosen(character()), integer())
  for (i in list(NULL, list(1), NA, NA_character_, 4, -4, Inf, 0.5, c(1, 1), c("a", "a"), TRUE[0],
                 "d", 1i)) {
    expect_crestline_error(chosen(i))
  }
})

test_that("near names come first in what is there, and one member is one", {
  error <- expect_crestline_error(one_member("C", c("b", "a", "c"), "the sample"))
  expect_match(error$remedy, "There are 3: c, ")
  expect_identical(one_member("a", c("b", "a"), "the sample"), 2L)
  for (i in list(NULL, 1:2, 0, -1, TRUE, NA, "", list("a"))) {
    expect_crestline_error(one_member(i, c("b", "a"), "the sample"))
  }
  expect_match(expect_crestline_error(one_member(1, character(), "the sample"))$remedy,
               "There is none")
})
