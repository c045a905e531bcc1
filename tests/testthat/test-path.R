quarter <- function() plane_path(Rvcg::vcgSphere(4), c(1, 0, 0), c(0, 1, 0))

steps <- function(path) sqrt(rowSums(diff(as.matrix(as.data.frame(path)[c("x", "y", "z")]))^2))

test_that("a part of a path has its own length, arc lengths from 0, nothing of the whole", {
  path <- quarter()
  part <- path[5:20, ]
  expect_s3_class(part, "mesh_path")
  expect_equal(attr(part, "length"), sum(steps(part)))
  expect_equal(part$s, path$s[5:20] - path$s[5])
  expect_equal(attr(part, "length"), path$s[20] - path$s[5])
  expect_equal(as.data.frame(part)[mesh_columns], as.data.frame(path)[5:20, mesh_columns],
               ignore_attr = TRUE)
  expect_setequal(names(attributes(part)), c("names", "row.names", "class", "length", "key"))
  expect_output(print(part), "<mesh_path> 16 points")
  expect_no_match(paste(capture.output(print(part)), collapse = " "), "angle")
})

test_that("what a reference path knows of its criterion does not go with its parts", {
  path <- reference_path(Rvcg::vcgSphere(4), c(1, 0, 0), c(0, 1, 0), "plane")
  expect_true(all(c("optima", "criterion", "competing", "angle",
                    "type") %in% names(attributes(path))))
  for (part in list(path[-1, ], head(path, 4), subset(path, z > -1 & s > 0.2), path[path$s > 0.2, ],
                    rbind(path, path[0, ])[-1, ])) {
    expect_s3_class(part, "mesh_path")
    expect_setequal(names(attributes(part)), c("names", "row.names", "class", "length", "key"))
    expect_equal(part$s[1], 0)
    expect_equal(attr(part, "length"), tail(part$s, 1))
  }
})

test_that("straight steps count where points are left out; one point and none have no length", {
  path <- quarter()
  ends <- path[c(1, nrow(path)), ]
  expect_equal(attr(ends, "length"), sqrt(2))
  expect_equal(attr(path[3, ], "length"), 0)
  expect_equal(path[3, "s"], path$s[3])
  none <- path[0, ]
  expect_s3_class(none, "mesh_path")
  expect_equal(attr(none, "length"), 0)
  expect_output(print(none), "<mesh_path> 0 points")
  expect_crestline_error(path[nrow(path) + 1, ], "no such rows")
})

test_that("the whole path stays; without one of its columns it is a plain data frame", {
  path <- quarter()
  expect_identical(attributes(path[]), attributes(path))
  expect_identical(path[seq_len(nrow(path)), ], path)
  for (plain in list(path[c("x", "y", "z")], path[, c("s", "z")], path[2:4, -1], path["s"])) {
    expect_identical(class(plain), "data.frame")
    expect_setequal(names(attributes(plain)), c("names", "row.names", "class"))
  }
  expect_null(rownames(as.matrix(path[c("x", "y", "z")])))
  expect_identical(rownames(path[2:4, c("x", "y")]), c("2", "3", "4"))
  expect_identical(path[, "x"], path$x)
  expect_identical(path[["x"]], path$x)
  path$depth <- path$z
  expect_identical(path[3:5, ]$depth, path$z[3:5])
})

test_that("a path whose columns are set stays one as long as it has them all", {
  path <- quarter()
  doubled <- path
  for (axis in c("x", "y", "z")) doubled[[axis]] <- 2 * path[[axis]]
  expect_equal(attr(doubled, "length"), 2 * attr(path, "length"))
  expect_equal(doubled$s, 2 * path$s)
  expect_null(attr(doubled, "angle"))
  noted <- path
  noted$note <- "here"
  expect_identical(attributes(noted)[c("length", "angle", "key")],
                   attributes(path)[c("length", "angle", "key")])
  without <- path
  without$face <- NULL
  expect_identical(class(without), "data.frame")
  expect_null(attr(without, "length"))
})

test_that("the key and the id of the mesh stay with a part", {
  ball <- specimen(Rvcg::vcgSphere(4), id = "ball")
  path <- plane_path(ball, c(1, 0, 0), c(0, 1, 0))
  part <- path[3:8, ]
  expect_identical(attr(part, "key"), ball$key)
  expect_identical(attr(part, "id"), "ball")
  expect_identical(attr(rbind(part, path[8:9, ]), "key"), ball$key)
  # It is a path of its mesh still.
  expect_s3_class(path_coordinates(ball, path[seq(1, nrow(path), 2), ], 0.2), "path_coordinates")
})

