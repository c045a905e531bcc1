# A long ridge that ends at x = -15, and one that leaves it at x = 3 (heights and widths in mm).
crossed_ridges <- function(spacing = 0.9) {
  side <- seq(-27, 27, by = spacing)
  at <- expand.grid(x = side, y = side)
  at <- with_seed(1, at + stats::runif(2 * nrow(at), -0.2, 0.2) * spacing)
  hump <- function(d) 4 * exp(-d^2 / 8)
  z <- pmax(hump(at$y) * stats::plogis(at$x + 15), hump(at$x - 3) * (at$y > 0))
  n <- length(side)
  turned <- rep(c(TRUE, FALSE), length.out = (n - 1)^2)
  mesh <- list(vb = t(cbind(as.matrix(at), z, 1)), it = grid_triangles(n, n, turned))
  structure(mesh, class = "mesh3d")
}

test_that("an ellipsoid has its caps at the ends of its longest axis, to a thousandth of it", {
  ball <- ball_mesh(4)
  ball$vb[1:3, ] <- ball$vb[1:3, ] * c(10, 6, 5)
  found <- suggest_landmarks(structure(ball[c("vb", "it")], class = "mesh3d"), 2.5)
  expect_equal(found$kind, c("cap", "cap"))
  expect_equal(sort(found$x), c(-10, 10), tolerance = 1e-3)
  expect_lt(max(abs(c(found$y, found$z))), 0.01)
  # The lesser curvature at the end of the axis a is a / b^2, here 10 / 36
  expect_equal(found$strength, rep(10 / 36, 2), tolerance = 0.05)
  expect_on_mesh(found, ball)
  inside <- ball
  inside$it <- inside$it[c(1, 3, 2), ]
  inside <- structure(inside[c("vb", "it")], class = "mesh3d")
  expect_equal(suggest_landmarks(inside, 2.5)$kind, c("cup", "cup"))
})

test_that("a ridge ends and meets another where it was made to", {
  mesh <- crossed_ridges()
  found <- suggest_landmarks(mesh, 3, n = 1, kinds = c("end", "crossing"))
  expect_equal(found$landmark, c("crossing1", "end1"))
  gap <- function(kind, x, y) {
    sqrt(sum((unlist(found[found$kind == kind, c("x", "y")]) - c(x, y))^2))
  }
  expect_lt(gap("crossing", 3, 0), 1)
  expect_lt(gap("end", -15, 0), 2.5)
  expect_match(found$reason[1], "3 ridges meet")
  expect_match(found$reason[2], "a ridge of strength .* fades to")
  expect_equal(suggest_landmarks(mesh, 3, kinds = "end")$kind[1], "end")
  expect_equal(nrow(suggest_landmarks(mesh, 3, faint = 100)), 0)
})

test_that("suggestions do not depend on pose, unit and order of the mesh", {
  mesh <- crossed_ridges(1.2)
  before <- suggest_landmarks(mesh, 3)
  xyz <- as.matrix(before[c("x", "y", "z")])
  turn <- rotation_about(c(0.3, -1.1, 0.7))
  order <- with_seed(3, sample(ncol(mesh$vb)))
  moved <- mesh
  moved$vb[1:3, ] <- 25 * turn %*% mesh$vb[1:3, ] + c(100, -50, 3)
  moved$vb <- moved$vb[, order]
  moved$it <- matrix(order(order)[mesh$it], 3)[, with_seed(4, sample(ncol(mesh$it)))]
  after <- suggest_landmarks(moved, 75)
  expect_equal(after$landmark, before$landmark)
  expect_equal(after$strength * 25, before$strength, tolerance = 1e-6)
  expect_equal(as.matrix(after[c("x", "y", "z")]),
               sweep(25 * xyz %*% t(turn), 2, c(100, -50, 3), `+`), tolerance = 1e-5,
               ignore_attr = TRUE)
})

test_that("suggestions are landmarks of a specimen, and are printed and drawn", {
  face <- humface_scan()
  found <- suggest_landmarks(face, 10, n = 3)
  nose <- humface_landmarks()["pn", ]
  expect_lt(min(sqrt(rowSums(sweep(as.matrix(found[found$kind == "cap", c("x", "y", "z")]), 2,
                                   nose)^2))), 5)
  expect_equal(rownames(specimen(face, found)$landmarks), found$landmark)
  expect_output(print(found), "<suggested_landmarks> .* at radius 10: 3 caps")
  expect_output(print(found, most = 1), "and [0-9]+ more")
  expect_output(print(found[c("x", "kind")]), "cap")
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  scene <- plot(found, face, "plain", engine = "picture", resolution = 20, samples = 1)
  expect_s3_class(scene, "picture_scene")
  expect_error(plot(found, ball_mesh(), engine = "picture"), class = "crestline_wrong_mesh")
})
