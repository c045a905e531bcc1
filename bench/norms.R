# How good are norms? Simulated cohorts of known truth: calibration, family-wise errors, lesions,
# the healed face, errors of the scan, privacy, speed.
#
#   Rscript bench/norms.R fit N SEED [SYMMETRIC]  one norm of N faces: time, memory, privacy, file;
#                                                 kept as norms-N-SEED.rds in $CRESTLINE_NORMS;
#                                                 SYMMETRIC: share of the variance (0.85)
#   Rscript bench/norms.R z N SEED FACES          z of new faces alone: no scan is fitted
#   Rscript bench/norms.R file N SEED             a kept norm written, read and used
#   Rscript bench/norms.R look N SEED PART [FACES]  a kept norm by FACES new faces; PART:
#                                                 calibration, worse, own, lesions, healed, time
#   Rscript bench/norms.R pool N                  the figures of all kept looks at norms of N faces,
#                                                 mean over norms by number of faces, and range
#
#   Rscript bench/norms.R visits FACES SEED [CASE]  two visits of FACES people: 0.15 mm independent
#                                                 and 0.15 mm of range 8 mm at each visit; CASE:
#                                                 height of the change, 0, 3 or 6 mm
#   Rscript bench/norms.R lone N SEED             a norm of N with one man beyond all others, to be
#                                                 shared: refused, until what the errors say is done
#   Rscript bench/norms.R simpop 45 1             a norm of Morpho's 45 faces, if they are there
#
# Each row printed is `what value count`. Faces have the fields, errors and ages of
# simulate_cohort(); new faces go through the same functions as assess() uses, many at once.

suppressPackageStartupMessages(library(crestline))
options(rgl.useNULL = TRUE)
arguments <- commandArgs(TRUE)
mode <- arguments[1]
n <- as.integer(arguments[2])
seed <- if (mode == "pool") NA else as.integer(arguments[3])
own <- function(name) getFromNamespace(name, "crestline")
folder <- Sys.getenv("CRESTLINE_NORMS", tempdir())
kept_file <- function(what) file.path(folder, sprintf("norms-%d-%s.rds", n, what))
rows <- NULL
say <- function(what, value, count = NA) {
  cat(sprintf("%-52s %s %s\n", what, paste(signif(value, 3), collapse = " "),
              if (anyNA(count)) "" else paste0("(", toString(unique(count)), ")")))
  keep(what, value, count)
}
# Kept for `pool` without being printed
keep <- function(what, value, count = NA) {
  own <- if (is.null(names(value))) seq_along(value) else names(value)
  names <- if (length(value) > 1) paste(what, own, sep = ": ") else what
  rows <<- rbind(rows, data.frame(what = names, value = as.vector(value), count = count))
}

if (mode == "fit") {
  settings <- cohort_settings()
  if (length(arguments) > 3) settings$symmetric <- as.numeric(arguments[4])
  cohort <- simulate_cohort(n, seed = seed, settings = settings)
  gc(reset = TRUE)
  time <- system.time(norms <- fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data,
                                         progress = FALSE))
  say("fit, seconds elapsed, user", time[c(3, 1)])
  say("fit, MB at most above what was there", sum(gc()[, 6]))
  say("privacy: ratio, auc, least effective", unlist(norms$privacy))
  saveRDS(list(norms = norms, settings = settings), kept_file(seed))
  saveRDS(rows, kept_file(paste0(seed, "-fit")))
}

if (mode == "file") {
  norms <- readRDS(kept_file(seed))$norms
  dir <- tempfile("norms")
  write_norms(norms, dir)
  say("file, KB", sum(file.size(list.files(dir, full.names = TRUE))) / 1024)
  time <- system.time(read <- read_norms(dir))
  say("reading, seconds elapsed, user", time[c(3, 1)])
  patient <- simulate_cohort(1, data = data.frame(age = 20, sex = "male"), seed = 1)$sample[[1]]
  z <- lapply(list(norms, read), function(one) assess(patient, one, 20, "male"))
  say("largest difference of z after reading", max(
    abs(z[[1]]$values$z - z[[2]]$values$z),
    abs(z[[1]]$points$z_map - z[[2]]$points$z_map), abs(z[[1]]$points$z_scan - z[[2]]$points$z_scan)
  ))
}

