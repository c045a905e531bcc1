ring_tables <- function(...) {
  marks <- c("a", "b", "c", "d", "e")
  curves <- data.frame(curve = c("rim", "half"), from = "a", to = c("a", "b"), kind = "ridge",
                       radius = ring_radius, width = 4.5, n = c(24, 9), via = c("c b d", NA),
                       path = c(NA, "crest"))
  curves[names(list(...))] <- list(...)
  list(landmarks = data.frame(landmark = marks), curves = curves)
}
ring_scheme <- function(...) {
  tables <- ring_tables(...)
  curve_scheme(tables$landmarks, tables$curves, name = "ring")
}

test_that("routes are read, written and told", {
  scheme <- ring_scheme()
  expect_equal(scheme$curves$path, c("crest", "crest"))
  expect_equal(closed_curves(scheme$curves), c(TRUE, FALSE))
  dir <- tempfile("ring")
  on.exit(unlink(dir, recursive = TRUE))
  expect_equal(read_scheme(write_scheme(scheme, dir), "ring"), scheme)
  expect_output(print(scheme), "2 along a crest, of them 1 closed")
  # A closed curve's points are all its own; an open one ends at its landmarks.
  points <- scheme$points[scheme$points$level == "curves", ]
  expect_equal(points$place[c(1, 24)], c("curves|rim|1", "curves|rim|24"))
  expect_equal(points$place[c(25, 33)], c("landmarks|a", "landmarks|b"))
  expect_equal(face_scheme()$curves$path, rep("plane", 40))
})

test_that("a scheme without routes has the hash it had before there were any", {
  one <- face_scheme()
  expect_equal(scheme_hash(one), "f0a11001bd03105af36030cc9280593f")
  one$curves[c("path", "via")] <- NULL
  expect_equal(scheme_hash(one), scheme_hash(face_scheme()))
  expect_silent(validate(one))
})

test_that("mistakes of routes are named by row and column", {
  wrong <- function(text, ...) {
    expect_error(ring_scheme(...), text, class = "crestline_scheme_error")
  }
  wrong("row 1 \\(rim\\), column to: is the same landmark as from", via = NA)
  wrong("column via: there is no landmark \"x\"", via = c("x", NA))
  wrong("column via: names a, which is an end", via = c("b a", NA))
  wrong("column via: names a landmark twice", via = c("b b", NA))
  wrong("row 1 \\(rim\\), column path: is plane, but there is a via", path = c("plane", NA))
  wrong("row 2 \\(half\\), column path: is crest, but a plane curve", kind = c("ridge", "plane"))
  wrong("row 1 \\(rim\\), column trust_to", trust_to = c(0.5, NA))
  wrong("row 1 \\(rim\\), column n: is below 3", n = c(2, 9))
  wrong("row 2 \\(half\\), column angle_limit", angle_limit = c(NA, 1))
  wrong("column path: \"snake\" is none of", path = c("snake", NA))
})

test_that("closed curves of a scheme are measured", {
  ring <- ring_specimen()
  shape <- fit_shape(ring, ring_scheme(), progress = FALSE)
  expect_equal(shape$status$ok, rep(TRUE, 7))
  rim <- coords(shape, part = "rim")
  expect_lte(mean(off_ring(as.data.frame(rim))), 0.15)
  expect_equal(shape$status$length[shape$status$part == "rim"], 24 * pi, tolerance = 0.02)
  expect_lte(sqrt(sum((rim[1, ] - ring$landmarks["a", ])^2)), 0.3)
  ring$landmarks <- ring$landmarks[c("a", "b", "d"), ]
  lost <- suppressWarnings(fit_shape(ring, ring_scheme(), progress = FALSE))
  expect_match(lost$status$reason[lost$status$part == "rim"], "c")
  expect_false(lost$status$ok[lost$status$part == "rim"])
})

test_that("mirror images of closed curves keep their first point, and run by their stops", {
  expect_equal(mirrored_points(5, FALSE, TRUE), 1:5)
  expect_equal(mirrored_points(5, TRUE, TRUE), c(1, 5, 4, 3, 2))
  expect_equal(mirrored_points(3, TRUE, FALSE), 3:1)
  marks <- data.frame(landmark = c("m", "k", "pL", "pR", "qL", "qR", "rL", "rR"))
  pairs <- data.frame(level = c(rep("landmarks", 3), "curves"),
                      left = c("pL", "qL", "rL", "left"), right = c("pR", "qR", "rR", "right"))
  scheme <- function(via) {
    curves <- data.frame(curve = c("left", "right", "middle"), from = c("pL", "pR", "m"),
                         to = c("pL", "pR", "m"), kind = "ridge", radius = 1, width = 1, n = 5,
                         via = via)
    curve_scheme(marks, curves, pairs = pairs, name = "rims")
  }
  one <- scheme(c("qL", "qR", "k"))
  partner <- mirror_rows(one)[9:23] - 8
  expect_equal(partner, c(c(1, 5, 4, 3, 2) + 5, c(1, 5, 4, 3, 2), c(1, 5, 4, 3, 2) + 10))
  two <- scheme(c("qL rL", "qR rR", "qL qR"))
  partner <- mirror_rows(two)[9:23] - 8
  expect_equal(partner, c(6:10, 1:5, c(1, 5, 4, 3, 2) + 10))
  # Stops in the other order run the other way.
  against <- scheme(c("qL rL", "rR qR", "k"))
  expect_equal(mirror_rows(against)[9:13] - 8, c(1, 5, 4, 3, 2) + 5)
  expect_error(scheme(c("qL rL", "qR k", "k")), "no mirror image: via",
               class = "crestline_scheme_error")
})
