ball_landmarks <- rbind(top = c(0, 0, 1), front = c(1, 0, 0), gone = NA)

test_that("a clean mesh passes unchanged, with landmarks exactly on it", {
  ball <- ball_mesh()
  s <- specimen(ball, ball_landmarks, id = "ball")
  expect_s3_class(s, "specimen")
  expect_identical(s$mesh$vb, ball$vb)
  expect_equal(s$mesh$it, ball$it)
  expect_equal(colSums(s$mesh$normals[1:3, ] * ball$vb[1:3, ]), rep(1, ncol(ball$vb)),
               tolerance = 0.01)
  expect_on_mesh(s$geometry$located[1:2, ], s$mesh)
  expect_identical(unname(s$landmarks[1:2, ]), unname(as.matrix(s$geometry$located[1:2, 1:3])))
  expect_equal(dimnames(s$landmarks), list(c("top", "front", "gone"), c("x", "y", "z")))
  expect_true(all(is.na(s$landmarks["gone", ])))
  expect_equal(report_count(s, "landmarks missing"), 1)
  expect_equal(s$geometry$twin, mesh_topology(s$mesh)$twin)
  expect_equal(unique(s$geometry$piece), 1)
})

test_that("the report has a row for every check, also where nothing is found", {
  report <- specimen(ball_mesh())$report
  expect_named(report, c("check", "count", "action"))
  expect_setequal(report$check, c(
    "polygons with fewer than three corners", "homogeneous co-ordinates", "quads",
    "faces naming missing vertices", "non-finite co-ordinates", "vertices far from all others",
    "duplicate vertices", "point cloud without triangles", "degenerate faces", "duplicate faces",
    "vertices apart by rounding", "vertices on edges of other triangles",
    "faces wound against their neighbours", "debris", "unreferenced vertices",
    "faces looking inwards", "faces without area", "non-manifold edges", "isolated pieces", "holes",
    "vertices on a border beside another", "per cent of the surface with a second skin",
    "landmarks missing", "landmarks beside the surface", "landmarks mirrored"
  ))
  expect_true(all(report$count == 0))
  expect_true(all(report$action == "none"))
})

test_that("print fits a screen and tells what was mended", {
  landmarks <- t(ball_mesh()$vb[1:3, 1:60])
  rownames(landmarks) <- paste0("landmark", 1:60)
  ball <- ball_mesh()
  ball$vb <- cbind(ball$vb, c(9, 9, 9, 1))
  text <- capture.output(print(specimen(ball, landmarks, id = "ball")))
  expect_lte(length(text), 12)
  expect_lte(max(nchar(text)), 80)
  expect_match(text[1], "ball: 162 vertices, 320 triangles")
  expect_match(text, "1 unreferenced vertex: left out", all = FALSE)
})

test_that("a landmark is found by its name, with its face and weights", {
  s <- specimen(ball_mesh(), ball_landmarks, id = "ball")
  point <- landmark_point(s, "front")
  expect_equal(unlist(point[1:3]), s$landmarks["front", ])
  expect_on_mesh(point, s$mesh)
})

test_that("a landmark that is unknown, missing or was moved off is refused by name", {
  s <- specimen(ball_mesh(), ball_landmarks, id = "ball")
  expect_crestline_error(landmark_point(s, "fron"), c("ball", "fron", "Near names: front"),
                         id = "ball")
  expect_crestline_error(landmark_point(s, NA), "Near names")
  expect_crestline_error(landmark_point(specimen(ball_mesh()), "a"), "has no landmarks")
  expect_crestline_error(landmark_point(s, "gone"), c("ball", "gone", "missing"), id = "ball")
  s$landmarks["top", ] <- c(0, 0, 1.5)
  expect_crestline_error(landmark_point(s, "top"), c("ball", "top", "off the surface"))
})

test_that("a landmark changed by the user is put on the mesh anew", {
  s <- specimen(ball_mesh(), ball_landmarks)
  s$landmarks["top", ] <- c(0, 1, 0)
  expect_lt(max(abs(unlist(landmark_point(s, "top")[1:3]) - c(0, 1, 0))), 0.02)
  s$landmarks <- rbind(s$landmarks, new = c(-1, 0, 0))
  expect_on_mesh(landmark_point(s, "new"), s$mesh)
})

test_that("id must be one string", {
  expect_crestline_error(specimen(ball_mesh(), id = c("a", "b")), "id")
  expect_equal(specimen(ball_mesh(), id = 7)$id, "7")
})

test_that("landmarks changed since are located once, and used as if they had been given so", {
  ball <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1), front = c(1, 0, 0)), id = "ball")
  ball$landmarks["top", ] <- c(0, 0.6, 0.8)
  ball$landmarks <- rbind(ball$landmarks, side = c(0, 1, 0), off = c(9, 9, 9), gone = NA)
  located <- with_located(ball)
  for (name in c("top", "front", "side")) {
    expect_identical(landmark_point(located, name), landmark_point(ball, name), ignore_attr = TRUE)
    expect_true(name %in% rownames(located$geometry$landmarks))
  }
  expect_identical(located$landmarks, ball$landmarks)
  expect_crestline_error(landmark_point(located, "off"), "off", id = "ball")
  expect_crestline_error(landmark_point(located, "gone"), "missing (NA)", id = "ball")
})

test_that("a specimen comes to another unit with its landmarks, and says so", {
  at <- rbind(top = c(0, 0, 1), front = c(1, 0, 0))
  metres <- specimen(Rvcg::vcgSphere(2), at, id = "ball")
  mm <- specimen(Rvcg::vcgSphere(2), at, id = "ball", rescale = 1000)
  expect_equal(mm$mesh$vb[1:3, ], 1000 * metres$mesh$vb[1:3, ])
  expect_equal(mm$landmarks, 1000 * metres$landmarks)
  expect_output(print(mm), "multiplied by 1000, landmarks too", fixed = TRUE)
  expect_match(provenance_lines(specimen_provenance(mm)), "multiplied by 1000", all = FALSE)
  expect_crestline_error(specimen(Rvcg::vcgSphere(2), at, rescale = 0), "rescale")
  expect_crestline_error(specimen(list(vb = 1), rescale = 2), "mesh3d")
})

# A ball of some subdivision beside another.
two_balls <- function(second = 3, apart = 5) {
  one <- Rvcg::vcgSphere(3)
  other <- Rvcg::vcgSphere(second)
  other$vb[1, ] <- other$vb[1, ] + apart
  structure(list(vb = cbind(one$vb, other$vb), it = cbind(one$it, other$it + ncol(one$vb))),
            class = "mesh3d")
}
top <- rbind(top = c(0, 0, 1), front = c(0, 1, 0))

test_that("a second large piece without landmarks is told of, with its share", {
  expect_warning(one <- specimen(two_balls(), top, id = "pair"), "50 % of the triangles",
                 class = "crestline_bare_piece")
  row <- one$report[one$report$check == "isolated pieces", ]
  expect_match(row$action, "the largest has 50.0 % of the triangles")
  expect_output(print(one), "50.0 %")
})

test_that("scraps, pieces with landmarks, and meshes without landmarks are not told of", {
  expect_no_warning(small <- specimen(two_balls(1), top, id = "scrap"))
  expect_match(small$report$action[small$report$check == "isolated pieces"], "5.9 %")
  expect_no_warning(specimen(two_balls(), rbind(top, other = c(5, 0, 1)), id = "both"))
  expect_no_warning(specimen(two_balls(), id = "bare"))
})
