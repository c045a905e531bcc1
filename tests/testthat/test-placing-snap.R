# A bell-shaped ridge along the x axis, on a plane: crest at y = 0, height 4.
one_ridge <- function(spacing = 1, turn = diag(3), scale = 1) {
  side <- seq(-15, 15, by = spacing)
  at <- with_seed(2, expand.grid(x = side, y = side) + stats::runif(2 * length(side)^2, -0.2, 0.2))
  n <- length(side)
  vb <- scale * turn %*% rbind(at$x, at$y, 4 * exp(-at$y^2 / 8))
  structure(list(vb = rbind(vb, 1), it = grid_triangles(n, n, rep(TRUE, (n - 1)^2))),
            class = "mesh3d")
}

test_that("points go to the foot on the crest, exactly on the mesh, with the way they went", {
  mesh <- one_ridge()
  from <- rbind(a = c(-5, 2, 3), b = c(4, -2.5, 2), far = c(0, 11, 0))
  expect_warning(found <- snap(mesh, from, "ridge", radius = 3, reach = 5),
                 "no ridge within 5 of far", class = "crestline_unsnapped")
  expect_equal(found$found, c(TRUE, TRUE, FALSE))
  expect_lt(max(abs(found$y[1:2])), 0.2)
  expect_equal(found$x[1:2], c(-5, 4), tolerance = 0.1)
  expect_on_mesh(found, mesh)
  # Arc length of the bell from y to 0
  arc <- function(y) stats::integrate(function(t) sqrt(1 + (t * exp(-t^2 / 8))^2), 0, y)$value
  start <- locate(mesh, from)
  expect_equal(found$distance[1:2], vapply(abs(start$y[1:2]), arc, 0), tolerance = 0.05)
  expect_equal(unlist(found["far", c("x", "y", "z")]), unlist(start["far", c("x", "y", "z")]))
  expect_match(found["far", "reason"], "no ridge within reach")
  # Nobody is moved twice
  again <- snap(mesh, as.matrix(found[1:2, c("x", "y", "z")]), "ridge", radius = 3, reach = 5)
  expect_lt(max(again$distance), 0.02)
})

test_that("snapping does not depend on pose, unit and order", {
  mesh <- one_ridge()
  at <- rbind(a = c(-5, 2, 3))
  before <- snap(mesh, at, "ridge", radius = 3, reach = 5)
  turn <- rotation_about(c(1, 0.4, -0.3))
  moved <- one_ridge(turn = turn, scale = 1 / 1000)
  order <- with_seed(5, sample(ncol(moved$vb)))
  moved$vb <- moved$vb[, order]
  moved$it <- matrix(order(order)[moved$it], 3)
  after <- snap(moved, at %*% t(turn) / 1000, "ridge", radius = 0.003, reach = 0.005)
  xyz <- c("x", "y", "z")
  expect_equal(unlist(after[xyz]) * 1000, drop(turn %*% unlist(before[xyz])), tolerance = 1e-4,
               ignore_attr = TRUE)
  expect_equal(after$distance * 1000, before$distance, tolerance = 1e-4)
})

test_that("valleys, caps, cups and the surface are found alike; thin walls are not crossed", {
  upside <- one_ridge()
  upside$vb[3, ] <- -upside$vb[3, ]
  upside$it <- upside$it[c(1, 3, 2), ]
  groove <- snap(upside, cbind(3, 2, -3), "ridge", radius = 3, reach = 5)
  expect_lt(abs(groove$y), 0.2)
  valley <- upside
  valley$it <- valley$it[c(1, 3, 2), ]
  expect_lt(abs(snap(valley, cbind(3, 2, -3), "valley", radius = 3, reach = 5)$y), 0.2)
  ball <- ball_mesh(4)
  ball$vb[1:3, ] <- ball$vb[1:3, ] * c(10, 6, 5)
  ball <- structure(ball[c("vb", "it")], class = "mesh3d")
  cap <- snap(ball, cbind(9, 2, 1), "cap", radius = 2.5, reach = 5)
  expect_equal(unlist(cap[c("x", "y", "z")]), c(x = 10, y = 0, z = 0), tolerance = 2e-3)
  flat <- snap(ball, cbind(20, 0, 0), "surface")
  expect_equal(flat$distance, 10, tolerance = 1e-6)
  # Two sheets 0.5 apart, joined nowhere: the point on the lower, plane one stays there
  sheet <- one_ridge()
  lower <- sheet$vb
  lower[3, ] <- -0.5
  both <- structure(list(vb = cbind(sheet$vb, lower),
                         it = cbind(sheet$it, sheet$it[c(1, 3, 2), ] + ncol(lower))),
                    class = "mesh3d")
  expect_warning(stays <- snap(both, cbind(0, 6, -0.6), "ridge", radius = 3, reach = 8),
                 class = "crestline_unsnapped")
  expect_false(stays$found)
})

test_that("landmarks of a specimen are snapped by name, missing ones are said", {
  face <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  face$landmarks["chR", ] <- NA
  found <- snap(face, c("chL", "chR"), "valley", radius = 5, reach = 5)
  expect_equal(found$found, c(TRUE, FALSE))
  expect_match(found["chR", "reason"], "missing")
  expect_crestline_error(snap(face, "chl", "valley", radius = 5, reach = 5), c("chl", "chL"))
  expect_crestline_error(snap(face, "chL", "ridge"), c("`radius`", "`reach`"))
})
