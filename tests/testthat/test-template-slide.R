cases <- lapply(1:30, random_slide)
paper_cases <- lapply(1:10, random_slide,
                      settings = slide_settings("paper", tolerance = 1e-8, sweeps = 20000))

test_that("points of random wiggly curves keep their order and never coincide", {
  for (case in c(cases, paper_cases)) {
    gap <- pmin(diff(case$s), case$settings$gap * case$rest)
    expect_true(all(diff(case$slid$after) >= gap * (1 - 1e-9)))
    expect_gt(min(diff(case$slid$after)), 0)
  }
})

test_that("the sum never rises, and the trace ends with the energy of the answer", {
  for (case in c(cases, paper_cases)) {
    total <- case$slid$trace$energy + case$slid$trace$strain
    expect_lte(max(diff(total)), 1e-12 * total[1])
    expect_equal(total[1], slide_sum(case, case$x, case$s))
    expect_equal(total[length(total)], slide_sum(case, case$slid$x, case$slid$after))
    expect_true(case$slid$trace$converged)
  }
})

test_that("points stay on their path; ends and landmarks stay where they are", {
  for (case in cases) {
    at <- seq_len(case$n)
    expect_lte(max(abs(case$slid$x[at, ] - along_track(case$track, case$slid$after))),
               tolerances$rounding)
    expect_identical(case$slid$x[-(2:(case$n - 1)), ], case$x[-(2:(case$n - 1)), ])
  }
})

test_that("no point does better on a fine grid between its neighbours", {
  for (case in c(cases[1:10], paper_cases)) {
    best <- slide_sum(case, case$slid$x, case$slid$after)
    for (j in c(2, case$n %/% 2, case$n - 1)) {
      gap <- case$settings$gap * case$rest
      low <- min(case$slid$after[j], case$slid$after[j - 1] + gap)
      high <- max(case$slid$after[j], case$slid$after[j + 1] - gap)
      tried <- vapply(seq(low, high, length.out = 301), function(s) {
        moved <- replace(case$slid$after, j, s)
        x <- case$slid$x
        x[j, ] <- along_track(case$track, s)
        slide_sum(case, x, moved)
      }, 0)
      expect_gte(min(tried), best * (1 - 1e-8))
    }
  }
})

test_that("one point in the middle of a straight line goes to the closed form", {
  track <- cbind(0:10, 0:10, 0, 0, face = 1)
  b <- diag(3)
  x <- cbind(c(0, 7, 10), 0, 0)
  goes_to <- function(strain, gap = 0.1, s = 7) {
    x[2, 1] <- s
    rows <- slider_rows(c(0, s, 10), c(FALSE, TRUE, FALSE), 5, 10,
                        list(gap = gap, tolerance = 1e-9))
    cpp_slide_on_tracks(b, x, list(track), rows, strain, 10)$s
  }
  # Energy s^2 + strain ((s - 5)^2 + (5 - s)^2): least at 10 strain / (1 + 2 strain), and not below
  # the gap.
  expect_equal(goes_to(2), 20 / 5)
  expect_equal(goes_to(0), 0.5)
  expect_equal(goes_to(0, gap = 0), 0)
  expect_equal(goes_to(0, s = 0.2), 0.2)
})

test_that("holes are jumped, not stopped in", {
  track <- cbind(0:10, 0:10, 0, 0, face = c(1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1))
  rows <- slider_rows(c(0, 7, 10), c(FALSE, TRUE, FALSE), 5, 10, list(gap = 0, tolerance = 1e-9))
  aim <- function(at) {
    x <- cbind(c(0, 7, 10), 0, 0)
    # Least of (s - at)^2, by a third point with whom it has a bond.
    b <- rbind(c(1, 0, 0), c(0, 1, -at / 10), c(0, -at / 10, 1))
    cpp_slide_on_tracks(b, x, list(track), rows, 0, 10)$s
  }
  expect_equal(aim(1.5), 1.5)
  expect_equal(aim(3.9), 4)
  expect_equal(aim(2.7), 2)
})

test_that("a slid shape is on its mesh, keeps what it shares, its landmarks and its ends", {
  shape <- paired_shape(c(1.2, 1, 1.1))
  slid <- slide(shape, symmetrise(paired_shape()), slide_settings(curves = "held"))
  expect_on_mesh(slid$points, shape$specimen$mesh)
  first <- match(shape$scheme$points$place, shape$scheme$points$place)
  at <- unname(as.matrix(slid$points[c("x", "y", "z", "face", "w1", "w2", "w3")]))
  expect_identical(at, at[first, ])
  held <- grepl("^landmarks", shape$scheme$points$place)
  expect_identical(slid$points[held, ], shape$points[held, ])
  moved <- sqrt(rowSums((coords(slid, "curves") - coords(shape, "curves"))^2))
  expect_gt(max(moved), 0.05)
  for (name in names(shape$paths)) {
    own <- slid$points$part == name & slid$points$level == "curves"
    expect_lte(max(distance_from_line(xyz_of(slid$points[own, ]), xyz_of(shape$paths[[name]]))),
               1e-10)
  }
  expect_true(all(slid$sliding$converged))
  expect_true(all(slid$sliding$energy_after <= slid$sliding$energy_before +
                  slid$trace[[1]]$strain[1]))
  expect_setequal(names(slid$trace), slid$sliding$part)
})

