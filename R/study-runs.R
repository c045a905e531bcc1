# Section 5.2 of the paper as a study: many simulated ridges, by any estimator, in parallel, gone on
# with after a kill.

#' Study of ridge estimates on simulated surfaces
#'
#' Estimates the ridges of `n` simulated surfaces, and measures their distances from the true
#' ridges. It does so for each combination of bend, sharpness, noise, spacing, landmark error,
#' radius and passes.
#'
#' Each curve is compared at `points` points along it, and the truth at the same number. The
#' distance is the mean of those from the curve's points to the true line, and from the truth's
#' points to the curve. It is taken in the (x, y) plane, since the noise moves points along z only.
#' There are two truths, the crest in height and the locus of greatest curvature, see
#' [simulate_ridge()].
#'
#' The paper takes the mean Euclidean distance between 21 equally spaced points of both. It has 500
#' simulations for each combination. Its ranges are 0 to 0.5 for `a` and `b`, and 0 to 0.1 for the
#' error of landmarks. For the distance between vertices they are 0.05 to 0.1, and for noise 0 to
#' 0.05.
#'
#' With the packages future and progressr it runs in parallel by the user's plan, as [fit_shapes()]
#' does. Surfaces depend on their seeds only. Results therefore do not depend on the number of
#' workers, and all methods get the same surfaces. With `dir` an interrupted run continues where it
#' stopped.
#'
#' @param settings [ridge_settings()], or a named list of methods that are compared on the same
#'   surfaces. A method is a [ridge_settings()] or a function `(specimen, radius, width, n)` that
#'   returns the points of another estimate (k x 3 matrix, in order from landmark `from` to `to`).
#'   Parallel workers do not have the objects of your workspace. Define the function together with
#'   its helpers in `local()`.
#' @param n Number of simulated surfaces for each combination; their seeds are `1, ..., n`.
#' @param a,b,noise Vectors of values, as in [simulate_ridge()].
#' @param dir Folder for the results of a long run; it is created if it does not exist. Results of
#'   the same arguments and the same version of the package are not computed again. Two functions
#'   are the same if their text and the objects that they use are the same. A damaged file is
#'   computed again. `NULL`: results are not stored.
#' @param progress Whether to show a progress bar, see [progressr::with_progress()].
#' @param study What the surfaces and estimates have in common, or more values for combinations: as
#'   of [study_settings()].
#' @param ... Fields of [study_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return Data frame with a row for each curve; a value that a method does not have is `NA`:
#'   * `a`, `b`, `noise`, `landmark_error`, `spacing`, `radius`, `correlation`, `passes`, `seed`;
#'   * `method`: name in `settings`;
#'   * `distance`: mean distance between estimate and crest, **in spacings**;
#'   * `distance_curvature`: the same for the locus of greatest curvature; `NA` if the locus does
#'     not run from end to end;
#'   * `se`: median standard error, in spacings;
#'   * `covered`, `covered_curvature`: share of the curve's inner points that lie within two of
#'     their standard errors of the crest, and of the locus;
#'   * `determined`, `converged`: logical;
#'   * `seconds`: processor time;
#'   * `error`: the message if the estimate failed.
#' @section Errors: of class `crestline_error`: an argument is out of its range; this stops the
#'   study before any work. A failed estimate does not stop it; its row has `error`.
#' @section Warnings: of class `crestline_keeping_warning`: results could not be written to `dir`.
#' @template glossary
#' @template experimental
#' @templateVar where section 5.2
#' @template paper
#' @examples
#' study <- ridge_study(n = 2, a = 0.25, b = 1, noise = c(0, 0.01))
#' aggregate(distance ~ a + b + noise, study, mean)
#'
#' chord <- function(specimen, radius, width, n) specimen$landmarks
#' methods <- list(ridge = ridge_settings(error = FALSE), chord = chord)
#' ridge_study(methods, n = 1, a = 0.25, b = 2, noise = 0)[c("method", "distance", "seconds")]
#' @export
ridge_study <- function(settings = ridge_settings(), n = 20, a = c(0, 0.25, 0.5),
                        b = c(0.25, 0.5, 1, 2), noise = c(0, 0.01, 0.05), dir = NULL,
                        progress = interactive(), study = study_settings(), ...) {
  check_flags(progress)
  methods <- study_methods(settings)
  check_count(n, "n")
  check_class(study, "study_settings", "study", "study_settings()")
  check_dots(..., known = names(study))
  study <- with_former(list(study = study), list(study = names(study)), list(...))$study
  largest <- study$largest
  block <- study$block
  grid <- check_study_grid(
    list(passes = study$passes, correlation = study$correlation, radius = study$radius,
         spacing = study$spacing, landmark_error = study$landmark_error, noise = noise, b = b,
         a = a),
    largest
  )
  constant <- unclass(study)[c("width", "points", "jitter", "end")]
  curves <- n * prod(lengths(grid)) * length(methods)
  if (curves > largest) {
    crestline_abort(sprintf("the study would have %s curves.", format(curves, big.mark = ",")),
                    "Give fewer values or a smaller `n`, or a greater `largest`.",
                    stage = "arguments")
  }
  cells <- do.call(expand.grid, grid)[8:1]
  tasks <- study_tasks(cells, n, block, methods, constant, dir)
  run <- function() apply_tasks(tasks, list(methods = methods, constant = constant))
  blocks <- if (isTRUE(progress) && runs_parallel()) progressr::with_progress(run()) else run()
  blocks[] <- Map(function(block, task) if (inherits(block, "lost_task")) {
                    lost_block(task, methods, block)
                  } else {
                    block
                  },
                  blocks, tasks)
  warn_unkept(blocks, dir)
  # All rows as one data frame
  rows <- unlist(blocks, recursive = FALSE)
  columns <- stats::setNames(nm = names(rows[[1]]))
  frame_of(lapply(columns, function(name) unlist(lapply(rows, `[[`, name), use.names = FALSE)))
}

