# Expected tracks: what learn_tracks() mends, what it costs the curves that were right, and whether
# tracks of one population serve another.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/tracks.R FOLDER [faces]
#
# Shapes are kept in FOLDER, so that a run goes on where it stopped. Pictures of the curves that
# move are written there (without the tracks red, with them blue).
#
# Faces of vignette("sexual-dimorphism"), of which one has its left brow ridge across the forehead:
# noise 0.1 mm, landmarks 0.3 mm off. Each face is measured without tracks, and with tracks learnt
# from the other faces. Distance of a curve from the truth: RMS of curve_distance(between =
# "curves"), mm. Then the tracks of 23 faces of simpop on these.

library(crestline)

folder <- commandArgs(TRUE)[1]
n <- as.integer(c(commandArgs(TRUE)[-1], 24)[1])
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
scan <- scan_settings(noise = 0.1, landmark_error = 0.3)
faces <- simulate_faces(n, effect = 3, size_effect = 0.03, scan = scan, seed = 1)
model <- fit_shape(faces$template, settings = ridge_settings(error = FALSE), progress = FALSE)
truth <- true_points(faces, coords(model, "curves"))
kept <- function(how, id, code) {
  file <- file.path(folder, sprintf("%s-%s.rds", how, id))
  if (!file.exists(file)) saveRDS(suppressWarnings(code), file)
  readRDS(file)
}
measure <- function(id, scheme, how) {
  kept(how, id, fit_shape(faces$specimens[[id]], scheme, progress = FALSE))
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

# Every curve that moves by more than 0.3 mm: its surroundings, shaded and coloured by curvature.
pictures <- function(how, before, after, least = 0.3) {
  for (id in names(before)) {
    curves <- before[[id]]$scheme$curves
    curves <- curves$curve[curves$kind != "plane" & curves$n > 2]
    moved <- curve_distance(before[[id]], coords(after[[id]], "curves"), between = "curves")
    for (part in moved$part[moved$max > least & moved$part %in% curves]) {
      picture(sprintf("%s-%s-%s", how, id, gsub(" ", "_", part)), before[[id]], after[[id]], part)
    }
  }
}

picture <- function(name, before, after, part) {
  lines <- lapply(list(before, after), function(shape) {
    as.matrix(as.data.frame(shape$paths[[part]])[c("x", "y", "z")])
  })
  around <- do.call(rbind, lines)
  around <- rbind(around, sweep(around, 2, 12, `+`), sweep(around, 2, 12, `-`))
  grDevices::png(file.path(folder, paste0(name, ".png")), 1400, 700, res = 100)
  graphics::par(mfrow = c(1, 2))
  for (colour in c("plain", "curvature")) {
    scene <- plot(before$specimen, colour, 5, "picture", landmarks = FALSE, legend = FALSE,
                  main = name, around = around)
    scene <- draw_lines(scene, lines[[1]], "#C8102E", 2)
    scene <- draw_lines(scene, lines[[2]], "#16218C", 2)
  }
  grDevices::dev.off()
}

plain <- lapply(stats::setNames(nm = ids), measure, face_scheme(), "plain")
own <- lapply(stats::setNames(nm = ids),
              function(id) measure(id, learn_tracks(plain[setdiff(ids, id)]), "own"))
compare("tracks of the other simulated faces", plain, own)
pictures("own", plain, own)
was <- graded(plain)
wrong <- away(plain)
wrong <- wrong[order(-wrong$rms), ][1, ]
cat(sprintf("the wrong one: %s of %s\n", wrong$part, wrong$id))
print(rbind(cbind(tracks = "without", was[was$specimen == wrong$id & was$part == wrong$part, ]),
            cbind(tracks = "with",
                  graded(own) |> subset(specimen == wrong$id & part == wrong$part))),
      row.names = FALSE)

from <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
placed <- utils::read.csv(file.path(from, "landmarks.csv"))
simpop <- lapply(stats::setNames(nm = unique(placed$id)), function(id) {
  rows <- placed[placed$id == id, ]
  landmarks <- as.matrix(data.frame(rows[c("x", "y", "z")], row.names = rows$landmark))
  kept("simpop", id, fit_shape(read_specimen(file.path(from, paste0(id, ".ply")), landmarks,
                                             id = id), progress = FALSE))
})
learnt <- learn_tracks(simpop)
other <- lapply(stats::setNames(nm = ids), measure, learnt, "other")
compare("tracks of simpop on the simulated faces", plain, other)
pictures("other", plain, other)
off <- graded(other)
cat("curves of a face beyond 4 spreads:", tapply(off$track > 4, off$specimen, sum, na.rm = TRUE),
    "\n")
print(tapply(off$track > 4, off$part, mean)[unique(learnt$tracks$curve)], digits = 2)
again <- lapply(stats::setNames(nm = names(simpop)), function(id) {
  scheme <- learn_tracks(simpop[setdiff(names(simpop), id)])
  kept("again", id, fit_shape(simpop[[id]]$specimen, scheme, progress = FALSE))
})
pictures("again", simpop, again)
moved <- unlist(Map(function(a, b) {
  each <- curve_distance(a, coords(b, "curves"), between = "curves")
  each$max[each$part %in% unique(learnt$tracks$curve)]
}, simpop, again))
grade <- graded(again)
cat(sprintf(paste("simpop, tracks of the other faces: %d curves, moved by at most %.2f mm (%d by",
                  "more than 0.3); flagged %d\n"),
            length(moved), max(moved), sum(moved > 0.3), sum(grade$track > 4, na.rm = TRUE)))
