# Another way to the closest point: all faces one by one, after Ericson's regions of a triangle
# (Real-Time Collision Detection, 2005, section 5.1.5).
region_point <- function(p, a, b, c) {
  dot <- function(u, v) sum(u * v)
  d1 <- dot(b - a, p - a); d2 <- dot(c - a, p - a)
  if (d1 <= 0 && d2 <= 0) return(a)
  d3 <- dot(b - a, p - b); d4 <- dot(c - a, p - b)
  if (d3 >= 0 && d4 <= d3) return(b)
  vc <- d1 * d4 - d3 * d2
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return(a + d1 / (d1 - d3) * (b - a))
  d5 <- dot(b - a, p - c); d6 <- dot(c - a, p - c)
  if (d6 >= 0 && d5 <= d6) return(c)
  vb <- d5 * d2 - d1 * d6
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return(a + d2 / (d2 - d6) * (c - a))
  va <- d3 * d6 - d5 * d4
  if (va <= 0 && d4 >= d3 && d5 >= d6) return(b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b))
  a + (vb * (b - a) + vc * (c - a)) / (va + vb + vc)
}

brute_distance <- function(mesh, p) {
  corner <- function(face, i) mesh$vb[1:3, mesh$it[i, face]]
  apply(p, 1, function(x) min(vapply(seq_len(ncol(mesh$it)), function(face) {
    sqrt(sum((region_point(x, corner(face, 1), corner(face, 2), corner(face, 3)) - x)^2))
  }, 0)))
}

triangle_mesh <- function(...) {
  structure(list(vb = rbind(cbind(...), 1), it = matrix(1:3, 3)), class = "mesh3d")
}

test_that("closest points on one triangle are right in all seven regions", {
  p <- rbind(c(1, 1, 3), c(-1, -1, 0), c(6, -1, 0), c(-1, 6, 0), c(2, -2, 1), c(-2, 2, 1),
             c(4, 4, 0))
  truth <- rbind(c(1, 1, 0), c(0, 0, 0), c(4, 0, 0), c(0, 4, 0), c(2, 0, 0), c(0, 2, 0), c(2, 2, 0))
  found <- locate(triangle_mesh(c(0, 0, 0), c(4, 0, 0), c(0, 4, 0)), p)
  expect_equal(as.matrix(found[c("x", "y", "z")]), truth, ignore_attr = TRUE)
  expect_equal(found$distance, sqrt(rowSums((p - truth)^2)))
  expect_equal(found$w1[1:4], c(0.5, 1, 0, 0))
})

test_that("points are exactly closest, near, far, beside the mesh, with boxes and without", {
  set.seed(2)
  mesh <- grid_mesh(12, function(x, y) sin(x) + cos(2 * y))
  p <- cbind(runif(60, -3, 15), runif(60, -3, 15), rnorm(60, 0, rep(c(0.01, 1, 30, 300), 15)))
  found <- locate(mesh, p)
  expect_on_mesh(found, mesh)
  expect_equal(sqrt(rowSums((as.matrix(found[c("x", "y", "z")]) - p)^2)), found$distance,
               tolerance = tolerances$rounding)
  expect_equal(found$distance, brute_distance(mesh, p), tolerance = tolerances$rounding)
  one_by_one <- do.call(rbind, lapply(seq_len(nrow(p)), function(i) locate(mesh, p[i, ])))
  expect_identical(one_by_one, found)
  for (leaf in c(1L, 3L, 1000L)) {
    expect_identical(surface_points(mesh, p, few = 0L, leaf = leaf), surface_points(mesh, p))
  }
})

test_that("on a sphere, a plane and a cone the places are those of the closed forms", {
  ball <- ball_mesh(5)
  p <- rbind(c(0, 0, 3), c(2, 2, -1), c(0.1, -0.2, 0.05))
  found <- locate(ball, p)
  # The triangles lie below the sphere, by less than 1 - cos of half an edge.
  expect_equal(found$distance, abs(sqrt(rowSums(p^2)) - 1), tolerance = 2e-3)
  flat <- locate(grid_mesh(6), cbind(2.25, 3.5, c(-4, 0, 7)))
  expect_equal(as.matrix(flat[c("x", "y", "z")]),
               rbind(c(2.25, 3.5, 0), c(2.25, 3.5, 0), c(2.25, 3.5, 0)), ignore_attr = TRUE)
  expect_equal(flat$distance, c(4, 0, 7))
  expect_length(unique(flat$face), 1)
})

test_that("uneven faces do not mislead the search", {
  # A huge face above, a clump of tiny ones below: the huge one's centre is far, its surface near.
  clump <- grid_mesh(9)
  clump$vb[1:3, ] <- clump$vb[1:3, ] / 100
  mesh <- structure(list(vb = cbind(clump$vb, c(-1000, -1000, 1, 1), c(3000, -1000, 1, 1),
                                    c(-1000, 3000, 1, 1)),
                         it = cbind(clump$it, 82:84)), class = "mesh3d")
  found <- surface_points(mesh, rbind(c(0.04, 0.04, 0.9), c(0.04, 0.04, 0.1)))
  expect_equal(found$z, c(1, 0))
})

