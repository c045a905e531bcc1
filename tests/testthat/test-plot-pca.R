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
  expect_equal(lengths(regmatches(html, gregexpr("\"type\":\"vertexSetter\"", html))), 2)
  json <- regmatches(html, regexpr("\\{\"x\":\\{\"actions\".*?</script>", html, perl = TRUE))
  player <- jsonlite::fromJSON(sub("</script>$", "", json), simplifyVector = TRUE)$x
  expect_equal(player$value, 0)
  values <- player$actions$values
  if (is.list(values)) values <- values[[1]]
  first <- as.vector(t(shape_at(pca, 1, -2, "mesh")$vb[1:3, ]))
  expect_equal(as.vector(values[1, seq_along(first)]), first, tolerance = 1e-5)
  expect_crestline_error(write_pca_page(pca, "x.txt"), "ends in .html")
  expect_crestline_error(write_pca_page(shape_pca(align(posed_sample())), file), "triangles")
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
