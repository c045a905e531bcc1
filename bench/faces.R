# Our curves beside the authors' on two real faces: distances and gathered strength.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/faces.R [preset]
#
# For every curve that face_scheme() finds by curvature: RMS and largest distance (mm) of the
# authors' points from our curve, mean strength along ours over that along theirs (principal
# curvature, the same estimates for both; trapezoid over 200 places), median standard error (mm),
# whether it counts as determined. For every plane curve: the same distances, and how far the
# authors' own points lie from the mesh they are compared on.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
preset <- c(commandArgs(TRUE), "crestline")[1]
settings <- ridge_settings(preset)
scheme <- face_scheme()

distance_to_path <- function(points, path) {
  track <- as.matrix(path[c("x", "y", "z")])
  a <- track[-nrow(track), , drop = FALSE]
  step <- diff(track)
  apply(points, 1, function(p) {
    rel <- sweep(-a, 2, p, `+`)
    along <- pmin(pmax(rowSums(rel * step) / rowSums(step^2), 0), 1)
    sqrt(min(rowSums((rel - along * step)^2)))
  })
}

evenly <- function(points, m = 200) {
  s <- c(0, cumsum(sqrt(rowSums(diff(points)^2))))
  apply(points, 2, function(x) approx(s, x, seq(0, max(s), length.out = m))$y)
}

mean_strength <- function(face, curved, type, points) {
  at <- crestline:::surface_points(face$mesh, evenly(points))
  value <- crestline:::strength_at(curved, type)
  value[is.na(value)] <- 0
  corner <- function(i) value[face$mesh$it[i, at$face]]
  mean(at$w1 * corner(1) + at$w2 * corner(2) + at$w3 * corner(3))
}

face_of <- function(id) {
  folder <- file.path(shared, id)
  face <- suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                         file.path(folder, "landmarks.csv"), id = id))
  case <- list(face = face, reference = read.csv(file.path(folder, "reference_curves.csv")),
               curved = lapply(c("5" = 5, "10" = 10),
                               function(r) curvature(face, r, settings$order)))
  case$ears <- "tL" %in% rownames(face$landmarks)
  case$curves <- scheme$curves
  if (!case$ears) case <- with_brow_ends(case)
  case$shape <- fit_shape(case$face, curve_scheme(scheme$landmarks, case$curves), settings,
                          progress = FALSE)
  case
}

# Where there are no ears (the template), the brows start where the authors' do, and no other curve
# from the ear is found.
with_brow_ends <- function(case) {
  ends <- rbind(tL = authors_points(case, "brow ridge left")[1, ],
                tR = authors_points(case, "brow ridge right")[1, ])
  ends[] <- as.matrix(crestline:::surface_points(case$face$mesh, ends)[c("x", "y", "z")])
  case$face$landmarks <- rbind(case$face$landmarks, ends)
  case$curves <- case$curves[is.na(case$curves$cut_share) | startsWith(case$curves$curve, "brow"), ]
  case$curves[c("cut_share", "cut_from", "cut_to")] <- NA
  case
}

authors_points <- function(case, curve) {
  as.matrix(case$reference[case$reference$curve == curve, c("x", "y", "z")])
}

by_curvature <- function(case, row) {
  theirs <- authors_points(case, row$curve)
  curved <- case$curved[[as.character(row$radius)]]
  path <- case$shape$paths[[row$curve]]
  d <- distance_to_path(theirs, path)
  status <- case$shape$status[case$shape$status$part == row$curve, ]
  strength <- function(points) mean_strength(case$face, curved, row$kind, points)
  data.frame(face = case$face$id, curve = row$curve, authors = row$authors_kind,
             rms = sqrt(mean(d^2)), max = max(d),
             strength_ratio = strength(as.matrix(as.data.frame(path)[c("x", "y", "z")])) /
               strength(theirs), se = status$se,
             determined = case$shape$checks$determined[case$shape$checks$part == row$curve])
}

by_plane <- function(case, row) {
  theirs <- authors_points(case, row$curve)
  d <- distance_to_path(theirs, case$shape$paths[[row$curve]])
  off <-
    sqrt(rowSums((theirs - as.matrix(crestline:::surface_points(case$face$mesh, theirs)[1:3]))^2))
  data.frame(face = case$face$id, curve = row$curve, rms = sqrt(mean(d^2)), max = max(d),
             authors_off_mesh = max(off))
}

each <- function(case, plane, f) {
  rows <- case$curves[(case$curves$kind == "plane") == plane, ]
  do.call(rbind, lapply(seq_len(nrow(rows)), function(i) f(case, rows[i, ])))
}
show <- function(table) {
  numbers <- vapply(table, is.numeric, NA)
  table[numbers] <- lapply(table[numbers], round, 3)
  print(table, row.names = FALSE)
}

cases <- lapply(c("scan_a", "template_male"), face_of)
found <- do.call(rbind, lapply(cases, each, FALSE, by_curvature))
cat("By curvature, settings \"", preset, "\"\n", sep = "")
show(found)
both <- found[found$authors != "plane", ]
lips <- grepl("lip", both$curve)
cat(sprintf("those that the authors find by curvature: mean RMS %.2f mm, lips at most %.2f mm; ",
            mean(both$rms), max(both$rms[lips])))
cat(sprintf("strength ratio %.3f in the mean, %.3f at least\n\n", mean(both$strength_ratio),
            min(both$strength_ratio)))
cat("Plane curves\n")
show(do.call(rbind, lapply(cases, each, TRUE, by_plane)))
