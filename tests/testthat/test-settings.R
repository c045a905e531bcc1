# A maker of settings of three fields, one of them with a former name.
some_settings <- function(preset = "ours", ..., size = 1, whole = 2, part = 3) {
  new_settings("some_settings", function(settings) {
    check_number(settings$size, "size", lower = 0)
    settings
  }, list(...), if (preset == "theirs") list(size = 10, whole = 20), c(old = "part"))
}

test_that("a field is what the call gives, else what the preset says, else its default", {
  expect_identical(some_settings(), structure(list(size = 1, whole = 2, part = 3),
                                              class = "some_settings"))
  expect_identical(unclass(some_settings("theirs")), list(size = 10, whole = 20, part = 3))
  expect_identical(unclass(some_settings("theirs", size = 1)), list(size = 1, whole = 20, part = 3))
  by_another <- function(...) some_settings("theirs", ...)
  expect_identical(by_another(whole = 2)$whole, 2)
  nothing <- new_settings("none", identity, fn = function(a = NULL) NULL,
                          frame = (function(a = NULL) environment())())
  expect_identical(unclass(nothing), list(a = NULL))
})

test_that("no field is taken for another, former names work with a message", {
  expect_crestline_error(some_settings(siz = 2), c("\"siz\"", "size, whole, part"))
  expect_crestline_error(some_settings("ours", 5), c("no setting without a name"))
  expect_crestline_error(some_settings(size = -1), "`size`")
  rlang::reset_message_verbosity("crestline: old =")
  expect_message(former <- some_settings(old = 4), "part =", class = "crestline_deprecated")
  expect_identical(former, some_settings(part = 4))
})

test_that("settings print as they are written in a call", {
  printed <- utils::capture.output(print_settings(
    structure(list(a = 0.25, b = c(40, 10), c = "x y"), class = "some_settings"),
    "<some_settings> of a test"
  ))
  expect_identical(printed, c("<some_settings> of a test",
                              "  a = 0.25, b = c(40, 10), c = \"x y\""))
})

test_that("fields are arguments of every maker of settings, so that editors complete them", {
  presets <- list(ridge_settings(), slide_settings(), find_settings(), path_settings(),
                  quality_limits(), scan_settings(), align_settings(), comparison_settings(),
                  model_settings(), curve_route(), shape_settings(), refine_settings(),
                  population_settings(), study_settings(), review_settings())
  for (one in presets) {
    maker <- getExportedValue("crestline", class(one)[1])
    expect_identical(setdiff(names(formals(maker)), c("preset", "...")), names(one))
    expect_crestline_error(maker(no_such_field = 1), "no_such_field")
  }
})

test_that("a setting may be NULL, a list or many numbers; it prints in few words", {
  settings <- comparison_settings(weights = NULL, permutations = list(1:3, 3:1))
  expect_null(settings$weights)
  expect_named(settings, names(comparison_settings()))
  printed <- paste(utils::capture.output(print(settings)), collapse = " ")
  expect_match(printed, "weights = NULL")
  expect_match(printed, "permutations = <")
})

test_that("former arguments of comparisons and models work with a message, and give the same", {
  set.seed(1)
  x <- array(rnorm(4 * 3 * 12), c(4, 3, 12))
  group <- rep(1:2, 6)
  rlang::reset_message_verbosity("crestline: tests =")
  expect_message(
    former <- compare_groups(x, group, n_perm = 19, seed = 1, tests = "size", progress = FALSE),
    "settings = comparison_settings(tests = )", fixed = TRUE, class = "crestline_deprecated"
  )
  today <- compare_groups(x, group, n_perm = 19, seed = 1, progress = FALSE,
                          settings = comparison_settings(tests = "size"))
  expect_identical(former$tests, today$tests)
  expect_crestline_error(compare_groups(x, group, "points", 19, 4), "`block`")
  rlang::reset_message_verbosity("crestline: ss =")
  data <- data.frame(id = 1:12, age = 1:12)
  dimnames(x) <- list(NULL, NULL, 1:12)
  expect_message(
    former <- shape_lm(x, ~ age, data, n_perm = 19, seed = 1, ss = "II", progress = FALSE),
    "settings = model_settings(ss = )", fixed = TRUE
  )
  expect_identical(former$ss, "II")
  rlang::reset_message_verbosity("crestline: bridge =")
  expect_message(former <- fit_shape(quad_specimen(), quad_scheme(), bridge = 0, progress = FALSE),
                 "measuring = shape_settings(bridge = )", fixed = TRUE)
  expect_identical(former$provenance$settings$fit$bridge, 0)
  expect_crestline_error(fit_shape(quad_specimen(), quad_scheme(), brigde = 0),
                         c("brigde", "bridge"))
  rlang::reset_message_verbosity("crestline: rounds =")
  expect_message(align(x, rounds = 300), "settings = align_settings(rounds = )", fixed = TRUE)
})
