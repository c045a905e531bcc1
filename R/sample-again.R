# The failed specimens of a batch measured again, with what is changed.

#' A batch whose failed specimens are measured again
#'
#' @param changed List of arguments of [fit_shapes()] that are given anew: `dir`, `template`,
#'   `doubtful`, `found`, `settings`.
#' @return The batch, with results in the place of failures, or new failures.
#' @noRd
fit_again <- function(batch, changed, landmarks, reading, chunk, progress) {
  batch <- renewed_batch(batch)
  failed <- attr(batch, "failed")
  again <- Filter(function(one) !is.null(one$job), failed)
  tell_not_again(batch, names(again))
  for (run in unique(lapply(again, `[[`, "run"))) {
    of <- vapply(again, function(one) identical(one$run, run), NA)
    # Jobs that failed, with landmarks and arguments of reading that are given anew
    jobs <- lapply(again[of], `[[`, "job")
    files <- Filter(function(job) !is.null(job$mesh), jobs)
    if (length(files) < length(jobs)) refuse_for_specimens(landmarks, reading)
    jobs <- if (!length(files)) jobs else {
      meshes <- vapply(files, `[[`, "", "mesh")
      read <- file_jobs(meshes, landmarks, reading, ids = names(files))
      jobs[names(files)] <- Map(function(old, new) {
        if (is.null(landmarks) && !old$beside) {
          new["landmarks"] <- old["landmarks"]
          new["wanting"] <- old["wanting"]
          new["refusal"] <- list(NULL)
        }
        new$beside <- is.null(landmarks) && old$beside
        new$reading <- Map(utils::modifyList, old$reading, new$reading)
        new
      }, files, read)
      jobs
    }
    told <- lapply(plain_list(batch)[setdiff(names(batch), names(again))], told_of)
    part <- fit_jobs(jobs, run_again(run, changed), chunk, progress,
                     placed = sum(!vapply(told, `[[`, NA, "found")))
    elements <- plain_list(batch)
    elements[names(part)] <- plain_list(part)
    failed[names(part)] <- NULL
    failed <- c(failed, attr(part, "failed"))
    batch <- new_shape_batch(elements, failed[intersect(names(elements), names(failed))],
                             attr(batch, "scheme"))
  }
  tell_twins(batch, "batch")
  validate_shape_batch(batch)
}

#' The arguments of a run with some changed
#' @noRd
run_again <- function(run, changed) {
  settings <- run$settings
  settings[names(changed$settings)] <- changed$settings
  changed$settings <- settings
  run <- rlang::env_clone(run)
  for (name in names(changed)) assign(name, changed[[name]], run)
  run
}

#' Say of which specimens a batch does not know enough to measure them again
#' @noRd
tell_not_again <- function(batch, again) {
  lost <- setdiff(failures(batch)$id, again)
  if (length(lost)) {
    crestline_inform(sprintf(paste(
      "The batch does not know how to measure %s again. Call fit_shapes() with the meshes."
    ), shorten(lost)))
  } else if (!length(again)) {
    crestline_inform("No specimen of the batch has failed: nothing is measured.")
  }
}
