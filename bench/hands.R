# Landmarks without hands: success, accuracy, confidence and time on damaged scans of whole faces;
# calibration, and what differs by definition. Everything else of the finder: bench/finder.R.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/hands.R [poses] [calibrated] [offsets] [curves]
#   [option=value ...]
#
# Options of poses: poses=10 of scan_a and template_male each; simpop=10 of its faces,
# simpop_poses=1 of each; damage=whole,shoulders (all); rows=file.rds, where the rows are kept after
# each damage.
#
# 19 landmarks (without t and oi), lengths in mm. A trial succeeds when the mean error over the
# landmarks that the scan still has is below 6 mm. Poses are random rotations; noise, decimation and
# shoulders differ from pose to pose.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
ears <- c("tL", "tR", "oiL", "oiR")
template <- face_template()

faces <- function(ids = NULL) {
  one <- function(id) {
    folder <- file.path(shared, id)
    at <- read_landmarks(file.path(folder, "landmarks.csv"))
    list(id = id, mesh = read_specimen(file.path(folder, "surface.ply"))$mesh,
         landmarks = at[!rownames(at) %in% ears, ])
  }
  all <- c(lapply(c("scan_a", "template_male"), one), simpop())
  names(all) <- vapply(all, `[[`, "", "id")
  if (is.null(ids)) all else all[ids]
}

simpop <- function() {
  table <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
  table <- table[!table$landmark %in% ears, ]
  lapply(split(table, table$id), function(rows) {
    id <- rows$id[1]
    file <- list.files(file.path(shared, "simpop"), sprintf("%s[.]ply$", sub("simpop_", "", id)),
                       full.names = TRUE)[1]
    at <- as.matrix(rows[c("x", "y", "z")])
    rownames(at) <- rows$landmark
    list(id = as.character(id), mesh = suppressWarnings(read_specimen(file))$mesh, landmarks = at)
  })
}

# Left, up and out of a face.
axes_of <- function(at) {
  unit <- function(v) v / sqrt(sum(v^2))
  left <- unit(at["exL", ] - at["exR", ])
  up <- (at["exL", ] + at["exR", ] - at["chL", ] - at["chR", ]) / 2
  up <- unit(up - sum(up * left) * left)
  rbind(left, up,
        c(left[2] * up[3] - left[3] * up[2], left[3] * up[1] - left[1] * up[3],
          left[1] * up[2] - left[2] * up[1]))
}

random_rotation <- function() {
  turn <- qr.Q(qr(matrix(rnorm(9), 3)))
  turn * sign(det(turn))
}

# What is done to a face; each returns the face.
damages <- list(
  whole = identity,
  `inside out` = function(face) {
    face$mesh$it <- face$mesh$it[c(1, 3, 2), ]
    face$mesh$normals <- NULL
    face
  },
  `0.3 mm noise` = function(face) {
    face$mesh$vb[1:3, ] <- face$mesh$vb[1:3, ] +
      rep(rnorm(ncol(face$mesh$vb), sd = 0.3), each = 3) * face$mesh$normals[1:3, ]
    face
  },
  `5k vertices` = function(face) {
    if (ncol(face$mesh$vb) > 5000)
      face$mesh <- Rvcg::vcgQEdecim(face$mesh, tarface = 10000, silent = TRUE)
    face
  },
  shoulders = function(face) {
    ball <- Rvcg::vcgSphere(5)
    wave <- 1 + 0.05 * sin(5 * ball$vb[1, ] + runif(1, 0, 6)) * cos(4 * ball$vb[2, ])
    torso <- c(220, 110, 100) * ball$vb[1:3, ] * rep(wave, each = 3) +
      c(runif(1, -20, 20), -230, -60)
    neck <- c(60, 120, 60) * ball$vb[1:3, ] * rep(wave, each = 3) + c(0, -150, -90)
    n <- ncol(ball$vb)
    behind <- function(xyz) !(xyz[2, ] > -75 & xyz[3, ] > -90)
    extra <- cbind(torso, neck)
    it <- cbind(ball$it, ball$it + n)
    ok <- behind(extra)
    number <- cumsum(ok)
    number[!ok] <- NA
    it <- matrix(number[it], 3)
    it <- it[, !is.na(colSums(it))] + ncol(face$mesh$vb)
    placed <- crossprod(axes_of(face$landmarks), extra[, ok]) + face$landmarks["pn", ]
    face$mesh <- structure(list(vb = cbind(face$mesh$vb, rbind(placed, 1)),
                                it = cbind(face$mesh$it, it)), class = "mesh3d")
    face
  }
)

