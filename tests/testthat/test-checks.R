test_that("check_number() gives the number, or says what it is and what it should be", {
  expect_identical(check_number(3L, "k"), 3)
  expect_identical(check_number(0, "k", lower = 0, upper = 1), 0)
  expect_crestline_error(check_number(0, "k", lower = 0, open = TRUE), c("`k` is 0", "above 0"))
  expect_crestline_error(check_number(2, "k", lower = 0, upper = 1),
                         c("`k` is 2", "at least 0 and of at most 1"))
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
  expect_crestline_error(check_class(1, "thing", "x", "thing()"),
                         c("not of class \"thing\"", "thing()"))
})

test_that("an error names the function that the user called, however deep it arose", {
  inner <- function(k) check_number(k, "k")
  asked <- function(k) inner(k)
  environment(inner) <- list2env(list(), parent = asNamespace("crestline"))
  environment(asked) <- list2env(list(inner = inner), parent = asNamespace("crestline"))
  error <- expect_crestline_error(asked("a"))
  expect_identical(as.character(error$call[[1]]), "asked")
})

test_that("flags, texts, names and choices are what they are called", {
  expect_true(check_flag(TRUE, "x"))
  for (wrong in list(NA, NULL, 1, "TRUE", c(TRUE, FALSE))) {
    expect_crestline_error(check_flag(wrong, "x"), "`x` is")
  }
  both <- function(band, legend) check_flags(band, legend)
  expect_crestline_error(both(TRUE, 1), "`legend` is 1")
  expect_identical(check_text(structure("<b>", class = "html"), "x"), "<b>")
  expect_null(check_text(NULL, "x", null = TRUE))
  expect_crestline_error(check_text(NA_character_, "x"), "`x` is NA")
  expect_crestline_error(check_names(c("a", NA), "x"), "`x`")
  expect_identical(check_choices(c("b", "b"), c("a", "b"), "x"), "b")
  expect_crestline_error(check_choices(c("b", "c"), c("a", "b"), "x"),
                         c("`x` is b, c", "\"a\", \"b\""))
})

test_that("numbers, colours, points and paths are checked as wholes", {
  expect_identical(check_numbers(1:2, "x", 2), c(1, 2))
  expect_identical(check_numbers(c(1, NA), "x", missing = TRUE), c(1, NA))
  for (wrong in list(c(1, NA), c(1, Inf), "a", numeric(), matrix(1))) {
    expect_crestline_error(check_numbers(wrong, "x"), "`x` is")
  }
  expect_identical(check_colour(c("red", "#16218C"), "x"), c("red", "#16218C"))
  expect_identical(check_colour(NA, "x", none = TRUE), NA)
  for (wrong in list("zzz", NA, -1, TRUE, NULL, list("red"), 1e10)) {
    expect_crestline_error(check_colour(wrong, "x"), "`x` is")
  }
  expect_crestline_error(check_function("mean", "x"), "Give a function")
  expect_crestline_error(check_seed(1e10), "`seed`")
  expect_identical(check_path_to_write(file.path(tempdir(), "a.HTML"), "x", "html"),
                   file.path(tempdir(), "a.HTML"))
  expect_crestline_error(check_path_to_write("a.txt", "x", "html"), "ends in .html")
  expect_crestline_error(check_path_to_write(tempdir(), "x"), "a folder")
  expect_crestline_error(check_path_to_write(file.path(tempdir(), "no", "a.html"), "x"),
                         "does not exist")
})

test_that("an object without its parts is told of", {
  expect_crestline_error(check_class(structure(list(id = "a"), class = "specimen"), "specimen", "x",
                                     "specimen()"),
                         c("damaged \"specimen\"", "`mesh`", "`landmarks`"))
  expect_crestline_error(check_list(structure(list(path = data.frame(), points = data.frame()),
                                              class = "curve"), "curve", "x",
                                    "ridge_curve()"), "the curve lacks its path")
  expect_crestline_error(check_list(data.frame(a = 1), "curve", "x", "ridge_curve()"), "`x`")
})

test_that("what is not given, and what is not known, has its name", {
  f <- function(a, b = 1, ...) {
    check_given()
    check_dots(..., known = "colour")
  }
  expect_crestline_error(f(), "`a` is not given")
  expect_null(f(1, colour = 2))
  expect_crestline_error(f(1, 2, color = 3), c("`color`", "Near names: colour"))
  expect_crestline_error(f(1, 2, 3), "place 1")
  g <- function(x, ...) f(x, ...)
  expect_crestline_error(g(), "`a` is not given")
  expect_match(rlang::catch_cnd(f())$remedy, "the help page of the function")
  expect_identical(rlang::catch_cnd(plane_path("a"))$remedy, "See ?plane_path.")
  expect_match(rlang::catch_cnd(crestline::curvature("a"))$remedy, "10, or 5 .* See [?]curvature.")
  expect_identical(describe_value(c("a", "chL")), "a, chL")
  expect_match(end_words(1, "a landmark"), "as text, such as \"1\"", fixed = TRUE)
  expect_no_match(end_words(TRUE, "a landmark"), "as text")
})
