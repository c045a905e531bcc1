test_that("what cannot be reviewed is refused", {
  skip_if_not_installed("shiny")
  expect_crestline_error(review_landmarks(ball_mesh()), "specimen")
  ball <- specimen(ball_mesh())
  expect_crestline_error(review_landmarks(ball, scheme = list()), "scheme")
  expect_crestline_error(review_landmarks(ball, surface = "blue"), "surface")
  expect_crestline_error(review_landmarks(ball, unit = 0), "unit")
  expect_crestline_error(place_landmarks(ball, NULL), "scheme")
})

test_that("curves are the same in metres", {
  face <- specimen(humface_scan(), humface_landmarks())
  lip <- face_scheme()$curves
  lip <- curve_scheme(face_scheme()$landmarks, lip[lip$curve == "mid-line lip left", ])
  small <- specimen(moved_mesh(humface_scan(), diag(3), scale = 1e-3), humface_landmarks() / 1000)
  length_in <- function(specimen, scheme) {
    review <- begin_review(specimen, scheme, 0.5, ridge_settings(error = FALSE), 0.2, 1)
    refit_curves(review$fitting, specimen)$fits[[1]]
  }
  mm <- length_in(face, scheme_in_unit(lip, 1))
  m <- length_in(small, scheme_in_unit(lip, 1000))
  expect_equal(m$length * 1000, mm$length, tolerance = 1e-6)
  expect_identical(m$reason, mm$reason)
})

test_that("placing begins without landmarks, on the mesh as it is", {
  face <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  bare <- without_landmarks(face, face_scheme())
  expect_identical(bare$mesh, face$mesh)
  expect_equal(bare$id, "humface")
  expect_equal(rownames(bare$landmarks), face_scheme()$landmarks$landmark)
  expect_true(all(is.na(bare$landmarks)))
  expect_equal(without_landmarks(humface_scan(), face_scheme(), "raw")$id, "raw")
})
