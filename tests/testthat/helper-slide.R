# What the tests of sliding share: random polylines, and a small scheme with left and right on a
# ball.

# Matrix s, x, y, z, face of a random wiggly path.
random_track <- function(nodes, seed) {
  with_seed(seed, {
    at <- apply(matrix(stats::rnorm(3 * nodes), nodes), 2, cumsum) / sqrt(nodes) +
      outer(seq_len(nodes), c(1, 0, 0)) / 10
    cbind(s = c(0, cumsum(sqrt(rowSums(diff(at)^2)))), at, face = 1)
  })
}

along_track <- function(track, s) {
  sapply(2:4, function(k) stats::approx(track[, 1], track[, k], s)$y)
}

# A random curve of n points, unevenly spaced, four landmarks beside it, and the energy from another
# such template.
random_slide <- function(seed, n = 12 + seed %% 29,
                         settings = slide_settings(tolerance = 1e-8, sweeps = 20000)) {
  track <- random_track(60 + 7 * seed %% 300, seed)
  other <- random_track(200, seed + 1e4)
  length <- max(track[, 1])
  s <- with_seed(seed, c(0, sort(stats::runif(n - 2, 0, length)), length))
  beside <- with_seed(seed, matrix(stats::rnorm(24), 8))
  template <- rbind(along_track(other, seq(0, max(other[, 1]), length.out = n)), beside[1:4, ])
  b <- energy_matrix(template, rep(c(settings$nugget, 0), c(n, 4)), 1e-6)
  x <- rbind(along_track(track, s), beside[5:8, ])
  strain <- settings$strain * mean(diag(b))
  rows <- slider_rows(s, seq_len(n) %in% 2:(n - 1), length / (n - 1), length, settings)
  slid <- cpp_slide_on_tracks(b, x, list(track), rows, strain, settings$sweeps)
  list(track = track, n = n, s = s, b = b, x = x, strain = strain, rest = length / (n - 1),
       settings = settings, slid = c(slid, list(after = c(0, slid$s, length))))
}

# The sum that sliding lowers.
slide_sum <- function(case, x, s) {
  quadratic_form(case$b, x) + case$strain * sum((diff(s) - case$rest)^2)
}

# A ball of radius 50, stretched, with a bump: its landmarks and a scheme of left, right and middle.
stretched_ball <- function(stretch = c(1, 1, 1), id = "ball", landmarks = paired_corners()) {
  mesh <- Rvcg::vcgSphere(4)
  mesh$vb[1:3, ] <- 50 * mesh$vb[1:3, ] * stretch
  mesh$normals <- NULL
  mesh <- Rvcg::vcgUpdateNormals(mesh, silent = TRUE)
  specimen(mesh, landmarks %*% diag(stretch) |> `rownames<-`(rownames(landmarks)), id = id,
           tolerance = 0.05)
}

# Low and high on either side, and in the middle.
paired_corners <- function() {
  turn <- function(lon, lat) 50 * c(cos(lat) * sin(lon), sin(lat), cos(lat) * cos(lon))
  rbind(lowL = turn(0.6, -0.4), lowR = turn(-0.6, -0.4), highL = turn(0.6, 0.5),
        highR = turn(-0.6, 0.5), low = turn(0, -0.5), high = turn(0, 0.6))
}

paired_tables <- function() {
  list(
    landmarks = data.frame(landmark = rownames(paired_corners())),
    curves = data.frame(
      curve = c("side left", "side right", "floor left", "floor right", "roof left", "roof right",
                "middle", "across"),
      from = c("lowL", "lowR", "lowL", "lowR", "highL", "highR", "low", "lowL"),
      to = c("highL", "highR", "low", "low", "high", "high", "high", "lowR"), kind = "plane",
      n = c(7, 7, 6, 6, 6, 6, 7, 5), cut_share = NA_real_, cut_from = NA_character_,
      cut_to = NA_character_
    ),
    patches = data.frame(
      patch = c("cheek left", "cheek right", "belt"), n = c(30, 30, 3),
      columns = c("1:6", "1:6", "1:3"), rows = c(6, 6, 1), rows_kept = c("1:5", "1:5", "1"),
      curve_a = c("floor left[1:6]", "floor right[1:6]", "across[1:5]"),
      resample_a = c(NA, NA, 3), curve_b = c("roof left[1:6]", "roof right[1:6]", NA),
      outward = c("rows", "columns", NA)
    ),
    pairs = data.frame(
      level = rep(c("landmarks", "curves", "surface"), c(2, 3, 1)),
      left = c("lowL", "highL", "side left", "floor left", "roof left", "cheek left"),
      right = c("lowR", "highR", "side right", "floor right", "roof right", "cheek right")
    )
  )
}

paired_scheme <- function(change = identity) {
  do.call(curve_scheme, c(change(paired_tables()), name = "paired"))
}

paired_shape <- function(stretch = c(1, 1, 1), id = "ball", scheme = paired_scheme(), ...) {
  fit_shape(stretched_ball(stretch, id, ...), scheme, ridge_settings(error = FALSE),
            progress = FALSE)
}

# Four balls of different build.
paired_sample <- function(...) {
  stretches <- list(c(1, 1, 1), c(1.2, 1, 1.1), c(0.95, 1.15, 1), c(1.1, 0.9, 1.2))
  Map(paired_shape, stretches, paste0("ball", seq_along(stretches)), MoreArgs = list(...))
}
