still <- data.frame(range = 60, sd = 0)
clean <- scan_settings(noise = 0, remesh = FALSE)
vertices_of <- function(faces, i) t(faces$specimens[[i]]$mesh$vb[1:3, ])

# The default template, checked once.
template <- humface_specimen()
simulated <- function(...) simulating(..., template = template, places = face_effect())

test_that("without deformation every face is the template, exactly", {
  faces <- simulated(2, effect = 0, size_effect = 0, size_sd = 0, variation = still, scan = clean,
                     waves = 1, seed = 1)
  for (face in faces$specimens) {
    expect_equal(face$mesh$vb, faces$template$mesh$vb, tolerance = tolerances$rounding)
    expect_identical(face$mesh$it, faces$template$mesh$it)
    expect_equal(face$landmarks, faces$template$landmarks, tolerance = tolerances$rounding)
  }
  expect_equal(faces$covariates$size, c(1, 1))
})

test_that("the true points are the vertices and the landmarks of scans without noise", {
  faces <- simulated(2, effect = 2, scan = scan_settings(noise = 0, turn = 0.4, shift = 20),
                     waves = 20, seed = 2)
  for (i in 1:2) {
    truth <- true_points(faces, faces$vertices[[i]])[, , i]
    expect_equal(truth, vertices_of(faces, i), tolerance = tolerances$rounding, ignore_attr = TRUE)
  }
  same <- simulated(2, effect = 2, scan = clean, waves = 20, seed = 2)
  beside <- true_points(same) - vapply(same$specimens, `[[`, same$template$landmarks, "landmarks")
  # Between vertices 2.3 mm apart the deformed surface leaves the triangles by micrometres.
  expect_lt(max(abs(beside)), 0.02)
  expect_equal(dimnames(true_points(same)),
               list(rownames(same$template$landmarks), c("x", "y", "z"), c("face 1", "face 2")))
})

test_that("the difference of groups at the vertices is the given effect", {
  faces <- simulated(2, effect = c(brow = 2, cheek = 1), size_effect = 0, size_sd = 0,
                     variation = still, scan = clean, seed = 1)
  effect <- true_effect(faces, t(faces$template$mesh$vb[1:3, ]))
  expect_equal(vertices_of(faces, 2) - vertices_of(faces, 1), unname(effect), tolerance = 1e-10)
  middle <- true_effect(faces, faces$places[c("x", "y", "z")])
  outward <- rowSums(middle * as.matrix(faces$places[c("dx", "dy", "dz")]))
  expect_equal(outward, c(2, 2, -1, -1), tolerance = 1e-10)
  expect_equal(row_lengths(middle), c(2, 2, 1, 1), tolerance = 1e-10)
  expect_identical(max(abs(true_effect(faces))), 0)
})

test_that("effect and size leave the random fields as they are", {
  with <- simulated(4, effect = 3, size_effect = 0.1, scan = NULL, seed = 5)
  without <- simulated(6, effect = 0, size_effect = 0, scan = NULL, seed = 5)
  at <- face_effect()[c("x", "y", "z")]
  centre <- rowMeans(with$template$mesh$vb[1:3, ])
  unsized <- function(faces, i) {
    sweep(sweep(true_points(faces, at)[, , i], 2, centre) / faces$covariates$size[i], 2,
          centre, `+`)
  }
  for (i in 1:4) {
    g <- c(female = -1 / 2, male = 1 / 2)[[as.character(with$covariates$group[i])]]
    expect_equal(unsized(with, i) - unsized(without, i), g * true_effect(with, at),
                 tolerance = 1e-10)
  }
  expect_equal(with$covariates$size / without$covariates$size[1:4], rep(1.1^c(-1 / 2, 1 / 2), 2))
})

