# A ridge that is known, with a scheme of one curve along it.
ridge_review <- function(kind = "ridge") {
  surface <- simulate_ridge(a = 0.25, b = 2, noise = 0, seed = 1)
  scheme <- curve_scheme(data.frame(landmark = c("from", "to")),
                         data.frame(curve = "crest", from = "from", to = "to", kind = kind,
                                    radius = 0.25, width = 0.5, n = 21), name = "one")
  review <- begin_review(surface, scheme, 0.5, ridge_settings(error = FALSE), 0.2, 1, "AB")
  choose_curve(review, "crest")
}

# Clicks at places of the plane below a surface, one after the other.
click_along <- function(review, x, y) {
  for (i in seq_along(x)) {
    ray <- mesh_on_ray(review$specimen$mesh, c(x[i], y[i], 9), c(x[i], y[i], -9))
    review <- add_knot(review, ray)
  }
  review
}

off_truth <- function(xyz, surface) {
  truth <- attr(surface, "truth")
  apply(xyz, 1, function(at) min(sqrt(colSums((t(truth) - at)^2))))
}

test_that("a line goes through its knots from landmark to landmark, on the surface", {
  review <- click_along(ridge_review(), c(0.2, 0.1), c(-0.4, 0.4))
  line <- review$drawn$crest
  path <- line$path
  expect_on_mesh(path, review$specimen$mesh)
  ends <- review$specimen$landmarks
  expect_equal(unlist(path[1, c("x", "y", "z")]), ends["from", ], tolerance = 1e-5)
  expect_equal(unlist(path[nrow(path), c("x", "y", "z")]), ends["to", ], tolerance = 1e-5)
  for (i in 1:2) {
    away <- sweep(as.matrix(path[c("x", "y", "z")]), 2, line$knots[i, 1:3])
    expect_lt(min(row_lengths(away)), 1e-4)
  }
  expect_gte(attr(path, "length"), sum(row_lengths(diff(rbind(ends["from", ], line$knots[, 1:3],
                                                              ends["to", ])))) - 1e-9)
  expect_equal(review$log$action, c("point set", "point set"))
  expect_equal(unique(review$log$by), "AB")
})

test_that("knots may come in any order", {
  y <- c(-0.6, -0.2, 0.2, 0.6)
  lengths <- vapply(list(1:4, 4:1, c(2, 4, 1, 3)), function(order) {
    review <- click_along(ridge_review(), rep(0.1, 4)[order], y[order])
    expect_equal(unname(review$drawn$crest$knots[, 2]), y, tolerance = 1e-9)
    attr(review$drawn$crest$path, "length")
  }, 0)
  expect_equal(lengths, rep(lengths[1], 3), tolerance = 1e-12)
  expect_equal(knot_place(NULL, 1:3, FALSE, c(FALSE, FALSE)), 0)
  line <- cbind(1:3, 0, 0)
  expect_equal(knot_place(line, c(4, 0, 0), FALSE, c(FALSE, FALSE)), 3)
  expect_equal(knot_place(line, c(0, 0, 0), FALSE, c(FALSE, FALSE)), 0)
  expect_equal(knot_place(line, c(4, 0, 0), FALSE, c(TRUE, TRUE)), 2)
  square <- rbind(c(0, 0, 0), c(2, 0, 0), c(2, 2, 0), c(0, 2, 0))
  expect_equal(knot_place(square, c(0, 1, 0), TRUE, c(FALSE, FALSE)), 4)
})

test_that("snapped to the ridge a line lies on the known ridge, beside which it was drawn", {
  review <- click_along(ridge_review(), c(-0.1, 0.15, 0.12, 0.25), c(-0.6, -0.2, 0.2, 0.6))
  drawn <- drawn_points(review)$crest
  expect_gt(max(off_truth(drawn, review$specimen)), 0.1)
  after <- snap_line(review)
  snapped <- drawn_points(after)$crest
  expect_lt(max(off_truth(snapped, review$specimen)), 0.01)
  expect_true(after$drawn$crest$snapped)
  expect_match(after$said, "snapped to the ridge")
  expect_match(line_words("crest", replace(after$drawn$crest, "kind", "valley")),
               "snapped to the valley")
  expect_match(attr(snapped, "drawn"), "^drawn by hand, snapped \\(AB, 20")
  expect_on_mesh(after$drawn$crest$path, review$specimen$mesh)
  expect_identical(undo_review(after)$drawn, review$drawn)
  expect_identical(redo_review(undo_review(after))$drawn, after$drawn)
})

