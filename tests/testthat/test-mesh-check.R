test_that("what is no mesh is refused with the reason", {
  expect_crestline_error(specimen(1:3, id = "s1"), c("s1", "mesh3d"), id = "s1")
  expect_crestline_error(specimen(structure(list(), class = "mesh3d")), "no vertices")
  few <- structure(list(vb = rbind(diag(3), 1)), class = "mesh3d")
  expect_crestline_error(specimen(few, id = "few"),
                         c("few", "no triangles", "3 points"), id = "few")
  line <- structure(list(vb = rbind(0:2, 0:2, 0:2, 1), it = matrix(1:3)), class = "mesh3d")
  expect_crestline_error(specimen(line), "no triangle with an area")
  bad <- ball_mesh()
  bad$it[1, 1:2] <- c(0L, 9999L)
  expect_crestline_error(specimen(bad, id = "b"), c("2 of 320 faces", "do not exist"), id = "b")
  bad$it <- bad$it[1:2, 1:2]
  bad$it <- matrix(1:4, 2)
  expect_crestline_error(specimen(bad), "3 x m")
})

test_that("homogeneous co-ordinates are divided out and three rows completed", {
  ball <- ball_mesh()
  scaled <- ball
  scaled$vb[, 1:10] <- 4 * scaled$vb[, 1:10]
  s <- specimen(scaled)
  expect_equal(s$mesh$vb, ball$vb)
  expect_equal(report_count(s, "homogeneous co-ordinates"), 10)
  scaled <- ball
  scaled$vb <- ball$vb[1:3, ]
  expect_equal(specimen(scaled)$mesh$vb, ball$vb)
})

test_that("quads are cut in two, with the same outline and sense", {
  grid <- grid_mesh(4)
  low <- grid$it[1, 1:9]
  quad <- structure(list(vb = grid$vb, ib = rbind(low, low + 1, low + 5, low + 4)),
                    class = "mesh3d")
  s <- specimen(quad)
  expect_equal(ncol(s$mesh$it), 18)
  expect_equal(report_count(s, "quads"), 9)
  expect_equal(face_normals(s$mesh), matrix(c(0, 0, 1), 18, 3, byrow = TRUE))
})

test_that("non-finite vertices go, with their faces", {
  ball <- ball_mesh()
  ball$vb[2, 5] <- NaN
  ball$vb[1, 6] <- Inf
  touching <- sum(colSums(matrix(ball$it %in% 5:6, 3)) > 0)
  expect_warning(s <- specimen(ball), "4 % of the triangles were left out (2 non-finite",
                 fixed = TRUE, class = "crestline_triangles_dropped")
  expect_equal(report_count(s, "non-finite co-ordinates"), 2)
  expect_equal(ncol(s$mesh$it), 320 - touching)
  expect_equal(s$mesh$vb, ball$vb[, -(5:6)])
})

test_that("equal vertices are merged, so that a soup of triangles becomes one piece", {
  ball <- ball_mesh()
  soup <- structure(list(vb = ball$vb[, ball$it], it = matrix(seq_along(ball$it), 3)),
                    class = "mesh3d")
  s <- specimen(soup)
  expect_equal(ncol(s$mesh$vb), 162)
  expect_equal(report_count(s, "duplicate vertices"), 960 - 162)
  expect_equal(report_count(s, "holes"), 0)
  expect_equal(s$mesh$vb[, s$mesh$it], soup$vb)
})

test_that("degenerate, duplicate and areal nothing faces are told apart", {
  grid <- grid_mesh(5)
  grid$it <- cbind(grid$it, c(1L, 1L, 2L), grid$it[c(2, 3, 1), 4], grid$it[c(3, 2, 1), 7])
  s <- specimen(grid)
  expect_equal(report_count(s, "degenerate faces"), 1)
  expect_equal(report_count(s, "duplicate faces"), 2)
  expect_equal(s$mesh$it, grid_mesh(5)$it)
  sliver <- grid_mesh(3)
  sliver$vb[1:3, 5] <- (sliver$vb[1:3, 2] + sliver$vb[1:3, 4]) / 2
  s <- specimen(sliver)
  expect_equal(report_count(s, "faces without area"), 1)
  expect_equal(ncol(s$mesh$it), 8)
})

