quietly <- function(code) suppressWarnings(code, classes = "crestline_rival_path")

test_that("a sphere's shortest cut is the great circle, a cylinder's between line and circle", {
  path <- quietly(reference_path(ball(), c(1, 0, 0), c(0, 1, 0), "plane"))
  expect_equal(attr(path, "length"), pi / 2, tolerance = 2e-3)
  expect_equal(attr(path, "criterion"), attr(path, "length"), tolerance = 1e-6)
  built <- closed_form_mesh(closed_forms()$cylinder)
  point <- function(u, v) c(25 * sin(u / 25), v, 25 * cos(u / 25))
  path <- quietly(reference_path(built$mesh, point(-15, -8), point(15, 8), "plane"))
  geodesic <- sqrt(30^2 + 16^2)
  expect_gte(attr(path, "length"), geodesic - 0.05)
  expect_lte(attr(path, "length"), 1.005 * geodesic)
  expect_path_on_mesh(path, built$mesh)
})

test_that("no angle of a fine grid does better", {
  bent <- bent_ridge(noise = 0.02)
  path <- quietly(reference_path(bent, "a", "b", "plane", settings = path_settings(reach = 1)))
  lengths <- vapply(seq(-1.5, 1.55, by = 0.05), function(angle) {
    tryCatch(attr(plane_path(bent, "a", "b", angle), "length"), error = function(e) Inf)
  }, 0)
  expect_lte(attr(path, "length"), min(lengths) + 1e-9)
})

test_that("the ridge's cut gathers most strength: it goes out to the ridge beside the line", {
  aside <- arched_ridges(4, 2)
  curved <- curvature(aside, 3)
  shortest <- quietly(reference_path(aside, "a", "b", "plane"))
  path <- reference_path(aside, "a", "b", "ridge", radius = curved,
                         settings = path_settings(longest = 1.5))
  expect_gt(max(path$y), 2)
  expect_identical(attr(path, "type"), "ridge")
  expect_path_on_mesh(path, aside$mesh)
  strength <- pmax(-curved$k2, 0) * (curved$k1 + curved$k2 < 0)
  mean_along <- function(p) {
    at <- rowSums(as.matrix(p[c("w1", "w2", "w3")]) *
                  matrix(strength[t(aside$mesh$it[, p$face])], ncol = 3))
    sum(diff(p$s) * (at[-1] + at[-length(at)]) / 2) / attr(p, "length")
  }
  fine <- reference_path(aside, "a", "b", "ridge", radius = curved,
                         settings = path_settings(longest = 1.5, spacing = 1e-3))
  expect_equal(attr(fine, "criterion"), mean_along(fine), tolerance = 1e-4)
  expect_equal(attr(path, "criterion"), mean_along(path), tolerance = 0.03)
  expect_gt(mean_along(path), 1.05 * mean_along(shortest))
})

test_that("`longest` holds a cut to the length of the shortest", {
  aside <- arched_ridges(4, 2)
  curved <- curvature(aside, 3)
  shortest <- attr(quietly(reference_path(aside, "a", "b", "plane")), "length")
  for (limit in c(1.01, 1.05)) {
    path <- quietly(reference_path(aside, "a", "b", "ridge", curved,
                                   settings = path_settings(longest = limit)))
    expect_lte(attr(path, "length"), limit * shortest * 1.001)
  }
})

test_that("the radius is that of the curvature that is given, else it is asked for", {
  bent <- bent_ridge()
  curved <- curvature(bent, 4)
  rlang::reset_message_verbosity("crestline: curvature =")
  expect_message(former <- reference_path(bent, "a", "b", "ridge", 4, curvature = curved),
                 "radius = <the curvature>", class = "crestline_deprecated")
  expect_equal(reference_path(bent, "a", "b", "ridge", curved), former)
  expect_crestline_error(reference_path(bent, "a", "b", "ridge"),
                         c("`radius` is NULL", "finite number"))
})

test_that("curvature that is given is used, and the same as estimated on the way", {
  bent <- bent_ridge()
  given <- reference_path(bent, "a", "b", "ridge", curvature(bent, 4))
  expect_equal(reference_path(bent, "a", "b", "ridge", 4), given, tolerance = 1e-6)
})

test_that("keep_away() turns the path from one ridge to the other", {
  twin <- arched_ridges(3.4, 3)
  curved <- curvature(twin, 2.5)
  left <- quietly(reference_path(twin, "a", "b", "ridge", curved,
                                 settings = path_settings(longest = 2)))
  expect_gt(max(left$y), 2)
  region <- keep_away(c(-13, 4, 3), c(13, 4, 3), radius = 0.13)
  right <- quietly(reference_path(twin, "a", "b", "ridge", curved,
                                  keep_away = region, settings = path_settings(longest = 2)))
  expect_lt(min(right$y), -2)
})

