# Sides that only one triangle has, as pairs of vertices.
border_sides <- function(mesh) {
  side <- cbind(mesh$it[1:2, ], mesh$it[2:3, ], mesh$it[c(3, 1), ])
  key <- paste(pmin(side[1, ], side[2, ]), pmax(side[1, ], side[2, ]))
  t(side[, !key %in% key[duplicated(key)]])
}
off_ball <- function(mesh, specimen) {
  centre <- (mesh$vb[1:3, mesh$it[1, ]] + mesh$vb[1:3, mesh$it[2, ]] + mesh$vb[1:3, mesh$it[3, ]]) /
    3
  surface_gap(specimen$mesh, t(centre))
}
surface_gap <- function(mesh, xyz) {
  sqrt(rowSums((as.matrix(surface_points(mesh, xyz)[1:3]) - xyz)^2))
}

test_that("a denser surface has the model's points, k x k quads each, all on the mesh", {
  shape <- quad_shape()
  specimen <- quad_specimen()
  coarse <- shape_mesh(shape)
  for (k in 2:4) {
    dense <- shape_mesh(shape, specimen = specimen, dense = k)
    expect_equal(ncol(dense$it), k^2 * ncol(coarse$it))
    expect_equal(ncol(dense$vb), (6 * k + 1) * (4 * k + 1))
    own <- !is.na(attr(dense, "row"))
    expect_identical(dense$vb[, own], coarse$vb)
    expect_identical(attr(dense, "row")[own], attr(coarse, "row"))
    expect_on_mesh(attr(dense, "points"), specimen$mesh)
    expect_equal(unname(t(dense$vb[1:3, ])), unname(as.matrix(attr(dense, "points")[1:3])))
    expect_equal(attr(dense, "group"), rep("quad", ncol(dense$it)))
  }
})

test_that("it has no crack, no triangle turned over or crossing, and is nearer to the specimen", {
  shape <- quad_shape()
  specimen <- quad_specimen()
  coarse <- shape_mesh(shape)
  for (k in 2:3) {
    dense <- shape_mesh(shape, specimen = specimen, dense = k)
    expect_equal(nrow(border_sides(dense)), k * nrow(border_sides(coarse)))
    xyz <- t(dense$vb[1:3, ])
    expect_length(flipped_triangles(xyz, dense$it, xyz), 0)
    expect_equal(nrow(crossing_pairs(xyz, dense$it)), 0)
    expect_lt(max(off_ball(dense, specimen)), max(off_ball(coarse, specimen)) / k)
  }
})

test_that("sides that are part of a curve follow it at equal chords, resampled too", {
  scheme <- quad_scheme(function(tables) {
    tables$patches[c("n", "columns", "resample_a", "resample_b")] <- data.frame(20, "1:4", 4, 4)
    tables
  })
  shape <- quad_shape(scheme)
  specimen <- quad_specimen()
  dense <- shape_mesh(shape, specimen = specimen, dense = 3)
  border <- unique(as.vector(border_sides(dense)))
  on <- rowSums(!is.na(sapply(shape$paths, arc_lengths_on, t(dense$vb[1:3, ])[border, ], 1e-9))) > 0
  expect_true(all(on))
  # The part of a bottom's curve between two of its four points: chords of the nine pieces are equal
  # by threes.
  bottom <- arc_lengths_on(shape$paths$bottom, t(dense$vb[1:3, ]), 1e-9)
  along <- order(bottom, na.last = NA)
  chord <- matrix(sqrt(rowSums(diff(t(dense$vb[1:3, along]))^2)), 3)
  expect_equal(length(along), 10)
  expect_equal(chord, matrix(colMeans(chord), 3, 3, byrow = TRUE), tolerance = 1e-8)
})

test_that("neighbours with different directions share the points of their common side", {
  shape <- two_patch_shape()
  specimen <- quad_specimen()
  coarse <- shape_mesh(shape)
  dense <- shape_mesh(shape, specimen = specimen, dense = 3)
  expect_equal(nrow(border_sides(dense)), 3 * nrow(border_sides(coarse)))
  expect_setequal(attr(dense, "group"), c("low", "high", "strip middle"))
  xyz <- t(dense$vb[1:3, ])
  expect_length(flipped_triangles(xyz, dense$it, xyz), 0)
  expect_equal(anyDuplicated(round(xyz, 9)), 0)
})

