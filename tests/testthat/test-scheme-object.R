# The scheme of an object that is no face: the skull of Morpho's boneData (inst/extdata/README.md).

skull_scheme <- function() {
  read_scheme(system.file("extdata", "skull_scheme", package = "crestline"), name = "skull")
}

skull_landmarks <- function() {
  read_landmarks(system.file("extdata", "skull_landmarks.csv", package = "crestline"))
}

morpho_skull <- function() {
  testthat::skip_if_not_installed("Morpho")
  data <- new.env()
  utils::data("boneData", package = "Morpho", envir = data)
  data
}

# Fitted once for all tests of this file.
skull_fit <- local({
  fit <- NULL
  function() {
    if (is.null(fit)) {
      skull <- specimen(morpho_skull()$skull_0144_ch_fe.mesh, skull_landmarks(), id = "skull")
      fit <<- list(specimen = skull, shape = fit_shape(skull, skull_scheme(), progress = FALSE))
    }
    fit
  }
})

# Greatest distance of points from a path.
off_path <- function(points, path) {
  xyz <- as.matrix(as.data.frame(path)[c("x", "y", "z")])
  from <- xyz[-nrow(xyz), ]
  step <- diff(xyz)
  max(apply(rbind(points), 1, function(p) {
    ahead <- rep(p, each = nrow(from)) - from
    share <- pmin(pmax(rowSums(ahead * step) / rowSums(step^2), 0), 1)
    sqrt(min(rowSums((ahead - share * step)^2)))
  }))
}

test_that("the skull's tables read, and its landmarks are those of the scheme", {
  scheme <- skull_scheme()
  expect_setequal(rownames(skull_landmarks()), scheme$landmarks$landmark)
  expect_setequal(scheme$curves$kind, c("ridge", "valley", "plane"))
  expect_true(all(scheme$landmarks$landmark %in% c(scheme$curves$from, scheme$curves$to)))
})

test_that("every left part has its right one, and no other is paired", {
  scheme <- skull_scheme()
  names <- c(scheme$landmarks$landmark, scheme$curves$curve, scheme$patches$patch)
  left <- grep("L$|left$", names, value = TRUE)
  right <- sub("L$", "R", sub("left$", "right", left))
  expect_setequal(scheme$pairs$left, left)
  expect_identical(scheme$pairs$right[match(left, scheme$pairs$left)], right)
  expect_setequal(setdiff(names, c(left, right)),
                  c("n", "rhi", "ac", "pr", "nasal bridge", "subnasal crest"))
})

test_that("the patches' triangles join: each edge once a way round, and all hang together", {
  scheme <- skull_scheme()
  v <- as.matrix(scheme$triangles[c("v1", "v2", "v3")])
  way <- rbind(v[, 1:2], v[, 2:3], v[, c(3, 1)])
  expect_identical(anyDuplicated(way), 0L)
  # Two triangles a quad; a strip between lines of p and q points has p + q - 2, one less where the
  # lines share an end.
  blocks <- 2 * (7 * 3 + 8 * 3 + 6 * 5 + 8 * 4)
  strips <- (5 + 7 - 2) + (4 + 6 - 3)
  expect_equal(nrow(v), 2 * (blocks + strips))
  piece <- seq_len(max(v))
  for (round in seq_len(max(v))) {
    lowest <- pmin(piece[v[, 1]], piece[v[, 2]], piece[v[, 3]])
    before <- piece
    for (corner in 1:3) piece[v[, corner]] <- pmin(piece[v[, corner]], lowest)
    if (identical(before, piece)) break
  }
  expect_length(unique(piece[v]), 1)
})

test_that("on the skull all is found, on the mesh, without a fault", {
  fit <- skull_fit()
  expect_true(all(fit$shape$status$ok))
  expect_true(all(is.na(fit$shape$status$reason)))
  expect_on_mesh(fit$shape$points, fit$specimen$mesh)
  expect_equal(nrow(surface_faults(fit$shape, fit$specimen)), 0)
})

