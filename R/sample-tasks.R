# The jobs of a batch as tasks: what is kept is read, the rest measured, a fault costs one
# specimen.

#' All jobs of a run measured
#'
#' @param run Environment: `scheme`, `settings`, `dir`, `template`, `doubtful`, `found`. Failures
#'   keep it, all the same one, to be measured again.
#' @param placed Number of other specimens of the batch with landmarks of their own.
#' @noRd
fit_jobs <- function(jobs, run, chunk, progress, placed = 0, call = rlang::caller_env()) {
  plain <- jobs
  jobs <- with_finder(jobs, run$dir, run$template, run$doubtful, run$scheme, run$found, placed,
                      call)
  tasks <- batch_tasks(jobs, run$dir, run$scheme, run$settings)
  results <- if (is.null(run$dir)) vector("list", length(tasks)) else lapply(tasks, kept_result)
  open <- vapply(results, is.null, NA)
  read <- names(jobs)[!open]
  if (length(read) && any(open)) {
    crestline_inform(sprintf("%d of %s are read from the folder; %d to measure.", length(read),
                             amount(length(tasks), "result"), sum(open)))
  }
  refusal <- if (any(open) && !is.null(run$dir)) unwritable(run$dir)
  if (!is.null(refusal)) {
    results[open] <- list(failure_of(refusal))
    open[] <- FALSE
  }
  if (any(open)) {
    results[open] <- with_told_progress(
      measure_tasks(tasks[open], run$scheme, run$settings, chunk), isTRUE(progress), length(read)
    )
  }
  results <- Map(function(result, job) {
    if (!inherits(result, "shape_failure")) return(result)
    result[c("job", "run")] <- list(job, run)
    result
  }, results, plain)
  batch_of(stats::setNames(results, names(jobs)), run$scheme, read)
}

#' All tasks: what is measured, where it is kept, and the key that tells whether it is kept already
#' @noRd
batch_tasks <- function(jobs, dir, scheme, settings) {
  tasks <- lapply(jobs, function(job) list(job = job, name = job$id))
  if (is.null(dir)) return(tasks)
  contents <- lapply(jobs, job_content, scheme, settings)
  files <- result_files(dir, names(jobs), contents)
  tell_places(files, names(jobs), contents)
  about <- list(name = scheme$name, key = content_hash(unclass(scheme)))
  Map(function(task, content, file) c(task, content, list(scheme = about, file = file)), tasks,
      contents, as.vector(files))
}

#' The result of a task from its file; NULL where that has not its key or is not whole
#' @noRd
kept_result <- function(task) {
  if (is.na(task$key) || !identical(peek_kept(task$file)$key, task$key)) return(NULL)
  opened <- open_kept(task$file)
  if (opened$state == "whole") kept_shape(task, opened$about)
}

#' All tasks, by the user's plan; what a fault of the machine has cost is tried once more, each
#' alone
#' @return List of what [measure_task()] returns, a `shape_failure` for a task that was lost.
#' @noRd
measure_tasks <- function(tasks, scheme, settings, chunk) {
  if (is.null(chunk)) chunk <- ceiling(length(tasks) / (2 * future::nbrOfWorkers()))
  arguments <- list(scheme = scheme, settings = settings)
  results <- run_tasks(tasks, measure_task, arguments, chunk)
  again <- vapply(results, function(result) inherits(result, "lost_task") || isTRUE(result$fault),
                  NA)
  if (any(again)) {
    results[again] <- run_tasks(tasks[again], measure_task, arguments, 1, alone = TRUE)
  }
  lapply(results,
         function(result) if (inherits(result, "lost_task")) lost_failure(result) else result)
}

#' One specimen measured
#'
#' @return A `shape`, or a `kept_shape` where it is in its file; or a `shape_failure`.
#' @noRd
measure_task <- function(task, scheme, settings) {
  if (!is.null(task$file)) {
    kept <- kept_result(task)
    if (!is.null(kept)) return(kept)
  }
  ear <- new_ear()
  shape <- tryCatch(fit_job(task$job, scheme, settings, ear),
                    error = function(e) failure_of(e, ear$heard))
  if (is.null(task$file) || !inherits(shape, "shape")) return(shape)
  about <- c(task[c("key", "mesh", "setting", "words", "scheme")],
             list(id = task$name, warnings = shape$warnings), told_of(shape))
  tryCatch({
    keep(shape, about, task$file)
    kept_shape(task, about)
  }, crestline_keeping_error = function(e) failure_of(e, ear$heard, fault = TRUE))
}

fit_job <- function(job, scheme, settings, ear) {
  one <- hear(job_specimen(job), "reading", ear)
  if (!is.null(job$finder)) one <- hear(found_specimen(one, job$finder), "landmarks", ear)
  settings <- utils::modifyList(list(progress = FALSE), settings)
  shape <- hear(do.call(fit_shape, c(list(one, scheme), settings)), "shape", ear)
  shape$warnings <- unique(rbind(shape$warnings, ear$heard))
  shape
}

#' @param fault Whether it is one of the machine, so that it is worth trying once more.
#' @noRd
failure_of <- function(e, heard = no_warnings(), fault = FALSE) {
  own <- inherits(e, "crestline_error")
  new_failure(if (own) e$stage else "unforeseen", if (own) e$problem else conditionMessage(e),
              if (own) e$remedy else "Please report it, with the specimen if you may.",
              heard, fault)
}

lost_failure <- function(lost) {
  new_failure("worker",
              sprintf("the worker that measured it died, and again when it measured it alone: %s.",
                      sub("[.]$", "", first_line(lost$message))),
              "Is there memory enough? Run it again with fewer workers, or decimate the mesh.",
              fault = TRUE)
}

#' The first line of a text, not longer than that
#' @noRd
first_line <- function(text, most = 200) {
  line <- strsplit(text[1], "\n", fixed = TRUE)[[1]][1]
  if (nchar(line) > most) paste0(substr(line, 1, most), "...") else line
}
