write_ball_page <- function(..., file = tempfile(fileext = ".html")) {
  testthat::skip_if_not_installed("htmltools")
  old <- options(rgl.useNULL = TRUE)
  on.exit(options(old))
  write_page(file, ball_specimen(), ..., curvature = ball_curvature())
}

test_that("a page is one file with the scene, the curves' table and the caption", {
  file <- write_ball_page(list(equator = equator_curve()), caption = "A quarter < a half", title = "One ball")
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
  expect_match(as.character(html_table(data.frame(length = pi))), "3.14<", fixed = TRUE)
  expect_null(html_table(NULL))
})

test_that("text of a script cannot end it", {
  folder <- tempfile()
  dir.create(folder)
  writeLines("x = '</script>' + \"\\\\1\";", file.path(folder, "a.js"))
  html <- inline_files("<p></p><script src=\"a.js\"></script><p></p>", folder, '<script src="([^"]+)"></script>', "script", "</script")
  expect_equal(html, "<p></p><script>\nx = '<\\/script>' + \"\\\\1\";\n</script><p></p>")
  unlink(folder, recursive = TRUE)
})

test_that("a page needs a name that ends in .html and a folder", {
  expect_error(write_page("page.txt", ball_specimen()), class = "crestline_error")
  expect_error(write_page(file.path(tempdir(), "nowhere", "page.html"), ball_specimen()), class = "crestline_error")
})

test_that("the page of a shape has a button for its surface and a row for each of its curves, nothing for what is missing", {
  testthat::skip_if_not_installed("htmltools")
  old <- options(rgl.useNULL = TRUE)
  on.exit(options(old))
  file <- tempfile(fileext = ".html")
  shape <- quad_shape()
  write_page(file, quad_specimen(), shape, surface = "plain")
  html <- paste(readLines(file, warn = FALSE), collapse = "\n")
  unlink(file)
  expect_true(grepl('"buttonLabels":"surface model"', html, fixed = TRUE))
  for (curve in c("bottom", "top", "left", "right")) expect_true(grepl(paste0(">", curve, "</td>"), html, fixed = TRUE))
  expect_false(grepl(">NA</td>", html, fixed = TRUE))
  layers <- with_null_rgl(page_layers(shape, quad_specimen(), "plain", NULL, 4))
  expect_named(layers, c("plain", "curves", "surface model"))
  expect_false(anyDuplicated(unlist(layers)) > 0)
})
