test_that("what specimen() refuses no function takes as a bare mesh, in the same words", {
  case <- complete_case()
  meshes <- damaged_meshes(case$specimen$mesh)
  calls <- any_mesh_calls()
  calls <- calls[setdiff(names(calls), c("find_landmarks", "place_landmarks"))]
  said <- function(code) tryCatch({
    suppressWarnings(draw_quietly(code))
    NA
  }, crestline_error = function(e) e$problem)
  for (name in names(meshes)) {
    words <- vapply(calls, function(call) said(call(case, meshes[[name]])), "")
    expect_false(anyNA(words), info = name)
    own <- said(specimen(meshes[[name]]))
    if (is.na(own) || name == "a list") next
    expect_true(all(words[c("curvature", "plane_path", "draw_surface", "frechet_mean")] == own),
                info = name)
  }
})

test_that("specimen() refuses faces in rows, from 0 and not whole, and says what to do", {
  mesh <- ball_mesh()
  expect_crestline_error(specimen(within_list(mesh, it = t(mesh$it))),
                         c("3 rows but 320 x 3", "t(mesh$it)"))
  expect_crestline_error(specimen(within_list(mesh, it = mesh$it - 1L)),
                         c("do not exist", "counted from 0", "mesh$it + 1"))
  half <- mesh
  half$it[2, 3] <- 2.5
  expect_crestline_error(specimen(half), c("1 of 320 faces", "not whole"))
  coloured <- within_list(mesh, material = list(color = rep("red", 960)))
  coloured$it[1, 1] <- 1000000000L
  expect_crestline_error(specimen(coloured), "do not exist")
})

test_that("a mesh that can be taken is: doubles, three rows, integers, a fourth row not 1", {
  mesh <- ball_mesh(3)
  path <- function(mesh) plane_path(mesh, c(1, 0, 0), c(0, 1, 0))
  whole <- path(mesh)
  expect_equal(path(within_list(mesh, it = mesh$it + 0)), whole)
  expect_equal(path(within_list(mesh, vb = mesh$vb[1:3, ])), whole)
  expect_equal(path(within_list(mesh, vb = 2 * mesh$vb)), whole)
  round <- grid_mesh()
  storage.mode(round$vb) <- "integer"
  expect_equal(attr(plane_path(round, c(0, 0, 0), c(4, 0, 0)), "length"), 4)
})

test_that("normals that do not fit are left out, quads beside triangles refused", {
  mesh <- within_list(ball_mesh(3), normals = matrix(1, 4, 3))
  expect_equal(curvature(mesh, 0.4, vertices = 1:5)$k1,
               curvature(ball_mesh(3), 0.4, vertices = 1:5)$k1)
  expect_crestline_error(curvature(within_list(ball_mesh(), ib = matrix(1:4, 4)), 0.4), "quads")
})

test_that("a mesh that has passed is known again, one that was touched since is not", {
  mesh <- ball_mesh()
  first <- passed_mesh(mesh, NULL)
  expect_identical(passed_mesh(mesh, NULL), first)
  other <- mesh
  other$it[1, 1] <- 5000L
  expect_crestline_error(passed_mesh(other, NULL), "do not exist")
  expect_crestline_error(curvature(other, 0.4), "do not exist")
  mesh$vb[1, 1] <- mesh$vb[1, 1] + 1e-9
  expect_false(identical(passed_mesh(mesh, NULL)$key, first$key))
})

test_that("neighbours are right only where they lead back along the same edge", {
  mesh <- grid_mesh(4)
  twin <- mesh_topology(mesh)$twin
  expect_identical(cpp_twin_faults(mesh$it, twin), 0L)
  expect_identical(cpp_twin_faults(mesh$it, replace(twin, which(twin > 0)[1], 0L)), 1L)
  expect_gt(cpp_twin_faults(mesh$it, replace(twin, 1, 1000L)), 0)
  expect_gt(cpp_twin_faults(mesh$it[c(2, 3, 1), ], twin), 0)
})
