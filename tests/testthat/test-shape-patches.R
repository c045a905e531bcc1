test_that("a bounding curve is resampled along its own path, forwards and backwards", {
  spaced <- function(curve_a) {
    scheme <- quad_scheme(function(tables) {
      tables$patches <- data.frame(patch = "row", n = 4, columns = "1:4", rows = 1, rows_kept = "1",
                                   curve_a = curve_a, resample_a = 4)
      tables
    })
    quad_shape(scheme)
  }
  there <- spaced("bottom[1:7]")
  back <- spaced("bottom[7:1]")
  expect_equal(unname(coords(there, "surface")), unname(coords(back, "surface")[4:1, ]),
               tolerance = 1e-9)
  expect_identical(coords(there, "surface")["row 1", ], coords(there, "landmarks")["a", ])
  expect_equal(unname(coords(there, "surface")[2:3, ]),
               unname(coords(there, "curves")[c("bottom 3", "bottom 5"), ]), tolerance = 1e-4)
  expect_on_mesh(back$points, quad_specimen()$mesh)
  round <- spaced("left[5:1]+bottom[2:7]")
  chord <- sqrt(rowSums(diff(coords(round, "surface"))^2))
  expect_lte(max(chord) / min(chord) - 1, 1e-6)
  expect_on_mesh(round$points, quad_specimen()$mesh)
})

test_that("curves that do not meet are joined by a cut", {
  scheme <- quad_scheme(function(tables) {
    tables$patches <- data.frame(patch = "row", n = 9, columns = "1:9", rows = 1, rows_kept = "1",
                                 curve_a = "bottom[1:7]+top[7]", resample_a = 9)
    tables
  })
  shape <- quad_shape(scheme)
  expect_true(all(shape$status$ok))
  expect_on_mesh(shape$points, quad_specimen()$mesh)
  expect_identical(coords(shape, "surface")["row 9", ], coords(shape, "landmarks")["c", ])
})

test_that("a column that meets a hole is missing with its reason, the others are there", {
  hole <- function(mesh) {
    centre <- (mesh$vb[1:3, mesh$it[1, ]] + mesh$vb[1:3, mesh$it[2, ]] +
               mesh$vb[1:3, mesh$it[3, ]]) / 3
    mesh$it <- mesh$it[, colSums((centre - c(0, 0, 50))^2) > 9]
    mesh
  }
  shape <- fit_shape(quad_specimen(hole), quad_scheme(), progress = FALSE,
                     measuring = shape_settings(column_angle = 0.01, bridge = 0))
  lost <- rownames(coords(shape, "surface"))[is.na(coords(shape, "surface")[, 1])]
  expect_equal(lost, paste("quad 4", 2:4))
  expect_match(status_of(shape, "quad")$reason,
               "3 of 35 points missing: column 4: the plane cut meets a border")
  # Of the 16 triangles of the 8 quads about the column two have no corner on its inside.
  expect_equal(ncol(shape_mesh(quad_shape())$it), 48)
  expect_equal(ncol(shape_mesh(shape)$it), 48 - 16 + 2)
  bridged <- fit_shape(quad_specimen(hole), quad_scheme(), progress = FALSE,
                       measuring = shape_settings(column_angle = 0.01))
  expect_equal(rownames(coords(bridged, "surface"))[is.na(coords(bridged, "surface")[, 1])],
               "quad 4 3")
  expect_match(status_of(bridged, "quad")$reason, "1 of 35 points missing: 1 in a hole of the mesh",
               fixed = TRUE)
  expect_lte(max(abs(coords(bridged, "surface") - coords(quad_shape(), "surface")), na.rm = TRUE),
             0.1)
})

