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

test_that("a norm of both sexes together is not called one of a sex", {
  one <- small_assessment()
  expect_match(page_text(one), "norms of its age and sex", fixed = TRUE)
  one$sex <- "all"
  html <- gsub("base64,[^\"]*", "", page_text(one))
  expect_match(html, "norms of its age<", fixed = TRUE)
  expect_match(html, "people of this age with a smaller value", fixed = TRUE)
  expect_false(grepl("sex", html, ignore.case = TRUE))
})

test_that("the page is one file without scripts, and says what was found and what it is not", {
  html <- page_text(small_assessment())
  expect_false(grepl("https?://|<link|<script|src=\"(?!data:)|@import", html, perl = TRUE))
  for (text in c("No diagnosis", "<b>differs by more than chance</b>", "<td>no difference shown",
                 "Places that do not fit", "Limits", "The norm", "A &lt;b&gt;",
                 "@page { size: A4", "name=\"viewport\"", "balls, 120 faces", "female, 10 years")) {
    expect_match(html, text, fixed = TRUE)
  }
  expect_false(grepl("A <b>", html, fixed = TRUE))
  asymmetric <- small_assessment()$verdicts$verdict[6] == "real"
  expect_equal(pngs(html), 4 + asymmetric)
  found <- small_assessment()$findings
  interval <- sprintf("%.1f (%.1f to %.1f)", found$height[1], found$height[1] - 1.96 * found$sd[1],
                      found$height[1] + 1.96 * found$sd[1])
  expect_match(html, paste("outward by", interval), fixed = TRUE)
  expect_match(html, paste0("<td class=\"n\">", interval), fixed = TRUE)
})

test_that("a height's interval may go over to the other side, which is said by its sign", {
  expect_identical(height_words(data.frame(height = -1, sd = 1)), "1.0 (\u22121.0 to 3.0)")
})

test_that("the answer on asymmetry names its direction, and measurements their centile", {
  x <- small_assessment()
  row <- data.frame(family = "asymmetry", where = x$points$point[3])
  x$points$z_asymmetry[3] <- -5
  expect_identical(verdict_place(row, x),
                   paste0(x$points$part[3], ", further inward against the other side than usual"))
  row <- data.frame(family = "measurements", where = x$values$name[2])
  x$values$centile[2] <- 0.05
  expect_identical(verdict_place(row, x), paste0(x$values$name[2], ", centile < 0.1"))
})

test_that("questions that were answered are counted, and a place that is not replaced is named", {
  x <- small_assessment()
  expect_match(page_text(x), "corrected for 6 questions", fixed = TRUE)
  x$verdicts$p[6] <- NA
  expect_match(page_text(x), "corrected for 5 questions", fixed = TRUE)
  x$findings <- x$findings[0, ]
  row <- data.frame(family = "scan", where = "mid 3 3 and mid 5 3")
  expect_identical(verdict_place(row, x),
                   "mid 3 3 and mid 5 3; not replaced, as too little of the face is left")
})

test_that("a scan with larger errors than the norm's is said to be so, with its wider z", {
  x <- small_assessment()
  x$values$z_widened <- x$values$z
  expect_no_match(page_text(x), "z, wider")
  x$values$z[2] <- 3
  x$values$z_widened[2] <- 2.5
  html <- page_text(x)
  expect_match(html, "larger than the norm's", fixed = TRUE)
  expect_match(html, "<b>+3.00</b>", fixed = TRUE)
  expect_match(html, "<td class=\"n\">+2.50</td>", fixed = TRUE)
  expect_match(paste(utils::capture.output(print(x)), collapse = " "), "wider scale")
})

test_that("values have as many decimals as their error", {
  values <- data.frame(name = letters[1:4], unit = c("mm", "mm", "1", "mm^2"),
                       value = c(20, 30, 0.5, 1234.5), lower = c(19.8, 29.8, 0.49, NA),
                       upper = c(20.2, 30.2, 0.51, NA))
  expect_equal(value_decimals(values), c(1, 1, 3, 0))
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
  expect_match(html, "Not all of the face was assessed: 3 of 35 surface points are missing, in",
               fixed = TRUE)
  expect_match(html, "If the place matters, scan again", fixed = TRUE)
  expect_match(html, "1 measurement: the reason is in the table", fixed = TRUE)
  expect_match(html, "could not be assessed", fixed = TRUE)
  for (name in x$values$name) expect_match(html, sprintf("<td>%s</td>", name), fixed = TRUE)
})

test_that("missing points are counted by part, the largest loss first", {
  part <- rep(c("a", "b", "c"), c(4, 3, 2))
  lost <- c(TRUE, FALSE, FALSE, FALSE, TRUE, TRUE, FALSE, FALSE, FALSE)
  expect_identical(lost_words(part, lost), "b (2 of 3), a (1 of 4)")
  expect_identical(lost_words(part, lost, most = 1), "b (2 of 3), 1 more part")
})

