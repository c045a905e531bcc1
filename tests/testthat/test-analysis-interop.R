covered <- function() {
  x <- posed_sample(n = 16, sd = 0.1)
  dimnames(x) <- list(paste0("p", 1:12), c("x", "y", "z"), letters[1:16])
  list(x = x, data = data.frame(id = rev(letters[1:16]), sex = rep(c("F", "M"), 8), age = 16:1))
}

test_that("covariates follow the specimens' names", {
  one <- covered()
  frame <- as_geomorph(one$x, data = one$data)
  expect_s3_class(frame, "geomorph.data.frame")
  expect_equal(frame$age, 1:16)
  expect_equal(frame$coords, align(one$x)$coords)
  expect_equal(frame$size, align(one$x)$size)
  rows <- one$data
  rownames(rows) <- rows$id
  expect_equal(as_geomorph(one$x, data = rows[-1])$age, 1:16)
  expect_crestline_error(as_geomorph(one$x, data = one$data[-1, ]), "no row for p")
  nameless <- unname(one$x)
  turned <- data.frame(age = 16:1)[order(1:16 %% 2), , drop = FALSE]
  expect_equal(as_geomorph(nameless, data = turned)$age, turned$age)
  expect_crestline_error(as_geomorph(one$x, data = data.frame(size = 1:16)), "`size`")
  expect_crestline_error(as_geomorph(one$x, data = data.frame(a = 1:3)), "3 rows for 16")
})

test_that("RRPP's matrix has geomorph's order of columns", {
  one <- covered()
  frame <- as_rrpp(one$x, data = one$data)
  aligned <- align(one$x)
  expect_equal(frame$coords["c", ], as.vector(t(aligned$coords[, , "c"])), ignore_attr = TRUE)
  expect_equal(colnames(frame$coords)[1:4], c("p1 x", "p1 y", "p1 z", "p2 x"))
  skip_if_not_installed("geomorph")
  expect_equal(frame$coords, geomorph::two.d.array(aligned$coords), ignore_attr = TRUE)
})

test_that("geomorph and RRPP take them, and test as we do where both do", {
  skip_if_not_installed("geomorph")
  skip_if_not_installed("RRPP")
  one <- covered()
  frame <- as_geomorph(one$x, data = one$data)
  fit <- geomorph::procD.lm(coords ~ sex, data = frame, iter = 199, seed = 2)
  compared <- compare_groups(one$x, frame$sex, equal_spread = TRUE, progress = FALSE,
                             settings = comparison_settings(
                               permutations = RRPP:::perm.index(16, 199, seed = 2),
                               tests = "shape"))
  expect_equal(summary(fit)$table[1, "Pr(>F)"], compared$tests$p_value)
  expect_equal(summary(fit)$table[1, "Rsq"], compared$tests$share, tolerance = 1e-8)
  full <- RRPP::lm.rrpp(coords ~ log(size) + sex * age,
                        data = as_rrpp(one$x, data = one$data), iter = 19)
  expect_equal(nrow(anova(full)$table), 6)
  back <- as_aligned(geomorph::gpagen(one$x, print.progress = FALSE, tol = 0, PrinAxes = FALSE))
  expect_equal(dist(t(matrix(back$coords, 36))), dist(t(matrix(align(one$x)$coords, 36))),
               tolerance = 1e-6, ignore_attr = TRUE)
  expect_equal(unname(back$size), unname(align(one$x)$size))
})

