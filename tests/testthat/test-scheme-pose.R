typical <- as.matrix(face_scheme()$landmarks[c("x", "y", "z")])
rownames(typical) <- face_scheme()$landmarks$landmark
turn <- rotation_about(c(0.4, -1.2, 2))

test_that("a face is shown from its own front, however it lies, in any unit and place", {
  lying <- 0.1 * typical %*% t(turn) + rep(c(5, -3, 40), each = nrow(typical))
  expect_equal(posed_view("front", lying), t(turn))
  expect_equal(posed_view(c(0.3, 0.1), lying), view_rotation(c(0.3, 0.1)) %*% t(turn))
  half <- lying[!grepl("R$", rownames(lying)), ]
  expect_equal(posed_view("left", half), view_rotation("left") %*% t(turn))
  expect_identical(posed_view(diag(3), lying), diag(3))
})

test_that("points of curves and patches that are landmarks tell the pose too", {
  points <- face_scheme()$points
  for (level in c("curves", "surface")) {
    own <- points[points$level == level, ]
    at <- typical[match(sub("landmarks|", "", own$place, fixed = TRUE), rownames(typical)), ]
    rownames(at) <- paste(own$part, own$point)
    expect_equal(posed_view("front", at %*% t(turn)), t(turn))
  }
})

test_that("without landmarks of the scheme, or with these elsewhere, the view is along z", {
  expect_identical(posed_view("front", unname(typical) %*% t(turn)), diag(3))
  expect_identical(posed_view("front", typical[1:3, ] %*% t(turn)), diag(3))
  mixed <- typical %*% t(turn)
  rownames(mixed) <- rev(rownames(mixed))
  expect_identical(posed_view("front", mixed), diag(3))
  expect_identical(posed_view("front", typical, quad_scheme()), diag(3))
  expect_identical(posed_view("front", typical[, 1:2]), diag(3))
  expect_crestline_error(posed_view("frontal", typical), "frontal")
})

test_that("pictures of a specimen and of its shape use the pose", {
  lying <- ball_specimen()
  lying$landmarks <- typical[1:8, ] %*% t(turn) / 200
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  scene <- plot(lying, "plain", engine = "picture", landmarks = FALSE, resolution = 10)
  expect_equal(scene$rotation, own_pose(lying$landmarks, face_scheme()))
  expect_gt(max(abs(scene$rotation - diag(3))), 0.1)
  scene <- plot(lying, "plain", engine = "picture", view = diag(3), resolution = 10)
  expect_identical(scene$rotation, diag(3))
})
