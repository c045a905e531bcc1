# Closed curves on the way from a shape to a sample.

closed_scheme <- function(via = "c b d", n = 16) {
  curve_scheme(data.frame(landmark = c("a", "b", "c", "d")),
               data.frame(curve = "rim", from = "a", to = "a", kind = "ridge",
                          radius = ring_radius, width = 4.5, n = n, via = via), name = "ring")
}
closed_shape <- function(angle = c(a = 20, b = 200, c = 110, d = 290), ...) {
  fit_shape(ring_specimen(angle, ...), closed_scheme(), progress = FALSE)
}

disc_scheme <- function() {
  tables <- unclass(closed_scheme())
  patches <- data.frame(patch = "disc", n = 7 * 5, columns = "2:8", rows = 5, rows_kept = "1:5",
                        curve_a = "rim[1:9]", curve_b = "rim[1]+rim[16:9]", outward = "columns")
  curve_scheme(tables$landmarks, tables$curves, patches, name = "disc")
}

test_that("a closed curve slides as a cycle: all its points, across the seam", {
  angle <- seq(0, 2 * pi, length.out = 721)
  track <- cbind(s = angle, x = cos(angle), y = sin(angle), z = 0, face = 1)
  at <- function(angle) cbind(cos(angle), sin(angle), 0)
  wanted <- (0:7) * pi / 4 - 0.3
  settings <- slide_settings()
  rows <- slider_rows((0:7) * pi / 4, rep(TRUE, 8), pi / 4, 2 * pi, settings, TRUE)
  # The energy is the sum of the squared distances from where the points are wanted.
  b <- rbind(cbind(diag(8), -diag(8)), cbind(-diag(8), diag(8)))
  slid <- cpp_slide_on_tracks(b, rbind(at((0:7) * pi / 4), at(wanted)),
                              list(unrolled_track(track)), rows, 0, 50)
  expect_equal(slid$s, wanted, tolerance = 1e-4)
  expect_lt(slid$s[1], 0)
  # With strain alone uneven points become even, those beside the seam too.
  uneven <- (0:7) * pi / 4 + c(0.3, 0, 0, 0, 0, 0, 0, -0.2)
  rows <- slider_rows(uneven, rep(TRUE, 8), pi / 4, 2 * pi, settings, TRUE)
  slid <- cpp_slide_on_tracks(0 * b, rbind(at(uneven), at(wanted)), list(unrolled_track(track)),
                              rows, 1, 2000)
  expect_equal(diff(slid$s), rep(pi / 4, 7), tolerance = 1e-3)
  expect_equal(slid$s[1] + 2 * pi - slid$s[8], pi / 4, tolerance = 1e-3)
})

test_that("shapes with closed curves slide and become a sample", {
  shapes <- lapply(1:3, function(i) {
    angle <- c(a = 20, b = 200, c = 110, d = 290) + c(0, 3, -4)[i] * c(0, 1, 1, -1)
    ring <- ring_specimen(angle, noise = 0.01 * i)
    ring <- specimen(ring$mesh, ring$landmarks, id = paste0("s", i), outward = "keep",
                     tolerance = 0.25)
    fit_shape(ring, disc_scheme(), progress = FALSE)
  })
  slid <- suppressWarnings(slide(shapes[[2]], shapes[[1]], slide_settings(curves = "held")))
  expect_true(all(slid$sliding$converged))
  expect_lte(mean(off_ring(as.data.frame(coords(slid)))), 0.2)
  expect_silent(check_tracks(slid, walkable(shapes[[2]]$specimen)))
  expect_false(anyDuplicated(round(slid$tracks$rim$s, 6)) > 0)
  free <- suppressWarnings(slide(shapes[[2]], shapes[[1]]))
  expect_lte(mean(off_ring(as.data.frame(coords(free)))), 0.5)
  across <- across_directions(shapes[[1]], slide_state(shapes[[1]], slide_settings())$store,
                              shapes[[1]]$specimen)
  rim <- across[grepl("rim", rownames(across)), ]
  expect_false(anyNA(rim))
  # Across a circle is along its radii, at the seam too.
  out <- coords(shapes[[1]])[, 1:2] / 12
  expect_equal(unname(abs(rowSums(rim[, 1:2] * out))), rep(1, 16), tolerance = 0.03)
})

