# Every figure of the landmark finder, row by row.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/finder.R [whole] [rotations] [units] [parts]
#     [expressions] [objects] [time] [kept] [ears] [n=6]
#
# 19 landmarks (without t and oi), lengths in mm. `n`: rotations, or random objects. Teeth are among
# the objects where DOOLKIT names the unpacked source of the package doolkit.

library(crestline)

shared <- Sys.getenv("CRESTLINE_SHARED")
template <- face_template()
ears <- c("tL", "tR", "oiL", "oiR")
mouth <- c("chL", "chR", "st", "ls", "li", "cphL", "cphR", "sl", "gn")
# Where data sets put these landmarks differs by more than 3 mm: no finder can serve all.
conventions <- c("gn", "se", "exL", "exR", "n")

landmarks_of <- function(table) {
  table <- table[!table$landmark %in% ears, ]
  structure(as.matrix(table[c("x", "y", "z")]), dimnames = list(table$landmark, c("x", "y", "z")))
}

folder_faces <- function(folder) {
  table <- read.csv(file.path(shared, folder, "landmarks.csv"))
  lapply(split(table, table$id), function(own) {
    id <- own$id[1]
    file <- file.path(shared, folder, paste0(id, ".ply"))
    list(id = id, mesh = suppressWarnings(read_specimen(file))$mesh, at = landmarks_of(own))
  })
}

single_face <- function(id) {
  folder <- file.path(shared, id)
  at <- read_landmarks(file.path(folder, "landmarks.csv"))
  list(id = id, mesh = read_specimen(file.path(folder, "surface.ply"))$mesh,
       at = at[!rownames(at) %in% ears, ])
}

packaged_face <- function(id, mesh) {
  file <- system.file("extdata", paste0(id, "_landmarks.csv"), package = "crestline")
  at <- read_landmarks(file)
  list(id = id, mesh = mesh, at = at[!rownames(at) %in% ears, ])
}

bundled <- new.env()
utils::data("humface", "dummyhead", package = "Rvcg", envir = bundled)
ict <- function() folder_faces("ict")
neutral <- function() Filter(function(face) grepl("^ict", face$id), ict())
expressions <- function() Filter(function(face) grepl("^expr", face$id), ict())
simpop <- function(every = 4) {
  all <- folder_faces("simpop")
  all[seq(1, length(all), every)]
}
real <- function() list(single_face("scan_a"), single_face("template_male"),
                        packaged_face("humface", bundled$humface))

moved <- function(face, turn = diag(3), shift = c(0, 0, 0), scale = 1) {
  face$mesh$vb[1:3, ] <- scale * (turn %*% face$mesh$vb[1:3, ] + shift)
  if (!is.null(face$mesh$normals)) face$mesh$normals[1:3, ] <- turn %*% face$mesh$normals[1:3, ]
  face$at[] <- scale * (t(turn %*% t(face$at) + shift))
  face
}

random_turn <- function() {
  turn <- qr.Q(qr(matrix(rnorm(9), 3)))
  turn * sign(det(turn))
}

# A row: the answer to a face, errors in mm of the face as it came (`scale` of the face here).
row_of <- function(face, scale = 1, ...) {
  seconds <- system.time(found <- tryCatch(
    suppressWarnings(find_landmarks(face$mesh, template, id = face$id, ...)),
    crestline_error = function(e) e
  ))[["user.self"]]
  row <- data.frame(id = face$id, mean = Inf, worst = Inf, verdict = "none", agree = NA,
                    score = NA, unit = NA, low = NA, seconds = round(seconds, 2))
  if (inherits(found, "error")) return(structure(row, at = NULL, message = conditionMessage(found)))
  placing <- found$placing[match(rownames(face$at), found$placing$landmark), ]
  place <- as.matrix(placing[c("x", "y", "z")])
  error <- sqrt(rowSums((place - face$at)^2)) / scale
  there <- as.matrix(crestline:::surface_points(found$mesh, face$at)[1:3])
  visible <- sqrt(rowSums((there - face$at)^2)) / scale < 1
  doubted <- placing$state == "absent" | placing$confidence < 0.5
  m <- found$match
  row[-1] <- list(mean(error[visible]), max(error[visible]), c(m$verdict, NA)[1],
                  if (is.null(m$agree)) NA else m$agree, m$score, m$unit,
                  sum(doubted[visible]), round(seconds, 2))
  each <- data.frame(id = face$id, landmark = rownames(face$at), error, visible, doubted,
                     state = placing$state, confidence = placing$confidence)
  structure(row, at = place / scale, each = each)
}

