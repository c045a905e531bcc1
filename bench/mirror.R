# Whether the mirror image of a face, left and right exchanged, has the mirror image of its model.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/mirror.R
#
# The mesh is mirrored in x and its triangles turned round; then also the corners of every triangle
# are begun at random and the triangles shuffled. "gap": greatest distance between a point of the
# model and the mirrored one of the other, over points of all levels; "share": the same over the
# diagonal of the mesh; "missing": points that only one of them has.

library(crestline)

scheme <- face_scheme()
settings <- ridge_settings(error = FALSE)
xyz <- c("x", "y", "z")

shared_face <- function(id) {
  folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), id)
  suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                 file.path(folder, "landmarks.csv"), id = id))
}

humface_face <- function() {
  data(humface, package = "Rvcg", envir = environment())
  specimen(humface,
           read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline")),
           id = "humface")
}

partner <- function(names, level) {
  pairs <- scheme$pairs[scheme$pairs$level == level, ]
  other <- c(pairs$right, pairs$left)[match(names, c(pairs$left, pairs$right))]
  ifelse(is.na(other), names, other)
}

turned <- function(corners) {
  first <- sample(0:2, ncol(corners), TRUE)
  rows <- outer(0:2, first, `+`) %% 3 + 1
  matrix(corners[cbind(as.vector(rows), rep(seq_len(ncol(corners)), each = 3))], 3)
}

mirrored <- function(face, shuffled) {
  corners <- face$mesh$it[c(1, 3, 2), ]
  if (shuffled) corners <- turned(corners)[, sample(ncol(corners))]
  mesh <- rgl::mesh3d(vertices = face$mesh$vb * c(-1, 1, 1, 1), triangles = corners)
  landmarks <- face$landmarks * rep(c(-1, 1, 1), each = nrow(face$landmarks))
  rownames(landmarks) <- partner(rownames(landmarks), "landmarks")
  suppressWarnings(specimen(mesh, landmarks, id = paste(face$id, "mirrored")))
}

model <- function(face) fit_shape(face, scheme, settings, progress = FALSE)$points

compare <- function(face, own, shuffled) {
  other <- model(mirrored(face, shuffled))
  key <- paste(own$level, own$part, own$point)
  part <- mapply(partner, other$part, other$level)
  other <- other[match(key, paste(other$level, part, other$point)), ]
  gap <- sqrt(rowSums((as.matrix(own[xyz]) - as.matrix(other[xyz]) *
                       rep(c(-1, 1, 1), each = nrow(own)))^2))
  diagonal <- sqrt(sum(apply(face$mesh$vb[1:3, ], 1, function(x) diff(range(x)))^2))
  data.frame(face = face$id, shuffled, points = sum(is.finite(gap)),
             missing = sum(is.na(own$x) != is.na(other$x)), gap = max(gap, na.rm = TRUE),
             share = max(gap, na.rm = TRUE) / diagonal, where = own$part[which.max(gap)])
}

set.seed(1)
rows <- lapply(list(shared_face("scan_a"), shared_face("template_male"), humface_face()),
               function(face) {
                 own <- model(face)
                 rbind(compare(face, own, FALSE), compare(face, own, TRUE))
               })
print(do.call(rbind, rows), row.names = FALSE)
