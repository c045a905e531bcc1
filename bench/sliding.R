# Sliding: does it make points homologous, does it keep its promises, what does it cost.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/sliding.R [random] [mean] [starts] [spread]
#     [noise] [variants] [morpho] [morpho-noise] [slider3d] [gpagen FILE]
#
# random: 1,000 random curves against random templates. mean: geodesic distances and frechet_mean()
# on spheres. The others use the 23 simpop faces, in dense correspondence: every point is carried to
# the shared topology, and its RMS distance from the mean over faces taken, along its curve and in
# all; noise: with noise and moved landmarks; variants: settings of held curves. morpho (relaxLM)
# and slider3d need Morpho, and so does the warp. gpagen writes what geomorph is to slide into FILE
# (with .rds), or measures what it has made of it: bench/sliding-gpagen.R runs between the two, on
# R 4.5 (tools/chroot.sh). bench/homology.R has more populations; its FOLDER, as
# CRESTLINE_BENCH=FOLDER, saves measuring the faces again.

library(crestline)

inner <- function(name) getFromNamespace(name, "crestline")
shared <- Sys.getenv("CRESTLINE_SHARED")
wanted <- commandArgs(TRUE)
if (!length(wanted))
  wanted <- c("random", "mean", "starts", "spread", "noise", "variants", "morpho", "morpho-noise",
              "slider3d")

# ---- random curves ----

wiggly_track <- function(nodes) {
  turn <- apply(matrix(rnorm(3 * nodes), nodes), 2, cumsum) / sqrt(nodes) +
    outer(seq_len(nodes), c(1, 0, 0)) / 10
  step <- sqrt(rowSums(diff(turn)^2))
  cbind(s = c(0, cumsum(step)), turn, face = 1)
}

at_length <- function(track, s) sapply(2:4, function(k) approx(track[, 1], track[, k], s)$y)

# One random curve slid against another with four landmarks held; the worst of each promise.
slide_random <- function(seed, settings) {
  set.seed(seed)
  n <- sample(12:40, 1)
  track <- wiggly_track(sample(60:400, 1))
  template <- rbind(at_length(wiggly_track(200), seq(0, 1, length.out = n)), matrix(rnorm(12), 4))
  template[seq_len(n), ] <- at_length(other <- wiggly_track(200),
                                      seq(0, max(other[, 1]), length.out = n))
  length <- max(track[, 1])
  s <- c(0, sort(runif(n - 2, 0, length)), length)
  x <- rbind(at_length(track, s), matrix(rnorm(12), 4))
  b <- inner("energy_matrix")(template, rep(c(settings$nugget, 0), c(n, 4)), 1e-6)
  rows <- inner("slider_rows")(s, seq_len(n) %in% 2:(n - 1), length / (n - 1), length, settings)
  strain <- settings$strain * mean(diag(b))
  slid <- inner("cpp_slide_on_tracks")(b, x, list(track), rows, strain, settings$sweeps)
  after <- c(0, slid$s, length)
  total <- slid$trace$energy + slid$trace$strain
  data.frame(order = min(diff(after)) > 0, rise = max(diff(total)) / total[1],
             off = max(abs(slid$x[seq_len(n), ] - at_length(track, after))),
             better = brute_force(b, slid$x, track, after, strain, length / (n - 1), settings),
             sweeps = length(total) - 1, converged = slid$trace$converged)
}

# How much lower the sum gets, relatively, by moving one point over a fine grid between its
# neighbours.
brute_force <- function(b, x, track, s, strain, rest, settings, grid = 2001) {
  n <- length(s)
  value <- function(x, s) sum(x * (b %*% x)) + strain * sum((diff(s) - rest)^2)
  best <- value(x, s)
  gain <- vapply(sample(2:(n - 1), 3), function(j) {
    low <- min(s[j], s[j - 1] + settings$gap * rest)
    high <- max(s[j], s[j + 1] - settings$gap * rest)
    try <- seq(low, high, length.out = grid)
    places <- at_length(track, try)
    gradient <- b[j, -j] %*% x[-j, ]
    own <- b[j, j] * rowSums(places^2) + 2 * places %*% t(gradient) +
      strain * ((try - s[j - 1] - rest)^2 + (s[j + 1] - try - rest)^2)
    here <- b[j, j] * sum(x[j, ]^2) + 2 * sum(x[j, ] * gradient) +
      strain * ((s[j] - s[j - 1] - rest)^2 + (s[j + 1] - s[j] - rest)^2)
    here - min(own)
  }, 0)
  max(gain) / best
}