# New faces: data as fit_parts() has it, from a seed of their own.
new_faces <- function(norms, settings, count, seed, lesions = NULL, ages = c(4, 39)) {
  template <- own("cohort_template")()
  model <- own("cohort_model")(template, settings)
  given <- own("check_lesions")(lesions, count, model)
  drawn <- own("with_seed")(seed, own("draw_people")(model, count, ages, NULL, given, settings,
                                                      1))
  xyz <- drawn$visits[[1]]
  plan <- own("measurement_plan")(norms$measurements, template$scheme)
  shapes <- own("cohort_sample")(model, xyz, drawn$data$id, settings)$shapes
  measured <- own("unbiased_values")(unname(shapes), plan)
  logs <- norms$table$transform[1 + seq_len(ncol(measured))] == "log"
  measured[, logs] <- log(measured[, logs])
  reference <- as.matrix(norms$points[c("x", "y", "z")])
  laid <- lapply(seq_len(count), function(i) own("lay_face")(xyz[model$surface, , i], reference))
  side <- norms$points$side
  y <- t(vapply(laid, function(one) as.vector(one$laid), numeric(length(reference))))
  off <- t(vapply(laid, function(one) {
    as.vector(own("asymmetric_part")(one$laid, norms$points$partner)[side, ])
  }, numeric(3 * sum(side))))
  list(points = norms$points, y = y, off = off,
       values = cbind(size = vapply(laid, function(one) {
         own("unbiased_log_size")(one$size, rep(settings$noise, nrow(reference)))
       }, 0), measured),
       shapes = shapes, scale = vapply(laid, `[[`, 0, "scale"), lesions = drawn$lesions,
       people = list(age = drawn$data$age, group = factor(drawn$data$sex, norms$ages$sex)))
}

# What assess() says of all of them.
looked_at <- function(norms, data, noise) {
  age <- data$people$age
  group <- data$people$group
  all <- seq_along(age)
  values <- cbind(data$values, own("field_scores")(norms$surface, data$y, age, group))
  expected <- own("expected_columns")(norms$values, age, group)
  z <- own("straightened")(own("predicted_z")(values, expected), norms$table)
  se_norm <- own("norm_error")(z, expected)
  along <- own("normal_part")(data$y, norms$surface$points, norms$surface$normal)
  map <- own("predicted_z")(along, own("expected_columns")(norms$surface$along, age, group))
  scan <- function(name, y) {
    field <- own("prepared_field")(norms, name)
    u <- own("field_deviations")(field, y, age, group)
    t <- lapply(field$weights, function(w) u %*% w)
    # The extra variance of a worse scan, by each face's own spread and scale, as assess() has it
    sd <- own("expected_columns")(field$columns, age, group)$sd
    both <- if (name == "surface") 1 else sqrt(2)
    base <- norms$points$se_norm[if (name == "surface") TRUE else norms$points$side] / both
    excess <- pmax(0, outer((noise * data$scale / both)^2, rep(base, 3)^2, `-`)) / sd^2
    extra <- lapply(field$weights, function(w) excess %*% w^2)
    list(plain = own("scan_maps")(t, field$scan, age, group),
         widened = own("scan_maps")(t, field$scan, age, group, extra))
  }
  columns <- own("expected_columns")(norms$surface$columns, age, group)
  list(z = z, se_norm = se_norm, map = apply(abs(map), 1, max), map_at = max.col(abs(map)),
       p_tangential = own("tangential_parts")(norms$points, data$y, columns)$p,
       surface = scan("surface", data$y), asymmetry = scan("asymmetry", data$off))
}

limit_of <- function(quantiles) quantiles[own("limit_levels")() == 0.95]
beyond <- function(maps, norms, name, kept = TRUE) {
  mean((apply(maps$largest, 1, max) > limit_of(norms[[name]]$scan$quantiles))[kept])
}

# Which faces assess() does not refuse for their age.
assessable <- function(parts, ages, people) {
  effective <- own("effective_faces")(parts, people$age, people$group)
  range <- ages[match(people$group, ages$sex), ]
  kept <- effective >= 10 & people$age >= range$from & people$age <= range$to
  say("refused by effective number or age", mean(!kept), length(kept))
  kept
}

