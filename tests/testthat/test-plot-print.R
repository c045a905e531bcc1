test_that("a picture has its size in cm, its scale bar and its title", {
  skip_if_not_installed("png")
  file <- tempfile(fileext = ".png")
  on.exit(unlink(file))
  x <- ball_specimen()
  expect_identical(write_picture(x, file, "plain", landmarks = FALSE, size = c(5.08, 7.62),
                                 dpi = 100, unit = "radii"), file)
  pixels <- png::readPNG(file)[, , 1:3]
  expect_equal(dim(pixels), c(300, 200, 3))
  black <- apply(pixels, 1:2, max) < 0.05
  # The bar is the longest black row: 0.5 where the ball is 2 wide.
  runs <- apply(black, 1, function(row) max(c(0, with(rle(row), lengths[values]))))
  expect_gt(which.max(runs), 250)
  ball <- range(which(colSums(apply(pixels, 1:2, min)[1:240, ] < 0.9) > 3))
  expect_equal(max(runs) / diff(ball), 0.2 / 2, tolerance = 0.1)
  write_picture(x, file, "plain", size = c(5.08, 7.62), dpi = 100, ruler = FALSE, title = "Ball")
  titled <- png::readPNG(file)[, , 1:3]
  expect_gt(sum(titled[1:25, , 1] < 0.3), 20)
  expect_equal(sum(apply(titled[270:300, , ], 1:2, max) < 0.05), 0)
})

test_that("the surface of a PDF has as many pixels as are asked for", {
  pdf <- tempfile(fileext = ".pdf")
  on.exit(unlink(pdf))
  width <- function(dpi) {
    write_picture(ball_specimen(), pdf, "plain", size = c(5, 5), dpi = dpi)
    bytes <- readBin(pdf, "raw", 1e6)
    text <- rawToChar(bytes[bytes > as.raw(0x1f) & bytes < as.raw(0x7f)])
    as.numeric(sub("/Width ", "", regmatches(text, regexpr("/Width [0-9]+", text))))
  }
  expect_equal(width(300) / width(150), 2, tolerance = 0.02)
  expect_null(getOption("crestline.dpi"))
})

test_that("other endings, other objects, and what is refused", {
  pdf <- tempfile(fileext = ".pdf")
  on.exit(unlink(pdf))
  before <- grDevices::dev.list()
  write_picture(quad_shape(), pdf, quad_specimen(), surface = "plain", size = c(5, 5), dpi = 72)
  expect_identical(readBin(pdf, "raw", 4), charToRaw("%PDF"))
  expect_identical(grDevices::dev.list(), before)
  expect_crestline_error(write_picture(ball_specimen(), "x.gif"), "ends in .png")
  expect_crestline_error(write_picture(ball_specimen(), tempfile(fileext = ".png"), "colourful"),
                         "`colour`")
  expect_identical(grDevices::dev.list(), before)
  expect_equal(round_length(c(0.9)), 0.5)
  expect_equal(vapply(c(1, 2.3, 7, 19, 20, 999), round_length, 0), c(1, 2, 5, 10, 20, 500))
})
