# Section 5.3: curves of one face measured twice.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/manual.R [authors] [humface] [pictures]
#
# `authors`: scan_a and template_male by face_scheme() beside the curves of the method's authors:
# curve_distance() by curve, to the nearest place and between points of one number, with our
# settings and the paper's; then repeatability() of the two faces, ours and theirs as two observers.
# Curves to the ear are left out. `humface`: the face marked twice, landmarks and curves.
# `pictures`: the second marking and both sets of curves, into manual-*.png of the working folder.

library(crestline)

xyz <- c("x", "y", "z")
rms <- function(x) sqrt(mean(x^2, na.rm = TRUE))
scheme <- face_scheme()
to_ear <- scheme$curves$curve[!is.na(scheme$curves$cut_share)]

fitted <- function(face, settings = ridge_settings(error = FALSE)) {
  own <- scheme$curves[scheme$curves$from %in% rownames(face$landmarks) &
                       !scheme$curves$curve %in% to_ear, ]
  fit_shape(face, curve_scheme(scheme$landmarks, own), settings, progress = FALSE)
}

authors_case <- function(id) {
  folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), id)
  face <- suppressWarnings(read_specimen(file.path(folder, "surface.ply"),
                                         file.path(folder, "landmarks.csv"), id = id))
  theirs <- attr(read_landmarks(file.path(folder, "reference_curves.csv")), "curves")
  list(face = face, theirs = theirs, ours = fitted(face),
       paper = fitted(face, ridge_settings("paper", error = FALSE)))
}

# Curves of both as lists of matrices, those that both have whole.
common_curves <- function(a, b) {
  points <- split(a$points[a$points$level == "curves", xyz],
                  a$points$part[a$points$level == "curves"])
  a <- Filter(Negate(anyNA), lapply(points, as.matrix))
  both <- intersect(names(a), names(b))
  list(a = a[both], b = lapply(b[both], as.matrix))
}

kind_of <- function(curve) {
  ifelse(scheme$curves$kind[match(curve, scheme$curves$curve)] == "plane", "cut", "by curvature")
}
base_name <- function(curve) sub(" (left|right)$", "", curve)

compare_authors <- function() {
  cases <- lapply(c(scan_a = "scan_a", template_male = "template_male"), authors_case)
  rows <- lapply(names(cases), function(id) {
    case <- cases[[id]]
    distances <- function(shape) {
      both <- common_curves(shape, case$theirs)
      near <- curve_distance(both$a, both$b, between = "curves")
      data.frame(part = near$part, near = near$rms, max = near$max,
                 points = curve_distance(both$a, both$b)$rms)
    }
    merged <- merge(distances(case$ours), distances(case$paper), by = "part",
                    suffixes = c("", "_paper"))
    data.frame(face = id, kind = kind_of(merged$part), curve = base_name(merged$part), merged[-1])
  })
  table <- do.call(rbind, rows)
  numbers <- c("near", "max", "points", "near_paper", "points_paper")
  by_curve <- aggregate(table[numbers], table[c("face", "kind", "curve")], rms)
  by_curve <- by_curve[order(by_curve$face, by_curve$kind, -by_curve$near), ]
  print(data.frame(by_curve[1:3], round(by_curve[numbers], 2)), row.names = FALSE)
  overall <- aggregate(table[numbers], table[c("face", "kind")], rms)
  print(data.frame(overall[1:2], round(overall[numbers], 2)), row.names = FALSE)
  observers_of(cases)
}

# The two faces, each by two observers: the authors and us.
observers_of <- function(cases) {
  both <- lapply(cases, function(case) common_curves(case$ours, case$theirs))
  parts <- Reduce(intersect, lapply(both, function(x) names(x$a)))
  stack <- function(curves) {
    points <- do.call(rbind, curves[parts])
    rownames(points) <- unlist(lapply(parts,
                                      function(part) paste(part, seq_len(nrow(curves[[part]])))))
    points
  }
  coords <- simplify2array(unlist(lapply(both, function(x) list(stack(x$a), stack(x$b))),
                                  recursive = FALSE))
  print(repeatability(coords, rep(names(cases), each = 2), rep(c("crestline", "authors"), 2)),
        most = 30)
}