# z by kind, band of age and sex; tails of the measurements.
calibrated_z <- function(found, data, kept) {
  kind <- ifelse(colnames(found$z) == "size", "size",
                 ifelse(grepl("^component ", colnames(found$z)), "components", "measurements"))
  band <- cut(data$people$age, c(3, 8, 13, 18, 40), include.lowest = TRUE)
  for (one in unique(kind)) {
    inside <- rowMeans(abs(found$z[, kind == one, drop = FALSE]) <= 1.96)
    say(paste("within 1.96:", one), mean(inside[kept]), sum(kept))
    for (sex in c("female", "male")) {
      own_rows <- kept & data$people$group == sex
      cells <- tapply(inside[own_rows], band[own_rows], mean)
      say(paste0("  ", one, ", ", sex, ", by band"), cells, as.vector(table(band[own_rows])))
    }
  }
  measured <- found$z[kept, kind == "measurements"]
  names <- paste(rep(colnames(measured), 2), rep(c("above", "below"), each = ncol(measured)))
  tails <- stats::setNames(c(colMeans(measured > 1.96), colMeans(measured < -1.96)), names)
  keep("tail", tails, sum(kept))
  say("tails of measurements, least, median, largest", stats::quantile(tails, c(0, 0.5, 1)),
      sum(kept))
  say("tails within 0.02-0.03", mean(tails >= 0.02 & tails <= 0.03))
}

calibration <- function(norms, settings, faces) {
  data <- new_faces(norms, settings, faces, 1000 + seed, ages = c(3, 40))
  kept <- assessable(norms, norms$ages, data$people)
  band <- cut(data$people$age, c(3, 8, 13, 18, 40), include.lowest = TRUE)
  found <- looked_at(norms, data, settings$noise)
  calibrated_z(found, data, kept)
  say("along the surface: p above 0.05", mean(found$p_tangential[kept, ] > 0.05), sum(kept))
  limit <- if (norms$n < 200) NA else limit_of(norms$limits$map)
  say("family-wise: marginal map", mean(found$map[kept] > limit), sum(kept))
  say("family-wise: scan", beyond(found$surface$plain, norms, "surface", kept), sum(kept))
  say("  scan, by band", tapply((apply(found$surface$plain$largest, 1, max) >
                                   limit_of(norms$surface$scan$quantiles))[kept], band[kept],
                                mean), as.vector(table(band[kept])))
  say("family-wise: asymmetry scan", beyond(found$asymmetry$plain, norms, "asymmetry", kept),
      sum(kept))
  u <- data$off
  expected <- own("expected_columns")(norms$asymmetry$along, data$people$age, data$people$group)
  off <- own("normal_part")(u, norms$asymmetry$points, norms$asymmetry$normal)
  say("directional asymmetry: |z| <= 1.96 against the norm",
      mean(abs(own("predicted_z")(off, expected)) <= 1.96))
}

worse_scans <- function(norms, settings, faces) {
  for (noise in c(0.3, 0.5)) {
    worse <- settings
    worse$noise <- noise
    data <- new_faces(norms, worse, faces, 2000 + seed)
    found <- looked_at(norms, data, noise)
    say(sprintf("noise %g: scan plain, widened", noise),
        c(beyond(found$surface$plain, norms, "surface"),
          beyond(found$surface$widened, norms, "surface")), faces)
    measured <- which(!grepl("^component |^size$", colnames(found$z)))
    # On the wider scale, with each face's own standard errors, as assess() has it
    each <- lapply(data$shapes, own("own_errors"), norms)
    of <- function(name) t(vapply(each, function(one) one[[name]][measured], 0 * measured))
    expected <- own("expected_columns")(norms$values, data$people$age, data$people$group)
    part <- lapply(expected, function(x) x[, measured])
    extra <- pmax(0, of("se")^2 - rep(norms$table$se_norm[measured]^2, each = faces))
    z <- lapply(list(plain = 0, wide = extra), function(extra) {
      own("straightened")(own("predicted_z")(of("value"), part, extra), norms$table[measured, ])
    })
    say(sprintf("noise %g: measurements within 1.96, plain, widened", noise),
        vapply(z, function(z) mean(abs(z) <= 1.96, na.rm = TRUE), 0), faces)
    say(sprintf("noise %g: measurements not larger than what errors add", noise),
        mean(is.na(z$wide)), faces)
    inside <- split(colMeans(abs(z$wide) <= 1.96, na.rm = TRUE), norms$measurements$kind)
    say(sprintf("noise %g: the same by kind, widened", noise), vapply(inside, mean, 0), faces)
    say(sprintf("noise %g: least and largest of a measurement", noise), range(unlist(inside)),
        faces)
  }
}

