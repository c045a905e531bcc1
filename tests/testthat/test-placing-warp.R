test_that("the nearest points in place and feature are those of a search of all", {
  with_seed(1, {
    unit <- function(x) x / rep(sqrt(colSums(x^2)), each = 3)
    from <- matrix(stats::runif(150, 0, 20), 3)
    to <- matrix(stats::runif(900, 0, 20), 3)
    own <- unit(matrix(stats::rnorm(150), 3))
    other <- unit(matrix(stats::rnorm(900), 3))
    feature <- matrix(stats::rnorm(100), 2)
    others <- matrix(stats::rnorm(600), 2)
  })
  found <- cpp_match_clouds(from, own, feature, to, other, others, 4, 0.2)
  for (i in seq_len(50)) {
    d2 <- colSums((to - from[, i])^2)
    all <- d2 + colSums((others - feature[, i])^2)
    all[d2 > 16 | colSums(other * own[, i]) < 0.2] <- Inf
    expect_equal(found$index[i], if (all(is.infinite(all))) NA_integer_ else which.min(all))
  }
  hit <- !is.na(found$index)
  expect_equal(found$distance[hit], sqrt(colSums((to[, found$index[hit]] - from[, hit])^2)))
})

test_that("a basis has the kernel's variance, and symmetric displacements are symmetric", {
  xyz <- as.matrix(expand.grid(seq(-40, 40, 10), seq(-40, 40, 10), c(0, 15)))
  settings <- find_settings(uneven = 0, affine = 0, rank = 600)
  basis <- warp_basis(xyz, nrow(xyz), TRUE, settings)
  partner <- match(paste(-xyz[, 1], xyz[, 2], xyz[, 3]), paste(xyz[, 1], xyz[, 2], xyz[, 3]))
  coefficients <- with_seed(2, stats::rnorm(sum(vapply(basis, ncol, 0L))))
  moved <- displaced(basis, coefficients)
  expect_equal(moved[partner, ], moved %*% diag(c(-1, 1, 1)), tolerance = 1e-6, ignore_attr = TRUE)
  own <- warp_basis(xyz, nrow(xyz), FALSE, settings)
  expect_equal(rowSums(own[[1]]^2), rep(sum(settings$length_scale_sd^2), nrow(xyz)),
               tolerance = 1e-3)
})

test_that("a template bent by a known displacement is bent back to it", {
  own <- landmark_template(specimen(humface_scan(), humface_landmarks()), ear_names, unit = 1)
  settings <- find_settings()
  prepared <- prepared_template(own, settings, 1)
  bend <- function(xyz) {
    xyz + cbind(3 * sin(xyz[, 2] / 40), 2 * cos(xyz[, 1] / 50), 2 * sin(xyz[, 1] / 45 + 1))
  }
  scan <- own$specimen$mesh
  scan$vb[1:3, ] <- t(bend(t(scan$vb[1:3, ])))
  cloud <- scan_cloud(specimen(scan), 1, prepared$settings)
  cloud <- with_curvature(cloud, prepared$settings, 1)
  bent <- fit_warp(prepared, cloud, prepared$settings, settings$weight)
  error <- row_lengths(bent$moved[-seq_len(ncol(prepared$xyz)), ] - bend(own$landmarks))
  expect_lt(mean(error), 0.6)
  expect_lt(mean(error), 0.25 * mean(row_lengths(bend(own$landmarks) - own$landmarks)))
})

test_that("the normal matrix of a displacement is that of its weighted equations", {
  with_seed(3, {
    basis <- lapply(c(5, 6, 7), function(size) matrix(rnorm(900 * size), 900))
    used <- sort(sample(900, 700))
    normal <- matrix(rnorm(3 * 700), 3)
    weight <- runif(700)
  })
  own <- lapply(basis, function(b) b[used, ])
  along_normal <- do.call(cbind, lapply(1:3, function(k) normal[k, ] * own[[k]]))
  expected <- crossprod(along_normal, 0.7 * weight * along_normal) +
    as.matrix(Matrix::bdiag(lapply(own, function(b) crossprod(b, 0.3 * weight * b))))
  expect_equal(cpp_warp_gram(basis, used, normal, weight, 0.3, 0.7), expected, tolerance = 1e-13)
})
