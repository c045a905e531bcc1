# The main job of `make demo`: the whole model of one real face, from the raw mesh to tables,
# pictures and pages.
# Run from anywhere, crestline being installed: Rscript tools/demo.R [folder for the output, default
# demo-output]

options(rgl.useNULL = TRUE) # no display is needed
library(crestline)

# Rvcg's humface, its landmarks found by the built-in template.
demo_specimen <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  find_landmarks(data$humface, id = "humface")
}

# How far the found landmarks are from those placed by hand in inst/extdata/humface_landmarks.csv.
print_placing <- function(face) {
  placed <- read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline",
                                       mustWork = TRUE))
  placing <- face$placing[match(rownames(placed), face$placing$landmark), ]
  off <- sqrt(rowSums((as.matrix(placing[c("x", "y", "z")]) - placed)^2))
  cat(sprintf(paste("\nLandmarks found without hands, and their distance in mm from those",
                    "placed by hand (score %.2f)\n"), face$match$score))
  print(data.frame(placing[c("landmark", "state")], confidence = round(placing$confidence, 2),
                   distance = round(off, 2)), row.names = FALSE)
  found <- placing$state == "found"
  cat(sprintf("mean of the %d found: %.2f mm\n", sum(found), mean(off[found])))
  cat("The template contains this face. Other faces are found to 1.5 to 2 mm: bench/finder.md.\n")
}

# The rotation that sets the face upright, seen from `round` radians towards its left.
face_view <- function(landmarks, round = 0) {
  unit <- function(v) v / sqrt(sum(v^2))
  across <- unit(landmarks["exL", ] - landmarks["exR", ])
  up <- colMeans(landmarks[c("exL", "exR"), ]) - colMeans(landmarks[c("chL", "chR"), ])
  up <- unit(up - sum(up * across) * across)
  out <- c(across[2] * up[3] - across[3] * up[2], across[3] * up[1] - across[1] * up[3],
           across[1] * up[2] - across[2] * up[1])
  rbind(cos(round) * across - sin(round) * out, up, sin(round) * across + cos(round) * out)
}

# Curves over shape index above, the surface model below, from the front and both sides.
write_picture <- function(file, shape, face, bending) {
  grDevices::png(file, width = 2400, height = 1800, res = 150, type = "cairo")
  on.exit(grDevices::dev.off())
  graphics::layout(matrix(1:6, 2, byrow = TRUE), widths = c(1, 1, 1.3))
  turns <- c(-0.7, 0, 0.7)
  for (round in turns) {
    plot(shape, face, engine = "picture", view = face_view(face$landmarks, round),
         curvature = bending,
         patches = FALSE, legend = round > 0)
  }
  for (round in turns) plot(shape, engine = "picture", view = face_view(face$landmarks, round),
                            points = FALSE)
}

print_table <- function(shape, graded) {
  curves <- graded[graded$level == "curves", ]
  numbers <- c("length", "strength", "contrast", "se", "competing")
  shown <- cbind(curves[c("part", "kind")], signif(curves[numbers], 3),
                 grade = as.character(curves$grade))
  print(shown, row.names = FALSE)
  said <- graded[graded$grade != "green", ]
  if (nrow(said)) cat("\nNot green\n",
                      strwrap(paste0(said$part, ": ", said$why), 118, indent = 2, exdent = 4,
                              prefix = "\n"), "\n", sep = "")
}

# The pictures show the shape index at `picture_radius`, in mm: between the radii of lips and of
# brows.
run_demo <- function(folder, picture_radius = 7) {
  dir.create(folder, showWarnings = FALSE, recursive = TRUE)
  cat("crestline", format(utils::packageVersion("crestline")), "on Rvcg's humface\n\n")
  finding <- system.time(face <- demo_specimen())[["elapsed"]]
  print(face)
  print_placing(face)
  cat(sprintf("Found in %.1f s\n", finding))
  seconds <- system.time(shape <- fit_shape(face, face_scheme()))[["elapsed"]]
  cat(sprintf("\nMeasured in %.1f s\n", seconds))
  print(shape)
  cat(paste("\nLengths in mm, strength (mean curvature of the kind sought along the curve) in",
            "1/mm, se (median standard error across) in mm\n"))
  print_table(shape, quality(shape))
  files <- file.path(folder,
                     c("curves.csv", "points.csv", "model.ply", "face.png", "face.html",
                       "quality.html"))
  utils::write.csv(shape$status[shape$status$level == "curves", ], files[1], row.names = FALSE)
  utils::write.csv(as.data.frame(shape), files[2], row.names = FALSE)
  write_mesh(shape, files[3])
  bending <- curvature(face$mesh, radius = picture_radius)
  write_picture(files[4], shape, face, bending)
  write_page(face, files[5], shape, curvature = bending, view = face_view(face$landmarks),
             title = "Ridges, valleys and surface model of Rvcg's humface")
  quality_report(shape, files[6], specimens = list(face))
  cat("\nWritten\n", paste0("  ", normalizePath(files), "\n"), sep = "")
}

arguments <- commandArgs(trailingOnly = TRUE)
run_demo(if (length(arguments)) arguments[1] else "demo-output")
