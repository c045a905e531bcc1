# A ball of radius 50 with four landmarks on it, and a scheme of the curves between them and the
# patch inside.

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
    curves = data.frame(curve = c("bottom", "top", "left", "right"), from = c("a", "d", "a", "b"),
                        to = c("b", "c", "d", "c"), kind = "plane", n = c(7, 7, 5, 5)),
    patches = data.frame(patch = "quad", n = 35, columns = "1:7", rows = 5, rows_kept = "1:5",
                         curve_a = "bottom[1:7]", curve_b = "top[1:7]", first_column = "left[1:5]",
                         outward = "columns")
  )
}

quad_scheme <- function(change = identity) {
  do.call(curve_scheme, c(change(quad_tables()), name = "quad"))
}

quad_shape <- function(scheme = quad_scheme(), ..., landmarks = quad_corners()) {
  fitting(quad_specimen(landmarks = landmarks), scheme, ..., progress = FALSE)
}

status_of <- function(shape, part) shape$status[shape$status$part == part, ]

# Two patches on the ball, the upper one turned by a quarter, joined by a strip that ends in
# triangles.
two_patch_shape <- function() {
  quad_shape(quad_scheme(function(tables) {
    tables$curves <- rbind(tables$curves,
                           data.frame(curve = "across", from = "a", to = "c",
                                      kind = "plane", n = 7))
    tables$patches <- data.frame(
      patch = c("low", "high"), n = c(18, 18), columns = c("2:7", "2:7"), rows = 4,
      rows_kept = "1:3", curve_a = c("bottom[1:7]", "top[7:1]"),
      curve_b = c("across[1:7]", "across[7:1]"), outward = "columns"
    )
    tables$strips <- data.frame(part = "model", strip = "middle", rung = 1:7,
                                a = paste0("low|", c(1, 1:6), " 3"),
                                b = paste0("high|", c(6:1, 1), " 3"), outward = "rows")
    tables
  }))
}

# A scheme of curves between a and b of a graph_specimen().
ends_scheme <- function(...) {
  curve_scheme(data.frame(landmark = c("a", "b")), data.frame(from = "a", to = "b", ..., n = 9),
               name = "ends")
}

# The mirror image of a specimen in x, left and right exchanged in the landmarks' names; on request
# with the corners of every face turned at random and the faces in another order.
mirrored_specimen <- function(specimen, pairs, shuffled = FALSE) {
  mesh <- specimen$mesh
  mesh$vb[1, ] <- -mesh$vb[1, ]
  mesh$it <- mesh$it[c(1, 3, 2), ]
  mesh$normals <- NULL
  if (shuffled) {
    turn <- rep_len(0:2, ncol(mesh$it))
    turned <- rbind(1 + turn, 1 + (turn + 1) %% 3, 1 + (turn + 2) %% 3)
    mesh$it <- matrix(mesh$it[cbind(as.vector(turned), rep(seq_len(ncol(mesh$it)), each = 3))], 3)
    mesh$it <- mesh$it[, order((seq_len(ncol(mesh$it)) * 7919) %% 104729)]
  }
  landmarks <- specimen$landmarks %*% diag(c(-1, 1, 1))
  rownames(landmarks) <- partner_of(rownames(specimen$landmarks), pairs, "landmarks")
  specimen(mesh, landmarks, id = paste(specimen$id, "mirrored"))
}

# Greatest distance of the points of a shape from those of its mirror image, left and right
# exchanged; all points must be missing in both or in neither.
mirror_gap <- function(shape, mirror, pairs) {
  part <- mapply(function(part, level) partner_of(part, pairs, level), mirror$points$part,
                 mirror$points$level)
  key <- function(points, part) paste(points$level, part, points$point)
  other <- mirror$points[match(key(shape$points, shape$points$part), key(mirror$points, part)), ]
  gap <- as.matrix(shape$points[c("x", "y", "z")]) - as.matrix(other[c("x", "y", "z")]) %*%
    diag(c(-1, 1, 1))
  testthat::expect_identical(is.na(shape$points$x), is.na(other$x))
  max(abs(gap), na.rm = TRUE)
}
