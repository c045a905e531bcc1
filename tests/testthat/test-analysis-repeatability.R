# Values of one variable as measurements of one point.
as_points <- function(y) array(rbind(y, 0, 0), c(1, 3, length(y)), list("p 1", NULL, NULL))

# Shrout and Fleiss (1979), table 2: six targets, four judges.
judged <- rbind(c(9, 2, 5, 8), c(6, 1, 3, 2), c(8, 4, 6, 8), c(7, 1, 2, 6), c(10, 5, 6, 9),
                c(6, 2, 4, 7))

test_that("published intra-class correlations are found again", {
  target <- row(judged)
  judge <- col(judged)
  one <- repeatability(as_points(as.vector(judged)), target, match = "none")$parts
  two <- repeatability(as_points(as.vector(judged)), target, judge, match = "none")$parts
  expect_equal(round(one$icc[1], 2), 0.17)
  expect_equal(round(two$icc[1], 2), 0.29)
  # Mean squares of their table 3: between targets 11.24, judges 32.49, residual 1.02.
  expect_equal(two$residual[1]^2, 1.02, tolerance = 0.005)
  expect_equal(two$specimen[1]^2, (11.24 - 1.02) / 4, tolerance = 0.005)
  expect_equal(two$observer[1]^2, (32.49 - 1.02) / 6, tolerance = 0.005)
  expect_true(is.na(two$interaction[1]))
})

test_that("components are those of the balanced analysis of variance, a point's mean", {
  set.seed(1)
  design <- expand.grid(again = 1:2, observer = 1:3, specimen = 1:7)
  draw <- function(n) matrix(rnorm(n * 12), n)
  y <- draw(42) + 2 * draw(7)[design$specimen, ] + draw(3)[design$observer, ]
  y <- y + draw(21)[interaction(design$specimen, design$observer), ]
  squares <- apply(y, 2, function(v) {
    summary(aov(v ~ factor(specimen) * factor(observer), design))[[1]][["Mean Sq"]]
  })
  positive <- function(x) pmax(x, 0)
  expected <- rbind(specimen = positive(squares[1, ] - squares[3, ]) / 6,
                    observer = positive(squares[2, ] - squares[3, ]) / 14,
                    interaction = positive(squares[3, ] - squares[4, ]) / 2,
                    residual = squares[4, ])
  found <- variance_components(y, factor(design$specimen), factor(design$observer))
  # Where one is below 0 it counts as 0, the others stay.
  expect_equal(found, expected, ignore_attr = TRUE)
  coords <- array(t(y), c(4, 3, 42), list(c("a 1", "a 2", "b 1", "b 2"), NULL, NULL))
  result <- repeatability(coords, design$specimen, design$observer, match = "none")
  by_point <- t(apply(array(expected, c(4, 4, 3)), c(1, 2), sum))
  expect_equal(result$points$residual, sqrt(by_point[, 4]))
  expect_equal(result$parts$specimen,
               sqrt(c(mean(by_point[1:2, 1]), mean(by_point[3:4, 1]), mean(by_point[, 1]))))
  expect_equal(result$parts$icc[3], sum(by_point[, 1]) / sum(by_point))
  expect_equal(result$parts$error,
               sqrt(result$parts$observer^2 + result$parts$interaction^2 + result$parts$residual^2))
})

test_that("unequal numbers of repeats give the closed form of one way", {
  set.seed(2)
  specimen <- rep(1:5, c(2, 3, 4, 2, 6))
  y <- rnorm(17) + 3 * rnorm(5)[specimen]
  squares <- anova(lm(y ~ factor(specimen)))[["Mean Sq"]]
  n0 <- (17 - sum(table(specimen)^2) / 17) / 4
  found <- repeatability(as_points(y), specimen, match = "none")$parts
  expect_equal(found$specimen[1]^2, (squares[1] - squares[2]) / n0)
  expect_equal(found$residual[1]^2, squares[2])
})

test_that("estimates of unbalanced crossed designs are right on average", {
  set.seed(3)
  design <- expand.grid(observer = 1:4, specimen = 1:12)[-c(1, 6, 11, 20, 33), ]
  true <- c(4, 1, 0.25)
  draw <- function(n, k) matrix(rnorm(n * 400, 0, sqrt(true[k])), n)
  y <- draw(12, 1)[design$specimen, ] + draw(4, 2)[design$observer, ] + draw(nrow(design), 3)
  found <- variance_components(y, factor(design$specimen), factor(design$observer))[c(1, 2, 4), ]
  # Truncation at 0 is rare here; 400 draws.
  expect_lt(max(abs(rowMeans(found) - true) / (apply(found, 1, sd) / 20)), 4)
})

