unrolled <- function(mesh, from, to, width) {
  path <- plane_path(mesh, from, to)
  list(path = path, window = path_coordinates(mesh, path, width),
       s = seq(0, attr(path, "length"), length.out = 41))
}
wave <- function(s) 1.2 * sin(pi * s / max(s)) + 0.5 * sin(3 * pi * s / max(s))

test_that("a curve of the plane comes to lie where it is in the plane", {
  mesh <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-12, 12),
                                v = c(-8, 8)), spacing = 0.5)$mesh
  u <- unrolled(mesh, c(-9.3, 0.2, 0), c(9.1, 0.2, 0), 4)
  lifted <- lift(mesh, u$window, u$path, u$s, wave(u$s))
  expect_true(attr(lifted, "lifted"))
  expect_path_on_mesh(lifted, mesh)
  wanted <- stats::splinefun(u$s, wave(u$s), method = "natural")(lifted$x + 9.3) + 0.2
  expect_lt(max(abs(lifted$y - wanted)), 0.05)
  expect_identical(xyz_of(lifted)[c(1, nrow(lifted)), ], xyz_of(u$path)[c(1, nrow(u$path)), ],
                   ignore_attr = TRUE)
})

test_that("(s, d) of the lifted curve is the curve", {
  bent <- bent_ridge(noise = 0.02)
  u <- unrolled(bent, "a", "b", 5)
  lifted <- lift(bent, u$window, u$path, u$s, wave(u$s))
  expect_path_on_mesh(lifted, bent$mesh)
  found <- cpp_path_coordinates(t(xyz_of(lifted)), t(xyz_of(u$path)),
                                path_normals(bent$mesh, u$path))
  inside <- found$s > 0 & found$s < max(u$s)
  wanted <- stats::splinefun(u$s, wave(u$s), method = "natural")(found$s)
  expect_lt(max(abs(found$d - wanted)[inside]), 0.1)
  expect_lt(stats::median(abs(found$d - wanted)[inside]), 0.01)
})

test_that("alpha = 0 is the reference path", {
  bent <- bent_ridge(noise = 0.02)
  u <- unrolled(bent, "a", "b", 5)
  lifted <- lift(bent, u$window, u$path, u$s, 0 * u$s)
  expect_lt(max(distance_from_line(xyz_of(lifted), xyz_of(u$path))), 0.02)
  expect_equal(attr(lifted, "length"), attr(u$path, "length"), tolerance = 1e-3)
})

test_that("ends at corners of the mesh are lifted like any other", {
  mesh <- grid_mesh(21)
  u <- unrolled(mesh, c(4, 10, 0), c(16, 10, 0), 4)
  lifted <- lift(mesh, u$window, u$path, u$s, wave(u$s))
  expect_true(attr(lifted, "lifted"))
  wanted <- stats::splinefun(u$s, wave(u$s), method = "natural")(lifted$x - 4) + 10
  expect_lt(max(abs(lifted$y - wanted)), 0.15)
})

test_that("where the walk is cut off the curve is pieced together, still on the mesh", {
  mesh <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-12, 12),
                                v = c(-8, 8)), spacing = 0.5)$mesh
  u <- unrolled(mesh, c(-9.3, 0.2, 0), c(9.1, 0.2, 0), 4)
  # a gap in the window on the curve's way
  torn <- u$window[abs(u$window$s - 9) > 0.4 | abs(u$window$d) < 0.7, ]
  lifted <- suppressWarnings(lift(mesh, torn, u$path, u$s, wave(u$s)))
  expect_false(attr(lifted, "lifted"))
  expect_on_mesh(lifted, mesh)
  expect_identical(xyz_of(lifted)[c(1, nrow(lifted)), ], xyz_of(u$path)[c(1, nrow(u$path)), ],
                   ignore_attr = TRUE)
  wanted <- stats::splinefun(u$s, wave(u$s), method = "natural")(lifted$x + 9.3) + 0.2
  expect_lt(max(abs(lifted$y - wanted)), 0.1)
  expect_path_on_mesh(lifted, mesh)
})

test_that("piecing a curve together warns of no rivals", {
  mesh <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(0 * u), u = c(-12, 12),
                                v = c(-8, 8)), spacing = 0.5)$mesh
  u <- unrolled(mesh, c(-9.3, 0.2, 0), c(9.1, 0.2, 0), 4)
  torn <- u$window[abs(u$window$s - 9) > 0.4 | abs(u$window$d) < 0.7, ]
  expect_no_warning(lift(mesh, torn, u$path, u$s, wave(u$s)), class = "crestline_rival_path")
})

test_that("triangles_about() finds the triangles that hold a point, with its weights", {
  flat <- list(vb = rbind(c(0, 1, 0, 1), c(0, 0, 1, 1), 0), it = cbind(c(1, 2, 3), c(2, 4, 3)))
  expect_identical(triangles_about(flat, 0.2, 0.3)$face, 1L)
  expect_equal(triangles_about(flat, 0.2, 0.3)$weight, rbind(c(0.5, 0.2, 0.3)), ignore_attr = TRUE)
  expect_identical(triangles_about(flat, 0.5, 0.5)$face, 1:2)
  expect_no_warning(expect_identical(triangles_about(flat, 2, 2)$face, integer()))
})

test_that("of two sheets that hold a place the one by the reference path is taken", {
  sheet <- grid_mesh(11)
  n <- ncol(sheet$vb)
  both <- rgl::mesh3d(vertices = cbind(sheet$vb, sheet$vb + c(0, 0, 3, 0)),
                      triangles = cbind(sheet$it + n, sheet$it))
  path <- plane_path(sheet, c(1, 5.2, 0), c(9, 5.2, 0))
  window <- structure(data.frame(vertex = seq_len(2 * n), s = both$vb[1, ] - 1,
                                 d = both$vb[2, ] - 5.2),
                      class = c("path_coordinates", "data.frame"))
  places <- places_in_plane(walkable(both), window, path, c(0, 4, 8), c(0, 1, 0))
  expect_equal(unlist(places[1:3]), c(x = 5, y = 6.2, z = 0))
  expect_gt(places$face, ncol(sheet$it)) # the lower sheet comes second
})

test_that("ends in one triangle are joined straight", {
  mesh <- grid_mesh(6)
  path <- plane_path(mesh, c(2.1, 2.1, 0), c(2.3, 2.2, 0))
  window <- path_coordinates(mesh, path, 2)
  s <- seq(0, attr(path, "length"), length.out = 5)
  lifted <- lift(mesh, window, path, s, 0 * s)
  expect_identical(nrow(lifted), 2L)
  expect_true(attr(lifted, "lifted"))
})

test_that("a window without triangles by the curve is an error of the path", {
  mesh <- grid_mesh(15)
  u <- unrolled(mesh, c(2.2, 7.3, 0), c(12.1, 7.2, 0), 3)
  error <- expect_crestline_error(lift(mesh, u$window[1:3, ], u$path, u$s, 0 * u$s),
                                  "no triangle near the reference path")
  expect_s3_class(error, "crestline_path_error")
})