test_that("triangles beside a missing one are divided, across a hole left out, with a warning", {
  shape <- quad_shape()
  specimen <- quad_specimen()
  lost <- which(shape$points$level == "surface" & shape$points$point == "7 5")
  shape$points[lost, c("x", "y", "z", "face", "w1", "w2", "w3")] <- NA
  expect_equal(ncol(shape_mesh(shape)$it), 46)
  expect_equal(ncol(shape_mesh(shape, specimen = specimen, dense = 2)$it), 4 * 46)
  hole <- quad_specimen(function(mesh) {
    centre <- (mesh$vb[1:3, mesh$it[1, ]] + mesh$vb[1:3, mesh$it[2, ]] +
               mesh$vb[1:3, mesh$it[3, ]]) / 3
    mesh$it <- mesh$it[, colSums((centre - c(4, 0, 50))^2) > 4]
    mesh
  })
  shape <- fit_shape(hole, quad_scheme(), progress = FALSE)
  expect_warning(dense <- shape_mesh(shape, specimen = hole, dense = 2,
                                     measuring = shape_settings(column_angle = 0.01)),
                 "triangles of the denser surface", class = "crestline_warning")
  expect_gt(ncol(dense$it), 100)
  expect_false(anyNA(dense$vb))
})

test_that("a curve that folds the surface is not followed", {
  shape <- quad_shape()
  specimen <- quad_specimen()
  # A detour of the bottom curve between its points 3 and 4, over the middle of the patch and back.
  at <- which(shape$points$level == "curves" & shape$points$part == "bottom")[3:4]
  ends <- lapply(at, function(i) unlist(shape$points[i, c("x", "y", "z")]))
  over <- 50 * c(0, 0.3, 0.95) / sqrt(0.3^2 + 0.95^2)
  s <- arc_lengths_on(shape$paths$bottom, do.call(rbind, ends), 1e-9)
  part <- function(from, to) {
    as.data.frame(part_of_path(specimen$mesh, shape$paths$bottom, from, to))[mesh_columns]
  }
  away <- function(from, to) as.data.frame(plane_path(specimen, from, to))[mesh_columns]
  detour <- rbind(part(0, s[1]), away(ends[[1]], over), away(over, ends[[2]]), part(s[2], Inf))
  shape$paths$bottom <- path_through(detour)
  xyz <- t(shape_mesh(shape, specimen = specimen, dense = 2)$vb[1:3, ])
  plain <- t(shape_mesh(quad_shape(), specimen = specimen, dense = 2)$vb[1:3, ])
  expect_equal(xyz, plain, tolerance = 1e-3)
})

test_that("density and specimen are checked", {
  shape <- quad_shape()
  expect_crestline_error(shape_mesh(shape, dense = 2), "specimen()")
  expect_crestline_error(shape_mesh(shape, specimen = quad_specimen(), dense = 1.5), "whole number")
  expect_crestline_error(shape_mesh(shape, specimen = quad_specimen(), dense = 0), "dense")
})

test_that("the denser face of scan_a is closed, sound and nearer to the scan", {
  scan <- read_specimen(shared_data("scan_a", "surface.ply"),
                        shared_data("scan_a", "landmarks.csv"), id = "scan_a")
  shape <- fit_shape(scan, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  coarse <- shape_mesh(shape)
  dense <- expect_no_warning(shape_mesh(shape, specimen = scan, dense = 2))
  # The outer border and the underside of the nose: 142 and 26 sides.
  expect_equal(nrow(border_sides(coarse)), 168)
  expect_equal(nrow(border_sides(dense)), 336)
  expect_equal(mesh_topology(dense)$nonmanifold_edges, 0)
  expect_on_mesh(attr(dense, "points"), scan$mesh)
  normals <- t(path_normals(scan$mesh, attr(dense, "points")))
  expect_length(flipped_triangles(t(dense$vb[1:3, ]), dense$it, normals), 0)
  expect_lt(mean(off_ball(dense, scan)), mean(off_ball(coarse, scan)) / 2)
})
