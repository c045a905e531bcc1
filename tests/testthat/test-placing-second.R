# Another finder's landmarks, and what they do to confidence.

test_that("where another finder differs, confidence falls by the formula, and nothing moves", {
  face <- found_lines()
  other <- face$landmarks[c("pn", "exL", "chR", "tL"), ]
  away <- face$landmarks["exL", ] + c(9, 0, 0)
  other["exL", ] <- away
  said <- second_opinion(face, other)
  expect_identical(said$landmarks, face$landmarks)
  rownames(said$placing) <- said$placing$landmark
  before <- stats::setNames(face$placing$confidence, face$placing$landmark)
  on <- as.matrix(surface_points(face$mesh, matrix(away, 1))[c("x", "y", "z")])
  gap <- sqrt(sum((on - face$landmarks["exL", ])^2))
  expect_equal(said$placing["exL", "apart"], gap)
  expect_equal(said$placing["exL", "confidence"], 1 / (1 / before[["exL"]] + (gap / 6)^2))
  expect_lt(said$placing["exL", "confidence"], 0.5)
  expect_equal(said$placing[c("pn", "chR"), "apart"], c(0, 0), tolerance = 1e-8)
  expect_equal(said$placing[c("pn", "chR"), "confidence"], unname(before[c("pn", "chR")]))
  # No opinion, no change; predicted ones have no confidence to lose.
  expect_true(is.na(said$placing["n", "apart"]))
  expect_equal(said$placing["n", "confidence"], before[["n"]])
  expect_equal(said$placing["tL", "state"], "predicted")
  expect_true(is.na(said$placing["tL", "confidence"]))
  expect_output(print(said), "second opinion on 4: .* little confidence: exL")
  expect_error(check_placing(said), "exL", class = "crestline_placing_error")
  expect_identical(check_placing(face)$id, "humface")
  # In another unit, and from a file: the same.
  metres <- find_landmarks(moved_mesh(humface_scan(), diag(3), scale = 0.001),
                           settings = quick_settings())
  file <- tempfile(fileext = ".csv")
  write_landmarks(other / 1000, file)
  far <- second_opinion(metres, file)$placing
  expect_equal(far$confidence[far$landmark == "exL"], said$placing["exL", "confidence"],
               tolerance = 1e-4)
})

test_that("doubt by a second opinion travels to the grades, of placed landmarks too", {
  scheme <- curve_scheme(data.frame(landmark = c("exL", "n", "gn")),
                         data.frame(curve = c("a", "b"), from = c("exL", "n"), to = c("gn", "gn"),
                                    kind = "plane", n = 5))
  given <- suppressWarnings(specimen(humface_scan(), humface_landmarks()[c("exL", "pn", "gn"), ]))
  face <- find_landmarks(given, settings = quick_settings())
  graded <- function(face) {
    parts <- quality(suppressWarnings(fit_shape(face, scheme, progress = FALSE)))
    stats::setNames(as.character(parts$grade), parts$part)
  }
  expect_equal(graded(face)[["exL"]], "green")
  other <- face$landmarks
  other["exL", ] <- other["exL", ] + c(10, -5, -5)
  said <- graded(second_opinion(face, other))
  expect_equal(said[c("exL", "a", "gn")], c(exL = "amber", a = "amber", gn = "green"))
  other <- other + 8
  expect_true(second_opinion(face, other, agreed = 2)$match$doubtful)
})

test_that("MediaPipe's points are landmarks by the table that ships", {
  file <- system.file("extdata", "mediapipe.csv", package = "crestline")
  table <- utils::read.csv(file)
  template <- face_template()
  expect_setequal(table$landmark, rownames(template$landmarks))
  expect_true(all(tapply(table$weight, table$landmark, sum) == 1))
  expect_true(all(table$mediapipe %in% 0:477))
  # The canonical face model at these numbers (MediaPipe's canonical_face_model.obj, in its own
  # unit) is a face as ours: right is right, and each point is near its landmark.
  model <- rbind(
    `4` = c(0, -0.463, 7.587), `2` = c(0, -2.089, 6.058), `168` = c(0, 3.271, 5.236),
    `9` = c(0, 4.886, 5.385), `33` = c(-4.446, 2.664, 3.173), `133` = c(-1.856, 2.585, 3.758),
    `129` = c(-1.786, -0.978, 4.850), `0` = c(0, -3.406, 5.980), `37` = c(-0.711, -3.329, 5.877),
    `61` = c(-2.456, -4.343, 4.284), `13` = c(0, -3.994, 5.219), `14` = c(0, -4.542, 5.405),
    `17` = c(0, -5.365, 5.535), `18` = c(0, -6.150, 5.071), `199` = c(0, -7.942, 5.181),
    `175` = c(0, -8.765, 4.891)
  )
  left <- model[c("33", "133", "129", "37", "61"), ] %*% diag(c(-1, 1, 1))
  rownames(left) <- c("263", "362", "358", "267", "291")
  points <- matrix(NA_real_, 468, 3)
  both <- rbind(model, left)
  points[as.integer(rownames(both)) + 1, ] <- both
  named <- other_landmarks(points, "model")
  expect_equal(nrow(named), 19)
  expect_equal(named["st", ], colMeans(model[c("13", "14"), ]), ignore_attr = TRUE)
  own <- template$landmarks[rownames(named), ]
  fitted <- apply_similarity(named, similarity(named, own))
  off <- row_lengths(fitted - own)
  expect_lt(max(off), 6)
  expect_lt(mean(off), 2.5)
  # A frame, with the irises, and a point missing.
  frame <- as.data.frame(rbind(points, matrix(0, 10, 3)))
  frame[5, ] <- NA
  again <- other_landmarks(stats::setNames(frame, c("x", "y", "z")), "model")
  expect_true(all(is.na(again["pn", ])))
  expect_equal(again["n", ], named["n", ], ignore_attr = TRUE)
})

test_that("what is no second opinion is refused; points off the surface have no say", {
  face <- found_lines()
  expect_error(second_opinion(specimen(humface_scan()), face$landmarks), "not found but given",
               class = "crestline_error")
  strange <- matrix(0, 1, 3, dimnames = list("elbow", NULL))
  expect_crestline_error(second_opinion(face, strange), "none of its landmarks", id = "humface")
  expect_crestline_error(second_opinion(face, matrix(0, 5, 3)), "without a name", id = "humface")
  other <- face$landmarks[c("pn", "gn"), ]
  other["pn", 3] <- other["pn", 3] + 100
  expect_warning(said <- second_opinion(face, other), "no say: pn",
                 class = "crestline_far_opinion")
  expect_equal(is.na(said$placing$apart[match(c("pn", "gn"), said$placing$landmark)]),
               c(TRUE, FALSE))
})