show <- function(rows) {
  table <- do.call(rbind, lapply(rows, function(row) as.data.frame(unclass(row)[1:9])))
  numbers <- vapply(table, is.numeric, NA)
  table[numbers] <- lapply(table[numbers], round, 2)
  print(table, row.names = FALSE)
  invisible(table)
}

show_flags <- function(rows) {
  each <- do.call(rbind, lapply(rows, attr, "each"))
  each <- each[each$visible, ]
  near <- each$error < 3
  far <- each$error > 5 & !each$landmark %in% conventions
  cat(sprintf("flagged: %.1f %% of %d within 3 mm; %d of %d beyond 5 mm, not by definition\n",
              100 * mean(each$doubted[near]), sum(near), sum(each$doubted[far]), sum(far)))
  left <- each[each$error > 5 & !each$doubted, c("id", "landmark", "error")]
  if (nrow(left)) print(left, row.names = FALSE, digits = 2)
}

run_whole <- function(n) {
  rows <- lapply(c(neutral(), real(), simpop()), row_of)
  show(rows)
  show_flags(rows)
}

# Each face in n poses, its vertices shuffled: the worst mean error, and how far a landmark's places
# lie from their mean over the poses, at most and in the mean.
run_rotations <- function(n) {
  for (face in c(neutral(), list(single_face("scan_a")))) {
    set.seed(1)
    rows <- lapply(seq_len(n), function(i) {
      turn <- random_turn()
      shift <- rnorm(3, sd = 200)
      row <- row_of(moved(shuffled(face), turn, shift))
      if (!is.null(attr(row, "at"))) {
        attr(row, "at") <- t(crossprod(turn, t(attr(row, "at")) - shift))
      }
      row
    })
    at <- lapply(rows, attr, "at")
    if (any(vapply(at, is.null, NA))) {
      cat(face$id, "refused in", sum(vapply(at, is.null, NA)), "\n")
      next
    }
    middle <- Reduce(`+`, at) / n
    apart <- vapply(at, function(x) sqrt(rowSums((x - middle)^2)), numeric(nrow(middle)))
    cat(sprintf("%-8s worst mean error %.2f, apart at most %.4f, in the mean %.4f; %.2f s\n",
                face$id, max(vapply(rows, `[[`, 0, "mean")), max(apart), mean(apart),
                mean(vapply(rows, `[[`, 0, "seconds"))))
  }
}

shuffled <- function(face) {
  n <- ncol(face$mesh$vb)
  order <- sample(n)
  face$mesh$vb <- face$mesh$vb[, order]
  if (!is.null(face$mesh$normals)) face$mesh$normals <- face$mesh$normals[, order]
  face$mesh$it <- matrix(match(seq_len(n), order)[face$mesh$it], 3)
  face
}

run_units <- function(n) {
  for (scale in c(1 / 200, 1 / 50, 3, 7)) {
    cat("\nscale", scale, "\n")
    show(lapply(neutral(), function(face) row_of(moved(face, scale = scale), scale)))
  }
}