#' The factors of a study, each value in its range
#'
#' @param largest As in [ridge_study()].
#' @noRd
check_study_grid <- function(grid, largest) {
  largest <- check_number(largest, "largest", 9)
  finest <- 2 / (sqrt(largest) - 1)
  range <- list(passes = c(1, 1e3), correlation = c(0, 1e3), radius = c(0, 2),
                spacing = c(finest, 0.5),
                landmark_error = c(0, 2), noise = c(0, 2), b = c(0, 1e4), a = c(-100, 100))
  open <- c("radius", "b")
  for (name in setdiff(names(grid), if (is.null(grid$passes)) "passes")) {
    if (!is.numeric(grid[[name]]) || !length(grid[[name]]) || !is.null(dim(grid[[name]]))) {
      crestline_abort(sprintf("`%s` is %s.", name, describe_value(grid[[name]])),
                      "Give one number or several.",
                      stage = "arguments")
    }
    grid[[name]] <- vapply(as.vector(grid[[name]]), function(value) {
      value <- check_number(value, name, range[[name]][1], range[[name]][2])
      if (name %in% open && value == 0) check_number(value, name, 0, open = TRUE)
      if (name == "passes") check_count(value, name) else value
    }, 0)
  }
  if (is.null(grid$passes)) grid["passes"] <- NA_real_
  grid
}

#' Settings of a study of ridges
#'
#' The scans and estimates of [ridge_study()], beside the ridges themselves. Vectors give a study
#' with all combinations of their values.
#'
#' @template setting-names
#' @param landmark_error,spacing,correlation Vectors of values, as in [simulate_ridge()].
#' @param passes,radius Vectors of values, as in [ridge_settings()] and [ridge_curve()]; the side
#'   of the surface is 2. `passes = NULL`: the passes of the settings.
#' @param width As in [ridge_curve()], in the unit of the surface.
#' @param points Number of points at which each curve is compared; the paper: 21.
#' @param jitter,end As in [simulate_ridge()].
#' @param block Number of surfaces that a worker takes, and writes to the study's `dir`, at a time.
#' @param largest Greatest number of vertices of a surface, (2 / `spacing` + 1)^2, and greatest
#'   number of curves of a study. Larger ones are refused before any work.
#' @return List of class `study_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @templateVar where section 5.2
#' @template paper
#' @template experimental
#' @examples
#' study_settings(radius = c(0.2, 0.25), points = 11)
#' @export
study_settings <- function(..., landmark_error = 0, passes = NULL, radius = 0.25, width = 0.4,
                           spacing = 0.05, correlation = 0, jitter = 0, end = 0.95, points = 21,
                           block = 50, largest = 2e6) {
  new_settings("study_settings", check_study_settings, list(...))
}