random <- function(n = 1000) {
  for (preset in c("crestline", "paper")) {
    settings <- slide_settings(preset, tolerance = 1e-7, sweeps = 20000)
    found <- do.call(rbind, lapply(seq_len(n), slide_random, settings))
    cat(sprintf(paste("%d random curves, \"%s\": in order %d; energy rises by %.1e at most; off",
                      "the path %.1e; "), n, preset,
                sum(found$order), max(found$rise), max(found$off)))
    cat(sprintf("better by brute force %.1e; sweeps %g (median), %d converged\n", max(found$better),
                median(found$sweeps), sum(found$converged)))
  }
}

# ---- means on spheres ----

# Errors of distances between 20 vertices and all others further than 0.2 rad.
distance_errors <- function(ball) {
  from <- sample(ncol(ball$vb), 20)
  found <- inner("geodesic_distances")(ball, inner("surface_points")(ball, t(ball$vb[1:3, from])))
  edges <- vapply(from, function(v) Rvcg::vcgDijkstra(ball, v), numeric(ncol(ball$vb)))
  arc <- acos(pmin(pmax(crossprod(ball$vb[1:3, ], ball$vb[1:3, from]), -1), 1))
  for (one in list(list("ours", found), list("over edges", edges))) {
    error <- (one[[2]] / arc - 1)[arc > 0.2]
    cat(sprintf("  distances, %s: %.2f %% on average, %.2f to %.2f %%\n", one[[1]],
                100 * mean(error), 100 * min(error), 100 * max(error)))
  }
}

# Distance, in edges, between the mean of two weighted points and the place that divides their arc.
mean_error <- function(ball) {
  turn <- qr.Q(qr(matrix(rnorm(9), 3)))
  span <- runif(1, 0.3, 2.2)
  weights <- runif(2, 0.2, 1)
  on_arc <- function(angle) cos(angle) * turn[, 1] + sin(angle) * turn[, 2]
  found <- unlist(frechet_mean(ball, rbind(on_arc(0), on_arc(span)), weights)[1:3])
  truth <- on_arc(span * weights[2] / sum(weights))
  acos(sum(found * truth) / sqrt(sum(found^2))) / sqrt(4 * pi / ncol(ball$vb))
}

means <- function() {
  set.seed(1)
  for (subdivision in 3:5) {
    ball <- Rvcg::vcgSphere(subdivision)
    ball$vb[1:3, ] <- t(t(ball$vb[1:3, ]) / sqrt(colSums(ball$vb[1:3, ]^2)))
    cat(sprintf("sphere of %d vertices\n", ncol(ball$vb)))
    distance_errors(ball)
    off <- replicate(60, mean_error(ball))
    cat(sprintf("  mean of two points: off by %.3f edges (RMS), %.3f at most\n",
                sqrt(mean(off^2)), max(off)))
  }
}

# ---- faces ----

simpop_mesh <- function(id) {
  Rvcg::vcgImport(file.path(shared, "simpop", paste0(id, ".ply")), silent = TRUE, clean = FALSE)
}

simpop_landmarks <- function() {
  table <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
  lapply(split(table, table$id),
         function(rows) `rownames<-`(as.matrix(rows[c("x", "y", "z")]), rows$landmark))
}

# The faces, perhaps with noise along the normals and landmarks moved (RMS distance, then put on the
# surface), mm.
specimens <- function(noise = 0, moved = 0) {
  set.seed(1)
  Map(function(landmarks, id) {
    mesh <- Rvcg::vcgUpdateNormals(simpop_mesh(id), silent = TRUE)
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] + mesh$normals[1:3, ] *
      rep(rnorm(ncol(mesh$vb), 0, noise), each = 3)
    mesh$normals <- NULL
    suppressWarnings(specimen(mesh,
                              landmarks + rnorm(length(landmarks), 0, moved / sqrt(3)), id = id))
  }, simpop_landmarks(), names(simpop_landmarks()))
}

