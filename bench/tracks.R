# Expected tracks: what learn_tracks() mends, what it costs the curves that were right, and whether
# tracks of one population serve another.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/tracks.R [faces]
#
# Faces of vignette("sexual-dimorphism"), of which one has its left brow ridge across the forehead:
# noise 0.1 mm, landmarks 0.3 mm off. Each face is measured without tracks, and with tracks learnt
# from the other faces. Distance of a curve from the truth: RMS of curve_distance(between =
# "curves"), mm. Then the tracks of 23 faces of simpop on these.

library(crestline)

n <- as.integer(c(commandArgs(TRUE), 24)[1])
scan <- scan_settings(noise = 0.1, landmark_error = 0.3)
faces <- simulate_faces(n, effect = 3, size_effect = 0.03, scan = scan, seed = 1)
model <- fit_shape(faces$template, settings = ridge_settings(error = FALSE), progress = FALSE)
truth <- true_points(faces, coords(model, "curves"))
measure <- function(id, scheme) {
  suppressWarnings(fit_shape(faces$specimens[[id]], scheme, progress = FALSE))
}
ids <- names(faces$specimens)

away <- function(shapes) {
  each <- lapply(names(shapes), function(id) {
    cbind(id = id,
          curve_distance(shapes[[id]], truth[, , id], between = "curves")[c("part", "rms")])
  })
  each <- do.call(rbind, each)
  each[each$part %in% face_scheme()$curves$curve, ]
}

graded <- function(shapes) {
  table <- as.data.frame(quality(shapes))
  table[table$level == "curves", c("specimen", "part", "kind", "track", "grade", "why")]
}

compare <- function(title, before, after) {
  table <- merge(away(before), away(after), by = c("id", "part"), suffixes = c("_before", "_after"))
  change <- table$rms_after - table$rms_before
  cat(sprintf(paste("%s: %d curves, %d changed by more than 0.01 mm; worse by more than 0.3 mm:",
                    "%d; better by more: %d\n"), title,
              nrow(table), sum(abs(change) > 0.01), sum(change > 0.3), sum(change < -0.3)))
  print(table[abs(change) > 0.3, ], row.names = FALSE, digits = 3)
  grade <- graded(after)
  cat(sprintf("left their track by more than 4 spreads: %d of %d; 99 %% within %.1f spreads\n",
              sum(grade$track > 4, na.rm = TRUE), sum(!is.na(grade$track)),
              stats::quantile(grade$track, 0.99, na.rm = TRUE)))
}

plain <- lapply(stats::setNames(nm = ids), measure, face_scheme())
own <- lapply(stats::setNames(nm = ids),
              function(id) measure(id, learn_tracks(plain[setdiff(ids, id)])))
compare("tracks of the other simulated faces", plain, own)
was <- graded(plain)
wrong <- away(plain)
wrong <- wrong[order(-wrong$rms), ][1, ]
cat(sprintf("the wrong one: %s of %s\n", wrong$part, wrong$id))
print(rbind(cbind(tracks = "without", was[was$specimen == wrong$id & was$part == wrong$part, ]),
            cbind(tracks = "with",
                  graded(own) |> subset(specimen == wrong$id & part == wrong$part))),
      row.names = FALSE)

folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
placed <- utils::read.csv(file.path(folder, "landmarks.csv"))
simpop <- lapply(stats::setNames(nm = unique(placed$id)), function(id) {
  rows <- placed[placed$id == id, ]
  landmarks <- as.matrix(data.frame(rows[c("x", "y", "z")], row.names = rows$landmark))
  face <- suppressWarnings(read_specimen(file.path(folder, paste0(id, ".ply")), landmarks, id = id))
  suppressWarnings(fit_shape(face, progress = FALSE))
})
learnt <- learn_tracks(simpop)
other <- lapply(stats::setNames(nm = ids), measure, learnt)
compare("tracks of simpop on the simulated faces", plain, other)
off <- graded(other)
print(tapply(off$track > 4, off$part, mean)[unique(learnt$tracks$curve)], digits = 2)
again <- lapply(stats::setNames(nm = names(simpop)), function(id) {
  scheme <- learn_tracks(simpop[setdiff(names(simpop), id)])
  suppressWarnings(fit_shape(simpop[[id]]$specimen, scheme, progress = FALSE))
})
moved <- unlist(Map(function(a, b) {
  each <- curve_distance(a, coords(b, "curves"), between = "curves")
  each$max[each$part %in% unique(learnt$tracks$curve)]
}, simpop, again))
grade <- graded(again)
cat(sprintf(paste("simpop, tracks of the other faces: %d curves, moved by at most %.2f mm (%d by",
                  "more than 0.3); flagged %d\n"),
            length(moved), max(moved), sum(moved > 0.3), sum(grade$track > 4, na.rm = TRUE)))
