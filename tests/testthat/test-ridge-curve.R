# Truth of bent_ridge(): the crest's v at u.
crest <- function(u) 1.5 * sin(u / 8)
off_crest <- function(curve) mean(abs(curve$path$y - crest(curve$path$x)))
of_bent <- function(specimen = bent_ridge(), ..., radius = 4, n = 9) {
  curve_of(specimen, "a", "b", "ridge", radius = radius, width = 5, n = n, ...)
}

expect_sound_curve <- function(curve, specimen, n) {
  points <- as.data.frame(curve)
  expect_named(points, c("point", "s", "x", "y", "z", "d", "se", "face", "w1", "w2", "w3"))
  expect_identical(points$point, seq_len(n))
  expect_on_mesh(points, specimen$mesh)
  expect_path_on_mesh(curve$path, specimen$mesh)
  expect_lt(max(chords(points)) / min(chords(points)) - 1, 1e-8)
  expect_identical(xyz_of(points)[1, ], specimen$landmarks[curve$from, ], ignore_attr = TRUE)
  expect_identical(xyz_of(points)[n, ], specimen$landmarks[curve$to, ], ignore_attr = TRUE)
  expect_lt(max(distance_from_line(xyz_of(points), xyz_of(curve$path))), 1e-6 * curve$length)
  expect_equal(curve$length, attr(curve$path, "length"))
  expect_equal(points$s[n], curve$length)
}

test_that("the valley between humface's lips: a curve on the mesh from corner to stomion", {
  face <- humface_specimen()
  expect_no_warning(lip <- ridge_curve(face, "chL", "st", "valley", radius = 5, width = 6, n = 9))
  expect_s3_class(lip, "curve")
  expect_sound_curve(lip, face, 9)
  expect_true(lip$converged)
  expect_true(lip$determined)
  expect_gt(lip$strength, attr(lip$reference, "criterion") * 0.9)
  expect_lt(lip$se, 0.5)
  expect_true(all(lip$points$se[2:8] > 0))
  expect_lte(max(abs(lip$points$d)), 6)
  expect_identical(lip[c("id", "from", "to", "type", "radius", "width", "passes")],
                   list(id = "humface", from = "chL", to = "st", type = "valley", radius = 5,
                        width = 6, passes = NULL))
})

test_that("every stage is kept, each of its class", {
  curve <- of_bent()
  expect_s3_class(curve$reference, "mesh_path")
  expect_s3_class(curve$coordinates, "path_coordinates")
  expect_s3_class(curve$surface, "curvature_surface")
  expect_s3_class(curve$line, "ridge_line")
  expect_s3_class(curve$settings, "ridge_settings")
  expect_equal(curve$line$s[41], attr(curve$reference, "length"))
})

test_that("a ridge whose crest is known is found, better than by the reference path", {
  curve <- of_bent()
  expect_lt(off_crest(curve), 0.1)
  path <- reference_path(bent_ridge(), "a", "b", "ridge", 4,
                         settings = path_settings(order = "adaptive cubic"))
  expect_lt(off_crest(curve), 0.3 * mean(abs(path$y - crest(path$x))))
  expect_true(curve$determined)
  straight <- curve_of(straight_ridge(), "a", "b", "ridge", radius = 4, width = 5, n = 9)
  expect_lt(max(abs(straight$points$y)), 0.25) # the landmarks themselves are off by 0.2
})

test_that("noise moves it by a share of the spacing, and its band holds the truth", {
  curve <- of_bent(bent_ridge(noise = 0.05))
  expect_lt(off_crest(curve), 0.3)
  expect_true(curve$determined)
  inner <- curve$points[2:8, ]
  expect_gte(mean(abs(inner$y - crest(inner$x)) < 3 * inner$se), 0.5)
})

test_that("a second pass is nearer on clean data, its reference is the first pass's curve", {
  once <- of_bent(settings = ridge_settings(lambda = 1e-3, passes = 1))
  twice <- of_bent(settings = ridge_settings(lambda = 1e-3, passes = 2))
  expect_lt(off_crest(twice), off_crest(once))
  expect_equal(attr(twice$reference, "length"), once$length)
  expect_lt(mean(abs(twice$line$alpha)), 0.8 * mean(abs(once$line$alpha)))
  expect_sound_curve(twice, bent_ridge(), 9)
  expect_identical(twice$passes, 2L)
})

