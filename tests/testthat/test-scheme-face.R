face <- face_scheme()
surface <- face$points[face$points$level == "surface", ]

# A triangle's three corners from the least on, the sense kept.
turned <- function(v) {
  least <- max.col(-v, "first")
  row <- seq_len(nrow(v))
  paste(v[cbind(row, least)], v[cbind(row, least %% 3 + 1)], v[cbind(row, (least + 1) %% 3 + 1)])
}

test_that("the face has the published numbers", {
  expect_equal(nrow(face$landmarks), 23)
  expect_equal(nrow(face$curves), 40)
  expect_equal(sum(face$curves$n), 467)
  expect_equal(length(unique(face$patches$patch)), 29)
  expect_equal(nrow(face$patches), 33)
  expect_equal(sum(face$patches$n), 922)
  expect_equal(nrow(surface), 922)
  expect_equal(length(unique(surface$place)), 907)
  expect_equal(anyDuplicated(surface[c("part", "point")]), 0)
  expect_equal(c(table(face$triangles$part)), c("close eyes" = 38, "close nose" = 36, model = 1602))
})

test_that("points of the model that are curve points and landmarks are known as such", {
  level <- sub("[|].*", "", surface$place)
  expect_equal(length(unique(surface$place[level == "landmarks"])), 19)  # all but t and oi
  place <- function(part, point) surface$place[surface$part == part & surface$point == point]
  expect_equal(place("upper lip left", "6 1"), "landmarks|cphL")
  expect_equal(place("upper mid face right", "12 5"), "landmarks|exR")
  expect_equal(place("nose left", "1 5"), "landmarks|enL")
  expect_equal(place("mid-line chin", "1"), "landmarks|gn")
  expect_equal(place("upper face left", "1 12 1"), "curves|brow ridge left|10")
  expect_equal(place("upper face left", "2 1 1"), "curves|brow ridge left|10")
  expect_equal(place("lower face left", "1 1"), "curves|mandible left|1")  # cut off before the ear
})

test_that("the triangles are one outward sheet with two borders", {
  v <- as.matrix(face$triangles[face$triangles$part == "model", c("v1", "v2", "v3")])
  expect_true(all(v >= 1 & v <= 922))
  from <- c(v)
  to <- c(v[, c(2, 3, 1)])
  expect_equal(anyDuplicated(paste(from, to)), 0)
  border <- which(!paste(to, from) %in% paste(from, to))
  expect_equal(length(border), 142 + 26)
  expect_equal(anyDuplicated(from[border]), 0)
  expect_equal(length(unique(c(v))), 885)
})

test_that("left and right pair completely and both ways, points and triangles too", {
  for (level in c("landmarks", "curves", "surface")) {
    name <- unique(face$points$part[face$points$level == level])
    partner <- partner_of(name, face$pairs, level)
    expect_setequal(partner, name)
    expect_equal(partner_of(partner, face$pairs, level), name)
    expect_equal(partner == name, !grepl("(L|R| left| right)$", name))
  }
  key <- paste(surface$part, surface$point)
  mirror <- match(paste(partner_of(surface$part, face$pairs, "surface"), surface$point), key)
  expect_false(anyNA(mirror))
  v <- as.matrix(face$triangles[c("v1", "v2", "v3")])
  first <- match(surface$place, surface$place)
  reflected <- matrix(first[mirror[v[, c(1, 3, 2)]]], ncol = 3)
  expect_setequal(turned(reflected), turned(v))
})

test_that("brows keep away from the eye, eye sockets below it, curves from the ear are cut", {
  brow <- face$curves[grepl("^brow", face$curves$curve), ]
  expect_equal(brow$keep_away_from, c("exL", "exR"))
  expect_equal(brow$keep_away_radius, c(0.6, 0.6))
  socket <- face$curves[grepl("^lower eye", face$curves$curve), ]
  expect_equal(socket$keep_side_from, c("exL", "exR"))
  expect_equal(socket$keep_side_towards, c("acL", "acR"))
  expect_lt(max(socket$trust_to), 1)
  expect_equal(is.na(face$curves$cut_share), !face$curves$from %in% c("tL", "tR", "oiL", "oiR"))
})

test_that("where the kind differs from the authors', the note says why", {
  differs <- face$curves$kind != face$curves$authors_kind
  expect_equal(face$curves$curve[differs],
               paste(rep(c("philtrum ridge", "philtrum lip"), each = 2), c("left", "right")))
  expect_true(all(nzchar(face$curves$note[differs])) && !anyNA(face$curves$note[differs]))
  expect_true(all(face$curves$authors_kind %in% c("ridge", "valley", "plane")))
})

test_that("the model is the published one, point by point", {
  reference <- utils::read.csv(shared_data("scan_a", "reference_surface.csv"))
  expect_equal(surface$part, reference$patch)
  expect_equal(surface$point, reference$index)
  curves <- utils::read.csv(shared_data("scan_a", "reference_curves.csv"))
  expect_equal(c(table(curves$curve))[face$curves$curve],
               stats::setNames(face$curves$n, face$curves$curve))
  triangles <- utils::read.csv(shared_data("..", "spec", "face_triangles.csv"))
  first <- match(surface$place, surface$place)
  published <- matrix(first[as.matrix(triangles[c("v1", "v2", "v3")])], ncol = 3)
  expect_setequal(turned(as.matrix(face$triangles[c("v1", "v2", "v3")])), turned(published))
})

test_that("coinciding points of the model lie together on a real face", {
  reference <- utils::read.csv(shared_data("scan_a", "reference_surface.csv"))
  xyz <- as.matrix(reference[c("x", "y", "z")])
  gap <- sqrt(rowSums((xyz - xyz[match(surface$place, surface$place), ])^2))
  expect_lt(max(gap), 0.05)
  curves <- utils::read.csv(shared_data("scan_a", "reference_curves.csv"))
  points <- face$points[face$points$level == "curves", ]
  own <- match(paste(points$part, points$point), paste(curves$curve, curves$point))
  at <- match(surface$place, points$place)
  gap <- sqrt(rowSums((xyz - as.matrix(curves[own[at], c("x", "y", "z")]))^2))
  expect_equal(sum(!is.na(gap)), 280)
  # the reference's own curves do not agree at stomion
  inside <- startsWith(surface$place, "curves|")
  expect_lt(max(gap[inside], na.rm = TRUE), 0.2)
})

test_that("37 of its 922 surface points are in no triangle, as the help of compare_groups() says", {
  triangles <- model_triangles(face_scheme(), FALSE)
  points <- sum(face_scheme()$points$level == "surface")
  expect_equal(c(points, sum(!seq_len(points) %in% triangles)), c(922, 37))
})