axes_of <- function(at) {
  unit <- function(v) v / sqrt(sum(v^2))
  left <- unit(at["exL", ] - at["exR", ])
  up <- (at["exL", ] + at["exR", ] - at["chL", ] - at["chR", ]) / 2
  up <- unit(up - sum(up * left) * left)
  forward <- c(left[2] * up[3] - left[3] * up[2], left[3] * up[1] - left[1] * up[3],
               left[1] * up[2] - left[2] * up[1])
  rbind(left, up, forward)
}

keep <- function(face, inside) {
  number <- cumsum(inside)
  number[!inside] <- NA
  it <- matrix(number[face$mesh$it], 3)
  it <- it[, !is.na(colSums(it))]
  face$mesh <- structure(list(vb = face$mesh$vb[, inside], it = it), class = "mesh3d")
  face
}

in_axes <- function(face) axes_of(face$at) %*% (face$mesh$vb[1:3, ] - face$at["pn", ])
height_of <- function(face, names) {
  mean((axes_of(face$at) %*% (t(face$at[names, ]) - face$at["pn", ]))[2, ])
}

cuts <- list(
  nose = function(f) keep(f, sqrt(colSums((f$mesh$vb[1:3, ] - f$at["pn", ])^2)) > 22),
  side = function(f) keep(f, in_axes(f)[1, ] > -8),
  half = function(f) keep(f, in_axes(f)[1, ] > 0),
  mouth = function(f) keep(f, in_axes(f)[2, ] > height_of(f, c("sn", "sn")) - 4),
  eyes = function(f) keep(f, in_axes(f)[2, ] < height_of(f, c("enL", "enR")) - 8)
)

run_parts <- function(n) {
  all <- c(ict()[c("ict_03", "ict_09")], real()[1:2], folder_faces("simpop")["simpop_09"])
  rows <- unlist(lapply(names(cuts), function(cut) lapply(all, function(face) {
    face <- cuts[[cut]](face)
    face$id <- paste(face$id, cut)
    row_of(face)
  })), recursive = FALSE)
  table <- show(rows)
  cat(sum(table$mean < 6), "of", nrow(table), "below 6 mm\n")
  show_flags(rows)
}

run_expressions <- function(n) {
  rows <- lapply(expressions(), row_of)
  show(rows)
  for (row in rows) {
    each <- attr(row, "each")
    if (is.null(each)) next
    at_mouth <- each$landmark %in% mouth
    wrong <- each[at_mouth & each$error > 5 & !each$doubted, ]
    cat(sprintf("%-18s away %.2f, mouth %.2f (flagged %d); wrong and not flagged: %s\n", row$id,
                mean(each$error[!at_mouth]), mean(each$error[at_mouth]),
                sum(each$doubted[at_mouth]),
                paste(wrong$landmark, round(wrong$error, 1), collapse = ", ")))
  }
}

scaled <- function(mesh, size) {
  mesh$vb[1:3, ] <- size * mesh$vb[1:3, ]
  mesh
}

# A ball with bumps of all sizes, some 200 mm across.
blob <- function(seed) {
  ball <- Rvcg::vcgSphere(5)
  set.seed(seed)
  at <- matrix(rnorm(90), 3)
  at <- at / rep(sqrt(colSums(at^2)), each = 3)
  height <- runif(30, -10, 25)
  sharp <- exp(runif(30, log(8), log(150)))
  near <- t(ball$vb[1:3, ]) %*% at
  radius <- 85 + drop(exp(t(sharp * t(near - 1))) %*% height)
  stretch <- runif(3, 0.75, 1.25)
  ball$vb[1:3, ] <- stretch * ball$vb[1:3, ] * rep(radius, each = 3)
  structure(list(vb = ball$vb, it = ball$it), class = "mesh3d")
}

