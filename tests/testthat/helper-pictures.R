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
  specimen(unit_ball(), poles, id = "ball")
}

ball_curvature <- function(n = ncol(unit_ball()$vb)) {
  one <- rep(-1, n)
  axis <- matrix(1, n, 3)
  new_curvature(list(k1 = one, k2 = one, direction1 = axis, direction2 = axis, normal = axis,
                     sigma = -one), 0.3, "adaptive",
                mesh_of(ball_specimen()))
}

# Points of the mesh with face and weights, at closest distance to x.
on_ball <- function(x, mesh = unit_ball()) {
  at <- surface_points(mesh, x)
  cbind(s = c(0, cumsum(row_lengths(diff(as.matrix(at[1:3]))))), at)
}

# A quarter of the equator as if it were a ridge, with standard error 0.05 and strength exp(-d^2).
equator_curve <- function(type = "ridge") {
  quarter <- function(n) {
    turn <- seq(0, pi / 2, length.out = n)
    on_ball(cbind(cos(turn), 0, sin(turn)))
  }
  of <- mesh_of(ball_specimen())
  path <- quarter(101)
  path <- new_mesh_path(unclass(path), max(path$s), of$key, of$id)
  points <- cbind(point = 1:11, quarter(11), d = 0, se = 0.05)
  window <- expand.grid(s = seq(0, pi / 2, length.out = 40), d = seq(-0.3, 0.3, length.out = 20))
  window$inside <- TRUE
  across <- data.frame(tx = 0, ty = 0, tz = rep(1, nrow(window)))
  coordinates <- new_path_coordinates(as.list(cbind(vertex = seq_len(nrow(window)), window,
                                                    across)), pi / 2, 0.3, of)
  surface <- structure(list(), class = "test_surface")
  line <- list(s = seq(0, pi / 2, length.out = 41), alpha = rep(0, 41), se = rep(0.05, 41))
  job <- list(ends = list(scan = of, names = c("east", "front")), type = type)
  new_curve(points, path, path, job, list(se = 0.05, determined = TRUE, reason = NA_character_),
            coordinates = coordinates, surface = surface, line = line, strength = 1)
}
registerS3method("predict", "test_surface", function(object, s, d, ...) exp(-d^2),
                 envir = asNamespace("stats"))
