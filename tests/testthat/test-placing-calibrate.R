test_that("a calibrated template finds the points where the user puts them", {
  placed <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  # Another convention: the tip of the nose 4 mm higher, and a landmark of the user's own on the
  # cheek.
  placed$landmarks["pn", ] <- placed$landmarks["pn", ] + c(-1, 4, 0)
  cheek <- colMeans(placed$landmarks[c("exL", "chL", "tL"), ])
  placed <- specimen(placed$mesh, rbind(placed$landmarks, cheekL = cheek), id = "humface",
                     tolerance = 0.2)
  mine <- calibrate_template(face_template(), placed, settings = quick_settings())
  expect_equal(mine$calibration$specimens[mine$calibration$landmark %in% c("pn", "cheekL")],
               c(1, 1))
  expect_gt(mine$calibration$moved[mine$calibration$landmark == "pn"], 2)
  expect_equal(unname(mine$landmarks["exL", ]), unname(mine$landmarks["exR", ] * c(-1, 1, 1)),
               tolerance = 0.02)
  found <- find_landmarks(moved_mesh(humface_scan(), some_rotation(4)), mine,
                          settings = quick_settings())
  back <- found$landmarks %*% some_rotation(4)
  error <- row_lengths(back[c("pn", "cheekL"), ] - placed$landmarks[c("pn", "cheekL"), ])
  expect_lt(max(error), 1)
  inner <- setdiff(rownames(humface_landmarks()), ear_names)
  expect_lt(mean(row_lengths(back[inner, ] - placed$landmarks[inner, ])), 0.8)
})

test_that("landmarks and mirror images are averaged by name", {
  at <- rbind(aL = c(10, 1, 2), aR = c(-12, 1, 4), m = c(1, 5, 6), lonelyL = c(3, 3, 3))
  expect_equal(mirrored_mean(at),
               rbind(aL = c(11, 1, 3), aR = c(-11, 1, 3), m = c(0, 5, 6), lonelyL = c(3, 3, 3)))
})

test_that("specimens without landmarks are refused by name", {
  expect_crestline_error(calibrate_template(face_template(), specimen(humface_scan(), id = "bare")),
                         "no landmarks", id = "bare")
  expect_crestline_error(calibrate_template(face_template(), list()), "specimens")
})

test_that("a landmark that the template knows by another name is said, not added in silence", {
  template <- list(landmarks = data.frame(landmark = c("pn", "sn"), name = NA))
  named <- function(...) list(id = "q", landmarks = xyz(1:6, name = c(...)))
  expect_warning(warn_unused_names(named("PN", "sn"), template, "the template"),
                 "not used: PN; near: pn", class = "crestline_unused_landmarks")
  expect_no_warning(warn_unused_names(named("pn", "gn"), template, "the template"))
})