# A norm of values alone, and z of new faces: what `calibration` says of z, without any scan.
only_z <- function(faces) {
  settings <- cohort_settings()
  cohort <- simulate_cohort(n, seed = seed, settings = settings)
  scheme <- cohort$sample$template$scheme
  table <- face_measurements()
  made <- own("norm_data")(cohort$sample, own("measurement_plan")(table, scheme), 1e-3)
  made$off <- NULL
  made$people <- own("norm_people")(~ s(age, by = sex), cohort$data, names(cohort$sample))
  made$table <- table
  made <- own("transformed_values")(made)
  plan <- own("norm_plan")(norm_settings(), made$people)
  parts <- own("fit_parts")(made, seq_len(n), plan)
  scores <- function(y, people) {
    own("field_scores")(parts$surface, y, people$age, people$group)
  }
  z_of <- function(fit, values, people) {
    own("predicted_z")(values, own("expected_columns")(fit, people$age, people$group))
  }
  # Held out are mean and spread of the values; the components are those of all faces.
  all <- cbind(made$values, scores(made$y, made$people))
  fold <- integer(n)
  fold[order(made$people$group, made$people$age)] <- rep_len(seq_len(plan$folds), n)
  held <- lapply(seq_len(plan$folds), function(one) {
    rows <- fold == one
    fit <- own("smooth_columns")(all[!rows, ], made$people$age[!rows], made$people$group[!rows],
                                 plan$size_values)
    z_of(fit, all[rows, ], list(age = made$people$age[rows], group = made$people$group[rows]))
  })
  skew <- own("skew_table")(do.call(rbind, held))
  transform <- c(made$transform, rep("as is", plan$components))
  ages <- lapply(split(made$people$age, made$people$group), range)
  ages <- data.frame(sex = names(ages), from = vapply(ages, `[`, 0, 1),
                     to = vapply(ages, `[`, 0, 2))
  data <- new_faces(list(points = made$points, measurements = made$table, ages = ages,
                         table = data.frame(transform = transform)),
                    settings, faces, 1000 + seed, ages = c(3, 40))
  kept <- assessable(parts, ages, data$people)
  values <- cbind(data$values, scores(data$y, data$people))
  z <- own("straightened")(z_of(parts$values, values, data$people), skew)
  calibrated_z(list(z = z), data, kept)
  saveRDS(rows, kept_file(paste0(seed, "-z")))
}

# z of the same faces without noise, within 1.96 of their own standard errors: size and all
# measurements, as assess() has them.
own_error <- function(norms, settings, faces) {
  clean <- settings
  clean$noise <- 0
  truth <- new_faces(norms, clean, faces, 3000 + seed)
  for (noise in c(0.1, 0.3, 0.5, 0.7)) {
    noisy <- settings
    noisy$noise <- noise
    data <- new_faces(norms, noisy, faces, 3000 + seed)
    each <- lapply(data$shapes, own("own_errors"), norms)
    of <- function(name) t(vapply(each, function(one) one[[name]], 0 * truth$values[1, ]))
    covered <- colMeans(abs((of("value") - truth$values) / of("se")) <= 1.96, na.rm = TRUE)
    say(sprintf("own error, noise %g: share covered", noise), mean(covered), faces)
    kind <- c("size", norms$measurements$kind)
    say(sprintf("own error, noise %g: by kind", noise), tapply(covered, kind, mean), faces)
  }
}

