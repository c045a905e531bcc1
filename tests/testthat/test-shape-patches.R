test_that("a bounding curve is resampled along its own path, forwards and backwards", {
  spaced <- function(curve_a) {
    scheme <- quad_scheme(function(tables) {
      tables$patches <- data.frame(patch = "row", n = 4, columns = "1:4", rows = 1, rows_kept = "1", curve_a = curve_a, resample_a = 4)
      tables
    })
    quad_shape(scheme)
  }
  there <- spaced("bottom[1:7]")
  back <- spaced("bottom[7:1]")
  expect_equal(unname(coords(there, "surface")), unname(coords(back, "surface")[4:1, ]), tolerance = 1e-9)
  expect_identical(coords(there, "surface")["row 1", ], coords(there, "landmarks")["a", ])
  expect_equal(unname(coords(there, "surface")[2:3, ]), unname(coords(there, "curves")[c("bottom 3", "bottom 5"), ]), tolerance = 1e-4)
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
    centre <- (mesh$vb[1:3, mesh$it[1, ]] + mesh$vb[1:3, mesh$it[2, ]] + mesh$vb[1:3, mesh$it[3, ]]) / 3
    mesh$it <- mesh$it[, colSums((centre - c(0, 0, 50))^2) > 9]
    mesh
  }
  shape <- fit_shape(quad_specimen(hole), quad_scheme(), column_angle = 0.01, bridge = 0, progress = FALSE)
  lost <- rownames(coords(shape, "surface"))[is.na(coords(shape, "surface")[, 1])]
  expect_equal(lost, paste("quad 4", 2:4))
  expect_match(status_of(shape, "quad")$reason, "3 of 35 points missing: column 4: the plane cut meets a border")
  # Of the 16 triangles of the 8 quads about the column two have no corner on its inside.
  expect_equal(ncol(shape_mesh(quad_shape())$it), 48)
  expect_equal(ncol(shape_mesh(shape)$it), 48 - 16 + 2)
  bridged <- fit_shape(quad_specimen(hole), quad_scheme(), column_angle = 0.01, progress = FALSE)
  expect_equal(rownames(coords(bridged, "surface"))[is.na(coords(bridged, "surface")[, 1])], "quad 4 3")
  expect_match(status_of(bridged, "quad")$reason, "1 of 35 points missing: 1 in a hole of the mesh", fixed = TRUE)
  expect_lte(max(abs(coords(bridged, "surface") - coords(quad_shape(), "surface")), na.rm = TRUE), 0.1)
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