test_that("sliding a slid shape moves nothing; a shape against itself neither", {
  template <- symmetrise(paired_shape())
  slid <- slide(paired_shape(c(1.2, 1, 1.1)), template)
  again <- slide(slid, template)
  expect_equal(coords(again, "curves"), coords(slid, "curves"), tolerance = 1e-5)
  expect_equal(coords(again, "surface"), coords(slid, "surface"), tolerance = 1e-4)
})

test_that("unit and pose change nothing", {
  turn <- qr.Q(qr(with_seed(3, matrix(stats::rnorm(9), 3))))
  turn <- turn * det(turn)
  template <- symmetrise(paired_shape())
  shape <- paired_shape(c(1.2, 1, 1.1))
  mesh <- shape$specimen$mesh
  mesh$vb[1:3, ] <- t(0.001 * t(mesh$vb[1:3, ]) %*% turn)
  landmarks <- 0.001 * shape$specimen$landmarks %*% turn
  rownames(landmarks) <- rownames(shape$specimen$landmarks)
  moved <- specimen(mesh, landmarks, id = "moved", outward = "keep")
  other <- fit_shape(moved, paired_scheme(), progress = FALSE)
  small <- template
  small$points[c("x", "y", "z")] <- 0.001 * as.matrix(small$points[c("x", "y", "z")])
  a <- slide(shape, template)
  b <- slide(other, small)
  for (level in c("curves", "surface")) {
    expect_equal(unname(coords(b, level)), unname(0.001 * coords(a, level) %*% turn),
                 tolerance = 1e-4)
  }
})

test_that("missing points stay missing and cost nothing else", {
  corners <- paired_corners()
  corners["highL", ] <- NA
  shape <- paired_shape(c(1.2, 1, 1.1), landmarks = corners)
  slid <- slide(shape, symmetrise(paired_shape()))
  expect_identical(is.na(slid$points$x), is.na(shape$points$x))
  expect_true("side right" %in% slid$sliding$part && !"side left" %in% slid$sliding$part)
  partial <- symmetrise(paired_shape())
  partial$points[partial$points$part == "middle", c("x", "y", "z")] <- NA
  whole <- paired_shape(c(1.2, 1, 1.1))
  expect_false("middle" %in% slide(whole, partial)$sliding$part)
  expect_identical(coords(slide(whole, partial), "curves")["middle 3", ],
                   coords(whole, "curves")["middle 3", ])
})

test_that("a cut end slides along the whole curve, or stays", {
  cut <- paired_scheme(function(tables) {
    tables$curves[1:2, "cut_share"] <- 0.5
    tables$curves[1:2, c("cut_from", "cut_to")] <- rep(c("lowL", "lowR"), each = 2)
    tables
  })
  shape <- paired_shape(c(1.2, 1, 1.1), scheme = cut)
  template <- symmetrise(paired_shape(scheme = cut))
  slid <- slide(shape, template, slide_settings(curves = "held"))
  start <- function(x) unname(coords(x, "curves")["side left 1", ])
  expect_gt(sqrt(sum((start(slid) - start(shape))^2)), 0.01)
  expect_on_mesh(slid$points, shape$specimen$mesh)
  expect_equal(unname(xyz_of(slid$paths[["side left"]])[1, ]), start(slid))
  expect_equal(status_of(slid, "side left")$length, attr(slid$paths[["side left"]], "length"))
  stays <- slide(shape, template, slide_settings(cut_ends = "stay"))
  expect_identical(start(stays), start(shape))
})

test_that("standard errors go along", {
  shape <- paired_shape()
  own <- shape$points$level == "curves" & shape$points$part == "side left"
  shape$points$se[own] <- 1:7
  slid <- slide(shape, symmetrise(paired_shape(c(1, 1.3, 1))))
  track <- function(x) x$tracks[["side left"]]$s
  expect_equal(slid$points$se[own][2:6], stats::approx(track(shape), 1:7, track(slid)[2:6])$y)
})

test_that("all settings run, and none moves a point off the mesh", {
  shape <- paired_shape(c(1.2, 1, 1.1))
  template <- symmetrise(paired_shape())
  changes <- list(list("paper"), list(energy = "all"), list(curves = "held"),
                  list(curves = "held", surface = "between"),
                  list(curves = "held", surface_energy = "patch"),
                  list(curves = "held", surface = "transect"), list(floor = 0.1))
  for (change in changes) {
    slid <- slide(shape, template, do.call(slide_settings, change))
    expect_on_mesh(slid$points, shape$specimen$mesh)
    expect_false(anyNA(slid$points$x))
    last <- vapply(slid$trace, function(trace) max(diff(trace$energy + trace$strain)) <=
                               1e-10 * trace$energy[1] + 1e-12, NA)
    expect_true(all(last))
  }
})

test_that("what does not belong together is refused", {
  shape <- paired_shape()
  expect_crestline_error(slide(shape, quad_shape()), c("paired", "quad"))
  expect_crestline_error(slide(stretched_ball(), shape), "fit_shape()")
  expect_crestline_error(slide(shape, shape, list()), "slide_settings()")
  shape$specimen <- NULL
  expect_crestline_error(slide(shape, paired_shape()), "does not keep its specimen")
  expect_s3_class(slide(shape, paired_shape(), specimen = stretched_ball()), "shape")
})
