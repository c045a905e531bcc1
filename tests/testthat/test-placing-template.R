test_that("the face's template is symmetric, with the facial model's landmarks", {
  face <- face_template()
  all <- rbind(face$landmarks, face$predicted)
  expect_setequal(rownames(all), face_scheme()$landmarks$landmark)
  expect_setequal(rownames(face$predicted), ear_names)
  expect_true(face$mirror)
  expect_lt(max(abs(mirrored_mean(all) - all)), 0.1)
  expect_true(all(all[endsWith(rownames(all), "L"), 1] > 0))
  mirrored <- t(face$specimen$mesh$vb[1:3, ]) %*% diag(c(-1, 1, 1))
  gap <- row_lengths(as.matrix(surface_points(face$specimen$mesh, mirrored)[1:3]) - mirrored)
  expect_lt(stats::quantile(gap, 0.95), 0.2)
  file <- system.file("extdata", "face_template", "mesh.ply.gz", package = "crestline")
  expect_lt(file.size(file), 3e5)
  expect_output(print(face), "23|19 landmarks")
})

test_that("a template stands in its own mirror's frame, and says what it lacks", {
  face <- specimen(moved_mesh(humface_scan(), some_rotation(1), c(10, 20, 30)),
                   humface_landmarks() %*% t(some_rotation(1)) + rep(c(10, 20, 30), each = 23))
  own <- landmark_template(face, ear_names)
  expect_true(own$mirror)
  expect_equal(unname(own$landmarks["exL", 1] + own$landmarks["exR", 1]), 0, tolerance = 1)
  expect_equal(as.vector(stats::dist(own$landmarks)),
               as.vector(stats::dist(face$landmarks[rownames(own$landmarks), ])))
  expect_equal(own$unit, mesh_diagonal(own$specimen$mesh) / 280, tolerance = 0.2)
  expect_crestline_error(landmark_template(face, "nose"), c("nose", "Near names"))
  face$landmarks <- face$landmarks[1:3, ]
  expect_crestline_error(landmark_template(face), "3 landmarks")
})

test_that("settings are checked, and their lengths go with the template", {
  expect_crestline_error(find_settings(turn = 3), "no setting")
  expect_crestline_error(find_settings(5), "no setting")
  expect_crestline_error(find_settings(turns = "many"), "turns")
  expect_message(former <- find_settings(kept = 0.6, robust = 2), class = "crestline_deprecated")
  expect_equal(former, find_settings(trim_share = 0.6, robust_scale = 2))
  expect_crestline_error(find_settings(reach = 3), "Give 2")
  expect_crestline_error(find_settings(cluster = 0), "above 0")
  expect_equal(find_settings(uneven = 0)$uneven, 0)
  own <- scaled_settings(find_settings(), 2)
  expect_equal(own$reach, 2 * find_settings()$reach)
  expect_equal(own$cap, find_settings()$cap / 2)
  expect_equal(own$weight, 4 * find_settings()$weight)
  expect_output(print(find_settings()), "turns = 12")
})

test_that("a landmark whose partner is missing does not move the mirror; sides need names", {
  at <- humface_landmarks()
  one_sided <- at
  one_sided["exR", ] <- NA
  whole <- landmark_template(specimen(humface_scan(), at), ear_names)
  own <- landmark_template(specimen(humface_scan(), one_sided), ear_names)
  expect_lt(max(abs(own$landmarks[, "x"] - whole$landmarks[rownames(own$landmarks), "x"])), 1)
  four <- at[c("pn", "sn", "se", "gn"), ]
  expect_crestline_error(landmark_template(specimen(humface_scan(), four), mirror = TRUE),
                         c("L and R", "mirror = FALSE"))
})
