# The picture of README.md: Rvcg's humface with its curves, plain from the front, by shape index from the subject's left.
# Run from the project's root, crestline being installed: Rscript tools/readme-picture.R

library(crestline)

demo_file <- function(name) system.file("extdata", name, package = "crestline", mustWork = TRUE)

read_face <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  specimen(data$humface, read_landmarks(demo_file("humface_landmarks.csv")), id = "humface")
}

find_curve <- function(row, face) {
  region <- if (!is.na(row$keep_from)) keep_away(row$keep_from, row$keep_to)
  ridge_curve(face, row$from, row$to, row$kind, radius = row$radius, width = row$half_width, n = row$n, keep_away = region)
}

# The rotation that sets the face upright, seen from `round` radians towards its left.
upright_view <- function(landmarks, round) {
  unit <- function(v) v / sqrt(sum(v^2))
  across <- unit(landmarks["exL", ] - landmarks["exR", ])
  up <- colMeans(landmarks[c("exL", "exR"), ]) - colMeans(landmarks[c("chL", "chR"), ])
  up <- unit(up - sum(up * across) * across)
  out <- c(across[2] * up[3] - across[3] * up[2], across[3] * up[1] - across[1] * up[3],
           across[1] * up[2] - across[2] * up[1])
  rbind(cos(round) * across - sin(round) * out, up, sin(round) * across + cos(round) * out)
}

draw_readme <- function(file, radius = 7) {
  face <- read_face()
  rows <- utils::read.csv(demo_file("demo_curves.csv"), na.strings = "")
  curves <- lapply(split(rows, seq_len(nrow(rows))), find_curve, face = face)
  grDevices::png(file, width = 940, height = 550, res = 80, type = "cairo")
  on.exit(grDevices::dev.off())
  graphics::layout(t(1:2), widths = c(1, 1.22))
  plot_curves(curves, face, "plain", points = FALSE, legend = FALSE, engine = "picture", view = upright_view(face$landmarks, 0))
  plot_curves(curves, face, "shape index", points = FALSE, engine = "picture", view = upright_view(face$landmarks, 0.65),
              curvature = curvature(face, radius))
}

draw_readme(file.path("man", "figures", "README-face.png"))
