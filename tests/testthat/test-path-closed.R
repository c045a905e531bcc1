closed_ring <- function(ring, via, from = "a", ...) {
  ridge_curve(ring, from, from, "ridge", radius = ring_radius, width = 4.5, n = 24, via = via, ...)
}

test_that("a closed curve goes once round, and begins at its place nearest to its landmark", {
  ring <- ring_specimen()
  curve <- closed_ring(ring, "b")
  expect_true(curve$closed)
  expect_true(curve$determined)
  expect_equal(curve$length, 24 * pi, tolerance = 0.02)
  expect_lte(mean(off_ring(curve$points)), 0.15)
  expect_path_on_mesh(curve$path, ring$mesh)
  expect_equal(xyz_of(curve$path)[1, ], xyz_of(curve$path)[nrow(curve$path), ])
  expect_lte(sqrt(sum((coords(curve)[1, ] - ring$landmarks["a", ])^2)), 0.3)
  # The last point is a chord before the first.
  whole <- rbind(coords(curve), coords(curve)[1, ])
  step <- sqrt(rowSums(diff(whole)^2))
  expect_equal(step, rep(mean(step), 24), tolerance = 1e-6)
  expect_output(print(curve), "closed, length")
  expect_false(anyNA(curve$points$se))
})

test_that("two stops give the curve of four, and stops moved round the same curve", {
  ring <- ring_specimen(noise = 0.02)
  two <- closed_ring(ring, "b")
  for (other in list(closed_ring(ring, c("c", "b", "d")), closed_ring(ring, "d", "c"))) {
    near <- cpp_path_coordinates(t(coords(other)), t(xyz_of(two$path)),
                                 matrix(1, 3, nrow(two$path)), TRUE)
    expect_lte(max(abs(near$d)), 0.3)
  }
})

test_that("two stops go round anticlockwise as seen from outside, more by their order", {
  ring <- ring_specimen()
  turn <- function(curve) {
    xyz <- coords(curve)
    sum(xyz[, 1] * xyz[c(2:24, 1), 2] - xyz[, 2] * xyz[c(2:24, 1), 1]) / (2 * pi * 144)
  }
  expect_equal(turn(closed_ring(ring, "b")), 1, tolerance = 0.05)
  expect_equal(turn(closed_ring(ring, "c", "d")), 1, tolerance = 0.05)
  expect_equal(turn(closed_ring(ring, c("c", "b"))), 1, tolerance = 0.05)
  expect_equal(turn(closed_ring(ring, c("d", "b"))), -1, tolerance = 0.05)
  expect_equal(turn(closed_ring(ring, c("b", "c"))), -1, tolerance = 0.05)
})

test_that("stops on one side are not determined, and say so", {
  ring <- ring_specimen()
  expect_warning(bad <- suppressWarnings(closed_ring(ring, "e"), classes = "crestline_rival_path"),
                 "twice over|closed in|elsewhere", class = "crestline_undetermined")
  expect_false(bad$determined)
})

test_that("a loop that went elsewhere is told by running twice over, not by `competing`", {
  ring <- ring_specimen(c(a = 20, c = 110, d = 80, e = 150))
  right <- closed_ring(ring, "c")
  expect_true(right$determined)
  expect_equal(right$length, 24 * pi, tolerance = 0.02)
  # No rival is warned of: the wrong loop is cheaper beside its rivals than the right one.
  bad <- withCallingHandlers(closed_ring(ring, c("d", "e")), warning = function(w) {
    expect_s3_class(w, "crestline_undetermined")
    invokeRestart("muffleWarning")
  })
  competing <- function(curve) attr(curve$reference, "competing")
  expect_lt(competing(bad), competing(right))
  expect_lt(bad$length, 12 * pi)
  expect_false(bad$determined)
  expect_match(bad$reason, "twice over")
})

test_that("a width that is cut is told", {
  wide <- ridge_curve(ring_specimen(), "a", "a", "ridge", ring_radius, 9, 24, via = "b")
  expect_output(print(wide), "only 4.5 of its width is used, 1.5 radii")
  expect_output(print(closed_ring(ring_specimen(), "b")), "\\n  converged")
})

test_that("a part of a closed curve cannot be trusted alone", {
  expect_error(closed_ring(ring_specimen(), "b", trust = c(0.1, 1)), "closed curve",
               class = "crestline_path_error")
})

test_that("closed paths begin elsewhere without a change of course", {
  ring <- ring_specimen()
  path <- reference_path(ring, "a", "a", "ridge", radius = ring_radius, via = "b")
  scan <- walkable(ring)
  moved <- begun_at(scan, path, 20)
  expect_path_on_mesh(moved, ring$mesh)
  expect_equal(attr(moved, "length"), attr(path, "length"))
  expect_equal(points_along(moved, 5), points_along(path, 25))
  expect_equal(points_along(moved, attr(path, "length") - 15), points_along(path, 5))
  expect_identical(begun_at(scan, path, 0), path)
  expect_equal(attr(begun_at(scan, path, 20), "criterion"), attr(path, "criterion"))
})

test_that("shares that run twice over are those of the hairpin, and none of a circle", {
  hairpin <- function(gap) {
    x <- c(seq(0, 20, 0.25), seq(20, 0, -0.25))
    y <- rep(c(0, gap), each = 81)
    path_through(cbind(x, y, 0, 1, 1, 0, 0))
  }
  expect_equal(share_twice(hairpin(0.5), 1, 4), 1 - 3.5 / 40.5, tolerance = 0.1)
  expect_equal(share_twice(hairpin(3), 1, 4), 0)
  turn <- seq(0, 2 * pi, length.out = 200)
  circle <- path_through(cbind(2 * cos(turn), 2 * sin(turn), 0, 1, 1, 0, 0), closed = TRUE)
  expect_equal(share_twice(circle, 1, 4), 0)
})

test_that("lifting a closed line needs its last offset to be its first", {
  ring <- ring_specimen()
  path <- reference_path(ring, "a", "a", "ridge", radius = ring_radius, via = "b")
  window <- path_coordinates(ring, path, 4)
  s <- seq(0, attr(path, "length"), length.out = 25)
  up <- lift(ring, window, path, s, rep(1, 25))
  expect_path_on_mesh(up, ring$mesh)
  expect_equal(attr(up, "length"), attr(path, "length") - 2 * pi, tolerance = 0.05)
  expect_error(lift(ring, window, path, s, seq(0, 1, length.out = 25)), "`alpha`",
               class = "crestline_error")
})
