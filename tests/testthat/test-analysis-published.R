# Data sets of other packages: what their functions find, found again.

package_data <- function(name, package) {
  skip_if_not_installed(package)
  space <- new.env()
  utils::data(list = name, package = package, envir = space)
  as.list(space)
}

gorillas <- function() {
  each <- c(package_data("gorf.dat", "shapes"), package_data("gorm.dat", "shapes"))
  list(x = array(c(each$gorf.dat, each$gorm.dat), c(8, 2, 59)), sex = rep(c("f", "m"), c(30, 29)))
}

# Sums of squares of a balanced design, summed over all co-ordinates.
crossed_squares <- function(y, a, b) {
  squares <- function(...) {
    cell <- interaction(..., drop = TRUE)
    means <- rowsum(y, cell) / as.vector(table(cell))
    sum(table(cell) * rowSums(sweep(means, 2, colMeans(y))^2))
  }
  each <- c(squares(a), squares(b))
  c(each, squares(a, b) - sum(each), sum(sweep(y, 2, colMeans(y))^2))
}

test_that("gorillas (shapes): mean, components and Hotelling's test", {
  gorilla <- gorillas()
  theirs <- shapes::procGPA(gorilla$x)
  aligned <- align(gorilla$x, scale = "full", tangent = FALSE)
  flat <- function(x) cbind(unname(x), 0)
  both <- superimposition(flat(aligned$mean), flat(theirs$mshape), TRUE)(flat(aligned$mean))
  expect_lt(max(abs(both - flat(theirs$mshape))) / sqrt(sum(theirs$mshape^2)), 1e-5)
  expect_equal(unname(aligned$size), theirs$size, tolerance = 1e-10)
  expect_equal(100 * shape_pca(aligned)$share[1:5], theirs$percent[1:5], tolerance = 1e-4)
  compared <- compare_groups(gorilla$x, gorilla$sex, equal_spread = TRUE, n_perm = 199, seed = 1,
                             progress = FALSE,
                             settings = comparison_settings(components = 12,
                                                            tests = c("size", "T2", "shape")))
  expect_equal(as.vector(tapply(compared$aligned[[1]]$size, gorilla$sex, mean)),
               c(mean(shapes::centroid.size(gorilla$x[, , 1:30])),
                 mean(shapes::centroid.size(gorilla$x[, , 31:59]))), tolerance = 1e-10)
  # Dryden and Mardia give F = 26.47 on 12 and 46 degrees of freedom.
  t2 <- compared$tests$statistic[compared$tests$test == "T2"]
  expect_equal(t2 * 46 / (12 * 57), 26.47, tolerance = 1e-4)
  expect_equal(t2 * 46 / (12 * 57),
               shapes::testmeanshapes(gorilla$x[, , 1:30], gorilla$x[, , 31:59], resamples = 0)$H,
               tolerance = 2e-3)
})

test_that("skulls (Morpho's boneData): mean, sizes and components of their example", {
  bones <- package_data("boneData", "Morpho")$boneLM
  theirs <- suppressMessages(Morpho::procSym(bones))
  aligned <- align(bones, scale = "full")
  expect_lt(apart(aligned$mean, theirs$mshape), 1e-5)
  expect_equal(aligned$size, theirs$size, tolerance = 1e-12)
  expect_equal(100 * shape_pca(aligned)$share[1:10], unname(theirs$Variance[1:10, 2]),
               tolerance = 1e-4)
  exact <- suppressMessages(Morpho::procSym(bones, scale = FALSE, proctol = 1e-25))
  expect_lt(apart(align(bones)$mean, exact$mshape), 1e-8)
  # Its skulls are of two populations, which differ, and two sexes.
  population <- substr(dimnames(bones)[[3]], 12, 13)
  compared <- compare_groups(bones, population, equal_spread = TRUE, n_perm = 199, seed = 1,
                             progress = FALSE,
                             settings = comparison_settings(tests = c("shape", "T2")))
  expect_lt(max(compared$tests$p_value), 0.01)
})

test_that("pupfish (geomorph): the table of variance of their example", {
  skip_if_not_installed("RRPP")
  pupfish <- package_data("pupfish", "geomorph")$pupfish
  aligned <- as_aligned(pupfish$coords, pupfish$CS)
  frame <- as_geomorph(aligned, data = data.frame(Pop = pupfish$Pop, Sex = pupfish$Sex))
  theirs <- anova(geomorph::procD.lm(coords ~ Pop * Sex, data = pupfish, iter = 99))$table
  ours <- anova(geomorph::procD.lm(coords ~ Pop * Sex, data = frame, iter = 99))$table
  expect_equal(ours, theirs, tolerance = 1e-12)
  expect_equal(round(theirs$SS[1:4], 6), c(0.008993, 0.015917, 0.003453, 0.027970))
  compared <- compare_groups(aligned, pupfish$Sex, equal_spread = TRUE, n_perm = 19,
                             progress = FALSE, settings = comparison_settings(tests = "shape"))
  one <- anova(geomorph::procD.lm(coords ~ Sex, data = pupfish, iter = 9))$table
  expect_equal(compared$tests$share, one$Rsq[1], tolerance = 1e-10)
  # Aligned anew, their aligned shapes stay as they are.
  expect_lt(apart(cbind(align(pupfish$coords)$mean, 0), cbind(aligned$mean, 0)), 1e-4)
})

