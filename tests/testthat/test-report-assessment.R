# The page of one face against its norms, and that of two visits.

page_text <- function(x, ...) {
  testthat::skip_if_not_installed("htmltools")
  file <- tempfile(fileext = ".html")
  on.exit(unlink(file))
  expect_identical(write_page(x, file, ...), file)
  paste(readLines(file, warn = FALSE, encoding = "UTF-8"), collapse = "\n")
}

pngs <- function(html) lengths(regmatches(html, gregexpr("data:image/png;base64", html)))

small_assessment <- local({
  made <- NULL
  function() {
    if (is.null(made)) {
      point <- rownames(coords(small_template(), "surface"))[18]
      shape <- small_patient(lesions = data.frame(height = 8, radius = 18, point = point))
      shape$id <- "A <b>"
      made <<- suppressWarnings(assess(shape, small_norms(), age = 10, sex = "female"))
    }
    made
  }
})

test_that("the page is one file without scripts, and says what was found and what it is not", {
  html <- page_text(small_assessment())
  expect_false(grepl("https?://|<link|<script|src=\"(?!data:)|@import", html, perl = TRUE))
  for (text in c("No diagnosis", "outside what chance explains", "within what is expected",
                 "Places that do not fit", "Limits", "Where this came from", "A &lt;b&gt;",
                 "@page { size: A4", "name=\"viewport\"", "balls, 120 faces", "female, 10 years")) {
    expect_match(html, text, fixed = TRUE)
  }
  expect_false(grepl("A <b>", html, fixed = TRUE))
  asymmetric <- small_assessment()$verdicts$verdict[6] == "real"
  expect_equal(pngs(html), 4 + asymmetric)
  found <- small_assessment()$findings
  expect_match(html, sprintf("%.1f \u00b1 %.1f", found$height[1], 1.96 * found$sd[1]),
               fixed = TRUE)
})

test_that("every value has its row, and what was not assessed its reason", {
  x <- small_assessment()
  x$values$z[2] <- x$values$value[2] <- NA
  x$values$reason[2] <- "a point that it needs is missing"
  x$points$assessed[1:3] <- FALSE
  x$verdicts$verdict[6] <- "not assessable"
  html <- page_text(x, title = "Mine")
  expect_match(html, "<title>Mine</title>", fixed = TRUE)
  expect_match(html, "not assessed: a point that it needs is missing", fixed = TRUE)
  expect_match(html, "3 surface points of 35 missing", fixed = TRUE)
  expect_match(html, "could not be assessed", fixed = TRUE)
  for (name in x$values$name) expect_match(html, sprintf("<td>%s</td>", name), fixed = TRUE)
})

test_that("a chart has the person's point where it belongs", {
  chart <- data.frame(age = rep(c(0, 10), 3), centile = rep(c(3, 50, 97), each = 2),
                      value = c(0, 0, 5, 5, 10, 10))
  one <- data.frame(value = 5, lower = 4, upper = 6)
  drawn <- as.character(growth_drawing(chart, 5, one, size = c(100, 100), margin = rep(0, 4)))
  expect_match(drawn, "<circle cx=\"50.0\" cy=\"50.0\"", fixed = TRUE)
  expect_match(drawn, "M50.0 60.0V40.0", fixed = TRUE)
  # The highest curve is at the top.
  expect_match(drawn, "<path d=\"M0.0 0.0L100.0 0.0\"", fixed = TRUE)
  one$lower <- one$upper <- NA
  expect_no_match(as.character(growth_drawing(chart, 5, one)), "stroke-width=\"2\"/><circle")
})

test_that("two visits have a page too; arguments of other pages are refused", {
  lesion <- data.frame(height = 6, radius = 18, visit = 2,
                       point = rownames(coords(small_template(), "surface"))[18])
  cohort <- simulate_cohort(1, data = data.frame(age = 10, sex = "female"), visits = 2,
                            template = small_template(), lesions = lesion, seed = 4)
  compared <- compare_visits(cohort$sample[[1]], cohort$second[[1]], table = ball_measurements())
  html <- page_text(compared)
  expect_equal(pngs(html), 3)
  for (text in c("No diagnosis", "Growth between the visits was not subtracted", "changed",
                 "Smallest detectable change")) {
    expect_match(html, text, fixed = TRUE)
  }
  file <- tempfile(fileext = ".html")
  expect_crestline_error(write_page(compared, file, size = c(10, 10)), "`size`")
  expect_crestline_error(write_page(small_assessment(), "page.txt"), "`file`")
  expect_crestline_error(write_page(small_assessment(), file, title = 3), "`title`")
})
