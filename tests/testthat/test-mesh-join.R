# A mesh cut along a line, its right half on vertices of its own, moved by `off`.
cut_mesh <- function(mesh, off) {
  n <- ncol(mesh$vb)
  right <- colMeans(matrix(mesh$vb[1, mesh$it], 3)) > stats::median(mesh$vb[1, ])
  cut <- structure(list(vb = cbind(mesh$vb, mesh$vb + off), it = mesh$it), class = "mesh3d")
  cut$it[, right] <- cut$it[, right] + n
  cut
}
pieces_of <- function(specimen) report_count(specimen, "isolated pieces") + 1
wavy <- function() grid_mesh(21, function(x, y) sin(x / 3) + cos(y / 4))

test_that("both sides of a seam that differ by rounding are joined, the surface stays as it was", {
  for (off in c(1e-9, 1e-6, 2e-5)) {
    s <- expect_no_warning(specimen(cut_mesh(wavy(), c(off, 0, -off, 0)), outward = "keep"))
    expect_equal(pieces_of(s), 1)
    expect_equal(ncol(s$mesh$it), 800)
    expect_equal(report_count(s, "holes"), 0)
    expect_equal(report_count(s, "vertices apart by rounding"), 21)
    expect_equal(sum(row_lengths(face_normals(s$mesh))), sum(row_lengths(face_normals(wavy()))),
                 tolerance = 1e-5)
  }
})

test_that("a wider seam is told of, a gap is none", {
  for (off in c(1e-4, 0.01, 0.05)) {
    expect_warning(s <- specimen(cut_mesh(wavy(), c(off, 0, 0, 0)), id = "s", outward = "keep"),
                        "s, mesh: 42 vertices of the border", class = "crestline_seam")
    expect_equal(pieces_of(s), 2)
    expect_equal(report_count(s, "vertices on a border beside another"), 42)
  }
  expect_no_warning(specimen(cut_mesh(wavy(), c(1, 0, 0, 0)), outward = "keep"))
})

test_that("single triangles whose corners differ by rounding become one surface", {
  ball <- ball_mesh(3)
  soup <- structure(list(vb = ball$vb[, ball$it], it = matrix(seq_along(ball$it), 3)),
                    class = "mesh3d")
  apart <- with_seed(1, matrix(stats::runif(3 * 3840, -1e-7, 1e-7), 3))
  soup$vb[1:3, ] <- soup$vb[1:3, ] + apart
  s <- expect_no_warning(specimen(soup))
  expect_equal(c(ncol(s$mesh$vb), ncol(s$mesh$it), pieces_of(s)), c(642, 1280, 1))
  expect_true(all(s$geometry$twin > 0))
  expect_equal(s$mesh$vb[, s$vertices], soup$vb, tolerance = 1e-6)
})

test_that("what is not apart by rounding keeps its numbers bit for bit", {
  ball <- ball_mesh(3)
  s <- specimen(ball)
  expect_identical(s$mesh$vb, ball$vb)
  expect_identical(s$mesh$it, ball$it)
  # A short edge of the border, and inner vertices that touch another sheet.
  short <- wavy()
  short$vb[1:3, 2] <- short$vb[1:3, 1] + c(1e-6, 0, 0)
  expect_identical(specimen(short, outward = "keep")$mesh$vb, short$vb)
  folded <- wavy()
  folded$vb[1:3, 60] <- folded$vb[1:3, 200] + 1e-7
  expect_identical(specimen(folded, outward = "keep")$mesh$vb, folded$vb)
})

