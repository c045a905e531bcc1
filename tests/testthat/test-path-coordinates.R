flat <- function(...) {
  closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-12, 12), v = c(-8, 8)),
                   ...)$mesh
}

test_that("on a plane s and d are the plane's own, d positive on the left seen from outside", {
  mesh <- flat()
  path <- plane_path(mesh, c(-7.3, 0.4, 0), c(6.9, 0.4, 0))
  window <- path_coordinates(mesh, path, width = 3, margin = 2)
  at <- mesh$vb[1:2, window$vertex]
  # Ends are moved into their triangles by 1e-6 of them.
  expect_equal(window$s, at[1, ] + 7.3, tolerance = 1e-5)
  expect_equal(window$d, at[2, ] - 0.4, tolerance = 1e-5)
  expect_lt(max(abs(cbind(window$tx, window$ty, window$tz) - rep(c(1, 0, 0), each = nrow(window)))),
            1e-5)
  expected <- abs(mesh$vb[2, ] - 0.4) <= 5 & mesh$vb[1, ] >= -9.3 & mesh$vb[1, ] <= 8.9
  expect_identical(window$vertex, which(expected))
  expect_identical(window$inside, at[1, ] >= -7.3 & at[1, ] <= 6.9 & abs(at[2, ] - 0.4) <= 3)
  expect_equal(attr(window, "length"), 14.2)
  expect_identical(attr(window, "width"), 3)
})

test_that("the sign turns with the path and with the side of the surface", {
  mesh <- flat()
  back <- path_coordinates(mesh, plane_path(mesh, c(6.9, 0.4, 0), c(-7.3, 0.4, 0)), 3)
  expect_equal(back$d, 0.4 - mesh$vb[2, back$vertex], tolerance = 1e-5)
  mesh$it <- mesh$it[c(1, 3, 2), ]
  under <- path_coordinates(mesh, plane_path(mesh, c(-7.3, 0.4, 0), c(6.9, 0.4, 0)), 3)
  expect_equal(under$d, 0.4 - mesh$vb[2, under$vertex], tolerance = 1e-5)
})

test_that("round a cylinder s is the arc and d the chord across it", {
  built <- closed_form_mesh(closed_forms()$cylinder)
  point <- function(u, v) c(25 * sin(u / 25), v, 25 * cos(u / 25))
  around <- plane_path(built$mesh, point(-15, 0.3), point(15, 0.3))
  window <- path_coordinates(built$mesh, around, 5)
  near <- window$inside
  at <- built$uv[window$vertex, ][near, ]
  expect_lt(max(abs(window$s[near] - (at$u + 15))), 0.05)
  # The ends' own triangles tilt the plane a little.
  expect_lt(max(abs(abs(window$d[near]) - abs(at$v - 0.3))), 0.3)
  along <- path_coordinates(built$mesh, plane_path(built$mesh, point(0, -15), point(0, 15)), 5)
  at <- built$uv[along$vertex, ][along$inside, ]
  expect_lt(max(abs(along$s[along$inside] - at$v - 15)), 0.05)
  expect_lt(max(abs(abs(along$d[along$inside]) - 50 * abs(sin(at$u / 50)))), 0.1)
})

test_that("beyond the middle of a bend the nearest place decides", {
  corner <- data.frame(s = c(0, 5, 10), x = c(0, 5, 5), y = c(0, 0, 5), z = 0)
  found <- cpp_path_coordinates(rbind(c(2, 4.5, 6, -1, 5), c(1, 3, -1, 0.5, 7), 0),
                                t(as.matrix(corner[c("x", "y", "z")])), matrix(c(0, 0, 1), 3, 3))
  expect_equal(found$s, c(2, 8, 5, -1, 12))
  expect_equal(found$d, c(1, 0.5, -sqrt(2), 0.5, 0))
  expect_equal(found$tangent[3, ], c(1, 1, 0) / sqrt(2)) # at the corner the mean of both
})

test_that("ends at corners or on edges of the mesh change nothing", {
  mesh <- grid_mesh(15)
  for (y in c(7, 7.5)) {
    path <- plane_path(mesh, c(3, y, 0), c(11, y, 0))
    window <- path_coordinates(mesh, path, width = 2.2, margin = 2)
    expect_lt(max(abs(window$s - mesh$vb[1, window$vertex] + 3)), 1e-4)
    expect_lt(max(abs(window$d - mesh$vb[2, window$vertex] + y)), 1e-4)
  }
})

test_that("what is not joined to the path inside the window stays out", {
  sheet <- flat()
  n <- ncol(sheet$vb)
  both <- rgl::mesh3d(vertices = cbind(sheet$vb, sheet$vb + c(0, 0, 0.5, 0)),
                      triangles = cbind(sheet$it, sheet$it + n))
  path <- plane_path(both, c(-7.3, 0.4, 0), c(6.9, 0.4, 0))
  window <- path_coordinates(both, path, width = 3)
  alone <- path_coordinates(sheet, plane_path(sheet, c(-7.3, 0.4, 0), c(6.9, 0.4, 0)), width = 3)
  expect_identical(window$vertex, alone$vertex)
  expect_true(all(window$vertex <= n))
})

test_that("joined_to() spreads over edges between members only", {
  it <- matrix(c(1L, 2L, 3L, 3L, 4L, 5L, 5L, 6L, 7L), 3)
  joined <- function(member, seeds) which(cpp_joined_to(it, seq_len(8) %in% member, seeds))
  expect_identical(joined(1:8, 1L), 1:7)
  expect_identical(joined(c(1:4, 6, 7), 1L), 1:4)
  expect_identical(joined(1:8, 8L), 8L)
  expect_identical(joined(2:4, 1L), integer())
})

test_that("path, width and mesh are checked", {
  mesh <- flat()
  path <- plane_path(mesh, c(-7.3, 0.4, 0), c(6.9, 0.4, 0))
  expect_crestline_error(path_coordinates(mesh, data.frame(x = 1), 3), "mesh_path")
  expect_crestline_error(path_coordinates(mesh, path, 0), "`width`")
  expect_crestline_error(path_coordinates(list(), path, 1), "mesh3d")
})