test_that("optima hold every local optimum, best first, with angles in (-pi/2, pi/2]", {
  twin <- arched_ridges(3.2, 2)
  path <- quietly(reference_path(twin, "a", "b", "ridge", 2.5,
                                 settings = path_settings(longest = 2)))
  optima <- attr(path, "optima")
  expect_named(optima, c("angle", "side", "criterion", "length"))
  expect_true(all(optima$angle > -pi / 2 & optima$angle <= pi / 2))
  expect_false(is.unsorted(-optima$criterion))
  expect_identical(attr(path, "angle"), optima$angle[1])
  expect_identical(attr(path, "criterion"), optima$criterion[1])
  expect_gt(max(optima$angle), 0.3)
  expect_lt(min(optima$angle), -0.3)
  for (i in seq_len(nrow(optima))) {
    cut <- plane_path(twin, "a", "b", optima$angle[i], optima$side[i])
    expect_equal(attr(cut, "length"), optima$length[i], tolerance = 1e-6)
  }
  expect_output(print(path), "Local optima")
})

test_that("two ridges nearly alike are warned of, with both angles", {
  twin <- arched_ridges(3, 3)
  warning <- expect_warning(reference_path(twin, "a", "b", "ridge", 2.5,
                                           settings = path_settings(longest = 2, rival = 0.3)),
                            class = "crestline_rival_path")
  expect_match(conditionMessage(warning), "nearly as good: at -?[0-9]+ and -?[0-9]+ degrees")
  expect_match(conditionMessage(warning), "a to b")
  expect_identical(warning$id, "graph")
  expect_no_warning(reference_path(twin, "a", "b", "ridge", 2.5,
                                   settings = path_settings(longest = 2, rival = 0.15)),
                    class = "crestline_rival_path")
  expect_no_warning(reference_path(twin, "a", "b", "ridge", 2.5,
                                   settings = path_settings(longest = 2, rival = 0.3,
                                                            distinct = 1.2)),
                    class = "crestline_rival_path")
})

test_that("planes that all cut a flat piece along one line are no rivals", {
  flat <- graph_specimen(quote(0 * u), two_ends())
  expect_no_warning(path <- reference_path(flat, "a", "b", "plane"), class = "crestline_rival_path")
  expect_equal(attr(path, "length"), sqrt(26.9^2 + 0.3^2), tolerance = 1e-6)
})

test_that("the way back is the same path", {
  bent <- bent_ridge(noise = 0.02)
  there <- reference_path(bent, "a", "b", "ridge", 4)
  back <- reference_path(bent, "b", "a", "ridge", 4)
  expect_equal(attr(back, "length"), attr(there, "length"), tolerance = 1e-6)
  expect_lt(max(distance_from_line(xyz_of(back), xyz_of(there))), 1e-5)
})

test_that("errors name the landmarks, the specimen and what to do", {
  torn <- graph_specimen(quote(0 * u), two_ends())
  middle <- which(torn$mesh$vb[1, ] > -1.5 & torn$mesh$vb[1, ] < 1.5 & abs(torn$mesh$vb[2, ]) < 17)
  it <- torn$mesh$it
  gap <- specimen(rgl::mesh3d(vertices = torn$mesh$vb,
                              triangles = it[, colSums(matrix(it %in% middle, 3)) == 0]),
                  torn$landmarks, id = "gap", outward = "keep")
  error <- expect_crestline_error(reference_path(gap, "a", "b", "plane"),
                                  c("no plane cut joins a and b", "hole"), id = "gap")
  expect_s3_class(error, "crestline_path_error")
  expect_crestline_error(reference_path(torn, "a", "b", "crest"), "crest")
  expect_crestline_error(reference_path(torn, "a", "c", "plane"), "no landmark c", id = "graph")
  expect_crestline_error(reference_path(torn, "a", "b", "ridge", list()), "`radius`")
  other <- curvature(ball(), 0.5)
  expect_crestline_error(reference_path(torn, "a", "b", "ridge", other),
                         c("vertices", "own mesh"), id = "graph")
})

test_that("strength is taken no further apart than asked; the mean is that of every edge", {
  aside <- arched_ridges(4, 2)
  surface <- walkable(aside)
  ends <- located_ends(aside, surface, "a", "b")
  cut <- measure_cuts(ends, 0.2, 0L, 0.5)
  height <- function(vertices) surface$vb[3, vertices]
  path <- cut_path(ends, 0.2, 0, 0.5)
  exact <- sum(diff(path$s) * (path$z[-1] + path$z[-nrow(path)]) / 2) / cut$length
  expect_equal(cut_strength(ends, cut, 0.5, 1e-3, height), exact, tolerance = 1e-5)
  expect_equal(cut_strength(ends, cut, 0.5, 2, height), exact, tolerance = 2e-2)
  expect_identical(cut_strength(ends, cut[0, ], 0.5, 2, height), numeric())
  asked <- NULL
  cut_strength(ends, cut, 0.5, 5, function(vertices) height(asked <<- vertices))
  expect_lte(length(asked), 3 * (ceiling(cut$length / 5) + 1))
})

test_that("angles wrap into the half turn", {
  expect_equal(wrap_angle(c(-pi / 2, pi / 2, pi, 0.1, 3 * pi / 4)),
               c(pi / 2, pi / 2, 0, 0.1, -pi / 4))
})