test_that("the paper's settings go all the way", {
  curve <- suppressWarnings(of_bent(settings = ridge_settings("paper")))
  expect_sound_curve(curve, bent_ridge(), 9)
  expect_lt(off_crest(curve), 0.5)
  expect_equal(curve$surface$df, 12, tolerance = 1e-6)
})

test_that("vertices of the wrong sign count as 0, or are left out", {
  strengths <- function(...) {
    suppressWarnings(curve_of(bent_ridge(), "a", "b", "ridge", radius = 4, width = 9, n = 9,
                              settings = ridge_settings(window = Inf, ...)))$surface$strength
  }
  kept <- strengths()
  expect_gt(sum(kept == 0), 50)
  left <- strengths(wrong_sign = "drop")
  expect_true(all(left > 0))
  expect_length(left, sum(kept > 0))
})

test_that("nu0 is the mean strength near the reference path, no curvature counting as 0", {
  window <- data.frame(d = c(0, 0.5, -1, 1.1, 0), inside = c(TRUE, TRUE, TRUE, TRUE, FALSE))
  expect_equal(core_strength(window,
                             list(value = c(3, NA, 6, 100, 100), rows = which(window$inside)), 1),
               3)
  expect_true(is.na(core_strength(window[4:5, ], list(value = c(1, 1)), 1)))
  window$s <- 1:5
  expect_equal(core_strength(window, list(value = c(3, NA, 6, 100), rows = 1:4), 1,
                             trusted = c(2, 3)), 3)
  expect_equal(core_strength(window, list(value = c(3, NA, 6, 100), rows = 1:4), 1,
                             trusted = c(3, 5)), 6)
  curve <- of_bent()
  near <- curve$coordinates$vertex[abs(curve$coordinates$d) <= 0.3 * 4 & curve$coordinates$inside]
  expect_equal(curve$scale,
               mean(-curvature(bent_ridge(), 4, order = curve$settings$order)$k2[near]),
               tolerance = 0.05)
})

test_that("n points, from 2 on", {
  bent <- bent_ridge()
  expect_sound_curve(of_bent(bent, n = 2), bent, 2)
  expect_sound_curve(of_bent(bent, n = 40), bent, 40)
})

test_that("d of the points is their distance from the reference path", {
  bent <- bent_ridge()
  curve <- of_bent(bent)
  found <- cpp_path_coordinates(t(xyz_of(curve$points)), t(xyz_of(curve$reference)),
                                path_normals(bent$mesh, curve$reference))
  expect_lt(max(abs(curve$points$d - found$d)), 0.1)
})

test_that("without standard errors there are none, and nothing is said of being determined", {
  curve <- of_bent(settings = ridge_settings(error = FALSE))
  expect_true(all(is.na(curve$points$se)))
  expect_true(is.na(curve$determined))
  expect_equal(curve$path, of_bent()$path)
})

test_that("curvature that is given makes the same curve", {
  bent <- bent_ridge(noise = 0.02)
  known <- curvature(bent, 4, order = ridge_settings()$order)
  expect_equal(of_bent(bent, radius = known)$points, of_bent(bent)$points, tolerance = 1e-6)
  expect_crestline_error(of_bent(bent, radius = curvature(ball(), 0.5)), "own mesh",
                         id = "graph")
})

test_that("mean strength is that along the curve", {
  bent <- bent_ridge()
  curve <- of_bent(bent, settings = ridge_settings(strength = "principal", cap = Inf))
  known <- curvature(bent, 4, order = ridge_settings()$order)
  strength <- pmax(-known$k2, 0) * (known$k1 + known$k2 < 0)
  p <- curve$path
  at <- rowSums(as.matrix(p[c("w1", "w2", "w3")]) *
                matrix(strength[t(bent$mesh$it[, p$face])], ncol = 3))
  expect_equal(curve$strength, sum(diff(p$s) * (at[-1] + at[-length(at)]) / 2) / curve$length,
               tolerance = 1e-4)
})

