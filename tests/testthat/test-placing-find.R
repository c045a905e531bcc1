# Found once for the file.
found_humface <- local({
  found <- NULL
  function() {
    if (is.null(found))
      found <<- find_landmarks(humface_scan(), id = "humface", settings = quick_settings())
    found
  }
})

test_that("the landmarks of a face are found near those placed by hand, with their states", {
  face <- found_humface()
  placed <- humface_landmarks()
  expect_setequal(rownames(face$landmarks), rownames(placed))
  inner <- setdiff(rownames(placed), ear_names)
  error <- row_lengths(face$landmarks[inner, ] - placed[inner, ])
  expect_lt(mean(error), 1.5)
  expect_lt(max(error), 4)
  placing <- face$placing
  expect_equal(placing$state, ifelse(placing$landmark %in% ear_names, "predicted", "found"))
  expect_gte(sum(placing$confidence > 0.5, na.rm = TRUE), 18)
  expect_lt(face$match$score, 0.5)
  expect_gt(face$match$agree, 0.6)
  expect_equal(face$match$verdict, "face")
  expect_equal(face$match$unit, 1)
  # On the surface, located once.
  expect_equal(as.matrix(surface_points(face$mesh, face$landmarks[inner, ])[1:3]),
               face$landmarks[inner, ], ignore_attr = TRUE)
  expect_equal(landmark_point(face, "pn")[c("x", "y", "z")],
               as.data.frame(face$landmarks["pn", , drop = FALSE]), ignore_attr = TRUE)
})

test_that("neither pose, unit nor the sense of the triangles changes what is found", {
  face <- found_humface()
  turn <- some_rotation(3)
  changed <- moved_mesh(humface_scan(), turn, c(1, -2, 0.3), 0.001)
  changed$it <- changed$it[c(1, 3, 2), ]
  found <- find_landmarks(changed, settings = quick_settings())
  expect_equal(found$match$unit, 1000)
  back <- (found$landmarks - rep(c(1, -2, 0.3), each = 23)) %*% turn * 1000
  expect_lt(max(abs(back - face$landmarks)), 1e-6)
  expect_equal(found$placing$confidence, face$placing$confidence, tolerance = 1e-6)
  expect_equal(found$placing$moved * 1000, face$placing$moved, tolerance = 1e-6)
})

test_that("where found landmarks lie on the mesh is kept, also of a scan that was turned", {
  mesh <- humface_scan()
  mesh$it <- mesh$it[c(1, 3, 2), ]
  inside_out <- suppressWarnings(specimen(mesh, outward = "keep"))
  turned <- find_landmarks(inside_out, settings = quick_settings())
  expect_true(turned$match$inverted)
  for (face in list(found_humface(), turned)) {
    on <- which(face$placing$state == "found")
    located <- face$geometry$located
    expect_equal(nrow(located), length(on))
    expect_equal(place_on_faces(face$mesh, located$face, as.matrix(located[c("w1", "w2", "w3")])),
                 unname(face$landmarks[on, ]), tolerance = 1e-10)
    expect_false(any(c("face", "w1") %in% names(face$placing)))
  }
})

test_that("where the scan has no surface landmarks are absent, the others stay", {
  placed <- humface_landmarks()
  mesh <- humface_scan()
  mesh <- keep_vertices(mesh, sqrt(colSums((mesh$vb[1:3, ] - placed["pn", ])^2)) > 22)
  face <- find_landmarks(mesh, settings = quick_settings())
  state <- stats::setNames(face$placing$state, face$placing$landmark)
  expect_equal(state[["pn"]], "absent")
  expect_true(all(is.na(face$landmarks["pn", ])))
  expect_false(anyNA(face$placing$x))
  still <- c("exL", "exR", "chL", "chR", "li", "gn", "n")
  expect_true(all(state[still] == "found"))
  expect_lt(mean(row_lengths(face$landmarks[still, ] - placed[still, ])), 2.5)
})

test_that("what is no face is refused, with name and remedy", {
  ball <- ball_mesh(5)
  ball$vb[1:3, ] <- 100 * ball$vb[1:3, ]
  expect_crestline_error(find_landmarks(ball, id = "ball"),
                         c("nothing on it is like the template face", "by hand"), id = "ball")
})

