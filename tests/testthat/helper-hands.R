# Rvcg's face as it comes, and its landmarks; what is worked out once for the files that need it.
humface_scan <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  data$humface
}

humface_landmarks <- function() {
  read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline"))
}

ear_names <- c("tL", "tR", "oiL", "oiR")

# A mesh turned, moved and scaled: x -> scale * turn x + shift.
moved_mesh <- function(mesh, turn, shift = c(0, 0, 0), scale = 1) {
  mesh$vb[1:3, ] <- scale * turn %*% mesh$vb[1:3, ] + shift
  mesh$normals <- NULL
  mesh
}

some_rotation <- function(seed) with_seed(seed, {
  turn <- qr.Q(qr(matrix(stats::rnorm(9), 3)))
  turn * sign(det(turn))
})

# Fewer points and steps than the default: half the time, a little less exact.
quick_settings <- function() find_settings(points = 1000, warp_steps = 10)

# Humface with found landmarks, found once.
found_lines <- local({
  found <- NULL
  function() {
    if (is.null(found))
      found <<- find_landmarks(humface_scan(), id = "humface", settings = quick_settings())
    found
  }
})
