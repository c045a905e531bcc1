test_that("landmarks are changed, moved, named by assignment; no matrix is refused", {
  ball <- stretched_ball()
  expect_identical({
    ball$landmarks["low", ] <- c(0, -30, 40)
    ball$landmarks["low", ]
  }, c(x = 0, y = -30, z = 40))
  expect_false(is.na(attr(plane_path(ball, "low", "high"), "length")))
  rownames(ball$landmarks)[1] <- "renamed"
  expect_true("renamed" %in% rownames(ball$landmarks))
  ball[["landmarks"]]["high", ] <- NA
  expect_true(all(is.na(ball$landmarks["high", ])))
  ball$landmarks <- NULL
  expect_identical(dim(ball$landmarks), c(0L, 3L))
  expect_crestline_error(ball$landmarks <- "low", "k x 3", id = "ball")
  expect_crestline_error(ball$landmarks <- matrix(1, 2, 3), "without a name", id = "ball")
  expect_crestline_error(ball[["landmarks"]] <- diag(2), "k x 3", id = "ball")
  expect_crestline_error(ball["landmarks"] <- list(1:3), "k x 3", id = "ball")
})

test_that("another mesh passes the door again, and takes the landmarks or refuses them", {
  ball <- stretched_ball()
  mesh <- ball$mesh
  mesh$it <- mesh$it[, rev(seq_len(ncol(mesh$it)))]
  other <- ball
  other$mesh <- mesh
  expect_false(identical(other$key, ball$key))
  expect_identical(other$key, mesh_key(other$mesh))
  expect_equal(other$landmarks, ball$landmarks, tolerance = 1e-9)
  expect_equal(attr(plane_path(other, "low", "high"), "length"),
               attr(plane_path(ball, "low", "high"), "length"))
  expect_crestline_error(ball$mesh$vb[1, ] <- ball$mesh$vb[1, ] + 500, "off the surface")
  expect_crestline_error(ball$mesh$it[1, 1] <- 1000000000L, "do not exist", id = "ball")
  expect_crestline_error(ball$mesh <- NULL, "mesh3d", id = "ball")
})

test_that("colours and normals are changed without another key", {
  ball <- stretched_ball()
  key <- ball$key
  ball$mesh$material$color <- rep("#102030", ncol(ball$mesh$vb))
  expect_identical(ball$mesh$material$color[1], "#102030")
  ball$mesh$normals <- NULL
  expect_equal(ball$mesh$normals, stretched_ball()$mesh$normals)
  expect_identical(ball$key, key)
})

test_that("a misspelt field is refused, one that is declared stays when it is emptied", {
  ball <- stretched_ball()
  expect_crestline_error(ball$landmark <- ball$landmarks, "no field landmark", id = "ball")
  expect_crestline_error(ball[["landmark"]] <- 1, "no field", id = "ball")
  expect_crestline_error(ball$key <- "0", "worked out", id = "ball")
  expect_crestline_error(ball$id <- c("a", "b"), "one string")
  before <- names(ball)
  ball$placing <- NULL
  expect_identical(names(ball), before)
  ball$id <- 7
  expect_identical(ball$id, "7")
})

test_that("what was changed behind the methods is refused wherever a specimen is taken", {
  case <- complete_case()
  wrong <- wrong_specimens(case)
  wrong <- wrong[c("mesh exchanged", "index far out", "no normals", "twins gone", "geometry gone",
                   "landmarks as text")]
  calls <- specimen_calls()
  expect_null(not_refused(calls, case, wrong))
})

test_that("a specimen from a file or an older version is taken", {
  ball <- stretched_ball()
  again <- unserialize(serialize(ball, NULL))
  old <- tampered(again, function(x) x[c("id", "mesh", "landmarks", "report", "geometry")])
  expect_equal(plane_path(again, "low", "high"), plane_path(ball, "low", "high"))
  expect_equal(plane_path(old, "low", "high"), plane_path(ball, "low", "high"))
  expect_identical(fit_shape(old, paired_scheme(), ridge_settings(error = FALSE),
                             progress = FALSE)$key, ball$key)
})
