report_of <- function(x, ...) {
  testthat::skip_if_not_installed("htmltools")
  file <- tempfile(fileext = ".html")
  on.exit(unlink(file))
  shown <- quality_report(x, file, ..., size = c(600, 250))
  testthat::expect_identical(normalizePath(shown), normalizePath(file))
  paste(readLines(file, warn = FALSE, encoding = "UTF-8"), collapse = "\n")
}

# The columns that the page's script reads.
data_of <- function(html) {
  text <- regmatches(html,
                     regexpr('(?s)<script id="data" type="application/json">.*?</script>', html,
                             perl = TRUE))
  jsonlite::fromJSON(gsub("<\\/", "</", gsub("^<script[^>]*>|</script>$", "", text), fixed = TRUE))
}

pictures_of <- function(html) {
  data <- regmatches(html, gregexpr("data:image/png;base64,[A-Za-z0-9+/=]+", html))[[1]]
  lapply(sub("^[^,]*,", "", data), jsonlite::base64_dec)
}

test_that("a page is one file with table, pictures and limits, and asks for nothing else", {
  shape <- quad_shape(landmarks = quad_corners()[c("a", "b", "d"), ])
  html <- report_of(shape, specimens = quad_specimen(), title = "Four < five")
  expect_match(html, "<title>Four &lt; five</title>", fixed = TRUE)
  expect_match(html, "1 specimen, 9 parts: 5 green, 0 amber, 4 red.", fixed = TRUE)
  expect_false(grepl("https?://|<link|src=\"(?!data:)|@import|url\\(", html, perl = TRUE))
  expect_false(grepl("id=\"matrix\"", html, fixed = TRUE))
  graded <- quality(shape)
  data <- data_of(html)
  expect_equal(data$part, graded$part)
  expect_equal(data$grade, as.character(graded$grade))
  expect_equal(data$why, graded$why)
  expect_equal(data$length, signif(graded$length, 3))
  expect_equal(data$missing == 1,
               is.na(match(data$part, shape$points$part[!is.na(shape$points$x)])))
  for (name in names(Filter(function(limit) length(limit) == 2, quality_limits()))) {
    expect_match(html, sprintf("<td>%s</td>", name), fixed = TRUE)
  }
})

test_that("several specimens have counts and a matrix, also one that was lost", {
  html <- report_of(list(one = quad_shape(), lost = NULL, two = quad_shape()))
  expect_match(html, "3 specimens, 19 parts: 18 green, 0 amber, 1 red.", fixed = TRUE)
  expect_match(html, "id=\"matrix\"", fixed = TRUE)
  expect_match(html, "data-specimen=\"lost\"", fixed = TRUE)
  expect_equal(unique(data_of(html)$specimen), c("one", "lost", "two"))
  expect_length(pictures_of(html), 2)
  expect_length(pictures_of(report_of(list(quad_shape(), quad_shape()), pictures = 1)), 1)
})

test_that("names cannot break out of the page", {
  shape <- quad_shape()
  html <- report_of(list("</script><b>" = shape, "\"x\"" = shape), pictures = 0)
  expect_false(grepl("</script><b>", html, fixed = TRUE))
  expect_equal(unique(data_of(html)$specimen), c("</script><b>", "\"x\""))
})

test_that("pictures are PNGs of the size asked for, in the colours of the grades", {
  skip_if_not_installed("png")
  shape <- quad_shape()
  near <- function(html, colour) {
    pixels <- png::readPNG(pictures_of(html)[[1]])
    expect_equal(dim(pixels)[1:2], c(250, 600))
    rgb <- grDevices::col2rgb(grade_colours[[colour]]) / 255
    sum((pixels[, , 1] - rgb[1])^2 + (pixels[, , 2] - rgb[2])^2 + (pixels[, , 3] - rgb[3])^2 < 0.01)
  }
  good <- report_of(shape, specimens = quad_specimen())
  expect_gt(near(good, "green"), 100)
  expect_equal(near(good, "red"), 0)
  shape$checks$cut[5] <- 0.5
  shape$checks$cut[6] <- 0.9
  bad <- report_of(shape, specimens = quad_specimen())
  expect_gt(near(bad, "red"), 50)
  expect_gt(near(bad, "amber"), 50)
  expect_gt(near(report_of(shape), "red"), 50)
})

test_that("a shape with nothing to draw has no picture", {
  lost <- quad_shape(landmarks = quad_corners()[1, , drop = FALSE])
  expect_match(report_of(lost), "Nothing to draw.", fixed = TRUE)
  bare <- quad_shape(quad_scheme(function(tables) tables[1:2]))
  expect_match(report_of(bare), "Nothing to draw.", fixed = TRUE)
  expect_length(pictures_of(report_of(bare, specimens = quad_specimen())), 1)
})

test_that("specimens are told by id, file and pictures are checked", {
  shape <- quad_shape()
  other <- quad_specimen()
  other$id <- "other"
  html <- tempfile(fileext = ".html")
  expect_crestline_error(quality_report(shape, html, other), "other")
  expect_crestline_error(quality_report(shape, html, quad_scheme()), "specimen()")
  expect_crestline_error(quality_report(shape, "page.txt"), ".html")
  expect_crestline_error(quality_report(quad_specimen(), html), "fit_shape()")
  expect_crestline_error(quality_report(shape, html, pictures = -1), "pictures")
  renamed <- shape
  renamed$id <- "other"
  expect_length(specimens_of(list(other, quad_specimen()), list(a = shape, b = NULL, c = renamed)),
                3)
  expect_equal(specimens_of(list(other), list(a = NULL, c = renamed))$c$id, "other")
})

test_that("ids that look like scripts leave the page's table whole", {
  skip_if_not_installed("htmltools")
  for (id in c("<!--<script>", "</script>", "a\u2028b", "\"'&<b>")) {
    shape <- quad_shape()
    shape$id <- id
    file <- tempfile(fileext = ".html")
    quality_report(shape, file, pictures = 0, title = id)
    html <- paste(readLines(file, encoding = "UTF-8", warn = FALSE), collapse = "\n")
    unlink(file)
    data <- sub('(?s).*<script id="data" type="application/json">(.*?)</script>.*', "\\1", html,
                perl = TRUE)
    expect_equal(unique(jsonlite::fromJSON(data)$specimen), id)
    expect_no_match(html, "<!--<script>", fixed = TRUE)
  }
})

test_that("a homologised sample has a page", {
  sample <- homologise(paired_sample()[1:2], rounds = 1, tolerance = 1, progress = FALSE)
  file <- tempfile(fileext = ".html")
  on.exit(unlink(file))
  expect_identical(quality_report(sample, file, pictures = 0), file)
  expect_match(paste(readLines(file, warn = FALSE), collapse = ""), "ball1")
})