check_study_settings <- function(settings) {
  check_number(settings$width, "width", 0, 2, open = TRUE)
  check_number(settings$jitter, "jitter", 0, 0.45)
  check_number(settings$end, "end", 0, 1)
  check_number(settings$points, "points", 3, 1e5)
  check_count(settings$points, "points", lower = 3)
  check_count(settings$block, "block")
  grid <- c("passes", "correlation", "radius", "spacing", "landmark_error")
  check_study_grid(settings[grid], settings$largest)
  settings
}

#' @export
print.study_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<study_settings> of ridge_study()")
}

#' Blocks of surfaces, each of one cell: its seeds, its file, and the key by which a block that was
#' kept is recognised
#' @noRd
study_tasks <- function(cells, n, block, methods, constant, dir) {
  seeds <- split(seq_len(n), ceiling(seq_len(n) / block))
  about <- list(value_print(methods), constant, answers_version,
                as.character(utils::packageVersion("crestline")))
  if (!is.null(dir)) dir <- results_folder(dir)
  tasks <- lapply(seq_len(nrow(cells)), function(i) {
    lapply(seeds, function(some) {
      cell <- as.list(cells[i, ])
      key <- content_hash(list(cell, some, about))
      file <- if (!is.null(dir)) file.path(dir, paste0(key, ".study"))
      list(cell = cell, seeds = some, key = key, name = key, file = file)
    })
  })
  unlist(tasks, recursive = FALSE)
}

runs_parallel <- function() rlang::is_installed(c("future", "progressr"))

#' Work at tasks in parallel where the packages for that are there, and one after the other where
#' not; those whose worker has died once more, each alone
#' @noRd
apply_tasks <- function(tasks, arguments) {
  if (!runs_parallel()) return(lapply(tasks, study_block, arguments$methods, arguments$constant))
  blocks <- run_tasks(tasks, study_block, arguments, 1)
  lost <- vapply(blocks, inherits, NA, "lost_task")
  if (any(lost)) blocks[lost] <- run_tasks(tasks[lost], study_block, arguments, 1, alone = TRUE)
  blocks
}

#' Estimates for one block of surfaces, from its file where they are there
#' @return List of rows, each a list; with attribute `unkept`, why they could not be written, where
#'   they could not.
#' @noRd
study_block <- function(task, methods, constant) {
  kept <- if (!is.null(task$file)) open_kept(task$file)
  if (identical(kept$state, "whole") &&
      identical(kept$about$key, task$key)) return(kept_value(kept))
  crest <- ridge_crest(task$cell$a, task$cell$b, constant$end)
  cell <- task$cell
  rows <- lapply(task$seeds, function(seed) {
    # One surface's estimates by all methods
    surface <- simulated_ridge(
      cell$a, cell$b, cell$spacing, cell$noise, seed, constant$jitter, cell$correlation,
      cell$landmark_error, constant$end
    )
    truths <- list(attr(surface, "truth"), if (!anyNA(crest)) crest)
    lapply(names(methods), function(name) {
      start <- proc.time()
      found <- tryCatch(study_estimate(methods[[name]], surface, cell, constant),
                        error = conditionMessage)
      seconds <- sum((proc.time() - start)[1:2])
      problem <- if (is.character(found)) found else NA_character_
      c(cell, list(seed = seed, method = name), study_result(found, truths, cell$spacing),
        list(seconds = seconds, error = problem))
    })
  })
  rows <- unlist(rows, recursive = FALSE)
  if (is.null(task$file)) return(rows)
  tryCatch({
    keep(rows, list(key = task$key, mesh = "none"), task$file)
    rows
  }, crestline_keeping_error = function(e) structure(rows, unkept = e$problem))
}

