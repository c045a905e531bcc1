begun <- function(specimen, scheme = NULL) {
  begin_review(specimen, scheme, 0.5, ridge_settings(error = FALSE), 0.2, 1)
}
on_ball <- function(specimen, at) surface_points(specimen$mesh, matrix(at, 1))

test_that("landmarks are listed in the scheme's order and words, then the specimen's", {
  face <- specimen(humface_scan(),
                   rbind(humface_landmarks()[c("st", "pn"), ], mole = humface_landmarks()["chL", ]))
  about <- begun(face, face_scheme())$about
  expect_equal(about$landmark, c(face_scheme()$landmarks$landmark, "mole"))
  expect_equal(about$where[about$landmark == "chL"], "corner of the mouth")
  expect_equal(about$where[about$landmark == "chR"], "corner of the mouth")
  expect_equal(about$where[24], "")
  expect_equal(begun(face)$about$landmark, c("st", "pn", "mole"))
  expect_equal(unname(begun(face, face_scheme())$state[c("pn", "sn", "mole")]),
               c("given", "missing", "given"))
})

test_that("placing goes through those that are missing, in order, round the list", {
  bare <- without_landmarks(quad_specimen(), quad_scheme())
  review <- begun(bare, quad_scheme())
  review$selected <- next_open(review)
  expect_equal(review$selected, "a")
  review <- place_selected(review, on_ball(bare, quad_corners()["a", ]))
  expect_equal(review$selected, "b")
  review <- place_selected(select_landmark(review, "c"), on_ball(bare, quad_corners()["c", ]))
  expect_equal(review$selected, "d")
  review <- place_selected(review, NULL)
  expect_equal(review$selected, "b")
  expect_null(review$fitting$fits$right$path)
  review <- place_selected(review, on_ball(bare, quad_corners()["b", ]))
  expect_equal(review$selected, "b")
  expect_equal(review$state, c(a = "placed", b = "placed", c = "placed", d = "absent"))
  expect_equal(review$fitting$refitted, c("bottom", "right"))
  arc <- 50 * acos(sum(quad_corners()["b", ] * quad_corners()["c", ]) / 50^2)
  expect_equal(review$fitting$fits$right$length, arc, tolerance = 0.005)
})

test_that("every step can be taken back, to the very same", {
  review <- begun(quad_specimen(), quad_scheme())
  review$fitting <- refit_curves(review$fitting, review$specimen)
  first <- select_landmark(review, "b")
  second <- place_selected(first, on_ball(first$specimen, c(30, 0, 40)))
  third <- keep_selected(select_landmark(second, "c"))
  fourth <- place_selected(select_landmark(third, "d"), NULL)
  expect_true(is.na(fourth$specimen$landmarks["d", 1]))
  expect_equal(fourth$state[["c"]], "placed")
  expect_identical(third$specimen$landmarks["c", ], review$specimen$landmarks["c", ])
  parts <- c("specimen", "fitting", "state")
  expect_identical(undo_review(fourth)[parts], third[parts])
  expect_identical(undo_review(undo_review(undo_review(fourth)))[c(parts, "selected")],
                   first[c(parts, "selected")])
  expect_identical(undo_review(undo_review(second))$specimen, review$specimen)
})

test_that("doubtful landmarks wait, and are settled by a word", {
  face <- find_landmarks(humface_scan(), settings = quick_settings())
  face$placing$confidence <- ifelse(face$placing$landmark %in% c("sn", "gn"), 0.4, 1)
  review <- begun(face)
  expect_setequal(names(which(is_open(review))), c("sn", "gn"))
  review$selected <- next_open(review)
  review <- keep_selected(review)
  expect_equal(length(which(is_open(review))), 1)
  review <- place_selected(review, landmark_point(face, "sl"))
  expect_false(any(is_open(review)))
  ear <- select_landmark(review, "tL")  # predicted, beside the scan
  expect_identical(keep_selected(ear), ear)
  expect_equal(review$specimen$placing$state[review$specimen$placing$landmark %in% c("sn", "gn")],
               c("placed", "placed"))
})

test_that("a click on a ball chooses, on the surface is a place, beside nothing; none hidden", {
  review <- begun(quad_specimen())
  eye <- c(0, 0, 200)
  b <- quad_corners()["b", ]
  expect_equal(aimed_at(review, eye, b, 1), list(landmark = "b"))
  expect_equal(aimed_at(review, eye, b + c(0, 0.5, 0), 1), list(landmark = "b"))
  expect_named(aimed_at(select_landmark(review, "b"), eye, b, 1), "point")
  expect_lt(sqrt(sum((unlist(aimed_at(review, eye, c(0, 0, 50), 1)$point[1:3]) - c(0, 0, 50))^2)),
            0.1)
  expect_equal(aimed_at(review, eye, c(100, 0, 0), 1), list())
  expect_named(aimed_at(review, -eye, b, 1), "point")
})