test_that("sizes have the given ratio and spread", {
  faces <- simulated(2000, effect = 0, size_effect = 0.05, size_sd = 0.04, scan = NULL,
                     variation = still, waves = 1, seed = 1)
  log_size <- split(log(faces$covariates$size), faces$covariates$group)
  expect_lt(abs(mean(log_size$male) - mean(log_size$female) - log(1.05)), 4 * 0.04 * sqrt(2 / 1000))
  expect_lt(abs(sd(log_size$male) - 0.04), 4 * 0.04 / sqrt(2000))
  lone <- simulated(2, effect = 0, size_effect = 0.05, size_sd = 0, scan = NULL, variation = still)
  size <- apply(true_points(lone), 3, function(x) sqrt(sum(scale(x, scale = FALSE)^2)))
  expect_equal(size[[2]] / size[[1]], 1.05)
})

test_that("a seed gives the same faces and leaves the user's stream alone", {
  set.seed(9)
  before <- .Random.seed
  one <- simulated(1, seed = 4)
  expect_identical(.Random.seed, before)
  two <- simulated(2, seed = 4)
  expect_identical(one$specimens[[1]]$mesh, two$specimens[[1]]$mesh)
  expect_identical(two$covariates$size[1], one$covariates$size)
  set.seed(9)
  own <- simulated(1, scan = NULL)
  set.seed(9)
  expect_identical(simulated(1, scan = NULL)$covariates, own$covariates)
  expect_false(identical(simulated(1, scan = NULL)$covariates, own$covariates))
})

test_that("every scan has its own vertices, off by its noise, and holes clear of landmarks", {
  scan <- scan_settings(noise = 0.2, holes = 4, hole_radius = 6)
  faces <- simulated(2, scan = scan, size_sd = 0, size_effect = 0, seed = 3)
  expect_false(ncol(faces$specimens[[1]]$mesh$vb) == ncol(faces$specimens[[2]]$mesh$vb))
  for (i in 1:2) {
    off <- row_lengths(true_points(faces, faces$vertices[[i]])[, , i] - vertices_of(faces, i))
    expect_lt(abs(sqrt(mean(off^2)) / 0.2 - 1), 4 / sqrt(2 * length(off)))
    # No vertex follows the one before it.
    expect_gt(median(row_lengths(diff(faces$vertices[[i]]))), 30)
    near <- nearest_centres(faces$vertices[[i]], faces$template$landmarks, 1)
    expect_lt(max(row_lengths(faces$vertices[[i]][near, ] - faces$template$landmarks)), 3)
  }
  expect_gt(report_count(faces$specimens[[1]], "holes"), report_count(template, "holes"))
})

test_that("an observer misses landmarks by the given error, on the surface", {
  scan <- scan_settings(noise = 0, remesh = FALSE, landmark_error = 0.5)
  faces <- simulated(6, effect = 0, variation = still, scan = scan, waves = 1, seed = 3)
  off <- true_points(faces) - vapply(faces$specimens, `[[`, faces$template$landmarks, "landmarks")
  rms <- sqrt(mean(apply(off, c(1, 3), function(x) sum(x^2))))
  # Two directions along the surface: sd sqrt(2), from 6 x 23 x 2 values.
  expect_lt(abs(rms / (0.5 * sqrt(2)) - 1), 4 / sqrt(2 * 6 * 23 * 2))
})

test_that("noise can go together over a distance", {
  scan <- scan_settings(noise = 0.5, noise_range = 10, remesh = FALSE)
  faces <- simulated(1, effect = 0, size_effect = 0, size_sd = 0, variation = still,
                     scan = scan, seed = 3)
  off <- row_lengths(vertices_of(faces, 1) - t(faces$template$mesh$vb[1:3, ]))
  it <- faces$template$mesh$it
  expect_gt(cor(off[it[1, ]], off[it[2, ]]), 0.8)
})

test_that("answers do not depend on the unit", {
  faces <- simulate_faces(1, effect = 2, seed = 7,
                          scan = scan_settings(noise = 0.1, holes = 1, remesh = FALSE))
  mesh <- faces$template$mesh
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] / 1000
  places <- face_effect()
  places[c("x", "y", "z", "radius")] <- places[c("x", "y", "z", "radius")] / 1000
  template <- specimen(mesh, faces$template$landmarks / 1000)
  metres <- simulate_faces(1, effect = 2e-3, seed = 7, places = places, template = template,
                           scan = scan_settings(noise = 1e-4, holes = 1, hole_radius = 0.005,
                                                remesh = FALSE),
                           population = population_settings(
                             variation = data.frame(range = c(60, 20), sd = c(1.5, 0.5)) / 1000))
  expect_equal(metres$specimens[[1]]$mesh$vb[1:3, ] * 1000, faces$specimens[[1]]$mesh$vb[1:3, ],
               tolerance = 1e-8)
})

