# Balls with a bump in front in the second group.
bumped_balls <- function(n = 8, bump = 0.1) {
  ball <- ball_mesh(3)
  xyz <- t(ball$vb[1:3, ])
  front <- exp(-8 * rowSums(sweep(xyz, 2, c(0, 0, 1))^2))
  balls <- with_seed(1, lapply(seq_len(2 * n), function(i) {
    xyz * (1 + 0.02 * rnorm(1) * xyz[, 1]^2 + 0.02 * rnorm(1) * xyz[, 2] + (i > n) * bump * front +
           rnorm(nrow(xyz),
                 sd = 0.003))
  }))
  aligned <- align(simplify2array(balls), "ball", triangles = ball$it)
  compare_groups(aligned, rep(c("A", "B"), each = n), n_perm = 199, seed = 1, progress = FALSE)
}

test_that("boxes show the groups' quartiles", {
  compared <- bumped_balls()
  drawn <- draw_quietly(plot(compared, components = 1:2))
  expect_length(drawn, 3)
  size <- compared$aligned$ball$size
  expect_equal(drawn[[1]]$stats[3, ], unname(c(median(size[1:8]), median(size[9:16]))))
  expect_match(names(drawn)[2], "PC1")
})

test_that("the map's colours and outline are where the bump is", {
  compared <- bumped_balls()
  pixels <- drawn_pixels(plot(compared, "map", engine = "picture", legend = FALSE,
                              main = "", gloss = 0))
  red <- pixels[, , 1] - pixels[, , 3]
  expect_gt(red[108, 100], 0.2)
  expect_lt(red[108, 40], 0.1)
  points <- compared$points
  found <- points$p_adjusted <= 0.05
  expect_lt(max(acos(pmin(1, points$z[found] / sqrt(rowSums(points[found, c("x", "y", "z")]^2))))),
            0.9)
  mesh <- points_mesh(as.matrix(points[c("x", "y", "z")]), compared$aligned$ball$triangles)
  lines <- level_lines(mesh, log(points$p_adjusted), log(0.05))
  expect_gt(nrow(lines), 3)
})

test_that("level lines are where a linear function has the value, on the mesh", {
  mesh <- grid_mesh(6)
  lines <- level_lines(mesh, mesh$vb[1, ] + 2 * mesh$vb[2, ], 3.3)
  ends <- lines[!is.na(lines[, 1]), ]
  expect_equal(ends[, 1] + 2 * ends[, 2], rep(3.3, nrow(ends)), tolerance = 1e-12)
  # From x = 3.3 to y = 1.65: as long as all segments together.
  length <-
    sum(sqrt(rowSums((lines[seq(1, nrow(lines), 3), ] - lines[seq(2, nrow(lines), 3), ])^2)))
  expect_equal(length, sqrt(3.3^2 + 1.65^2), tolerance = 1e-12)
  expect_equal(nrow(level_lines(mesh, mesh$vb[1, ], 99)), 0)
  expect_equal(nrow(level_lines(mesh, rep(NA_real_, 36), 1)), 0)
})

test_that("of two surfaces the nearer one has the greater share of the colour", {
  compared <- bumped_balls(bump = 0.3)
  colour <- c("#0000FF", "#FF0000")
  pixels <- drawn_pixels(plot(compared, "means", engine = "picture", legend = FALSE, main = "",
                              colour = colour, gloss = 0))
  middle <- pixels[108, 100, ]
  expect_equal(middle[1] / sum(middle), 0.8, tolerance = 0.05)
  side <- pixels[108, 45, ]
  expect_equal(side[3] / sum(side), 0.8, tolerance = 0.05)
  expect_equal(front_colours(c("#000000", "#FFFFFF"), 0.75), c("#404040", "#BFBFBF"))
})

test_that("both turn in rgl", {
  compared <- bumped_balls()
  with_null_rgl({
    scene <- plot(compared, "means", engine = "rgl")
    expect_length(scene$ids, 2)
    scene <- plot(compared, "map", engine = "rgl")
    expect_gte(length(scene$ids), 2)
  })
})

test_that("what cannot be drawn is refused", {
  data <- grouped_sample(c(4, 4))
  compared <- compare_groups(data$x, data$group, n_perm = 19, progress = FALSE,
                             settings = comparison_settings(components = 2))
  ball <- bumped_balls()
  expect_crestline_error(plot(ball, level = "curves"), "`level`")
  three <- compare_groups(ball$aligned, rep(1:4, 4), n_perm = 19, progress = FALSE,
                          settings = comparison_settings(tests = "points"))
  expect_crestline_error(plot(three, "means"), "4 groups")
  without <- compare_groups(ball$aligned, ball$group, n_perm = 19, progress = FALSE,
                            settings = comparison_settings(tests = "size"))
  expect_crestline_error(plot(without, "map"), "tests")
})