test_that("a plane curve is the shortest cut, with nothing to determine", {
  bent <- bent_ridge()
  curve <- curve_of(bent, "a", "b", "plane", n = 7)
  expect_sound_curve(curve, bent, 7)
  shortest <- suppressWarnings(reference_path(bent, "a", "b", "plane"))
  expect_equal(curve$length, attr(shortest, "length"))
  expect_true(is.na(curve$determined))
  expect_identical(curve$points$d, numeric(7))
  expect_true(all(is.na(curve$points$se)))
  expect_true(curve$converged)
  expect_output(print(curve), "<curve> plane from a to b on graph")
})

test_that("keep_away() counts strength as 0 in the window too", {
  bent <- bent_ridge()
  region <- keep_away(c(-4, crest(-0.5), 6), c(4, crest(0.5), 6), radius = 0.5)
  curve <- suppressWarnings(of_bent(bent, keep_away = region))
  at <- curve$coordinates$vertex[curve$surface$rows]
  inside <- is_kept_away(located_regions(region, region_locator(bent), NULL),
                         t(bent$mesh$vb[1:3, at]))
  expect_gt(sum(inside), 10)
  expect_true(all(curve$surface$strength[inside] == 0))
  expect_gt(min(curve$surface$strength[!inside & abs(curve$coordinates$d[curve$surface$rows]) < 1]),
            0)
})

test_that("noise on a plane is not taken for a ridge: warned of, flagged, with the reason", {
  noisy <- graph_specimen(quote(0 * u), two_ends(), noise = 0.3)
  warning <- expect_warning(curve <- curve_of(noisy, "a", "b", "ridge", radius = 4, width = 5,
                                              n = 9), class = "crestline_undetermined")
  expect_match(conditionMessage(warning), "ridge from a to b is not determined")
  expect_match(conditionMessage(warning), "plane")
  expect_identical(warning$id, "graph")
  expect_false(curve$determined)
  expect_false(is.na(curve$reason))
  expect_sound_curve(curve, noisy, 9)
  expect_output(print(curve), "NOT determined by curvature")
})

test_that("no curvature of the sought sign: the reference path, flagged", {
  sphere <- specimen(ball(), rbind(a = c(1, 0, 0), b = c(0, 1, 0)), id = "ball")
  expect_warning(curve <- curve_of(sphere, "a", "b", "valley", radius = 0.3, width = 0.4, n = 5),
                 "no valley curvature", class = "crestline_undetermined")
  expect_false(curve$determined)
  expect_equal(curve$length, pi / 2, tolerance = 2e-3)
  expect_true(all(is.na(curve$points$d)))
  expect_null(curve$line)
})

test_that("a mesh without landmarks will do with positions", {
  bent <- bent_ridge()
  curve <- curve_of(bent$mesh, bent$landmarks["a", ], bent$landmarks["b", ], "ridge", radius = 4,
                    width = 5, n = 9)
  expect_equal(curve$points, of_bent(bent)$points, tolerance = 1e-6)
  expect_null(curve$id)
  expect_output(print(curve), "<curve> ridge from \\(-13.3, .*\\) to \\(13.6, ")
})

test_that("errors name the specimen, the landmark and the remedy", {
  bent <- bent_ridge()
  call <- function(specimen = bent, from = "a", to = "b", type = "ridge", radius = 4, width = 5,
                   n = 9, ...) {
    ridge_curve(specimen, from, to, type, radius = radius, width = width, n = n, ...)
  }
  expect_crestline_error(call(to = "c"), c("graph", "no landmark c", "Near names"), id = "graph")
  missing <- bent
  missing$landmarks["b", ] <- NA
  expect_crestline_error(call(missing), c("graph", "landmark b is missing"), id = "graph")
  away <- bent
  away$landmarks["b", 3] <- away$landmarks["b", 3] + 5
  expect_crestline_error(call(away), c("graph", "off the surface", "b (by"), id = "graph")
  expect_crestline_error(call(from = "b"), "same point", id = "graph")
  expect_crestline_error(call(type = "crest"), c("`type`", "valley"))
  expect_crestline_error(call(radius = 0), "`radius`")
  expect_crestline_error(call(radius = 0.01), "larger `radius`")
  expect_crestline_error(call(width = -1), "`width`")
  expect_crestline_error(call(width = 0.3), c("vertices", "`width`"))
  expect_crestline_error(call(n = 1), "`n`")
  expect_crestline_error(call(n = 2.5), "whole number")
  expect_crestline_error(call(settings = ridge_settings(passes = 0)), "`passes`")
  expect_crestline_error(call(route = list()), "curve_route()")
  expect_crestline_error(call(reech = 1), c("`reech`", "reach"))
  expect_crestline_error(call(settings = list()), "ridge_settings")
  expect_crestline_error(call(keep_away = list(1)), "keep_away")
  expect_crestline_error(call(list()), "mesh3d")
})