# Two sheets that meet at y = 10, the second with `times` as many vertices, those between moved by
# `off`.
t_junctions <- function(times, off = 0) {
  height <- function(x) 0.02 * (x - 10)^2
  strip <- function(nx, first) {
    low <- as.vector(outer(seq_len(nx - 1), (0:9) * nx, `+`)) + first
    cbind(rbind(low, low + 1, low + nx), rbind(low + 1, low + nx + 1, low + nx))
  }
  a <- expand.grid(x = 0:20, y = 0:10)
  b <- expand.grid(x = seq(0, 20, 1 / times), y = 10:20)
  mesh <- structure(list(vb = rbind(c(a$x, b$x), c(a$y, b$y), height(c(a$x, b$x)), 1),
                         it = cbind(strip(21, 0), strip(20 * times + 1, 231))), class = "mesh3d")
  line <- 231 + which(b$y == 10)
  x <- mesh$vb[1, line]
  mesh$vb[3, line] <- stats::approx(0:20, height(0:20), x)$y
  mesh$vb[2, line] <- mesh$vb[2, line] + off * (x %% 1 != 0)
  mesh
}

test_that("edges are divided at the vertices on them, and a curve crosses the line", {
  for (times in 2:4) {
    mesh <- t_junctions(times)
    s <- specimen(mesh, rbind(a = c(10, 2, 0), b = c(10, 18, 0)), outward = "keep")
    expect_equal(report_count(s, "vertices on edges of other triangles"), 20 * (times - 1))
    expect_equal(pieces_of(s), 1)
    expect_equal(ncol(s$mesh$it), ncol(mesh$it) + 20 * (times - 1))
    expect_equal(sum(row_lengths(face_normals(s$mesh))), sum(row_lengths(face_normals(mesh))))
    expect_equal(report_count(s, "faces without area"), 0)
  }
  valley <- ridge_curve(s, "a", "b", "valley", radius = 4, width = 4, n = 9)
  expect_lt(max(abs(as.data.frame(valley)$x - 10)), 0.1)
  expect_warning(s <- specimen(t_junctions(2, 0.01), outward = "keep"), class = "crestline_seam")
  expect_equal(pieces_of(s), 2)
})

# The mesh twice, the second time moved inwards by `gap`; `flip`: facing the other way.
two_skins <- function(mesh, gap, flip = FALSE) {
  inner <- mesh$vb
  inner[1:3, ] <- inner[1:3, ] - gap * vertex_normals(mesh)[1:3, ]
  it <- mesh$it + ncol(mesh$vb)
  structure(list(vb = cbind(mesh$vb, inner),
                 it = cbind(mesh$it, if (flip) it[c(1, 3, 2), ] else it)), class = "mesh3d")
}

test_that("a second skin is joined where it differs by rounding, else told of", {
  for (flip in c(FALSE, TRUE)) {
    s <- expect_no_warning(specimen(two_skins(ball_mesh(3), 1e-7, flip)))
    expect_equal(c(ncol(s$mesh$vb), ncol(s$mesh$it)), c(642, 1280))
    suppressWarnings(expect_warning(s <- specimen(two_skins(ball_mesh(3), 0.01, flip), id = "d"),
                                    "100 % of the surface is there twice",
                                    class = "crestline_double_skin"))
    expect_equal(report_count(s, "per cent of the surface with a second skin"), 100)
  }
  lid <- two_skins(wavy(), 0.05)
  rim <- border_vertices(wavy()$it, mesh_topology(wavy())$twin)
  lid$it[lid$it %in% (rim + 441)] <- lid$it[lid$it %in% (rim + 441)] - 441
  expect_warning(specimen(lid, outward = "keep"), class = "crestline_double_skin")
  # A wall is no second skin, nor is the sheet beside a cut.
  expect_no_warning(specimen(two_skins(ball_mesh(3), 0.5, TRUE), outward = "keep"))
  expect_no_warning(specimen(cut_mesh(wavy(), c(0.4, 0, 0, 0)), outward = "keep"))
})

test_that("a face whose scans were not fused is told of, a good scan is not", {
  data("humface", package = "Rvcg", envir = environment())
  whole <- expect_no_warning(specimen(humface))
  expect_warning(specimen(two_skins(whole$mesh, 0.4)), class = "crestline_double_skin")
})
