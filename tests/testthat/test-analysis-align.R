test_that("copies of one shape come back to it, whatever their pose and size", {
  x <- posed_sample(sd = 0)
  aligned <- align(x)
  expect_lt(max(abs(aligned$coords - as.vector(aligned$mean))), 1e-12)
  expect_equal(sqrt(sum(aligned$mean^2)), 1, tolerance = 1e-12)
  expect_equal(colSums(aligned$mean), c(x = 0, y = 0, z = 0), tolerance = 1e-12)
  sizes <- apply(x, 3, function(one) sqrt(sum(sweep(one, 2, colMeans(one))^2)))
  expect_equal(unname(aligned$size), sizes, tolerance = 1e-12)
  expect_equal(as.data.frame(aligned)$distance, rep(0, 15), tolerance = 1e-10)
})

test_that("the kernel's rotation is that of the singular value decomposition, flat shapes too", {
  for (seed in 1:5) {
    x <- posed_sample(8, 2, 0.3, seed)
    if (seed > 3) x[, 3, ] <- 0
    one <- cpp_align(x, dim(x), rep(1, 8), x[, , 2], 1, 0, 1)
    own <- superimposition(x[, , 1], x[, , 2], TRUE)(x[, , 1])
    expect_lt(apart(one$coords[1:24] |> matrix(8), own / sqrt(sum(sweep(own, 2, colMeans(own))^2))),
              1e-12)
  }
})

test_that("the mean is stationary: no shape gets nearer to it by turning, and it is their mean", {
  for (dim in 2:3) {
    aligned <- align(posed_sample(dim = dim, sd = 0.2), tangent = FALSE)
    mean <- apply(aligned$coords, 1:2, mean)
    expect_equal(mean / sqrt(sum(mean^2)), aligned$mean, tolerance = 1e-10)
    for (i in 1:15) {
      overlap <- crossprod(aligned$coords[, , i], aligned$mean)
      expect_lt(max(abs(overlap - t(overlap))), 1e-10)
    }
  }
})

test_that("projected shapes lie in the plane that touches at the mean", {
  aligned <- align(posed_sample(sd = 0.2))
  along <- apply(aligned$coords, 3, function(one) sum(one * aligned$mean))
  expect_equal(unname(along), rep(1, 15), tolerance = 1e-12)
  expect_equal(apply(aligned$coords, 1:2, mean), aligned$mean, tolerance = 1e-10)
})

test_that("mean and size are Morpho's", {
  skip_if_not_installed("Morpho")
  quiet <- function(...) suppressMessages(Morpho::procSym(..., proctol = 1e-25, tol = 1e-25))
  x <- posed_sample(k = 30, sd = 0.1)
  aligned <- align(x)
  theirs <- quiet(x, scale = FALSE)
  expect_lt(apart(aligned$mean, theirs$mshape), 1e-8)
  expect_equal(unname(aligned$size), unname(theirs$size), tolerance = 1e-12)
  # Their tangent co-ordinates, up to the pose.
  pca <- shape_pca(aligned)
  expect_equal(pca$sdev[1:14]^2, theirs$eigenvalues[1:14], tolerance = 1e-8)
  expect_lt(apart(align(x, scale = FALSE)$mean, quiet(x, scale = FALSE, CSinit = FALSE)$mshape),
            1e-8)
  # Their rounds of full scaling end early.
  expect_lt(apart(align(x, scale = "full")$mean, quiet(x)$mshape), 1e-5)
})

test_that("full scaling gives the principal axis of the turned shapes", {
  aligned <- align(posed_sample(sd = 0.3), scale = "full", tangent = FALSE)
  flat <- matrix(aligned$coords, 36)
  unit <- flat / rep(sqrt(colSums(flat^2)), each = 36)
  axis <- eigen(tcrossprod(unit), symmetric = TRUE)$vectors[, 1]
  expect_equal(abs(sum(axis * aligned$mean)), 1, tolerance = 1e-12)
  expect_equal(colSums(flat^2), drop(crossprod(unit, as.vector(aligned$mean)))^2, tolerance = 1e-10)
})

test_that("mean and size are geomorph's", {
  skip_if_not_installed("geomorph")
  x <- posed_sample(k = 30, sd = 0.02)
  # With PrinAxes = TRUE theirs may be the mirror image.
  theirs <- geomorph::gpagen(x, print.progress = FALSE, tol = 0, PrinAxes = FALSE)
  aligned <- align(x)
  expect_lt(apart(aligned$mean, theirs$consensus), 1e-8)
  expect_equal(unname(aligned$size), unname(theirs$Csize), tolerance = 1e-12)
  expect_equal(unclass(dist(t(matrix(aligned$coords, 90)))),
               unclass(dist(t(matrix(theirs$coords, 90)))), tolerance = 1e-8,
               ignore_attr = TRUE)
})

