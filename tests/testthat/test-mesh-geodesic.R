at_vertices <- function(mesh, vertices) {
  face <- vapply(vertices, function(v) which(colSums(mesh$it == v) > 0)[1], 0L)
  weight <- t(mapply(function(face, v) as.numeric(mesh$it[, face] == v), face, vertices))
  data.frame(face = face, w1 = weight[, 1], w2 = weight[, 2], w3 = weight[, 3])
}

round_ball <- function(subdivision) {
  ball <- ball_mesh(subdivision)
  ball$vb[1:3, ] <- t(t(ball$vb[1:3, ]) / sqrt(colSums(ball$vb[1:3, ]^2)))
  ball
}

test_that("distances on an irregular flat mesh are straight, from vertices and within faces", {
  sheet <- grid_mesh(15)
  border <- unique(as.vector(sheet$it[, colSums(mesh_topology(sheet)$twin == 0) > 0]))
  moved <- with_seed(1, matrix(stats::runif(2 * ncol(sheet$vb), -0.2, 0.2), 2))
  sheet$vb[1:2, -border] <- (sheet$vb[1:2, ] + moved)[, -border]
  inside <- data.frame(face = 201L, w1 = 0.2, w2 = 0.5, w3 = 0.3)
  inside_at <- place_on_faces(sheet, 201L, as.matrix(inside[2:4]))[1, ]
  found <- geodesic_distances(sheet, rbind(at_vertices(sheet, c(100, 113)), inside))
  from <- rbind(t(sheet$vb[1:3, c(100, 113)]), inside_at)
  straight <- apply(from, 1, function(p) sqrt(colSums((sheet$vb[1:3, ] - p)^2)))
  expect_lte(max(abs(found - straight)), 100 * tolerances$rounding)
})

test_that("distances on a ball are arcs, to 0.3 % on average and 2 % at most", {
  ball <- round_ball(4)
  from <- c(1, 500, 2000)
  found <- geodesic_distances(ball, at_vertices(ball, from))
  arc <- acos(pmin(pmax(crossprod(ball$vb[1:3, ], ball$vb[1:3, from]), -1), 1))
  error <- (found / arc - 1)[arc > 0.2]
  expect_lte(mean(abs(error)), 0.003)
  expect_lte(max(abs(error)), 0.02)
  larger <- ball
  larger$vb[1:3, ] <- 1000 * ball$vb[1:3, ]
  expect_equal(geodesic_distances(larger, at_vertices(ball, from)), 1000 * found, tolerance = 1e-9)
})

test_that("a path goes round a hole, and there is none to another piece", {
  sheet <- grid_mesh(9)
  slit <- sheet
  middle <- (sheet$vb[1, sheet$it[1, ]] + sheet$vb[1, sheet$it[2, ]] + sheet$vb[1, sheet$it[3, ]]) /
    3
  row <- (sheet$vb[2, sheet$it[1, ]] + sheet$vb[2, sheet$it[2, ]] + sheet$vb[2, sheet$it[3, ]]) / 3
  slit$it <- sheet$it[, !(row > 3 & row < 4 & middle < 6)]
  vertex <- function(x, y) which(sheet$vb[1, ] == x & sheet$vb[2, ] == y)
  found <- geodesic_distances(slit, at_vertices(slit, vertex(2, 1)))
  # Round the corners (6, 3) and (6, 4); where a path bends the unfolding is not exact.
  round_slit <- sqrt(16 + 4) + 1 + sqrt(16 + 4)
  expect_gte(found[vertex(2, 6)], round_slit - 100 * tolerances$rounding)
  expect_lte(found[vertex(2, 6)], 1.015 * round_slit)
  slit$it <- sheet$it[, !(row > 3 & row < 4)]
  expect_equal(geodesic_distances(slit, at_vertices(slit, vertex(2, 1)))[vertex(2, 6)], Inf)
})
