test_that("ranges are read as written, and what is no range is not", {
  expect_equal(number_list("1, 3:5"), c(1L, 3L, 4L, 5L))
  expect_equal(number_list("3:1"), 3:1)
  for (wrong in c("", "a", "1:2:3", "1-3", "1,,2", "1.5")) expect_null(number_list(wrong))
  expect_equal(side_points("nose[3:1] + mid-line lip[2]"),
               data.frame(curve = c(rep("nose", 3), "mid-line lip"), point = c(3:1, 2L)))
  for (wrong in c("nose", "nose[]", "nose[1:]", "[1:2]", "nose[1:2]x", "a[1]+nose")) {
    expect_null(curve_parts(wrong))
  }
})

test_that("a block's points run by column, then row: columns as kept, rows as made", {
  block <- data.frame(patch = "blade", block = NA, columns = "2,4", rows = 4, rows_kept = "2:3")
  expect_equal(block_points(block),
               data.frame(part = "blade", point = c("1 2", "1 3", "2 2", "2 3"),
                          column = c(2, 2, 4, 4), row = c(2, 3, 2, 3)))
  expect_equal(block_points(transform(block, block = 7))$point[1], "7 1 2")
  expect_equal(block_points(transform(block, rows = 1, rows_kept = "1"))$point, c("1", "2"))
})

test_that("points that coincide by construction have one place", {
  points <- leaf_scheme()$points
  place <- function(level, part, point) {
    points$place[points$level == level & points$part == part & points$point == point]
  }
  expect_equal(place("curves", "edge left", "1"), "landmarks|base")
  expect_equal(place("curves", "edge right", "6"), place("landmarks", "tip", "1"))
  expect_equal(place("surface", "blade left", "1 1"), place("curves", "edge left", "2"))
  expect_equal(place("surface", "rib", "1"), "landmarks|base")  # resampled: the ends only
  expect_equal(place("surface", "rib", "2"), "surface|rib|2")
  expect_equal(place("surface", "blade left", "1 2"), "surface|blade left|1 2")
  expect_equal(c(table(points$level)), c(curves = 18, landmarks = 4, surface = 28))
})

test_that("a first column lies on its curve, at its own points where they are as many", {
  along <- function(parts) {
    leaf_scheme(function(x) {
      base <- x$curves[c(1, 1), ]
      base[c("curve", "to", "n")] <- data.frame(c("base left", "base right"),
                                                c("wideL", "wideR"), 4)
      x$curves <- rbind(x$curves, base)
      x$patches[1:2, c("columns", "n")] <- data.frame("1:5", c(15, 15))
      x$patches$first_column <- c(paste0("base left", parts), paste0("base right", parts), NA)
      x$pairs <- rbind(x$pairs,
                       data.frame(level = "curves", left = "base left", right = "base right"))
      x
    })$points
  }
  first <- function(points) {
    points$place[points$part == "blade left" & points$point %in% c("1 2", "1 3")]
  }
  expect_equal(first(along("[1:4]")), c("curves|base left|2", "curves|base left|3"))
  expect_equal(first(along("[4:1]")), c("curves|base left|3", "curves|base left|2"))
  expect_equal(first(along("[1:3]")), c("surface|blade left|1 2", "surface|blade left|1 3"))
})

test_that("the end that is cut off is not its landmark", {
  cut <- set_cell("curves", 1, c("cut_share", "cut_from", "cut_to"), list(2, "wideL", "wideR"))
  points <- leaf_scheme(cut)$points
  rib <- points$place[points$part == "midrib"]
  expect_equal(rib[c(1, 6)], c("curves|midrib|1", "landmarks|tip"))
})

test_that("surface points that go with a landmark are those that fit_shape() leaves out", {
  expect_equal(surface_without(face_scheme(), character(), character()), 0)
  specimen <- quad_specimen()
  for (gone in c("d", "b")) {
    at <- specimen$landmarks
    at[gone, ] <- NA
    bare <- specimen(specimen$mesh, at, outward = "keep")
    shape <- suppressWarnings(fit_shape(bare, quad_scheme(), progress = FALSE))
    own <- shape$scheme$curves
    lost <- sum(shape$points$level == "surface" & is.na(shape$points$x))
    expect_gt(lost, 0)
    cut <- own$curve[own$from == gone | own$to == gone]
    expect_equal(surface_without(shape$scheme, cut, gone), lost)
  }
})
