test_that("colours a vertex, a corner and a mesh all become one a vertex", {
  ball <- ball_mesh()
  n <- ncol(ball$vb)
  hex <- sprintf("#%06X", seq_len(n))
  colour <- function(value) vertex_colours(c(ball, list(material = list(color = value))))
  expect_equal(colour(hex), hex)
  expect_equal(colour(matrix(hex[ball$it], 3)), hex)
  expect_equal(colour("#123456"), rep("#123456", n))
  expect_null(colour(c("red", "blue")))
  expect_null(vertex_colours(ball))
})

test_that("an image is read from its lower left corner, repeats, and may be grey", {
  image <- array(0, c(2, 2, 3))
  image[1, 2, 1] <- 1
  expect_equal(sample_image(image, cbind(c(0.9, 0.1, 1.9, -0.1), c(0.9, 0.1, 0.9, -0.1))),
               c("#FF0000", "#000000", "#FF0000", "#FF0000"))
  expect_equal(sample_image(image, cbind(1, 1)), "#FF0000")
  expect_equal(sample_image(image[, , 1], cbind(1, 1)), "#FFFFFF")
})
