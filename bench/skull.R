# The skull's scheme under landmarks moved by 1 mm at random: how far curves move away from their
# ends, what fails.
#   Rscript bench/skull.R [times]
suppressMessages(library(crestline))
times <- as.integer(c(commandArgs(TRUE), 50)[1])
data(boneData, package = "Morpho")
folder <- system.file("extdata", package = "crestline")
scheme <- read_scheme(file.path(folder, "skull_scheme"), name = "skull")
marks <- read_landmarks(file.path(folder, "skull_landmarks.csv"))
plain <- ridge_settings(error = FALSE)
fit <- function(marks) {
  skull <- specimen(skull_0144_ch_fe.mesh, marks, id = "skull")
  shape <- fit_shape(skull, scheme, plain)
  c(shape, list(faults = nrow(surface_faults(shape, skull))))
}

# Every landmark 1 mm away in a direction along the surface.
moved <- function(marks, by = 1) {
  step <- matrix(rnorm(length(marks)), nrow(marks))
  step <- by * step / sqrt(rowSums(step^2))
  closest <- Rvcg::vcgClostKD(marks + step, skull_0144_ch_fe.mesh)
  structure(t(closest$vb[1:3, ]), dimnames = dimnames(marks))
}

# RMS distance of the middle of one path (ends left off) from another.
middle_off <- function(path, other, ends = 0.15, n = 40) {
  share <- path$s / attr(path, "length")
  xyz <- as.matrix(as.data.frame(path)[c("x", "y", "z")])
  at <- sapply(1:3, function(i)
    approx(share, xyz[, i], seq(ends, 1 - ends, length.out = n), ties = "ordered")$y)
  line <- as.matrix(as.data.frame(other)[c("x", "y", "z")])
  from <- line[-nrow(line), ]
  step <- diff(line)
  squared <- apply(at, 1, function(p) {
    ahead <- rep(p, each = nrow(from)) - from
    along <- pmin(pmax(rowSums(ahead * step) / rowSums(step^2), 0), 1)
    min(rowSums((ahead - along * step)^2))
  })
  sqrt(mean(squared))
}

set.seed(1)
own <- fit(marks)
user <- system.time(runs <- replicate(times, fit(moved(marks)), simplify = FALSE))[["user.self"]]
off <- sapply(runs, function(run) mapply(middle_off, own$paths, run$paths))
curves <- scheme$curves$curve
flagged <- sapply(runs, function(run) !is.na(run$status$reason[run$status$level == "curves"]))
print(data.frame(curve = curves, rms = round(sqrt(rowMeans(off^2)), 2),
                 worst = round(apply(off, 1, max), 2), flagged = rowSums(flagged)),
      row.names = FALSE)
lost <- sapply(runs, function(run) sum(is.na(run$points$x[run$points$level == "surface"])))
cat(sprintf(paste("%d times, %.1f s user each: curves missing %d, surface points missing %d,",
                  "faulty triangles %.1f a time\n"),
            times, user / times,
            sum(!sapply(runs, function(run) all(run$status$ok[run$status$level == "curves"]))),
            sum(lost), mean(sapply(runs, `[[`, "faults"))))