test_that("Morpho takes them", {
  skip_if_not_installed("Morpho")
  one <- covered()
  ours <- as_morpho(one$x)
  theirs <- suppressMessages(Morpho::procSym(one$x, scale = FALSE, proctol = 1e-25))
  expect_equal(ours$eigenvalues, theirs$eigenvalues[seq_along(ours$eigenvalues)], tolerance = 1e-8)
  expect_equal(ours$rho, theirs$rho, tolerance = 1e-6)
  expect_lt(max(abs(apply(ours$rotated, 3, function(one) sum(one^2)) - 1)), 1e-10)
  expect_lt(apart(ours$rotated[, , 5], theirs$rotated[, , 5]), 1e-6)
  full <- suppressMessages(Morpho::procSym(one$x, proctol = 1e-25, tol = 1e-25))
  expect_equal(as_morpho(one$x, scale = "full")$rho, full$rho, tolerance = 1e-4)
  back <- as_aligned(theirs)
  expect_equal(shape_pca(back)$sdev^2, theirs$eigenvalues[seq_along(shape_pca(back)$sdev)],
               tolerance = 1e-8)
})

test_that("and back", {
  one <- covered()
  aligned <- align(one$x)
  back <- as_aligned(as_geomorph(aligned))
  expect_equal(back$coords, aligned$coords)
  expect_equal(back$mean, aligned$mean, tolerance = 1e-10)
  expect_equal(back$size, aligned$size)
  group <- rep(1:2, 8)
  expect_equal(compare_groups(back, group, n_perm = 19, seed = 1, progress = FALSE)$tests$p_value,
               compare_groups(aligned, group, n_perm = 19, seed = 1,
                              progress = FALSE)$tests$p_value)
  expect_equal(as_aligned(as_morpho(aligned))$coords, aligned$coords)
  kept <- as_aligned(align(one$x, scale = FALSE)$coords)
  expect_false(kept$scale)
  expect_equal(kept$size, aligned$size, tolerance = 1e-10)
  expect_false(as_aligned(list(coords = align(one$x, scale = FALSE)$coords,
                               size = aligned$size * (1 + 1e-12)))$scale)
  expect_true(back$scale)
  expect_crestline_error(as_aligned(list(1)), "`x`")
  expect_crestline_error(as_aligned(aligned$coords, size = 1), "`size`")
})

test_that("a key column of another name is found, and rows without the sample's names refused", {
  one <- covered()
  for (name in c("ID", "Specimen", "file name")) {
    expect_equal(as_geomorph(one$x, data = stats::setNames(one$data, c(name, "sex", "age")))$age,
                 1:16)
  }
  other <- replace(one$data$id, 3, "nobody")
  expect_crestline_error(as_geomorph(one$x, data = transform(one$data, id = other)),
                         c("no row for n", "nobody"))
  expect_crestline_error(as_geomorph(one$x, data = one$data[-1]),
                         c("no column of the specimens' names", "`id`"))
  expect_crestline_error(as_rrpp(one$x, data = rbind(one$data, transform(one$data[1, ], age = 99))),
                         "2 different rows for p")
  expect_warning(as_geomorph(one$x, data = transform(one$data, sex = replace(sex, 1, "f "))),
                 "differ by blanks or case",
                 class = "crestline_alike_groups")
})

test_that("sizes with names go to specimens by name", {
  aligned <- align(covered()$x)
  expect_equal(as_aligned(aligned$coords, size = rev(aligned$size))$size, aligned$size)
  other <- stats::setNames(aligned$size, LETTERS[11:26])
  expect_crestline_error(as_aligned(aligned$coords, size = other), "`size` has no value for a")
})

test_that("which points of a sample are handed over is said if no level is given", {
  shapes <- Map(function(east, id) {
    shape <- quad_shape(landmarks = quad_corners(east = east))
    shape$id <- id
    shape
  }, c(28, 29, 31), c("a", "b", "c"))
  sample <- suppressMessages(homologise(shapes, progress = FALSE))
  expect_message(as_rrpp(sample), "The 4 landmarks are taken. Give level = \"curves\" for 24")
  expect_message(as_morpho(sample), "4 landmarks")
  expect_no_message(as_geomorph(sample, "curves"))
  expect_no_message(as_geomorph(align(sample)))
  expect_crestline_error(as_geomorph(shapes[[1]]), "coords(shape, level)")
})