posed <- function(face) {
  turn <- random_rotation()
  shift <- rnorm(3, sd = 200)
  face$landmarks <- t(turn %*% t(face$landmarks) + shift)
  face$mesh$vb[1:3, ] <- turn %*% face$mesh$vb[1:3, ] + shift
  if (!is.null(face$mesh$normals)) face$mesh$normals[1:3, ] <- turn %*% face$mesh$normals[1:3, ]
  face
}

# One trial: a row a landmark.
trial <- function(face, damage, pose, template) {
  set.seed(1000 * pose + match(damage, names(damages)))
  face <- damages[[damage]](posed(face))
  seconds <- system.time(found <- tryCatch(find_landmarks(face$mesh, template),
                                           crestline_error = function(e) e))[["user.self"]]
  row <- data.frame(face = face$id, damage = damage, pose = pose, seconds = seconds)
  if (inherits(found, "error"))
    return(cbind(row, landmark = NA, state = "refused", confidence = NA, moved = NA, sd = NA,
                 residual = NA, lost = NA, error = NA, visible = NA, score = NA))
  placing <- found$placing[match(rownames(face$landmarks), found$placing$landmark), ]
  there <- as.matrix(crestline:::surface_points(face$mesh, face$landmarks)[1:3])
  visible <- sqrt(rowSums((there - face$landmarks)^2)) < 1
  error <- sqrt(rowSums((as.matrix(placing[c("x", "y", "z")]) - face$landmarks)^2))
  cbind(row, placing[c("landmark", "state", "confidence", "moved", "sd", "residual", "lost")],
        error = error, visible = visible, score = found$match$score,
        row.names = NULL)
}

# Results

doubted <- function(x) x$state == "absent" | x$confidence < 0.5

# `poses` of scan_a and template_male each, and `simpop_poses` of as many as `simpop` of simpop's
# faces.
run_poses <- function(poses = 10, simpop = 10, simpop_poses = 1, damage = names(damages),
                      rows = NULL) {
  all <- faces()
  chosen <- 2 + round(seq(1, length(all) - 2, length.out = simpop))
  cases <- c(rep(all[1:2], each = poses), rep(all[chosen], each = simpop_poses))
  # One pose each: all different.
  simpop_pose <- if (simpop_poses == 1) seq_len(simpop) else rep(seq_len(simpop_poses), simpop)
  pose <- c(rep(seq_len(poses), 2), simpop_pose)
  found <- NULL
  for (one in damage) {
    here <- do.call(rbind, Map(function(face, pose) trial(face, one, pose, template), cases, pose))
    show_damage(here)
    found <- rbind(found, here)
    if (!is.null(rows)) saveRDS(found, rows)
  }
  found
}

show_damage <- function(x) {
  x$error[is.na(x$error)] <- Inf
  visible <- x[is.na(x$visible) | x$visible, ]
  mean_error <- tapply(visible$error, paste(visible$face, visible$pose), mean)
  cat(sprintf(paste("%-17s %3.0f %% of %d trials; mean error %.2f mm (median trial), 95 %% of",
                    "landmarks within %.1f; %.1f user s\n"), x$damage[1],
              100 * mean(mean_error < 6), length(mean_error), median(mean_error),
              quantile(visible$error, 0.95), mean(visible$seconds)))
}

show_poses <- function(x) {
  x$error[is.na(x$error)] <- Inf
  visible <- x[is.na(x$visible) | x$visible, ]
  set <- sub("simpop.*", "simpop", x$face)
  cat("whole scans, mean error by set:",
      paste(unique(set),
            round(tapply(x$error[x$damage == "whole"], set[x$damage == "whole"], mean)[unique(set)],
                  2)), "\n")
  far <- visible$error > 5
  near <- visible$error < 3
  cat(sprintf(paste("flagged: %.0f %% of the %d that are more than 5 mm off, %.1f %% of the %d",
                    "within 3 mm; of %d missing, %d called absent\n"),
              100 * mean(doubted(visible)[far]), sum(far), 100 * mean(doubted(visible)[near]),
              sum(near), sum(!x$visible, na.rm = TRUE),
              sum(x$state[which(!x$visible)] == "absent")))
  cat("unflagged and more than 5 mm off, by set and landmark:\n")
  left <- visible[far & !doubted(visible), ]
  print(table(sub("simpop.*", "simpop", left$face), left$landmark))
}

