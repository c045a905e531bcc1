test_that("every named view is a rotation that shows the side it says", {
  towards <- list(front = c(0, 0, 1), left = c(1, 0, 0), right = c(-1, 0, 0), below = c(0, -1, 0),
                  above = c(0, 1, 0), back = c(0, 0, -1))
  for (name in names(towards)) {
    rotation <- view_rotation(name)
    expect_equal(drop(rotation %*% towards[[name]]), c(0, 0, 1))
    expect_equal(det(rotation), 1)
  }
  expect_equal(view_rotation("front"), diag(3))
  expect_equal(drop(view_rotation("left") %*% c(0, 1, 0)), c(0, 1, 0))
  expect_equal(view_rotation(view_rotation("three-quarter")), view_rotation("three-quarter"))
})

test_that("the depth of a ball is that of a hemisphere, to a pixel and a facet", {
  scene <- draw_quietly(draw_surface(unit_ball(), engine = "picture"))
  seen <- which(is.finite(scene$depth), arr.ind = TRUE)
  x <- scene$usr[1] + (seen[, 2] - 0.5) * scene$pixel
  y <- scene$usr[4] - (seen[, 1] - 0.5) * scene$pixel
  inner <- x^2 + y^2 < 0.8
  expect_lt(max(abs(scene$depth[seen][inner] - sqrt(1 - x[inner]^2 - y[inner]^2))), 4 * scene$pixel)
  expect_equal(nrow(seen) * scene$pixel^2, pi, tolerance = 0.02)
})

test_that("points at the back and behind another sheet are hidden", {
  scene <- draw_quietly(draw_surface(unit_ball(), engine = "picture"))
  expect_identical(visible_points(scene,
                                  rbind(c(0, 0, 1), c(0, 0, -1), c(0, 0, 1.5), c(0, 0, 0.9),
                                        c(5, 0, 0), NA)),
                   c(TRUE, FALSE, TRUE, FALSE, FALSE, FALSE))
  from_left <- draw_quietly(draw_surface(unit_ball(), view = "left", engine = "picture"))
  expect_identical(visible_points(from_left, rbind(c(1, 0, 0), c(-1, 0, 0))), c(TRUE, FALSE))
})

test_that("triangles seen from behind are left out", {
  inside_out <- unit_ball()
  inside_out$it <- inside_out$it[c(1, 3, 2), ]
  scene <- draw_quietly(draw_surface(inside_out, engine = "picture"))
  middle <- scene$depth[nrow(scene$depth) %/% 2, ncol(scene$depth) %/% 2]
  expect_equal(middle, -1, tolerance = 0.01)
})

test_that("colours come through where the light is full, and darken away from it", {
  pixels <- drawn_pixels({
    graphics::par(mar = rep(0, 4))
    draw_surface(unit_ball(), "#FF0000", engine = "picture", light = c(0, 0, 1), gloss = 0,
                 wrap = 0, ambient = 0.2)
  })
  expect_equal(pixels[100, 100, ], c(1, 0, 0), tolerance = 0.02)
  expect_equal(pixels[100, 165, 1], 0.2 + 0.8 * sqrt(1 - (65.5 / 96)^2), tolerance = 0.05)
  expect_equal(pixels[2, 2, ], c(1, 1, 1))
})

test_that("one colour a vertex is interpolated", {
  ball <- unit_ball()
  halves <- ifelse(ball$vb[1, ] > 0, "#FF0000", "#0000FF")
  pixels <- drawn_pixels(draw_surface(ball, halves, engine = "picture",
                                      light = c(0, 0, 1), gloss = 0))
  row <- pixels[90, , ]
  expect_gt(sum(row[, 1] > row[, 3] + 0.3), 20)
  expect_gt(sum(row[, 3] > row[, 1] + 0.3), 20)
})

test_that("lines and points appear only where they are seen", {
  green <- function(at) {
    pixels <- drawn_pixels({
      scene <- draw_surface(unit_ball(), "#FFFFFF", engine = "picture")
      draw_points(scene, at, "#00FF00", size = 3)
    })
    sum(pixels[, , 2] > 0.9 & pixels[, , 1] < 0.1)
  }
  expect_gt(green(cbind(0, 0, 1)), 20)
  expect_identical(green(cbind(0, 0, -1)), 0L)
})

test_that("the scene is drawn on where it was, whatever the margins have become", {
  at <- draw_quietly({
    graphics::par(mar = rep(0, 4))
    scene <- draw_surface(unit_ball(), engine = "picture")
    graphics::par(mar = rep(3, 4))
    draw_lines(scene, cbind(0, 0, c(1, 1)))
    graphics::par("plt")
  })
  expect_true(at[1] > 0)
})

test_that("a part of the surface can be shown from near", {
  scene <- draw_quietly(draw_surface(unit_ball(), engine = "picture",
                                     around = rbind(c(-0.1, -0.1, 1), c(0.1, 0.1, 1)), margin = 0))
  expect_equal(max(scene$usr[2] - scene$usr[1], scene$usr[4] - scene$usr[3]), 0.2, tolerance = 0.2)
  expect_true(all(is.finite(scene$depth)))
})

test_that("runs of seen points are found", {
  expect_identical(runs_of(c(TRUE, TRUE, FALSE, TRUE)), list(1:2, 4L))
  expect_length(runs_of(c(FALSE, FALSE)), 0)
})

test_that("what cannot be drawn is refused", {
  ball <- unit_ball()
  expect_error(draw_surface(ball, c("red", "blue"), engine = "picture"), "2 values for",
               class = "crestline_error")
  expect_error(draw_surface(ball, view = "inside", engine = "picture"), class = "crestline_error")
  expect_error(draw_surface(ball, view = 1:3, engine = "picture"), class = "crestline_error")
  expect_error(draw_surface(ball, view = diag(c(1, 1, -1)), engine = "picture"),
               class = "crestline_error")
  expect_error(draw_surface(ball, engine = "picture", light = c(0, 0, 0)),
               class = "crestline_error")
  expect_error(draw_surface(ball, engine = "svg"), class = "crestline_error")
  expect_error(visible_points(list(), cbind(0, 0, 0)), class = "crestline_error")
  scene <- draw_quietly(draw_surface(ball, engine = "picture"))
  expect_error(draw_quietly(draw_lines(scene, 1:3)), class = "crestline_error")
  expect_output(print(scene), "pixels")
})
