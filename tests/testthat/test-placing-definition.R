test_that("the strongest cap and cup are found where they are, from anywhere near", {
  knob <- quote(4 * exp(-((u - 3)^2 + (v + 2)^2) / 60))
  for (kind in c("cap", "cup")) {
    z <- if (kind == "cap") knob else bquote(-.(knob))
    for (start in list(c(5, 0), c(1, -4), c(3, -2))) {
      at <- rbind(top = start, far = c(-20, 20))
      face <- graph_specimen(z, at)
      found <- refine_landmarks(face,
                                one_definition(rownames(at), landmark = "top", kind = kind,
                                               radius = 5, reach = 6))
      expect_equal(found$refinement$state, "found")
      expect_lt(max(abs(place_of(found)[1:2] - c(3, -2))), 0.06)
      # Curvature of the knob at its top: 4 * 2 / 60; the fits smooth it.
      expect_equal(found$refinement$value, 8 / 60, tolerance = 0.25)
      expect_lt(found$refinement$value, 8 / 60)
    }
  }
})

test_that("a cup as deep as it is wide is settled, too", {
  at <- rbind(bottom = c(2, 0), far = c(-20, 20))
  pit <- graph_specimen(quote(-8 * exp(-((u - 3)^2 + (v + 2)^2) / 30)), at)
  found <- refine_landmarks(pit,
                            one_definition(rownames(at), landmark = "bottom", kind = "cup",
                                           radius = 5, reach = 6))
  expect_equal(found$refinement$state, "found")
  expect_lt(max(abs(place_of(found)[1:2] - c(3, -2))), 0.2)
})

test_that("where a cap is asked for and there is none, or none within reach, nothing is found", {
  at <- rbind(top = c(0, 0), far = c(-20, 20))
  rim <- graph_specimen(quote(-4 * exp(-(u^2 + v^2) / 60)), at)
  scheme <- one_definition(rownames(at), landmark = "top", kind = "cap", radius = 5, reach = 6)
  expect_equal(refine_landmarks(rim, scheme)$refinement$state, "none")
  knob <- graph_specimen(quote(4 * exp(-((u - 12)^2 + v^2) / 60)), at)
  found <- refine_landmarks(knob, scheme, move = TRUE)
  expect_equal(found$refinement$state, "none")
  expect_equal(found$landmarks, knob$landmarks)
  expect_match(found$refinement$reason, "nothing near")
})

test_that("the extreme of a profile lies in its plane, on the crest or in the fold", {
  at <- rbind(mid = c(1, 1.5), sideL = c(-5, 10), sideR = c(-5, -10), low = c(-20, 0),
              high = c(20, 0))
  for (bend in c("out", "in")) {
    face <- graph_specimen(bquote(.(if (bend == "out") 4 else -4) * exp(-(u - 3)^2 / 40)), at)
    mirrored <- one_definition(rownames(at), landmark = "mid", kind = "profile",
                               radius = 4, reach = 6, bend = bend, mirror = "sideL")
    upright <- one_definition(rownames(at), landmark = "mid", kind = "profile", radius = 4,
                              reach = 6, bend = bend, across_from = "low", across_to = "high")
    for (scheme in list(mirrored, upright)) {
      found <- refine_landmarks(face, scheme)
      expect_lt(max(abs(place_of(found)[1:2] - c(3, 0))), 0.06)
      # 4 * 2 / 40, smoothed
      expect_equal(found$refinement$value, 0.2, tolerance = 0.25)
    }
  }
})

