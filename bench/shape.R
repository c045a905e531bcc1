# The whole facial model on a real scan: seconds and peak memory, one thread and two, and on the
# same scan refined.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/shape.R [times = 5]
#   CRESTLINE_SHARED=../shared/data Rscript bench/shape.R refined (a process of its own, for its
#   peak memory)
#   CRESTLINE_SHARED=../shared/data Rscript bench/shape.R raw [times = 5]
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/shape.R passes [times = 5] (processor seconds of
#   the face and of ten ridge curves, by the default and by one pass)
#
# "raw": from the file of the scan, without landmarks, to the model. Processor time (user, system)
# and elapsed time of each step: `door` is read_specimen(), `scheme` face_scheme(), `find`
# find_landmarks(), `fit` fit_shape() with standard errors and checks. A first round warms the
# session; its scheme is the one that reads the tables.
#
# scan_a as read; the refined one has every triangle divided into four, twice (1,291,985 vertices).
# The method's authors' own software takes over 460 s for the 40 curves of scan_a (measured once,
# see bench/shape.md).

library(crestline)

folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), "scan_a")
mode <- c(commandArgs(TRUE), "5")[1]

# Seconds of each step from the file of a scan to its model.
raw_steps <- function(threads) {
  took <- function(code) {
    time <- system.time(code)
    c(processor = time[["user.self"]] + time[["sys.self"]], elapsed = time[["elapsed"]])
  }
  found <- scan <- scheme <- NULL
  suppressWarnings(cbind(
    door = took(scan <- read_specimen(file.path(folder, "surface.ply"), id = "scan_a")),
    scheme = took(scheme <- face_scheme()),
    find = took(found <- find_landmarks(scan, threads = threads)),
    fit = took(fit_shape(found, scheme, threads = threads, progress = FALSE))
  ))
}

if (mode == "raw") {
  times <- as.integer(c(commandArgs(TRUE), "5")[2])
  cat("first round of the session, one thread:\n")
  print(round(raw_steps(1L), 3))
  for (threads in 1:2) {
    each <- replicate(times, raw_steps(threads))
    each <- simplify2array(list(apply(each, 1:2, stats::median), apply(each, 1:2, min)))
    dimnames(each)[[3]] <- c("median", "least")
    cat(sprintf("%d thread%s, %d rounds:\n", threads, if (threads > 1) "s" else "", times))
    for (kind in dimnames(each)[[3]]) {
      cat(kind, "\n")
      print(round(cbind(each[, , kind], all = rowSums(each[, , kind])), 3))
    }
  }
  quit("no")
}

scheme <- face_scheme()
scan <- suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                       file.path(folder, "landmarks.csv"), id = "scan_a"))
fit <- function(specimen, error, threads) {
  fit_shape(specimen, scheme, settings = ridge_settings(error = error), threads = threads,
            progress = FALSE)
}

# Processor seconds of a measurement by the default and by one pass.
against_one_pass <- function(measure, times) {
  settings <- list(default = ridge_settings(), "one pass" = ridge_settings("one pass"))
  once <- function() {
    vapply(settings, function(s) sum(system.time(suppressWarnings(measure(s)))[1:2]), 0)
  }
  once()
  once()
  seconds <- replicate(times, once())
  round(cbind(median = apply(seconds, 1, stats::median), least = apply(seconds, 1, min)), 3)
}

# Every triangle in four, at the middles of its sides.
divided <- function(mesh) {
  ends <- cbind(mesh$it[1:2, ], mesh$it[2:3, ], mesh$it[c(3, 1), ])
  key <- paste(pmin(ends[1, ], ends[2, ]), pmax(ends[1, ], ends[2, ]))
  first <- !duplicated(key)
  middle <- (mesh$vb[1:3, ends[1, first]] + mesh$vb[1:3, ends[2, first]]) / 2
  m <- t(matrix(match(key, key[first]) + ncol(mesh$vb), ncol = 3))
  it <- mesh$it
  corners <- cbind(rbind(it[1, ], m[1, ], m[3, ]), rbind(m[1, ], it[2, ], m[2, ]),
                   rbind(m[3, ], m[2, ], it[3, ]), m)
  rgl::mesh3d(vertices = rbind(cbind(mesh$vb[1:3, ], middle), 1), triangles = corners)
}

peak <- function() grep("VmHWM", readLines("/proc/self/status"), value = TRUE)

if (mode == "passes") {
  times <- as.integer(c(commandArgs(TRUE), "5")[2])
  cat("the face:\n")
  print(against_one_pass(function(s) fit_shape(scan, scheme, s, progress = FALSE), times))
  cat("ten ridge curves:\n")
  curve <- function(s) ridge_curve(scan, "chL", "st", "valley", 5, 6, 9, settings = s)
  print(against_one_pass(function(s) for (i in 1:10) curve(s), times))
} else if (mode == "refined") {
  dense <- suppressWarnings(specimen(divided(divided(scan$mesh)), scan$landmarks, id = "refined"))
  rm(scan)
  invisible(gc())
  cat(ncol(dense$mesh$vb), "vertices, before the model:", peak(), "\n")
  print(system.time(shape <- fit(dense, FALSE, 1L)))
  print(shape)
  cat("after:", peak(), "\n")
} else {
  invisible(fit(scan, TRUE, 1L))
  cases <- data.frame(error = c(FALSE, FALSE, TRUE, TRUE), threads = c(1L, 2L, 1L, 2L))
  seconds <- vapply(seq_len(nrow(cases)), function(i) {
    times <- replicate(as.integer(mode),
                       system.time(fit(scan, cases$error[i],
                                       cases$threads[i]))[c("user.self", "elapsed")])
    c(user = stats::median(times[1, ]), elapsed = stats::median(times[2, ]),
      least = min(times[2, ]))
  }, numeric(3))
  print(cbind(cases, t(seconds)))
}