test_that("measurements that repeat exactly have no error; shared frames do not count", {
  set.seed(4)
  own <- replicate(4, matrix(rnorm(30), 10))
  specimen <- rep(1:4, each = 3)
  coords <- own[, , specimen]
  rownames(coords) <- paste("c", 1:10)
  for (i in 1:4) {
    turn <- qr.Q(qr(matrix(rnorm(9), 3)))
    turn <- turn * det(turn)
    for (j in which(specimen == i)) coords[, , j] <- sweep(coords[, , j] %*% turn, 2, i * 10, `+`)
  }
  noise <- array(rnorm(360, sd = 0.01), dim(coords))
  exact <- repeatability(coords, specimen)
  expect_lt(max(exact$parts$error), 1e-10)
  expect_equal(exact$parts$icc, c(1, 1))
  # The error is that of a point in its specimen's frame, by whatever pose: 80 degrees of freedom a
  # co-ordinate.
  noisy <- repeatability(coords + noise, specimen)
  expect_equal(noisy$parts$error[2], 0.01 * sqrt(3), tolerance = 0.15)
  within <- apply(coords + noise, 1:2, function(v) sum(tapply(v, specimen, var)) / 4)
  expect_equal(noisy$points$error, sqrt(unname(rowSums(within))))
  # Laid by itself, each measurement loses a little error to its frame.
  each <- repeatability(coords + noise, specimen, match = "each")
  expect_lt(each$parts$error[2], noisy$parts$error[2])
  expect_gt(each$parts$error[2], 0.7 * noisy$parts$error[2])
})

test_that("of one specimen there is the error alone: that among observers", {
  set.seed(6)
  coords <- array(rnorm(120), c(4, 3, 10), list(c("a 1", "a 2", "b 1", "b 2"), NULL, NULL))
  alone <- repeatability(coords, rep("only", 10), match = "none")
  expect_equal(alone$points$error, unname(sqrt(rowSums(apply(coords, 1:2, var)))))
  expect_equal(alone$parts$error[3], sqrt(mean(alone$points$error^2)))
  expect_true(all(is.na(alone$parts$icc)) && all(is.na(alone$parts$specimen)))
  expect_output(print(alone), "10 measurements of 1 specimen")
  expect_gt(sum(drawn_pixels(plot(alone), 600, 400)[, 1:300, 1] -
                drawn_pixels(plot(alone), 600, 400)[, 1:300, 3] > 0.3), 50)
  turning <- plot(alone, engine = "widget")
  expect_equal(unname(turning$drawn$points[[1]]$xyz), as.matrix(alone$points[c("x", "y", "z")]),
               ignore_attr = TRUE)
  expect_length(turning$drawn$lines, 2)
  # The frame is the one of the specimen: as they lie.
  expect_equal(repeatability(coords, rep("only", 10))$parts$error, alone$parts$error)
  observer <- rep(1:5, 2)
  found <- repeatability(coords, rep("only", 10), observer, match = "none")
  squares <- apply(coords, 1:2, function(v) anova(lm(v ~ factor(observer)))[["Mean Sq"]])
  expect_equal(found$points$residual, unname(sqrt(rowSums(squares[2, , ]))))
  expect_equal(found$points$observer,
               unname(sqrt(rowSums(pmax(squares[1, , ] - squares[2, , ], 0) / 2))))
})

test_that("points that some measurement lacks are left out and named", {
  coords <- array(rnorm(90), c(5, 3, 6), list(paste("a", 1:5), NULL, NULL))
  coords[2, , 3] <- NA
  found <- repeatability(coords, rep(1:3, 2))
  expect_equal(found$missing, "a 2")
  expect_equal(found$parts$points, c(4, 4))
  expect_output(print(found), "left out, missing somewhere: a 2")
})

test_that("what cannot be estimated is said", {
  coords <- array(rnorm(36), c(3, 3, 4))
  expect_crestline_error(repeatability(coords, 1:4), "measured twice")
  expect_crestline_error(repeatability(coords, c(1, 1, 2, 2), rep(1, 4)), "one observer")
  expect_crestline_error(repeatability(coords, 1:3), "`specimen`")
  expect_crestline_error(repeatability(matrix(1, 3, 3), 1:3), "`shapes`")
  coords[] <- NA
  expect_crestline_error(repeatability(coords, c(1, 1, 2, 2)), "no point")
})

test_that("print and plot fit, and the table is there", {
  set.seed(5)
  names <- paste(rep(paste("some curve of the face", 1:10), each = 2), 1:2)
  coords <- array(rnorm(600), c(20, 3, 10), list(names, NULL, NULL))
  found <- repeatability(coords, rep(1:5, 2), rep(1:2, each = 5))
  shown <- capture.output(print(found))
  expect_lte(max(nchar(shown)), 100)
  expect_lte(length(shown), 16)
  expect_identical(as.data.frame(found), found$parts)
  drawn <- drawn_pixels(plot(found), 600, 400)
  # Both halves have colours of errors (red above blue).
  coloured <- drawn[, , 1] - drawn[, , 3] > 0.3
  expect_gt(sum(coloured[, 1:300]), 50)
  expect_gt(sum(coloured[, 301:600]), 50)
})

