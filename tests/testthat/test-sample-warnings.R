# What was warned of: heard, kept, told by kind.

test_that("warnings of any package are heard and go no further", {
  ear <- new_ear()
  told <- 0
  value <- withCallingHandlers(
    hear({
      crestline_warn("a thing is odd.", "Mend it.", "landmarks", "x", class = "crestline_odd")
      warning("something else")
      7
    }, "reading", ear),
    warning = function(w) told <<- told + 1
  )
  expect_identical(value, 7)
  expect_identical(told, 0)
  expect_identical(ear$heard, data.frame(stage = c("landmarks", "reading"),
                                         class = c("crestline_odd", "simpleWarning"),
                                         problem = c("a thing is odd.",
                                                     "something else"), remedy = c("Mend it.", "")))
})

test_that("warnings are told in one line a kind, with the ids", {
  odd <- function(id, problem, class) data.frame(id = id, stage = "s", class = class,
                                                 problem = problem, remedy = "Mend it.")
  warnings <- rbind(odd("a", "mirrored.", "crestline_mirrored"),
                    odd("b", "mirrored.", "crestline_mirrored"),
                    odd("a", "3 of 4 are off.", "crestline_warning"),
                    odd("c", "2 of 4 are off.", "crestline_warning"),
                    odd("c", "a hole.", "crestline_warning"))
  expect_identical(warning_lines(warnings), c("2 specimens: mirrored. Mend it. In: a, b.",
                                              "2 specimens: 3 of 4 are off. (a) Mend it. In: a, c.",
                                              "1 specimen: a hole. Mend it. In: c."))
  expect_identical(warning_lines(warnings[0, ]), character())
})

test_that("warnings are had of a shape and of a list of them", {
  shape <- quad_shape(edge_scheme())
  none <- warnings_of(shape)
  expect_identical(dim(none), c(0L, 5L))
  shape$warnings <- data.frame(stage = "s", class = "c", problem = "p", remedy = "r")
  expect_identical(warnings_of(list(shape, NULL)),
                   data.frame(id = "quad", stage = "s", class = "c", problem = "p", remedy = "r"))
  expect_crestline_error(warnings_of(1), "shape")
})
