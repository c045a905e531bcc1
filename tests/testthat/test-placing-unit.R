test_that("a face in no unit is found as in mm, and its unit is said to be a guess", {
  face <- humface_scan()
  face$vb[1:3, ] <- face$vb[1:3, ] * 3.7
  settings <- quick_settings()
  expect_warning(found <- find_landmarks(face, id = "big", settings = settings),
                 "specimen big.*its unit is a guess", class = "crestline_guessed_unit")
  expect_false(found$match$unit_known)
  expect_equal(found$match$unit * 3.7, 1, tolerance = 0.12)
  expect_equal(found$match$scale, 1)
  expect_output(print(found), "unit unknown: about", fixed = TRUE)
  expect_identical(unit_line(list(unit = 10, unit_known = TRUE)),
                   "- unit: lengths times 10 are in the unit of the template")
  expect_null(unit_line(list(unit = 1, unit_known = TRUE)))
  expect_null(unit_line(NULL))
  inner <- setdiff(rownames(humface_landmarks()), ear_names)
  off <- row_lengths(found$landmarks[inner, ] / 3.7 - humface_landmarks()[inner, ])
  expect_lt(mean(off), 2)
})

test_that("a size between two powers of ten is told as a guess too, unless the unit is given", {
  face <- humface_scan()
  face$vb[1:3, ] <- face$vb[1:3, ] * 0.7
  settings <- quick_settings()
  expect_warning(found <- find_landmarks(face, id = "small", settings = settings),
                 class = "crestline_guessed_unit")
  expect_equal(found$match$unit * 0.7, 1, tolerance = 0.15)
  known <- expect_no_warning(find_landmarks(face, settings = settings, unit = 1),
                             class = "crestline_guessed_unit")
  expect_true(known$match$unit_known)
})

test_that("a face in a unit 1.4 times off is fitted again at the template's size", {
  file <- shared_data("ict", "ict_05.ply")
  table <- utils::read.csv(shared_data("ict", "landmarks.csv"))
  table <- table[table$id == "ict_05" & !table$landmark %in% ear_names, ]
  face <- read_specimen(file)$mesh
  face$vb[1:3, ] <- 7 * face$vb[1:3, ]
  found <- suppressWarnings(find_landmarks(face, id = "ict_05"), classes = "crestline_warning")
  expect_false(found$match$unit_known)
  off <- row_lengths(found$landmarks[table$landmark, ] / 7 - as.matrix(table[c("x", "y", "z")]))
  # 3.03 in mm; 3.94 before it was fitted again.
  expect_lt(mean(off), 3.3)
  once <- suppressWarnings(find_landmarks(face, settings = find_settings(sure = 0.3)),
                           classes = "crestline_warning")
  expect_gt(found$match$agree, once$match$agree + 0.1)
})

test_that("a mesh with very many vertices in a ball is thinned before its curvature", {
  ball <- Rvcg::vcgSphere(5)
  ball$vb[1:3, ] <- 50 * ball$vb[1:3, ]
  settings <- scaled_settings(find_settings(ball_points = 60), 1)
  cloud <- scan_cloud(specimen(ball), 1, settings)
  group <- cell_groups(t(ball$vb[1:3, ]), 3)
  thin <- thinned_mesh(cloud$mesh, group)
  expect_equal(ncol(thin$vb), length(group$vertex))
  expect_lt(ncol(thin$vb), ncol(ball$vb) / 2)
  expect_true(all(thin$it[1, ] != thin$it[2, ] & thin$it[2, ] != thin$it[3, ]))
  # Still a closed surface: every edge in two triangles, Euler's number 2.
  edge <- apply(cbind(thin$it[1:2, ], thin$it[2:3, ], thin$it[c(3, 1), ]), 2, sort)
  expect_equal(unique(c(table(paste(edge[1, ], edge[2, ])))), 2)
  curved <- with_curvature(cloud, settings, 1)
  expect_equal(stats::median(curved$k1), -1 / 50, tolerance = 0.05)
  expect_equal(stats::median(curved$k2), -1 / 50, tolerance = 0.05)
})