test_that("any template and scheme will do, and the faces can be measured", {
  skip_if_not_installed("future.apply")
  skip_if_not_installed("progressr")
  corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
  ball <- specimen(ball_mesh(4), corners, id = "ball")
  places <- data.frame(part = "top", x = 0, y = 0, z = 1.2, radius = 0.4, share = -1, dx = 0,
                       dy = 0, dz = 1)
  balls <- simulate_faces(2, effect = 0.1, size_effect = 0.1, places = places, template = ball,
                          scan = clean, seed = 1,
                          population = population_settings(
                            size_sd = 0, variation = data.frame(range = 1, sd = 0),
                            groups = c("small", "large")
                          ))
  curves <- data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 9)
  scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "side")
  shapes <- fit_shapes(balls$specimens, scheme)
  expect_equal(nrow(failures(shapes)), 0)
  length <- vapply(as.list(shapes), function(shape) shape$status$length[shape$status$part == "ab"],
                   0)
  expect_equal(length[["face 2"]] / length[["face 1"]], 1.1, tolerance = 1e-6)
  expect_equal(true_effect(balls, cbind(0, 0, 1)), cbind(x = 0, y = 0, z = -0.1), tolerance = 1e-6)
  expect_equal(levels(balls$covariates$group), c("small", "large"))
})

test_that("what cannot be is said", {
  ball <- specimen(ball_mesh(2), rbind(a = c(0, 0, 1)), id = "ball")
  expect_crestline_error(simulate_faces(2, template = ball), c("effect", "places"))
  expect_crestline_error(simulate_faces(2, effect = c(chin = 1), scan = NULL), c("effect", "brow"))
  expect_crestline_error(simulate_faces(2, places = face_effect()["part"], scan = NULL), "places")
  expect_crestline_error(simulate_faces(2, scan = NULL,
                                        population = population_settings(
                                          variation = data.frame(sd = 1))),
                         "variation")
  expect_crestline_error(simulate_faces(2, scan = NULL,
                                        population = population_settings(groups = "one")), "groups")
  expect_crestline_error(simulate_faces(0), "`n`")
  expect_crestline_error(scan_settings(remesh = NA), "remesh")
  expect_crestline_error(scan_settings(noise = -1), "noise")
  expect_crestline_error(simulate_faces(1,
                                        scan = scan_settings(holes = 1, hole_radius = 500,
                                                             remesh = FALSE)), "room")
  expect_crestline_error(true_points(1), "simulate_faces")
})

test_that("print fits a screen", {
  faces <- simulated(1, seed = 1)
  shown <- capture.output(print(faces))
  expect_lte(max(nchar(shown)), 80)
  expect_match(shown[2], "male is +3 % in size, brow +2, cheek -2", fixed = TRUE)
  expect_match(capture.output(print(simulated(1, scan = NULL, seed = 1)))[4], "truth only")
  expect_identical(as.data.frame(faces), faces$covariates)
})

test_that("a template of one's own needs no places of an effect; parts may be a factor", {
  ball <- specimen(ball_mesh(2), rbind(a = c(0, 0, 1)), id = "ball")
  made <- simulate_faces(2, effect = 0, template = ball, scan = NULL)
  expect_equal(max(abs(true_effect(made, cbind(0, 0, 1)))), 0)
  places <- data.frame(part = factor(c("top", "front"), c("front", "top")), x = c(0, 1), y = 0,
                       z = c(1, 0), radius = 0.2, share = 1)
  made <- simulate_faces(2, effect = c(top = 0.5, front = 0), places = places, template = ball,
                         scan = NULL)
  expect_equal(abs(true_effect(made, cbind(0, 0, 1))[1, "z"]), c(z = 0.5), tolerance = 1e-3)
  expect_lt(max(abs(true_effect(made, cbind(1, 0, 0)))), 1e-3)
})
