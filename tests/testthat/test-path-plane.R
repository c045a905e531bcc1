# A ring about the z axis, radii 3 and 1: nested loops where the plane z = 0 cuts it.
ring <- function(k = 60) {
  at <- expand.grid(u = seq_len(k) * 2 * pi / k, v = seq_len(24) * 2 * pi / 24)
  cell <- expand.grid(i = seq_len(k) - 1, j = 0:23)
  number <- function(i, j) (j %% 24) * k + i %% k + 1
  a <- number(cell$i, cell$j); b <- number(cell$i + 1, cell$j)
  c <- number(cell$i + 1, cell$j + 1); d <- number(cell$i, cell$j + 1)
  rgl::mesh3d(vertices = rbind((3 + cos(at$v)) * cos(at$u), (3 + cos(at$v)) * sin(at$u),
                               sin(at$v), 1),
              triangles = cbind(rbind(a, b, c), rbind(a, c, d)))
}

# The mesh without the triangles whose centres lie in a disc about (x, y).
with_hole <- function(mesh, x, y, radius) {
  centre <- (mesh$vb[1:2, mesh$it[1, ]] + mesh$vb[1:2, mesh$it[2, ]] + mesh$vb[1:2, mesh$it[3, ]]) /
    3
  mesh$it <- mesh$it[, colSums((centre - c(x, y))^2) > radius^2]
  mesh
}

test_that("a great circle is pi / 2 long, and 3 pi / 2 the other way round", {
  sphere <- ball()
  short <- plane_path(sphere, c(1, 0, 0), c(0, 1, 0))
  expect_equal(attr(short, "length"), pi / 2, tolerance = 2e-3)
  expect_lt(max(abs(short$z)), 0.02)
  long <- plane_path(sphere, c(1, 0, 0), c(0, 1, 0), side = 1)
  expect_equal(attr(long, "length"), 3 * pi / 2, tolerance = 2e-3)
  expect_lt(min(long$x), -0.99)
  expect_path_on_mesh(short, sphere)
  expect_path_on_mesh(long, sphere)
})

test_that("every angle gives the circle of its plane, turned right-handed about the axis", {
  sphere <- ball()
  from <- c(1, 0, 0)
  to <- c(0, 1, 0)
  axis <- (to - from) / sqrt(2)
  out <- c(1, 1, 0) / sqrt(2)
  for (angle in c(-1.2, -0.5, 0.3, 1, 1.4)) {
    path <- plane_path(sphere, from, to, angle)
    inside <- out * cos(angle) + cross_product(axis, out) * sin(angle)
    normal <- cross_product(axis, inside)
    height <- as.vector(xyz_of(path) %*% normal)
    expect_lt(max(abs(height - sum(from * normal))), 0.03) # out: the triangles' own normals
    radius <- sqrt(1 - sum(from * normal)^2)
    expect_equal(attr(path, "length"), 2 * radius * asin(sqrt(0.5) / radius), tolerance = 0.02)
    expect_identical(attr(path, "angle"), angle)
    expect_path_on_mesh(path, sphere)
  }
  across <- plane_path(sphere, from, to, 1)
  # right-handed about (-1, 1, 0): outwards turns to -z
  expect_lt(across$z[nrow(across) %/% 2], -0.2)
})

test_that("ends are exact, whether in a face, on an edge, at a corner or on the border", {
  mesh <- grid_mesh(11)
  start <- list(face = c(2.3, 5.2), edge = c(2.5, 5), diagonal = c(2.5, 4.5), corner = c(2, 5),
                border = c(0, 4.4), outer = c(0, 5))
  end <- list(face = c(8.1, 4.6), edge = c(8, 5.5), diagonal = c(8.25, 5.75), corner = c(8, 3),
              border = c(10, 6.1), outer = c(10, 5))
  for (a in start) for (b in end) {
    path <- plane_path(mesh, c(a, 0), c(b, 0))
    expect_equal(unlist(path[1, c("x", "y", "z")]), c(a, 0), tolerance = 1e-12, ignore_attr = TRUE)
    expect_equal(unlist(path[nrow(path), c("x", "y", "z")]), c(b, 0), tolerance = 1e-12,
                 ignore_attr = TRUE)
    expect_equal(attr(path, "length"), sqrt(sum((b - a)^2)), tolerance = 1e-5)
    expect_path_on_mesh(path, mesh, tolerance = 2e-6)
  }
})

test_that("a plane along the edges of the mesh follows them", {
  mesh <- grid_mesh(11)
  for (angle in c(0, 0.4, -1.1)) {
    path <- plane_path(mesh, c(1, 5, 0), c(9, 5, 0), angle)
    expect_equal(attr(path, "length"), 8, tolerance = 1e-5)
    expect_lt(max(abs(path$y - 5)), 1e-5)
  }
  diagonal <- plane_path(mesh, c(2, 8, 0), c(8, 2, 0))
  expect_equal(attr(diagonal, "length"), sqrt(72), tolerance = 1e-5)
})

