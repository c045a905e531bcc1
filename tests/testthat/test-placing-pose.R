# A lump that is no solid of revolution, of two sizes of detail.
lump <- function(n = 4) {
  mesh <- Rvcg::vcgSphere(n)
  at <- mesh$vb[1:3, ]
  bump <- function(place, height, width) height * exp(-colSums((at - place)^2) / (2 * width^2))
  r <- 60 + bump(c(0, 0, 1), 25, 0.15) + bump(c(0, 0.8, 0.6), 12, 0.2) +
    bump(c(0.7, -0.2, 0.68), 15, 0.12)
  mesh$vb[1:3, ] <- rep(r, each = 3) * at * c(0.75, 1.25, 1)
  specimen(mesh, rbind(a = c(0, 0, 85), b = c(0, 72, 43), c = c(40, -18, 51), d = c(0, -75, 0)),
           id = "lump", tolerance = 0.2)
}

test_that("a known pose is found again, scale and all", {
  own <- landmark_template(lump(), unit = 1)
  settings <- find_settings(points = 800)
  prepared <- prepared_template(own, settings, 1)
  turn <- some_rotation(5)
  moved <- specimen(moved_mesh(own$specimen$mesh, turn, c(30, -200, 10)))
  laid <- laid_template(prepared, own, moved, settings, 1)
  expect_lt(laid$score, 0.1)
  expect_equal(matrix(laid$pose[1:9], 3), turn, tolerance = 0.01)
  expect_equal(laid$pose[10:12], c(30, -200, 10), tolerance = 0.01)
  expect_equal(laid$pose[13], 1, tolerance = 0.01)
  expect_false(laid$inverted)
  place <- with_seed(1, matrix(stats::rnorm(9), 3))
  expect_equal(into_frame(from_frame(place, laid), laid), place)
})

test_that("any specimen with landmarks serves as a template", {
  own <- lump()
  turn <- some_rotation(8)
  moved <- moved_mesh(own$mesh, turn, c(0, 0, 50), 0.01)
  found <- find_landmarks(moved, own, settings = find_settings(points = 500, warp_steps = 10))
  expect_equal(found$match$unit, 100)
  truth <- own$landmarks %*% t(turn) * 0.01 + rep(c(0, 0, 50), each = 4)
  expect_lt(max(row_lengths(found$landmarks - truth)), 0.02)
})

test_that("an inverted cloud inverted again is the first", {
  settings <- scaled_settings(find_settings(), 1)
  cloud <- scan_cloud(lump(), 1, settings)
  cloud <- with_anchors(with_curvature(cloud, settings, 1), settings, 1)
  twice <- inverted_cloud(inverted_cloud(cloud))
  expect_equal(twice[c("normal", "k1", "k2")], cloud[c("normal", "k1", "k2")])
  expect_equal(twice$anchors$kind, cloud$anchors$kind)
  frames <- attr(inverted_cloud(cloud)$anchors, "frames")
  expect_true(all(abs(vapply(frames, det, 0) - 1) < 1e-9))
})

test_that("the best pose of trimmed matches is Horn's", {
  own <- with_seed(4, matrix(stats::rnorm(300, sd = 30), 3))
  normal <- with_seed(5, apply(matrix(stats::rnorm(300), 3), 2, function(x) x / sqrt(sum(x^2))))
  angle <- 0.05
  turn <- rbind(c(cos(angle), -sin(angle), 0), c(sin(angle), cos(angle), 0), c(0, 0, 1))
  settings <- list(reach = c(20, 5), steps = 10L, cosine = 0.5, kept = 0.9, scale = c(0.9, 1.1),
                   saturation = 5, spacing = 1, more = 0L, rest = 0)
  found <- cpp_fit_poses(own, normal, 1.03 * turn %*% own + c(1, 2, 3), turn %*% normal,
                         matrix(c(diag(3), 0, 0, 0, 1)), settings)
  expect_equal(found$poses[, 1], c(turn, 1, 2, 3, 1.03), tolerance = 1e-8)
  expect_lt(found$score, 1e-8)
})

test_that("a pose is fitted on until it rests, and says whether it does", {
  own <- with_seed(4, matrix(stats::rnorm(300, sd = 30), 3))
  normal <- with_seed(5, apply(matrix(stats::rnorm(300), 3), 2, function(x) x / sqrt(sum(x^2))))
  settings <- list(reach = c(20, 5), steps = 1L, cosine = -1, kept = 1, scale = c(1, 1),
                   saturation = 5, spacing = 1, more = 0L, rest = 1e-9)
  fit <- function(more, rest) {
    settings[c("more", "rest")] <- list(more, rest)
    cpp_fit_poses(own, normal, own + c(1, 1, 0), normal, matrix(c(diag(3), 0, 0, 0, 1)), settings)
  }
  expect_false(fit(0L, 1e-9)$rests)
  expect_true(fit(50L, 1e-9)$rests)
  expect_equal(fit(50L, 1e-9)$poses[, 1], c(diag(3), 1, 1, 0, 1), tolerance = 1e-8)
})