test_that("a design whose components cannot be told apart is refused", {
  y <- matrix(rnorm(24), 12)
  nested <- list(factor(rep(1:6, each = 2)), factor(rep(c("A", "B"), each = 6)))
  expect_crestline_error(variance_components(y, nested[[1]], nested[[2]]),
                         c("told apart", "observer"))
})

test_that("measurements that failed are left out, counted and named; the rest is as without", {
  skip_if_not_installed("Rvcg")
  shape <- quad_shape()
  moved <- function(i) {
    shape$points[c("x", "y", "z")] <- shape$points[c("x", "y", "z")] +
      with_seed(i, rnorm(3 * nrow(shape$points), sd = i))
    shape
  }
  shapes <- c(lapply(1:4, moved), list(NULL), lapply(5:6, moved))
  names(shapes) <- paste0("scan", 1:7)
  specimen <- c("a", "a", "b", "b", "b", "c", "c")
  expect_warning(found <- repeatability(shapes, specimen),
                 "1 of 7 measurements failed and is left out: scan5",
                 class = "crestline_failed_measurements")
  whole <- repeatability(shapes[-5], specimen[-5])
  expect_identical(found$parts, whole$parts)
  expect_equal(unname(found$counts[c("measurements", "failed")]), c(6, 1))
  expect_identical(found$failed, "scan5")
  expect_output(print(found), "not measured, left out: scan5")
  expect_warning(short <- repeatability(shapes, specimen[-5]),
                 class = "crestline_failed_measurements")
  expect_identical(short$parts, whole$parts)
  expect_warning(repeatability(unname(shapes), specimen), "left out: 5",
                 class = "crestline_failed_measurements")
  expect_length(whole$failed, 0)
  expect_equal(unname(whole$counts["failed"]), 0)
  # A batch, as fit_shapes() returns it.
  batch <- structure(shapes, files = vector("list", 7), class = "shape_batch")
  expect_warning(of_batch <- repeatability(batch, specimen), "scan5",
                 class = "crestline_failed_measurements")
  expect_identical(of_batch$parts, whole$parts)
})

test_that("specimens and observers with names go to measurements by name", {
  x <- array(with_seed(4, rnorm(60)), c(5, 3, 4), list(paste("p", 1:5), NULL, paste0("m", 1:4)))
  x[, , 1:2] <- x[, , 1:2] + 5
  expected <- suppressMessages(repeatability(x, c("A", "A", "B", "B"), match = "none"))
  expect_equal(repeatability(x, c(m4 = "B", m1 = "A", m3 = "B", m2 = "A"), match = "none"),
               expected)
  expect_equal(repeatability(x, data.frame(id = c("m4", "m1", "m3", "m2"),
                                           of = c("B", "A", "B", "A")), match = "none"), expected)
  expect_crestline_error(repeatability(x, c(m4 = "B", m1 = "A", m3 = "B", other = "A")),
                         c("no value for m2", "other"))
  expect_crestline_error(repeatability(x, c("A", "a", "B", "B")), "differ by blanks or case only")
})

test_that("landmarks are parts of their own, and no line joins them", {
  x <- array(with_seed(4, rnorm(60)), c(5, 3, 4), list(paste("LM", 1:5), NULL, paste0("m", 1:4)))
  specimen <- c(m1 = "A", m2 = "A", m3 = "B", m4 = "B")
  # Pixels of the right panel that are not white: points, and lines between them.
  drawn <- function(found) sum(drawn_pixels(plot(found), 800, 400)[, 440:700, 1] < 1)
  landmarks <- repeatability(x, specimen, level = "landmarks")
  expect_identical(landmarks$parts$part, c(paste("LM", 1:5), "all"))
  expect_equal(landmarks$parts$error[1:5], landmarks$points$error)
  expect_message(curve <- repeatability(x, specimen), "LM (5 points)", fixed = TRUE)
  expect_silent(again <- repeatability(x, specimen, level = "curves"))
  expect_identical(again, curve)
  expect_identical(curve$parts$part, c("LM", "all"))
  expect_gt(drawn(curve), drawn(landmarks) + 100)
  # Without names they are landmarks: nothing says that they lie on a curve.
  expect_length(repeatability(unname(x), unname(specimen))$parts$part, 6)
  expect_crestline_error(repeatability(x, specimen, level = "curve"), "`level`")
  expect_length(joined_points(landmarks), 0)
  expect_length(joined_points(curve), 1)
})