test_that("both ends in one triangle: a single straight step", {
  mesh <- grid_mesh(4)
  path <- plane_path(mesh, c(1.1, 1.1, 0), c(1.3, 1.2, 0))
  expect_identical(nrow(path), 2L)
  expect_equal(attr(path, "length"), sqrt(0.05))
  expect_path_on_mesh(path, mesh)
  expect_error(plane_path(mesh, c(1.1, 1.1, 0), c(1.3, 1.2, 0), side = 1),
               class = "crestline_path_error")
})

test_that("a hole between the points is an error that names landmarks and specimen", {
  torn <- with_hole(grid_mesh(11), 5, 5, 1.5)
  expect_error(plane_path(torn, c(1, 5.1, 0), c(9, 5.1, 0)), class = "crestline_path_error")
  scan <- specimen(torn, rbind(left = c(1, 5.1, 0), right = c(9, 5.1, 0)), id = "torn",
                   outward = "keep")
  error <- expect_crestline_error(plane_path(scan, "left", "right"),
                                  c("left", "right", "border", "torn", "hole"), id = "torn")
  expect_s3_class(error, "crestline_path_error")
})

test_that("the way round a border is an error, the way past it is not", {
  mesh <- grid_mesh(11)
  expect_error(plane_path(mesh, c(4, 5.1, 0), c(6, 5.1, 0), side = 1), "border",
               class = "crestline_path_error")
})

test_that("a cut that comes round without the second point is an error", {
  expect_error(plane_path(ring(), c(4, 0, 0), c(-2, 0, 0), angle = pi / 2),
               "does not come to the second point", class = "crestline_path_error")
})

test_that("a cut beyond `reach` is given up", {
  sphere <- ball()
  expect_error(plane_path(sphere, c(1, 0, 0), c(0, 1, 0), side = 1, reach = 0.5), "strays too far",
               class = "crestline_path_error")
  expect_equal(attr(plane_path(sphere, c(1, 0, 0), c(0, 1, 0), reach = 0.5), "length"), pi / 2,
               tolerance = 2e-3)
})

test_that("the same point twice, and points on two pieces, are refused", {
  sphere <- ball()
  error <- expect_crestline_error(plane_path(sphere, c(1, 0, 0), c(1, 0, 0)), "same point")
  expect_s3_class(error, "crestline_path_error")
  second <- sphere$vb + c(5, 0, 0, 0)
  two <- rgl::mesh3d(vertices = cbind(sphere$vb, second),
                     triangles = cbind(sphere$it, sphere$it + ncol(sphere$vb)))
  error <- expect_crestline_error(plane_path(two, c(1, 0, 0), c(5, 1, 0)), "different pieces")
  expect_s3_class(error, "crestline_path_error")
})

test_that("an end that is no place is refused in words", {
  sphere <- ball()
  expect_crestline_error(plane_path(sphere, "pn", c(1, 0, 0)),
                         c("`from`", "pn", "three finite co-ordinates"))
  expect_crestline_error(plane_path(sphere, c(1, 0, 0), c(1, NA, 0)), "`to`")
  expect_crestline_error(plane_path(sphere, c(1, 0, 0), c(1, 0)), "`to`")
  expect_crestline_error(plane_path(sphere, c(1, 0, 0), c(0, 1, 0), angle = "steep"), "`angle`")
  expect_crestline_error(plane_path(specimen(sphere, id = "round"), "pn", c(1, 0, 0)), "pn",
                         id = "round")
})

test_that("ends may be points of the surface, as a row of a path", {
  sphere <- ball()
  path <- plane_path(sphere, c(1, 0, 0), c(0, 1, 0))
  half <- plane_path(sphere, path[1, ], path[nrow(path) %/% 2, ])
  expect_equal(attr(half, "length"), path$s[nrow(path) %/% 2], tolerance = 1e-3)
})

test_that("ends along the axis of their own normals still have a plane", {
  sphere <- ball()
  path <- plane_path(sphere, c(0, 0, 1), c(0, 0, -1))
  expect_equal(attr(path, "length"), pi, tolerance = 5e-3)
  expect_path_on_mesh(path, sphere)
})

test_that("a path prints its length and angle", {
  expect_output(print(plane_path(grid_mesh(11), c(1, 5.1, 0), c(9, 5.1, 0), angle = pi / 6)),
                "length 8, angle 30.0 degrees")
})

test_that("ends that are one point to the precision of their triangle are refused", {
  mesh <- grid_mesh(3)
  end <- surface_points(mesh, rbind(c(0.3, 0.4, 0)))
  near <- replace(end, "x", end$x + 1e-14)
  error <- expect_crestline_error(plane_path(mesh, end, near), "too near to each other")
  expect_s3_class(error, "crestline_path_error")
})