torus <- function(n = 120, m = 60, big = 90, small = 40) {
  a <- rep(2 * pi * seq_len(n) / n, m)
  b <- rep(2 * pi * seq_len(m) / m, each = n)
  r <- big + small * cos(b)
  cell <- function(i, j) (j - 1) %% m * n + (i - 1) %% n + 1
  i <- rep(seq_len(n), m)
  j <- rep(seq_len(m), each = n)
  it <- cbind(rbind(cell(i, j), cell(i + 1, j), cell(i + 1, j + 1)),
              rbind(cell(i, j), cell(i + 1, j + 1), cell(i, j + 1)))
  structure(list(vb = rbind(r * cos(a), r * sin(a), small * sin(b), 1), it = it),
            class = "mesh3d")
}

objects <- function(n) {
  ball <- scaled(Rvcg::vcgSphere(5), 100)
  utils::data("boneData", package = "Morpho", envir = bundled)
  head <- packaged_face("dummyhead", bundled$dummyhead.mesh)
  a <- single_face("scan_a")
  b <- ict()[["ict_05"]]
  crop <- function(face, place, radius) {
    keep(face, sqrt(colSums((face$mesh$vb[1:3, ] - place)^2)) < radius)$mesh
  }
  cheek <- function(f) colMeans(f$at[c("exL", "acL", "chL"), ]) + 20 * axes_of(f$at)[1, ]
  ear <- function() {
    at <- read_landmarks(system.file("extdata", "dummyhead_landmarks.csv", package = "crestline"))
    crop(head, colMeans(at[c("tL", "oiL"), ]), 40)
  }
  blobs <- lapply(seq_len(n), blob)
  c(list(sphere = ball, torus = torus(), skull = bundled$skull_0144_ch_fe.mesh,
         behind = keep(head, in_axes(head)[3, ] < -115)$mesh,
         behind_a = keep(a, in_axes(a)[3, ] < -90)$mesh,
         cheek = crop(a, cheek(a), 45), cheek_ict = crop(b, cheek(b), 45), ear = ear(),
         forehead = crop(a, a$at["n", ] + 60 * axes_of(a$at)[2, ], 50),
         chin = crop(a, a$at["gn", ] - 15 * axes_of(a$at)[2, ], 35)),
    stats::setNames(blobs, paste0("blob_", seq_len(n))))
}

# An orang-utan's molar: the outer surface and that of the dentine, and a model of a tooth.
teeth <- function() {
  folder <- file.path(Sys.getenv("DOOLKIT"), "data")
  if (!nzchar(Sys.getenv("DOOLKIT"))) return(list())
  load(file.path(folder, "dkpongo.rda"))
  load(file.path(folder, "dkmodel.rda"))
  all <- c(dkpongo, dkmodel)
  all <- Filter(function(one) inherits(one, "mesh3d"), all)
  stats::setNames(all, paste0("tooth_", names(all)))
}

run_objects <- function(n) {
  all <- c(teeth(), objects(n))
  rows <- Map(function(mesh, name) {
    seconds <- system.time(found <- tryCatch(
      suppressWarnings(find_landmarks(mesh, template, id = name)), crestline_error = identity
    ))[["user.self"]]
    bad <- inherits(found, "error")
    data.frame(object = name, verdict = if (bad) "none" else c(found$match$verdict, NA)[1],
               agree = if (bad || is.null(found$match$agree)) NA else round(found$match$agree, 2),
               seconds = round(seconds, 2),
               said = if (bad) substr(sub("\n.*", "", conditionMessage(found)), 1, 90) else "")
  }, all, names(all))
  table <- do.call(rbind, rows)
  print(table[!grepl("blob", table$object) | table$verdict != "none", ], row.names = FALSE)
  print(table(table$verdict))
  cat("seconds, greatest:", max(table$seconds), "\n")
}

run_time <- function(n) {
  one <- function(call) min(replicate(5, system.time(call())[["user.self"]]))
  for (face in c(list(single_face("scan_a")), neutral()[1], simpop()[1])) {
    mesh <- specimen(face$mesh, id = face$id)
    find_landmarks(mesh)
    finder <- one(function() find_landmarks(mesh))
    all <- one(function() curvature(mesh, 10))
    cat(sprintf("%s: %d vertices, finder %.2f s, curvature at 10 mm %.2f s, ratio %.2f\n", face$id,
                ncol(face$mesh$vb), finder, all, finder / all))
  }
}