test_that("of planes that gather the same the shortest is taken, not one that nearly touches", {
  # every plane through it cuts along the ridge
  straight <- simulate_ridge(0, 2, jitter = 0.2, seed = 46)
  path <- reference_path(straight, "from", "to", "ridge", radius = 0.25)
  optima <- attr(path, "optima")
  expect_gt(nrow(optima), 1)
  expect_lt(optima$length[1], min(optima$length[-1]))
  best <- reference_path(straight, "from", "to", "ridge", radius = 0.25,
                         settings = path_settings(tie = 0))
  expect_gt(attr(best, "criterion"), attr(path, "criterion"))
  expect_gt(attr(path, "criterion"), (1 - 0.002) * attr(best, "criterion"))
})

test_that("outside its trusted part the path is the shortest cut", {
  face <- graph_specimen(quote(0 * u), two_ends(c(-10, 10), c(0, 0)))
  corners <- rbind(c(-10, 0, 0), c(-10, 6, 0), c(10, 6, 0), c(10, 0, 0))
  legs <- lapply(1:3, function(i) columns_of(plane_path(face, corners[i, ], corners[i + 1, ])))
  detour <- path_through(do.call(rbind, legs))
  path <- trusted_path(c(8, 24) / 32, walkable(face), detour)
  expect_path_on_mesh(path, face$mesh)
  expect_equal(attr(path, "length"), 16 + 2 * sqrt(2^2 + 6^2), tolerance = 1e-6)
  expect_equal(diff(attr(path, "trusted")), 16, tolerance = 1e-6)
  whole <- trusted_path(c(0, 1), walkable(face), detour)
  expect_equal(columns_of(whole), columns_of(detour))
})

test_that("ridge_curve() believes the part that it is told, as a scheme does", {
  face <- straight_ridge()
  scheme <- ends_scheme(curve = "crest", kind = "ridge", radius = 6, width = 6, trust_from = 0.25,
                        trust_to = 0.75)
  shape <- fit_shape(face, scheme, progress = FALSE)
  curve <- curve_of(face, "a", "b", "ridge", radius = 6, width = 6, n = 9, trust = c(0.25, 0.75))
  expect_equal(unname(coords(shape, "curves")), unname(as.matrix(curve$points[c("x", "y", "z")])),
               tolerance = 1e-9)
  whole <- curve_of(face, "a", "b", "ridge", radius = 6, width = 6, n = 9)
  expect_null(attr(whole$reference, "trusted"))
  expect_length(attr(curve$reference, "trusted"), 2)
  for (wrong in list(0.5, c(0.8, 0.2), c(-0.1, 1), c(0, NA), "all")) {
    expect_crestline_error(ridge_curve(face, "a", "b", "ridge", 6, 6, 9, trust = wrong), "`trust`")
  }
})

test_that("the demo's eye sockets keep to the lower lid, as those of the face's scheme do", {
  face <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  rows <- read.csv(system.file("extdata", "demo_curves.csv", package = "crestline"),
                   na.strings = "")
  scheme <- face_scheme()
  for (name in c("lower eye socket left", "lower eye socket right")) {
    row <- rows[rows$curve == name, ]
    side <- keep_side(row$keep_from, row$keep_to, row$keep_towards)
    curve <- ridge_curve(face, row$from, row$to, row$kind, row$radius, row$half_width,
                         row$n, keep_away = side, trust = c(0, row$trust_to))
    own <- scheme$curves[scheme$curves$curve == name, ]
    expect_equal(c(row$radius, row$half_width, row$n, row$trust_to),
                 c(own$radius, own$width, own$n, own$trust_to))
    # The line between the corners bulges down by a quarter of its length at most; a curl at the
    # corner goes up.
    corners <- face$landmarks[c(row$from, row$to), ]
    up <- corners[1, ] - face$landmarks[row$keep_towards, ]
    along <- corners[2, ] - corners[1, ]
    up <- up - sum(up * along) / sum(along^2) * along
    height <- sweep(as.matrix(curve$path[c("x", "y", "z")]), 2, corners[1, ]) %*% up /
      sqrt(sum(up^2))
    expect_lt(max(height), 0.5)
  }
})

test_that("cuts that are given up are those that are too long, whatever the order of the angles", {
  ball <- Rvcg::vcgSphere(3)
  scan <- walkable(ball)
  ends <- located_ends(ball, scan, c(1, 0, 0), c(0, 1, 0.3))
  angle <- seq(-1.5, 1.5, length.out = 31)
  whole <- measure_cuts(ends, angle, rep(0L, 31), Inf)
  some <- measure_cuts(ends, rev(angle), rep(0L, 31), Inf, longest = 1.02)[31:1, ]
  allowed <- whole$length <= 1.02 * min(whole$length)
  expect_gt(sum(allowed), 3)
  expect_gt(sum(is.na(some$length)), 10)
  expect_identical(some$length[allowed], whole$length[allowed])
  expect_identical(unique(some$end[is.na(some$length)]), "too far")
})
