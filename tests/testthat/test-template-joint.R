shapes <- paired_sample()
sample <- homologise(shapes, progress = FALSE)

# A shape whose middle line counts as a ridge of some standard error.
ridged_scheme <- function() paired_scheme(function(tables) {
  tables$curves$kind[tables$curves$curve == "middle"] <- "ridge"
  tables$curves$radius <- 5
  tables$curves$width <- 10
  tables
})

random_points <- function(n, seed) with_seed(seed, matrix(stats::rnorm(3 * n), n))

smooth_kernel <- function(r) (1 + r) * exp(-r) - 0.5 * r

test_that("an energy without points is that of the others, least over where these could be", {
  xyz <- random_points(30, 1)
  nugget <- rep(c(0.1, 2), 15)
  whole <- energy_matrix(xyz, nugget, 1e-6, smooth_kernel)
  keep <- c(3, 1, 10:30)
  own <- energy_matrix(xyz[keep, ], nugget[keep], 1e-6, smooth_kernel)
  expect_equal(energy_without(whole, keep), own, tolerance = 1e-9, ignore_attr = TRUE)
  x <- random_points(30, 2)
  gone <- setdiff(1:30, keep)
  best <- x
  best[gone, ] <- -solve(whole[gone, gone], whole[gone, keep] %*% x[keep, ])
  expect_equal(quadratic_form(whole, best), quadratic_form(own, x[keep, ]), tolerance = 1e-9)
})

test_that("an energy with more of a nugget is the one made with it", {
  xyz <- random_points(30, 3)
  less <- rep(0.05, 30)
  more <- replace(less, c(2, 7, 9), c(0.5, 10, 0.5))
  expect_equal(energy_loosened(energy_matrix(xyz, less, 1e-6, smooth_kernel), c(2, 7, 9),
                               (more - less)[c(2, 7, 9)]),
               energy_matrix(xyz, more, 1e-6, smooth_kernel), tolerance = 1e-9, ignore_attr = TRUE)
})

# One point on a flat sheet, bound to another of weight one, and a line along y at `line`.
drawn <- function(line, error, x = c(4, 4, 0), to = c(6, 5, 0), scale = 1, reach = 5,
                  relaxation = 1, ...) {
  sheet <- specimen(grid_mesh(13), rbind(a = c(1, 1, 0)), id = "sheet", outward = "keep")
  surface <- walkable(sheet)
  at <- as.matrix(surface_points(sheet$mesh, matrix(x, 1)))
  b <- rbind(c(1, -1), c(-1, 1))
  rows <- cbind(1, 0, 0, matrix(0, 1, 6), line, 0, 0, 1, 0, 0, error)
  settings <- utils::modifyList(list(scale = scale, reach = reach, relaxation = relaxation,
                                     gap = 0.1, tolerance = 1e-10, halvings = 4,
                                     sweeps = 500), list(...))
  cpp_slide_jointly(surface$vb, surface$it, surface$twin, b, rbind(at[, 1:3], to), rows,
                    at[, 4:7, drop = FALSE], settings)
}

test_that("a point between its bond and its line goes to the closed form", {
  # Without a reach: (x - 6)^2 + (x - 3)^2 / error^2, least at (6 + 3 / error^2) / (1 + 1 /
  # error^2).
  for (relaxation in c(1, 1.3)) for (error in c(0.5, 1, 2)) {
    found <- drawn(3, error, reach = 1e6, relaxation = relaxation)
    expect_equal(found$points[1, 1:3], c((6 + 3 / error^2) / (1 + 1 / error^2), 5, 0),
                 tolerance = 1e-6)
    expect_true(found$trace$converged)
  }
  expect_equal(drawn(NA, NA)$points[1, 1:3], c(6, 5, 0), tolerance = 1e-9)
})

test_that("a line that is far off lets go, one that is near draws", {
  expect_equal(drawn(3, 0.1, x = c(5, 4, 0))$points[1, 1:3], c(6, 5, 0), tolerance = 1e-9)
  near <- drawn(3, 0.1, x = c(3.1, 4, 0))$points[1, 1:2]
  expect_equal(near[2], 5, tolerance = 1e-6)
  # The derivative of the sum vanishes there: 2 (x - 6) + 2 w(u) (x - 3) / error^2.
  u <- (near[1] - 3) / 0.1
  expect_lt(u, 5)
  expect_equal((near[1] - 6) + (1 - (u / 5)^2)^2 * u / 0.1, 0, tolerance = 1e-4)
})

