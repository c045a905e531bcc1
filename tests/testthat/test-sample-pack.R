# What is packed comes back: to the bit, or to 2^-40 of its range.

test_that("doubles, whole numbers and flags come back to the bit", {
  x <- c(pi, -1e300, 0, NA, 5e-324, 1)
  expect_identical(unpack_exact(pack_exact(x)), x)
  expect_identical(unpack_exact(pack_exact(numeric())), numeric())
  i <- c(3L, NA, 700000L, 1L, 1L)
  expect_identical(unpack_whole(pack_whole(i)), i)
  for (n in c(1, 8, 13)) {
    flags <- rep_len(c(TRUE, FALSE, FALSE), n)
    expect_identical(unpack_flags(pack_flags(flags), n), flags)
  }
})

test_that("doubles in five bytes come back to 2^-40 of their range, in any order", {
  set.seed(1)
  for (x in list(stats::runif(3000, -80, 170), c(0, 1, 0, 1, 0.5), 7, rep(7, 4), numeric())) {
    back <- unpack_fixed(pack_fixed(x))
    expect_length(back, length(x))
    expect_true(all(abs(back - x) <= 2^-40 * (max(x, -Inf) - min(x, Inf))) || !length(x))
  }
})

test_that("weights inside, on each edge, at corners and missing come back", {
  w <- rbind(c(0.2, 0.3, 0.5), c(0, 0.4, 0.6), c(0.4, 0, 0.6), c(0.4, 0.6, 0), c(1, 0, 0),
             c(0, 1, 0), c(0, 0, 1), NA, c(0.6, 0.1, 0.3))
  back <- unpack_weights(pack_weights(w))
  expect_equal(back, w, tolerance = 1e-11)
  expect_identical(back == 0, w == 0)
})

test_that("points come back with every bit of their co-ordinates, paths on their faces", {
  shape <- fit_shape(batch_specimens(1)[[1]], quad_scheme(), progress = FALSE)
  points <- unpack_points(pack_points(shape$points, shape$scheme), shape$scheme)
  xyz <- c("x", "y", "z", "face", "se")
  expect_identical(points[xyz], shape$points[xyz])
  expect_equal(points, shape$points, tolerance = 1e-11)
  paths <- c(lapply(shape$tracks, `[[`, "path"), shape$paths, list(none = NULL))
  back <- unpack_paths(pack_paths(paths))
  expect_equal(back, paths, tolerance = 1e-10)
  for (path in shape$paths) expect_silent(validate(path))
  expect_true(read_alike(paths, back))
  expect_identical(unpack_paths(pack_paths(list(a = NULL))), list(a = NULL))
})

test_that("what does not come back alike is noticed", {
  a <- data.frame(x = c(1, 2), y = c("a", "b"))
  expect_true(read_alike(a, a))
  for (b in list(a[2:1, ], transform(a, x = x + 1e-6), transform(a, y = "a"), as.list(a),
                 transform(a, x = c(1, NA)))) {
    expect_false(read_alike(a, b))
  }
})
