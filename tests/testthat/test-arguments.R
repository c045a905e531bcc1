# The whole table, 13,000 calls: with CRESTLINE_ARGUMENTS=all, or `Rscript tools/arguments.R`. Here
# some values of each pair.
calls <- NULL
table_of_calls <- function() {
  if (is.null(calls)) calls <<- suppressWarnings(argument_calls())
  calls
}

test_that("every exported function has an entry for each of its arguments", {
  calls <- table_of_calls()
  expect_setequal(names(calls), getNamespaceExports("crestline"))
  for (fn in names(calls)) {
    own <- setdiff(as.character(names(formals(getExportedValue("crestline", fn)))), "...")
    expect_equal(setdiff(own, names(calls[[fn]]$kinds)), character(), label = fn)
    expect_true(all(names(calls[[fn]]$kinds) %in% names(calls[[fn]]$args)))
  }
})

test_that("a wrong value of any argument is refused by its name, never by an error of R's", {
  skip_on_cran()
  calls <- table_of_calls()
  all <- identical(Sys.getenv("CRESTLINE_ARGUMENTS"), "all")
  turn <- 0
  some <- function(fn, argument, kind) {
    if (all) return(names(wrong_values()))
    # Every pair meets three values that it must refuse, other ones in turn.
    must <- unlawful_values(kind)
    turn <<- turn + 1
    unique(must[(turn * 5 + c(0, 13, 27)) %% max(length(must), 1) + 1])
  }
  tried <- try_arguments(calls, values = function(...) stats::na.omit(some(...)))
  expect_gt(nrow(tried), 1000)
  bad <- leaks_of(tried)
  told <- sprintf("%s(%s = %s): %s", bad$fn, bad$argument, bad$value,
                  substr(gsub("\\s+", " ", bad$outcome), 1, 200))
  expect_identical(told, character())
})

test_that("what is not given is told of by name", {
  ball <- specimen(ball_mesh(), rbind(a = c(1, 0, 0), b = c(0, 0, 1)), id = "ball")
  expect_crestline_error(ridge_curve(ball, "a", "b"), c("`radius`", "`width`", "`n` are not given"))
  expect_crestline_error(curvature(), c("`mesh`", "`radius`"))
  expect_crestline_error(curvature(ball), "`radius` is not given")
  expect_crestline_error(fit_shape(), "`specimen`")
  expect_crestline_error(draw_lines(), c("`scene`", "`x`"))
  expect_s3_class(ridge_curve(ball, "a", "b", "plane", n = 5), "curve")
})

test_that("counts have a limit, which the message names, and memory is not asked for", {
  ball <- specimen(ball_mesh(), rbind(a = c(1, 0, 0), b = c(0, 0, 1)), id = "ball")
  expect_crestline_error(ridge_curve(ball, "a", "b", "plane", n = 1e10), c("`n`", "1e+06"))
  expect_crestline_error(curvature(ball, 0.5, threads = 1e9), c("`threads`", "1024"))
  expect_crestline_error(draw_surface(ball, resolution = 1e6), c("`resolution`", "pixels"))
  expect_crestline_error(draw_surface(ball, samples = 1e3), "`samples`")
  expect_crestline_error(simulate_faces(1e9), "`n`")
  expect_crestline_error(compare_groups(array(0, c(4, 3, 4)), 1:4, n_perm = 1e12), "`n_perm`")
  expect_crestline_error(check_size(c(1e6, 1e6)), c("`size`", "2e+08"))
  expect_crestline_error(check_memory(1e12, 1e3, "dense"), c("`dense`", "GB"))
})

test_that("misspelt arguments are not passed over", {
  shape <- quad_shape()
  expect_crestline_error(print(shape, mots = 3), c("mots"))
  expect_crestline_error(as.data.frame(shape, row.names = NULL, FALSE, levl = "curves"), "levl")
  expect_crestline_error(summary(quality(shape), x = 1), "`x`")
  expect_crestline_error(coords(shape, "curves", lvl = 1), "lvl")
  expect_crestline_error(draw_surface(ball_mesh(), resolutoin = 5), c("resolutoin", "resolution"))
  expect_crestline_error(as_morpho(array(0, c(4, 3, 4)), "points", scal = TRUE), "scal")
})

test_that("a path that no system takes is refused, whichever way R was started", {
  long <- strrep("x", 5000)
  expect_crestline_error(write_landmarks(rbind(a = 1:3), paste0(long, ".csv")), "`file`")
  expect_crestline_error(fit_shapes(long), "`x`")
  expect_crestline_error(fit_shapes("face.ply", dir = long), "`dir`")
  expect_crestline_error(read_specimen(long), "`file`")
})

test_that("no function has more than nine arguments, but makers of settings and of records", {
  space <- asNamespace("crestline")
  count <- vapply(ls(space), function(name) {
    if (is.function(space[[name]])) sum(names(formals(space[[name]])) != "...") else 0L
  }, 0L)
  # Their arguments are fields; those of compiled functions are arrays.
  exempt <- grepl("_(settings|limits)$|^new_|^cpp_", names(count))
  expect_identical(names(count)[count > 9 & !exempt], character())
})