# All curves are cut at the share that every face has.
fitted <- function(faces, scale = 0.82) {
  lapply(faces, function(face)
    suppressWarnings(fit_shape(face, face_scheme(), progress = FALSE,
                               measuring = shape_settings(cut_scale = scale))))
}

# The same faces as bench/homology.R, which may have kept them.
measured_faces <- function(noise = 0, moved = 0) {
  file <- file.path(Sys.getenv("CRESTLINE_BENCH"),
                    paste0("shapes-simpop", if (noise) "-noise", ".rds"))
  if (file.exists(file)) readRDS(file)$shapes else fitted(specimens(noise, moved))
}

# Matrix by place: x, y, z, face, w1, w2, w3.
store_of <- function(shape) {
  first <- !duplicated(shape$scheme$points$place)
  `rownames<-`(as.matrix(shape$points[first, c("x", "y", "z", "face", "w1", "w2", "w3")]),
               shape$scheme$points$place[first])
}

stores <- function(shapes) lapply(shapes, store_of)

mean_mesh <- function() {
  vertices <- lapply(names(simpop_landmarks()), function(id) t(simpop_mesh(id)$vb[1:3, ]))
  inner("procrustes_mean")(vertices, vertices[[1]])
}

# Places x 3 x faces on the mean mesh.
carried <- function(stores, it, mean) {
  simplify2array(lapply(stores, function(store) {
    corner <- function(i) store[, paste0("w", i)] * mean[it[i, store[, "face"]], , drop = FALSE]
    `rownames<-`(corner(1) + corner(2) + corner(3), rownames(store))
  }))
}

# By curve: spread along and across of the points between its ends, mm.
curve_spread <- function(at, scheme) {
  rows <- lapply(with(scheme$curves, curve[n > 2]), function(name) {
    place <- with(scheme$points, place[level == "curves" & part == name])
    n <- length(place)
    middle <- apply(at[place, , ], 1:2, mean)
    tangent <- middle[c(2:n, n), ] - middle[c(1, 1:(n - 1)), ]
    tangent <- tangent / sqrt(rowSums(tangent^2))
    off <- sweep(at[place, , ], 1:2, middle)[2:(n - 1), , , drop = FALSE]
    along <- apply(off, 3, function(d) rowSums(d * tangent[2:(n - 1), , drop = FALSE]))
    total <- apply(off, 3, function(d) rowSums(d^2))
    data.frame(curve = name, points = n - 2, along = sqrt(mean(along^2)),
               across = sqrt(mean(total - along^2)))
  })
  do.call(rbind, rows)
}

pooled <- function(x, weight) sqrt(sum(x^2 * weight) / sum(weight))

surface_spread <- function(at, scheme) {
  free <- setdiff(scheme$points$place, inner("bound_places")(scheme))
  sqrt(mean(apply(sweep(at[free, , ], 1:2, apply(at[free, , ], 1:2, mean)), 3,
                  function(d) rowSums(d^2))))
}

# The warp on the landmarks as its users run it: the template's points carried by the thin-plate
# spline, then the closest point of the mesh.
warped <- function(shape, template) {
  store <- store_of(shape)
  at <- setdiff(rownames(store)[!is.na(store[, 1])], inner("landmark_keys")(shape$scheme))
  image <- Morpho::tps3d(inner("places_of")(template)[at, ], coords(template, "landmarks"),
                         coords(shape, "landmarks"), threads = 1)
  on <- Rvcg::vcgClostKD(image, shape$specimen$mesh, barycentric = TRUE, threads = 1)
  store[at, ] <- cbind(t(on$vb[1:3, ]), on$faceptr, t(on$barycoords))
  store
}