test_that("boxes without a test of size have no p-value in their title", {
  data <- grouped_sample(c(4, 4))
  compared <- compare_groups(data$x, data$group, n_perm = 19, progress = FALSE,
                             settings = comparison_settings(tests = "shape"))
  expect_null(p_value_of(compared, names(compared$aligned), NA))
  # Of a single component the picture has the p-value that print() has
  given <- list(tests = data.frame(level = "a", test = c("T2", "PC1"), p_value = 0.02,
                                   p_adjusted = c(0.02, 0.06)))
  expect_identical(p_value_of(given, "a", "PC1"), "adjusted p = 0.06")
  expect_identical(p_value_of(given, "a", "T2"), "p = 0.02")
})

test_that("boxes of whole blocks show the means of the blocks", {
  data <- grouped_sample(c(6, 6))
  person <- rep(1:6, each = 2)
  compared <- compare_groups(data$x, data$group, n_perm = 19, block = person, progress = FALSE,
                             settings = comparison_settings(components = 2))
  drawn <- plot(compared, components = 1)
  expect_equal(drawn[["centroid size"]]$n, c(3, 3))
})

test_that("levels without a surface are drawn as points: means of all groups, a map of two", {
  data <- grouped_sample(c(6, 6), effect = 0.5, sd = 0.02)
  rownames(data$x) <- paste("rim", 1:12)
  aligned <- align(data$x, "curves")
  compared <- compare_groups(aligned, data$group, n_perm = 99, seed = 1, progress = FALSE,
                             settings = comparison_settings(components = 2))
  means <- draw_quietly(plot(compared, "means"))
  expect_named(means, c("a", "b"))
  size <- mean(aligned$size)
  expect_equal(means$b, size * apply(aligned$coords[, , 7:12], 1:2, mean), ignore_attr = TRUE)
  map <- draw_quietly(plot(compared, "map", engine = "picture", length_unit = "mm"))
  expect_equal(map$displacement, compared$points$displacement)
  three <- compare_groups(aligned, rep(1:3, 4), n_perm = 19, progress = FALSE,
                          settings = comparison_settings(tests = "shape"))
  expect_length(draw_quietly(plot(three, "means")), 3)
  expect_crestline_error(plot(three, "map"), "3 groups")
  expect_equal(curve_rows(c("a 1", "a 2", "b c 1"), "curves"), list(a = 1:2, "b c" = 3))
})

test_that("a map holds what is asked", {
  p <- c(0.001, 0.04, 0.02, NA, 0.6)
  expect_equal(weighted_fdr(p, rep(1, 5)), p.adjust(p, "BH"))
  # Twice the weight is the point twice.
  expect_equal(weighted_fdr(p, c(1, 2, 1, 1, 1))[c(1, 2, 2, 3, 5)],
               p.adjust(p[c(1, 2, 2, 3, 5)], "BH"))
  expect_true(is.na(weighted_fdr(p, c(0, 1, 1, 1, 1))[1]))
  points <- data.frame(p_value = p, p_adjusted = 2 * p)
  expect_equal(held_p(points, "fwe", 1), 2 * p)
  expect_equal(held_p(points, "none", 1), p)
})

test_that("the title of a map counts the points that have a test", {
  compared <- bumped_balls()
  compared$points$p_adjusted[1:2] <- NA
  file <- tempfile(fileext = ".pdf")
  on.exit(unlink(file))
  grDevices::pdf(file, compress = FALSE, useKerning = FALSE)
  plot(compared, "map", engine = "picture")
  grDevices::dev.off()
  expect_match(readLines(file, warn = FALSE), sprintf(" of %d points", nrow(compared$points) - 2),
               all = FALSE, useBytes = TRUE)
})

test_that("the unit of a picture of a map is that of its key too", {
  compared <- bumped_balls()
  drawn <- function(...) {
    file <- tempfile(fileext = ".png")
    on.exit(unlink(file))
    write_picture(compared, file, what = "map", size = c(8, 6), dpi = 72, ruler = FALSE, ...)
    readBin(file, "raw", file.size(file))
  }
  cm <- drawn(unit = "cm")
  expect_identical(cm, drawn(length_unit = "cm"))
  expect_false(identical(cm, drawn()))
})
