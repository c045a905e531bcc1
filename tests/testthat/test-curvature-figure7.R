# The paper's Fig. 7: estimated and true curvature over the cross-section y = 0 of z = -x^2 and z =
# -x^3.

# Estimates at the vertices of the row y = 0 of a 41 x 41 grid over [-1, 1]^2; the curvature across
# is z'' / (1 + z'^2)^(3/2), the other 0.
figure7 <- function(height, slope, bend, order = "adaptive", radius = 0.5) {
  side <- seq(-1, 1, length.out = 41)
  at <- expand.grid(x = side, y = side)
  corner <- as.vector(outer(1:40, (0:39) * 41, `+`))
  faces <- cbind(rbind(corner, corner + 1, corner + 42), rbind(corner, corner + 42, corner + 41))
  mesh <- structure(list(vb = rbind(at$x, at$y, height(at$x), 1), it = faces), class = "mesh3d")
  row <- which(abs(at$y) < 1e-9)
  found <- curvature(mesh, radius, order = order, vertices = row)
  truth <- bend(side) / (1 + slope(side)^2)^1.5
  data.frame(x = side, k1 = found$k1[row], k2 = found$k2[row], true1 = pmax(truth, 0),
             true2 = pmin(truth, 0))
}

parabola <- function(...) {
  figure7(function(x) -x^2, function(x) -2 * x, function(x) rep(-2, length(x)), ...)
}
cubic <- function(...) figure7(function(x) -x^3, function(x) -3 * x^2, function(x) -6 * x, ...)

test_that("curvature of z = -x^2 and z = -x^3 follows the truth over the whole cross-section", {
  for (section in list(parabola(), cubic())) {
    scale <- max(abs(section$true1), abs(section$true2))
    expect_lt(max(abs(section$k1 - section$true1)), 0.03 * scale)
    expect_lt(max(abs(section$k2 - section$true2)), 0.03 * scale)
  }
})

test_that("the paper's forced quadratic has the parabola's top right, and is far off beside", {
  ours <- parabola()
  paper <- parabola(order = "forced")
  expect_equal(paper$k2[paper$x == 0], -2, tolerance = 0.01)
  error <- function(section) mean(abs(section$k2 - section$true2))
  expect_lt(error(ours), 0.2 * error(paper))
})