test_that("a drawn line goes into fit_shape() as it is, which says who drew it", {
  review <- snap_line(click_along(ridge_review(), c(0.1, 0.1), c(-0.4, 0.4)))
  one <- reviewed_specimen(review)
  shape <- fit_shape(one, review$fitting$scheme, progress = FALSE)
  expect_match(shape$status$reason[shape$status$part == "crest"], "^drawn by hand, snapped \\(AB")
  expect_equal(unname(coords(shape, "curves")), unname(one$drawn$crest[, 1:3]), tolerance = 1e-9)
  found <- fit_shape(one, review$fitting$scheme, ridge_settings(error = FALSE), curves = list(),
                     progress = FALSE)
  expect_true(is.na(found$status$reason[found$status$part == "crest"]))
  file <- tempfile(fileext = ".csv")
  write_landmarks(one, file)
  expect_equal(unname(read_curves(file)$crest[, 1:3]), unname(one$drawn$crest[, 1:3]),
               tolerance = 1e-12)
  again <- with_drawn(begin_review(one, review$fitting$scheme, 0.5, ridge_settings(), 0.2, 1))
  expect_equal(drawn_points(again)$crest[, 1:3], one$drawn$crest[, 1:3], tolerance = 1e-3)
})

test_that("points of a line are moved and removed, a landmark takes its end along", {
  review <- click_along(ridge_review(), c(0.1, 0.1), c(-0.4, 0.4))
  to <- surface_points(review$specimen$mesh, matrix(c(-0.2, 0.4, 0), 1))
  moved <- move_knot(review, 2, to)
  expect_equal(unname(moved$drawn$crest$knots[2, 1:3]), unname(unlist(to[1:3])))
  expect_equal(nrow(move_knot(review, 1, NULL)$drawn$crest$knots), 1)
  expect_identical(move_knot(review, 9, to), review)
  none <- move_knot(move_knot(review, 1, NULL), 1, NULL)
  expect_length(none$drawn, 0)
  expect_equal(utils::tail(none$log$action, 1), "erased")
  end <- surface_points(review$specimen$mesh, matrix(c(0, 0.8, 0), 1))
  after <- place_selected(select_landmark(snap_line(review), "to"), end)
  path <- after$drawn$crest$path
  expect_equal(unname(unlist(path[nrow(path), 2:4])), unname(unlist(end[1:3])), tolerance = 1e-5)
  expect_true(after$drawn$crest$snapped)
})

test_that("what cannot be drawn or snapped is said", {
  review <- ridge_review("plane")
  expect_match(snap_line(review)$said, "click along it")
  expect_match(erase_curve(review)$said, "drawn curve first")
  after <- click_along(review, 0.1, 0)
  expect_match(snap_line(after)$said, "plane cut by its scheme")
  expect_identical(snap_line(after)$drawn, after$drawn)
  expect_equal(choose_curve(review, "crest")$pen, character())
  expect_identical(choose_curve(review, "none")$pen, "crest")
})

test_that("a snapped line that went far, got a kink, or has no clear ridge is doubted", {
  path_of <- function(y) {
    x <- seq(0, 20, length.out = length(y))
    data.frame(x = x, y = y, z = 0, face = 1, w1 = 1, w2 = 0, w3 = 0)
  }
  drawn <- path_of(rep(0, 41))
  curve <- function(y, determined = TRUE, reason = NA) {
    list(path = path_of(y), determined = determined, reason = reason)
  }
  expect_identical(snap_doubt(curve(rep(0.5, 41)), drawn, 5), NA_character_)
  expect_match(snap_doubt(curve(rep(3, 41)), drawn, 5), "it went 3 from where it was drawn")
  # A hook at the corner: down and back
  hook <- snap_doubt(curve(c(rep(0, 20), -2.4, rep(0, 20))), drawn, 1)
  expect_match(hook, "kink of 1[0-9][0-9] degrees")
  # A line that turns back upon itself
  back <- list(path = path_of(rep(0, 41)), determined = TRUE, reason = NA)
  back$path$x <- c(seq(0, 10, 0.5), seq(9.5, 0, -0.5))
  expect_match(snap_doubt(back, drawn, 1), "kink of 180 degrees")
  # A kink that was drawn is not one of the snap
  expect_no_match(snap_doubt(curve(c(rep(0, 20), -2.4, rep(0, 20))),
                             path_of(c(rep(0, 20), -2.4, rep(0, 20))), 1), "kink")
  expect_match(snap_doubt(curve(rep(0, 41), FALSE, "it runs along the edge of the window"), drawn,
                          5), "edge of the window")
})