test_that("the sum never rises, whatever the relaxation", {
  for (relaxation in c(0.5, 1, 1.3, 1.9)) {
    trace <- drawn(3, 0.7, relaxation = relaxation)$trace
    expect_lte(max(diff(trace$energy + trace$strain)), 1e-12)
  }
  for (shape in sample$shapes) {
    total <- shape$trace$joint$energy + shape$trace$joint$strain
    expect_lte(max(diff(total)), 1e-10 * total[1])
  }
})

test_that("no point passes its neighbour, however it is drawn", {
  sheet <- specimen(grid_mesh(13), rbind(a = c(1, 1, 0)), id = "sheet", outward = "keep")
  surface <- walkable(sheet)
  line <- cbind(c(2, 4, 6), 5, 0)
  at <- as.matrix(surface_points(sheet$mesh, line))
  # The first wants to 9, the last to 1.
  b <- diag(5) * 2
  b[1, 4] <- b[4, 1] <- b[3, 5] <- b[5, 3] <- -2
  rows <- cbind(1:3, c(0, 1, 2), c(2, 3, 0), rbind(0, cbind(c(0.5, 0.5), 0, 0)),
                rbind(cbind(c(0.5, 0.5), 0, 0), 0), matrix(0, 3, 6), NA)
  settings <- list(scale = 1, reach = 5, relaxation = 1.3, gap = 0.1, tolerance = 1e-9,
                   halvings = 10, sweeps = 200)
  x <- rbind(line, c(9, 5, 0), c(1, 5, 0))
  slid <- cpp_slide_jointly(surface$vb, surface$it, surface$twin, b, x, rows, at[, 4:7],
                            settings)$points
  expect_true(all(diff(slid[, 1]) >= 0.2 * (1 - 1e-9)))
})

test_that("free points are on the mesh, landmarks stay, offsets say how far off their curves", {
  for (i in seq_along(shapes)) {
    shape <- sample$shapes[[i]]
    expect_on_mesh(shape$points, shapes[[i]]$specimen$mesh)
    expect_identical(coords(shape, "landmarks"), coords(shapes[[i]], "landmarks"))
    expect_identical(shape$paths,
                     slide(shapes[[i]], sample$template, slide_settings(curves = "held"))$paths)
    expect_identical(is.na(shape$points$offset), shape$points$level != "curves" |
                                                 grepl("^landmarks", shape$scheme$points$place))
    own <- shape$points$level == "curves" & shape$points$part == "middle"
    off <- distance_from_line(xyz_of(shape$points[own, ]), xyz_of(shape$paths$middle))
    expect_lte(max(abs(abs(shape$points$offset[own]) - off), na.rm = TRUE), 0.2 * max(off) + 0.02)
    rms <- shape$checks$offset[shape$checks$part == "middle" & shape$checks$level == "curves"]
    expect_equal(rms * slide_plan(sample$template, slide_settings())$radius,
                 sqrt(mean(shape$points$offset[own]^2, na.rm = TRUE)))
  }
  expect_null(slide(shapes[[1]], sample$template, slide_settings(curves = "held"))$points$offset)
})

test_that("a shape slid again, and a new one against the saved sample, come to the same points", {
  file <- tempfile(fileext = ".rds")
  on.exit(unlink(file))
  saveRDS(sample, file)
  kept <- readRDS(file)
  for (i in seq_along(shapes)) {
    expect_identical(slide(shapes[[i]], kept)$points, sample$shapes[[i]]$points)
    again <- slide(sample$shapes[[i]], kept, specimen = shapes[[i]]$specimen)
    expect_equal(again$points[c("x", "y", "z")], sample$shapes[[i]]$points[c("x", "y", "z")],
                 tolerance = 1e-4)
  }
  held <- homologise(shapes, settings = slide_settings(curves = "held"), progress = FALSE)
  expect_identical(slide(shapes[[1]], held)$points, held$shapes[[1]]$points)
  new <- homologise(shapes[1:3], progress = FALSE)
  off <- coords(slide(shapes[[4]], new), "surface") - coords(sample$shapes[[4]], "surface")
  expect_lte(sqrt(mean(off^2)), 0.5)
})

test_that("the order of specimens changes nothing", {
  other <- homologise(rev(shapes), template = sample, rounds = 0, progress = FALSE)
  for (id in names(sample)) expect_identical(other[[id]]$points, sample[[id]]$points)
})

