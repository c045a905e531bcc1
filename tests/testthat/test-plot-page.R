write_ball_page <- function(..., file = tempfile(fileext = ".html")) {
  testthat::skip_if_not_installed("htmltools")
  old <- options(rgl.useNULL = TRUE)
  on.exit(options(old))
  write_page(ball_specimen(), file, ..., curvature = ball_curvature())
}

test_that("a page is one file with the scene, the curves' table and the caption", {
  file <- write_ball_page(list(equator = equator_curve()), caption = "A quarter < a half",
                          title = "One ball")
  html <- paste(readLines(file, warn = FALSE), collapse = "\n")
  for (text in c("equator", "A quarter &lt; a half", "One ball", "saddle ridge", "rglWebGL")) {
    expect_match(html, text, fixed = TRUE)
  }
  expect_false(grepl("<script src=|<link href=", html))
  expect_false(dir.exists(paste0(tools::file_path_sans_ext(file), "_files")))
  unlink(file)
})

test_that("a page may keep its files in a folder", {
  file <- write_ball_page(selfcontained = FALSE)
  folder <- paste0(tools::file_path_sans_ext(file), "_files")
  expect_gt(length(list.files(folder, recursive = TRUE)), 1)
  expect_match(paste(readLines(file, warn = FALSE), collapse = "\n"), "<script src=", fixed = TRUE)
  unlink(c(file, folder), recursive = TRUE)
})

test_that("the user's rgl device is left as it was", {
  with_null_rgl({
    before <- rgl::cur3d()
    file <- write_ball_page()
    expect_identical(rgl::cur3d(), before)
    unlink(file)
  })
})

test_that("the table has a row a curve, numbers shortened, names only where there are some", {
  table <- curve_table(list(a = equator_curve(), b = equator_curve("valley")))
  expect_equal(table$curve, c("a", "b"))
  expect_equal(table$kind, c("ridge", "valley"))
  expect_equal(table$se, c(0.05, 0.05))
  expect_false("curve" %in% names(curve_table(list(equator_curve()))))
  html <- as.character(column_table(data.frame(length = pi, x = NA),
                                    list(length = "in mm", y = "z")))
  expect_match(html, "3.14<", fixed = TRUE)
  expect_match(html, "<dd>in mm</dd>", fixed = TRUE)
  expect_no_match(html, "NA<|<dd>z")
  expect_null(column_table(NULL))
})

test_that("a page needs a name that ends in .html and a folder", {
  expect_error(write_page(ball_specimen(), "page.txt"), class = "crestline_error")
  expect_error(write_page(ball_specimen(), file.path(tempdir(), "nowhere", "page.html")),
               class = "crestline_error")
})

test_that("a shape's page has a tick for its surface, a row a curve, none for the missing", {
  testthat::skip_if_not_installed("htmltools")
  file <- tempfile(fileext = ".html")
  shape <- quad_shape()
  write_page(quad_specimen(), file, shape, surface = "plain", length_unit = "furlong")
  html <- paste(readLines(file, warn = FALSE), collapse = "\n")
  unlink(file)
  expect_true(grepl('data-layer="surface model"', html, fixed = TRUE))
  for (curve in c("bottom", "top", "left", "right")) {
    expect_true(grepl(paste0(">", curve, "</td>"), html, fixed = TRUE))
  }
  expect_false(grepl(">NA</td>", html, fixed = TRUE))
  for (text in c("width=device-width", "arc length (furlong)", "@media print", "@media (max-width",
                 "Where this came from")) {
    expect_true(grepl(text, html, fixed = TRUE), label = text)
  }
})

test_that("a page has few objects, however many curves and points it shows", {
  objects <- function(curves) {
    scene <- page_scene(curves, ball_specimen(), "plain", c(400, 400), list())
    with_null_rgl(joined_objects(scene$drawn))
  }
  one <- objects(list(equator_curve()))
  expect_named(one, c("surface", "bands of error", "curves"))
  many <- objects(rep(list(equator_curve(), equator_curve("valley")), 10))
  expect_equal(lengths(many), lengths(one))
  expect_lte(sum(lengths(many)), 4)
})

test_that("the radius of the shape index is said, with its unit", {
  testthat::skip_if_not_installed("htmltools")
  file <- write_ball_page(length_unit = "mm")
  expect_match(paste(readLines(file, warn = FALSE), collapse = ""),
               "shape index, radius 0.3 (mm)", fixed = TRUE)
  unlink(file)
})

test_that("the scripts of a page are closed", {
  file <- write_ball_page(surface = "plain", selfcontained = FALSE)
  html <- paste(readLines(file, encoding = "UTF-8"), collapse = "\n")
  count <- function(text) lengths(regmatches(html, gregexpr(text, html, fixed = TRUE)))
  expect_equal(count("</script>"), count("<script"))
  unlink(c(file, sub(".html", "_files", file, fixed = TRUE)), recursive = TRUE)
})

test_that("the page of a shape needs no specimen beside it, unless the shape keeps none", {
  testthat::skip_if_not_installed("htmltools")
  old <- options(rgl.useNULL = TRUE)
  on.exit(options(old))
  shape <- two_patch_shape()
  file <- tempfile(fileext = ".html")
  write_page(shape, file, surface = "plain", selfcontained = FALSE)
  expect_match(paste(readLines(file, warn = FALSE), collapse = "\n"),
               paste("Specimen", shape$id), fixed = TRUE)
  unlink(c(file, sub("[.]html$", "_files", file)), recursive = TRUE)
  shape$specimen <- NULL
  expect_crestline_error(write_page(shape, file), "write_page(specimen, file, curves = shape)")
})
