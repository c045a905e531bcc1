# Corruptions of a scan: no crash, and no silent nonsense.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/corruption.R [cases, default 200] [folder to keep
#   the shapes in]
#
# Every case spoils scan_a in one way, at random with the case's number as seed: holes, spikes,
# patches turned inside out, noise, decimation, a cut in two. Landmarks stay where they still lie on
# the mesh, others are NA. Each is measured by the face's scheme; an error of class crestline_error
# is a refusal, any other a crash. A point of a curve or patch that lies more than 3 mm from the
# clean scan's is seen when its part is graded amber or red; needless is the share of parts graded
# so among those with no point missing or more than 1 mm off. Then the false alarms: grades of good
# scans.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
arguments <- commandArgs(TRUE)
cases <- as.integer(c(arguments, 200)[1])
folder <- arguments[2]
off_limit <- 3 # mm
still_limit <- 1 # mm: a part with no point farther off has not moved
scheme <- face_scheme()

# Specimens ---------------------------------------------------------------

quiet <- function(code) suppressWarnings(code, classes = "crestline_warning")

face_of <- function(id) {
  quiet(read_specimen(file.path(shared, id, "surface.ply"),
                      file.path(shared, id, "landmarks.csv"), id = id))
}

humface_of <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
  quiet(specimen(data$humface, read_landmarks(file), id = "humface"))
}

simpop_faces <- function() {
  landmarks <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
  lapply(split(landmarks, landmarks$id), function(own) {
    file <- file.path(shared, "simpop", paste0(own$id[1], ".ply"))
    quiet(read_specimen(file, data.frame(name = own$landmark, own[c("x", "y", "z")]),
                        id = own$id[1]))
  })
}

measured <- function(face, ...) fit_shape(face, scheme, ..., progress = FALSE)

# Corruptions: functions of a mesh and of the places (k x 3) where damage would matter
# --------------------------

from <- function(mesh, at) sqrt(colSums((mesh$vb[1:3, , drop = FALSE] - at)^2))
normals_of <- function(mesh) Rvcg::vcgUpdateNormals(mesh, silent = TRUE)$normals[1:3, ]
without <- function(mesh, gone) {
  mesh$it <- mesh$it[, !colSums(matrix(gone[mesh$it], 3)), drop = FALSE]
  mesh
}
# k centres near the model, about `spread` mm from it.
centres <- function(places, k, spread) {
  places[sample(nrow(places), k, replace = TRUE), , drop = FALSE] + rnorm(3 * k, sd = spread)
}

corruptions <- list(
  holes = function(mesh, places) {
    radius <- runif(sample(4, 1), 3, 25)
    at <- centres(places, length(radius), 7)
    without(mesh,
            Reduce(`|`, lapply(seq_along(radius), function(i) from(mesh, at[i, ]) < radius[i])))
  },
  # Tents 3 to 20 mm high, outwards or inwards, on a disc of 0.5 to 3 mm.
  spikes = function(mesh, places) {
    at <- centres(places, sample(5:60, 1), 3)
    normal <- normals_of(mesh)
    for (i in seq_len(nrow(at))) {
      tip <- which.min(from(mesh, at[i, ]))
      share <- pmax(1 - from(mesh, mesh$vb[1:3, tip]) / runif(1, 0.5, 3), 0)
      mesh$vb[1:3, ] <- mesh$vb[1:3, ] +
        outer(normal[, tip], runif(1, 3, 20) * sample(c(-1, 1), 1) * share)
    }
    mesh
  },
  flips = function(mesh, places) {
    radius <- runif(sample(4, 1), 5, 30)
    at <- centres(places, length(radius), 7)
    for (i in seq_along(radius)) {
      inside <- which(colSums(matrix(from(mesh, at[i, ])[mesh$it] < radius[i], 3)) == 3)
      mesh$it[, inside] <- mesh$it[c(1, 3, 2), inside]
    }
    mesh
  },
  noise = function(mesh, places) {
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] + normals_of(mesh) *
      rep(rnorm(ncol(mesh$vb), sd = 0.3), each = 3)
    mesh
  },
  # A little noise first, so that no two cases are decimated alike; 2.2 faces a vertex, since
  # quadrics keep the border.
  decimation = function(mesh, places) {
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] + rnorm(3 * ncol(mesh$vb), sd = 0.02)
    Rvcg::vcgQEdecim(mesh, tarface = 5000 * ncol(mesh$it) / ncol(mesh$vb), silent = TRUE)
  },
  half = function(mesh, places) {
    height <- drop(rnorm(3) %*% mesh$vb[1:3, ])
    without(mesh, height < quantile(height, runif(1, 0.3, 0.7)))
  }
)

landmarks_left <- function(landmarks, mesh, within = 1) {
  off <- sqrt(rowSums((landmarks - as.matrix(crestline:::surface_points(mesh, landmarks)[1:3]))^2))
  replace(landmarks, cbind(rep(which(off > within), 3), rep(1:3, each = sum(off > within))), NA)
}

spoiled_case <- function(number, face, places) {
  set.seed(number)
  kind <- names(corruptions)[(number - 1) %% length(corruptions) + 1]
  mesh <- corruptions[[kind]](structure(list(vb = face$mesh$vb, it = face$mesh$it),
                                        class = "mesh3d"), places)
  mesh <- structure(list(vb = mesh$vb[1:4, ], it = mesh$it), class = "mesh3d")
  list(number = number, kind = kind, shape = tryCatch(
    measured(quiet(specimen(mesh, landmarks_left(face$landmarks, mesh), id = paste(kind, number)))),
    error = identity
  ))
}

# What came of it ---------------------------------------------------------

positions <- function(shape) as.matrix(shape$points[c("x", "y", "z")])

