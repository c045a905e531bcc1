given_columns <- paste0("given_", c("x", "y", "z"))

placed_humface <- function() specimen(humface_scan(), humface_landmarks(), id = "humface")

test_that("a face is reported, not moved, unless asked; moved landmarks stay where they are", {
  face <- placed_humface()
  report <- refine_landmarks(face, face_scheme())
  expect_equal(report$landmarks, face$landmarks)
  table <- report$refinement
  expect_equal(table$landmark, face_scheme()$definitions$landmark)
  expect_true(all(table$state == "found") && !any(table$moved))
  expect_lt(max(table$distance), 6)
  expect_on_mesh(table, face$mesh)
  given <- face$landmarks[table$landmark, ]
  expect_equal(as.matrix(table[given_columns]), given, ignore_attr = TRUE)
  expect_equal(table$distance, row_lengths(as.matrix(table[c("x", "y", "z")]) - given),
               ignore_attr = TRUE)
  moved <- refine_landmarks(face, face_scheme(), move = TRUE)
  expect_equal(moved$landmarks[table$landmark, ], as.matrix(table[c("x", "y", "z")]),
               ignore_attr = TRUE)
  others <- setdiff(rownames(face$landmarks), table$landmark)
  expect_identical(moved$landmarks[others, ], face$landmarks[others, ])
  expect_lt(max(refine_landmarks(moved, face_scheme())$refinement$distance), 1e-3)
  expect_equal(landmark_point(moved, "st")[mesh_columns],
               table[table$landmark == "st", mesh_columns], ignore_attr = TRUE)
})

test_that("landmarks that are put elsewhere come to the same places", {
  face <- placed_humface()
  names <- face_scheme()$definitions$landmark
  to <- function(seed) {
    step <- with_seed(seed, matrix(stats::rnorm(3 * 23), 23))
    face$landmarks <- face$landmarks + 2 * step / row_lengths(step)
    face$landmarks[] <- as.matrix(surface_points(face$mesh, face$landmarks)[1:3])
    refine_landmarks(face, face_scheme(), move = TRUE)
  }
  one <- to(1)
  two <- to(2)
  expect_gt(
    min(row_lengths(as.matrix(one$refinement[given_columns] - two$refinement[given_columns]))), 0.2)
  expect_lt(max(row_lengths(one$landmarks[names, ] - two$landmarks[names, ])), 0.01)
})

test_that("neither pose, unit nor the order of the vertices changes the places", {
  at <- rbind(top = c(4, 1), west = c(-22, 1), east = c(22, 1), sideL = c(3, 10), sideR = c(3, -10),
              mid = c(5, 2))
  # Symmetric about v = 0, with a knob on a ridge.
  z <- quote(2 * exp(-v^2 / 20) + 3 * exp(-((u - 3)^2 + v^2) / 50))
  tables <- function(unit) {
    data.frame(landmark = c("top", "mid"), kind = c("cap", "profile"), radius = 5 * unit,
               reach = 7 * unit, bend = c(NA, "out"), mirror = c(NA, "sideL"))
  }
  scheme <- function(unit) {
    curve_scheme(data.frame(landmark = rownames(at)),
                 data.frame(curve = "line", from = "west", to = "east", kind = "plane", n = 2),
                 pairs = data.frame(level = "landmarks", left = "sideL", right = "sideR"),
                 definitions = tables(unit))
  }
  face <- graph_specimen(z, at)
  before <- refine_landmarks(face, scheme(1))$refinement
  expect_equal(before$state, c("found", "found"))
  turn <- some_rotation(5)
  mesh <- moved_mesh(face$mesh, turn, c(1, 2, 3), 0.001)
  new <- with_seed(6, sample(ncol(mesh$vb)))
  mesh$it[] <- new[mesh$it]
  mesh$vb[, new] <- mesh$vb
  mesh$it <- mesh$it[, rev(seq_len(ncol(mesh$it)))]
  moved <- specimen(mesh, 0.001 * face$landmarks %*% t(turn) + rep(c(1, 2, 3), each = nrow(at)),
                    outward = "keep")
  after <- refine_landmarks(moved, scheme(0.001))$refinement
  back <- (as.matrix(after[c("x", "y", "z")]) - rep(c(1, 2, 3), each = 2)) %*% turn * 1000
  expect_lt(max(abs(back - as.matrix(before[c("x", "y", "z")]))), 1e-4)
  expect_equal(after$distance * 1000, before$distance, tolerance = 1e-4)
})

test_that("a landmark that is missing is said to be; what builds on it, too", {
  face <- placed_humface()
  face$landmarks["chL", ] <- NA
  table <- refine_landmarks(face, face_scheme(), move = TRUE)$refinement
  state <- stats::setNames(table$state, table$landmark)
  expect_equal(unname(state[c("chL", "st", "pn")]), rep("missing", 3))
  expect_equal(unname(state[c("cphR", "chR", "cphL")]), rep("found", 3))
  expect_true(all(is.na(table$x[table$state == "missing"])) &&
              !any(table$moved[table$state == "missing"]))
})

test_that("some may be moved, and mistakes are told", {
  face <- placed_humface()
  some <- refine_landmarks(face, face_scheme(), move = c("chL", "st"))
  expect_equal(some$refinement$landmark[some$refinement$moved], c("chL", "st"))
  expect_identical(some$landmarks["chR", ], face$landmarks["chR", ])
  expect_crestline_error(refine_landmarks(face, face_scheme(), move = "tL"), c("tL", "chL"))
  expect_crestline_error(refine_landmarks(face, face_scheme(), move = 1), "`move`")
  expect_crestline_error(refine_landmarks(face, leaf_scheme()), c("leaf", "definitions"))
  none <- specimen(face$mesh, face$landmarks[c("tL", "tR"), ], id = "ears")
  expect_crestline_error(refine_landmarks(none, face_scheme()), "none of the landmarks",
                         id = "ears")
  expect_crestline_error(plot(face, what = "refinement"), "not refined", id = "humface")
})

test_that("the picture shows both places", {
  face <- refine_landmarks(placed_humface(), face_scheme())
  scene <- NULL
  pixels <- drawn_pixels(scene <- plot(face, what = "refinement", labels = FALSE), 500, 500)
  expect_s3_class(scene, "picture_scene")
  orange <- pixels[, , 1] > 0.9 & pixels[, , 2] > 0.35 & pixels[, , 2] < 0.6 & pixels[, , 3] < 0.2
  expect_gt(sum(orange), 50)
  expect_gt(sum(pixels[, , 1] < 0.1 & pixels[, , 2] < 0.1), 50)
})

test_that("the places of found landmarks follow the moves, their confidence stays", {
  face <- found_lines()
  moved <- refine_landmarks(face, face_scheme(), move = c("chL", "chR"))
  before <- face$placing[face$placing$landmark == "chL", ]
  after <- moved$placing[moved$placing$landmark == "chL", ]
  expect_equal(unlist(after[c("x", "y", "z")]), moved$landmarks["chL", ], ignore_attr = TRUE)
  expect_gt(max(abs(unlist(after[c("x", "y", "z")]) - unlist(before[c("x", "y", "z")]))), 0)
  expect_identical(after[c("state", "confidence")], before[c("state", "confidence")])
  expect_identical(moved$placing[moved$placing$landmark == "pn", ],
                   face$placing[face$placing$landmark == "pn", ])
  expect_identical(current_placing(moved), moved$placing)
  expect_null(refine_landmarks(humface_specimen(), face_scheme(), move = "chL")$placing)
})
