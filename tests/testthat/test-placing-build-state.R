built_begin <- function(scheme = NULL) {
  bare <- specimen(quad_specimen()$mesh, if (!is.null(scheme)) quad_specimen()$landmarks, id = "b")
  begin_build(bare, scheme, list(ridge = ridge_settings(error = FALSE), bridge = 0.2, threads = 1L,
                                 radius = 20, name = "quad"))
}
ball_point <- function(state, at) surface_points(state$specimen$mesh, matrix(at, 1))
joined <- function(state, chain, name, kind = "plane", n = 7, ...) {
  for (mark in chain) state <- pick_mark(state, mark)
  join_curve(state, utils::modifyList(list(curve = name, kind = kind, path = "plane",
                                           closed = FALSE, radius = 20, width = 20, n = n),
                                      list(...)))
}
with_corners <- function(state) {
  for (name in c("a", "b", "c", "d")) {
    state <- place_mark(state, name, ball_point(state, quad_corners()[name, ]))
  }
  state
}

test_that("landmarks, curves and a patch make the scheme that tables make", {
  state <- with_corners(built_begin())
  expect_equal(build_names(state), c("a", "b", "c", "d"))
  expect_null(build_scheme_of(state))
  state <- joined(state, c("a", "b"), "bottom")
  state <- joined(state, c("d", "c"), "", n = 9)
  expect_equal(state$curves$curve, c("bottom", "curve 1"))
  expect_length(state$chain, 0)
  expect_match(curve_words(state, "bottom"), "^bottom: plane, .* long$")
  state <- bound_patch(state, "mid", "bottom", "curve 1", 4)
  expect_equal(state$patches$columns, "1:7")
  expect_equal(state$patches$resample_b, 7)
  expect_equal(dim(state$surface$mid$points), c(28, 3))
  expect_false(anyNA(state$surface$mid$points))
  # What the page shows is what fit_shape() measures, and its triangles face outwards
  shape <- fit_shape(state$specimen, build_scheme_of(state), ridge_settings(error = FALSE))
  expect_equal(coords(shape, "surface"), state$surface$mid$points, ignore_attr = TRUE)
  expect_equal(nrow(surface_faults(shape, state$specimen)), 0)
  for (curve in state$curves$curve) {
    expect_equal(coords(shape, "curves", part = curve),
                 columns_of(state$fitting$fits[[curve]]$points, c("x", "y", "z")),
                 ignore_attr = TRUE)
  }
  folder <- tempfile()
  saved <- save_build(state, folder)
  expect_match(saved$said, "^Saved in ")
  back <- read_scheme(folder)
  expect_equal(as.data.frame(back, "curves")$curve, state$curves$curve)
  marks <- as.matrix(back$landmarks[c("x", "y", "z")])
  rownames(marks) <- back$landmarks$landmark
  again <- fit_shape(specimen(state$specimen$mesh, marks), back, ridge_settings(error = FALSE))
  expect_equal(again$points, shape$points, tolerance = 1e-12)
  unlink(folder, recursive = TRUE)
})

test_that("more than two landmarks make a route along the crest, and closed it returns", {
  # A ring: the crest of a torus is its outermost circle
  v <- expand.grid(a = seq_len(60) * pi / 30, b = seq_len(24) * pi / 12)
  ring <- rbind((30 + 8 * cos(v$b)) * cos(v$a), (30 + 8 * cos(v$b)) * sin(v$a), 12 * sin(v$b), 1)
  at <- function(i, j) (i - 1) %% 60 + 60 * ((j - 1) %% 24) + 1
  cell <- expand.grid(i = seq_len(60), j = seq_len(24))
  it <- with(cell, cbind(rbind(at(i, j), at(i + 1, j), at(i + 1, j + 1)),
                         rbind(at(i, j), at(i + 1, j + 1), at(i, j + 1))))
  state <- begin_build(specimen(structure(list(vb = ring, it = it), class = "mesh3d")), NULL,
                       list(ridge = ridge_settings(error = FALSE), bridge = 0.2, threads = 1L,
                            radius = 6, name = "ring"))
  top <- function(angle) ball_point(state, 30 * c(cos(angle), sin(angle), 0) + c(0, 0, 12))
  for (i in 1:3) state <- place_mark(state, paste0("m", i), top(2 * i))
  open <- joined(state, c("m1", "m2", "m3"), "part", "ridge", n = 20, radius = 6, width = 9)
  expect_equal(unlist(open$curves[c("from", "to", "via", "path")]),
               c(from = "m1", to = "m3", via = "m2", path = "crest"))
  loop <- joined(state, c("m1", "m2", "m3"), "loop", "ridge", n = 20, radius = 6, width = 9,
                 closed = TRUE)
  expect_equal(unlist(loop$curves[c("from", "to", "via")]),
               c(from = "m1", to = "m1", via = "m2 m3"))
  expect_match(loop$said, "^loop: ridge")
  points <- loop$fitting$fits$loop$points
  expect_equal(loop$fitting$fits$loop$length, 2 * pi * 30, tolerance = 0.02)
  expect_lt(max(abs(sqrt(points$x^2 + points$y^2) - 30)), 1)
  # Any of its landmarks leads to it: moved, it is fitted again
  moved <- place_mark(loop, "m3", top(6.1))
  expect_equal(moved$fitting$refitted, "loop")
  expect_match(try_build(loop, function(s) remove_mark(s, "m2"))$said, "on the curve loop")
  expect_equal(rename_mark(loop, "m2", "new")$curves$via, "new m3")
  expect_match(try_build(state, function(s) joined(s, c("m1", "m2", "m3"), "x"))$said,
               "two landmarks only")
})