test_that("side is 0 or 1", {
  expect_crestline_error(plane_path(ball(), c(1, 0, 0), c(0, 1, 0), side = 2), "`side`")
})

test_that("at an end on a corner the normal is of all faces there, whichever it was put in", {
  mesh <- bent_ridge(noise = 0.2)$mesh
  surface <- walkable(mesh)
  corner <- function(i, face) t(mesh$vb[1:3, mesh$it[i, face], drop = FALSE])
  area_normal <- function(face) {
    cross_rows(corner(2, face) - corner(1, face), corner(3, face) - corner(1, face))
  }
  unit <- function(x) x / sqrt(sum(x^2))
  other <- 1000L
  for (vertex in c(1, 20, 700)) {
    about <- which(colSums(mesh$it == vertex) > 0)
    own <- unit(colSums(area_normal(about)))
    normal_of <- function(v) unit(colSums(area_normal(which(colSums(mesh$it == v) > 0))))
    far <- unit(rowMeans(vapply(mesh$it[, other], normal_of, numeric(3))))
    for (face in about) {
      axis <- cpp_cut_axis(surface$vb, surface$it, surface$twin,
                           as.double(c(face, mesh$it[, face] == vertex)),
                           c(other, 1 / 3, 1 / 3, 1 / 3))
      wanted <- cross_product(axis$axis, own + far)
      expect_equal(axis$across, unit(wanted), tolerance = 1e-10)
    }
  }
})

# A grid of n x n points without the faces for which `gone` (of their middle x and y) is TRUE.
grid_without <- function(n, gone) {
  mesh <- grid_mesh(n)
  middle <- apply(mesh$it, 2, function(f) rowMeans(mesh$vb[1:2, f]))
  mesh$it <- mesh$it[, !gone(middle[1, ], middle[2, ])]
  specimen(mesh, id = "grid", outward = "keep")
}

loops_of <- function(specimen) {
  lapply(cpp_border_loops(specimen$geometry$twin), function(loop) specimen$mesh$it[loop])
}

test_that("the loops of the border follow it round, outside and inside", {
  loops <- loops_of(grid_without(6, function(x, y) x > 2 & x < 3 & y > 2 & y < 3))
  expect_equal(sort(lengths(loops)), c(4, 20))
  expect_setequal(loops[[which.min(lengths(loops))]], c(15, 16, 21, 22))
  for (loop in loops) expect_equal(anyDuplicated(loop), 0L)
})

test_that("holes that meet in one vertex are bridged each", {
  scan <- grid_without(6, function(x, y) (x > 1 & x < 2 & y > 1 & y < 2) |
                          (x > 2 & x < 3 & y > 2 & y < 3))
  bridged <- bridge_holes(scan, 0.3)
  expect_equal(bridged$mesh$vb[1:2, 37:38][, order(bridged$mesh$vb[1, 37:38])],
               cbind(c(1.5, 1.5), c(2.5, 2.5)))
  expect_equal(sum(bridged$geometry$twin == 0), 20)
  expect_equal(simple_loops(c(1, 2, 3, 2, 4, 5, 4)), list(c(2, 3), c(4, 5), c(1, 2, 4)))
})

test_that("a bridge closes a hole and leaves the mesh's own numbers", {
  scan <- grid_without(6, function(x, y) x > 2 & x < 3 & y > 2 & y < 3)
  bridged <- bridge_holes(scan, 0.3)
  expect_equal(bridged$mesh$vb[, 1:36], scan$mesh$vb)
  expect_equal(bridged$mesh$it[, seq_len(ncol(scan$mesh$it))], scan$mesh$it)
  expect_equal(bridged$mesh$vb[, 37], c(2.5, 2.5, 0, 1))
  expect_equal(sum(bridged$geometry$twin == 0), 20)
  expect_true(all(face_normals(bridged$mesh)[, 3] > 0))
  path <- plane_path(bridged, c(0.3, 2.4, 0), c(4.6, 2.4, 0))
  expect_equal(attr(path, "length"), 4.3)
  over <- unbridged_path(path, scan)
  expect_on_mesh(over, scan$mesh)
  expect_equal(over$s[over$s > 1.71 & over$s < 2.69], numeric())
  expect_identical(unbridged_path(plane_path(scan, c(0.3, 1.4, 0), c(4.6, 1.4, 0)), scan),
                   plane_path(scan, c(0.3, 1.4, 0), c(4.6, 1.4, 0)))
})

test_that("a hole that is too large, and the outer border, stay open", {
  scan <- grid_without(6, function(x, y) x > 1 & x < 4 & y > 1 & y < 4)
  expect_identical(bridge_holes(scan, 0.5), scan)
  expect_equal(sum(bridge_holes(scan, 0.7)$geometry$twin == 0), 20)
  ball <- specimen(ball_mesh(), id = "ball")
  expect_identical(bridge_holes(ball, 1), ball)
})
