# What calls are made with, once for all tests of this file.
delayedAssign("whole", complete_case())

test_that("what specimen() refuses no function takes as a bare mesh, in the same words", {
  # Most of the time of an error is its backtrace, which nobody reads here.
  rlang::local_options("rlang:::disable_trace_capture" = TRUE)
  case <- whole
  meshes <- damaged_meshes(case$specimen$mesh)
  calls <- any_mesh_calls()
  calls <- calls[setdiff(names(calls), c("find_landmarks", "place_landmarks"))]
  said <- function(code) tryCatch({
    suppressWarnings(draw_quietly(code, 150, 150))
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

test_that("the graph of a mesh is made once, and again where its pointer comes from a file", {
  mesh <- Rvcg::vcgSphere(2)
  known <- passed_mesh(mesh, NULL)
  graph <- mesh_graph(known)
  expect_identical(mesh_graph(known), graph)
  curved <- function(known) {
    cpp_curvature(mesh_graph(known), 1:9, kernel_settings(0.8, "quadratic"), 1L)
  }
  expect_identical(curved(unserialize(serialize(known, NULL))), curved(known))
})

key <- function(mesh) crestline:::mesh_key(mesh)
ball <- Rvcg::vcgSphere(2)

test_that("a mesh has one key, whatever it is dressed in", {
  expect_match(key(ball), "^[0-9a-f]{32}$")
  dressed <- ball
  dressed$vb <- rbind(ball$vb[1:3, ], 1)
  dressed$normals <- -ball$normals
  dressed$material <- list(color = rep("#FF0000", ncol(ball$vb)))
  dimnames(dressed$vb) <- list(c("x", "y", "z", "w"), NULL)
  expect_identical(key(dressed), key(ball))
  dressed$vb <- ball$vb[1:3, ]
  storage.mode(dressed$it) <- "double"
  expect_identical(key(dressed), key(ball))
  zero <- ball
  zero$vb[ball$vb == 0] <- -0
  expect_identical(key(zero), key(ball))
})

test_that("the key does not depend on how R keeps the numbers", {
  plain <- list(vb = rbind(c(0, 1, 0), c(0, 0, 1), 0), it = matrix(c(1L, 2L, 3L), 3))
  compact <- plain
  compact$it <- matrix(1:3, 3)
  expect_identical(key(compact), key(plain))
  expect_identical(key(unserialize(serialize(ball, NULL))), key(ball))
})

test_that("other vertices, triangles or orders have other keys", {
  n <- ncol(ball$it)
  others <- list(
    moved = within(unclass(ball), vb[1, ] <- vb[1, ] + 1),
    nudged = within(unclass(ball), vb[2, 5] <- vb[2, 5] * (1 + 1e-15) + 1e-300),
    reordered = within(unclass(ball), it <- it[, n:1]),
    turned = within(unclass(ball), it[, 1] <- it[c(2, 3, 1), 1]),
    cut = within(unclass(ball), it <- it[, -1]),
    swapped = within(unclass(ball), it[, 1:2] <- it[, 2:1]),
    exchanged = within(unclass(ball), vb[, 1:2] <- vb[, 2:1]),
    axes = within(unclass(ball), vb[1:3, ] <- vb[c(2, 1, 3), ])
  )
  keys <- vapply(c(list(ball), others), key, "")
  expect_identical(anyDuplicated(keys), 0L)
})

test_that("keys of many small changes differ", {
  set.seed(1)
  keys <- replicate(2000, {
    one <- ball
    at <- sample(length(one$it), 1)
    one$it[at] <- sample(setdiff(seq_len(ncol(one$vb)), one$it[at]), 1)
    paste(key(one), rlang::hash(one$it))
  })
  expect_identical(length(unique(substr(keys, 1, 32))), length(unique(substr(keys, 34, 65))))
})

test_that("whatever takes something of a mesh and a specimen refuses another, damaged mesh", {
  case <- whole
  wrong <- wrong_specimens(case)
  some <- c(grep("^other", names(wrong), value = TRUE), "mesh exchanged", "index far out",
            "co-ordinate NaN", "twins out of range")
  expect_null(not_refused(own_mesh_calls(), case, wrong[some]))
})

test_that("the right mesh is taken: of another id, other normals and colours, from a file", {
  case <- whole
  dressed <- case$specimen
  dressed$id <- "someone else"
  dressed$mesh$normals[1:3, ] <- dressed$mesh$normals[1:3, ] + 0.05
  dressed$mesh$material <- list(color = rep("#123456", ncol(dressed$mesh$vb)))
  kept <- unserialize(serialize(case$specimen, NULL))
  calls <- own_mesh_calls()
  calls <- calls[setdiff(names(calls), "quality_report")]
  answers <- function(one) {
    vapply(calls, function(call) {
      !is.null(suppressWarnings(draw_quietly(call(case, one), 150, 150)))
    }, NA)
  }
  expect_true(all(answers(kept)))
  expect_true(all(answers(dressed)))
})

test_that("what was damaged itself is refused with the right mesh", {
  case <- whole
  calls <- lapply(damaged_calls(), function(call) function(case, one) call(case))
  expect_null(not_refused(calls, case, list(own = case$specimen)))
})

test_that("an error names the mesh that was expected and the one that came", {
  case <- whole
  wide <- stretched_ball(c(1.2, 1, 1.1), "wide")
  expect_crestline_error(slide(case$shape, case$template, specimen = wide),
                         c("the mesh of ball (key", "the mesh of wide (key"), id = "wide")
  expect_error(path_coordinates(wide$mesh, case$path, 10),
               "mesh of ball .* here is a mesh without an id", class = "crestline_wrong_mesh")
  expect_error(surface_faults(case$template, case$specimen), "on no mesh",
               class = "crestline_wrong_mesh")
})

test_that("a shape of an older version knows its mesh by its specimen, else it is refused", {
  case <- whole
  old <- tampered(case$shape, function(x) {
    x$specimen <- tampered(x$specimen,
                           function(y) y[c("id", "mesh", "landmarks", "report", "geometry")])
    x$paths <- lapply(x$paths, function(path) structure(path, key = NULL, id = NULL))
    x$tracks <- lapply(x$tracks, function(track)
      within_list(track, path = structure(track$path, key = NULL, id = NULL)))
    x[c("id", "points", "status", "paths", "scheme", "tracks", "column", "specimen", "checks")]
  })
  expect_equal(coords(slide(old, case$template), "surface"),
               coords(slide(case$shape, case$template), "surface"))
  expect_equal(nrow(surface_faults(old, case$specimen)),
               nrow(surface_faults(case$shape, case$specimen)))
  expect_crestline_error(surface_faults(old, stretched_ball(c(1.2, 1, 1.1))), "the mesh of ball")
  old$specimen <- NULL
  expect_s3_class(quality(old), "shape_quality")
  expect_crestline_error(surface_faults(old, case$specimen), c("does not know the mesh", "anew"))
})

test_that("`shape$specimen <- NULL` and `specimens` stay possible", {
  case <- whole
  small <- case$shape
  small$specimen <- NULL
  whole <- slide(case$shape, case$template)
  expect_equal(slide(small, case$template, specimen = case$specimen)$points, whole$points)
  found <- homologise(list(small), case$template, specimens = list(ball = case$specimen),
                      rounds = 0, progress = FALSE)
  expect_equal(found$shapes$ball$points, whole$points)
})

test_that("every exported function that takes a mesh or a part of it is in the tables", {
  takes <- function(name) {
    arguments <- names(formals(get(name, asNamespace("crestline"))))
    any(c("mesh", "specimen", "specimens", "curvature", "path", "coordinates") %in% arguments)
  }
  exports <- Filter(function(name) is.function(get(name, asNamespace("crestline"))),
                    getNamespaceExports("crestline"))
  called <- c(names(own_mesh_calls()), names(any_mesh_calls()), names(specimen_calls()))
  called <- sub(",.*", "", called)
  # specimen() is the door itself; keep_*() and the readers take no mesh; in repeatability() and
  # visit_errors() specimens are names, in write_parquet() a table, in curve_route() the path is a
  # word; read_digitised() compares with its records, see test-placing-desk-state.R.
  elsewhere <- c("specimen", "repeatability", "visit_errors", "write_parquet", "curvature_surface",
                 "curve_route", "read_digitised")
  expect_setequal(setdiff(Filter(takes, exports), c(called, elsewhere)), character())
})
