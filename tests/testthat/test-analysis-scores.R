# Scores of shapes by what the sample is, in any pose.

noisy <- function(n = 20, k = 12, seed = 1) {
  with_seed(seed, {
    x <- array(matrix(stats::rnorm(3 * k), k), c(k, 3, n))
    x[] <- x + stats::rnorm(length(x), sd = 0.05)
  })
  dimnames(x) <- list(paste0("p", seq_len(k)), c("x", "y", "z"), paste0("s", seq_len(n)))
  x
}

test_that("specimens of the sample get their own scores in any pose, unit and alignment", {
  x <- noisy()
  turn <- with_seed(3, qr.Q(qr(matrix(rnorm(9), 3))))
  turn <- turn * det(turn)
  for (scale in list(TRUE, FALSE, "full")) for (weights in list(NULL, 1:12)) {
    for (tangent in c(TRUE, FALSE)) {
      pca <- shape_pca(align(x, scale = scale, weights = weights, tangent = tangent))
      unit <- if (isFALSE(scale)) 1 else 25
      moved <- array(apply(x, 3, function(one) unit * one %*% turn + 7), dim(x), dimnames(x))
      found <- predict(pca, moved)
      expect_lt(max(abs(found - pca$x)), 1e-10)
      expect_lt(max(attr(found, "outside")), 1e-10)
    }
  }
  flat <- x[, 1:2, ]
  pca <- shape_pca(align(flat))
  expect_lt(max(abs(predict(pca, flat) - pca$x)), 1e-10)
})

test_that("a new shape has the scores of its place, and points are matched by name", {
  x <- noisy()
  pca <- shape_pca(align(x))
  at <- shape_at(pca, 1:2, c(2, -1))
  found <- predict(pca, at[12:1, ])
  expect_equal(unname(found[1, 1:2] / pca$sdev[1:2]), c(2, -1), tolerance = 0.02)
  expect_error(predict(pca, at[-1, ]), "p1 missing", class = "crestline_error")
  expect_identical(predict(pca), pca$x)
  flat <- t(matrix(align(x)$coords, 36))
  expect_equal(unname(predict(pca, flat)), unname(pca$x), tolerance = 1e-10)
})

test_that("missing points are estimated, and said", {
  x <- noisy()
  pca <- shape_pca(align(x))
  one <- x[, , 4]
  one[5, ] <- NA
  expect_message(found <- predict(pca, one), "1 of 1", class = "crestline_message")
  expect_lt(sqrt(sum((found[1, ] - pca$x[4, ])^2)), 3 * sqrt(sum(pca$sdev^2)))
})

test_that("a shape must be slid against the sample's own template", {
  made <- argument_objects()
  sample <- suppressWarnings(homologise(made$shapes, progress = FALSE))
  pca <- shape_pca(suppressWarnings(align(sample, "curves")))
  expect_lt(max(abs(predict(pca, sample) - pca$x)), 1e-10)
  expect_lt(max(abs(predict(pca, sample[["s2"]]) - pca$x["s2", ])), 1e-10)
  expect_error(predict(pca, made$shapes[[1]]), "was not slid", class = "crestline_error")
  other <- slide(made$shapes[[1]], symmetrise(made$shapes[[2]]), specimen = made$specimens[[1]])
  expect_error(predict(pca, other), "another template", class = "crestline_error")
})
