scheme <- face_scheme()
known <- scheme$landmarks$landmark
renamed <- function(...) {
  other <- c(...)
  ifelse(known %in% names(other), other[known], known)
}

test_that("names that the scheme does not know are listed with those that may be meant", {
  expect_null(unused_names(known, scheme))
  expect_equal(unused_names(renamed(pn = "prn", chL = "CHL"), scheme),
               "not used: prn, CHL; near: pn, chL", ignore_attr = TRUE)
  expect_equal(attr(unused_names(renamed(pn = "prn", chL = "CHL"), scheme), "near"),
               c(prn = "pn", CHL = "chL"))
  near <- function(...) unname(attr(unused_names(renamed(...), scheme), "near"))
  for (other in c("PN", "p n", "pronasale", "Pro-Nasale")) expect_equal(near(pn = other), "pn")
  for (other in c("ch left", "ch_L", "left ch", "Left_ch")) expect_equal(near(chL = other), "chL")
})

test_that("what is no more than another landmark is near nothing", {
  for (names in list(c(known, "prn"), renamed(chR = "chX"), renamed(chR = "xx"), renamed(gn = "me"),
                     setdiff(known, "tL"))) {
    expect_length(attr(unused_names(names, scheme), "near"), 0)
  }
  expect_equal(unused_names(c(known, "zyL"), scheme), "not used: zyL", ignore_attr = TRUE)
  # The other side of a pair is never near
  expect_length(attr(unused_names(c(setdiff(known, "acL"), "acR2"), scheme), "near"), 0)
})

test_that("fit_shape() warns where another landmark may be meant, and print() lists the unused", {
  corners <- rbind(c(-1, -1, 2), c(1, -1, 2), c(0, 1.5, 2), c(0, 0, 2)) / sqrt(6)
  three <- curve_scheme(data.frame(landmark = c("a", "b", "C C")),
                        data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 5),
                        name = "three")
  ball <- function(...) {
    specimen(Rvcg::vcgSphere(3), `rownames<-`(corners, c(...)), id = "ball", tolerance = 1)
  }
  expect_warning(shape <- fit_shape(ball("a", "b", "cc", "x"), three, progress = FALSE),
                 "not used: cc, x; near: C C", class = "crestline_unused_landmarks")
  expect_output(print(shape), "landmarks not used: cc, x; near: C C", fixed = TRUE)
  expect_match(shape$status$reason[shape$status$part == "C C"], "near: cc")
  expect_no_warning(shape <- fit_shape(ball("a", "b", "C C", "x"), three, progress = FALSE))
  expect_output(print(shape), "landmarks not used: x", fixed = TRUE)
  expect_crestline_error(fit_shape(ball("A", "B", "c c", "x"), three, progress = FALSE),
                         c("none of the landmarks", "near: a, b, C C"))
})

test_that("landmarks are renamed on reading, and never onto another's name", {
  file <- tempfile(fileext = ".ply")
  write_mesh(ball_mesh(), file)
  at <- rbind(prn = c(1, 0, 0), top = c(0, 0, 1))
  one <- read_specimen(file, at, names = c(prn = "pn"))
  expect_identical(rownames(one$landmarks), c("pn", "top"))
  expect_identical(unname(one$landmarks["pn", ]),
                   unname(read_specimen(file, at)$landmarks["prn", ]))
  expect_crestline_error(read_specimen(file, at, names = c(prn = "top")),
                         "two landmarks the name top")
  expect_warning(some <- read_specimen(file, at, names = c(prn = "pn", other = "x")),
                 "`names` has other", class = "crestline_warning")
  expect_identical(rownames(some$landmarks), c("pn", "top"))
  expect_crestline_error(read_specimen(file, at, names = c(other = "x")), "`names` has other")
  expect_crestline_error(read_specimen(file, at, names = "pn"), "`names`")
  expect_crestline_error(read_specimen(file, at, names = c(a = "x", b = "x")), "`names`")
})
