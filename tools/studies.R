# The simulation studies behind the vignettes "How good are the curves?" and "Curvature: bias and
# variance": runs them and says whether they agree with the tables that ship with the vignettes.
# From the package's root, crestline being installed:
#   Rscript tools/studies.R [N = 500] [write] [ridges] [alternatives] [bias]
# N: simulations a setting; 20 is a short run, compared with the first 20 seeds of the tables.
# write: make the tables anew.
# Without a name all studies run. Results are kept in studies-output/ as they come, and a run that
# was cut short goes on there.
options(rgl.useNULL = TRUE)
library(crestline)
# In an environment of its own, that goes to the workers with the functions.
bench <- new.env()
sys.source("bench/alternatives.R", bench)
sys.source("bench/bias.R", bench)

argument <- commandArgs(TRUE)
simulations <- c(suppressWarnings(as.integer(argument[grepl("^[0-9]+$", argument)])), 500L)[1]
first_few <- 20L # seeds whose mean is kept beside that of all

# The installed package's sources, so that results of other sources are not taken up.
output <- function(name) {
  key <- system.file("source-key", package = "crestline")
  file.path("studies-output", if (nzchar(key)) substr(readLines(key, 1), 1, 12) else "unknown",
            name)
}

# --- Section 5.2: the paper's factors, one at a time about a = 0.25, noise 0.01, and three in full
# sharpness x noise in full ----

ridge_factors <- function() {
  base <- list(a = 0.25, b = c(1, 2), noise = 0.01)
  about <- function(...) utils::modifyList(base, list(...))
  list(
    "bend, sharpness, noise" = about(a = c(0, 0.25, 0.5), b = c(0.25, 0.5, 1, 2),
                                     noise = c(0, 0.01, 0.05)),
    noise = about(noise = c(0.02, 0.1)),
    landmarks = about(landmark_error = c(0.05, 0.1, 0.2)),
    "landmarks, much noise" = about(noise = 0.05, landmark_error = 0.1),
    mesh = about(spacing = c(0.1, 0.025)),
    radius = about(radius = c(0.15, 0.35, 0.5)),
    correlation = about(correlation = c(1, 2, 3)),
    passes = about(noise = c(0, 0.05), passes = 2)
  )
}

run_ridges <- function(n) {
  methods <- list(crestline = ridge_settings(), "one pass" = ridge_settings("one pass"),
                  paper = ridge_settings("paper", error = FALSE))
  run_factors(ridge_factors(), methods, n, output("ridges"))
}

# Bent ridges by the estimators that are compared cell by cell: all simulations. Fewer for the other
# methods, and for the other factors.
run_alternatives <- function(n, most = 50L,
                             closest = c("crestline", "one pass", "two passes", "paper's settings",
                                         "principal curve")) {
  base <- list(a = 0.25, b = c(1, 2), noise = 0.01)
  about <- function(...) utils::modifyList(base, list(...))
  bent <- list("bend, sharpness, noise" = about(a = c(0.25, 0.5), noise = c(0, 0.01, 0.05)))
  others <- list("bend, sharpness, noise" = about(a = 0, noise = c(0, 0.01, 0.05)),
                 landmarks = about(landmark_error = 0.1), radius = about(radius = 0.15))
  methods <- bench$alternatives()
  if (is.null(methods$"principal curve")) cat(paste("princurve is not installed: the principal",
                                                    "curve is left out.\n"))
  dir <- output("alternatives")
  # One method after the other, so that a run that is cut short has whole methods.
  each <- function(factors, names, n) {
    do.call(rbind, lapply(names, function(name) run_factors(factors, methods[name], n, dir)))
  }
  rbind(each(bent, intersect(closest, names(methods)), n),
        each(others, names(methods), min(n, most)),
        each(bent, setdiff(names(methods), closest), min(n, most)))
}

run_factors <- function(factors, methods, n, dir) {
  rows <- lapply(names(factors), function(name) {
    cat(sprintf("  %s\n", name))
    own <- names(factors[[name]]) %in% names(study_settings())
    study <- do.call(ridge_study, c(
      factors[[name]][!own],
      list(settings = methods, n = n, dir = dir,
           study = do.call(study_settings, factors[[name]][own]))
    ))
    cbind(factor = name, summarise(study))
  })
  do.call(rbind, rows)
}