judged_case <- function(case, clean) {
  row <- data.frame(number = case$number, kind = case$kind,
                    refused = inherits(case$shape, "crestline_error"), crashed = FALSE, points = 0,
                    off = 0, seen = 0, parts = 0, parts_off = 0, parts_seen = 0,
                    amber = NA_real_, red = NA_real_, needless = NA_real_, unseen = "")
  if (!inherits(case$shape, "shape")) {
    row$crashed <- !row$refused
    row$unseen <- conditionMessage(case$shape)
    return(row)
  }
  graded <- quality(case$shape)
  points <- case$shape$points
  grade <- graded$grade[match(paste(points$level, points$part), paste(graded$level, graded$part))]
  off <- sqrt(rowSums((positions(case$shape) - positions(clean))^2))
  there <- points$level != "landmarks" & !is.na(off)
  far <- there & off > off_limit
  row[c("points", "off", "seen")] <- c(sum(there), sum(far), sum(far & grade > "green"))
  whole <- graded$level != "landmarks" & graded$missing == 0
  row[c("amber", "red")] <- c(mean(graded$grade[whole] == "amber"),
                              mean(graded$grade[whole] == "red"))
  part <- paste(points$level, points$part)
  counted <- function(chosen) length(unique(part[chosen]))
  row[c("parts", "parts_off", "parts_seen")] <- c(counted(there), counted(far),
                                                  counted(far & grade > "green"))
  still <- tapply(off, part, function(d) !anyNA(d) &&
                             max(d) <= still_limit)[paste(graded$level, graded$part)]
  row$needless <- mean(graded$grade[whole & still] > "green")
  silent <- far & grade == "green"
  worst <- tapply(off[silent], points$part[silent], max)
  row$unseen <- toString(sprintf("%s by %.1f", names(worst), worst))
  row
}

by_kind <- function(rows) {
  sums <- function(own, kind) {
    fitted <- own[!own$refused & !own$crashed, ]
    wrong <- fitted[fitted$off > 0, ]
    share <- function(seen, off) sum(fitted[[seen]]) / sum(fitted[[off]])
    data.frame(kind = kind, cases = nrow(own), refused = sum(own$refused),
               crashed = sum(own$crashed), points = sum(fitted$points), off = sum(fitted$off),
               seen = share("seen", "off"), parts_off = sum(fitted$parts_off),
               parts_seen = share("parts_seen", "parts_off"), cases_off = nrow(wrong),
               cases_seen = mean(wrong$seen >= 0.9 * wrong$off),
               amber = mean(fitted$amber, na.rm = TRUE), red = mean(fitted$red, na.rm = TRUE),
               needless = mean(fitted$needless, na.rm = TRUE))
  }
  rows$kind <- factor(rows$kind, names(corruptions))
  rbind(do.call(rbind, Map(sums, split(rows, rows$kind), levels(rows$kind))), sums(rows, "all"))
}

# Shares of the parts that are there; those that want a landmark that the specimen never had are
# not.
false_alarms <- function(shapes, name) {
  graded <- quality(shapes)
  there <- graded$level != "landmarks" & !grepl("there is no landmark|is missing", graded$why)
  own <- graded[there, ]
  data.frame(scans = name, parts = nrow(own), amber = mean(own$grade == "amber"),
             red = mean(own$grade == "red"), curves = sum(own$level == "curves"),
             curves_amber = mean(own$grade[own$level == "curves"] == "amber"),
             curves_red = mean(own$grade[own$level == "curves"] == "red"))
}

options(width = 200)
rounded <- function(table) {
  numbers <- vapply(table, is.double, NA)
  table[numbers] <- lapply(table[numbers], round, 3)
  print(table, row.names = FALSE)
}

good <- list(scan_a = face_of("scan_a"), template_male = face_of("template_male"),
             humface = humface_of())
shapes <- lapply(good, measured)
clean <- shapes$scan_a
known <- positions(clean)[!is.na(clean$points$x), ]

rows <- lapply(seq_len(cases), function(number) {
  kept <- if (!is.na(folder)) file.path(folder, sprintf("%03d.rds", number))
  case <- if (length(kept) && file.exists(kept)) readRDS(kept) else
    spoiled_case(number, good$scan_a, known)
  if (length(kept)) saveRDS(case, kept)
  row <- judged_case(case, clean)
  said <- if (row$crashed) paste("CRASH:", row$unseen) else if (row$refused) "refused" else {
    unseen <- if (nzchar(row$unseen)) paste("; unseen:", row$unseen) else ""
    sprintf("%d of %d points off, %d seen%s", row$off, row$points, row$seen, unseen)
  }
  cat(sprintf("%3d %-10s %s\n", number, case$kind, said))
  row
})
rows <- do.call(rbind, rows)
half <- ifelse(rows$number <= cases / 2, "first", "second")
cat("\nCorruptions\n")
rounded(by_kind(rows))
for (name in unique(half)) {
  cat("\nThe", name, "half of them\n")
  rounded(by_kind(rows[half == name, ]))
}

simpop <- simpop_faces()
alone <- lapply(simpop, measured)
shortest <- min(vapply(alone, function(shape) min(shape$checks$cut, na.rm = TRUE), 0))
simpop_cut <- lapply(simpop, measured, measuring = shape_settings(cut_scale = shortest))
if (!is.na(folder))
  saveRDS(c(shapes, alone = alone, cut = simpop_cut), file.path(folder, "good.rds"))
cat("\nFalse alarms\n")
rounded(rbind(do.call(rbind, Map(false_alarms, shapes, names(shapes))),
              false_alarms(alone, "simpop, each cut at its own share"),
              false_alarms(simpop_cut, sprintf("simpop, all cut at %.2f of it", shortest))))