# rows: function of `slid(name, ...)`, which homologises by settings, that gives more rows.
spread_table <- function(shapes, label, rows) {
  scheme <- shapes[[1]]$scheme
  it <- shapes[[1]]$specimen$mesh$it
  mean <- mean_mesh()
  before <- curve_spread(carried(stores(shapes), it, mean), scheme)
  whole <- before$curve %in% with(scheme$curves, curve[is.na(cut_share)])
  line <- function(name, stores, seconds = NA) {
    at <- carried(stores, it, mean)
    curves <- curve_spread(at, scheme)
    ends <- curves[whole, ]
    data.frame(what = name, along = pooled(curves$along, curves$points),
               across = pooled(curves$across, curves$points),
               total = pooled(sqrt(curves$along^2 + curves$across^2), curves$points),
               along_uncut = pooled(ends$along, ends$points),
               better = sum(curves$along < before$along), surface = surface_spread(at, scheme),
               seconds = seconds)
  }
  slid <- function(name, ...) {
    time <-
      system.time(sample <- suppressWarnings(homologise(shapes, settings = slide_settings(...),
                                                        progress = FALSE)))
    list(line = line(name, stores(sample$shapes), time[["user.self"]]), sample = sample)
  }
  ours <- slid("default: free curve points")
  table <- rbind(line("as fitted, equal chords", stores(shapes)),
                 line("warp on the landmarks", lapply(shapes, warped, ours$sample$template)),
                 ours$line, rows(slid))
  cat("\n", label, "\n", sep = "")
  print(format(table, digits = 3), row.names = FALSE, width = 200)
}

main_rows <- function(slid) {
  rbind(slid("crests kept, floor 0", floor = 0)$line, slid("held", curves = "held")$line,
        slid("the paper's energies", "paper")$line)
}

held_rows <- function(slid) {
  rbind(
    slid("held, cut ends stay", curves = "held", cut_ends = "stay")$line,
    slid("held, no nugget, no strain", curves = "held", nugget = 0, strain = 0)$line,
    slid("held, one energy of all curves", curves = "held", energy = "all")$line,
    slid("held, nugget by standard error", curves = "held", nugget_by = "error")$line,
    slid("held, surface between slid curves, not slid", curves = "held", surface = "between")$line,
    slid("held, surface along transects, one energy", curves = "held", surface = "transect")$line
  )
}

spread <- function() spread_table(measured_faces(), "Spread over 23 faces, mm", main_rows)

noise <- function() {
  spread_table(measured_faces(0.2, 1), "Spread with 0.2 mm noise and landmarks moved by 1 mm",
               main_rows)
}

variants <- function() {
  spread_table(measured_faces(), "Settings of held curves, 23 faces, mm", held_rows)
  spread_table(measured_faces(0.2, 1), "The same with noise", held_rows)
}

# Convergence, time, and whether the answer depends on the start.
starts <- function() {
  faces <- specimens()
  fitting <- system.time(shapes <- fitted(faces))[["user.self"]]
  sliding <- system.time(sample <- homologise(shapes, progress = FALSE))[["user.self"]]
  cat(sprintf("\n23 faces: fitted in %.1f s, homologised in %.1f s\n", fitting, sliding))
  print(sample$convergence, digits = 3)
  reference <- inner("places_of")(sample$template)
  mirrored <- reference[inner("mirror_places")(sample$template$scheme), ] %*% diag(c(-1, 1, 1))
  cat(sprintf("template from its relabelled reflection: %.1e mm at most\n",
              max(abs(inner("laid_onto")(mirrored, reference, FALSE) - reference))))
  for (first in c(12, 23)) {
    other <- homologise(shapes[c(first, seq_along(shapes)[-first])], progress = FALSE)
    laid <- inner("laid_onto")(inner("places_of")(other$template), reference, FALSE)
    gap <- sqrt(rowSums((laid - reference)^2))
    cat(sprintf("begun with face %d: template differs by %.4f mm (RMS), %.4f at most\n", first,
                sqrt(mean(gap^2)), max(gap)))
  }
}

# What both comparisons with Morpho begin with: shapes with curves slid and surface points between
# them; which of the surface model's places are free.
morpho_start <- function(noise, moved) {
  shapes <- measured_faces(noise, moved)
  sample <- homologise(shapes, settings = slide_settings(curves = "held"), progress = FALSE)
  scheme <- sample$template$scheme
  place <- unique(with(scheme$points, place[level == "surface"]))
  settings <- slide_settings(curves = "held", surface = "between")
  list(shapes = shapes, sample = sample, free_sample = homologise(shapes, progress = FALSE),
       scheme = scheme, place = place,
       free = match(setdiff(place, inner("bound_places")(scheme)), place),
       stores = lapply(shapes,
                       function(shape) stores(list(slide(shape, sample$template, settings)))[[1]]))
}

