test_that("components are those of prcomp", {
  aligned <- align(posed_sample(sd = 0.1))
  pca <- shape_pca(aligned)
  theirs <- prcomp(t(matrix(aligned$coords, 36)))
  r <- seq_along(pca$sdev)
  expect_equal(length(r), 14)
  expect_equal(pca$sdev, theirs$sdev[r], tolerance = 1e-8)
  sign <- sign(colSums(pca$rotation * theirs$rotation[, r]))
  expect_equal(unname(pca$rotation), unname(theirs$rotation[, r]) %*% diag(sign), tolerance = 1e-6)
  expect_equal(unname(pca$x), unname(theirs$x[, r]) %*% diag(sign), tolerance = 1e-8)
  expect_equal(sum(pca$share), 1)
  expect_equal(pca$share, theirs$sdev[r]^2 / sum(theirs$sdev^2), tolerance = 1e-8)
  expect_s3_class(summary(pca), "summary.prcomp")
})

test_that("scores rise with size, or points move outward where they do not correlate", {
  aligned <- align(posed_sample())
  outward <- function(pca) {
    off <- scale(pca$mean, scale = FALSE)
    off <- off / sqrt(rowSums(off^2))
    apply(pca$rotation, 2, function(own) {
      move <- matrix(own, nrow(off))
      sum(rowSums(move * off) * rowSums(move^2))
    })
  }
  expect_true(all(cor(shape_pca(aligned, sized = 0)$x, aligned$size) > 0))
  expect_true(all(outward(shape_pca(aligned, sized = 1)) > 0))
  pca <- shape_pca(aligned)
  along <- cor(pca$x, aligned$size)
  expect_true(all(along[abs(along) >= 0.4] > 0))
  expect_true(all(outward(pca)[abs(along) < 0.4] > 0))
})

test_that("a point that moves outward gives its component's sign, whoever is left out", {
  x <- posed_sample(k = 10, n = 12, sd = 0)
  base <- with_seed(1, matrix(rnorm(30), 10))
  step <- with_seed(2, rnorm(12, sd = 0.2))
  for (i in 1:12) {
    x[, , i] <- base + with_seed(100 + i, rnorm(30, sd = 0.01))
    x[1, , i] <- x[1, , i] + step[i] * base[1, ] / sqrt(sum(base[1, ]^2))
  }
  same <- vapply(1:12, function(i) {
    part <- shape_pca(align(x[, , -i]), sized = 1)
    cor(part$x[, 1], step[-i])
  }, 0)
  expect_gt(min(same), 0.9)
})

test_that("a few of many components are those of the whole decomposition", {
  aligned <- align(posed_sample(k = 20, n = 80, sd = 0.1))
  whole <- shape_pca(aligned)
  few <- shape_pca(aligned, components = 3)
  expect_equal(few$sdev, whole$sdev[1:3], tolerance = 1e-8)
  expect_equal(few$share, whole$share[1:3], tolerance = 1e-8)
  expect_equal(few$x, whole$x[, 1:3], tolerance = 1e-6)
  expect_equal(few$rotation, whole$rotation[, 1:3], tolerance = 1e-6)
  expect_equal(shape_pca(aligned, components = 40)$sdev, whole$sdev[1:40])
})

test_that("more specimens than co-ordinates", {
  aligned <- align(posed_sample(k = 4, n = 60, sd = 0.1))
  pca <- shape_pca(aligned)
  theirs <- prcomp(t(matrix(aligned$coords, 12)))
  expect_equal(length(pca$sdev), 5)
  expect_equal(pca$sdev, theirs$sdev[1:5], tolerance = 1e-8)
})

test_that("all components together give a specimen back", {
  aligned <- align(posed_sample(sd = 0.1), weights = c(0, 2, rep(1, 10)))
  pca <- shape_pca(aligned)
  scores <- pca$x[3, ] / pca$sdev
  expect_equal(shape_at(pca, seq_along(scores), scores), aligned$coords[, , 3], tolerance = 1e-8)
  expect_equal(unname(cor(pca$x)), diag(length(scores)), tolerance = 1e-8)
  expect_equal(apply(pca$x, 2, sd), pca$sdev, tolerance = 1e-8, ignore_attr = TRUE)
})

test_that("a weighted component is that of points repeated", {
  x <- posed_sample(sd = 0.1)
  aligned <- align(x)
  weighted <- shape_pca(aligned, weights = c(rep(1, 10), 3, 1))
  repeated <- aligned
  rows <- c(1:12, 11, 11)
  repeated$coords <- aligned$coords[rows, , ]
  repeated$mean <- aligned$mean[rows, ]
  repeated$weights <- rep(1, 14)
  theirs <- shape_pca(repeated)
  # Weights of mean 1 share 14 repeats among 12 points.
  expect_equal(weighted$sdev^2, theirs$sdev^2 * 12 / 14, tolerance = 1e-8)
  expect_equal(abs(weighted$x), abs(theirs$x) * sqrt(12 / 14), tolerance = 1e-8)
})