test_that("the answer does not depend on unit, pose and order", {
  x <- posed_sample()
  aligned <- align(x)
  turned <- posed_sample(sd = 0, seed = 5)
  moved <- x
  for (i in 1:15) moved[, , i] <- 1000 *
    sweep(x[, , i] %*% nearest_rotation(diag(3), qr.Q(qr(turned[1:3, , i])))$rotation, 2, i, `+`)
  expect_lt(apart(align(moved)$mean, aligned$mean), 1e-10)
  expect_equal(align(moved)$size, 1000 * aligned$size, tolerance = 1e-12)
  back <- align(x[, , 15:1])
  expect_lt(apart(back$mean, aligned$mean), 1e-10)
  rows <- align(x[12:1, , ])
  expect_lt(apart(rows$mean[12:1, ], aligned$mean), 1e-10)
})

test_that("weights: a point of weight 2 is a point that is there twice, of weight 0 none", {
  x <- posed_sample(sd = 0.2)
  twice <- align(x[c(1:12, 12), , ])
  weighted <- align(x, weights = c(rep(1, 11), 2))
  expect_lt(apart(twice$mean[1:12, ], weighted$mean * sqrt(12 / 13)), 1e-10)
  expect_equal(unname(twice$size^2) * 12 / 13, unname(weighted$size^2), tolerance = 1e-10)
  places <- array(x[c(1:12, 12), , ], c(13, 3, 15), list(c(letters[1:12], "l"), NULL, NULL))
  joined <- align(places, weights = "places")
  expect_equal(joined$weights, c(rep(13 / 12, 11), 13 / 24, 13 / 24))
  without <- align(x, weights = c(rep(1, 11), 0))
  expect_lt(apart(without$mean[1:11, ] * sqrt(12 / 11), align(x[1:11, , ])$mean), 1e-10)
})

test_that("areas are shared by the corners of triangles", {
  square <- cbind(c(0, 2, 2, 0), c(0, 0, 2, 2), 0)
  it <- cbind(c(1, 2, 3), c(1, 3, 4))
  expect_equal(point_areas(square, it), c(4, 2, 4, 2) / 3)
  x <- posed_sample(sd = 0.1)
  expect_equal(which(align(x, weights = "area", triangles = four_triangles())$weights > 0), 1:4)
})

test_that("missing points come back where a sample of affine images has them", {
  x <- with_seed(2, array(apply(array(stats::rnorm(9 * 10, sd = 0.2), c(3, 3, 10)), 3, function(a) {
    posed_sample(k = 12, n = 1, sd = 0, seed = 4)[, , 1] %*% (diag(3) + a)
  }), c(12, 3, 10)))
  gappy <- x
  gappy[2:4, , 3] <- NA
  gappy[9, 2, 7] <- NA
  aligned <- align(gappy)
  expect_equal(aligned$missing,
               data.frame(id = c("3", "3", "3", "7"), point = c("2", "3", "4", "9"),
                          action = "estimated"))
  expect_equal(unname(aligned$size), unname(align(x)$size), tolerance = 1e-6)
  expect_lt(apart(aligned$mean, align(x)$mean), 1e-6)
  expect_match(paste(capture.output(aligned), collapse = "\n"),
               "missing and estimated: 4 points of 3, 7")
})

test_that("in the plane too", {
  base <- cbind(c(0, 1, 1, 0, 0.4, 0.7, 0.2), c(0, 0, 1, 1, 0.3, 0.6, 0.8))
  x <- array(sapply(1:6, function(i) base %*% rbind(c(1, i / 10), c(0.1, 1 + i / 20))), c(7, 2, 6))
  gappy <- x
  gappy[6, , 2] <- NA
  expect_lt(apart(cbind(align(gappy)$mean, 0), cbind(align(x)$mean, 0)), 1e-6)
})

test_that("dropped points leave the triangles that need them", {
  x <- posed_sample()
  x[2, , 5] <- NA
  aligned <- align(x, missing = "drop", triangles = four_triangles())
  expect_equal(rownames(aligned$mean), as.character(c(1, 3:12)))
  expect_equal(aligned$triangles, cbind(c(1, 2, 3)), ignore_attr = TRUE)
  expect_equal(aligned$missing$action, "dropped")
  expect_equal(unname(aligned$coords), unname(align(x[-2, , ])$coords), tolerance = 1e-10)
})

