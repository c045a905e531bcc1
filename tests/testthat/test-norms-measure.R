# Measurements: closed forms on a ball, invariance, and errors against draws.

ball_shape <- function() {
  made <- argument_objects()
  made$shapes[[1]]
}

test_that("distances, angles, depths and ratios are those of the landmarks", {
  shape <- ball_shape()
  found <- measurements(shape, ball_measurements(), error = 1, draws = 50)
  at <- coords(shape, "landmarks")
  value <- stats::setNames(found$value, found$measurement)
  length_of <- function(x) sqrt(sum(x^2))
  expect_equal(value[["width"]], length_of(at["aL", ] - at["aR", ]))
  a <- at["aL", ] - at["n", ]
  b <- at["aR", ] - at["n", ]
  expect_equal(value[["corner"]], 180 / pi * acos(sum(a * b) / length_of(a) / length_of(b)))
  expect_equal(value[["index"]], value[["width"]] / value[["height"]])
  along <- (at["aR", ] - at["aL", ]) / length_of(at["aR", ] - at["aL", ])
  off <- at["n", ] - at["aL", ]
  expect_equal(value[["dent"]], length_of(off - sum(off * along) * along))
  expect_equal(found$unit, c("unit", "unit", "degrees", "1", "unit", "unit^2", "unit", "unit^3"))
  # A distance ends at two landmarks of standard error 1.
  expect_equal(found$se[1], sqrt(2), tolerance = 1e-6)
  expect_true(all(is.na(found$reason)))
})

test_that("lengths and areas are those of the shape's polylines and triangles", {
  shape <- ball_shape()
  found <- measurements(shape, ball_measurements(), draws = 0)
  value <- stats::setNames(found$value, found$measurement)
  arc <- function(part) sum(sqrt(rowSums(diff(coords(shape, "curves", part = part))^2)))
  expect_equal(value[["arc"]], arc("top") + arc("bottom"))
  mesh <- shape_mesh(shape)
  corner <- lapply(1:3, function(i) t(mesh$vb[1:3, mesh$it[i, ]]))
  cross <- cross_rows(corner[[2]] - corner[[1]], corner[[3]] - corner[[1]])
  expect_equal(value[["face"]], sum(sqrt(rowSums(cross^2))) / 2)
  expect_equal(found$reason[5], "no draws")
  expect_match(found$reason[1], "no standard error of its points: give .*`error`")
})

test_that("a pyramid's volume over its base is a third of area times height", {
  corner <- rbind(c(0, 0, 0), c(3, 0, 0), c(0, 4, 0), c(1, 1, 5))
  sides <- cbind(c(1, 2, 4), c(2, 3, 4), c(3, 1, 4))
  turn <- rotation_about(c(0.3, -1, 2))
  both <- array(c(corner, sweep(2 * corner %*% turn, 2, c(5, 6, 7), `+`)), c(4, 3, 2))
  expect_equal(volume_over(both, sides, 1:3), c(1, 8) * 6 * 5 / 3)
})

test_that("measurements do not change with the pose, and follow the size", {
  shape <- ball_shape()
  moved <- shape
  xyz <- as.matrix(shape$points[c("x", "y", "z")])
  moved$points[c("x", "y", "z")] <- as.data.frame(
    2 * sweep(xyz %*% rotation_about(c(1, 2, 3)), 2, c(9, 8, 7), `+`)
  )
  a <- measurements(shape, ball_measurements(), error = 1)
  b <- measurements(moved, ball_measurements(), error = 2)
  power <- c(unit = 1, degrees = 0, `1` = 0, `unit^2` = 2, `unit^3` = 3)[a$unit]
  expect_equal(b$value, unname(a$value * 2^power))
  plain <- a$kind %in% c("distance", "angle", "ratio", "depth")
  expect_equal(b$se[plain], unname(a$se * 2^power)[plain], tolerance = 1e-6)
})

test_that("a curve between landmarks follows its ends", {
  shape <- ball_shape()
  table <- data.frame(measurement = "arc", kind = "length", of = "side L")
  # The shortest cut changes by the ends' moves along it only: sqrt(2) of one.
  expect_equal(measurements(shape, table, error = 0.1, draws = 2000)$se, 0.1 * sqrt(2),
               tolerance = 0.06)
})

test_that("errors of neighbouring points of a curve go together", {
  shape <- ball_shape()
  own <- shape$points$level == "curves" & shape$points$part == "top"
  shape$points$se[own] <- c(0, rep(1, sum(own) - 2), 0)
  table <- data.frame(measurement = "arc", kind = "length", of = "top")
  se <- function(range) measurements(shape, table, error = 0, draws = 500, range = range)$se
  # Apart, they make a curve longer by zigzags, which a smooth error does not.
  expect_gt(se(0), 2 * se(100))
  expect_equal(se(20), se(20))
})

test_that("a sample gives a row for each shape, and what is missing says why", {
  made <- argument_objects()
  sample <- suppressWarnings(homologise(made$shapes[1:3], rounds = 1, progress = FALSE))
  found <- measurements(sample, ball_measurements(), draws = 0)
  expect_identical(unique(found$id), names(sample))
  expect_equal(nrow(found), 3 * 8)
  lost <- ball_shape()
  lost$points[lost$points$part == "n", c("x", "y", "z")] <- NA
  found <- measurements(lost, ball_measurements(), error = 1, draws = 0)
  expect_identical(found$reason[2], "points are missing: n")
  # The ratio lacks what its measurement lacks
  expect_identical(found$reason[4], "points are missing: n")
  expect_true(all(is.na(found$value[c(2, 3, 4, 7)])))
})

test_that("a batch gives the rows of its shapes, and names those that failed", {
  skip_without_futures()
  made <- argument_objects()
  dir <- tempfile("scans")
  dir.create(dir)
  on.exit(unlink(dir, recursive = TRUE))
  files <- file.path(dir, c("one.ply", "two.ply", "broken.ply"))
  for (i in 1:2) write_mesh(made$specimens[[i]]$mesh, files[i])
  writeLines("no mesh", files[3])
  marks <- lapply(made$specimens[c(1, 2, 2)], `[[`, "landmarks")
  batch <- suppressWarnings(fit_shapes(
    files, made$scheme, progress = FALSE, landmarks = stats::setNames(marks, c("one", "two",
                                                                              "broken"))
  ))
  expect_message(found <- measurements(batch, ball_measurements(), draws = 0),
                 "without 1 specimen that failed: broken")
  each <- lapply(as.list(batch)[c("one", "two")], measurements, ball_measurements(), draws = 0)
  expect_equal(found, do.call(rbind, unname(each)), ignore_attr = TRUE)
})

test_that("the table of the face fits its scheme; wrong tables are refused by name", {
  plan <- measurement_plan(face_measurements(), face_scheme())
  expect_length(plan, nrow(face_measurements()))
  shape <- ball_shape()
  table <- ball_measurements()
  table$of[1] <- "aL + xL"
  expect_crestline_error(measurements(shape, table), c("width", "xL"))
  table$of[1] <- "aL"
  expect_crestline_error(measurements(shape, table), c("width", "2 names"))
  expect_crestline_error(measurements(shape, ball_measurements()[4:1, ]), "above it")
  expect_crestline_error(measurements(shape, ball_measurements(), error = c(q = 1)), "\"q\"")
  expect_crestline_error(measurements(shape, data.frame(kind = 1)), "`measurement`")
})