#' Rows of a block whose worker died twice
#' @noRd
lost_block <- function(task, methods, lost) {
  message <- paste("the worker died:", first_line(lost$message))
  unlist(lapply(task$seeds, function(seed) lapply(names(methods), function(name) {
    c(task$cell, list(seed = seed, method = name), study_result(message),
      list(seconds = NA_real_, error = message))
  })), recursive = FALSE)
}

warn_unkept <- function(blocks, dir) {
  unkept <- unlist(lapply(blocks, attr, "unkept"))
  if (length(unkept)) {
    crestline_warn(sprintf("%s of %s not kept: %s", length(unkept), amount(length(blocks), "block"),
                           unkept[1]),
                   sprintf("Make room in %s; what was not kept is run again next time.", dir),
                   stage = "keeping", class = "crestline_keeping_warning")
  }
}

#' An estimate by one method
#'
#' @return List: `line` (the whole curve, k x 3), `at` (its points to be compared, with `se`), `se`,
#'   `determined`, `converged`.
#' @noRd
study_estimate <- function(method, surface, cell, constant) {
  points <- constant$points
  quiet <- function(code) suppressWarnings(code, classes = "crestline_warning")
  if (is.function(method)) {
    line <- as.matrix(quiet(method(surface, cell$radius, constant$width,
                                   points)))[, 1:3, drop = FALSE]
    colnames(line) <- c("x", "y", "z")
    return(list(line = line, at = equally_along(line, points), error = NA_real_, se = NA_real_,
                determined = NA,
                converged = NA))
  }
  if (!is.na(cell$passes)) method$passes <- cell$passes
  curve <- quiet(ridge_curve(
    surface, "from", "to", "ridge", cell$radius, constant$width, points, settings = method
  ))
  list(line = columns_of(curve$path, c("x", "y", "z")),
       at = columns_of(curve$points, c("x", "y", "z")),
       error = curve$points$se, se = curve$se, determined = curve$determined,
       converged = curve$converged)
}

#' What is kept of an estimate
#'
#' @param found As of [study_estimate()], or a message.
#' @param truths The crest, and the locus of greatest curvature or NULL; both NULL where `found` is
#'   a message.
#' @noRd
study_result <- function(found, truths = NULL, spacing = 1) {
  failed <- is.character(found)
  # Mean distance between the curve and a true line at points of both, seen along z
  distance <- function(truth) {
    if (failed || is.null(truth)) return(NA_real_)
    there <- mean(abs(ridge_offset(found$at, truth)))
    back <- mean(abs(ridge_offset(equally_along(truth, nrow(found$at)), found$line)))
    (there + back) / 2 / spacing
  }
  covered <- function(truth) if (failed || is.null(truth)) NA_real_ else share_covered(found, truth)
  list(distance = distance(truths[[1]]), distance_curvature = distance(truths[[2]]),
       se = if (failed) NA_real_ else found$se / spacing, covered = covered(truths[[1]]),
       covered_curvature = covered(truths[[2]]), determined = if (failed) NA else found$determined,
       converged = if (failed) NA else found$converged)
}

#' Share of the inner points within two standard errors of a true line
#' @noRd
share_covered <- function(found, truth) {
  inner <- seq_len(nrow(found$at))[-c(1, nrow(found$at))]
  mean(abs(ridge_offset(found$at[inner, , drop = FALSE], truth)) <= 2 * found$error[inner])
}

#' Points at equal distances along a line, seen along z: n x 3
#' @noRd
equally_along <- function(line, n) {
  s <- c(0, cumsum(sqrt(rowSums(diff(line[, 1:2])^2))))
  kept <- c(TRUE, diff(s) > 0)
  at <- seq(0, s[length(s)], length.out = n)
  out <- vapply(1:3, function(i) stats::approx(s[kept], line[kept, i], at)$y, numeric(n))
  colnames(out) <- c("x", "y", "z")
  out
}
