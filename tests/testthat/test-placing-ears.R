# The tragion by a patch of an ear.

ears_of <- function(face) face$landmarks[ear_names, ]

test_that("on the head that the patch is of, the tragion is where it was placed; both sides", {
  data(dummyhead, package = "Rvcg", envir = environment())
  file <- system.file("extdata", "dummyhead_landmarks.csv", package = "crestline")
  placed <- read_landmarks(file)[ear_names, ]
  settings <- function(ear) find_settings(points = 1000, warp_steps = 10, ear = ear)
  head <- find_landmarks(dummyhead.mesh, settings = settings(c(0.55, 0.8)))
  without <- find_landmarks(dummyhead.mesh, settings = settings(c(1e-6, 1e-6)))
  off <- row_lengths(ears_of(head) - placed)
  before <- row_lengths(ears_of(without) - placed)
  expect_lt(max(off[1:2]), 2)
  expect_gt(min(before[1:2]), 2 * max(off[1:2]))
  # The lower end of the ear stays with the prediction, and all are still predicted.
  expect_equal(off[3:4], before[3:4])
  state <- head$placing$state[match(ear_names, head$placing$landmark)]
  expect_equal(state, rep("predicted", 4))
})

test_that("without ears the others predict the tragion; calibration replaces the patch", {
  settings <- find_settings(points = 1000, warp_steps = 10, ear = c(1e-6, 1e-6))
  expect_equal(ears_of(find_landmarks(humface_scan(), settings = settings)),
               ears_of(found_lines()))
  expect_named(face_template()$ear, c("tL", "tR"))
  own <- suppressWarnings(specimen(humface_scan(), humface_landmarks(), id = "humface"))
  mine <- calibrate_template(face_template(), own, rounds = 1, settings = quick_settings())
  expect_length(mine$ear, 0)
})

test_that("a patch comes to where it lies in a cloud, and nowhere on a ball", {
  ear <- face_template()$ear$tR
  expect_lt(ear$landmark[1], 0)
  settings <- find_settings()
  turn <- some_rotation(1)
  small <- diag(3) + 0.1 * (turn - t(turn)) / 2
  turn <- svd(small)
  turn <- turn$u %*% t(turn$v)
  middle <- rowMeans(ear$xyz)
  moved <- function(xyz) turn %*% (xyz - middle) + middle + c(3, 8, -6)
  cloud <- list(xyz = moved(ear$xyz), normal = turn %*% ear$normal, k1 = ear$k1, k2 = ear$k2,
                border = logical(length(ear$k1)), spacing = c(2.5, 5))
  place <- place_by_ear(ear, cloud, ear$landmark, settings)
  expect_equal(place, drop(moved(cbind(ear$landmark))), tolerance = 0.01)
  # Its hollow is found where the prediction is 20 mm off.
  expect_equal(place_by_ear(ear, cloud, ear$landmark + c(0, 0, 20), settings), place,
               tolerance = 0.01)
  ball <- with_seed(1, matrix(stats::rnorm(1200), 3))
  ball <- ball / rep(sqrt(colSums(ball^2)), each = 3)
  smooth <- list(xyz = 40 * ball + ear$landmark, normal = ball, k1 = rep(-1 / 40, 400),
                 k2 = rep(-1 / 40, 400), border = logical(400), spacing = c(2.5, 5))
  expect_null(place_by_ear(ear, smooth, ear$landmark, settings))
  expect_null(place_by_ear(ear, smooth, ear$landmark + 500, settings))
})

test_that("a hollow's place and strength are those of a dent", {
  grid <- as.matrix(expand.grid(x = -20:20, y = -20:20, z = 0))
  r2 <- rowSums((grid - rep(c(4, -3, 0), each = nrow(grid)))^2)
  # A dent of radius 6 with a smaller curvature of 0.05, and a sharper valley, which is no cup
  dent <- r2 < 36
  valley <- grid[, 1] < -15
  cloud <- list(xyz = t(grid), k1 = ifelse(valley, 1, 0.05 * dent), k2 = 0.05 * dent,
                border = logical(nrow(grid)), spacing = c(1, 2))
  settings <- find_settings(ear_hollow = c(12, 45, 8))
  found <- strongest_hollow(cloud, c(0, 0, 0), settings)
  expect_equal(found$at, c(4, -3, 0), tolerance = 1e-8)
  expect_equal(found$strength, sum(0.05 * (1 - r2[dent] / 144)))
  expect_null(strongest_hollow(cloud, c(100, 0, 0), settings))
  cloud$border[dent] <- TRUE
  expect_null(strongest_hollow(cloud, c(0, 0, 0), settings))
  # Beyond the first limit a patch counts only where the scan is deep.
  ear <- face_template()$ear$tL
  seen <- c(ear, list(border = logical(length(ear$k1))))
  seen$xyz <- seen$xyz + 0.5 * outer(c(1, -1, 0), sin(seq_along(ear$k1)))
  place <- function(...) {
    place_by_ear(ear, seen, ear$landmark, find_settings(ear = c(1e-6, 1), ...))
  }
  expect_null(place(ear_hollow = c(12, 45, 50)))
  expect_equal(place(ear_hollow = c(12, 45, 1)), ear$landmark, tolerance = 0.02)
})
