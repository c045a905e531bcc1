test_that("check_number() gives the number, or says what it is and what it should be", {
  expect_identical(check_number(3L, "k"), 3)
  expect_identical(check_number(0, "k", lower = 0, upper = 1), 0)
  expect_crestline_error(check_number(0, "k", lower = 0, open = TRUE), c("`k` is 0", "above 0"))
  expect_crestline_error(check_number(2, "k", lower = 0, upper = 1), c("`k` is 2", "at least 0 and of at most 1"))
  expect_crestline_error(check_number(Inf, "k"), "`k` is Inf")
  expect_crestline_error(check_number(NaN, "k"), "`k` is NaN")
  expect_crestline_error(check_number("a", "k"), "`k` is a")
  expect_crestline_error(check_number(NULL, "k"), "`k` is NULL")
  expect_crestline_error(check_number(1:9, "k"), "1, 2, 3, ... (9 values)")
  expect_crestline_error(check_number(list(1), "k"), "of class list")
})

test_that("check_count() wants whole numbers", {
  expect_identical(check_count(4, "n"), 4L)
  expect_crestline_error(check_count(1.5, "n"), c("`n` is 1.5", "whole number"))
  expect_crestline_error(check_count(1, "n", lower = 2), "at least 2")
})

test_that("check_choice() takes the first of several, and names the choices", {
  expect_identical(check_choice(c("b", "a"), c("a", "b"), "x"), "b")
  expect_crestline_error(check_choice("c", c("a", "b"), "x"), c("`x` is c", "\"a\", \"b\""))
  expect_crestline_error(check_choice(1, c("a", "b"), "x"), "`x` is 1")
  expect_crestline_error(check_choice(character(), "a", "x"), "`x` is empty")
})

test_that("check_class() names the maker", {
  expect_invisible(check_class(structure(1, class = "thing"), "thing", "x", "thing()"))
  expect_crestline_error(check_class(1, "thing", "x", "thing()"), c("not of class \"thing\"", "thing()"))
})

test_that("errors of the checkers blame the caller", {
  asked <- function(k) check_number(k, "k")
  error <- expect_crestline_error(asked("a"))
  expect_identical(as.character(error$call[[1]]), "asked")
})