lesions <- function(norms, settings, faces) {
  distance <- as.matrix(stats::dist(norms$surface$points))
  side <- which(norms$points$side)
  for (height in c(1, 2, 3)) {
    data <- new_faces(norms, settings, faces, 4000 + seed,
                      data.frame(height = height, radius = 15))
    found <- looked_at(norms, data, settings$noise)
    at <- match(data$lesions$point, norms$points$point)
    scan <- scan_near(found$surface$plain, norms, distance, at)
    map <- found$map > limit_of(norms$limits$map) & distance[cbind(found$map_at, at)] <= 15
    say(sprintf("lesion %g mm on 3 cm: scan, marginal map", height), c(mean(scan), mean(map)),
        faces)
    other <- found$asymmetry$plain
    row <- ifelse(at %in% side, at, norms$points$partner[at])
    off_middle <- abs(norms$points$x[at] - stats::median(norms$points$x)) > 15 & row %in% side
    where <- side[max.col(Reduce(pmax, lapply(other$z, abs)))]
    hit <- apply(other$largest, 1, max) > limit_of(norms$asymmetry$scan$quantiles)
    near <- distance[cbind(where, row)] <= 15
    say(sprintf("lesion %g mm, asymmetry scan, off the mid-line", height),
        mean((hit & near)[off_middle]), sum(off_middle))
    # The same on the other side too, by the norm's own points
    partner <- norms$points$partner[at]
    put <- height * data$scale * t(own("bump")(lesion_distances(settings)[, partner], 15))
    data$y <- data$y + cbind(put, put, put) * rep(as.vector(norms$surface$normal), each = faces)
    found <- looked_at(norms, data, settings$noise)
    scan <- scan_near(found$surface$plain, norms, distance, at) |
      scan_near(found$surface$plain, norms, distance, partner)
    say(sprintf("lesion %g mm on both sides, off the mid-line: scan", height),
        mean(scan[off_middle]), sum(off_middle))
  }
}

# Distances by which lesions are drawn: those of the template, which is larger than a norm's mean
lesion_distances <- function(settings) {
  model <- own("cohort_model")(own("cohort_template")(), settings)
  as.matrix(stats::dist(model$places[model$surface, ]))
}

# Whether the scan finds something, within 15 mm of a place. What is on both sides has one value on
# both: the first of them is taken, always.
scan_near <- function(scan, norms, distance, at) {
  where <- max.col(Reduce(pmax, lapply(scan$z, abs)), "first")
  apply(scan$largest, 1, max) > limit_of(norms$surface$scan$quantiles) &
    distance[cbind(where, at)] <= 15
}

healed <- function(norms, settings, faces) {
  field <- own("prepared_field")(norms, "surface")
  distance <- lesion_distances(settings)
  for (case in list(c(0, 15), c(3, 15), c(5, 30), c(8, 45))) {
    data <- new_faces(norms, settings, faces, 5000 + seed,
                      data.frame(height = case[1], radius = case[2]))
    if (case[1] == 0) data$lesions$point <- NA
    each <- lapply(seq_len(faces), function(i) {
      age <- data$people$age[i]
      sex <- data$people$group[i]
      face <- own("standardised_face")(field, data$y[i, ], age, sex)
      face$excess <- 0 * face$u
      made <- own("heal_face")(field, face, age, sex, rep(FALSE, nrow(field$points)), 0.05)
      took <- matrix((face$u - made$u) * face$spread, ncol = 3)
      along <- rowSums(took * field$normal) / data$scale[i]
      at <- match(data$lesions$point[i], norms$points$point)
      # What was put on
      put <- if (is.na(at)) 0 * along else {
        case[1] * own("bump")(distance[at, ], case[2])
      }
      sd <- sqrt(own("variance_along")(field$normal, made$variance * face$spread^2)) / data$scale[i]
      out <- made$out
      c(touched = any(out), height = if (is.na(at)) NA else along[at],
        covered = if (any(out)) mean(abs(along - put)[out] <= 1.96 * sd[out]) else NA)
    })
    each <- do.call(rbind, each)
    say(sprintf("healed, %g mm on %g cm: share touched", case[1], case[2] / 5),
        mean(each[, "touched"]), faces)
    touched <- each[, "touched"] == 1
    if (case[1] > 0 && any(touched)) {
      label <- sprintf("healed, %g mm on %g cm:", case[1], case[2] / 5)
      say(paste(label, "height where touched, mean, sd"),
          c(mean(each[touched, "height"]), stats::sd(each[touched, "height"])) / case[1],
          sum(touched))
      say(paste(label, "points within the interval"), mean(each[touched, "covered"]),
          sum(touched))
    }
  }
}

# assess() itself, of one face.
timed <- function(norms, settings, faces) {
  time <- system.time(own("prepared_field")(norms, "surface"))
  say("preparing the scan, seconds elapsed, user", time[c(3, 1)])
  patient <- simulate_cohort(1, data = data.frame(age = 20, sex = "male"), seed = 1)
  suppressWarnings(assess(patient$sample[[1]], norms, 20, "male"))
  time <- system.time(assess(patient$sample[[1]], norms, 20, "male"))
  say("assess, seconds elapsed, user", time[c(3, 1)])
}

