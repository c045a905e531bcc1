# Landmarks that a specimen has already, and the others found with them.

kept_of <- function(names, landmarks = humface_landmarks(), id = "humface") {
  suppressWarnings(specimen(humface_scan(), landmarks[names, , drop = FALSE], id = id))
}

inner_error <- function(face, names) {
  placing <- face$placing[match(names, face$placing$landmark), ]
  row_lengths(as.matrix(placing[c("x", "y", "z")]) - humface_landmarks()[names, ])
}

test_that("landmarks that a scan has are kept, and the rest are found no worse", {
  four <- c("pn", "exL", "exR", "gn")
  at <- humface_landmarks()
  at[ear_names, ] <- NA  # not on this scan
  given <- kept_of(c(four, ear_names), at)
  face <- find_landmarks(given, settings = quick_settings())
  expect_identical(face$landmarks[four, ], given$landmarks[four, ])
  expect_equal(report_count(given, "landmarks missing"), 4)
  expect_equal(report_count(face, "landmarks missing"), 0)
  state <- stats::setNames(face$placing$state, face$placing$landmark)
  expect_equal(unname(state[four]), rep("placed", 4))
  expect_true(all(is.na(face$placing$confidence[state == "placed"])))
  expect_setequal(names(state)[state == "predicted"], ear_names)
  origin <- stats::setNames(face$origin$how, face$origin$landmark)
  expect_equal(unname(origin[four]), rep("given", 4))
  expect_equal(origin[["n"]], "found")
  # Each stays a point of the mesh, and paths begin there.
  expect_equal(unlist(landmark_point(face, "pn")[c("x", "y", "z")]), given$landmarks["pn", ])
  rest <- setdiff(rownames(humface_landmarks()), c(four, ear_names))
  expect_lt(mean(inner_error(face, rest)), mean(inner_error(found_lines(), rest)) + 0.05)
  # Found ones are found again, and do not count as kept.
  again <- find_landmarks(face, settings = quick_settings())
  expect_equal(again$landmarks, face$landmarks, tolerance = 1e-8)
  expect_equal(again$placing$state, face$placing$state)
})

test_that("a kept landmark draws the template with it by its weight", {
  moved <- humface_landmarks()
  moved["gn", ] <- as.matrix(surface_points(humface_scan(), moved["gn", ] + c(0, -5, 0))[1:3])
  lips <- c("sl", "li")
  way <- function(placed) {
    settings <- find_settings(points = 1000, warp_steps = 10, placed = placed)
    face <- find_landmarks(kept_of("gn", moved), settings = settings)
    expect_identical(face$landmarks["gn", 2], kept_of("gn", moved)$landmarks["gn", 2])
    mean(face$landmarks[lips, "y"])
  }
  without <- way(0)
  expect_equal(without, mean(found_lines()$landmarks[lips, "y"]), tolerance = 1e-8)
  expect_lt(way(1000), way(10))
  expect_lt(way(10), without)
})

test_that("a landmark on the wrong side is named, kept, and has no say", {
  wrong <- humface_landmarks()
  wrong["exL", ] <- wrong["exR", ]
  given <- kept_of(c("exL", "gn", "pn"), wrong)
  expect_warning(face <- find_landmarks(given, settings = quick_settings()),
                 "humface, .*contradict the face that was found: exL \\(8[0-9]",
                 class = "crestline_contrary_landmarks")
  expect_identical(face$landmarks["exL", ], given$landmarks["exL", ])
  row <- face$placing[face$placing$landmark == "exL", ]
  expect_equal(row$state, "placed")
  expect_lt(row$confidence, 0.01)
  expect_gt(row$residual, 75)
  rest <- c("exR", "enL", "enR", "n", "chL")
  expect_lt(mean(inner_error(face, rest)), 2)
  # The doubt travels.
  expect_output(print(face), "little confidence: exL")
  error <- expect_error(check_placing(face), class = "crestline_placing_error")
  expect_match(conditionMessage(error), "exL", fixed = TRUE)
  scheme <- curve_scheme(data.frame(landmark = c("exL", "n", "gn")),
                         data.frame(curve = c("a", "b"), from = c("exL", "n"), to = c("gn", "gn"),
                                    kind = "plane", n = 5))
  shape <- suppressWarnings(fit_shape(face, scheme, progress = FALSE))
  parts <- quality(shape)
  grade <- stats::setNames(as.character(parts$grade), parts$part)
  expect_equal(grade[c("exL", "a")], c(exL = "amber", a = "amber"))
  expect_equal(grade[["gn"]], "green")
})

test_that("landmarks that the template does not have are kept too, ears as they are", {
  own <- humface_landmarks()[c("tL", "pn", "exR"), ]
  own <- rbind(own, wart = humface_landmarks()["chL", ] + c(15, 0, 0))
  own["wart", ] <- as.matrix(surface_points(humface_scan(), own["wart", ])[1:3])
  given <- specimen(humface_scan(), own, id = "humface")
  face <- find_landmarks(given, settings = quick_settings())
  expect_identical(face$landmarks[rownames(own), ], given$landmarks)
  state <- stats::setNames(face$placing$state, face$placing$landmark)
  expect_equal(unname(state[rownames(own)]), rep("placed", 4))
  expect_equal(state[["tR"]], "predicted")
})

test_that("a start by kept landmarks needs three that are not on a line, of about the size", {
  template <- face_template()
  settings <- find_settings()
  at <- template$landmarks[c("pn", "exL", "exR", "gn"), ]
  turn <- some_rotation(5)
  kept <- 1.1 * at %*% t(turn) + rep(c(5, -3, 40), each = 4)
  start <- kept_start(template, kept, settings)
  expect_equal(drop(start), c(turn, 5, -3, 40, 1.1))
  expect_equal(dim(kept_start(template, kept[1:2, ], settings)), c(13, 0))
  line <- kept
  line[] <- outer(1:4, c(10, 20, 5))
  expect_equal(ncol(kept_start(template, line, settings)), 0)
  expect_equal(ncol(kept_start(template, 5 * kept, settings)), 0)
})

test_that("ears at the edge of a mask are no contradiction, on the other side they are", {
  own <- humface_landmarks()[c("tL", "oiL", "pn", "exR"), ]
  own["tL", ] <- as.matrix(surface_points(humface_scan(), own["tL", ] + c(-10, 0, 45))[1:3])
  given <- suppressWarnings(specimen(humface_scan(), own, id = "humface"))
  face <- expect_no_warning(find_landmarks(given, settings = quick_settings()))
  expect_gt(face$placing$residual[face$placing$landmark == "tL"], 30)
  own["tL", ] <- humface_landmarks()["tR", ]
  given <- suppressWarnings(specimen(humface_scan(), own, id = "humface"))
  expect_warning(find_landmarks(given, settings = quick_settings()), "found: tL",
                 class = "crestline_contrary_landmarks")
})
