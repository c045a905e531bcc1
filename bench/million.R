# One ridge and one valley curve on a mesh of a million vertices: seconds and peak memory of this
# process.
#
#   Rscript bench/million.R
#
# The mesh is Rvcg's humface, subdivided (Loop) until it has about a million vertices.

library(crestline)

data(humface, package = "Rvcg")
landmarks <- read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline"))
mesh <- specimen(humface)$mesh # mended: Rvcg's subdivision crashes R on the mesh as it comes
while (ncol(mesh$vb) < 6e5)
  mesh <- Rvcg::vcgSubdivide(mesh, type = "Loop", threshold = 0, silent = TRUE)
if (ncol(mesh$vb) < 1e6)
  mesh <- Rvcg::vcgSubdivide(mesh, type = "Loop", threshold = 0.4, silent = TRUE)
invisible(gc(reset = TRUE))

seconds <- function(code) system.time(code)[c("user.self", "elapsed")]
door <- seconds(face <- suppressWarnings(specimen(mesh, landmarks, id = "million")))
valley <- seconds(lip <- suppressWarnings(ridge_curve(face, "chL", "st", "valley", 5, 6, 9)))
ridge <- seconds(socket <- suppressWarnings(ridge_curve(face, "exL", "enL", "ridge", 5, 15, 9)))
cat(sprintf("%d vertices; peak of R's own memory %.0f MB\n", ncol(face$mesh$vb), sum(gc()[, 6])))
print(rbind("specimen()" = door, "mid-line lip left" = valley, "lower eye socket left" = ridge))
print(lip)
status <- "/proc/self/status"
if (file.exists(status)) cat(grep("VmHWM", readLines(status), value = TRUE), sep = "\n")
