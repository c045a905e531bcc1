# The landmarks of Rvcg's humface, placed by hand (inst/extdata/README.md): do they stand where they
# say?

humface_mesh <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  data
}

humface_points <- function(name = "humface_landmarks.csv") {
  file <- system.file("extdata", name, package = "crestline")
  table <- utils::read.csv(file)
  matrix(as.matrix(table[c("x", "y", "z")]), ncol = 3,
         dimnames = list(table$name, c("x", "y", "z")))
}

# The landmarks mirrored left for right, relabelled, and fitted to themselves without scaling.
mirrored <- function(points) {
  names <- chartr("LR", "RL", rownames(points))
  image <- points[names, ] %*% diag(c(-1, 1, 1))
  centred <- sweep(image, 2, colMeans(image))
  parts <- svd(crossprod(centred, sweep(points, 2, colMeans(points))))
  turn <- parts$u %*% diag(c(1, 1, det(parts$u %*% t(parts$v)))) %*% t(parts$v)
  sweep(centred %*% turn, 2, -colMeans(points))
}

row_distance <- function(a, b) sqrt(rowSums((a - b)^2))

test_that("humface has the 23 landmarks of the face, each once", {
  sided <- c("ac", "ex", "en", "t", "cph", "ch", "oi")
  middle <- c("pn", "sn", "se", "n", "ls", "st", "li", "sl", "gn")
  expect_setequal(rownames(humface_points()), c(middle, paste0(sided, "L"), paste0(sided, "R")))
  expect_identical(anyDuplicated(rownames(humface_points())), 0L)
})

test_that("humface's landmarks lie on its surface", {
  points <- humface_points()
  closest <- Rvcg::vcgClostKD(points, humface_mesh()$humface, sign = FALSE)
  expect_lt(max(row_distance(points, t(closest$vb[1:3, ]))), 1e-4)
})

test_that("eye corners, nose tip and mouth corners agree with Rvcg's own to 1.5 mm", {
  own <- humface_mesh()$humface.lm
  ours <- humface_points()[c("exR", "enR", "enL", "exL", "pn", "chR", "chL"), ]
  expect_lt(max(row_distance(own, ours)), 1.5)
})

test_that("L is the subject's own left: across x up points out of the face", {
  points <- humface_points()
  across <- points["exL", ] - points["exR", ]
  up <- points["n", ] - points["gn", ]
  out <- c(across[2] * up[3] - across[3] * up[2], across[3] * up[1] - across[1] * up[3],
           across[1] * up[2] - across[2] * up[1])
  mesh <- Rvcg::vcgUpdateNormals(humface_mesh()$humface)
  tip <- which.min(colSums((mesh$vb[1:3, ] - points["pn", ])^2))
  expect_gt(sum(out * mesh$normals[1:3, tip]), 0)
})

test_that("left and right landmarks mirror each other: face to 1.2 mm, ear to 2 mm", {
  points <- humface_points()
  asymmetry <- row_distance(points, mirrored(points))
  ear <- grepl("^(t|oi)[LR]$", names(asymmetry))
  expect_lt(max(asymmetry[!ear]), 1.2)
  expect_lt(max(asymmetry[ear]), 2)
})

test_that("landmarks of valleys stand in valleys, those of ridges on ridges", {
  points <- humface_points()
  mesh <- Rvcg::vcgUpdateNormals(humface_mesh()$humface)
  nearest <- apply(points, 1, function(p) which.min(colSums((mesh$vb[1:3, ] - p)^2)))
  bend <- curvature(mesh, radius = 5, vertices = unname(nearest))
  mean_curvature <- stats::setNames((bend$k1 + bend$k2)[nearest] / 2, rownames(points))
  valleys <- c("acL", "acR", "exL", "exR", "enL", "enR", "chL", "chR", "st", "sl")
  expect_true(all(mean_curvature[valleys] > 0))
  expect_true(all(mean_curvature[c("pn", "ls", "cphL", "cphR", "li", "gn")] < 0))
})

test_that("the second marking has the same landmarks, on the surface, and is another one", {
  first <- humface_points()
  second <- humface_points("humface_landmarks_2.csv")
  expect_setequal(rownames(second), rownames(first))
  closest <- Rvcg::vcgClostKD(second, humface_mesh()$humface, sign = FALSE)
  expect_lt(max(row_distance(second, t(closest$vb[1:3, ]))), 1e-4)
  # Two markings of a face are 1 to 3 mm apart (RMS); a landmark named for another one would be 10
  # and more.
  apart <- row_distance(first, second[rownames(first), ])
  expect_gt(min(apart), 0.1)
  expect_gt(sqrt(mean(apart^2)), 1)
  expect_lt(sqrt(mean(apart^2)), 3)
  expect_lt(max(apart), 6)
})

test_that("the ridge of a lower lid is the same from either marking, off its ends", {
  ridge <- function(name) {
    face <- specimen(humface_mesh()$humface, humface_points(name), id = "humface")
    route <- curve_route(keep_away = keep_side("exL", "enL", "acL"), trust = c(0, 0.75))
    ridge_curve(face, "exL", "enL", "ridge", 5, 15, 9, ridge_settings(error = FALSE), route)
  }
  first <- ridge("humface_landmarks.csv")$path
  second <- ridge("humface_landmarks_2.csv")$path
  inner <- as.matrix(first[first$s > 0.2 * max(first$s) & first$s < 0.8 * max(first$s),
                           c("x", "y", "z")])
  expect_gt(nrow(inner), 5)
  expect_lt(max(nearest_on_polyline(inner, as.matrix(second[c("x", "y", "z")]))$distance), 0.25)
})
