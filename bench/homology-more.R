# What else homologise() promises of the joint step: ridges stay ridges, a wrong feature is named, a
# new face is slid alike, time and memory do not grow.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/homology-more.R FOLDER [real] [wrong] [new] [many]
#
# FOLDER: of bench/homology.R, whose shapes of simpop it takes.

source("bench/homology.R")

wanted <- commandArgs(TRUE)[-1]
if (!length(wanted)) wanted <- c("real", "wrong", "new", "many")

simpop <- function() kept("shapes-simpop", function() population("simpop"))$shapes

settings_of <- function(name)
  switch(name, held = slide_settings(curves = "held"), free = slide_settings(),
         crests = slide_settings(floor = 0))

# Mean strength of a ridge's or valley's points: the curvature of its kind, at its radius.
strength_at <- function(shape, curve, specimen) {
  row <- shape$scheme$curves[shape$scheme$curves$curve == curve, ]
  own <- shape$points$level == "curves" & shape$points$part == curve & !is.na(shape$points$x)
  it <- specimen$mesh$it[, shape$points$face[own]]
  vertices <- sort(unique(as.vector(it)))
  found <- curvature(specimen, row$radius, vertices = vertices)
  value <- if (row$kind == "ridge") -found$k2 else found$k1
  if (length(value) != ncol(specimen$mesh$vb))
    value <- replace(rep(NA, ncol(specimen$mesh$vb)), vertices, value)
  mean(colSums(matrix(value[it], 3) * t(shape$points[own, c("w1", "w2", "w3")])), na.rm = TRUE)
}

real <- function() {
  read <- function(name) {
    table <- read.csv(file.path(shared, name, "landmarks.csv"))
    landmarks <- `rownames<-`(as.matrix(table[c("x", "y", "z")]), table[[1]])
    suppressWarnings(read_specimen(file.path(shared, name, "surface.ply"), landmarks, id = name))
  }
  faces <- lapply(c("scan_a", "template_male"), read)
  names(faces) <- c("scan_a", "template_male")
  shapes <- lapply(faces, function(face)
    suppressWarnings(fit_shape(face, face_scheme(), progress = FALSE)))
  samples <- lapply(c(held = "held", free = "free", crests = "crests"), function(name) {
    suppressWarnings(homologise(shapes, settings = settings_of(name), progress = FALSE))
  })
  ridges <- with(face_scheme()$curves, curve[kind != "plane" & n > 2])
  for (id in names(faces)) for (name in c("free", "crests")) {
    shape <- samples[[name]][[id]]
    own <- shape$points$level == "curves" & shape$points$part %in% ridges
    strength <- vapply(ridges, function(curve) {
      strength_at(shape, curve, faces[[id]]) / strength_at(samples$held[[id]], curve, faces[[id]])
    }, 0)
    off <- shape$points$offset[own]
    cat(sprintf(paste("%s, %s: ridge points off their curve %.2f mm RMS, %.2f at most; strength",
                      "along them %.3f of the curve's (%.3f to %.3f)\n"),
                id, name, sqrt(mean(off^2, na.rm = TRUE)), max(abs(off), na.rm = TRUE),
                mean(strength, na.rm = TRUE), min(strength, na.rm = TRUE),
                max(strength, na.rm = TRUE)))
  }
}

# One curve of one face drawn anew, `by` mm aside between its ends, and taken for a measured one.
misplaced <- function(shape, curve, by) {
  path <- coords(shape, "curves")
  path <- path[grepl(paste0("^", curve, " [0-9]+$"), rownames(path)), ]
  n <- nrow(path)
  up <- c(0, by, 0)
  aside <- path + outer(pmin(1, 2 * sin(seq(0, pi, length.out = n))), up)
  drawn <- suppressWarnings(fit_shape(shape$specimen, shape$scheme,
                                      curves = stats::setNames(list(aside), curve),
                                      progress = FALSE,
                                      measuring = shape_settings(cut_scale = 0.82)))
  drawn$provenance$settings$fit$given <- character()
  own <- function(x) x$points$level == "curves" & x$points$part == curve
  drawn$points$se[own(drawn)] <- stats::median(shape$points$se[own(shape)], na.rm = TRUE)
  drawn
}

