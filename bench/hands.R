# Landmarks without hands: success, accuracy, confidence and time on real faces, whole and damaged; what is no face.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/hands.R [poses|accuracy|calibrated|curves|faceless|time ...]
#
# 19 landmarks (without t and oi), lengths in mm. A trial succeeds when the mean error over the landmarks that the scan still has is
# below 6 mm. Poses are random rotations; noise, decimation and shoulders differ from pose to pose.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
ears <- c("tL", "tR", "oiL", "oiR")
template <- face_template()

faces <- function(ids = NULL) {
  one <- function(id) {
    folder <- file.path(shared, id)
    at <- read_landmarks(file.path(folder, "landmarks.csv"))
    list(id = id, mesh = read_specimen(file.path(folder, "surface.ply"))$mesh, landmarks = at[!rownames(at) %in% ears, ])
  }
  all <- c(lapply(c("scan_a", "template_male"), one), simpop())
  names(all) <- vapply(all, `[[`, "", "id")
  if (is.null(ids)) all else all[ids]
}

simpop <- function() {
  table <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
  table <- table[!table$landmark %in% ears, ]
  lapply(split(table, table$id), function(rows) {
    id <- rows$id[1]
    file <- list.files(file.path(shared, "simpop"), sprintf("%s[.]ply$", sub("simpop_", "", id)), full.names = TRUE)[1]
    at <- as.matrix(rows[c("x", "y", "z")])
    rownames(at) <- rows$landmark
    list(id = as.character(id), mesh = suppressWarnings(read_specimen(file))$mesh, landmarks = at)
  })
}

# Left, up and out of a face.
axes_of <- function(at) {
  unit <- function(v) v / sqrt(sum(v^2))
  left <- unit(at["exL", ] - at["exR", ])
  up <- (at["exL", ] + at["exR", ] - at["chL", ] - at["chR", ]) / 2
  up <- unit(up - sum(up * left) * left)
  rbind(left, up, c(left[2] * up[3] - left[3] * up[2], left[3] * up[1] - left[1] * up[3], left[1] * up[2] - left[2] * up[1]))
}

keep <- function(face, inside) {
  number <- cumsum(inside)
  number[!inside] <- NA
  it <- matrix(number[face$mesh$it], 3)
  face$mesh <- structure(list(vb = face$mesh$vb[, inside], it = it[, !is.na(colSums(it))]), class = "mesh3d")
  face
}

in_axes <- function(face) axes_of(face$landmarks) %*% (face$mesh$vb[1:3, ] - face$landmarks["pn", ])

random_rotation <- function() {
  turn <- qr.Q(qr(matrix(rnorm(9), 3)))
  turn * sign(det(turn))
}

# What is done to a face; each returns the face, perhaps with `unit`.
damages <- list(
  whole = identity,
  metres = function(face) {
    face$mesh$vb[1:3, ] <- face$mesh$vb[1:3, ] / 1000
    face$unit <- 1000
    face
  },
  `inside out` = function(face) {
    face$mesh$it <- face$mesh$it[c(1, 3, 2), ]
    face$mesh$normals <- NULL
    face
  },
  `0.3 mm noise` = function(face) {
    face$mesh$vb[1:3, ] <- face$mesh$vb[1:3, ] + rep(rnorm(ncol(face$mesh$vb), sd = 0.3), each = 3) * face$mesh$normals[1:3, ]
    face
  },
  `5k vertices` = function(face) {
    if (ncol(face$mesh$vb) > 5000) face$mesh <- Rvcg::vcgQEdecim(face$mesh, tarface = 10000, silent = TRUE)
    face
  },
  shoulders = function(face) {
    ball <- Rvcg::vcgSphere(5)
    wave <- 1 + 0.05 * sin(5 * ball$vb[1, ] + runif(1, 0, 6)) * cos(4 * ball$vb[2, ])
    torso <- c(220, 110, 100) * ball$vb[1:3, ] * rep(wave, each = 3) + c(runif(1, -20, 20), -230, -60)
    neck <- c(60, 120, 60) * ball$vb[1:3, ] * rep(wave, each = 3) + c(0, -150, -90)
    n <- ncol(ball$vb)
    at <- in_axes(face)
    skin <- at[, at[2, ] > -90 | at[3, ] > -60]
    behind <- function(xyz) !(xyz[2, ] > -75 & xyz[3, ] > -90)
    extra <- cbind(torso, neck)
    it <- cbind(ball$it, ball$it + n)
    ok <- behind(extra)
    number <- cumsum(ok)
    number[!ok] <- NA
    it <- matrix(number[it], 3)
    it <- it[, !is.na(colSums(it))] + ncol(face$mesh$vb)
    placed <- crossprod(axes_of(face$landmarks), extra[, ok]) + face$landmarks["pn", ]
    face$mesh <- structure(list(vb = cbind(face$mesh$vb, rbind(placed, 1)), it = cbind(face$mesh$it, it)), class = "mesh3d")
    face
  },
  `nose cut out` = function(face) keep(face, sqrt(colSums((face$mesh$vb[1:3, ] - face$landmarks["pn", ])^2)) > 22),
  `one side cut off` = function(face) keep(face, in_axes(face)[1, ] > -22),
  `exact half` = function(face) keep(face, in_axes(face)[1, ] > 0)
)

posed <- function(face) {
  turn <- random_rotation()
  shift <- rnorm(3, sd = 200)
  face$landmarks <- t(turn %*% t(face$landmarks) + shift)
  face$mesh$vb[1:3, ] <- turn %*% face$mesh$vb[1:3, ] + shift
  if (!is.null(face$mesh$normals)) face$mesh$normals[1:3, ] <- turn %*% face$mesh$normals[1:3, ]
  face
}

# One trial: a row a landmark.
trial <- function(face, damage, pose, template) {
  set.seed(1000 * pose + match(damage, names(damages)))
  face <- damages[[damage]](posed(face))
  unit <- if (is.null(face$unit)) 1 else face$unit
  seconds <- system.time(found <- tryCatch(find_landmarks(face$mesh, template), crestline_error = function(e) e))[["user.self"]]
  row <- data.frame(face = face$id, damage = damage, pose = pose, seconds = seconds)
  if (inherits(found, "error")) return(cbind(row, landmark = NA, state = "refused", confidence = NA, error = NA, visible = NA, score = NA))
  placing <- found$placing[match(rownames(face$landmarks), found$placing$landmark), ]
  there <- as.matrix(crestline:::surface_points(face$mesh, face$landmarks / unit)[1:3]) * unit
  visible <- sqrt(rowSums((there - face$landmarks)^2)) < 1
  error <- sqrt(rowSums((as.matrix(placing[c("x", "y", "z")]) * unit - face$landmarks)^2))
  cbind(row, placing[c("landmark", "state", "confidence", "moved", "residual", "lost")], error = error, visible = visible, score = found$match$score,
        row.names = NULL)
}