# Four landmarks given as they are, the others found: their mean error without and with these four.
# Then one of them on the other side: whether it is named.
run_kept <- function(n) {
  four <- c("pn", "exL", "exR", "gn")
  error_of <- function(face, given, names) {
    scan <- suppressWarnings(specimen(face$mesh, given, id = face$id, tolerance = 0.25))
    said <- character()
    found <- withCallingHandlers(find_landmarks(scan), crestline_warning = function(w) {
      if (inherits(w, "crestline_contrary_landmarks")) said <<- conditionMessage(w)
      invokeRestart("muffleWarning")
    })
    placing <- found$placing[match(names, found$placing$landmark), ]
    at <- as.matrix(placing[c("x", "y", "z")])
    list(mean = mean(sqrt(rowSums((at - face$at[names, ])^2))), said = said)
  }
  rows <- lapply(c(neutral(), real(), simpop()), function(face) {
    rest <- setdiff(rownames(face$at), four)
    wrong <- face$at[four, ]
    wrong["exL", ] <- wrong["exR", ]
    swapped <- error_of(face, wrong, setdiff(rest, "exL"))
    kept <- error_of(face, face$at[four, ], rest)
    data.frame(id = face$id, none = error_of(face, NULL, rest)$mean, four = kept$mean,
               false_alarm = length(kept$said) > 0, wrong_side = swapped$mean,
               named = any(grepl(": exL \\([0-9.]+ off\\)[.]", swapped$said)))
  })
  table <- do.call(rbind, rows)
  print(table, row.names = FALSE, digits = 3)
  cat(sprintf("mean %.2f without, %.2f with four; at most %.2f worse; named %d of %d\n",
              mean(table$none), mean(table$four), max(table$four - table$none), sum(table$named),
              nrow(table)))
}

# The landmarks of the ears where a scan has ears: how far they are off, and their state.
run_ears <- function(n) {
  table <- read.csv(file.path(shared, "ict", "landmarks.csv"))
  own <- table[table$landmark %in% ears & grepl("^ict", table$id), ]
  at <- lapply(split(own, own$id), function(one) {
    structure(as.matrix(one[c("x", "y", "z")]), dimnames = list(one$landmark, NULL))
  })
  at$scan_a <- read_landmarks(file.path(shared, "scan_a", "landmarks.csv"))[ears, ]
  rows <- lapply(c(neutral(), list(single_face("scan_a"))), function(face) {
    found <- find_landmarks(face$mesh, id = face$id)$placing
    found <- found[match(ears, found$landmark), ]
    off <- sqrt(rowSums((as.matrix(found[c("x", "y", "z")]) - at[[face$id]][ears, ])^2))
    data.frame(id = face$id, landmark = sub(".$", "", ears), off, state = found$state)
  })
  each <- do.call(rbind, rows)
  print(aggregate(off ~ landmark + (id == "scan_a"), each, function(x) {
    round(c(mean = mean(x), `90 %` = stats::quantile(x, 0.9, names = FALSE), worst = max(x)), 1)
  }))
  print(table(each$state))
}

asked <- commandArgs(TRUE)
number <- sub("n=", "", grep("^n=", asked, value = TRUE))
number <- if (length(number)) as.numeric(number) else 6
parts <- list(whole = run_whole, rotations = run_rotations, units = run_units, parts = run_parts,
              expressions = run_expressions, objects = run_objects, time = run_time,
              kept = run_kept, ears = run_ears)
named <- intersect(asked, names(parts))
for (part in if (length(named)) named else names(parts)) {
  cat("\n", part, "\n", sep = "")
  parts[[part]](number)
}