test_that("parts of a closed curve lead across its seam", {
  shape <- closed_shape()
  scan <- walkable(shape$specimen)
  path <- shape$paths$rim
  length <- attr(path, "length")
  part <- part_of_path(scan, path, length - 5, length + 7)
  expect_path_on_mesh(part, shape$specimen$mesh)
  expect_equal(attr(part, "length"), 12)
  expect_equal(points_along(part, 5), points_along(path, 0))
  back <- part_of_path(scan, path, 3, -4)
  expect_equal(attr(back, "length"), 7)
  expect_equal(points_along(back, 0), points_along(path, 3))
  fit <- list(points = data.frame(s = (0:15) * length / 16), path = path)
  expect_equal(run_lengths(fit, c(15, 16, 1, 2)), c(14, 15, 16, 17) * length / 16)
  expect_equal(run_lengths(fit, c(2, 1, 16)), c(1, 0, -1) * length / 16)
})

test_that("a patch is bounded by both halves of a closed curve", {
  scheme <- disc_scheme()
  ring <- ring_specimen()
  shape <- fit_shape(ring, scheme, progress = FALSE)
  expect_true(all(shape$status$ok))
  points <- shape$points[shape$points$level == "surface", ]
  expect_true(all(sqrt(points$x^2 + points$y^2) <= 12.5))
  middle <- points[points$point == "4 3", ]
  expect_lte(sqrt(middle$x^2 + middle$y^2), 2)
  # Sides that are spaced anew lead along the curve, across its seam too.
  patches <- scheme$patches
  patches[c("n", "columns", "resample_a", "resample_b")] <- list(5 * 5, "2:6", 7, 7)
  coarse <- curve_scheme(scheme$landmarks, scheme$curves, patches, name = "disc")
  coarse <- fit_shape(ring, coarse, progress = FALSE)
  expect_true(all(coarse$status$ok))
  rim <- coarse$points[coarse$points$level == "surface" & grepl(" [15]$", coarse$points$point), ]
  expect_lte(mean(off_ring(rim)), 0.3)
})

test_that("closed curves go to Slicer and back", {
  shape <- closed_shape()
  file <- tempfile(fileext = ".mrk.json")
  on.exit(unlink(file))
  write_landmarks(shape, file)
  written <- paste(readLines(file), collapse = "")
  expect_match(written, "\"type\": \"ClosedCurve\", \"name\": \"rim\"")
  back <- read_curves(file)
  expect_true(attr(back$rim, "closed"))
  expect_equal(unname(back$rim[, ]), unname(coords(shape)), ignore_attr = TRUE)
  given <- fit_shape(shape$specimen, closed_scheme(), curves = back, progress = FALSE)
  expect_equal(coords(given), coords(shape), tolerance = 1e-6)
  # The other way round, begun elsewhere: the scheme's direction and start.
  turned <- list(rim = structure(back$rim[c(9:1, 16:10), ], closed = TRUE))
  given <- fit_shape(shape$specimen, closed_scheme(), curves = turned, progress = FALSE)
  expect_equal(coords(given), coords(shape), tolerance = 1e-6)
  dense <- list(rim = xyz_of(shape$paths$rim))
  given <- fit_shape(shape$specimen, closed_scheme(), curves = dense, progress = FALSE)
  expect_lte(max(abs(coords(given) - coords(shape))), 0.2)
  far <- list(rim = 3 * coords(shape))
  far <- fit_shape(shape$specimen, closed_scheme(), curves = far, progress = FALSE)
  expect_match(far$status$reason[far$status$part == "rim"], "from the mesh")
})

test_that("a closed curve is drawn, graded and told", {
  shape <- fit_shape(ring_specimen(), disc_scheme(), progress = FALSE)
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  expect_silent(plot(shape, engine = "picture", resolution = 50, samples = 1))
  graded <- quality(shape)
  expect_equal(as.character(graded$grade[graded$part == "rim"]), "green")
  expect_output(print(shape), "1 of 1 curves with 16 of 16 points")
})

test_that("closed curves have no expected track; the others learn theirs", {
  scheme <- curve_scheme(
    data.frame(landmark = c("a", "b", "c", "d"), x = c(11, -11, -4, 4), y = c(4, -4, 11, -11),
               z = 3),
    data.frame(curve = c("rim", "half"), from = "a", to = c("a", "b"), kind = "ridge",
               radius = ring_radius, width = 4.5, n = 9, via = c("c b d", "c")), name = "ring"
  )
  shapes <- lapply(1:3, function(i) {
    ring <- ring_specimen(c(a = 20, b = 200, c = 110, d = 290), noise = 0.01 * i)
    ring <- specimen(ring$mesh, ring$landmarks, id = paste0("s", i), outward = "keep",
                     tolerance = 0.25)
    fit_shape(ring, scheme, progress = FALSE)
  })
  learnt <- learn_tracks(shapes, fewest = 3)
  expect_equal(unique(learnt$tracks$curve), "half")
})
