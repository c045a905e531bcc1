# The whole model beside the authors': 40 curves of two faces, and the 922 surface points of scan_a.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/model.R [picture.png]
#
# Curves: RMS distance (mm) of the authors' points from our curve ("rms", "max"); the same after
# their points are put on the mesh ("on_mesh"); RMS of their distance from the mesh ("off").
# Ear-ended curves are compared where both are. Of plane curves above 0.1 mm also "best": "rms" of
# the cut that fits their points best, of the planes through their ends, up to 30 degrees from the
# surface's normal. Surface: RMS (mm) of our points from theirs of the same name, by patch: from
# their own curves, and from ours; the picture shows both.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
picture <- commandArgs(TRUE)[1]
settings <- ridge_settings(error = FALSE)
xyz <- c("x", "y", "z")
rms <- function(x) sqrt(mean(x^2, na.rm = TRUE))
lengths_of <- function(rows) sqrt(rowSums(rows^2))

case_of <- function(id) {
  folder <- file.path(shared, id)
  list(face = suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                             file.path(folder, "landmarks.csv"), id = id)),
       curves = attr(read_landmarks(file.path(folder, "reference_curves.csv")), "curves"),
       surface = read.csv(file.path(folder, "reference_surface.csv")))
}

distance_to_path <- function(points, path) {
  track <- as.matrix(as.data.frame(path)[xyz])
  a <- track[-nrow(track), , drop = FALSE]
  along <- diff(track)
  apply(points, 1, function(p) {
    rel <- sweep(-a, 2, p, `+`)
    share <- pmin(pmax(rowSums(rel * along) / rowSums(along^2), 0), 1)
    sqrt(min(lengths_of(rel - share * along)^2))
  })
}

# Where a face has no ear landmarks each ear-ended curve gets one of its own, the authors' end,
# which may lie off the mesh, and is cut a hundredth before it.
with_ear_ends <- function(case) {
  scheme <- face_scheme()
  curves <- scheme$curves
  own <- !curves$from %in% rownames(case$face$landmarks)
  ends <- t(vapply(case$curves[curves$curve[own]], function(at) at[1, ], numeric(3)))
  rownames(ends) <- curves$from[own] <- paste("end of", curves$curve[own])
  length <- vapply(case$curves[curves$curve[own]], function(at) sum(lengths_of(diff(at))), 0)
  span <- sqrt(sum((case$face$landmarks["enL", ] - case$face$landmarks["enR", ])^2))
  curves$cut_share[own] <- 0.99 * length / span
  case$face$landmarks <- rbind(case$face$landmarks, ends)
  landmarks <- rbind(scheme$landmarks[c("landmark", "name")],
                     data.frame(landmark = rownames(ends), name = NA))
  case$scheme <- curve_scheme(landmarks, curves, name = "face with its own ear ends")
  case
}

# The least distance of a curve's points from any plane cut through its ends.
best_cut <- function(face, row, points) {
  start <- crestline:::surface_points(face$mesh, points[1, , drop = FALSE])
  min(vapply((-30:30) * pi / 180, function(angle) {
    cut <- tryCatch(plane_path(face, start, row$to, angle, reach = 1),
                    crestline_error = function(e) NULL)
    if (is.null(cut)) Inf else rms(distance_to_path(points, cut))
  }, 0))
}

compare_curves <- function(case) {
  shape <- fit_shape(case$face, case$scheme, settings, progress = FALSE)
  rows <- lapply(case$scheme$curves$curve, function(curve) {
    row <- case$scheme$curves[case$scheme$curves$curve == curve, ]
    theirs <- case$curves[[curve]]
    on <- as.matrix(crestline:::surface_points(case$face$mesh, theirs)[xyz])
    off <- lengths_of(theirs - on)
    inside <- off < 2
    path <- shape$paths[[curve]]
    raw <- distance_to_path(theirs[inside, ], path)
    searched <- row$kind == "plane" && rms(raw) > 0.1
    data.frame(curve, kind = row$kind, ear = !is.na(row$cut_share), rms = rms(raw), max = max(raw),
               on_mesh = rms(distance_to_path(on[inside, ], path)), off = rms(off[inside]),
               best = if (searched) best_cut(case$face, row, theirs[inside, ]) else NA,
               points = sum(inside))
  })
  do.call(rbind, rows)
}

compare_surface <- function(case, curves = NULL) {
  shape <- fit_shape(case$face, face_scheme(), settings, curves = curves, progress = FALSE)
  at <- coords(shape, "surface")
  stopifnot(identical(rownames(at), paste(case$surface$patch, case$surface$index)))
  gap <- lengths_of(at - as.matrix(case$surface[xyz]))
  list(shape = shape, all = c(rms = rms(gap), max = max(gap, na.rm = TRUE)),
       patches = vapply(split(gap, factor(case$surface$patch, unique(case$surface$patch))), rms, 0))
}

show <- function(table, digits = 3) {
  numbers <- vapply(table, is.numeric, NA)
  table[numbers] <- lapply(table[numbers], round, digits)
  print(table, row.names = FALSE)
}

scan <- case_of("scan_a")
scan$scheme <- face_scheme()
for (case in list(scan, with_ear_ends(case_of("template_male")))) {
  cat("\n", case$face$id, "\n", sep = "")
  found <- compare_curves(case)
  show(found)
  by <- ifelse(found$kind != "plane", "ridges and valleys",
               ifelse(found$ear, "plane, to the ear", "plane"))
  show(do.call(rbind, lapply(split(found, by), function(x) {
    data.frame(curves = nrow(x), median = median(x$rms), worst = max(x$rms),
               worst_on_mesh = max(x$on_mesh), which = x$curve[which.max(x$rms)])
  })))
}

theirs <- compare_surface(scan, scan$curves)
ours <- compare_surface(scan)
cat(sprintf(paste("\n922 points of scan_a: from their curves RMS %.4f mm (worst %.3f), from ours",
                  "%.3f (worst %.2f)\n"),
            theirs$all[1], theirs$all[2], ours$all[1], ours$all[2]))
show(data.frame(patch = names(ours$patches), from_theirs = theirs$patches,
                from_ours = ours$patches))

# Three views of the model from their curves (above) and from ours.
if (!is.na(picture)) {
  grDevices::png(picture, 1800, 1300, res = 110)
  graphics::par(mfrow = c(2, 3), mar = c(0, 0, 2, 0))
  for (found in list(theirs, ours)) {
    for (view in c("front", "left", "right")) {
      plot(found$shape, surface = "patch", engine = "picture", view = view)
    }
  }
  invisible(grDevices::dev.off())
}
