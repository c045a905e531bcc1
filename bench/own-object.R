# What helps with a scheme of one's own, on Morpho's skull: places that are suggested beside those
# that were placed by hand, points that are snapped back to the rims of the orbits, every row of the
# scheme checked.
#   Rscript bench/own-object.R [times]
suppressMessages(library(crestline))
options(rgl.useNULL = TRUE, width = 100)
times <- as.integer(c(commandArgs(TRUE), 20)[1])
data(boneData, package = "Morpho")
folder <- system.file("extdata", package = "crestline")
marks <- read_landmarks(file.path(folder, "skull_landmarks.csv"))
skull <- specimen(skull_0144_ch_fe.mesh, marks, id = "skull")

# ---- Suggested: how many of the twenty landmarks have one within a radius
suggested <- lapply(c(2, 3, 4, 6), function(radius) {
  time <- system.time(found <- suggest_landmarks(skull, radius, n = 20))
  at <- t(as.matrix(as.data.frame(found)[c("x", "y", "z")]))
  gap <- apply(marks, 1, function(p) min(sqrt(colSums((at - p)^2))))
  data.frame(radius, suggested = nrow(found), seconds = time[["user.self"]],
             within = sum(gap <= radius), of = nrow(marks))
})
print(do.call(rbind, suggested), digits = 2)

# ---- Snapped: places on the rims of the orbits, moved along the surface at random
outline <- data.frame(curve = c("orbit left", "orbit right"), from = c("soL", "soR"),
                      to = c("soL", "soR"), via = c("orL", "orR"), kind = "ridge", radius = 4,
                      width = 6, n = 30)
scheme <- curve_scheme(data.frame(landmark = rownames(marks)), outline, name = "orbits")
rim <- coords(fit_shape(skull, scheme, ridge_settings(error = FALSE), progress = FALSE), "curves")
dense <- outline
dense$n <- 1000
path <- t(coords(fit_shape(skull, curve_scheme(data.frame(landmark = rownames(marks)), dense),
                           ridge_settings(error = FALSE), progress = FALSE), "curves"))
off_rim <- function(x) apply(x, 1, function(p) sqrt(min(colSums((path - p)^2))))
set.seed(1)
snapped <- lapply(c(1, 2, 3), function(by) {
  at <- rim[rep(seq_len(nrow(rim)), length.out = times * 10), ]
  step <- matrix(rnorm(length(at)), nrow(at))
  moved <- at + by * step / sqrt(rowSums(step^2))
  rownames(moved) <- seq_len(nrow(moved))
  from <- as.matrix(locate(skull, moved)[c("x", "y", "z")])
  time <- system.time(found <- suppressWarnings(snap(skull, from, "ridge", radius = 4, reach = 4)))
  to <- as.matrix(found[c("x", "y", "z")])
  ok <- found$found
  data.frame(moved_by = by, points = nrow(at), found = mean(ok), before = mean(off_rim(from)[ok]),
             after = mean(off_rim(to)[ok]), median_after = median(off_rim(to)[ok]),
             within_1_mm = mean(off_rim(to)[ok] < 1),
             ms_each = 1000 * time[["user.self"]] / nrow(at))
})
print(do.call(rbind, snapped), digits = 2)

# ---- Checked: every row of the scheme
whole <- read_scheme(file.path(folder, "skull_scheme"), name = "skull")
time <- system.time(checked <- check_scheme(whole, skull))
fit <- system.time(fit_shape(skull, whole, progress = FALSE))
print(checked)
cat(sprintf("checked in %.1f s of the processor; fit_shape() alone %.1f s\n", time[["user.self"]],
            fit[["user.self"]]))