test_that("a known direction is found, and shapes along it", {
  base <- posed_sample(n = 1, sd = 0)[, , 1]
  base <- sweep(base, 2, colMeans(base))
  base <- base / sqrt(sum(base^2))
  # Orthogonal to moves, turns and scaling, so that alignment changes it in second order only.
  nuisance <- cbind(as.vector(base), kronecker(diag(3), rep(1, 12)),
                    as.vector(base %*% rbind(c(0, 1, 0), c(-1, 0, 0), 0)),
                    as.vector(base %*% rbind(c(0, 0, 1), 0, c(-1, 0, 0))),
                    as.vector(base %*% rbind(0, c(0, 0, 1),
                                             c(0, -1, 0))))
  direction <- qr.resid(qr(nuisance), with_seed(1, rnorm(36)))
  direction <- direction / sqrt(sum(direction^2))
  at <- seq(-0.01, 0.01, length.out = 9)
  aligned <- align(array(sapply(at, function(t) base + t * direction), c(12, 3, 9)))
  pca <- shape_pca(aligned)
  expect_gt(pca$share[1], 0.999)
  turned <- laid_onto(base, aligned$mean, FALSE)
  expect_equal(abs(pca$x[, 1]), abs(at), tolerance = 1e-3, ignore_attr = TRUE)
  away <- shape_at(pca, 1, 2) - shape_at(pca, 1, -2)
  expect_equal(sqrt(sum(away^2)), 4 * sd(at), tolerance = 1e-3)
  expect_equal(shape_at(pca, 1, 0, size = 3), 3 * aligned$mean, tolerance = 1e-10)
})

test_that("shapes as meshes have the triangles' points", {
  aligned <- align(posed_sample(sd = 0.1), triangles = four_triangles() + 2)
  pca <- shape_pca(aligned)
  mesh <- shape_at(pca, 2, -1, "mesh")
  expect_equal(attr(mesh, "row"), 3:6)
  expect_equal(t(mesh$vb[1:3, ]), shape_at(pca, 2, -1)[3:6, ], ignore_attr = TRUE)
  expect_equal(mesh$it, four_triangles(), ignore_attr = TRUE)
})

test_that("what cannot be done is refused", {
  pca <- shape_pca(align(posed_sample()))
  expect_crestline_error(shape_pca(1), "align()")
  expect_crestline_error(shape_at(pca, 99), "`component`")
  expect_crestline_error(shape_at(pca, 1:2, 1:3), "`sd`")
  expect_crestline_error(shape_at(pca, as = "mesh"), "triangles")
  expect_match(paste(capture.output(pca), collapse = "\n"), "15 specimens, 12 points.*PC1")
  expect_equal(as.data.frame(pca)$cumulative, cumsum(pca$share))
})

test_that("weights of a shape_pca() have mean 1, and points that coincide can count as one", {
  aligned <- align(posed_sample(sd = 0.1))
  expect_equal(shape_pca(aligned, rep(2, 12))$sdev, shape_pca(aligned)$sdev)
  expect_crestline_error(shape_pca(aligned, c(1, 1)), "weights")
  aligned$places <- c("one", "one", paste("place", 3:12))
  expect_equal(shape_pca(aligned, "places")$sdev, shape_pca(aligned, c(0.5, 0.5, rep(1, 10)))$sdev)
})

test_that("a sample is aligned on the way, in memory, in files, or as an array", {
  parts <- c("x", "sdev", "rotation", "mean", "size", "laid", "level")
  balls <- Map(paired_shape, list(c(1, 1, 1), c(1.2, 1, 1.1), c(1, 1.1, 1)), c("a", "b", "c"))
  sample <- suppressWarnings(homologise(unname(balls), rounds = 1, progress = FALSE))
  expect_silent(own <- shape_pca(sample, level = "curves"))
  expect_identical(own[parts], shape_pca(align(sample, "curves"))[parts])
  expect_message(plain <- shape_pca(sample), "landmarks are taken.*level = \"curves\"")
  expect_identical(plain[parts], shape_pca(align(sample))[parts])
  x <- posed_sample(k = 10, n = 12)
  expect_identical(shape_pca(x)[parts], shape_pca(align(x))[parts])
  expect_identical(shape_pca(x, weights = c(2, rep(1, 9)))[parts],
                   shape_pca(align(x), weights = c(2, rep(1, 9)))[parts])
  expect_crestline_error(shape_pca(sample, level = "curve"), "`level`")
  expect_crestline_error(shape_pca(x[, , 1]), "`aligned`")
  skip_if_not_installed("nanoparquet")
  dir <- tempfile("blocks-")
  on.exit(unlink(dir, recursive = TRUE))
  files <- write_blocks(named_array(x), dir, 7)
  expect_equal(abs(shape_pca(files)$x), abs(shape_pca(x)$x), tolerance = 1e-8, ignore_attr = TRUE)
})
