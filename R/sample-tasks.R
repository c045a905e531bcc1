# The jobs of a batch as tasks: what is kept is read, the rest measured, a fault costs one
# specimen.

#' All jobs of a run measured
#'
#' @param run Environment: `scheme`, `settings`, `dir`, `template`, `doubtful`, `found`. Failures
#'   keep it, all the same one, to be measured again.
#' @param placed Number of other specimens of the batch with landmarks of their own.
#' @noRd
fit_jobs <- function(jobs, run, chunk, progress, placed = 0) {
  jobs <- with_finder(with_plain(jobs), run$dir, run$template, run$doubtful, run$scheme, run$found,
                      placed)
  jobs <- jobs_of_part(jobs, run)
  plain <- lapply(jobs, `[[`, "plain")
  jobs <- lapply(jobs, function(job) job[names(job) != "plain"])
  if (!is.null(run$part)) {
    run <- rlang::env_clone(run)
    run$part <- NULL
  }
  tasks <- batch_tasks(jobs, run$dir, run$scheme, run$settings, run$embed)
  results <- lapply(tasks, `[[`, "kept")
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

#' Jobs that remember what they were before landmarks were to be found, and which file's name is
#' theirs among all
#' @noRd
with_plain <- function(jobs) {
  Map(function(job, stem) c(job, list(plain = job, stem = stem)), jobs, file_stems(names(jobs)))
}

#' The jobs of one part of a cohort: every n-th, from the i-th
#'
#' The folder remembers the ids of all, so that [read_batch()] tells which are not measured yet.
#' @noRd
jobs_of_part <- function(jobs, run) {
  if (is.null(run$part)) return(jobs)
  if (!is.null(run$dir)) note_cohort(names(jobs), run$dir)
  jobs[seq_along(jobs) %% run$part[2] == run$part[1] %% run$part[2]]
}

#' Which part of all specimens is to be measured
#' @noRd
check_part <- function(part) {
  if (is.null(part)) return(NULL)
  right <- is.numeric(part) && length(part) == 2 && all(is.finite(part)) &&
    all(part == round(part)) && part[1] >= 1 && part[1] <= part[2]
  if (!right) {
    refuse_argument("part", part, "Give the number of the part and of all: part = c(3, 8).")
  }
  as.numeric(part)
}

#' All tasks: what is measured, where it is kept, and the key that tells whether it is kept already
#' @noRd
batch_tasks <- function(jobs, dir, scheme, settings, embed) {
  tasks <- lapply(jobs, function(job) list(job = job, name = job$id))
  if (is.null(dir) || !length(jobs)) return(tasks)
  contents <- lapply(jobs, job_content, scheme, settings)
  index <- folder_index(dir)
  files <- result_files(dir, jobs, contents, index)
  tell_places(files, names(jobs), contents)
  about <- list(name = scheme$name, key = content_hash(unclass(scheme)))
  at <- match(files, index$path)
  whole <- which(index$state[at] == "whole" &
                   index$key[at] == vapply(contents, `[[`, "", "key"))
  kept <- vector("list", length(jobs))
  kept[whole] <- Map(function(one, id) {
    attr(one, "id") <- id
    one
  }, kept_in_index(index[at[whole], ]), names(jobs)[whole])
  Map(function(task, content, file, kept) {
    c(task, content, list(scheme = about, file = file, kept = kept, embed = embed))
  }, tasks, contents, as.vector(files), kept)
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
  Map(function(result, task) {
    if (!inherits(result, "lost_task")) return(result)
    note_failure(lost_failure(result), task)
  }, results, tasks)
}

#' One specimen measured
#'
#' @return A `shape`, or a `kept_shape` where it is in its file; or a `shape_failure`.
#' @noRd
measure_task <- function(task, scheme, settings) {
  if (!is.null(task$file)) {
    kept <- kept_result(task)
    if (!is.null(kept)) return(kept)
    # On a full disk nothing is measured in vain.
    refusal <- unwritable(dirname(task$file))
    if (!is.null(refusal)) return(failure_of(refusal, fault = TRUE))
  }
  ear <- new_ear()
  shape <- tryCatch(fit_job(task$job, scheme, settings, ear),
                    error = function(e) failure_of(e, ear$heard))
  if (is.null(task$file)) return(shape)
  if (!inherits(shape, "shape")) return(note_failure(shape, task))
  tryCatch(keep_shape(shape, task),
           crestline_keeping_error = function(e) failure_of(e, ear$heard, fault = TRUE),
           error = function(e) note_failure(failure_of(e, ear$heard), task))
}

#' A shape written to its file, and to the index
#' @return A `kept_shape`.
#' @noRd
keep_shape <- function(shape, task) {
  about <- c(task[c("key", "mesh", "setting", "words", "scheme")],
             list(id = task$name, warnings = shape$warnings), told_of(shape))
  dir <- dirname(task$file)
  source <- task_source(task, shape, dir)
  stored <- stored_shape(shape, dir, source)
  about$scan <- if (is.null(source)) "embedded" else source$file
  small <- if (is.null(source)) 1 else "xz"
  failed <- failure_of_task(task)
  task$file <- keep_apart(task, function(file, new) keep(stored, about, file, small, new))
  row <- index_row(task$file, list(state = "whole", about = about))
  append_index(row, dir)
  note_measures(shape, row, dir)
  unlink(c(failed, failure_of_task(task)))
  kept_shape(task, about, c(row$size, row$time))
}

#' Where the scan of a task lies, NULL where it is stored with its result
#' @noRd
task_source <- function(task, shape, dir) {
  embedded <- isTRUE(task$embed) || is.null(task$job$mesh) || !inherits(shape$specimen, "specimen")
  if (!embedded) scan_source(task$job$mesh, task$mesh, task$job$reading$specimen, dir)
}

#' Write to a task's file, or, where another process has put a result measured in another way there
#' meanwhile, to one beside it
#' @param write Function of the path and whether it must be new; gives whether it was written.
#' @return The path.
#' @noRd
keep_apart <- function(task, write) {
  beside <- sub("[.]shape$", paste0("-", substr(task$key, 1, 8), ".shape"), task$file)
  for (file in c(task$file, beside)) {
    if (file.exists(file)) {
      there <- peek_kept(file)
      ours <- there$own && (identical(there$key, task$key) || is.na(there$mesh) ||
                              identical(there$mesh, task$mesh) &&
                                identical(there$setting, task$setting))
      if (ours && write(file, FALSE)) return(file)
    } else if (write(file, TRUE) || identical(peek_kept(file)$key, task$key)) {
      return(file)
    }
  }
  write(beside, FALSE)
  beside
}

#' A failure, remembered in the folder of results, so that [read_batch()] tells of it
#' @noRd
note_failure <- function(failure, task) {
  if (is.null(task$file)) return(failure)
  file <- failure_of_task(task)
  about <- c(task[c("key", "mesh", "setting", "words", "scheme")], list(
    id = task$name, failure = unclass(failure)[c("stage", "message", "remedy", "warnings")]
  ))
  about[c("key", "mesh", "setting")] <- lapply(about[c("key", "mesh", "setting")], function(one) {
    if (is.na(one)) "none" else one
  })
  tryCatch({
    keep(list(), about, file)
    append_index(index_row(file, list(state = "whole", about = about)), dirname(file))
  }, crestline_keeping_error = function(e) NULL)
  failure
}

#' The file of a task's failure. On disks without capitals the name may be that of another specimen,
#' measured in another run: then one beside it
#' @noRd
failure_of_task <- function(task) {
  file <- sub("[.]shape$", ".failure", task$file)
  id <- if (file.exists(file)) open_kept(file)$about$id
  if (is.null(id) || identical(id, task$name)) return(file)
  sub("[.]failure$", sprintf("-%s.failure", substr(content_hash(task$name), 1, 8)), file)
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
