# Where the curvature of z = -b (x - a y^3)^2 is greatest.

test_that("curvature and direction are those of the symbolic forms", {
  a <- 0.4
  b <- 0.8
  form <- list(x = quote(u), y = quote(v), z = bquote(-.(b) * (u - .(a) * v^3)^2))
  x <- c(0.1, -0.4, 0.3, 0)
  y <- c(0.2, 0.7, -0.9, 0)
  exact <- exact_curvature(form, x, y)
  found <- simulated_curvature(a, b, x, y)
  expect_equal(found$k2, exact$k2)
  # The direction belongs to k2: normal to that of k1.
  along <- cbind(found$direction2,
                 rowSums(found$direction2 *
                         cbind(-2 * b * (x - a * y^3), 6 * a * b * (x - a * y^3) * y^2)))
  expect_lt(max(abs(rowSums(along * exact$direction1))), 1e-12)
})

test_that("on a straight ridge the locus of greatest curvature is the crest", {
  locus <- ridge_crest(0, 1, end = 0.95)
  expect_equal(locus[, "x"], numeric(401))
  expect_equal(range(locus[, "y"]), c(-0.95, 0.95))
})

test_that("beside a bent ridge curvature along its own direction is least on the locus", {
  for (case in list(c(0.25, 1), c(0.5, 2), c(0.25, 0.5))) {
    a <- case[1]
    b <- case[2]
    locus <- ridge_crest(a, b, end = 0.95)
    expect_equal(locus[, "z"], -b * (locus[, "x"] - a * locus[, "y"]^3)^2, tolerance = 1e-8)
    expect_equal(locus[401:1, 1:2], -locus[, 1:2])
    here <- simulated_curvature(a, b, locus[, "x"], locus[, "y"])
    for (step in c(-0.02, 0.02)) {
      there <- locus[, 1:2] + step * here$direction2
      expect_true(all(simulated_curvature(a, b, there[, 1], there[, 2])$k2 > here$k2))
    }
  }
})

test_that("the locus lies beside the crest the more the ridge is blunt, ends on very blunt", {
  aside <- function(a, b) {
    locus <- ridge_crest(a, b, end = 0.95)
    mean(abs(locus[, "x"] - a * locus[, "y"]^3))
  }
  expect_true(aside(0.5, 2) < aside(0.5, 1) && aside(0.25, 1) < aside(0.25, 0.5))
  expect_true(anyNA(ridge_crest(0.5, 0.25, end = 0.95)))
  expect_false(anyNA(ridge_crest(0.5, 0.25, end = 0.95)[191:211, ]))
  expect_identical(attr(simulate_ridge(0.5, 1, seed = 1, end = 0.8), "truth_curvature"),
                   ridge_crest(0.5, 1, 0.8))
})