test_that("unreferenced vertices go and the others keep their order", {
  ball <- ball_mesh()
  more <- ball
  more$vb <- cbind(more$vb[, 1:3], c(7, 7, 7, 1), more$vb[, -(1:3)], c(8, 8, 8, 1))
  more$it <- more$it + (more$it > 3)
  more$material <- list(color = sprintf("#%06X", seq_len(164)))
  s <- specimen(more)
  expect_equal(report_count(s, "unreferenced vertices"), 2)
  expect_equal(s$mesh$vb, ball$vb)
  expect_equal(s$mesh$it, ball$it)
  expect_equal(s$mesh$material$color, sprintf("#%06X", seq_len(164)[-c(4, 164)]))
})

test_that("three faces on one edge are told and act as borders", {
  grid <- grid_mesh(4)
  grid$vb <- cbind(grid$vb, c(1.5, 1, 1, 1))
  grid$it <- cbind(grid$it, c(6L, 7L, 17L))
  s <- specimen(grid)
  expect_equal(report_count(s, "non-manifold edges"), 1)
  expect_equal(ncol(s$mesh$it), 19)
})

test_that("pieces are counted, and debris goes", {
  ball <- ball_mesh(3)
  two <- structure(list(vb = cbind(ball$vb, ball$vb + c(5, 0, 0, 0), c(0, 0, 9, 1), c(1, 0, 9, 1),
                                   c(0, 1, 9, 1)),
                        it = cbind(ball$it, ball$it + 642L, 1285:1287)), class = "mesh3d")
  s <- specimen(two)
  expect_equal(report_count(s, "debris"), 1)
  expect_equal(report_count(s, "isolated pieces"), 1)
  expect_equal(ncol(s$mesh$vb), 2 * 642)
  expect_equal(tabulate(s$geometry$piece), c(1280, 1280))
  s <- specimen(two, debris = 0)
  expect_equal(report_count(s, "isolated pieces"), 2)
})

test_that("a mesh whose pieces are all debris is refused with what to do", {
  loose <- function(n) {
    vb <- rbind(rep(seq_len(n), each = 3) + c(0, 0.8, 0), rep(c(0, 0, 30), n), 0, 1)
    structure(list(vb = vb, it = matrix(seq_len(3 * n), 3)), class = "mesh3d")
  }
  kept <- function(...) {
    ncol(suppressWarnings(specimen(...), classes = "crestline_loose_triangles")$mesh$it)
  }
  expect_equal(kept(loose(1000)), 1000)
  expect_crestline_error(specimen(loose(1001), id = "loose"), c("1001 pieces", "`debris`"), "loose")
  expect_equal(kept(loose(1001), debris = 0), 1001)
})

test_that("holes are border loops beyond the outer one", {
  grid <- grid_mesh(8)
  expect_equal(report_count(specimen(grid), "holes"), 0)
  grid$it <- grid$it[, -c(10, 59, 40)]
  expect_equal(report_count(specimen(grid), "holes"), 2)
  expect_equal(report_count(specimen(ball_mesh()), "holes"), 0)
  # Two faces that meet at a corner: one hole of figure-eight shape or two, never none.
  ball <- ball_mesh()
  ball$it <- ball$it[, -c(1, 200)]
  expect_equal(report_count(specimen(ball), "holes"), 1)
})

test_that("a point cloud is triangulated and the report says so", {
  cloud <- ball_mesh(4)
  cloud$it <- NULL
  expect_warning(s <- specimen(cloud, id = "c"), "c, mesh: there are points only",
                 class = "crestline_triangulated")
  expect_equal(report_count(s, "point cloud without triangles"), ncol(cloud$vb))
  expect_gt(ncol(s$mesh$it), 0.9 * ncol(ball_mesh(4)$it))
  outward <- colSums(s$mesh$normals[1:3, ] * s$mesh$vb[1:3, ])
  expect_gt(mean(outward > 0.9), 0.99)
})

test_that("results do not depend on scale", {
  ball <- ball_mesh()
  for (scale in c(1e-30, 1e-3, 1e3, 1e30)) {
    scaled <- ball
    scaled$vb[1:3, ] <- ball$vb[1:3, ] * scale
    s <- specimen(scaled, rbind(a = c(0, 0, scale)))
    expect_equal(s$mesh$normals, specimen(ball)$mesh$normals)
    expect_true(all(s$report$count[s$report$check != "landmarks beside the surface"] == 0))
  }
})

