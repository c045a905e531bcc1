shapes <- paired_sample()
sample <- homologise(shapes, progress = FALSE)

test_that("the sample has arrays of all levels, and says what moved", {
  expect_s3_class(sample, "shape_sample")
  expect_equal(dim(as.array(sample, "landmarks")), c(6, 3, 4))
  expect_equal(dim(as.array(sample, "curves")), c(50, 3, 4))
  expect_equal(dim(as.array(sample, "surface")), c(63, 3, 4))
  expect_equal(dimnames(as.array(sample, "curves"))[[3]], paste0("ball", 1:4))
  expect_identical(as.array(sample, "curves")[, , "ball2"], coords(sample$shapes$ball2, "curves"))
  expect_equal(nrow(as.data.frame(sample)), 4 * nrow(shapes[[1]]$points))
  expect_equal(sample$convergence$round, seq_len(nrow(sample$convergence)))
  expect_equal(nrow(sample$missing), 0)
  expect_output(print(sample), "4 specimens")
  expect_crestline_error(as.array(sample, "patches"), "surface")
})

test_that("every point is on its specimen's mesh; slide() to the template gives it again", {
  for (i in seq_along(shapes)) {
    expect_on_mesh(sample$shapes[[i]]$points, shapes[[i]]$specimen$mesh)
    again <- slide(shapes[[i]], sample$template)
    expect_identical(again$points, sample$shapes[[i]]$points)
  }
})

test_that("the template converges in a few rounds, to one that does not depend on the start", {
  expect_lte(nrow(sample$convergence), 5)
  other <- homologise(rev(shapes), progress = FALSE)
  laid <- laid_onto(places_of(other$template), places_of(sample$template), FALSE)
  expect_lte(max(abs(laid - places_of(sample$template))), 0.01)
})

test_that("the template is symmetric and its curves are evenly spaced in the mean", {
  at <- places_of(sample$template)
  mirrored <- at[mirror_places(sample$template$scheme), ] %*% diag(c(-1, 1, 1))
  expect_lte(max(abs(laid_onto(mirrored, at, FALSE) - at)), 1e-10)
  share <- vapply(sample$shapes, function(shape) shape$tracks$middle$s / shape$tracks$middle$kept,
                  numeric(7))
  expect_equal(unname(rowMeans(share)), seq(0, 1, length.out = 7), tolerance = 1e-3)
})

test_that("new specimens slide against the old template without changing it", {
  new <- paired_shape(c(1.05, 1.05, 1.15), "new")
  joined <- homologise(list(new), sample$template, rounds = 0, progress = FALSE)
  expect_identical(joined$template$points, sample$template$points)
  expect_null(joined$convergence)
  expect_identical(joined$shapes$new$points, slide(new, sample$template)$points)
})

test_that("specimens may come from a list or a function", {
  faces <- lapply(shapes, `[[`, "specimen")
  names(faces) <- vapply(faces, `[[`, "", "id")
  light <- lapply(shapes, function(shape) {
    shape$specimen <- NULL
    shape
  })
  expect_crestline_error(homologise(light, progress = FALSE), "does not keep its specimen",
                         id = "ball1")
  from_list <- homologise(light, specimens = faces, progress = FALSE)
  from_function <- homologise(light, specimens = function(id) faces[[id]], progress = FALSE)
  expect_identical(as.array(from_list, "surface"), as.array(sample, "surface"))
  expect_identical(as.array(from_function, "surface"), as.array(sample, "surface"))
})

test_that("missing points are NA, listed, and do not spoil the rest", {
  corners <- paired_corners()
  corners["highL", ] <- NA
  gone <- paired_shape(c(1.2, 1, 1.1), "ball2", landmarks = corners)
  part <- homologise(replace(shapes, 2, list(gone)), progress = FALSE)
  expect_identical(is.na(as.array(part, "curves")[, 1, "ball2"]),
                   is.na(coords(gone, "curves")[, 1]))
  expect_setequal(part$missing$part[part$missing$level == "curves"], c("side left", "roof left"))
  expect_true(all(part$missing$id == "ball2"))
  expect_false(anyNA(part$template$points$x))
  expect_lte(max(abs(as.array(part, "curves")[, , c(1, 3, 4)] -
                     as.array(sample, "curves")[, , c(1, 3, 4)])), 1)
})

test_that("a scheme without pairs has a template that need not be symmetric", {
  scheme <- paired_scheme(function(tables) tables[c("landmarks", "curves", "patches")])
  plain <- homologise(paired_sample(scheme = scheme), progress = FALSE)
  expect_equal(unname(dim(as.array(plain, "surface"))), c(63, 3, 4))
})