wrong <- function() {
  shapes <- simpop()
  limit <- quality_limits()$offset[1]
  flagged <- function(sample) {
    table <- as.data.frame(quality(sample))
    table[table$level == "curves" & !is.na(table$offset) & table$offset > limit,
          c("specimen", "part")]
  }
  good <- homologise(shapes, progress = FALSE)
  saveRDS(good, file.path(folder, "simpop-sample.rds"), compress = FALSE)
  cat(sprintf("nothing wrong: %d of %d curves flagged\n", nrow(flagged(good)), 23 * 38))
  for (curve in c("brow ridge left", "lower eye socket right", "upper lip left"))
    for (by in c(4, 6, 8)) {
    named <- vapply(c(3, 9, 17), function(i) {
      bad <- homologise(list(misplaced(shapes[[i]], curve, by)), template = good, rounds = 0,
                        progress = FALSE)
      found <- flagged(c(good[-i], bad))
      own <- found$part == curve & found$specimen == names(bad)
      c(any(own), sum(!own),
        bad[[1]]$checks$offset[with(bad[[1]]$checks, level == "curves" & part == curve)])
    }, numeric(3))
    cat(sprintf(paste("%s %g mm aside on one face: named %d of 3 times, other curves flagged %s of",
                      "873; offset, radii: %s\n"), curve, by,
                sum(named[1, ]), paste(named[2, ], collapse = ", "),
                paste(round(named[3, ], 3), collapse = ", ")))
  }
}

# RMS length of the rows of a matrix of three columns.
rms <- function(x) sqrt(mean(rowSums(x^2), na.rm = TRUE))

# Faces slid against the saved sample of the others: how far from their places in the whole sample,
# and how much of that is the template's own move, which takes all faces along.
new <- function() {
  case <- kept("shapes-simpop", function() population("simpop"))
  case$mean <- inner("procrustes_mean")(case$dense, case$dense[[1]])
  shapes <- case$shapes
  whole <- homologise(shapes, progress = FALSE)
  at <- function(shapes, of) {
    part <- case
    part$it <- case$it[of]
    carried(part, lapply(shapes, store_of))
  }
  before <- at(whole$shapes, seq_along(shapes))
  rows <- lapply(c(2, 9, 14, 20), function(i) {
    file <- tempfile(fileext = ".rds")
    saveRDS(homologise(shapes[-i], progress = FALSE), file)
    others <- readRDS(file)
    new <- slide(shapes[[i]], others)
    apart <- at(list(new), i)[, , 1] - before[, , i]
    along <- apply(at(others$shapes, seq_along(shapes)[-i]) - before[, , -i], 1:2, mean)
    rescaled <- whole$template
    rescaled$energy_scale <- others$template$energy_scale
    scaled <- slide(shapes[[i]], rescaled)
    of_mesh <- store_of(new)[, 1:3] - store_of(whole[[i]])[, 1:3]
    data.frame(face = names(whole)[i], off = rms(of_mesh), off_on_mean = rms(apart),
               all_others = rms(along),
               beyond_the_others = rms(apart - along),
               scale_alone = rms(store_of(scaled)[, 1:3] - store_of(whole[[i]])[, 1:3]),
               scales = others$template$energy_scale / whole$template$energy_scale)
  })
  cat("a new face against the sample of the other 22, mm RMS\n")
  print(do.call(rbind, rows), digits = 3)
}

# Time and memory, 23 faces and 200 (the same again under other ids).
many <- function() {
  shapes <- simpop()
  meshes <- lapply(shapes, `[[`, "specimen")
  for (n in c(23, 200)) {
    light <- lapply(seq_len(n), function(i) {
      shape <- shapes[[(i - 1) %% 23 + 1]]
      shape$specimen <- NULL
      shape$id <- paste("face", i)
      shape
    })
    read <- function(id) {
      i <- (as.integer(sub("face ", "", id)) - 1) %% 23 + 1
      meshes[[i]]$id <- id
      meshes[[i]]
    }
    for (how in c(if (n < 100) "held", "free")) {
      gc(reset = TRUE)
      before <- sum(gc()[, 2])
      time <-
        system.time(sample <- suppressWarnings(homologise(light, settings = settings_of(how),
                                                          specimens = read, progress = FALSE)))
      cat(sprintf(paste("%d faces, %s: %.2f user s a face; peak %.0f MB above the start, of which",
                        "the sample %.0f\n"), n, how,
                  time[["user.self"]] / n, sum(gc()[, 6]) - before,
                  as.numeric(utils::object.size(sample)) / 2^20))
    }
  }
}

sections <- list(real = real, wrong = wrong, new = new, many = many)
for (name in wanted) sections[[name]]()