test_that("only what a change touches is fitted again; every step can be taken back", {
  state <- with_corners(built_begin())
  one <- joined(state, c("a", "b"), "bottom")
  two <- joined(one, c("d", "c"), "top")
  expect_equal(two$fitting$refitted, "top")
  moved <- place_mark(two, "c", ball_point(two, quad_corners()["c", ] + c(3, 2, 0)))
  expect_equal(moved$fitting$refitted, "top")
  expect_identical(moved$fitting$fits$bottom, two$fitting$fits$bottom)
  again <- joined(moved, character(), "bottom", n = 5)
  expect_equal(again$fitting$refitted, "bottom")
  expect_equal(again$curves$n, c(5, 7))
  back <- undo_build(undo_build(again))
  expect_identical(back$curves, two$curves)
  expect_identical(back$specimen$landmarks, two$specimen$landmarks)
  for (step in seq_along(again$history)) again <- undo_build(again)
  expect_length(build_names(again), 0)
  expect_match(undo_build(again)$said, "nothing to undo")
})

test_that("names go through all tables; what is in use is not removed", {
  state <- joined(with_corners(built_begin()), c("a", "b"), "bottom")
  state <- joined(state, c("d", "c"), "top")
  state <- rename_mark(state, "a", "corner")
  expect_equal(state$curves$from, c("corner", "d"))
  expect_true("corner" %in% rownames(state$specimen$geometry$landmarks))
  expect_match(try_build(state, function(s) rename_mark(s, "corner", "b"))$said, "There is a landm")
  expect_match(try_build(state, function(s) rename_mark(s, "corner", "two words"))$said, "blank")
  expect_match(try_build(state, function(s) remove_mark(s, "b"))$said, "is on the curve bottom")
  state <- bound_patch(state, "", "bottom", "top", 3)
  expect_equal(state$patches$patch, "patch 1")
  expect_match(try_build(state, function(s) remove_curve(s, "top"))$said, "bounds the patch pat")
  state <- remove_curve(remove_patch(state, "patch 1"), "top")
  expect_equal(state$curves$curve, "bottom")
  state <- remove_mark(state, "d")
  expect_false("d" %in% c(build_names(state), rownames(state$specimen$geometry$landmarks)))
  expect_match(try_build(state, function(s) bound_patch(s, "", "bottom", "bottom", 3))$said,
               "two different")
  expect_match(try_build(state, function(s) joined(s, "b", "x"))$said, "Fewer than two")
  expect_match(try_build(state, function(s) save_build(s, ""))$said, "no folder")
  expect_match(try_build(built_begin(), function(s) save_build(s, tempfile()))$said, "no curve")
  expect_match(try_build(state, function(s) joined(s, c("b", "c"), "x", "ridge", radius = NA))$said,
               "radius")
})

test_that("a scheme goes on where it was, with its words; suggestions come and go", {
  scheme <- quad_scheme()
  state <- built_begin(scheme)
  expect_setequal(names(Filter(function(fit) !is.null(fit$path), state$fitting$fits)),
                  scheme$curves$curve)
  expect_equal(state$curves, scheme$curves)
  shown <- suggest_marks(state)
  expect_s3_class(shown$suggested, "suggested_landmarks")
  expect_null(suggest_marks(shown)$suggested)
  pairless <- try_build(state, propose_pairs)
  expect_match(pairless$said, "^(Pairs|No plane)")
})

test_that("a landmark snaps to a cap within the radius, or stays and says so", {
  ball <- ball_mesh(4)
  ball$vb[1:3, ] <- ball$vb[1:3, ] * c(50, 30, 25)
  state <- begin_build(specimen(structure(ball[c("vb", "it")], class = "mesh3d")), NULL,
                       list(ridge = ridge_settings(), bridge = 0.2, threads = 1L, radius = 12,
                            name = "egg"))
  near <- place_mark(state, "tip", ball_point(state, c(48, 8, 2)), "cap")
  expect_equal(near$specimen$landmarks["tip", ], c(x = 50, y = 0, z = 0), tolerance = 5e-3)
  far <- place_mark(state, "side", ball_point(state, c(0, 30, 0)), "cap")
  expect_match(far$said, "no cap within 12 of side")
  expect_equal(far$specimen$landmarks["side", ], c(x = 0, y = 30, z = 0), tolerance = 1e-2)
})
