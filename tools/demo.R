# The main job of `make demo`: ridges and valleys of one real face, from landmarks to table, CSV, picture and page.
# Run from anywhere, crestline being installed: Rscript tools/demo.R [folder for the output, default demo-output]

options(rgl.useNULL = TRUE) # no display is needed
library(crestline)

demo_file <- function(name) system.file("extdata", name, package = "crestline", mustWork = TRUE)

# Rvcg's humface with the 23 landmarks of inst/extdata/humface_landmarks.csv.
demo_specimen <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  specimen(data$humface, read_landmarks(demo_file("humface_landmarks.csv")), id = "humface")
}

demo_curves <- function() utils::read.csv(demo_file("demo_curves.csv"), na.strings = "")

# The curve of one row of the table.
demo_curve <- function(row, face) {
  region <- if (!is.na(row$keep_from)) keep_away(row$keep_from, row$keep_to)
  ridge_curve(face, row$from, row$to, type = row$kind, radius = row$radius, width = row$half_width,
              n = row$n, keep_away = region)
}

# All curves, with seconds and warnings, and a line for each as it is done.
estimate_curves <- function(rows, face) {
  cat(sprintf("%-24s %-7s %7s %9s %7s %10s %11s %8s\n", "curve", "kind", "length", "strength", "error",
              "converged", "determined", "seconds"))
  warned <- character()
  curves <- lapply(split(rows, seq_len(nrow(rows))), function(row) {
    seconds <- system.time(curve <- withCallingHandlers(demo_curve(row, face), warning = function(w) {
      warned <<- c(warned, paste0(row$curve, ": ", gsub("\n", " ", conditionMessage(w))))
      invokeRestart("muffleWarning")
    }))[["elapsed"]]
    line <- curve_row(row$curve, curve, seconds)
    cat(sprintf("%-24s %-7s %7.1f %9.3f %7.2f %10s %11s %8.2f\n", line$curve, line$kind, line$length, line$strength,
                line$standard_error, line$converged, line$determined, line$seconds))
    list(curve = curve, row = line)
  })
  list(curves = stats::setNames(lapply(curves, `[[`, "curve"), rows$curve),
       table = do.call(rbind, lapply(curves, `[[`, "row")), warnings = warned)
}

# What the table says of one curve; the standard error is the median along it, ends left out.
curve_row <- function(name, curve, seconds) {
  data.frame(curve = name, kind = curve$type, length = curve$length, strength = curve$strength,
             standard_error = curve$se,
             converged = curve$converged, determined = curve$determined, seconds = seconds)
}

# Every curve's points in one table.
curve_points <- function(curves) {
  do.call(rbind, Map(function(name, curve) cbind(curve = name, as.data.frame(curve)), names(curves), curves))
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

# From the front and from both sides, without a display.
write_picture <- function(file, curves, face, bending) {
  grDevices::png(file, width = 2400, height = 1000, res = 150, type = "cairo")
  on.exit(grDevices::dev.off())
  graphics::layout(t(1:3), widths = c(1, 1, 1.3))
  for (round in c(-0.7, 0, 0.7)) {
    plot_curves(curves, face, surface = "shape index", curvature = bending, engine = "picture",
                view = face_view(face$landmarks, round), legend = round > 0)
  }
}

# The pictures show the shape index at `picture_radius`, in mm: between the radii of lips and of brows.
run_demo <- function(folder, picture_radius = 7) {
  dir.create(folder, showWarnings = FALSE, recursive = TRUE)
  cat("crestline", format(utils::packageVersion("crestline")), "on Rvcg's humface\n\n")
  face <- demo_specimen()
  print(face)
  cat("\nLengths in mm, strength (mean curvature of the kind sought along the curve) in 1/mm, error: median standard error across the curve in mm\n")
  rows <- demo_curves()
  estimates <- estimate_curves(rows, face)
  if (length(estimates$warnings)) cat("\nWarnings\n", paste0("- ", estimates$warnings, "\n"), sep = "")
  files <- file.path(folder, c("curves.csv", "points.csv", "face.png", "face.html"))
  utils::write.csv(estimates$table, files[1], row.names = FALSE)
  utils::write.csv(curve_points(estimates$curves), files[2], row.names = FALSE)
  bending <- curvature(face$mesh, radius = picture_radius)
  write_picture(files[3], estimates$curves, face, bending)
  write_page(files[4], face, estimates$curves, table = estimates$table, curvature = bending,
             view = face_view(face$landmarks), title = "Ridges and valleys of Rvcg's humface")
  cat("\nWritten\n", paste0("  ", normalizePath(files), "\n"), sep = "")
}

arguments <- commandArgs(trailingOnly = TRUE)
run_demo(if (length(arguments)) arguments[1] else "demo-output")
