# Crests that bow and close, as height fields: crest 3 high over a curve in the plane.

# A ridge over a circle of radius 12, on a mesh of spacing 1; landmarks by angle in degrees.
ring_specimen <- function(angle = c(a = 20, b = 200, c = 110, d = 290, e = 55), noise = 0,
                          centre = c(0, 0), half = c(20, 20)) {
  at <- cbind(u = 12 * cos(angle * pi / 180), v = 12 * sin(angle * pi / 180))
  rownames(at) <- names(angle)
  graph_specimen(quote(3 * exp(-(sqrt(u^2 + v^2) - 12)^2 / 12)), at, half = half, noise = noise)
}

# Distance of points from that circle at the height of its crest.
off_ring <- function(points) {
  xyz <- xyz_of(points)
  sqrt((sqrt(xyz[, 1]^2 + xyz[, 2]^2) - 12)^2 + (xyz[, 3] - 3)^2)
}

ring_radius <- 3
