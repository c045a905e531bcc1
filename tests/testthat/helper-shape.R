# A ball of radius 50 with four landmarks on it, and a scheme of the curves between them and the patch inside.

quad_corners <- function(radius = 50, east = 30, north = 20) {
  turn <- function(lon, lat) radius * c(cos(lat) * sin(lon), sin(lat), cos(lat) * cos(lon))
  e <- east * pi / 180
  n <- north * pi / 180
  rbind(a = turn(-e, -n), b = turn(e, -n), c = turn(e, n), d = turn(-e, n))
}

quad_specimen <- function(change = identity, landmarks = quad_corners()) {
  mesh <- Rvcg::vcgSphere(5)
  mesh$vb[1:3, ] <- 50 * mesh$vb[1:3, ]
  specimen(change(mesh), landmarks, id = "quad")
}

quad_tables <- function() {
  list(
    landmarks = data.frame(landmark = c("a", "b", "c", "d")),
    curves = data.frame(curve = c("bottom", "top", "left", "right"), from = c("a", "d", "a", "b"), to = c("b", "c", "d", "c"),
                        kind = "plane", n = c(7, 7, 5, 5)),
    patches = data.frame(patch = "quad", n = 35, columns = "1:7", rows = 5, rows_kept = "1:5", curve_a = "bottom[1:7]",
                         curve_b = "top[1:7]", first_column = "left[1:5]", outward = "columns")
  )
}

quad_scheme <- function(change = identity) do.call(curve_scheme, c(change(quad_tables()), name = "quad"))

quad_shape <- function(scheme = quad_scheme(), ..., landmarks = quad_corners()) {
  fit_shape(quad_specimen(landmarks = landmarks), scheme, ..., progress = FALSE)
}

status_of <- function(shape, part) shape$status[shape$status$part == part, ]

# Two patches on the ball, the upper one turned by a quarter, joined by a strip that ends in triangles.
two_patch_shape <- function() {
  quad_shape(quad_scheme(function(tables) {
    tables$curves <- rbind(tables$curves, data.frame(curve = "across", from = "a", to = "c", kind = "plane", n = 7))
    tables$patches <- data.frame(
      patch = c("low", "high"), n = c(18, 18), columns = c("2:7", "2:7"), rows = 4, rows_kept = "1:3",
      curve_a = c("bottom[1:7]", "top[7:1]"), curve_b = c("across[1:7]", "across[7:1]"), outward = "columns"
    )
    tables$strips <- data.frame(part = "model", strip = "middle", rung = 1:7, a = paste0("low|", c(1, 1:6), " 3"),
                                b = paste0("high|", c(6:1, 1), " 3"), outward = "rows")
    tables
  }))
}

# A scheme of curves between a and b of a graph_specimen().
ends_scheme <- function(...) {
  curve_scheme(data.frame(landmark = c("a", "b")), data.frame(from = "a", to = "b", ..., n = 9), name = "ends")
}