errors_of <- function(face, template) {
  placing <- find_landmarks(face$mesh, template)$placing
  placing <- placing[match(rownames(face$landmarks), placing$landmark), ]
  data.frame(face = face$id, placing[c("landmark", "state", "confidence")],
             error = sqrt(rowSums((as.matrix(placing[c("x", "y", "z")]) - face$landmarks)^2)))
}

run_calibrated <- function(train = c(3, 10, 17)) {
  all <- faces()
  placed <- function(face) specimen(face$mesh, face$landmarks, id = face$id)
  sets <- all[-(1:2)]
  mine <- calibrate_template(template, lapply(sets[train], placed))
  rest <- do.call(rbind, lapply(sets[-train], errors_of, mine))
  plain <- do.call(rbind, lapply(sets[-train], errors_of, template))
  cat(sprintf(paste("simpop, 20 faces: uncalibrated %.2f mm, calibrated on three %.2f mm; flagged",
                    "%.1f %%\n"), mean(plain$error), mean(rest$error),
              100 * mean(doubted(rest))))
  other <- calibrate_template(template, list(placed(all$template_male)))
  cat(sprintf("scan_a: uncalibrated %.2f mm, calibrated on template_male %.2f mm\n",
              mean(errors_of(all$scan_a, template)$error),
              mean(errors_of(all$scan_a, other)$error)))
}

# Where the found landmarks lie from the placed ones, mean by set, in the face's own axes: outward
# from the mid-line, up, forward.
run_offsets <- function() {
  each <- lapply(faces(), function(face) {
    placing <- find_landmarks(face$mesh, template)$placing
    at <- as.matrix(placing[match(rownames(face$landmarks), placing$landmark), c("x", "y", "z")])
    off <- (at - face$landmarks) %*% t(axes_of(face$landmarks))
    right <- endsWith(rownames(face$landmarks), "R")
    off[right, 1] <- -off[right, 1]
    data.frame(set = sub("simpop.*", "simpop", face$id),
               landmark = sub("[LR]$", "", rownames(face$landmarks)), outward = off[, 1],
               up = off[, 2], forward = off[, 3], distance = sqrt(rowSums(off^2)))
  })
  table <- aggregate(cbind(outward, up, forward, distance) ~ landmark + set,
                     do.call(rbind, each), mean)
  table[3:6] <- round(table[3:6], 1)
  print(table, row.names = FALSE)
}

# Curves of scan_a from found landmarks beside those from placed ones: RMS distance of each from the
# other.
run_curves <- function() {
  face <- faces("scan_a")[[1]]
  folder <- file.path(shared, "scan_a")
  given <- read_specimen(file.path(folder, "surface.ply"), file.path(folder, "landmarks.csv"),
                         id = "scan_a")
  by_hand <- fit_shape(given, face_scheme(), progress = FALSE)
  alone <- fit_shape(find_landmarks(given$mesh), face_scheme(), progress = FALSE)
  distance <- function(curve) {
    a <- by_hand$paths[[curve]]
    b <- alone$paths[[curve]]
    if (is.null(a) || is.null(b)) return(NA)
    to_path <- function(p, q) min(colSums((t(as.matrix(q[c("x", "y", "z")])) - p)^2))
    one <- function(p, q) apply(as.matrix(p[c("x", "y", "z")]), 1, to_path, q)
    sqrt(mean(c(one(a, b), one(b, a))))
  }
  print(data.frame(curve = face_scheme()$curves$curve,
                   rms = round(vapply(face_scheme()$curves$curve, distance, 0), 2)),
        row.names = FALSE)
}

option <- function(name, default) {
  given <- grep(paste0("^", name, "="), asked, value = TRUE)
  if (!length(given)) return(default)
  value <- strsplit(sub("^[^=]*=", "", given), ",")[[1]]
  if (is.numeric(default)) as.numeric(value) else value
}

asked <- commandArgs(TRUE)
parts <- list(poses = function() {
  show_poses(run_poses(option("poses", 10), option("simpop", 10), option("simpop_poses", 1),
                       option("damage", names(damages)), option("rows", NULL)))
}, calibrated = run_calibrated, offsets = run_offsets, curves = run_curves)
named <- grep("=", asked, value = TRUE, invert = TRUE)
for (part in if (length(named)) named else names(parts)) {
  cat("\n", part, "\n", sep = "")
  parts[[part]]()
}
