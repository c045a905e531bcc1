# A kernel call by hand on a mesh whose shortest way is known.
test_that("with one cost everywhere the path is as long as the straight line, within the graph's", {
  flat <- graph_specimen(quote(0 * u), two_ends(), half = c(15, 6), jitter = 0)
  scan <- walkable(flat)
  ends <- located_ends(flat, scan, "a", "b")
  found <- least_cost(scan, ends$exact[1, ], ends$exact[2, ], rep(2, ncol(scan$vb)))
  straight <- sqrt(sum((ends$exact[1, 1:3] - ends$exact[2, 1:3])^2))
  expect_gte(found$cost, 2 * straight)
  expect_lte(found$cost, 2.1 * straight)
  path <- path_through(found$places, scan)
  expect_path_on_mesh(path, flat$mesh)
  expect_equal(2 * attr(path, "length"), found$cost)
})

test_that("an angle that is not known closes the way, and once round is once round", {
  ring <- ring_specimen()
  scan <- walkable(ring)
  at <- end_vector(ring, scan, "a", "from")
  xyz <- scan$vb[1:3, ]
  angle <- atan2(xyz[2, ], xyz[1, ])
  out <- sqrt(xyz[1, ]^2 + xyz[2, ]^2)
  angle <- (angle - 20 * pi / 180) %% (2 * pi)
  angle[out < 6] <- NaN
  cost <- rep(1, ncol(xyz))
  round <- least_cost(scan, at, at, cost, angle, TRUE)
  turned <- diff(atan2(round$places[, 2], round$places[, 1]))
  turned <- turned - 2 * pi * round(turned / (2 * pi))
  expect_equal(sum(turned), 2 * pi, tolerance = 1e-6)
  expect_null(least_cost(scan, at, at, cost, rep(NaN, length(angle)), TRUE))
})

test_that("a crest that bows away from every plane is followed", {
  ring <- ring_specimen(c(a = 0, b = 250, c = 130))
  arc <- ridge_curve(ring, "a", "b", "ridge", radius = ring_radius, width = 4.5, n = 15,
                     path = "crest")
  # Three crests lead from a to b: a way round by c, and the short one beyond b.
  expect_path_on_mesh(arc$path, ring$mesh)
  expect_lte(mean(off_ring(arc$points)), 0.2)
  by <- reference_path(ring, "a", "b", "ridge", radius = ring_radius, via = "c")
  expect_equal(attr(by, "length"), 12 * 250 * pi / 180, tolerance = 0.02)
  expect_lte(mean(off_ring(by)), 0.4)
  expect_path_on_mesh(by, ring$mesh)
})

test_that("a place on the way that is beside the crest has no say but in where it runs", {
  ring <- ring_specimen(c(a = 0, b = 250, c = 130))
  by <- function(out) {
    place <- c(out * cos(130 * pi / 180), out * sin(130 * pi / 180), 3)
    reference_path(ring, "a", "b", "ridge", radius = ring_radius, via = place)
  }
  expect_lte(max(abs(cpp_path_coordinates(t(xyz_of(by(9.5))), t(xyz_of(by(12))),
                                          matrix(1, 3, nrow(by(12))))$d)), 1e-6)
})

test_that("moved, turned and scaled, the path is the same", {
  ring <- ring_specimen(c(a = 0, b = 250, c = 130))
  turn <- rotation_about(c(0.3, -1.1, 0.7))
  moved <- ring$mesh
  moved$vb[1:3, ] <- 10 * (turn %*% ring$mesh$vb[1:3, ]) + c(5, -3, 40)
  other <- specimen(moved, 10 * ring$landmarks %*% t(turn) + rep(c(5, -3, 40), each = 3),
                    id = "moved", outward = "keep", tolerance = 0.25)
  path <- function(of, radius) {
    reference_path(of, "a", "b", "ridge", radius = radius, path = "crest", via = "c")
  }
  one <- path(ring, ring_radius)
  two <- path(other, 10 * ring_radius)
  back <- (xyz_of(two) - rep(c(5, -3, 40), each = nrow(two))) %*% turn / 10
  near <- cpp_path_coordinates(t(back), t(xyz_of(one)), matrix(1, 3, nrow(one)))
  expect_lte(max(abs(near$d)), 0.05)
  # The regular mesh has other paths of equal cost, of which rounding takes one.
  expect_lte(abs(attr(two, "competing") - attr(one, "competing")), 0.01)
})

test_that("competing says how much dearer the best other path is", {
  # Two arches of one height, and one of half of it.
  arched <- function(left, right, ...) {
    reference_path(arched_ridges(left, right), "a", "b", "ridge", radius = 2, path = "crest", ...)
  }
  expect_warning(even <- arched(3, 3, settings = path_settings(rival = 0.1)),
                 "costs nearly as little", class = "crestline_rival_path")
  expect_gte(attr(even, "competing"), 0.9)
  uneven <- arched(3, 1)
  expect_lte(attr(uneven, "competing"), 0.5)
  expect_gt(mean(uneven$y), 2)
})

test_that("what cannot be a route is refused by name", {
  ring <- ring_specimen()
  ask <- function(...) reference_path(ring, "a", "b", "ridge", radius = ring_radius, ...)
  expect_error(ask(path = "snake"), "`path`", class = "crestline_error")
  expect_error(ask(via = "nobody"), "nobody", class = "crestline_error")
  expect_error(ask(via = 1:2), "`via`", class = "crestline_error")
  expect_error(reference_path(ring, "a", "b", "plane", via = "c"), "plane cut has no crest",
               class = "crestline_error")
  expect_error(reference_path(ring, "a", "a", "ridge", radius = ring_radius), "`via`",
               class = "crestline_path_error")
})

test_that("a feature that is not there costs its length: the path is nearly straight", {
  flat <- graph_specimen(quote(0 * u), two_ends(), half = c(17, 8))
  path <- reference_path(flat, "a", "b", "ridge", radius = 3, path = "crest")
  expect_equal(attr(path, "length"), 26.9, tolerance = 0.02)
})
