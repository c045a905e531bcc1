# Points of a bowl turned upside down, z = 30 - r^2 / 40, with its normals: the top stands proud.
dome <- function(step = 3) {
  grid <- as.matrix(expand.grid(x = seq(-30, 30, step), y = seq(-24, 24, step)))
  grid <- grid[rowSums((grid / c(30, 24))^2) < 1.2, ]
  normal <- rbind(grid[, 1] / 20, grid[, 2] / 20, 1)
  list(xyz = rbind(t(grid), 30 - rowSums(grid^2) / 40),
       normal = normal / rep(sqrt(colSums(normal^2)), each = 3))
}

test_that("a place's height is over the weighted centroid of its ball, along the mean normal", {
  cloud <- dome()
  found <- cpp_mounds(cloud$xyz, cloud$normal, cbind(c(0, 0, 30), c(500, 0, 0)), 20)
  d2 <- colSums((cloud$xyz - c(0, 0, 30))^2)
  weight <- pmax(1 - d2 / 400, 0)
  expect_equal(found[, 1], c(0, 0, 1, 30 - sum(weight * cloud$xyz[3, ]) / sum(weight)))
  expect_equal(found[, 2], c(0, 0, 0, 0))
})

test_that("the template set down on its own cloud fits at the turn in which it was taken", {
  cloud <- with_seed(2, {
    own <- dome()
    own$xyz[3, ] <- own$xyz[3, ] + own$xyz[1, ] / 10
    own
  })
  frame <- diag(3)
  points <- list(xyz = cloud$xyz - c(0, 0, 30), normal = cloud$normal)
  search <- list(turns = 8L, scales = c(1, 1.3), voxel = 1, reach = 10, spacing = 0, cosine = 0.3,
                 each = 3L)
  found <- cpp_search_starts(points, cloud, cbind(c(0, 0, 30), c(15, 0, 24)),
                             cbind(c(0, 0, 1, 5), c(0, 0, 0, 5)), search)
  expect_equal(ncol(found), 3)
  expect_equal(found[15, ], c(1, 1, 1))
  expect_false(is.unsorted(found[14, ]))
  # The first axis about an upright normal is x.
  expect_equal(found[1:13, 1], c(frame, 0, 0, 30, 1))
  # A cell's nearest point is at most half its diagonal, and the spacing, away from the point's own.
  expect_lt(found[14, 1], 0.06)
})

test_that("starts that differ in turn, place or scale are kept, the best of those that do not", {
  turn <- function(a) c(cos(a), sin(a), 0, -sin(a), cos(a), 0, 0, 0, 1)
  one <- function(a, place, scale) c(turn(a), 0, 0, 0, scale, 0, place)
  found <- cbind(one(0, 1, 1), one(0.1, 1, 1), one(0.1, 2, 1), one(0, 1, 1.2), one(1, 1, 1))
  at <- cbind(c(0, 0, 0), c(0, 20, 0))
  settings <- find_settings()
  expect_equal(distinct_starts(found, at, settings), c(1, 3, 4, 5))
  expect_equal(distinct_starts(found, at, find_settings(starts = 2)), c(1, 3))
})

test_that("starts go with the scan, whatever its pose and the order of its points", {
  settings <- scaled_settings(find_settings(), 1)
  template <- prepared_template(face_template(), find_settings(), 1)
  scan <- humface_scan()
  starts <- proud_starts(template, scan_cloud(specimen(scan), 1, settings), 1, settings)
  turn <- some_rotation(6)
  moved <- moved_mesh(scan, turn, c(100, 20, -40))
  order <- with_seed(1, sample(ncol(moved$vb)))
  moved$vb <- moved$vb[, order]
  moved$it <- matrix(match(seq_along(order), order)[moved$it], 3)
  again <- proud_starts(template, scan_cloud(specimen(moved), 1, settings), 1, settings)
  carried <- apply(starts, 2, function(pose) {
    c(turn %*% matrix(pose[1:9], 3), turn %*% pose[10:12] + c(100, 20, -40), pose[13])
  })
  expect_equal(again, carried, tolerance = 1e-8)
  # The tip of the nose is among the first places.
  tip <- template$start$anchor
  at <- apply(starts, 2, function(pose) matrix(pose[1:9], 3) %*% tip + pose[10:12])
  off <- sqrt(colSums((at - humface_landmarks()["pn", ])^2))
  expect_lt(min(off[1:5]), 15)
})

test_that("a template starts at the landmark that is named, else at its proudest place", {
  placed <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  named <- landmark_template(placed, ear_names, start = "sn")
  expect_equal(named$start, named$landmarks["sn", ])
  expect_null(landmark_template(placed, ear_names)$start)
  expect_error(landmark_template(placed, ear_names, start = "tL"), class = "crestline_error")
  settings <- scaled_settings(find_settings(), 1)
  own <- prepared_template(face_template(), find_settings(), 1)
  free <- template_start(own, NULL, settings)
  expect_lt(sqrt(sum((free$anchor - face_template()$landmarks["pn", ])^2)), 10)
  expect_equal(crossprod(unname(free$frame)), diag(3))
  expect_equal(det(free$frame), 1)
})
