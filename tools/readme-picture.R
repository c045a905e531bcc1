# The pictures of README.md: Rvcg's humface with its curves, over shape index, and the surface model
# between them; and what the README's ten lines draw.
# Run from the project's root, crestline being installed: Rscript tools/readme-picture.R

library(crestline)

read_face <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  file <- system.file("extdata", "humface_landmarks.csv", package = "crestline", mustWork = TRUE)
  specimen(data$humface, read_landmarks(file), id = "humface")
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
  shape <- fit_shape(face, face_scheme(), progress = FALSE)
  grDevices::jpeg(file, width = 902, height = 426, res = 66, quality = 60, type = "cairo")
  on.exit(grDevices::dev.off())
  graphics::layout(t(1:3), widths = c(1, 1, 1.24))
  view <- function(round) upright_view(face$landmarks, round)
  plot(shape, face, surface = "plain", patches = FALSE, band = FALSE, engine = "picture",
       view = view(0), legend = FALSE)
  plot(shape, points = FALSE, engine = "picture", view = view(0.35))
  plot(shape, face, patches = FALSE, engine = "picture", view = view(0.65),
       curvature = curvature(face, radius))
}

draw_readme(file.path("man", "figures", "README-face.jpg"))

# The last of the README's ten lines.
draw_lines_of_readme <- function(file) {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  face <- find_landmarks(data$humface, id = "humface")
  shape <- fit_shape(face, face_scheme(), progress = FALSE)
  grDevices::jpeg(file, width = 476, height = 366, res = 56, quality = 60, type = "cairo")
  on.exit(grDevices::dev.off())
  plot(shape, face, engine = "picture", view = t(face$match$rotation))
}

draw_lines_of_readme(file.path("man", "figures", "README-lines.jpg"))
