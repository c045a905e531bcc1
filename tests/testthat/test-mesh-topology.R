topology_of <- function(...) cpp_mesh_topology(matrix(as.integer(c(...)), 3), max(...))

test_that("two triangles share one edge and have four of the border", {
  pair <- topology_of(1, 2, 3, 2, 1, 4)
  # Half edges: 1: 1-2, 2: 2-3, 3: 3-1; 4: 2-1, 5: 1-4, 6: 4-2.
  expect_identical(pair$twin, matrix(c(4L, 0L, 0L, 1L, 0L, 0L), 3))
  expect_identical(pair$border_edges, 4L)
  expect_identical(pair$nonmanifold_edges, 0L)
  expect_identical(pair$pieces, 1L)
  expect_identical(pair$piece, c(1L, 1L))
})

test_that("twins are mutual, run the other way, and a closed mesh has no border", {
  mesh <- ball()
  topology <- mesh_topology(mesh)
  twin <- as.vector(topology$twin)
  expect_identical(twin[twin], seq_along(twin))
  start <- as.vector(mesh$it)
  end <- as.vector(mesh$it[c(2, 3, 1), ])
  expect_equal(start[twin], end)
  expect_equal(end[twin], start)
  expect_identical(topology$border_edges, 0L)
  expect_identical(topology$pieces, 1L)
})

test_that("a grid's border is its outline", {
  topology <- mesh_topology(grid_mesh(6))
  expect_identical(topology$border_edges, 4L * 5L)
  expect_identical(sum(topology$twin == 0), 20L)
})

test_that("an edge of three triangles belongs to none of them", {
  book <- topology_of(1, 2, 3, 2, 1, 4, 1, 2, 5)
  expect_identical(book$nonmanifold_edges, 1L)
  expect_true(all(book$twin == 0))
  expect_identical(book$border_edges, 6L)
  expect_identical(book$pieces, 3L)
})

test_that("two triangles that run through their edge the same way are not joined", {
  turned <- topology_of(1, 2, 3, 1, 2, 4)
  expect_identical(turned$nonmanifold_edges, 1L)
  expect_identical(turned$pieces, 2L)
})

test_that("pieces joined in a corner only are two pieces", {
  corner <- topology_of(1, 2, 3, 3, 4, 5)
  expect_identical(corner$piece, 1:2)
  expect_identical(corner$pieces, 2L)
})

turned <- function(mesh, face = seq_len(ncol(mesh$it))) {
  mesh$it[2:3, face] <- mesh$it[3:2, face]
  mesh
}

test_that("faces wound against their neighbours are turned to the sense of the greater part", {
  set.seed(1)
  ball <- ball_mesh(3)
  mixed <- turned(ball, sample(ncol(ball$it), 300))
  s <- specimen(mixed)
  expect_equal(s$mesh$it, ball$it)
  expect_equal(report_count(s, "faces wound against their neighbours"), 300)
  expect_equal(report_count(s, "non-manifold edges"), 0)
})

test_that("inside-out meshes are turned round with a warning, open ones too", {
  data("humface", "dummyhead", package = "Rvcg", envir = environment())
  face <- grid_mesh(21, function(x, y) -0.1 * ((x - 10)^2 + (y - 10)^2))
  for (mesh in list(ball_mesh(), face, humface, dummyhead.mesh)) {
    # The closed mouth of the second head is a slit.
    right <- suppressWarnings(specimen(mesh), classes = "crestline_seam")
    expect_no_warning(specimen(mesh), class = "crestline_warning", message = "looked inwards")
    expect_equal(report_count(right, "faces looking inwards"), 0)
    expect_warning(mended <- specimen(turned(mesh), id = "io"), "specimen io.*looked inwards",
                   class = "crestline_warning")
    expect_equal(report_count(mended, "faces looking inwards"), ncol(right$mesh$it))
    expect_equal(mended$mesh$normals, right$mesh$normals)
  }
})

test_that("inside-out is seen on real scans", {
  for (file in c(shared_data("scan_a", "surface.ply"), shared_data("template_male", "surface.ply")))
    {
    mesh <- read_mesh(file, "scan")
    expect_equal(report_count(specimen(mesh), "faces looking inwards"), 0)
    expect_warning(s <- specimen(turned(mesh)), class = "crestline_warning")
    expect_equal(s$mesh$it[2:3, 1], mesh$it[c(2, 3), 1])
  }
})

test_that("outward = keep and flip do as they say, and a plane is left alone", {
  hollow <- grid_mesh(21, function(x, y) 0.1 * ((x - 10)^2 + (y - 10)^2))
  expect_equal(expect_no_warning(specimen(hollow, outward = "keep"))$mesh$it, hollow$it)
  expect_equal(expect_no_warning(specimen(hollow, outward = "flip"))$mesh$it, turned(hollow)$it)
  expect_equal(expect_no_warning(specimen(turned(grid_mesh())))$mesh$it, turned(grid_mesh())$it)
  expect_crestline_error(specimen(hollow, outward = "yes"), "outward")
})

test_that("normals are the area-weighted mean of the faces'", {
  s <- specimen(ball_mesh())
  expect_equal(s$mesh$normals[1:3, ], Rvcg::vcgUpdateNormals(ball_mesh())$normals[1:3, ],
               tolerance = tolerances$single)
})