test_that("scallops (geomorph): the table of object symmetry of their example", {
  skip_if_not_installed("RRPP")
  scallops <- package_data("scallops", "geomorph")$scallops
  frame <- geomorph::geomorph.data.frame(shape = scallops$coorddata, ind = scallops$ind)
  theirs <- geomorph::bilat.symmetry(A = shape, ind = ind, object.sym = TRUE,
                                     land.pairs = scallops$land.pairs, data = frame, iter = 9,
                                     print.progress = FALSE)
  partner <- seq_len(46)
  partner[scallops$land.pairs] <- scallops$land.pairs[, 2:1]
  # As theirs: aligned, then once more together with the reflections.
  first <- align(scallops$coorddata)$coords
  mirrored <- first[partner, , ]
  mirrored[, 1, ] <- -mirrored[, 1, ]
  aligned <- align(array(c(first, mirrored), c(46, 3, 10)))
  flat <- t(matrix(aligned$coords, 138))
  squares <- crossed_squares(flat, rep(1:5, 2), rep(1:2, each = 5))
  expect_equal(squares, theirs$shape.anova$SS[1:4], tolerance = 1e-6)
  expect_lt(apart(symmetric_mean(aligned$mean, partner, "mean"), aligned$mean), 1e-8)
  # The symmetric part of one specimen, and the distance between its sides.
  for (i in 1:5) {
    own <- scallops$coorddata[, , i]
    symmetric <- symmetric_mean(own, partner, "one")
    size <- sqrt(sum(sweep(symmetric, 2, colMeans(symmetric))^2))
    expect_lt(apart(symmetric / size,
                    theirs$symm.shape[, , i] / sqrt(sum(theirs$symm.shape[, , i]^2))), 1e-3)
  }
})

test_that("plethodon, pupfish (geomorph) and gorillas: models with size as a covariate", {
  skip_if_not_installed("RRPP")
  agree <- function(coords, size, formula, data, ss = "I") {
    aligned <- as_aligned(coords, size)
    y <- t(matrix(aligned$coords, length(aligned$mean)))
    frame <- do.call(RRPP::rrpp.data.frame, c(list(y = y, size = unname(aligned$size)), data))
    theirs <- anova(RRPP::lm.rrpp(update(formula, y ~ .), data = frame, iter = 199, seed = 1,
                                  SS.type = ss, print.progress = FALSE))$table
    orders <- RRPP:::perm.index(length(aligned), 199, seed = 1)
    rows <- data.frame(id = names(aligned), data)
    ours <- shape_lm(aligned, formula, rows, settings = model_settings(
      tests = "shape", permutations = orders, ss = ss
    ))$tests
    k <- seq_len(nrow(ours))
    expect_equal(ours$squares, theirs$SS[k], tolerance = 1e-10)
    expect_equal(ours$statistic, theirs$F[k], tolerance = 1e-10)
    expect_lt(max(abs(ours$z - theirs$Z[k])), 1e-8)
    expect_equal(ours$p_value, theirs[k, 7])
    ours
  }
  numbered <- function(x) `dimnames<-`(x, list(NULL, NULL, paste0("s", seq_len(dim(x)[3]))))
  plethodon <- package_data("plethodon", "geomorph")$plethodon
  fit <- geomorph::gpagen(numbered(plethodon$land), print.progress = FALSE)
  data <- list(species = plethodon$species, site = plethodon$site)
  plain <- agree(fit$coords, fit$Csize, ~ species * site, data)
  expect_equal(round(plain$statistic, 3), c(14.544, 32, 15.353))
  agree(fit$coords, fit$Csize, ~ log(size) + species * site, data)
  pupfish <- package_data("pupfish", "geomorph")$pupfish
  data <- list(Sex = pupfish$Sex, Pop = pupfish$Pop)
  coords <- numbered(pupfish$coords)
  size <- unname(pupfish$CS)
  # As tutorials of these data print it, aligned anew there.
  known <- agree(coords, size, ~ log(size) + Sex + Pop, data)
  expect_equal(round(known$share, 3), c(0.249, 0.135, 0.136))
  expect_equal(known$statistic, c(25.926, 14.086, 14.169), tolerance = 1e-3)
  agree(coords, size, ~ log(size) + Sex * Pop, data, "II")
  gorilla <- gorillas()
  aligned <- align(numbered(gorilla$x))
  agree(aligned$coords, aligned$size, ~ log(size) * sex, list(sex = gorilla$sex))
})

test_that("gorillas (shapes) with size as a covariate: squares and F of lm()", {
  gorilla <- gorillas()
  dimnames(gorilla$x) <- list(NULL, NULL, paste0("s", 1:59))
  aligned <- align(gorilla$x)
  rows <- data.frame(id = names(aligned), sex = gorilla$sex)
  ours <- shape_lm(aligned, ~ log(size) + sex, rows, n_perm = 199, seed = 1,
                   settings = model_settings(tests = "shape"))$tests
  y <- t(matrix(aligned$coords, 16))
  left <- vapply(list(y ~ 1, y ~ log(aligned$size), y ~ log(aligned$size) + gorilla$sex),
                 function(formula) sum(resid(lm(formula))^2), 0)
  expect_equal(ours$squares, -diff(left), tolerance = 1e-10)
  expect_equal(ours$statistic, -diff(left) / (left[3] / 56), tolerance = 1e-10)
  # Most of the difference of the sexes goes with size.
  alone <- shape_lm(aligned, ~ sex, rows, n_perm = 199, seed = 1,
                    settings = model_settings(tests = "shape"))$tests
  expect_gt(alone$share, 4 * ours$share[2])
})
