# Symmetric and asymmetric parts of a sample by linear models, closed forms and geomorph.

# Six points: two pairs and two of the mid-line.
mirrored_sample <- function(n = 12, directional = 0, sd = 0.03, seed = 1) {
  base <- rbind(aL = c(1, 0, 0), aR = c(-1, 0, 0), bL = c(0.7, 1, 0.4), bR = c(-0.7, 1, 0.4),
                m = c(0, 2, 0), o = c(0, -1, 0.5))
  x <- with_seed(seed,
                 array(base, c(6, 3, n),
                       list(rownames(base), c("x", "y", "z"), paste0("s", seq_len(n)))) +
                   stats::rnorm(18 * n, sd = sd))
  x["aL", 2, ] <- x["aL", 2, ] + directional
  x
}
two_pairs <- rbind(c("aL", "aR"), c("bL", "bR"))

test_that("symmetric parts are symmetric, and both parts add up to the shape", {
  x <- mirrored_sample(directional = 0.1)
  parts <- symmetry_parts(x, pairs = two_pairs, n_perm = 19)
  partner <- c(2, 1, 4, 3, 5, 6)
  for (one in parts$symmetric$points) {
    reflected <- one[partner, ] %*% diag(c(-1, 1, 1))
    expect_lt(apart(reflected, one), 1e-8)
  }
  whole <- parts$symmetric$points$coords + parts$asymmetric$points$coords -
    as.vector(apply(parts$symmetric$points$coords, 1:2, mean))
  raw <- align(x, tangent = FALSE)
  for (i in 1:3) expect_lt(apart(whole[, , i] / sqrt(sum(whole[, , i]^2)), raw[[i]]), 0.01)
})

test_that("sums of squares and F are those of a linear model of shapes and reflections", {
  x <- mirrored_sample(16, directional = 0.05)
  person <- rep(letters[1:8], each = 2)
  parts <- symmetry_parts(x, pairs = two_pairs, individual = person, n_perm = 99, seed = 1)
  s <- parts$symmetric$points$coords
  middle <- apply(s, 1:2, mean)
  off <- parts$asymmetric$points$coords - as.vector(middle)
  y <- rbind(t(matrix(s + off, 18)), t(matrix(s - off, 18)))
  data <- data.frame(ind = factor(rep(person, 2)), side = gl(2, 16))
  left <- function(formula) sum(qr.resid(qr(model.matrix(formula, data)), y)^2)
  rss <- c(left(~ 1), left(~ ind), left(~ ind + side), left(~ ind * side))
  expect_equal(parts$tests$squares, c(-diff(rss), rss[4]), tolerance = 1e-8)
  expect_equal(parts$tests$df, c(7, 1, 7, 16))
  ms <- parts$tests$squares / parts$tests$df
  expect_equal(parts$tests$statistic, c(ms[1] / ms[3], ms[2] / ms[3], ms[3] / ms[4], NA))
})

test_that("directional asymmetry is found where it is, at its level where it is not", {
  found <- symmetry_parts(mirrored_sample(directional = 0.1), pairs = two_pairs, seed = 1)
  expect_lt(found$tests$p_value[2], 0.01)
  p <- vapply(1:40, function(seed) {
    symmetry_parts(mirrored_sample(seed = seed), pairs = two_pairs, n_perm = 99,
                   seed = 1)$tests$p_value[2]
  }, 0)
  expect_lt(mean(p <= 0.05), 0.2)
  expect_gt(mean(p), 0.35)
  expect_gt(found$directional$points["aL", 2], 0)
})

test_that("fluctuating asymmetry is told from error of measurement", {
  people <- mirrored_sample(10, sd = 0.05)[, , rep(1:10, each = 2)]
  people <- people + with_seed(2, rnorm(length(people), sd = 0.01))
  dimnames(people)[[3]] <- paste0("m", 1:20)
  person <- rep(1:10, each = 2)
  expect_lt(symmetry_parts(people, pairs = two_pairs, individual = person,
                           seed = 1)$tests$p_value[3], 0.01)
  noise <- mirrored_sample(20)
  expect_gt(symmetry_parts(noise, pairs = two_pairs, individual = person,
                           seed = 1)$tests$p_value[3], 0.05)
})

test_that("answers do not depend on pose and unit; parts go into tests", {
  x <- mirrored_sample(directional = 0.05)
  turn <- with_seed(3, qr.Q(qr(matrix(rnorm(9), 3))))
  turn <- turn * det(turn)
  moved <- array(apply(x, 3, function(one) 40 * one %*% turn + 3), dim(x), dimnames(x))
  a <- symmetry_parts(x, pairs = two_pairs, n_perm = 49, seed = 1)
  b <- symmetry_parts(moved, pairs = two_pairs, n_perm = 49, seed = 1)
  expect_equal(b$tests, a$tests, tolerance = 1e-6)
  expect_equal(b$specimens$asymmetry, 40 * a$specimens$asymmetry, tolerance = 1e-6)
  group <- stats::setNames(gl(2, 6), names(a$symmetric$points))
  expect_s3_class(compare_groups(a$asymmetric, group, n_perm = 19,
                                 settings = comparison_settings(components = 2)),
                  "group_comparison")
  expect_s3_class(shape_pca(a$symmetric$points), "shape_pca")
  expect_output(print(a), "directional")
})

test_that("a sample's scheme pairs its points at every level", {
  made <- argument_objects()
  sample <- suppressWarnings(homologise(made$shapes, progress = FALSE))
  parts <- suppressWarnings(symmetry_parts(sample, c("landmarks", "curves", "surface"),
    n_perm = 19))
  expect_equal(names(parts$symmetric), c("landmarks", "curves", "surface"))
  # These balls are symmetric but for sampling.
  expect_lt(max(parts$specimens$asymmetry), 1)
  expect_error(symmetry_parts(as.array(sample, "curves")), "`pairs`", class = "crestline_error")
})

test_that("sums of squares and F are those of geomorph's bilat.symmetry()", {
  skip_if_not_installed("geomorph")
  x <- mirrored_sample(16, directional = 0.05)
  first <- geomorph::gpagen(x, Proj = FALSE, print.progress = FALSE)
  person <- rep(letters[1:8], each = 2)
  theirs <- geomorph::bilat.symmetry(first, ind = person, replicate = rep(1:2, 8),
                                     object.sym = TRUE, land.pairs = rbind(c(1, 2), c(3, 4)),
                                     iter = 19, print.progress = FALSE)
  ours <- symmetry_parts(x, pairs = two_pairs, individual = person, n_perm = 19)$tests
  expect_equal(ours$df, theirs$shape.anova$Df[1:4])
  expect_equal(ours$squares, theirs$shape.anova$SS[1:4], tolerance = 1e-5)
  expect_equal(ours$statistic[1:3], theirs$shape.anova$F[1:3], tolerance = 1e-5)
})

test_that("few individuals have all exchanges of sides", {
  expect_warning(
    found <- symmetry_parts(mirrored_sample(5, directional = 0.3), pairs = two_pairs),
    "below 0.062", class = "crestline_few_permutations"
  )
  expect_equal(found$tests$p_value[2], 1 / 16)
  expect_output(print(found), "all 16 exchanges of sides")
})
