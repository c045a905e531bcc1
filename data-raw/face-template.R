# The face that landmarks are found by: the mean of Rvcg's dummyhead and humface, symmetric, with 23
# landmarks.
#
#   Rscript data-raw/face-template.R      (crestline being installed)
#
# Reads inst/extdata/dummyhead_landmarks.csv and humface_landmarks.csv (inst/extdata/README.md says
# how they were placed), writes inst/extdata/face_template/mesh.ply and landmarks.csv. The head's
# triangles are kept; each vertex goes half of its way to the face.

library(crestline)
internal <- asNamespace("crestline")

ears <- c("tL", "tR", "oiL", "oiR")
extdata <- function(file) file.path("inst", "extdata", file)

scan_of <- function(name, mesh) {
  data <- new.env()
  utils::data(list = mesh[1], package = "Rvcg", envir = data)
  suppressWarnings(specimen(data[[mesh[2]]],
                            read_landmarks(extdata(paste0(name, "_landmarks.csv"))), id = name))
}

# The part of the head that face scans have: before the ears, above the throat, below the crown (mm
# from the nose tip).
face_part <- function(head, depth = 95, low = -85, high = 105) {
  nose <- head$landmarks["pn", ]
  eyes <- colMeans(head$landmarks[c("exL", "exR"), ])
  mouth <- colMeans(head$landmarks[c("chL", "chR"), ])
  unit <- function(v) v / sqrt(sum(v^2))
  across <- unit(head$landmarks["exL", ] - head$landmarks["exR", ])
  up <- unit(eyes - mouth - sum((eyes - mouth) * across) * across)
  out <- internal$cross_product(across, up)
  at <- t(head$mesh$vb[1:3, ]) - rep(nose, each = ncol(head$mesh$vb))
  inside <- at %*% out > -depth & at %*% up > low & at %*% up < high
  internal$keep_vertices(head$mesh, drop(inside))
}

# Where the points of the head's frame lie on the face: rigid by landmarks, bent to the surface,
# then what landmarks still say.
onto_face <- function(template, face, points, length = 15, nugget = 0.05) {
  settings <- find_settings(points = 2500, warp_steps = 40)
  prepared <- internal$prepared_template(template, settings, 1)
  cloud <- internal$scan_cloud(face, 1, prepared$settings, 1)
  names <- rownames(template$landmarks)
  pose <- landmark_pose(template$landmarks, face$landmarks[names, ])
  local <- internal$cloud_in_frame(cloud, pose)
  to <- t(crossprod(matrix(pose[1:9], 3), t(face$landmarks[names, ]) - pose[10:12]))
  # The points ride along as landmarks do.
  prepared$landmarks <- rbind(template$landmarks, points)
  prepared$basis <- internal$warp_basis(rbind(t(prepared$xyz), prepared$landmarks),
                                        ncol(prepared$xyz), TRUE, prepared$settings)
  moved <- internal$fit_warp(prepared, local, prepared$settings,
                             prepared$settings$weight)$moved[-seq_len(ncol(prepared$xyz)), ]
  k <- length(names)
  kernel <- function(a, b) {
    exp(-pmax(outer(rowSums(a^2), rowSums(b^2), `+`) - 2 * tcrossprod(a, b), 0) / (2 * length^2))
  }
  weights <- solve(kernel(template$landmarks, template$landmarks) + diag(nugget, k),
                   to - moved[1:k, ])
  moved <- moved + kernel(prepared$landmarks, template$landmarks) %*% weights
  ears <- t(crossprod(matrix(pose[1:9], 3),
                      t(face$landmarks[rownames(template$predicted), ]) - pose[10:12]))
  list(landmarks = to, points = moved[-(1:k), ], ears = ears)
}

landmark_pose <- function(from, to) {
  a <- scale(from, scale = FALSE)
  b <- scale(to, scale = FALSE)
  parts <- svd(crossprod(b, a))
  rotation <- parts$u %*% diag(c(1, 1, sign(det(parts$u %*% t(parts$v))))) %*% t(parts$v)
  c(rotation, colMeans(to) - rotation %*% colMeans(from), 1)
}

# Mean with the mirror image in x = 0, partners by nearest place.
symmetric_vertices <- function(mesh) {
  mirrored <- t(mesh$vb[1:3, ]) %*% diag(c(-1, 1, 1))
  partner <- as.matrix(internal$surface_points(mesh, mirrored)[1:3]) %*% diag(c(-1, 1, 1))
  (t(mesh$vb[1:3, ]) + partner) / 2
}

symmetric_landmarks <- function(at) {
  side <- substr(rownames(at), nchar(rownames(at)), nchar(rownames(at)))
  partner <- ifelse(side == "L", sub("L$", "R", rownames(at)),
                    ifelse(side == "R", sub("R$", "L", rownames(at)), rownames(at)))
  (at + at[partner, ] %*% diag(c(-1, 1, 1))) / 2
}

head <- scan_of("dummyhead", c("dummyhead", "dummyhead.mesh"))
face <- scan_of("humface", c("humface", "humface"))
template <- landmark_template(head, predicted = ears, unit = 1)
template$specimen <- specimen(face_part(template$specimen), template$landmarks, id = "face")
vertex <- t(template$specimen$mesh$vb[1:3, ])
moved <- onto_face(template, face, vertex)

mesh <- template$specimen$mesh
mesh$vb[1:3, ] <- t((vertex + moved$points) / 2)
mesh$vb[1:3, ] <- t(symmetric_vertices(mesh))
both <- rbind(template$landmarks + moved$landmarks, template$predicted + moved$ears) / 2
landmarks <- symmetric_landmarks(both)
found <- setdiff(rownames(landmarks), ears)
landmarks[found, ] <- as.matrix(internal$surface_points(mesh, landmarks[found, ])[1:3])

# Upright: from the mouth's corners to the eyes' is y.
up <- colMeans(landmarks[c("exL", "exR"), ]) - colMeans(landmarks[c("chL", "chR"), ])
up <- up / sqrt(sum(up^2))
upright <- rbind(c(1, 0, 0), c(0, up[2], up[3]), c(0, -up[3], up[2]))
mesh$vb[1:3, ] <- upright %*% mesh$vb[1:3, ]
landmarks <- landmarks %*% t(upright)

folder <- extdata("face_template")
dir.create(folder, showWarnings = FALSE)
mesh <- specimen(mesh, id = "face")$mesh
ply <- tempfile(fileext = ".ply")
write_mesh(mesh, ply)
packed <- gzfile(file.path(folder, "mesh.ply.gz"), "wb", compression = 9)
writeBin(readBin(ply, "raw", file.size(ply)), packed)
close(packed)
colnames(landmarks) <- c("x", "y", "z")
utils::write.csv(data.frame(name = rownames(landmarks), round(landmarks, 4)),
                 file.path(folder, "landmarks.csv"), row.names = FALSE, quote = FALSE)
