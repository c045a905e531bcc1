# What the tests of paths and ridges share: specimens with a known curve, and what a path on a mesh
# must be.

# A specimen of the graph z(u, v) on an irregular mesh, landmarks at given (u, v), a matrix with row
# names.
graph_specimen <- function(z, at, half = c(20, 20), spacing = 1, noise = 0, seed = 1, jitter = 0.3)
  {
  form <- list(x = quote(u), y = quote(v), z = z, u = c(-half[1], half[1]),
               v = c(-half[2], half[2]))
  built <- closed_form_mesh(form, spacing, noise, seed, jitter)
  height <- eval(z, list(u = at[, 1], v = at[, 2]))
  specimen(built$mesh, cbind(x = at[, 1], y = at[, 2], z = rep_len(height, nrow(at))), id = "graph",
           outward = "keep", tolerance = 0.2)
}

two_ends <- function(u = c(-13.3, 13.6), v = c(0.2, -0.1)) cbind(u, v, deparse.level = 0) |>
  `rownames<-`(c("a", "b"))

# A ridge 6 high, 5 wide, over the curve v = 1.5 sin(u / 8), and its straight sister.
bent_ridge <- function(...) {
  u <- c(-13.3, 13.6)
  graph_specimen(quote(6 * exp(-(v - 1.5 * sin(u / 8))^2 / 50)), two_ends(u, 1.5 * sin(u / 8)), ...)
}
straight_ridge <- function(...) graph_specimen(quote(6 * exp(-v^2 / 50)), two_ends(), ...)

# Two ridges that part at landmark a, swing out to v = 5 and v = -5 and meet again at b, of heights
# `left` and `right`.
arched_ridges <- function(left, right, ...) {
  z <- substitute(v^2 / 10 + left * exp(-(v - 5 * cos(pi * u / 27))^2 / 3) +
                  right * exp(-(v + 5 * cos(pi * u / 27))^2 / 3),
                  list(left = left, right = right))
  graph_specimen(z, two_ends(c(-13.5, 13.5), c(0, 0)), half = c(18, 14), ...)
}

xyz_of <- function(points) as.matrix(as.data.frame(points)[c("x", "y", "z")])

# Unit sphere of about 2,500 vertices, its poles at no vertex.
ball <- function() Rvcg::vcgSphere(4)

# A path is on its mesh: points in their faces, and every segment inside the face of its later
# point.
expect_path_on_mesh <- function(path, mesh, tolerance = 1e-6) {
  expect_on_mesh(path, mesh)
  size <- max(abs(mesh$vb[1:3, ]))
  begin <- xyz_of(path)[-nrow(path), , drop = FALSE]
  face <- path$face[-1]
  placed <- place_on_faces(mesh, face, weights_in_faces(mesh, face, begin))
  testthat::expect_lte(max(abs(placed - begin)), tolerance * size)
  testthat::expect_true(all(diff(path$s) >= 0))
  testthat::expect_equal(path$s[nrow(path)], attr(path, "length"))
  testthat::expect_equal(diff(path$s), chords(path), tolerance = 1e-9)
}

# Straight distances between neighbours.
chords <- function(points) unname(sqrt(rowSums(diff(xyz_of(points))^2)))

# Distance of each point from a polyline, n.
distance_from_line <- function(xyz, line) {
  a <- line[-nrow(line), , drop = FALSE]
  step <- line[-1, , drop = FALSE] - a
  apply(xyz, 1, function(p) {
    rel <- rep(p, each = nrow(a)) - a
    along <- pmin(pmax(rowSums(rel * step) / rowSums(step^2), 0), 1)
    sqrt(min(rowSums((rel - along * step)^2)))
  })
}

# Rvcg's humface with the landmarks of inst/extdata.
humface_specimen <- function() {
  kept <- new.env()
  utils::data("humface", package = "Rvcg", envir = kept)
  file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
  if (!nzchar(file)) testthat::skip("humface's landmarks are not here")
  specimen(kept$humface, read_landmarks(file), id = "humface")
}

# The curve without the warning that two cuts are nearly as good.
curve_of <- function(...) suppressWarnings(ridge_curve(...), classes = "crestline_rival_path")