# A row a cell: means over the simulations, and the standard error of the mean distance.
summarise <- function(study) {
  setting <- c("a", "b", "noise", "landmark_error", "spacing", "radius", "correlation", "passes",
               "method")
  # As text, since the passes are NA where the settings say them.
  cell <- do.call(paste, c(lapply(study[setting], format_key), sep = " | "))
  rows <- lapply(split(study, cell), function(one) {
    average <- function(x) if (all(is.na(x))) NA else mean(x, na.rm = TRUE)
    cbind(one[1, setting], n = nrow(one), failed = sum(!is.na(one$error)),
          distance = average(one$distance),
          distance_error = stats::sd(one$distance, na.rm = TRUE) / sqrt(sum(!is.na(one$distance))),
          distance_first = average(one$distance[one$seed <= first_few]),
          distance_determined = average(one$distance[one$determined %in% TRUE]),
          distance_curvature = average(one$distance_curvature), se = average(one$se),
          covered = average(one$covered),
          covered_curvature = average(one$covered_curvature), determined = average(one$determined),
          converged = average(one$converged), seconds = mean(one$seconds))
  })
  out <- do.call(rbind, rows)
  rownames(out) <- NULL
  out
}

# --- Tables that ship with the vignettes ----

# Equal to `same`, relatively, where neither code nor platform changed; else within `limit` standard
# errors of the difference, or `least` spacings (per cent of bias), which is agreement too.
compare <- function(found, kept, value, error, setting, same = 1e-6, limit = 4, least = 0.02) {
  key <- function(table) do.call(paste, c(lapply(table[setting], format_key), sep = " | "))
  at <- match(key(found), key(kept))
  here <- found[[value]]
  there <- kept[[value]][at]
  off <- abs(here - there)
  missing <- is.na(here) & is.na(there)
  spread <- sqrt(found[[error]]^2 + kept[[error]][at]^2)
  spread[is.na(spread)] <- 0
  verdict <- ifelse(is.na(at), "not in the table",
                    ifelse(missing | off <= same * abs(there), "equal",
                           ifelse(off <= pmax(limit * spread, least), "within error", "differs")))
  verdict[is.na(verdict)] <- "differs"
  print(table(verdict, dnn = NULL))
  bad <- verdict %in% c("differs", "not in the table")
  if (any(bad)) print(utils::head(cbind(found[setting], here = here, table = there)[bad, ], 40),
                      row.names = FALSE)
  !any(bad)
}

format_key <- function(x) as.character(if (is.numeric(x)) signif(x, 6) else x)

# The value to be compared: of all simulations where there are as many as in the table, else of the
# first few.
settle <- function(name, found, setting, value, error) {
  file <- file.path("vignettes", paste0(name, ".csv"))
  empty <- found$failed == found$n
  if (any(empty)) {
    cat("every estimate failed in", sum(empty), "cells: no table is written.\n")
    print(utils::head(found[empty, setting], 10), row.names = FALSE)
    return(FALSE)
  }
  if ("write" %in% argument) {
    shown <- lapply(found, function(x) if (is.double(x)) signif(x, 8) else x)
    utils::write.csv(as.data.frame(shown, check.names = FALSE), file, row.names = FALSE)
    cat("written:", file, "\n")
    return(TRUE)
  }
  kept <- utils::read.csv(file)
  if (value == "distance" && max(found$n) != max(kept$n)) {
    found[[value]] <- if (max(found$n) >= first_few) found$distance_first else found$distance
    if (max(found$n) >= first_few) kept[[value]] <- kept$distance_first
  }
  compare(found, kept, value, error, setting)
}

# --- All of them ----

study <- function(name, run, setting, value, error) {
  if (length(intersect(argument, names(studies))) && !name %in% argument) return(TRUE)
  cat(sprintf("==> %s\n", name))
  time <- system.time(found <- run(simulations))
  cat(sprintf("  %.0f s\n", time[["elapsed"]]))
  settle(studies[[name]], found, setting, value, error)
}

studies <- c(ridges = "ridge-study", alternatives = "alternatives", bias = "curvature-bias")
ridge_setting <- c("a", "b", "noise", "landmark_error", "spacing", "radius", "correlation",
                   "passes", "method")
future::plan("multisession", workers = future::availableCores())
progressr::handlers(global = FALSE)
agree <- c(study("ridges", run_ridges, ridge_setting, "distance", "distance_error"),
           study("alternatives", run_alternatives, ridge_setting, "distance", "distance_error"),
           study("bias", bench$run_bias, bench$bias_setting, "bias", "bias_error"))
cat(if (all(agree)) "All studies agree with" else "Some cells differ from",
    "the tables in vignettes/.\n")
quit(status = as.integer(!all(agree)))