test_that("a map tells which vertex became which, through merges, losses and debris", {
  ball <- ball_mesh(3)
  expect_equal(specimen(ball)$vertices, 1:642)
  ball$vb[, 100] <- ball$vb[, 101]
  ball$vb[1, 3] <- NaN
  debris <- cbind(c(0, 0, 2, 1), c(1e-3, 0, 2, 1), c(0, 1e-3, 2, 1))
  given <- structure(list(vb = cbind(ball$vb[, 1:50], debris, ball$vb[, 51:642]),
                          it = cbind(ball$it + 3L * (ball$it > 50), 51:53)), class = "mesh3d")
  s <- suppressWarnings(specimen(given))
  expect_equal(which(is.na(s$vertices)), c(3, 51:53))
  expect_equal(s$vertices[103], s$vertices[104])
  kept <- !is.na(s$vertices)
  expect_identical(s$mesh$vb[1:3, s$vertices[kept]], given$vb[1:3, kept])
  expect_setequal(s$vertices[kept], seq_len(ncol(s$mesh$vb)))
  soup <- structure(list(vb = ball_mesh()$vb[, ball_mesh()$it], it = matrix(1:960, 3)),
                    class = "mesh3d")
  s <- specimen(soup)
  expect_identical(s$mesh$vb[, s$vertices], soup$vb)
  cloud <- suppressWarnings(specimen(structure(list(vb = ball_mesh(4)$vb), class = "mesh3d")))
  expect_length(cloud$vertices, 2562)
})

test_that("far and absurd vertices go with a warning, and do not blind what goes by the size", {
  ball <- ball_mesh(4)
  for (x in c(60, 1e6, 1e30, 1e300)) {
    far <- ball
    far$vb[1, 5] <- x
    expect_warning(s <- specimen(far, id = "f"), "f, mesh: 1 vertices",
                   class = "crestline_far_vertices")
    expect_equal(s$mesh$vb, ball$vb[, -5])
  }
  many <- ball
  many$vb[1:3, 1:200] <- 1e30
  classes <- character()
  withCallingHandlers(specimen(many), warning = function(w) {
    classes <<- c(classes, class(w)[1])
    invokeRestart("muffleWarning")
  })
  expect_setequal(classes, c("crestline_far_vertices", "crestline_triangles_dropped"))
  stray <- ball
  stray$vb <- cbind(stray$vb, c(1e9, 0, 0, 1))
  expect_equal(expect_no_warning(specimen(stray))$mesh$vb, ball$vb)
  zeros <- ball
  zeros$vb[1:3, ] <- ball$vb[1:3, ] + 1000
  zeros$vb <- cbind(zeros$vb, matrix(c(0, 0, 0, 1), 4, 4000))
  expect_equal(ncol(expect_no_warning(specimen(zeros))$mesh$vb), 2562)
  absurd <- ball
  absurd$vb[1:3, ] <- 1e300
  expect_crestline_error(specimen(absurd, id = "a"), c("a, mesh", "absurdly large"))
  absurd$vb[1:3, ] <- 7
  expect_crestline_error(specimen(absurd), "no triangle with an area")
})

test_that("a mesh that falls apart is refused or told of", {
  pieces <- function(n) {
    x <- rep(seq_len(n), each = 3)
    structure(list(vb = rbind(x + c(0, 0.8, 0), rep(c(0, 0, 30), n), 0, 1),
                   it = matrix(seq_len(3 * n), 3)), class = "mesh3d")
  }
  expect_crestline_error(specimen(pieces(1001), id = "p"),
                         c("p, mesh", "1001 pieces", "corners do not meet"))
  expect_warning(s <- specimen(pieces(300)), "100 % of the triangles touch no other",
                 class = "crestline_loose_triangles")
})

test_that("polygons of two corners are counted", {
  file <- tempfile(fileext = ".obj")
  writeLines(c("v 0 0 0", "v 1 0 0", "v 0 1 0", "f 1 2 3", "f 1 2"), file)
  expect_warning(s <- read_specimen(file), "1 polygons with fewer than three corners",
                 class = "crestline_file_warning")
  expect_equal(report_count(s, "polygons with fewer than three corners"), 1)
})