test_that("points that coincide by construction agree exactly", {
  fit <- skull_fit()
  place <- fit$shape$scheme$points$place
  at <- as.matrix(fit$shape$points[c("x", "y", "z", "face", "w1", "w2", "w3")])
  expect_identical(unname(at), unname(at[match(place, place), ]))
  expect_gt(sum(duplicated(place)), 60)
})

test_that("ridges lie where the surface bends outwards, valleys where it bends inwards", {
  fit <- skull_fit()
  vertices <- t(fit$specimen$mesh$vb[1:3, ])
  middle_index <- function(row) {
    points <- fit$shape$points[fit$shape$points$level == "curves" & fit$shape$points$part ==
                               row$curve, ]
    nearest <- Rvcg::vcgKDtree(vertices, as.matrix(points[c("x", "y", "z")]), k = 1)$index
    curved <- curvature(fit$specimen, row$radius, vertices = sort(unique(as.vector(nearest))))
    stats::median(shape_index(curved), na.rm = TRUE)
  }
  curves <- fit$shape$scheme$curves
  index <- vapply(split(curves, curves$curve)[curves$curve[curves$kind != "plane"]],
                  middle_index, 0)
  kind <- curves$kind[match(names(index), curves$curve)]
  expect_gt(min(index[kind == "ridge"]), 0.25)
  expect_lt(max(index[kind == "valley"]), -0.25)
})

test_that("Morpho's own landmarks of this skull lie on the curves to 1 mm", {
  fit <- skull_fit()
  own <- morpho_skull()$boneLM[, , "skull_0144_ch_fe"]
  expect_near <- function(rows, curve) expect_lt(off_path(own[rows, ], fit$shape$paths[[curve]]), 1)
  expect_near(c(9, 10), "nasal bridge")             # nasion, rhinion
  expect_near(c(1, 2), "subnasal crest")            # on the nasal spine and below it
  expect_near(3, "aperture lower right")
  expect_near(4, "aperture lower left")
  expect_near(7, "lower rim medial right")          # by the upper end of the lacrimal crest
  expect_near(8, "lower rim medial left")
})

test_that("the mirrored skull, left and right swapped, has the mirrored model", {
  fit <- skull_fit()
  scheme <- skull_scheme()
  mesh <- fit$specimen$mesh
  mesh$vb[1, ] <- -mesh$vb[1, ]
  mesh$it <- mesh$it[c(1, 3, 2), ]
  marks <- fit$specimen$landmarks %*% diag(c(-1, 1, 1))
  rownames(marks) <- partner_of(rownames(fit$specimen$landmarks), scheme$pairs, "landmarks")
  image <- fit_shape(specimen(mesh, marks, id = "mirrored"), scheme, ridge_settings(error = FALSE),
                     progress = FALSE)
  for (level in c("landmarks", "curves", "surface")) {
    own <- fit$shape$points[fit$shape$points$level == level, ]
    other <- image$points[image$points$level == level, ]
    name <- paste(partner_of(own$part, scheme$pairs, level), own$point)
    mirror <- as.matrix(other[match(name, paste(other$part, other$point)), c("x", "y", "z")]) %*%
      diag(c(-1, 1, 1))
    expect_lt(max(abs(mirror - as.matrix(own[c("x", "y", "z")]))), tolerances$invariance * 100)
  }
})

test_that("the nasal spine, put elsewhere, is found again by its definition", {
  skull <- specimen(morpho_skull()$skull_0144_ch_fe.mesh, skull_landmarks(), id = "skull")
  placed <- skull$landmarks["ac", ]
  refined <- function(step) {
    skull$landmarks["ac", ] <- as.matrix(surface_points(skull$mesh, matrix(placed + step, 1))[1:3])
    refine_landmarks(skull, skull_scheme(), move = TRUE)$landmarks["ac", ]
  }
  one <- refined(c(2, 0, 0))
  two <- refined(c(0, 1.2, -1.6))
  expect_lt(sqrt(sum((one - two)^2)), 1e-3)
  expect_lt(sqrt(sum((one - placed)^2)), 0.5)
})