# Errors of two visits are those of `visit_settings(range = 8, share = 0.5)`.
visits <- function(faces, only) {
  people <- data.frame(age = rep(25, faces), sex = "female")
  for (case in list(c(0, 15), c(3, 30), c(6, 45))) {
    if (length(only) && case[1] != only) next
    lesion <- data.frame(height = case[1], radius = case[2], visit = 2)
    simulated <- function(seed, noise, range = 0) {
      simulate_cohort(faces, data = people, lesions = lesion, visits = 2, seed = seed,
                      settings = cohort_settings(noise = noise, noise_range = range, turn = 0,
                                                 shift = 0))
    }
    clean <- simulated(100 + seed, 0)
    # Errors of both kinds, each of random numbers of its own
    errors <- lapply(list(c(100 + seed, 0), c(50100 + seed, 8)), function(one) {
      with <- simulated(one[1], 0.15, one[2])
      without <- simulated(one[1], 0)
      lapply(c(sample = "sample", second = "second"), function(visit) {
        Map(function(a, b) own("point_columns")(a) - own("point_columns")(b),
            with[[visit]]$shapes, without[[visit]]$shapes)
      })
    })
    each <- lapply(seq_len(faces), function(i) visit_row(errors, clean, i))
    each <- do.call(rbind, each)
    label <- sprintf("visits, %g mm on %g cm:", case[1], case[2] / 5)
    say(paste(label, "unchanged points called, family-wise"), mean(each[, "any"]), faces)
    say(paste(label, "unchanged points beyond 1.96"), mean(each[, "points"]), faces)
    # With the standard error of the ratio, from the spread between faces
    ratio <- function(square) {
      square <- square[is.finite(square)]
      root <- sqrt(mean(square))
      c(root, stats::sd(square) / sqrt(length(square)) / (2 * root))
    }
    say(paste(label, "error of a point over its standard error, +-"), ratio(each[, "square"]),
        faces)
    say(paste(label, "the same of patches, +-"), ratio(each[, "patch"]), faces)
    say(paste(label, "the same of measurements, +-"), ratio(each[, "measured"]), faces)
    if (case[1] > 0) {
      say(paste(label, "change at the centre, over the true one"), mean(each[, "centre"]), faces)
      say(paste(label, "centre called"), mean(each[, "found"]), faces)
    }
  }
}

# Both errors are added to one face, whose second visit is turned and moved.
visit_row <- function(errors, clean, i) {
  noisy <- function(visit) {
    shape <- clean[[visit]][[i]]
    xyz <- c("x", "y", "z")
    for (one in errors) shape$points[xyz] <- shape$points[xyz] + one[[visit]][[i]]
    shape$points$se <- 0.15 * sqrt(2)
    shape
  }
  after <- noisy("second")
  turned <- as.matrix(after$points[c("x", "y", "z")]) %*% own("rotation_about")(c(0.1, -0.2, 0.1))
  after$points[c("x", "y", "z")] <- as.data.frame(turned + 5)
  found <- compare_visits(noisy("sample"), after,
                          settings = visit_settings(range = 8, share = 0.5))
  surface <- found$points[found$points$level == "surface", ]
  at <- match(clean$lesions$point[i], paste(surface$part, surface$point))
  xyz <- as.matrix(surface[c("x", "y", "z")])
  lesion <- clean$lesions[i, ]
  far <- if (is.na(at)) rep(TRUE, nrow(xyz)) else
    own("row_lengths")(sweep(xyz, 2, xyz[at, ])) > lesion$radius
  whole <- vapply(split(far, surface$part), all, NA)
  patch <- found$parts[found$parts$level == "surface" & found$parts$part %in% names(which(whole)), ]
  measured <- found$measurements
  c(measured = if (is.na(at)) mean((measured$change / measured$se)^2) else NA,
    any = any(surface$called[far]), points = mean(abs(surface$score[far]) > 1.96),
    square = mean(surface$score[far]^2), patch = mean((patch$change / patch$se)^2),
    centre = if (is.na(at)) NA else surface$change[at] / lesion$height,
    found = if (is.na(at)) NA else surface$called[at])
}

