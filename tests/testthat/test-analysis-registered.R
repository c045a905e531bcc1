# Three balls of one topology as files, the second stretched, the third turned and moved.
registered_files <- function() {
  ball <- Rvcg::vcgSphere(2)
  turn <- rbind(c(0, -1, 0), c(1, 0, 0), c(0, 0, 1))
  shift <- c(10, -3, 5)
  files <- file.path(tempfile("registered"), c("a.obj", "b.ply", "c.obj"))
  dir.create(dirname(files[1]))
  vb <- ball$vb[1:3, ]
  each <- list(vb, vb * c(2, 1, 1), turn %*% vb + shift)
  for (i in 1:3) {
    mesh <- structure(list(vb = rbind(each[[i]], 1), it = ball$it), class = "mesh3d")
    write_mesh(mesh, files[i])
  }
  list(files = files, ball = ball, each = each, turn = turn, shift = shift)
}

test_that("vertices come in their order, whatever the format, and values by vertex still fit", {
  at <- registered_files()
  on.exit(unlink(dirname(at$files[1]), recursive = TRUE))
  faces <- read_registered(at$files)
  expect_equal(dim(faces$coords), c(ncol(at$ball$vb), 3, 3))
  for (i in 1:3) expect_equal(unname(faces$coords[, , i]), t(at$each[[i]]), tolerance = 1e-12,
                              ignore_attr = TRUE)
  expect_equal(faces$triangles, at$ball$it, ignore_attr = TRUE)
  expect_s3_class(suppressWarnings(align(faces$coords, "ball", triangles = faces$triangles)),
                  "aligned")
  other <- file.path(dirname(at$files[1]), "other.obj")
  write_mesh(Rvcg::vcgSphere(1), other)
  expect_crestline_error(read_registered(c(at$files[1], other)), c("other", "triangles"))
  expect_crestline_error(read_registered("x.stl"), "x.stl")
  # Two files of one name are told apart by their folders.
  twin <- file.path(dirname(at$files[1]), "second", "a.obj")
  dir.create(dirname(twin))
  file.copy(at$files[3], twin)
  twins <- read_registered(c(at$files[1], twin))$coords
  expect_equal(basename(dirname(dimnames(twins)[[3]])),
               c(basename(dirname(at$files[1])), "second"))
})

test_that("points go to the same place of every mesh", {
  at <- registered_files()
  on.exit(unlink(dirname(at$files[1]), recursive = TRUE))
  faces <- read_registered(at$files)
  ball <- structure(list(vb = rbind(at$each[[1]], 1), it = at$ball$it), class = "mesh3d")
  # Points inside faces: affine maps of the mesh are affine maps of them.
  corner <- at$ball$it[, c(3, 50, 200)]
  x <- t(apply(corner, 2, function(v) at$each[[1]][, v] %*% c(0.2, 0.3, 0.5)))
  rownames(x) <- c("one", "two", "three")
  carried <- carry_points(rbind(x, gone = NA), ball, faces$coords)
  expect_equal(carried[1:3, , 1], x, tolerance = 1e-8, ignore_attr = TRUE)
  expect_equal(carried[1:3, , 2], x %*% diag(c(2, 1, 1)), tolerance = 1e-8, ignore_attr = TRUE)
  expect_equal(carried[1:3, , 3], sweep(x %*% t(at$turn), 2, at$shift, "+"), tolerance = 1e-8,
               ignore_attr = TRUE)
  expect_true(all(is.na(carried["gone", , ])))
  expect_crestline_error(carry_points(rbind(far = c(5, 0, 0)), ball, faces$coords), "far")
  expect_crestline_error(carry_points(x, ball, faces$coords[-1, , ]), "`to`")
})