# Our free surface points at Morpho's own criterion: the bending energy of all places, no nugget.
slide_as_morpho <- function(start, i, b) {
  plan <- list(settings = slide_settings(surface_sweeps = 1000), radius = 57)
  set <- list(places = start$place, free = start$place[start$free], b = b)
  inner("slide_free")(set, start$stores[[i]], start$shapes[[i]]$specimen, plan)$store
}

# Their points as a store, and how far off the mesh they are.
put_on_mesh <- function(start, i, x) {
  on <- as.matrix(inner("surface_points")(start$shapes[[i]]$specimen$mesh, x))
  store <- start$stores[[i]]
  store[start$place, 1:7] <- on
  list(store = store, off = max(sqrt(rowSums((x - on[, 1:3])^2))))
}

free_spread <- function(start, stores) {
  surface_spread(carried(stores, start$shapes[[1]]$specimen$mesh$it, mean_mesh()), start$scheme)
}

energy_in <- function(b) function(x) sum(x * (b %*% x))

# Against the same template, one face after the other.
morpho <- function(noise = 0, moved = 0) {
  if (!requireNamespace("Morpho", quietly = TRUE)) return(cat("Morpho is not here\n"))
  start <- morpho_start(noise, moved)
  template <- inner("places_of")(start$sample$template)[start$place, ]
  matrix_time <- system.time(b <- inner("energy_matrix")(template, rep(0, nrow(template)),
                                                         1e-6))[["user.self"]]
  energy <- energy_in(b)
  compared <- lapply(seq_along(start$shapes), function(i) {
    time <- system.time(own <- slide_as_morpho(start, i, b))[["user.self"]]
    x <- start$stores[[i]][start$place, 1:3]
    their_time <- system.time(theirs <- Morpho::relaxLM(x, template, SMvector = start$free,
                                                        surp = start$free, silent = TRUE,
                                                        mesh = start$shapes[[i]]$specimen$mesh))[[
                                                          "user.self"]]
    on <- put_on_mesh(start, i, theirs)
    list(theirs = on$store, ours = own, row = data.frame(
      energy_ours = energy(own[start$place, 1:3]), energy_morpho = energy(theirs),
      seconds_ours = time, seconds_morpho = their_time, off_mesh_morpho = on$off))
  })
  rows <- do.call(rbind, lapply(compared, `[[`, "row"))
  gain <- 1 - rows$energy_ours / rows$energy_morpho
  cat(sprintf(paste("\nMorpho::relaxLM, noise %g mm, %d free of %d places: our energy is lower on",
                    "%d faces, by %.2g to %.2g; "),
              noise, length(start$free), length(start$place), sum(gain >= 0), min(gain), max(gain)))
  cat(sprintf(paste("seconds a face %.3f (matrix once for all: %.2f) and %.2f; theirs off the mesh",
                    "by %.1e mm\n"),
              mean(rows$seconds_ours), matrix_time, mean(rows$seconds_morpho),
              max(rows$off_mesh_morpho)))
  cat(sprintf(paste("spread of surface points, mm: Morpho %.3f, ours at that criterion %.3f, held",
                    "%.3f, ours %.3f\n"),
              free_spread(start, lapply(compared, `[[`, "theirs")),
              free_spread(start, lapply(compared, `[[`, "ours")),
              free_spread(start, stores(start$sample$shapes)),
              free_spread(start, stores(start$free_sample$shapes))))
}