test_that("a curve prints its length, strength, error and outcome", {
  curve <- of_bent()
  expect_output(print(curve), "<curve> ridge from a to b on graph")
  expect_output(print(curve), "9 points, mean strength .*, median standard error")
  expect_output(print(curve), "\n  converged")
  curve$converged <- FALSE
  expect_output(print(curve), "NOT converged")
})

test_that("a ridge along the edge of the window is flagged", {
  u <- c(-13.3, 13.6)
  winding <- graph_specimen(quote(6 * exp(-(v - 3 * sin(u / 4))^2 / 50)),
                            two_ends(u, 3 * sin(u / 4)))
  expect_warning(curve <- curve_of(winding, "a", "b", "ridge", radius = 4, width = 1, n = 9,
                                   settings = ridge_settings(lambda = 1e-7)),
                 "edge of the window", class = "crestline_undetermined")
  expect_true(curve$line$at_bound)
  expect_false(curve$determined)
})

test_that("a ridge line that cannot be lifted leaves the reference path, with the reason", {
  bent <- bent_ridge()
  path <- reference_path(bent, "a", "b", "ridge", 4)
  torn <- walkable(bent)
  torn$twin[] <- 0L # every edge a border
  ends <- located_ends(bent, torn, "a", "b")
  job <- curve_job(ends, "ridge", 9, ridge_settings(), radius = 4, width = 5,
                   source = known_curvature(curvature(bent, 4), bent))
  fit <- fit_passes(torn, path, job)
  expect_false(fit$found)
  expect_match(fit$reason, "leaves the surface")
  expect_identical(fit$path, path)
})

test_that("errors of any stage name the curve", {
  bent <- bent_ridge()
  expect_crestline_error(ridge_curve(bent, "a", "b", "ridge", radius = 400, width = 5, n = 9),
                         c("specimen graph", "ridge from a to b", "as large as the mesh"),
                         id = "graph")
})

test_that("points on the reference path for want of a ridge carry no offset, no error of it", {
  u <- straight_ridge()
  path <- reference_path(u, "a", "b", "plane")
  job <- curve_job(located_ends(u, walkable(u), "a", "b"), "ridge", 5, ridge_settings(), radius = 4)
  fit <- list(found = FALSE, reason = "not lifted",
              line = list(s = c(0, 1), alpha = c(1, 1), se = c(1, 1)), scale = 1,
              coordinates = path_coordinates(u, path, 4))
  every <- seq_len(nrow(fit$coordinates))
  fit$strengths <- list(value = rep(1, length(every)), rows = every, cell = every)
  curve <- assembled_curve(path, path, job, fit)
  expect_warning(warn_undetermined(curve), "not lifted", class = "crestline_undetermined")
  expect_true(all(is.na(curve$points$d)) && all(is.na(curve$points$se)))
  expect_false(curve$determined)
})

test_that("no strength is NaN where no direction is across the path", {
  face <- straight_ridge()
  path <- reference_path(face, "a", "b", "plane")
  window <- path_coordinates(face, path, 6)
  source <- curvature_source(face$mesh, kernel_settings(6, "adaptive"), 1L)
  along <- which(window$inside)[1]
  normal <- source(window$vertex[along])$normal
  window[along, c("tx", "ty", "tz")] <- as.list(normal)
  job <- curve_job(located_ends(face, walkable(face), "a", "b"), "ridge", 9, ridge_settings(),
                   source = source)
  strength <- window_strength(walkable(face), window, job)
  expect_true(is.na(strength$value[along]) && !any(is.nan(strength$value)))
  expect_gt(sum(!is.na(strength$value)), 10)
})