test_that("parts put together again are the path; the common point is there once", {
  path <- quarter()
  n <- nrow(path)
  joined <- rbind(path[1:9, ], path[9:n, ])
  expect_s3_class(joined, "mesh_path")
  expect_equal(as.data.frame(joined), as.data.frame(path), ignore_attr = TRUE)
  expect_equal(attr(joined, "length"), attr(path, "length"))
  expect_equal(rbind(path[1:9, ], path[10:n, ])$s, path$s)
  expect_equal(rbind(path[1:9, ], NULL, path[9:20, ], path[20:n, ])$s, path$s)
  expect_null(attr(joined, "angle"))
})

test_that("paths of different meshes, and what is no path, are not joined", {
  path <- plane_path(specimen(Rvcg::vcgSphere(4), id = "ball"), c(1, 0, 0), c(0, 1, 0))
  other <- plane_path(specimen(Rvcg::vcgSphere(3), id = "other"), c(1, 0, 0), c(0, 1, 0))
  expect_crestline_error(rbind(path, other), c("2 meshes", "ball", "other"))
  expect_crestline_error(rbind(path, as.data.frame(path)), "joined with")
})

test_that("a path over a bridged hole keeps the arc lengths that it was measured along", {
  mesh <- grid_mesh(9)
  middle <- which(colSums(mesh$it == 41) > 0)
  mesh$it <- mesh$it[, -middle]
  flat <- specimen(mesh, outward = "keep")
  bridged <- bridge_holes(flat, 0.5)
  path <- plane_path(bridged, c(1, 4.3, 0), c(7, 4.3, 0))
  clear <- unbridged_path(path, flat)
  expect_lt(nrow(clear), nrow(path))
  expect_equal(attr(clear, "length"), attr(path, "length"))
  expect_true(all(clear$face <= ncol(flat$mesh$it)))
})

bent_path <- function() {
  bent <- bent_ridge(noise = 0.03)
  list(mesh = bent$mesh, path = plane_path(bent, "a", "b", 0.3))
}

test_that("points have equal chords, the ends exactly, all on the path and the mesh", {
  b <- bent_path()
  for (n in c(2, 3, 9, 50, 400)) {
    points <- resample_path(b$mesh, b$path, n)
    expect_identical(nrow(points), as.integer(n))
    expect_true(attr(points, "converged"))
    expect_lt(max(chords(points)) / min(chords(points)) - 1, 1e-8)
    expect_identical(xyz_of(points)[c(1, n), ], xyz_of(b$path)[c(1, nrow(b$path)), ],
                     ignore_attr = TRUE)
    expect_identical(points$s[c(1, n)], c(0, attr(b$path, "length")))
    expect_on_mesh(points, b$mesh)
    expect_lt(max(distance_from_line(xyz_of(points), xyz_of(b$path))), 1e-9)
  }
})

test_that("a straight path gives equal steps, a half circle the polygon's corners", {
  mesh <- grid_mesh(11)
  points <- resample_path(mesh, plane_path(mesh, c(1, 5.2, 0), c(9, 5.2, 0)), 5)
  expect_equal(points$x, c(1, 3, 5, 7, 9), tolerance = 1e-9)
  angle <- seq(0, pi, length.out = 2001)
  circle <- structure(data.frame(s = c(0, cumsum(rep(2 * sin(pi / 4000), 2000))), x = cos(angle),
                                 y = sin(angle), z = 0),
                      length = 2000 * 2 * sin(pi / 4000))
  at <- points_along(circle, attr(circle, "length") * (0:4) / 4)
  expect_equal(at[, 1], cos(pi * (0:4) / 4), tolerance = 1e-6, ignore_attr = TRUE)
})

test_that("chords that cannot be made equal in the rounds given are told", {
  b <- bent_path()
  expect_false(attr(resample_path(b$mesh, b$path, 30, iterations = 1), "converged"))
})

test_that("places between two points lie in the face of their segment", {
  b <- bent_path()
  middle <- (b$path$s[-1] + b$path$s[-nrow(b$path)]) / 2
  placed <- place_along(b$mesh, b$path, middle)
  expect_identical(placed$face, as.integer(b$path$face[-1]))
  half <- (xyz_of(b$path)[-1, ] + xyz_of(b$path)[-nrow(b$path), ]) / 2
  expect_equal(xyz_of(placed), half, tolerance = 1e-6, ignore_attr = TRUE)
})

test_that("weights in a face are barycentric, and clamped outside", {
  mesh <- grid_mesh(3)
  corners <- t(mesh$vb[1:3, mesh$it[, 1]])
  expect_equal(weights_in_faces(mesh, 1, rbind(c(0.2, 0.3, 0.5) %*% corners)),
               rbind(c(0.2, 0.3, 0.5)), ignore_attr = TRUE)
  expect_true(all(weights_in_faces(mesh, 1, rbind(c(-5, -5, 0))) >= 0))
})
