# How far the curves of a face move when every landmark is moved by 1 mm at random.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/jitter.R [times] [face]
#
# Each time every landmark is moved by 1 mm in a direction that is uniform on the sphere and put
# back onto the mesh, and the whole model is fitted. Points between 20 and 80 % of a curve's length
# (by their number) are compared with the curve of the landmarks as they are: "away" is their
# distance from that curve, "moved" from the point of the same number. RMS over points and times in
# mm; "worst": the greatest RMS away of a single time; "jumps": times whose RMS away exceeds 1.5 mm.

library(crestline)

arguments <- commandArgs(TRUE)
times <- as.integer(c(arguments, 50)[1])
id <- c(arguments[-1], "scan_a")[1]
step <- 1
inner <- c(0.2, 0.8)
jump <- 1.5
folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), id)
face <- suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                       file.path(folder, "landmarks.csv"), id = id))
scheme <- face_scheme()

moved_landmarks <- function(face) {
  direction <- matrix(rnorm(length(face$landmarks)), ncol = 3)
  moved <- face$landmarks + step * direction / sqrt(rowSums(direction^2))
  moved[] <- as.matrix(crestline:::surface_points(face$mesh, moved)[c("x", "y", "z")])
  suppressWarnings(specimen(face$mesh, moved, id = face$id))
}

model <- function(face) fit_shape(face, scheme, ridge_settings(error = FALSE), progress = FALSE)

distance_to_path <- function(points, path) {
  track <- as.matrix(as.data.frame(path)[c("x", "y", "z")])
  a <- track[-nrow(track), , drop = FALSE]
  along <- diff(track)
  apply(points, 1, function(p) {
    rel <- sweep(-a, 2, p, `+`)
    share <- pmin(pmax(rowSums(rel * along) / rowSums(along^2), 0), 1)
    sqrt(min(rowSums((rel - share * along)^2)))
  })
}

inner_points <- function(shape, curve) {
  at <- coords(shape, "curves")[shape$points$part[shape$points$level == "curves"] == curve, ]
  share <- seq(0, 1, length.out = nrow(at))
  at[share >= inner[1] & share <= inner[2], , drop = FALSE]
}

still <- model(face)
curves <- scheme$curves$curve[scheme$curves$n > 2 & !vapply(still$paths, is.null, NA)]
set.seed(1)
shapes <- lapply(seq_len(times), function(i) model(moved_landmarks(face)))
rms <- function(x) sqrt(mean(x^2))
each <- lapply(curves, function(curve) {
  away <- vapply(shapes, function(shape)
    rms(distance_to_path(inner_points(shape, curve), still$paths[[curve]])), 0)
  moved <- vapply(shapes, function(shape)
    rms(sqrt(rowSums((inner_points(shape, curve) - inner_points(still, curve))^2))), 0)
  data.frame(curve = curve, kind = scheme$curves$kind[scheme$curves$curve == curve],
             away = rms(away), moved = rms(moved), worst = max(away), jumps = sum(away > jump))
})
table <- do.call(rbind, each)
table <- table[order(-table$away), ]
numbers <- c("away", "moved", "worst")
table[numbers] <- lapply(table[numbers], round, 2)
print(table, row.names = FALSE)
cat(sprintf(paste("%s, %d times: %d of %d curves below 0.7 mm away; all curves RMS %.2f away, %.2f",
                  "moved\n"), id, times,
            sum(table$away < 0.7), nrow(table), rms(table$away), rms(table$moved)))