if (mode == "visits") visits(n, as.numeric(arguments[-(1:3)]))

if (mode == "z") only_z(as.integer(arguments[4]))

if (mode == "lone") {
  cohort <- simulate_cohort(n, ages = c(3, 25), seed = seed)
  old <- simulate_cohort(1, data = data.frame(age = 39, sex = "male"), seed = 100 + seed)
  shapes <- c(cohort$sample$shapes, stats::setNames(old$sample$shapes, "lone"))
  shapes$lone$id <- "lone"
  sample <- own("new_shape_sample")(shapes, cohort$sample$template,
                                    provenance = cohort$sample$provenance)
  data <- rbind(cohort$data, data.frame(id = "lone", age = 39, sex = "male", size = NA))
  # What the errors say is done until nothing is refused.
  settings <- norm_settings()
  for (round in 1:5) {
    refused <- tryCatch({
      shared <- fit_norms(sample, ~ s(age, by = sex), data, share = TRUE, settings = settings,
                          progress = FALSE)
      NULL
    }, crestline_privacy = conditionMessage)
    if (is.null(refused)) break
    cat("refused:", refused, "\n")
    out <- names(sample)[vapply(names(sample), grepl, NA, x = refused, fixed = TRUE)]
    fewer <- regmatches(refused, regexpr("components = [0-9]+", refused))
    if (length(out)) sample <- sample[setdiff(names(sample), out)]
    if (length(fewer)) settings$components <- as.integer(sub(".* ", "", fewer))
    if (!length(out) && !length(fewer)) break
  }
  if (is.null(refused)) print(shared)
}

# Ages are invented: this shows that the machinery runs on measured, slid shapes, no more. Faces of
# this set lie in about ten dimensions, so that they prove nothing of norms.
if (mode == "simpop") {
  shared <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
  landmarks <- read.csv(file.path(shared, "landmarks.csv"))
  files <- sort(list.files(shared, "[.]ply$", full.names = TRUE))
  scans <- lapply(files, function(file) {
    id <- sub("[.]ply$", "", basename(file))
    marks <- landmarks[landmarks$id %in% c(id, sub("simpop_", "", id)), ]
    xyz <- as.matrix(marks[c("x", "y", "z")])
    rownames(xyz) <- marks$landmark
    specimen(Morpho::file2mesh(file), xyz, id = id)
  })
  shapes <- fit_shapes(scans, face_scheme(), progress = FALSE)
  sample <- homologise(shapes, progress = FALSE)
  data <- data.frame(id = names(sample), age = 20 + (seq_along(names(sample)) * 7) %% 23)
  settings <- norm_settings(components = 3, folds = 3, least = 2)
  norms <- fit_norms(sample, ~ s(age), data, settings = settings, progress = FALSE)
  print(norms)
  print(assess(sample[[1]], norms, age = data$age[1]))
}

if (mode == "look") {
  part <- arguments[4]
  usual <- c(calibration = 1000, worse = 400, own = 200, lesions = 400, healed = 30, time = 1)
  faces <- if (length(arguments) > 4) as.integer(arguments[5]) else usual[[part]]
  kept <- readRDS(kept_file(seed))
  looks <- list(calibration = calibration, worse = worse_scans, own = own_error,
                lesions = lesions, healed = healed, time = timed)
  looks[[part]](kept$norms, kept$settings, faces)
  saveRDS(rows, kept_file(paste0(seed, "-", part)))
}

if (mode == "pool") {
  files <- list.files(folder, sprintf("^norms-%d-[0-9]+-.*rds$", n), full.names = TRUE)
  all <- do.call(rbind, lapply(files, readRDS))
  for (what in unique(all$what)) {
    own_rows <- all[all$what == what & is.finite(all$value), ]
    if (!nrow(own_rows)) next
    weight <- if (anyNA(own_rows$count)) NULL else own_rows$count
    mean <- if (is.null(weight)) mean(own_rows$value) else
      stats::weighted.mean(own_rows$value, weight)
    cat(sprintf("%-58s %.4g (%.4g to %.4g; %d norms%s)\n", what, mean, min(own_rows$value),
                max(own_rows$value), nrow(own_rows),
                if (is.null(weight)) "" else sprintf(", %d", sum(weight))))
  }
}