humface_twice <- function() {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  file <- function(name) system.file("extdata", name, package = "crestline", mustWork = TRUE)
  first <- read_landmarks(file("humface_landmarks.csv"))
  second <- read_landmarks(file("humface_landmarks_2.csv"))[rownames(first), ]
  lapply(list(first = first, second = second),
         function(at) specimen(data$humface, at, id = "humface"))
}

# Places of a curve between two shares of its length, evenly.
places_of <- function(path, from, to, n) {
  sapply(path[xyz], function(v) approx(path$s, v, seq(from, to, length.out = n) * max(path$s))$y)
}

compare_humface <- function() {
  faces <- humface_twice()
  moved <- sqrt(rowSums((faces$first$landmarks - faces$second$landmarks)^2))
  print(round(sort(moved), 2))
  ears <- grepl("^(t|oi)[LR]$", names(moved))
  cat(sprintf("landmarks: RMS %.2f, mean %.2f; without the ears' %.2f, %.2f\n", rms(moved),
              mean(moved), rms(moved[!ears]), mean(moved[!ears])))
  shapes <- lapply(faces, fit_shape, scheme, progress = FALSE)
  near <- curve_distance(shapes$first, shapes$second, between = "curves")
  numbered <- curve_distance(shapes$first, shapes$second)
  ends <- scheme$curves[match(near$part, scheme$curves$curve), ]
  # Of the middle, how far the one is from the whole of the other, both ways.
  inner <- vapply(near$part, function(part) {
    paths <- lapply(shapes, function(shape) shape$paths[[part]])
    off <- function(a, b) {
      crestline:::nearest_on_polyline(places_of(a, 0.2, 0.8, 100), as.matrix(b[xyz]))$distance
    }
    rms(c(off(paths$first, paths$second), off(paths$second, paths$first)))
  }, 0)
  table <- data.frame(curve = near$part, kind = kind_of(near$part), to_ear = near$part %in% to_ear,
                      ends = sqrt((moved[ends$from]^2 + moved[ends$to]^2) / 2), whole = near$rms,
                      inner, points = numbered$rms, row.names = NULL)
  print(data.frame(table[1:3],
                   round(table[-(1:3)], 2))[order(table$to_ear, table$kind, table$inner), ],
        row.names = FALSE)
  print(aggregate(table[4:7], table[c("to_ear", "kind")], function(x) round(rms(x), 2)),
        row.names = FALSE)
  curved <- table[table$kind != "cut", ]
  print(rbind(all = vapply(table[4:7], rms, 0), curved = vapply(curved[4:7], rms, 0),
              "but the left upper lip" = vapply(curved[curved$curve != "upper lip left", 4:7], rms,
                                                0)), digits = 3)
  for (level in c("landmarks", "curves")) {
    measured <- repeatability(shapes, c("humface", "humface"), level = level)
    cat(sprintf("%s: error %.2f mm over %d points\n", level, utils::tail(measured$parts$error, 1),
                utils::tail(measured$parts$points, 1)))
  }
  invisible(list(faces = faces, shapes = shapes))
}

draw_humface <- function() {
  twice <- compare_humface()
  for (view in c("front", "left", "three-quarter")) {
    grDevices::png(sprintf("manual-%s.png", view), 1400, 900)
    graphics::layout(t(1:2))
    for (i in 1:2) {
      plot(twice$shapes[[i]], twice$faces[[i]], "plain", patches = FALSE, view = view,
           engine = "picture", main = names(twice$faces)[i])
    }
    grDevices::dev.off()
  }
}

asked <- commandArgs(TRUE)
if (!length(asked)) asked <- c("authors", "humface")
options(width = 150)
if ("authors" %in% asked) compare_authors()
if ("humface" %in% asked) compare_humface()
if ("pictures" %in% asked) draw_humface()
