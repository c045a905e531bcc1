stretched_balls <- function() {
  ball <- ball_mesh(2)
  balls <- lapply(1:7,
                  function(i) t(ball$vb[1:3, ]) %*% diag(c(0.8 + i / 20, 1 + (i %% 3) / 20, 1)))
  shape_pca(align(simplify2array(balls), "ball", triangles = ball$it))
}

test_that("scores and shapes are drawn", {
  pca <- stretched_balls()
  drawn <- draw_quietly(plot(pca, group = rep(1:2, c(3, 4))))
  expect_equal(drawn, pca$x[, 1:2])
  scenes <- draw_quietly(plot(pca, "shapes", sd = 2))
  expect_length(scenes, 2)
  expect_equal(scenes[[1]]$pixel, scenes[[2]]$pixel)
  expect_crestline_error(plot(pca, component = 99), "`component`")
})

test_that("the page has a slider a component, which holds the shapes at its ends", {
  skip_if_not_installed("htmltools")
  skip_if_not_installed("htmlwidgets")
  pca <- stretched_balls()
  file <- tempfile(fileext = ".html")
  on.exit(unlink(file))
  expect_identical(basename(write_pca_page(pca, file, 1:2, sd = 2)), basename(file))
  html <- paste(readLines(file, warn = FALSE), collapse = "\n")
  expect_length(gregexpr("type=\"range\" min=\"-2\" max=\"2\"", html, fixed = TRUE)[[1]], 2)
  expect_true(grepl("\"moves\":{\"by\":[", html, fixed = TRUE))
  expect_crestline_error(write_pca_page(pca, "x.txt"), "ends in .html")
})

test_that("a slider's ends are the shapes at the ends, of surfaces, curves and points", {
  pca <- stretched_balls()
  moving <- moving_parts(pca, 1, 2, "wheat")
  for (at in c(-2, 2)) {
    expect_equal(t(moving$mesh$vb[1:3, ]) + at * moving$by,
                 t(shape_at(pca, 1, at, "mesh")$vb[1:3, ]))
  }
  shapes <- simplify2array(lapply(1:6, function(i) cbind(0:4, (0:4)^2 * i / 10, i %% 2)))
  rownames(shapes) <- c(paste("arc", 1:3), paste("bow", 1:2))
  for (level in c("curves", "landmarks")) {
    of_points <- shape_pca(align(shapes, level))
    moving <- moving_parts(of_points, 1, 3, "wheat")
    by <- (shape_at(of_points, 1, 3) - shape_at(of_points, 1, 0)) / 3
    expect_equal(unique(round(moving$by, 9)), unique(round(by, 9)), ignore_attr = TRUE)
    middle <- rowsum(t(moving$mesh$vb[1:3, ]), match(data.frame(t(round(moving$by, 9))),
                                                     data.frame(t(round(by, 9)))))
    count <- table(match(data.frame(t(round(moving$by, 9))), data.frame(t(round(by, 9)))))
    expect_equal(unname(middle / as.vector(count)), unname(shape_at(of_points, 1, 0)),
                 tolerance = 1e-6, ignore_attr = TRUE)
  }
  scene <- plot(pca, "shapes", engine = "widget")
  expect_equal(drawn_layers(scene$drawn), c("-3 sd", "+3 sd"))
  expect_s3_class(plot(of_points, "shapes", engine = "widget"), "widget_scene")
})

test_that("scores have labels and ellipses, and shapes without a surface are drawn as points", {
  pca <- shape_pca(align(posed_sample(sd = 0.1)))
  drawn <- draw_quietly(plot(pca, group = rep(1:3, c(7, 6, 2)), labels = TRUE, ellipse = 0.9))
  expect_equal(drawn, pca$x[, 1:2])
  ends <- draw_quietly(plot(pca, "shapes", component = 2, sd = 1.5))
  expect_equal(ends[["+1.5 sd"]], shape_at(pca, 2, 1.5), ignore_attr = TRUE)
  xy <- with_seed(1, matrix(rnorm(60), 30) %*% rbind(c(2, 0), c(1, 0.5)))
  ring <- normal_ellipse(xy, 0.9)
  expect_equal(mahalanobis(ring, colMeans(xy), cov(xy)), rep(qchisq(0.9, 2), 100))
  expect_crestline_error(plot(pca, ellipse = 2), "`ellipse`")
})

test_that("few specimens have their names in a plot of scores, many have not", {
  words <- function(n) {
    file <- tempfile(fileext = ".pdf")
    on.exit(unlink(file))
    x <- grouped_sample(c(n, n))$x
    dimnames(x)[[3]] <- sprintf("face%02d", seq_len(2 * n))
    grDevices::pdf(file, compress = FALSE, useKerning = FALSE)
    plot(shape_pca(align(x)))
    grDevices::dev.off()
    sum(grepl("(face", readLines(file, warn = FALSE), fixed = TRUE, useBytes = TRUE))
  }
  expect_identical(words(10), 20L)
  expect_identical(words(11), 0L)
})