# A window of strength 2 within 0.5 of the line, `beside` farther off.
striped_curve <- function(beside, offset = 0) {
  window <- expand.grid(s = seq(0, 10, by = 0.5), d = seq(-3, 3, by = 0.25))
  structure(
    list(line = list(s = c(0, 10), alpha = c(offset, offset)),
         points = data.frame(d = rep(offset, 3)), coordinates = window,
         surface = list(rows = seq_len(nrow(window)),
                        strength = ifelse(abs(window$d - offset) <= 0.5, 2, beside)),
         settings = ridge_settings(core = 0.5), radius = 1, strength = 2, type = "ridge"),
    class = "curve"
  )
}

test_that("contrast is the strength along the curve over that beside it", {
  expect_equal(curve_contrast(striped_curve(0.4)), 5)
  expect_equal(curve_contrast(striped_curve(0.4, offset = 1)), 5)
  expect_equal(curve_contrast(striped_curve(2)), 1)
  expect_equal(curve_contrast(striped_curve(0)), Inf)
})

test_that("plane curves, and those that stayed on the reference path, have none", {
  curve <- striped_curve(1)
  curve$points$d <- NA_real_
  expect_true(is.na(curve_contrast(curve)))
  plane <- ridge_curve(quad_specimen(), "a", "b", "plane", n = 5)
  expect_true(is.na(curve_contrast(plane)))
})

test_that("a sharp ridge stands out more than a blunt one", {
  contrast <- function(b) {
    curve_contrast(suppressWarnings(ridge_curve(simulate_ridge(a = 0, b = b, seed = 1), "from",
                                                "to", "ridge", 0.25, 0.4, 9)))
  }
  expect_gt(contrast(2), contrast(0.5))
})

test_that("a radius in another unit than the mesh is no determined curve, and is said by name", {
  ridge <- bent_ridge()
  in_other <- function(factor, radius, width) {
    other <- specimen(ridge$mesh, ridge$landmarks, id = "other", outward = "keep",
                      rescale = factor)
    ridge_curve(other, "a", "b", "ridge", radius = radius, width = width, n = 9)
  }
  expect_warning(wrong <- in_other(0.1, 2.6, 5), "as of another unit than the mesh",
                 class = "crestline_undetermined")
  expect_false(wrong$determined)
  right <- expect_no_warning(in_other(0.1, 0.4, 0.9))
  expect_true(right$determined)
  # Paths say it too, before anything is traced.
  small <- specimen(ridge$mesh, ridge$landmarks, id = "small", outward = "keep", rescale = 0.1)
  expect_warning(reference_path(small, "a", "b", "ridge", radius = 2.6),
                 class = "crestline_wide_radius")
  expect_no_warning(reference_path(small, "a", "b", "ridge", radius = 0.4))
  expect_warning(snap(small, "a", "ridge", radius = 0.4, reach = 4), "`reach` is 4",
                 class = "crestline_wide_radius")
})

test_that("a curve much longer than its ends are apart is not determined", {
  expect_warning(curve <- of_bent(settings = ridge_settings(detour = 1)),
                 "times as long as its ends are apart, more than 1",
                 class = "crestline_undetermined")
  expect_false(curve$determined)
  expect_true(of_bent()$determined)
})

test_that("a hole in the window of a curve along its edge is named; print keeps to 80 columns", {
  u <- c(-13.3, 13.6)
  winding <- graph_specimen(quote(6 * exp(-(v - 3 * sin(u / 4))^2 / 50)),
                            two_ends(u, 3 * sin(u / 4)))
  # A triangle beside the middle of the straight line between the ends is missing
  mesh <- winding$mesh
  off <- sweep(Reduce(`+`, face_corners(mesh)) / 3, 2, colMeans(winding$landmarks))
  gone <- which.min(row_lengths(cbind(off[, 1:2], 0)))
  mesh$it <- mesh$it[, -gone]
  holed <- specimen(mesh, winding$landmarks, id = "graph", outward = "keep")
  expect_warning(curve <- curve_of(holed, "a", "b", "ridge", radius = 4, width = 1, n = 9,
                                   settings = ridge_settings(lambda = 1e-7)),
                 "Fill the hole", class = "crestline_undetermined")
  expect_match(curve$reason, "edge of the window, in which there is a hole or border")
  expect_lte(max(nchar(utils::capture.output(print(curve)))), 80)
})
