# A device that needs no display and leaves nothing behind; the value of `drawing`.
draw_quietly <- function(drawing, width = 400, height = 400) {
  file <- tempfile(fileext = ".png")
  grDevices::png(file, width, height, type = "cairo", res = 72)
  on.exit({
    grDevices::dev.off()
    unlink(file)
  })
  force(drawing)
}

# The pixels of what is drawn: height x width x 3 in [0, 1].
drawn_pixels <- function(drawing, width = 200, height = 200) {
  testthat::skip_if_not_installed("png")
  file <- tempfile(fileext = ".png")
  on.exit(unlink(file))
  grDevices::png(file, width, height, type = "cairo", res = 72)
  tryCatch(force(drawing), finally = grDevices::dev.off())
  png::readPNG(file)[, , 1:3]
}

with_null_rgl <- function(code) {
  old <- options(rgl.useNULL = TRUE)
  rgl::open3d(useNULL = TRUE)
  on.exit({
    rgl::close3d()
    options(old)
  })
  force(code)
}

unit_ball <- function() Rvcg::vcgUpdateNormals(Rvcg::vcgSphere(4), silent = TRUE)

ball_specimen <- function() {
  poles <- rbind(east = c(1, 0, 0), front = c(0, 0, 1), west = c(-1, 0, 0))
  structure(list(id = "ball", mesh = unit_ball(), landmarks = poles), class = "specimen")
}

ball_curvature <- function(n = ncol(unit_ball()$vb)) {
  structure(list(k1 = rep(-1, n), k2 = rep(-1, n)), class = "curvature", radius = 0.3)
}

# Points of the mesh with face and weights, at closest distance to x.
on_ball <- function(x, mesh = unit_ball()) {
  hit <- Rvcg::vcgClostKD(x, mesh, barycentric = TRUE, sign = FALSE)
  xyz <- t(hit$vb[1:3, ])
  weights <- t(hit$barycoords)
  s <- c(0, cumsum(sqrt(rowSums(diff(xyz)^2))))
  data.frame(s = s, x = xyz[, 1], y = xyz[, 2], z = xyz[, 3], face = hit$faceptr, w1 = weights[, 1],
             w2 = weights[, 2], w3 = weights[, 3])
}

# A quarter of the equator as if it were a ridge, with standard error 0.05 and strength exp(-d^2).
equator_curve <- function(type = "ridge") {
  quarter <- function(n) {
    turn <- seq(0, pi / 2, length.out = n)
    on_ball(cbind(cos(turn), 0, sin(turn)))
  }
  path <- quarter(101)
  points <- cbind(point = 1:11, quarter(11), d = 0, se = 0.05)
  window <- expand.grid(s = seq(0, pi / 2, length.out = 40), d = seq(-0.3, 0.3, length.out = 20))
  window$inside <- TRUE
  coordinates <- structure(data.frame(vertex = seq_len(nrow(window)), window), length = pi / 2, width = 0.3)
  surface <- structure(list(), class = "test_surface")
  line <- list(s = seq(0, pi / 2, length.out = 41), alpha = rep(0, 41), se = rep(0.05, 41))
  structure(list(points = points, path = path, reference = path, coordinates = coordinates, surface = surface,
                 line = line, strength = 1, se = 0.05, length = pi / 2, converged = TRUE, determined = TRUE, type = type,
                 from = "east", to = "front", id = "ball"), class = "curve")
}
registerS3method("predict", "test_surface", function(object, s, d, ...) exp(-d^2), envir = asNamespace("stats"))
