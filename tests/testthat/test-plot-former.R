# A message is said once a session: here, as if none had been.
as_new <- function(former) rlang::reset_message_verbosity(paste("crestline:", former))

test_that("former names do what they did, and say once what to write", {
  curve <- equator_curve()
  as_new("plot_panel(x)")
  expect_message(panel <- draw_quietly(plot_panel(curve, grid = c(30, 21)), 500, 300),
                 "what = \"panel\"",
                 class = "crestline_deprecated")
  said <- testthat::capture_messages(again <- draw_quietly(plot_panel(curve, grid = c(30, 21)), 500,
                                                           300))
  expect_identical(said, character())
  expect_identical(again, draw_quietly(plot(curve, what = "panel", grid = c(30, 21)), 500, 300))
  expect_identical(again, panel)
})

test_that("cuts take their colours by the former names of arguments", {
  ball <- specimen(Rvcg::vcgSphere(4), rbind(east = c(1, 0, 0), front = c(0, 0, 1)), id = "ball")
  as_new("plot_cuts(specimen, from, to)")
  expect_message(former <- drawn_pixels(plot_cuts(ball, "east", "front", c(0, 0.5),
                                                  colour = c("red", "blue"),
                                                  engine = "picture"), 200, 200), "what = \"cuts\"")
  today <- drawn_pixels(plot(ball, what = "cuts", from = "east", to = "front", angles = c(0, 0.5),
                             colours = c("red", "blue"), engine = "picture"), 200, 200)
  expect_identical(former, today)
})

test_that("what was not found or refined has no such picture", {
  expect_crestline_error(suppressMessages(plot_placing(ball_specimen())), "not found but given",
                         id = "ball")
  expect_crestline_error(suppressMessages(plot_refinement(ball_specimen())), "not refined",
                         id = "ball")
  expect_crestline_error(plot(ball_specimen(), what = "other"), "`what`")
})

test_that("writers take the file first, as they did, with a message", {
  skip_if_not_installed("htmltools")
  as_new("write_page(file, x)")
  files <- replicate(2, tempfile(fileext = ".html"))
  expect_message(write_page(files[1], ball_specimen(), surface = "plain", selfcontained = FALSE),
                 "write_page(x, file)",
                 fixed = TRUE)
  write_page(ball_specimen(), files[2], surface = "plain", selfcontained = FALSE)
  expect_gt(file.size(files[1]), 1000)
  expect_equal(file.size(files[1]), file.size(files[2]), tolerance = 0.01)
  expect_crestline_error(write_page("a.html", "b.html"), "`x`")
})

test_that("writers take the object under its former name, with a message", {
  skip_if_not_installed("htmltools")
  as_new("write_page(specimen = )")
  file <- tempfile(fileext = ".html")
  expect_message(write_page(file, specimen = ball_specimen(), surface = "plain"),
                 "write_page(x, file)", fixed = TRUE, class = "crestline_deprecated")
  expect_gt(file.size(file), 1000)
  unlink(file)
  write_page(file = file, specimen = ball_specimen(), surface = "plain", title = "By name")
  expect_match(paste(readLines(file, warn = FALSE), collapse = ""), "By name")
  expect_crestline_error(write_page(file, list(), specimen = ball_specimen()), "`specimen`")
  expect_crestline_error(write_page(specimen = ball_specimen()), "`specimen`")
  expect_crestline_error(write_page(ball_specimen()), "`file` is not given")
  xyz <- t(Rvcg::vcgSphere(1)$vb[1:3, ])
  balls <- simplify2array(lapply(1:5, function(i) xyz %*% diag(c(1 + i / 20, 1, 1 - i^2 / 99))))
  pca <- shape_pca(align(balls, "ball", triangles = Rvcg::vcgSphere(1)$it))
  as_new("write_pca_page(pca = )")
  expect_message(write_pca_page(file, pca = pca, component = 1), "write_pca_page(x, file)",
                 fixed = TRUE, class = "crestline_deprecated")
  expect_match(paste(readLines(file, warn = FALSE), collapse = ""), "Principal components of shape")
  expect_crestline_error(write_pca_page(pca, file, colours = "red"), "`colours`")
})
