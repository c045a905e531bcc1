

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