# All faces at once, against their own mean: slider3d until it stands still or so many iterations;
# then ours from the same start against the mean that it has come to.
against_slider3d <- function(iterations = 10) {
  if (!requireNamespace("Morpho", quietly = TRUE)) return(cat("Morpho is not here\n"))
  start <- morpho_start(0, 0)
  x <- simplify2array(lapply(start$stores, function(store) store[start$place, 1:3]))
  meshes <- lapply(start$shapes, function(shape) shape$specimen$mesh)
  their_time <- system.time(slid <- Morpho::slider3d(x, SMvector = start$free, surp = start$free,
                                                     meshlist = meshes, mc.cores = 1,
                                                     iterations = iterations,
                                                     silent = TRUE))[["user.self"]]
  theirs <- lapply(seq_along(meshes), function(i) slid$dataslide[, , i])
  template <- inner("procrustes_mean")(theirs, theirs[[1]])
  time <- system.time({
    b <- inner("energy_matrix")(template, rep(0, nrow(template)), 1e-6)
    ours <- lapply(seq_along(meshes), function(i) slide_as_morpho(start, i, b))
  })[["user.self"]]
  energy <- energy_in(b)
  before <- apply(x, 3, energy)
  after <- vapply(theirs, energy, 0)
  own <- vapply(ours, function(store) energy(store[start$place, 1:3]), 0)
  on <- lapply(seq_along(meshes), function(i) put_on_mesh(start, i, theirs[[i]]))
  cat(sprintf(paste("\nMorpho::slider3d, %d iterations at most: energy %.2f before, %.3f after,",
                    "ours %.3f (mean); "), iterations,
              mean(before), mean(after), mean(own)))
  cat(sprintf(paste("ours lower on %d faces, by %.2g to %.2g; seconds %.1f and ours %.1f; theirs",
                    "off the mesh by %.1e mm\n"),
              sum(own <= after), min(1 - own / after), max(1 - own / after), their_time, time,
              max(vapply(on, `[[`, 0, "off"))))
  theirs <- lapply(on, `[[`, "store")
  cat(sprintf(paste("spread of surface points, mm: slider3d %.3f, ours at that criterion %.3f,",
                    "held %.3f, ours %.3f\n"),
              free_spread(start, theirs), free_spread(start, ours),
              free_spread(start, stores(start$sample$shapes)),
              free_spread(start, stores(start$free_sample$shapes))))
}

# The points of all faces as geomorph takes them: landmarks, curves in threes (before, slider,
# after), surface points.
against_gpagen <- function(file) {
  start <- morpho_start(0, 0)
  places <- unique(start$scheme$points$place)
  if (!file.exists(paste0(file, "-slid.rds"))) {
    x <- simplify2array(lapply(start$shapes, function(shape) store_of(shape)[places, 1:3]))
    curves <- do.call(rbind, lapply(inner("places_by_curve")(start$scheme), function(place) {
      n <- length(place)
      matrix(match(cbind(place[1:(n - 2)], place[2:(n - 1)], place[3:n]), places), ncol = 3)
    }))
    surfaces <- match(start$place[start$free], places)
    saveRDS(list(x = x, curves = curves, surfaces = surfaces), file)
    return(cat("written: now bench/sliding-gpagen.R\n"))
  }
  slid <- readRDS(paste0(file, "-slid.rds"))
  scheme <- start$scheme
  marks <- match(inner("landmark_keys")(scheme), places)
  theirs <- lapply(seq_along(start$shapes), function(i) {
    shape <- start$shapes[[i]]
    own <- store_of(shape)[places, ]
    back <- inner("superimposition")(slid$coords[marks, , i], own[marks, 1:3],
                                     TRUE)(slid$coords[, , i])
    free <- setdiff(seq_along(places), marks)
    own[free, ] <- as.matrix(inner("surface_points")(shape$specimen$mesh, back[free, ]))
    list(store = own, off = sqrt(mean(rowSums((back[free, ] - own[free, 1:3])^2))))
  })
  spread_of <- function(stores) {
    at <- carried(stores, start$shapes[[1]]$specimen$mesh$it, mean_mesh())
    curves <- curve_spread(at, scheme)
    c(along = pooled(curves$along, curves$points), across = pooled(curves$across, curves$points),
      curves = pooled(sqrt(curves$along^2 + curves$across^2), curves$points),
      surface = surface_spread(at, scheme))
  }
  cat(sprintf(paste("\ngeomorph::gpagen, %.0f s; off the mesh by %.2f mm RMS before they were put",
                    "back on it; spread, mm\n"), slid$seconds,
              sqrt(mean(vapply(theirs, `[[`, 0, "off")^2))))
  print(round(rbind(gpagen = spread_of(lapply(theirs, `[[`, "store")),
                    ours = spread_of(stores(start$free_sample$shapes))), 3))
}

sections <- list(random = random, mean = means, starts = starts, spread = spread, noise = noise,
                 variants = variants, morpho = morpho, "morpho-noise" = function() morpho(0.2, 1),
                 slider3d = against_slider3d)
if (wanted[1] == "gpagen") against_gpagen(wanted[2]) else for (name in wanted) sections[[name]]()