test_that("corners of small faces are found beside a huge one", {
  # A corner is as near as its face can be, but for rounding.
  set.seed(1)
  middle <- cbind(rep(1:10, 10), rep(1:10, each = 10), 0)
  corners <- middle[rep(1:100, each = 3), ] + runif(900, -0.3, 0.3)
  huge <- rbind(c(-1000, -1000, 1), c(3000, -1000, 1), c(-1000, 3000, 1))
  mesh <- structure(list(vb = rbind(t(rbind(corners, huge)), 1), it = matrix(1:303, 3)),
                    class = "mesh3d")
  found <- locate(mesh, corners)
  expect_equal(as.matrix(found[c("x", "y", "z")]), corners, ignore_attr = TRUE,
               tolerance = tolerances$rounding)
  expect_true(all(found$distance == 0))
})

test_that("points of the mesh come back to themselves; NA stays NA", {
  mesh <- ball_mesh()
  p <- rbind(t(mesh$vb[1:3, 1:30]), NA)
  found <- surface_points(mesh, p)
  expect_equal(as.matrix(found[1:30, 1:3]), p[1:30, ], ignore_attr = TRUE,
               tolerance = tolerances$rounding)
  expect_true(all(is.na(found[31, ])))
  expect_equal(nrow(surface_points(mesh, p[0, ])), 0)
  expect_true(all(is.na(locate(mesh, c(1, NA, 0)))))
})

test_that("of faces that are equally near the lowest is taken", {
  mesh <- ball_mesh()
  for (vertex in c(1, 17, 40)) {
    around <- which(colSums(mesh$it == vertex) > 0)
    expect_equal(locate(mesh, mesh$vb[1:3, vertex])$face, min(around))
    many <- matrix(mesh$vb[1:3, vertex], 40, 3, byrow = TRUE)
    expect_equal(unique(locate(mesh, many)$face), min(around))
  }
})

test_that("degenerate faces and needles do not disturb", {
  mesh <- grid_mesh(3)
  mesh$it <- cbind(c(1L, 1L, 1L), c(1L, 2L, 3L), mesh$it)
  expect_equal(surface_points(mesh, cbind(0.3, 0.4, 5))[1:3], data.frame(x = 0.3, y = 0.4, z = 0))
  expect_gt(surface_points(mesh, cbind(0.5, 0, 0))$face, 2)
  # Of a line of triangles only, its edges.
  line <- triangle_mesh(c(0, 0, 0), c(1, 0, 0), c(2, 0, 0))
  expect_equal(unlist(locate(line, c(0.5, 3, 4))[c("x", "y", "z", "distance")]),
               c(x = 0.5, y = 0, z = 0, distance = 5))
  # The foot on a needle is all rounding: the place is never farther than its edges are.
  needle <- triangle_mesh(c(0, 0, 0), c(1, 1e-9, 1), c(2, 0, 2) / 3)
  p <- cbind(0.3, c(-1, 0, 2), 0.4)
  expect_equal(locate(needle, p)$distance, sqrt(p[, 2]^2 + 0.005), tolerance = 1e-6)
})

test_that("the place does not depend on unit, position or scale", {
  mesh <- ball_mesh(3)
  set.seed(3)
  p <- rbind(c(0.3, -0.5, 0.9), matrix(rnorm(240), 80))
  place <- locate(mesh, p)
  # On edges and corners rounding decides which of the faces it is.
  inside <- pmin(place$w1, place$w2, place$w3) > 1e-3
  expect_gt(sum(inside), 20)
  for (scale in c(1e-30, 1e-8, 1e-3, 1e3, 1e8, 1e30)) {
    moved <- mesh
    moved$vb[1:3, ] <- scale * (mesh$vb[1:3, ] + 10)
    found <- locate(moved, scale * (p + 10))
    expect_equal(found[inside, 1:4], place[inside, 1:4], tolerance = tolerances$invariance)
    expect_equal(found$x / scale - 10, place$x, tolerance = tolerances$invariance)
    expect_equal(found$distance / scale, place$distance, tolerance = tolerances$invariance)
  }
  shuffle <- sample(ncol(mesh$it))
  mesh$it <- mesh$it[, shuffle]
  expect_equal(shuffle[locate(mesh, p)$face][inside], place$face[inside])
})

test_that("locate() takes specimens, tables and names, and refuses what is no position", {
  ball <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1), front = c(1, 0, 0)), id = "ball")
  found <- locate(ball, ball$landmarks)
  expect_identical(rownames(found), c("top", "front"))
  expect_identical(names(found), c("face", "w1", "w2", "w3", "x", "y", "z", "distance"))
  expect_equal(found$distance, c(0, 0))
  expect_identical(locate(ball, as.data.frame(ball$landmarks)), found)
  expect_identical(locate(ball, data.frame(x = 0, y = 0, z = 1))[["face"]], found$face[1])
  expect_crestline_error(locate(ball, "top"), "`xyz`")
  expect_crestline_error(locate(ball, 1:4), "`xyz`")
  expect_crestline_error(locate(ball, matrix(0, 3, 2)), c("`xyz`", "3 x 2"))
  expect_crestline_error(locate(ball, data.frame(a = 1, b = 2, c = 3)), "no columns x, y and z")
  expect_crestline_error(locate(ball, c(Inf, 0, 0)), "infinite")
  expect_crestline_error(locate(ball, NULL), "`xyz`")
  expect_crestline_error(locate(structure(list(vb = ball$mesh$vb), class = "mesh3d"), c(0, 0, 0)),
                         "no triangles")
})