test_that("a crossing is where two known ridges cross, or a valley and the mirror", {
  at <- rbind(mid = c(4, 3), west = c(-22, 1), east = c(22, 1), south = c(2, -22), north = c(2, 22))
  ridges <- quote(3 * exp(-(v - 1)^2 / 12) + 3 * exp(-(u - 2)^2 / 12))
  both <- one_definition(rownames(at), landmark = "mid", kind = "crossing", radius = 4, reach = 6,
                         from = "west", to = "east", type = "ridge", width = 5,
                         across_from = "south", across_to = "north", across_type = "ridge")
  found <- refine_landmarks(graph_specimen(ridges, at), both)
  expect_lt(max(abs(place_of(found)[1:2] - c(2, 1))), 0.25)
  expect_true(is.na(found$refinement$value))
  # A valley that runs askew: v = u / 4 + 1 meets v = 0 at u = -4.
  skew <- rbind(mid = c(-3, 2), west = c(-20, -4), east = c(20, 6), sideL = c(-5, 10),
                sideR = c(-5, -10))
  valley <- graph_specimen(quote(-3 * exp(-(v - u / 4 - 1)^2 / 12)), skew)
  mirrored <- one_definition(rownames(skew), landmark = "mid", kind = "crossing",
                             radius = 4, reach = 6, from = "west", to = "east", type = "valley",
                             width = 5, mirror = "sideL")
  found <- refine_landmarks(valley, mirrored)
  # 0.1 across the valley is 0.4 along the mirror's line.
  expect_lt(max(abs(place_of(found)[1:2] - c(-4, 0))), 0.4)
  valley$landmarks["mid", ] <- valley$landmarks["east", ]
  expect_equal(refine_landmarks(valley, mirrored)$refinement$state, "none")
})

test_that("a turn is where a curved ridge bends most, to the side that is asked for", {
  # The ridge's line is a hyperbola: v = 0.8 sqrt((u - 2)^2 + 16) - 4, which turns left (towards +v)
  # most at u = 2.
  ridge <- quote(3 * exp(-(v - 0.8 * sqrt((u - 2)^2 + 16) + 4)^2 / 10))
  line <- function(u) 0.8 * sqrt((u - 2)^2 + 16) - 4
  at <- rbind(bend = c(4, -1), west = c(-18, line(-18)), east = c(20, line(20)))
  face <- graph_specimen(ridge, at, spacing = 0.6)
  scheme <- function(bend) {
    one_definition(rownames(at), landmark = "bend", kind = "turn", radius = 4, reach = 6,
                   bend = bend, from = "west", to = "east", type = "ridge", width = 8)
  }
  found <- refine_landmarks(face, scheme("left"))
  # At u = 2 by symmetry; the curve itself runs on the inner side of the bend, where the ridge is
  # sharper.
  expect_lt(abs(place_of(found)[[1]] - 2), 0.4)
  expect_lt(abs(place_of(found)[[2]] - line(2)), 1.2)
  other <- refine_landmarks(face, scheme("right"))
  expect_true(other$refinement$state == "none" || other$refinement$distance > 2)
})

test_that("the turning of a path is that of its circle, by sign", {
  flat <- specimen(grid_mesh(41), outward = "keep")
  angle <- seq(0, pi, length.out = 181)
  circle <- surface_points(flat$mesh, cbind(20 + 12 * cos(angle), 10 + 12 * sin(angle), 0))
  path <- path_through(as.matrix(circle[mesh_columns]))
  turning <- path_turning(flat$mesh, path, 5)
  inner <- is.finite(turning$value)
  expect_gt(sum(inner), 30)
  # A parabola over 5 either way is not quite the circle.
  expect_equal(stats::median(turning$value[inner]), 1 / 12, tolerance = 0.04)
  back <- path_turning(flat$mesh, path_through(as.matrix(circle[181:1, mesh_columns])), 5)
  expect_equal(stats::median(back$value, na.rm = TRUE), -1 / 12, tolerance = 0.04)
})

test_that("a ridge ends where its strength has fallen to a half", {
  ridge <- quote(3 / (1 + exp((u - 5) / 2)) * exp(-v^2 / 10))
  for (start in list(c(7, 1), c(4, -1.5))) {
    at <- rbind(tip = start, west = c(-20, 0))
    face <- graph_specimen(ridge, at)
    scheme <- one_definition(rownames(at), landmark = "tip", kind = "end", radius = 4, reach = 8,
                             from = "west", type = "ridge", width = 5)
    found <- refine_landmarks(face, scheme)
    expect_equal(found$refinement$state, "found")
    expect_lt(abs(place_of(found)[[1]] - 5), 0.6)
    expect_lt(abs(place_of(found)[[2]]), 0.6)
  }
  endless <- graph_specimen(quote(3 * exp(-v^2 / 10)), rbind(tip = c(4, 0), west = c(-20, 0)))
  expect_equal(refine_landmarks(endless, scheme)$refinement$state, "none")
})