test_that("if most landmarks have little confidence, a warning; the match is doubtful", {
  face <- found_humface()
  expect_false(face$match$doubtful)
  expect_equal(placing_doubt(face$placing)$of, 19)
  # The back of a head is refused by the agreement; by other limits, perhaps a face.
  data(dummyhead, package = "Rvcg", envir = environment())
  at <- read_landmarks(system.file("extdata", "dummyhead_landmarks.csv", package = "crestline"))
  head <- dummyhead.mesh
  middle <- rowMeans(head$vb[1:3, ])
  front <- unit_vector(colMeans(at[c("pn", "sn", "n", "exL", "exR"), ]) - middle)
  behind <- drop(front %*% (head$vb[1:3, ] - middle)) < -10
  head <- keep_vertices(list(vb = head$vb, it = head$it), behind)
  head <- structure(head, class = "mesh3d")
  quick <- list(points = 1000, warp_steps = 10, refuse = 1)
  error <- expect_crestline_error(
    find_landmarks(head, id = "behind", settings = do.call(find_settings, quick)),
    c("nothing on it is a face", "agreement 0."), id = "behind"
  )
  expect_s3_class(error, "crestline_landmark_error")
  lenient <- do.call(find_settings, c(quick, list(agree = c(-1, 0.45))))
  expect_warning(behind <- find_landmarks(head, id = "behind", settings = lenient, unit = 1),
                 "specimen behind.*perhaps it is no face", class = "crestline_doubtful_placing")
  expect_equal(behind$match$verdict, "perhaps")
  expect_true(behind$match$doubtful)
  expect_lte(max(behind$placing$confidence, na.rm = TRUE), 0.4)
  expect_equal(placing_doubt(behind$placing)$share, 1)
  expect_output(print(behind), "the template lies badly on it", fixed = TRUE)
  strict <- find_settings(points = 1000, warp_steps = 10, low = 0.99)
  expect_warning(find_landmarks(humface_scan(), settings = strict), "little confidence",
                 class = "crestline_doubtful_placing")
})

test_that("a template of one's own gives no verdict, but a warning where curvature disagrees", {
  found <- with_fields(found_humface(), match = utils::modifyList(
    found_humface()$match, list(verdict = NA_character_, agree = 0.2, template = "mine")
  ))
  doubt <- placing_doubt(found$placing)
  expect_warning(warn_doubtful(found, doubt, find_settings()),
                 "hardly agrees with the template mine", class = "crestline_doubtful_placing")
  found$match$agree <- 0.5
  expect_no_warning(warn_doubtful(found, doubt, find_settings()))
})

test_that("a platform, or a stray vertex, does not change the unit that is guessed", {
  face <- humface_scan()
  face$vb <- cbind(face$vb, c(0, 0, 1e6, 1))
  face$it <- cbind(face$it, c(1L, 2L, ncol(face$vb)))
  found <- find_landmarks(specimen(face, debris = 0, outward = "keep"), settings = quick_settings())
  expect_equal(found$match$unit, 1)
})

test_that("a scan that is too coarse for curvature is named", {
  ball <- Rvcg::vcgSphere(1)
  ball$vb[1:3, ] <- 90 * ball$vb[1:3, ]
  error <- expect_error(find_landmarks(specimen(ball, id = "coarse")), class = "crestline_error")
  expect_match(conditionMessage(error), "specimen coarse, ", fixed = TRUE)
})

test_that("doubt of one landmark of a group is shared by a share", {
  found <- data.frame(landmark = c("chL", "st", "chR", "pn", "gn"),
                      confidence = c(0.8, 0.4, NA, 0.9, 0.3))
  expect_equal(with_shared_doubt(found, c("chL", "st", "chR"), 0.5)$confidence,
               c(0.6, 0.4, NA, 0.9, 0.3))
  expect_equal(with_shared_doubt(found, c("chL", "st"), 1)$confidence, c(0.4, 0.4, NA, 0.9, 0.3))
  expect_identical(with_shared_doubt(found, NULL, 0.5), found)
})
