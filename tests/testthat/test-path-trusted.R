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
  scheme <- ends_scheme(curve = "crest", kind = "ridge", radius = 6, width = 6, trust_from = 0.25, trust_to = 0.75)
  shape <- fit_shape(face, scheme, progress = FALSE)
  curve <- curve_of(face, "a", "b", "ridge", radius = 6, width = 6, n = 9, trust = c(0.25, 0.75))
  expect_equal(unname(coords(shape, "curves")), unname(as.matrix(curve$points[c("x", "y", "z")])), tolerance = 1e-9)
  whole <- curve_of(face, "a", "b", "ridge", radius = 6, width = 6, n = 9)
  expect_null(attr(whole$reference, "trusted"))
  expect_length(attr(curve$reference, "trusted"), 2)
  for (wrong in list(0.5, c(0.8, 0.2), c(-0.1, 1), c(0, NA), "all")) {
    expect_crestline_error(ridge_curve(face, "a", "b", "ridge", 6, 6, 9, trust = wrong), "`trust`")
  }
})

test_that("the demo's eye sockets keep to the lower lid, as those of the face's scheme do", {
  face <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  rows <- read.csv(system.file("extdata", "demo_curves.csv", package = "crestline"), na.strings = "")
  scheme <- face_scheme()
  for (name in c("lower eye socket left", "lower eye socket right")) {
    row <- rows[rows$curve == name, ]
    side <- keep_side(row$keep_from, row$keep_to, row$keep_towards)
    curve <- ridge_curve(face, row$from, row$to, row$kind, row$radius, row$half_width, row$n, side, trust = c(0, row$trust_to))
    own <- scheme$curves[scheme$curves$curve == name, ]
    expect_equal(c(row$radius, row$half_width, row$n, row$trust_to), c(own$radius, own$width, own$n, own$trust_to))
    # The line between the corners bulges down by a quarter of its length at most; a curl at the corner goes up.
    corners <- face$landmarks[c(row$from, row$to), ]
    up <- corners[1, ] - face$landmarks[row$keep_towards, ]
    along <- corners[2, ] - corners[1, ]
    up <- up - sum(up * along) / sum(along^2) * along
    height <- sweep(as.matrix(curve$path[c("x", "y", "z")]), 2, corners[1, ]) %*% up / sqrt(sum(up^2))
    expect_lt(max(height), 0.5)
  }
})
