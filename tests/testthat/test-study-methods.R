# When two methods of a study are the same.

same <- function(a, b) identical(content_hash(value_print(a)), content_hash(value_print(b)))

test_that("functions are told apart by what they close over", {
  made <- function(k) function(x) x + k
  expect_true(same(made(1), made(1)))
  expect_false(same(made(1), made(2)))
  deep <- function(k) {
    helper <- function(x) x * k
    function(x) helper(x)
  }
  expect_true(same(deep(1), deep(1)))
  expect_false(same(deep(1), deep(2)))
  expect_false(same(function(x) x + 1, function(x) x + 2))
  expect_false(same(function(x = 1) x, function(x = 2) x))
  expect_true(same(function(x, ...) x, function(x, ...) x))
  # What is looked up by a text, and functions in lists and environments.
  named <- function(k) function(x) get("k")
  expect_false(same(named(1), named(2)))
  expect_false(same(list(a = made(1)), list(a = made(2))))
  boxed <- function(k) {
    box <- new.env()
    box$k <- k
    function(x) box$k
  }
  expect_false(same(boxed(1), boxed(2)))
  expect_true(same(stats::median, stats::median))
  expect_false(same(stats::median, base::mean))
})

test_that("what a function uses of the workspace counts, and nothing else of it", {
  work <- globalenv()
  kept <- mget(c("crestline_test_k", "crestline_test_other"), work, ifnotfound = list(NULL))
  on.exit(rm(list = c("crestline_test_k", "crestline_test_other"), envir = work))
  assign("crestline_test_k", 1, work)
  assign("crestline_test_other", 1, work)
  method <- eval(quote(function(x) x + crestline_test_k), work)
  first <- content_hash(value_print(method))
  assign("crestline_test_other", 2, work)
  expect_identical(content_hash(value_print(method)), first)
  assign("crestline_test_k", 2, work)
  expect_false(identical(content_hash(value_print(method)), first))
})

test_that("environments that hold each other are looked at once", {
  box <- new.env()
  box$own <- box
  box$f <- function(x) box
  expect_true(same(box$f, box$f))
  expect_true(same(ridge_settings(), ridge_settings()))
  expect_false(same(ridge_settings(), ridge_settings("paper")))
})
