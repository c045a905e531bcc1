test_that("an error carries its parts and reads as specimen, stage, problem, remedy", {
  error <- expect_crestline_error(crestline_abort("it broke.", "Mend it.", stage = "path",
                                                  id = "scan 7", class = "extra"))
  expect_s3_class(error, "extra")
  expect_identical(error[c("id", "stage", "problem", "remedy")],
                   list(id = "scan 7", stage = "path", problem = "it broke.", remedy = "Mend it."))
  expect_match(conditionMessage(error), "^specimen scan 7, path: it broke.\\n.*Mend it\\.$")
})

test_that("without a specimen the stage stands alone", {
  error <- expect_crestline_error(crestline_abort("it broke.", "Mend it.", stage = "path"))
  expect_match(conditionMessage(error), "^path: it broke.")
  expect_null(error$id)
})

test_that("a warning has the same parts, and code goes on", {
  warning <- expect_warning(done <- {
    crestline_warn("it creaks.", "Oil it.", stage = "path", id = "x", class = "crestline_creak")
    TRUE
  }, class = "crestline_creak")
  expect_true(done)
  expect_s3_class(warning, "crestline_warning")
  expect_identical(warning$remedy, "Oil it.")
  expect_match(conditionMessage(warning), "specimen x, path: it creaks.")
})

test_that("problems may hold braces and per cent signs", {
  error <- expect_crestline_error(crestline_abort("{x} at 5 %d", "Drop {y}.", stage = "mesh"))
  expect_match(conditionMessage(error), "{x} at 5 %d", fixed = TRUE)
})

test_that("in_context() adds specimen and doing to an error without them, keeps the rest", {
  inner <- function() {
    crestline_abort("`n` is 0.", "Give one.", stage = "arguments", class = "crestline_odd")
  }
  error <- expect_crestline_error(in_context(inner(), id = "scan 7", doing = "ridge from a to b"),
                                  c("specimen scan 7, arguments: ridge from a to b: `n` is 0.",
                                    "Give one."), id = "scan 7")
  expect_s3_class(error, "crestline_odd")
  known <- function() crestline_abort("it broke.", "Mend it.", stage = "path", id = "own")
  expect_match(conditionMessage(expect_crestline_error(in_context(known(), "other", "x"),
                                                       id = "own")),
               "^specimen own, path: it broke.")
  expect_identical(in_context(5, "other", "x"), 5)
  expect_error(in_context(stop("not ours"), "other", "x"), "^not ours$")
})

test_that("a damaged object is printed as an error of ours, a sound one as before", {
  without <- function(x, ...) tampered(x, function(fields) within_list(fields, ...))
  ball <- stretched_ball()
  for (field in c("mesh", "landmarks", "report")) {
    damaged <- do.call(without, c(list(ball), stats::setNames(list("x"), field)))
    expect_error(capture.output(print(damaged)),
                 "specimen ball, printing: the specimen cannot be printed",
                 class = "crestline_error")
  }
  shape <- quad_shape()
  expect_error(capture.output(print(without(shape, status = 1))), "the shape cannot be printed",
               class = "crestline_error")
  expect_error(capture.output(print(without(shape$scheme, curves = sum))),
               "the curve_scheme cannot be printed", class = "crestline_error")
  for (sound in list(ball, shape, shape$scheme)) capture.output(expect_invisible(print(sound)))
})
