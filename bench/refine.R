# What definitions of landmarks by shape are worth: how far they bring jittered landmarks together,
# and how far they lie from where people put the points.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/refine.R [times=100] [step=2]
#   [faces=scan_a,template_male,simpop] [noise=0.3] [picture=file.png]
#
# Each time every landmark of a face is moved by `step` mm in a random direction along the surface,
# all at once, and refined by face_scheme()'s definitions. Spread: root mean square distance of a
# landmark from its mean over the times. A landmark that is left alone counts where the jitter left
# it. With `noise` the landmarks stay and the vertices move instead, by normal noise of this sd
# along the normals: the spread is that of the definition itself from one scan to the next. "hand":
# distance of the defined place from the landmark as it was placed.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
asked <- commandArgs(TRUE)
option <- function(name, default) {
  given <- grep(paste0("^", name, "="), asked, value = TRUE)
  if (length(given)) strsplit(sub("^[^=]*=", "", given), ",")[[1]] else default
}
times <- as.integer(option("times", 100))
step <- as.numeric(option("step", 2))
scheme <- face_scheme()

one_face <- function(id) {
  folder <- file.path(shared, id)
  suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                 file.path(folder, "landmarks.csv"), id = id))
}

simpop <- function() {
  table <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
  lapply(split(table, table$id), function(rows) {
    id <- as.character(rows$id[1])
    file <- list.files(file.path(shared, "simpop"), sprintf("%s[.]ply$", sub("simpop_", "", id)),
                       full.names = TRUE)[1]
    at <- as.matrix(rows[c("x", "y", "z")])
    rownames(at) <- rows$landmark
    suppressWarnings(read_specimen(file, at, id = id))
  })
}

faces_of <- function(set) if (set == "simpop") simpop() else list(one_face(set))

# Unit normals of the surface at points of it, n x 3.
normals_at <- function(mesh, points) {
  corner <- function(i) mesh$normals[1:3, mesh$it[i, points$face], drop = FALSE] *
    rep(points[[paste0("w", i)]], each = 3)
  normal <- t(corner(1) + corner(2) + corner(3))
  normal / sqrt(rowSums(normal^2))
}

jittered <- function(face) {
  normal <- normals_at(face$mesh, crestline:::surface_points(face$mesh, face$landmarks))
  direction <- matrix(rnorm(length(normal)), ncol = 3)
  direction <- direction - rowSums(direction * normal) * normal
  at <- face$landmarks + step * direction / sqrt(rowSums(direction^2))
  face$landmarks[] <- as.matrix(crestline:::surface_points(face$mesh, at)[1:3])
  face
}

spread <- function(at) {
  at <- at[stats::complete.cases(at), , drop = FALSE]
  sqrt(mean(rowSums(sweep(at, 2, colMeans(at))^2)))
}

# A row a landmark that has a definition. The curvature is that of one mesh and worked out once for
# all repeats.
bench_face <- function(face) {
  once <- crestline:::curvature_by_radius(face, NULL, "adaptive cubic", 1L)
  refine <- function(face) refine_landmarks(face, scheme, move = TRUE, curvature = once)
  hand <- refine(face)$refinement
  repeats <- lapply(seq_len(times), function(i) {
    moved <- jittered(face)
    list(before = moved$landmarks, after = refine(moved))
  })
  rows <- lapply(seq_len(nrow(hand)), function(i) {
    name <- hand$landmark[i]
    before <- do.call(rbind, lapply(repeats, function(r) r$before[name, ]))
    after <- do.call(rbind, lapply(repeats, function(r) r$after$landmarks[name, ]))
    alone <- vapply(repeats, function(r) r$after$refinement$state[i] != "found", NA)
    data.frame(face = face$id, landmark = name, kind = hand$kind[i], before = spread(before),
               after = spread(after), alone = sum(alone), hand = hand$distance[i])
  })
  do.call(rbind, rows)
}

# The landmarks as they are, the surface scanned again: `times` meshes with noise.
bench_noise <- function(face, sd) {
  places <- lapply(seq_len(times), function(i) {
    mesh <- face$mesh
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] + rep(rnorm(ncol(mesh$vb), sd = sd), each = 3) *
      mesh$normals[1:3, ]
    mesh$normals <- NULL
    suppressWarnings(refine_landmarks(specimen(mesh, face$landmarks, id = face$id),
                                      scheme))$refinement
  })
  names <- places[[1]]$landmark
  data.frame(face = face$id, landmark = names, kind = places[[1]]$kind,
             spread = vapply(seq_along(names),
                             function(i)
                               spread(do.call(rbind,
                                              lapply(places, function(p)
                                                as.matrix(p[i, c("x", "y", "z")])))), 0),
             alone = vapply(seq_along(names), function(i)
               sum(vapply(places, function(p) p$state[i] != "found", NA)), 0L))
}

noise <- as.numeric(option("noise", 0))
if (noise > 0) {
  for (set in option("faces", c("scan_a", "template_male"))) {
    set.seed(1)
    cat(sprintf("\n%s: %d scans with %g mm of noise\n", set, times, noise))
    for (face in faces_of(set)) print(bench_noise(face, noise), row.names = FALSE, digits = 2)
  }
  quit(save = "no")
}

summary_of <- function(rows) {
  each <- lapply(unique(rows$landmark), function(name) {
    own <- rows[rows$landmark == name, ]
    data.frame(landmark = name, kind = own$kind[1], before = mean(own$before),
               after = mean(own$after), worst_ratio = max(own$after / own$before),
               not_halved = sum(own$after > own$before / 2), faces = nrow(own),
               left_alone = sum(own$alone), hand_median = median(own$hand, na.rm = TRUE),
               hand_most = max(own$hand, na.rm = TRUE))
  })
  do.call(rbind, each)
}

for (set in option("faces", c("scan_a", "template_male", "simpop"))) {
  set.seed(1)
  seconds <- system.time(rows <- do.call(rbind, lapply(faces_of(set), bench_face)))[["user.self"]]
  cat(sprintf("\n%s: %d faces, %d repeats of %g mm, %.0f user s\n", set, length(unique(rows$face)),
              times, step, seconds))
  table <- summary_of(rows)
  numbers <- vapply(table, is.numeric, NA)
  table[numbers] <- lapply(table[numbers], round, 3)
  print(table, row.names = FALSE)
}

picture <- option("picture", NULL)
if (!is.null(picture)) {
  grDevices::png(picture, 1800, 800, res = 110)
  graphics::par(mfrow = c(1, 3))
  for (face in c(faces_of("scan_a"), faces_of("template_male"), simpop()[1])) {
    plot(refine_landmarks(face, scheme), what = "refinement")
  }
  grDevices::dev.off()
}