test_that("what is no sample is refused, and a mean that still moves is told of", {
  expect_crestline_error(homologise(list()), "list")
  expect_crestline_error(homologise(list(shapes[[1]], 3)), "element 2")
  expect_crestline_error(homologise(shapes[c(1, 1)]), c("ball1", "two shapes"))
  expect_crestline_error(homologise(list(shapes[[1]], quad_shape())), c("quad", "paired"))
  expect_crestline_error(homologise(shapes, rounds = 0), "template")
  expect_warning(homologise(shapes, rounds = 1, progress = FALSE),
                 class = "crestline_not_converged")
})

test_that("the paper's settings go through too", {
  expect_s3_class(suppressWarnings(homologise(shapes, settings = slide_settings("paper"),
                                              progress = FALSE)), "shape_sample")
})

with_humface <- function() {
  kept <- new.env()
  utils::data("humface", package = "Rvcg", envir = kept)
  kept$humface
}

# humface pushed about smoothly, with noise on mesh and landmarks.
noisy_faces <- function(n, scheme) {
  face <- list(mesh = with_humface(), landmarks = humface_specimen()$landmarks)
  lapply(seq_len(n), function(i) with_seed(i, {
    centre <- face$landmarks[sample.int(nrow(face$landmarks), 6), ]
    push <- matrix(stats::rnorm(18, sd = 2), 6)
    noise <- stats::rnorm(ncol(face$mesh$vb))
    moved <- function(xyz) {
      xyz +
        exp(-(outer(rowSums(xyz^2), rowSums(centre^2), `+`) - 2 * xyz %*% t(centre)) /
            (2 * 30^2)) %*% push
    }
    mesh <- face$mesh
    mesh$vb[1:3, ] <- t(moved(t(mesh$vb[1:3, ]))) + t(t(mesh$normals[1:3, ]) * 0.2 * noise)
    mesh$normals <- NULL
    landmarks <- moved(face$landmarks) + noise[seq_along(face$landmarks)] * 0.5 / sqrt(3)
    fit_shape(specimen(mesh, landmarks, id = paste("face", i), tolerance = 0.25), scheme,
              ridge_settings(error = FALSE), progress = FALSE)
  }))
}

test_that("a mean that takes two places in turn, as on noisy scans, rests between them", {
  whole <- face_scheme()
  curves <- subset(whole$curves,
                   grepl("^nasal|^mid-line (nas|lip|phil|upper|lower|col)|^(upper|lower) lip",
                         curve))
  pairs <- subset(whole$pairs, level != "surface" &
                               (left %in% curves$curve | left %in% whole$landmarks$landmark))
  shapes <- noisy_faces(8,
                        curve_scheme(whole$landmarks, curves, pairs = pairs,
                                     name = "nose and mouth"))
  expect_no_warning(sample <- homologise(shapes, progress = FALSE, red = "keep"))
  expect_lte(nrow(sample$convergence), 6)
})

test_that("a face of which half is missing is slid with the others, however long its names", {
  fine <- paired_scheme(function(tables) {
    tables$curves$n[3:6] <- 21
    tables$patches$patch[1] <- "cheek on the left side of the ball"
    tables$pairs$left[6] <- tables$patches$patch[1]
    tables$patches$n[1:2] <- 21 * 17
    tables$patches$columns[1:2] <- "1:21"
    tables$patches$rows[1:2] <- 18
    tables$patches$rows_kept[1:2] <- "1:17"
    tables$patches$curve_a[1:2] <- c("floor left[1:21]", "floor right[1:21]")
    tables$patches$curve_b[1:2] <- c("roof left[1:21]", "roof right[1:21]")
    tables
  })
  corners <- paired_corners()
  corners[c("lowL", "highL"), ] <- NA
  half <- paired_shape(c(1.1, 1, 1), "half", fine, landmarks = corners)
  gone <- fine$points$place[is.na(half$points$x)]
  expect_gt(sum(nchar(gone)), 10000)
  whole <- lapply(1:2, function(i) paired_shape(c(1, 0.95 + i / 20, 1), paste0("whole", i), fine))
  sample <- suppressWarnings(homologise(c(whole, list(half)),
                                        settings = slide_settings(), rounds = 2, progress = FALSE))
  expect_identical(is.na(sample$shapes[[3]]$points$x), is.na(half$points$x))
  slid <- slide(half, sample$template)
  expect_true("side right" %in% slid$sliding$part && !"side left" %in% slid$sliding$part)
  # Another half is another set of points.
  corners <- paired_corners()
  corners[c("lowR", "highR"), ] <- NA
  other <- slide(paired_shape(c(1.1, 1, 1), "other half", fine, landmarks = corners),
                 sample$template)
  expect_true("side left" %in% other$sliding$part && !"side right" %in% other$sliding$part)
})

test_that("the same scan under two ids is named", {
  copy <- shapes[[1]]
  copy$id <- copy$specimen$id <- "copy"
  expect_warning(homologise(list(shapes[[1]], copy), rounds = 1, tolerance = 1, progress = FALSE),
                 "ball1 and copy", class = "crestline_twin")
})
