# Which constants of the joint step would one choose without the faces that they are judged by?
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/homology-constants.R FOLDER [make] [judge]
#
# FOLDER: of bench/homology.R, whose shapes it takes. make: the joint step alone, by every one of
# `candidates`, on every case (every other face of simpop); templates and anchors are worked out
# once a case. judge: the best candidate on some faces, and its share of the warp's spread on the
# others: halves of every population, and each population left out.

source("bench/homology.R")
steps <- commandArgs(TRUE)[-1]
if (!length(steps)) steps <- c("make", "judge")
cases <- c("ict", "simpop", "simulated")

candidates <- expand.grid(rough = c(1, 3), pull = c(1, 4, 8), floor = c(0.08, 0.16))

# What all candidates share: the sample's template, and the shapes with their slid curves.
prepared <- function(name) {
  case <- readRDS(file.path(folder, paste0("shapes-", name, ".rds")))
  some <- seq(1, length(case$shapes), if (grepl("simpop", name)) 2 else 1)
  if (!is.null(case$dense)) {
    case$mean <- inner("procrustes_mean")(case$dense, case$dense[[1]])
  }
  settings <- slide_settings()
  sample <- suppressWarnings(homologise(case$shapes, settings = settings, progress = FALSE))
  plan <- inner("slide_plan")(sample$template, settings)
  cuts <- lapply(case$shapes[some], function(shape) {
    state <- inner("slide_state")(shape, settings)
    inner("cut_between_slid")(shape, state, inner("slide_curves")(state, plan), shape$specimen)
  })
  for (part in c("shapes", "dense", "places")) case[[part]] <- case[[part]][some]
  if (!isTRUE(case$dense_mesh)) case$it <- case$it[some]
  list(case = case, template = sample$template, cuts = cuts,
       warp = carried(case, lapply(case$shapes, warp_store, sample$template)))
}

# Every place on the mean face, places x 3 x faces, by one candidate.
placed_by <- function(ready, candidate) {
  settings <- do.call(slide_settings, as.list(candidate))
  template <- ready$template
  template$energy_scale <- NULL
  plan <- inner("slide_plan")(template, settings)
  shapes <- ready$case$shapes
  starts <- Map(function(shape, cut) inner("joint_start")(shape, cut$store, plan, shape$specimen),
                shapes, ready$cuts)
  plan$scale <- inner("energy_scale")(starts, own_mean = TRUE)
  slid <- Map(function(shape, cut, start) {
    inner("slide_joint")(shape, cut, start, plan, shape$specimen)
  }, shapes, ready$cuts, starts)
  ridge <- with(shapes[[1]]$scheme, unique(points$place[points$level == "curves" &
    points$part %in% curves$curve[curves$kind != "plane"]]))
  offset <- unlist(lapply(slid, function(one) one$offset[names(one$offset) %in% ridge]))
  list(at = carried(ready$case, lapply(slid, `[[`, "store")),
       offset = sqrt(mean(offset^2, na.rm = TRUE)))
}

# Spread over some faces, mm: curves, surface.
spread_of <- function(at, scheme, faces) {
  row <- spread_row(at[, , faces], scheme)
  c(curves = row$curves, surface = row$surface)
}

make <- function() {
  for (name in cases) {
    file <- file.path(folder, paste0("constants-", name, ".rds"))
    if (file.exists(file)) next
    ready <- prepared(name)
    scheme <- ready$case$shapes[[1]]$scheme
    n <- length(ready$case$shapes)
    sets <- list(all = seq_len(n), odd = seq(1, n, 2), even = seq(2, n, 2))
    warp <- lapply(sets, function(faces) spread_of(ready$warp, scheme, faces))
    rows <- lapply(seq_len(nrow(candidates)), function(i) {
      found <- placed_by(ready, candidates[i, ])
      shares <- Map(function(faces, warp) spread_of(found$at, scheme, faces) / warp, sets, warp)
      c(unlist(shares), offset = found$offset)
    })
    saveRDS(do.call(rbind, rows), file)
    cat(name, "done\n")
  }
}

judge <- function() {
  share <- lapply(stats::setNames(nm = cases), function(name) {
    readRDS(file.path(folder, paste0("constants-", name, ".rds")))
  })
  loss <- function(names, set) {
    Reduce(`+`, lapply(share[names], function(x) {
      rowSums(log(x[, paste0(set, c(".curves", ".surface"))]))
    }))
  }
  told <- function(what, chosen, names, set) {
    cat(sprintf("%s: %s\n", what, paste(names(candidates), unlist(candidates[chosen, ]),
                                        collapse = ", ")))
    for (name in names) {
      columns <- paste0(set, c(".curves", ".surface"))
      cat(sprintf("  %-16s %s (best there %s)\n", name,
                  paste(sprintf("%.3f", share[[name]][chosen, columns]), collapse = ", "),
                  paste(sprintf("%.3f", apply(share[[name]][, columns], 2, min)),
                        collapse = ", ")))
    }
  }
  defaults <- which(candidates$rough == 3 & candidates$pull == 4 & candidates$floor == 0.08)
  told("the defaults, all faces", defaults, cases, "all")
  told("chosen on all faces", which.min(loss(cases, "all")), cases, "all")
  told("chosen on odd faces, judged on even ones", which.min(loss(cases, "odd")), cases, "even")
  told("chosen on even faces, judged on odd ones", which.min(loss(cases, "even")), cases, "odd")
  for (out in c("ict", "simpop", "simulated")) {
    own <- grep(out, cases, value = TRUE)
    told(paste("chosen without", out), which.min(loss(setdiff(cases, own), "all")), own, "all")
  }
}

for (step in steps) list(make = make, judge = judge)[[step]]()
