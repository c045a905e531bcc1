a_point <- function(specimen, at) surface_points(specimen$mesh, matrix(at, 1))

test_that("a landmark moved lies exactly on the mesh, and the others stay", {
  ball <- quad_specimen()
  moved <- move_landmark(ball, "b", a_point(ball, c(30, 0, 40)))
  expect_lt(sqrt(sum((moved$landmarks["b", ] - c(30, 0, 40))^2)), 0.1)
  expect_identical(moved$landmarks[c("a", "c", "d"), ], ball$landmarks[c("a", "c", "d"), ])
  point <- landmark_point(moved, "b")
  expect_on_mesh(point, ball$mesh)
  expect_identical(unlist(point[c("x", "y", "z")]), moved$landmarks["b", ])
  expect_identical(with_located(moved), moved)
})

test_that("one is added to a specimen that has none, and taken away", {
  ball <- quad_specimen(landmarks = NULL)
  one <- move_landmark(ball, "top", a_point(ball, c(0, 50, 0)))
  expect_equal(rownames(one$landmarks), "top")
  expect_on_mesh(landmark_point(one, "top"), ball$mesh)
  none <- move_landmark(one, "top", NULL)
  expect_true(all(is.na(none$landmarks["top", ])))
  expect_crestline_error(landmark_point(none, "top"), "missing")
})

test_that("the placing says what became of it; checks do not doubt what a person placed", {
  face <- find_landmarks(humface_scan(), id = "humface", settings = quick_settings())
  face$placing$confidence <- ifelse(face$placing$landmark %in% c("pn", "exL"), 0.2, 1)
  expect_crestline_error(check_placing(face), c("2 of 19", "pn (0.2)"))
  moved <- move_landmark(face, "pn", landmark_point(face, "sn"))
  expect_crestline_error(check_placing(moved), c("1 of 19", "exL (0.2)"))
  row <- moved$placing[moved$placing$landmark == "pn", ]
  expect_equal(row$state, "placed")
  expect_true(is.na(row$confidence))
  expect_equal(unlist(row[c("x", "y", "z")]), moved$landmarks["sn", ], ignore_attr = TRUE)
  gone <- move_landmark(moved, "exL", NULL)
  expect_equal(gone$placing$state[gone$placing$landmark == "exL"], "absent")
  expect_identical(check_placing(gone), gone)
  added <- move_landmark(gone, "mole", landmark_point(face, "sn"))
  expect_equal(unlist(utils::tail(added$placing[c("landmark", "state")], 1)),
               c(landmark = "mole", state = "placed"))
  expect_equal(nrow(move_landmark(added, "mole", NULL)$placing), nrow(face$placing) + 1)
})