test_that("a chart has the person's point where it belongs", {
  chart <- data.frame(age = rep(c(0, 10), 3), centile = rep(c(3, 50, 97), each = 2),
                      value = c(0, 0, 5, 5, 10, 10))
  one <- data.frame(value = 5, lower = 4, upper = 6)
  drawn <- as.character(growth_drawing(chart, 5, one, size = c(100, 100), margin = rep(0, 4),
                                       room = 0))
  expect_match(drawn, "<circle cx=\"50.0\" cy=\"50.0\"", fixed = TRUE)
  expect_match(drawn, "M50.0 60.0V40.0", fixed = TRUE)
  # The highest curve is at the top.
  expect_match(drawn, "<path d=\"M0.0 0.0L100.0 0.0\"", fixed = TRUE)
  expect_match(drawn, "age, years", fixed = TRUE)
  # A bar that is the lowest of all does not touch the axis.
  one$lower <- -10
  drawn <- as.character(growth_drawing(chart, 5, one, size = c(100, 100), margin = rep(0, 4)))
  bar <- sub(".*<path d=\"M50.0 ([0-9.]+)V.*", "\\1", drawn)
  expect_lt(as.numeric(bar), 98)
  one$lower <- one$upper <- NA
  expect_no_match(as.character(growth_drawing(chart, 5, one)), "stroke-width=\"2\"/><circle")
})

two_visits <- function() {
  lesion <- data.frame(height = 6, radius = 18, visit = 2,
                       point = rownames(coords(small_template(), "surface"))[18])
  cohort <- simulate_cohort(1, data = data.frame(age = 10, sex = "female"), visits = 2,
                            template = small_template(), lesions = lesion, seed = 4)
  list(cohort$sample[[1]], cohort$second[[1]])
}

test_that("two visits have a page too; arguments of other pages are refused", {
  visits <- two_visits()
  compared <- compare_visits(visits[[1]], visits[[2]], table = ball_measurements())
  html <- page_text(compared)
  expect_equal(pngs(html), 3)
  called <- sum(compared$points$called)
  for (text in c("No diagnosis", "Growth between the visits was not subtracted",
                 sprintf("<b>%d of 35 changed</b>", called), ": two visits", "no change shown")) {
    expect_match(html, text, fixed = TRUE)
  }
  best <- compared$points[which.max(abs(compared$points$score) * compared$points$called), ]
  expect_match(html, largest_change(compared), fixed = TRUE)
  expect_match(largest_change(compared), sprintf("%s, outward by %.1f", best$part, best$change))
  expect_no_match(html, "Not all of the face was compared")
  file <- tempfile(fileext = ".html")
  expect_crestline_error(write_page(compared, file, size = c(10, 10)), "`size`")
  expect_crestline_error(write_page(small_assessment(), "page.txt"), "`file`")
  expect_crestline_error(write_page(small_assessment(), file, title = 3), "`title`")
})

test_that("the page of two visits says which places were not compared, and why", {
  compared <- compare_visits(two_visits()[[1]], two_visits()[[2]], table = ball_measurements())
  at <- which(compared$points$level == "surface")
  lost <- compared
  lost$points[at[1:2], c("change", "score")] <- NA
  lost$points$score[at[3]] <- NA
  html <- page_text(lost)
  expect_match(html, "2 missing at one of the visits and 1 without an error", fixed = TRUE)
  expect_match(html, lost_words(compared$points$part[at], seq_along(at) < 4), fixed = TRUE)
  expect_no_match(html, "not in the pictures")
  lost$points$score <- lost$points$se <- NA
  lost$points$called <- FALSE
  lost$parts$p_holm <- NA
  html <- page_text(lost)
  expect_match(html, "<td>could not be assessed</td>", fixed = TRUE)
  expect_match(html, "No error is known", fixed = TRUE)
  expect_equal(pngs(html), 2)
})

test_that("errors alone do not fill the scale of a change", {
  same <- two_visits()[[1]]
  compared <- compare_visits(same, same, table = ball_measurements())
  html <- page_text(compared)
  least <- signif(6 * stats::median(compared$points$se[compared$points$level == "surface"]), 1)
  expect_match(html, sprintf(">+%g unit</text>", least), fixed = TRUE)
  expect_match(html, "no change shown (35 compared)", fixed = TRUE)
})

test_that("growth has a column of its own, by which change, before and after fit each other", {
  compared <- compare_visits(two_visits()[[1]], two_visits()[[2]], table = ball_measurements())
  expect_no_match(page_text(compared), "<th class=\"n\">growth</th>")
  compared$growth <- "from 8 to 10 years"
  compared$measurements$growth <- 0.25
  html <- page_text(compared)
  expect_match(html, "<th class=\"n\">growth</th>", fixed = TRUE)
  expect_match(html, "<td class=\"n\">+0.2", fixed = TRUE)
})

test_that("points of no triangle have no sign, which would float beside the face", {
  found <- small_assessment()
  xyz <- as.matrix(found$points[c("x", "y", "z")])
  drawn <- NULL
  view <- function(scene, at) {
    drawn <<- nrow(at)
    at
  }
  signs <- function(triangles) {
    grDevices::pdf(NULL)
    on.exit(grDevices::dev.off())
    own <- environment(draw_signs)
    copy <- draw_signs
    environment(copy) <- list2env(list(view_points = view, visible_points = function(scene, at) {
      rep(TRUE, nrow(at))
    }), parent = own)
    copy(triangles, xyz, rep(9, nrow(xyz)), 6, 3, NULL, found$front, TRUE)
    drawn
  }
  some <- found$triangles[, 1:3]
  expect_equal(signs(some), length(unique(as.vector(some))))
})