test_that("the surface is a mesh of the scheme's triangles, outward", {
  shape <- quad_shape()
  mesh <- shape_mesh(shape)
  expect_equal(unname(t(mesh$vb[1:3, ])), unname(coords(shape, "surface")[attr(mesh, "row"), ]))
  corner <- function(i) t(mesh$vb[1:3, mesh$it[i, ]])
  normal <- cross_rows(corner(2) - corner(1), corner(3) - corner(1))
  expect_true(all(rowSums(normal * corner(1)) > 0))
  expect_crestline_error(shape_mesh(shape, "eyes"), "model")
  empty <- quad_shape(quad_scheme(function(tables) tables[1:2]))
  expect_crestline_error(shape_mesh(empty), "no triangle", id = "quad")
})

# A thin bowl, open at the top: outer wall of radius 50, inner wall of 48, a rim as sharp as a knife
# at z = 0.
bowl <- function(step = 3) {
  down <- seq(0, 90, step) * pi / 180
  wall <- function(radius, from) radius * cbind(cos(down), -sin(down))[from:length(down), ]
  profile <- rbind(wall(48, 2)[length(down):2 - 1, ], c(49, 0.5), wall(50, 2))
  turn <- seq(0, 360 - step, step) * pi / 180
  grid <- expand.grid(v = seq_len(nrow(profile)), u = turn)
  xyz <- cbind(profile[grid$v, 1] * cos(grid$u), profile[grid$v, 1] * sin(grid$u),
               profile[grid$v, 2])
  at <- expand.grid(v = seq_len(nrow(profile) - 1), u = seq_along(turn))
  corner <- function(v, u) (u - 1) %% length(turn) * nrow(profile) + v
  a <- corner(at$v, at$u); b <- corner(at$v + 1, at$u); c <- corner(at$v + 1, at$u + 1)
  d <- corner(at$v, at$u + 1)
  rgl::mesh3d(vertices = rbind(t(xyz), 1), triangles = cbind(rbind(a, b, c), rbind(a, c, d)))
}

test_that("columns that begin on a sharp rim run over the outer wall", {
  on_wall <- function(radius, lon, down) {
    radius * c(cos(down) * cos(lon), cos(down) * sin(lon), -sin(down))
  }
  low <- 0.5
  rim <- 0.02
  landmarks <- rbind(a = on_wall(50, -0.4, low), b = on_wall(50, 0.4, low),
                     c = on_wall(48, 0.4, rim), d = on_wall(48, -0.4, rim))
  cup <- specimen(bowl(), landmarks, id = "bowl")
  from_rim <- quad_scheme(function(tables) {
    tables$patches[c("curve_a", "curve_b", "first_column", "outward")] <-
      list("top[1:7]", "bottom[1:7]", "left[5:1]", "rows")
    tables
  })
  for (scheme in list(quad_scheme(), from_rim)) {
    shape <- fit_shape(cup, scheme, progress = FALSE)
    expect_true(status_of(shape, "quad")$ok)
    inside <- shape$points[shape$points$level == "surface", ]
    low_half <- inside[inside$z < -5, ]
    expect_gt(nrow(low_half), 20)
    expect_gt(min(sqrt(low_half$x^2 + low_half$y^2 + low_half$z^2)), 49.8)
    expect_on_mesh(inside, cup$mesh)
  }
})

test_that("the order of a patch's corners says where outside is, where its sides do", {
  a <- cbind(x = 0:2, y = 0, z = 0)
  b <- cbind(x = 0:2, y = 1, z = 0)
  direction <- function(...) unname(sign(column_outside(...)))
  for (at in 1:3) {
    expect_equal(direction(a, b, at, "columns"), c(0, 0, 1))
    expect_equal(direction(a, b, at, "rows"), c(0, 0, -1))
  }
  expect_true(all(is.na(column_outside(a, b, 2, NA))))
  expect_true(all(is.na(column_outside(a[1, , drop = FALSE], b[1, , drop = FALSE], 1, "rows"))))
  expect_true(all(is.na(column_outside(a, a, 2, "rows"))))
  a[2:3, ] <- NA
  expect_true(all(is.na(column_outside(a, b, 1, "rows"))))
})