test_that("a half, and one without landmarks of cut ends, come to where the whole has its points", {
  whole <- sample$shapes$ball2
  for (gone in list(c("lowL", "highL"), "highR")) {
    corners <- paired_corners()
    corners[gone, ] <- NA
    part <- paired_shape(c(1.2, 1, 1.1), "part", landmarks = corners)
    slid <- slide(part, sample)
    there <- !is.na(part$points$x)
    expect_identical(!is.na(slid$points$x), there)
    expect_true(all(slid$sliding$converged))
    off <- row_lengths(xyz_of(slid$points) - xyz_of(whole$points))[there]
    plain <- row_lengths(xyz_of(part$points) - xyz_of(whole$points))[there]
    expect_lte(sqrt(mean(off^2)), 0.5)
    expect_lte(sqrt(mean(off^2)), sqrt(mean(plain^2)) / 2)
  }
})

test_that("the stronger the curves' pull, the nearer points stay to them", {
  ridged <- lapply(shapes, function(shape) {
    shape$scheme <- ridged_scheme()
    shape$points$se[shape$points$level == "curves" & shape$points$part == "middle"] <- 0.3
    shape
  })
  off <- vapply(c(0, 4, 100), function(pull) {
    slid <- homologise(ridged, settings = slide_settings(pull = pull), progress = FALSE)
    middle <- slid[[2]]$checks$level == "curves" & slid[[2]]$checks$part == "middle"
    slid[[2]]$checks$offset[middle]
  }, 0)
  expect_true(all(diff(off) < 0))
})

test_that("the energy's scale is a variance about the sample's own mean", {
  starts <- list(list(energy = 1), list(energy = 2), list(energy = 6))
  expect_equal(energy_scale(starts, own_mean = TRUE), 9 / 2)
  expect_equal(energy_scale(starts), 3)
  expect_equal(energy_scale(starts[3], own_mean = TRUE), 6)
})

test_that("landmarks count by how they came", {
  shape <- shapes[[1]]
  names <- rownames(paired_corners())
  expect_equal(unname(landmark_nuggets(shape, slide_settings())), rep(0.1, 6))
  shape$placing <- data.frame(landmark = names,
                              state = c("found", "found", "predicted", "placed", "absent", "found"),
                              confidence = c(0.9, 0.1, NA, NA, NA, 0.8))
  expect_equal(unname(landmark_nuggets(shape, slide_settings())), c(1, 20, 20, 0.1, 0.1, 1))
})

test_that("a curve that runs along another feature is let go of, and named by quality()", {
  scheme <- ridged_scheme()
  plain <- paired_sample()
  ridged <- lapply(plain, function(shape) {
    shape$scheme <- scheme
    own <- shape$points$level == "curves" & shape$points$part == "middle"
    shape$points$se[own] <- 0.3
    shape
  })
  good <- homologise(ridged, progress = FALSE)
  # Its middle line again, drawn 8 mm aside between its ends.
  wrong <- ridged
  path <- coords(plain[[2]], "curves")[paste("middle", 1:7), ]
  aside <- path + cbind(8 * sin(seq(0, pi, length.out = 7)), 0, 0)
  bowed <- fit_shape(plain[[2]]$specimen, paired_scheme(), ridge_settings(error = FALSE),
                     curves = list(middle = aside), progress = FALSE)
  own <- bowed$points$level == "curves" & bowed$points$part == "middle"
  bowed$points$se[own] <- 0.3
  bowed$scheme <- scheme
  bowed$provenance$settings$fit$given <- NULL
  wrong[[2]] <- bowed
  found <- slide(bowed, good)
  off <-
    sqrt(rowSums((coords(found, "curves") - coords(good[[2]], "curves"))[paste("middle", 2:6), ]^2))
  expect_lte(max(off), 2)
  graded <- function(shape) {
    table <- as.data.frame(quality(shape))
    table[table$level == "curves" & table$part == "middle", ]
  }
  expect_gt(graded(found)$offset, 1 / 19)
  expect_match(graded(found)$why, "beside its homologous points")
  expect_lt(graded(good[[2]])$offset, 1 / 19)
  expect_no_match(paste(graded(good[[2]])$why), "beside")
  # A curve that is given is where its maker wants it.
  bowed$provenance$settings$fit$given <- "middle"
  given <- slide(bowed, good)
  expect_equal(given$points$offset[own][2:6], rep(0, 5))
})

test_that("what does not go together is refused", {
  expect_crestline_error(slide_settings(curves = "free", surface = "between"), c("held", "surface"))
  expect_crestline_error(slide_settings("paper", curves = "free"), "held")
  expect_crestline_error(slide_settings(relaxation = 2), "relaxation")
  expect_crestline_error(slide_settings(floor = -1), "floor")
  expect_crestline_error(slide_settings(pull = -1), "pull")
  bare <- lapply(shapes, function(shape) {
    shape$scheme <- ridged_scheme()
    shape
  })
  expect_crestline_error(homologise(bare, settings = slide_settings(floor = 0), progress = FALSE),
                         c("standard errors", "floor"))
})
