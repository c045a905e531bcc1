# Our curves beside the authors' on two real faces: distances and gathered strength.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/faces.R [preset]
#
# For every ridge and valley: RMS and largest distance (mm) of the authors' points from our curve, mean
# strength along ours over that along theirs (principal curvature, the same estimates for both; trapezoid
# over 200 places), median standard error (mm), converged, determined. For every plane curve that does not end at the
# ear: the same distances, and how far the authors' own points lie from the mesh they are compared on.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
preset <- c(commandArgs(TRUE), "crestline")[1]
settings <- ridge_settings(preset)
curves <- read.csv(file.path(dirname(shared), "spec", "face_curves.csv"))

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
  face <- suppressWarnings(read_specimen(file.path(folder, "surface.ply"), file.path(folder, "landmarks.csv"), id = id))
  list(face = face, reference = read.csv(file.path(folder, "reference_curves.csv")),
       curved = lapply(c("5" = 5, "10" = 10), function(r) curvature(face, r, settings$order)))
}

authors_points <- function(case, curve) {
  as.matrix(case$reference[case$reference$curve == curve, c("x", "y", "z")])
}

# An end without a landmark (the template has no ears) is the authors' own.
end_of <- function(case, name, point) if (name %in% rownames(case$face$landmarks)) name else point

by_curvature <- function(case, row) {
  theirs <- authors_points(case, row$curve)
  side <- substring(row$from, nchar(row$from))
  region <- if (startsWith(row$curve, "brow")) keep_away(paste0("ex", side), paste0("en", side))
  curved <- case$curved[[as.character(row$radius_mm)]]
  ours <- suppressWarnings(ridge_curve(case$face, end_of(case, row$from, theirs[1, ]), row$to, row$kind, row$radius_mm,
                                       row$half_width_mm, row$n, region, settings, curvature = curved))
  track <- as.matrix(ours$path[c("x", "y", "z")])
  if (!is.na(row$ear_cut)) track <- track[which.min(rowSums(sweep(track, 2, theirs[1, ])^2)):nrow(track), ]
  d <- distance_to_path(theirs, ours$path)
  data.frame(face = case$face$id, curve = row$curve, rms = sqrt(mean(d^2)), max = max(d),
             strength_ratio = mean_strength(case$face, curved, row$kind, track) /
               mean_strength(case$face, curved, row$kind, theirs),
             se = ours$se, converged = ours$converged, determined = ours$determined)
}

by_plane <- function(case, row) {
  theirs <- authors_points(case, row$curve)
  d <- distance_to_path(theirs, suppressWarnings(reference_path(case$face, row$from, row$to, "plane")))
  off <- sqrt(rowSums((theirs - as.matrix(crestline:::surface_points(case$face$mesh, theirs)[1:3]))^2))
  data.frame(face = case$face$id, curve = row$curve, rms = sqrt(mean(d^2)), max = max(d), authors_off_mesh = max(off))
}

each <- function(case, rows, f) do.call(rbind, lapply(split(rows, factor(rows$curve, rows$curve)), function(row) f(case, row)))
show <- function(table) {
  numbers <- vapply(table, is.numeric, NA)
  table[numbers] <- lapply(table[numbers], round, 3)
  print(table, row.names = FALSE)
}

cases <- lapply(c("scan_a", "template_male"), face_of)
found <- do.call(rbind, lapply(cases, each, curves[curves$kind != "plane", ], by_curvature))
cat("Ridges and valleys, settings \"", preset, "\"\n", sep = "")
show(found)
lips <- grepl("lip", found$curve)
cat(sprintf("mean RMS %.2f mm, lips at most %.2f mm; strength ratio %.3f in the mean, %.3f at least\n\n", mean(found$rms),
            max(found$rms[lips]), mean(found$strength_ratio), min(found$strength_ratio)))
cat("Plane curves that do not end at the ear\n")
show(do.call(rbind, lapply(cases, each, curves[curves$kind == "plane" & is.na(curves$ear_cut), ], by_plane)))