test_that("a sample gives its levels, in the template's pose", {
  sample <- suppressWarnings(homologise(paired_sample(), progress = FALSE))
  for (level in c("model", "landmarks", "curves", "surface")) {
    aligned <- align(sample, level)
    expect_equal(dimnames(aligned$coords), dimnames(as.array(sample, level)))
    array <- align(as.array(sample, level))
    expect_lt(apart(aligned$mean, array$mean), 1e-10)
    if (level == "model") next
    template <- coords(sample$template, level)
    overlap <- crossprod(sweep(template, 2, colMeans(template)), aligned$mean)
    expect_equal(unname(overlap), unname(t(overlap)), tolerance = 1e-8)
  }
  model <- align(sample, "model")
  expect_equal(nrow(model$mean), length(unique(sample$template$scheme$points$place)))
  same <- align(as.array(sample, "landmarks"))
  places <- as.array(sample, "model")
  expect_lt(apart(align(places[grepl("^landmarks", rownames(model$mean)), , ])$mean, same$mean),
            1e-10)
  expect_equal(as.array(sample[[2]], "model")[, , 1], places[, , 2])
  expect_equal(unname(places[model$triangles, , ]),
               unname(as.array(sample, "surface")[aligned$triangles, , ]))
  mesh <- shape_at(shape_pca(aligned), 1, 0, "mesh")
  expect_equal(ncol(mesh$it), ncol(shape_mesh(sample$template)$it))
})

test_that("what cannot be aligned is refused", {
  x <- posed_sample()
  expect_crestline_error(align(x[, , 1]), "k x 3 x n")
  expect_crestline_error(align(x[, , 1, drop = FALSE]), "one specimen")
  expect_crestline_error(align(x, scale = 2), c("`scale`", "full"))
  same <- x
  same[, , 3] <- 1
  expect_crestline_error(align(same), "coincide", id = "3")
  same[1] <- Inf
  expect_crestline_error(align(same), "infinite")
  expect_crestline_error(align(x, weights = 1:3), "`weights`")
  expect_crestline_error(align(x, weights = "area"), "triangles")
  expect_crestline_error(align(x, triangles = diag(3)), "`triangles`")
  named <- array(x, dim(x), list(NULL, NULL, c(letters[1:14], "a")))
  expect_crestline_error(align(named), "\"a\"")
  x[1, , 2] <- NA
  expect_crestline_error(align(x, missing = "stop"), c("1 point missing", "of 2"))
  few <- x
  few[1:9, , 4] <- NA
  expect_crestline_error(align(few), "3 points only", id = "4")
  base <- posed_sample(n = 1)[, , 1]
  base[1:6, 3] <- 0
  flat <- array(base, c(12, 3, 5))
  flat[7:12, , 2] <- NA
  expect_crestline_error(align(flat), "in a plane", id = "2")
  nowhere <- x
  nowhere[3, , ] <- NA
  expect_crestline_error(align(nowhere, missing = "stop"), "points missing")
  expect_warning(align(posed_sample(sd = 0.5),
                       settings = align_settings(rounds = 1)), class = "crestline_not_converged")
})

test_that("points that every specimen lacks are left out, as if they had never been, and named", {
  x <- posed_sample()
  gone <- x
  gone[3, , ] <- NA
  expect_message(a <- align(gone), "1 point missing in every specimen, left out: 3")
  b <- align(x[-3, , ])
  expect_equal(unname(a$coords), unname(b$coords), tolerance = 1e-12)
  expect_equal(unname(a$size), unname(b$size), tolerance = 1e-12)
  expect_identical(unique(a$missing$action), "dropped")
  gone[1, , 2] <- NA
  both <- suppressMessages(align(gone))
  expect_setequal(both$missing$action, c("dropped", "estimated"))
  expect_output(print(both), "missing and dropped.*missing and estimated")
})

test_that("estimated points that still move after all rounds are said", {
  set.seed(4)
  mean <- matrix(rnorm(24), 8)
  given <- list(coords = replicate(6, mean + rnorm(24, sd = 0.1)))
  gap <- matrix(FALSE, 8, 6, dimnames = list(NULL, letters[1:6]))
  gap[cbind(c(1, 2, 5), 1:3)] <- TRUE
  given$coords[1, , 1] <- given$coords[2, , 2] <- given$coords[5, , 3] <- NA
  expect_warning(estimated(given, gap, rounds = 1), class = "crestline_not_converged")
  expect_warning(estimated(given, gap), NA)
})
