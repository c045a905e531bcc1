# Many specimens by one scheme: in parallel as the user plans it, each result kept as it comes, a
# killed run gone on with.

#' Measure many specimens
#'
#' Calls [fit_shape()] for every specimen, in parallel by the package future. You choose the plan:
#' `future::plan("multisession", workers = 4)` on one machine, `"cluster"` on several, or a queue
#' through future.batchtools. Without a plan, specimens are measured one after the other. A specimen
#' that fails does not stop the others, see [failures()]. Warnings are kept with each shape, see
#' [warnings_of()], and printed. [crestline-package] has a glossary.
#'
#' With `dir` every result is written to that folder as soon as it is ready, and read again when it
#' is needed. Memory therefore does not grow with the number of specimens. A result is written whole
#' or not at all. A run that was interrupted continues where it stopped; failures are tried again. A
#' result in `dir` is used again if mesh, landmarks, scheme, settings, template and `reading` are
#' the same, and if the version of the package gives the same answers. File names do not matter. A
#' scan that was renamed is not measured again, and two scans of one name in different folders are
#' kept apart. A message gives the number of results that are read, and the number of results of
#' other settings that are replaced. Use one folder for each set of settings.
#'
#' To read results in a new session, call `fit_shapes()` again with the same arguments. `saveRDS()`
#' of a batch with `dir` stores only the paths of its files.
#'
#' The file of a result has a checksum, which is compared before the file is read. A damaged or
#' truncated result is measured again. Several runs may share a folder. A run deletes only its own
#' unfinished files. Unfinished files of a run that was killed (`part-*.tmp`) remain. They are never
#' read, and you may delete them.
#'
#' If a result cannot be written (a full disk) or a worker dies, its specimens are tried once more,
#' each alone. After a second error they are failures.
#'
#' If no mesh has landmarks, they are found by `template`, see [find_landmarks()]. A landmark with
#' little confidence is left out, and with it the curves that end there. If most landmarks have
#' little confidence, the specimen is refused, see [check_placing()]. A picture of its landmarks is
#' then saved in `dir`, or in R's temporary folder. `print()` and `summary()` show which specimens
#' have found landmarks.
#'
#' @param x Mesh files, or a list of [specimen()]s. Files are given by their paths, each once, such
#'   as `list.files("scans", "[.]ply$", full.names = TRUE)`; see [read_specimen()]. The id of a file
#'   is its name without the extension. If several files share that name, their folders are added:
#'   "visit 1/anna", "visit 2/anna".
#' @param scheme A [curve_scheme()], such as [face_scheme()].
#' @param dir Folder for the results; it is created if it does not exist. `NULL`: results are kept
#'   in memory.
#' @param landmarks Landmarks of mesh files. `NULL`: those of a file in the same folder with the
#'   name of the mesh and an extension of [read_landmarks()], in upper or lower case, if there is
#'   one. Two such files that differ are a failure. Otherwise one of the following, matched by the
#'   ids of the specimens:
#'   * a landmark file for each specimen;
#'   * one file for all (.tps, .nts, .csv with a column of specimens);
#'   * a folder of landmark files;
#'   * a named list of k x 3 matrices;
#'   * a k x 3 x n array with names.
#' @param template A [landmark_template()] for meshes without landmarks. `NULL`: [face_template()]
#'   if the scheme's landmarks are those of the face, else none.
#' @param doubtful Greatest share of found landmarks with little confidence that are not left out.
#'   They are used and graded amber.
#' @param ... Further arguments of [fit_shape()], the same for all.
#' @param found TRUE: landmarks are found for every mesh that has none. FALSE: such a mesh is a
#'   failure. `NULL`: landmarks are found only if no mesh has any. A mesh without landmarks among
#'   others with landmarks is then a failure. So found and placed landmarks are not mixed by
#'   accident.
#' @param reading For mesh files: named list of further arguments of [read_specimen()], [specimen()]
#'   and [read_landmarks()], such as `list(frame = "RAS", names = c(prn = "pn"), tolerance = 0.02)`.
#'   It may also have `unit`, as in [fit_shape()]. `rescale` is one factor for all specimens, or has
#'   the names of the specimens that are in another unit: `list(rescale = c(anna = 1000))`.
#' @param chunk Number of specimens that one worker takes at a time. `NULL`: each worker gets two
#'   such parts. With small parts workers are started more often; with large ones they wait longer
#'   at the end.
#' @param progress Whether to show a progress bar, see [progressr::with_progress()]. In a script
#'   that `Rscript` runs, set `options(progressr.enable = TRUE)` too.
#' @return Object of class `shape_batch`: a named list with a shape for each id, or `NULL` for a
#'   specimen that failed. With `dir`, a shape is read from its file when you use it.
#'   * `x[["id"]]`, `x$id`, `x[[i]]`: one shape; an unknown id is an error;
#'   * `x[i]`, `rev(x)`, `head(x)`: a batch of some specimens. `c(x, y)` joins two batches of one
#'     scheme. If a specimen failed in one of them and was measured in the other, the result is
#'     taken;
#'   * `length(x)`, `names(x)`: all specimens, failed ones too;
#'   * `for (shape in x)` has one shape in memory at a time; `lapply(x, f)` and `as.list(x)` have
#'     all in memory;
#'   * `print(x)` counts and lists failures and warnings. `summary(x)` is a data frame with a row
#'     for each specimen. Columns are `specimen`, `measured` (TRUE or FALSE), `landmarks` ("placed",
#'     "found"), `lacking` (number of missing landmarks of the scheme), `warnings` (number), and
#'     `message` (reason of a failure).
#' @section Errors: of class `crestline_error`: an argument is wrong for every specimen. Errors of
#'   single specimens do not stop the batch, see [failures()].
#' @section Warnings: of class `crestline_keeping_warning`: the file of a result is damaged or
#'   missing, or has another result now. The value is then `NULL`.
#' @seealso [failures()], [warnings_of()], [homologise()]
#' @examplesIf rlang::is_installed(c("future", "progressr"))
#' ball <- Rvcg::vcgSphere(4)
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc"), from = c("a", "b"), to = c("b", "c"), kind = "plane",
#'                      n = 7)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "two sides")
#' balls <- lapply(1:3, function(i) specimen(ball, corners, id = paste("ball", i)))
#' shapes <- fit_shapes(balls, scheme)
#' shapes
#' shapes[["ball 2"]]
#' @export
fit_shapes <- function(x, scheme = face_scheme(), dir = NULL, landmarks = NULL, template = NULL,
                       doubtful = 0, ...,
                       found = NULL, reading = list(), chunk = NULL, progress = interactive()) {
  check_given()
  check_flags(progress)
  if (!is.null(template)) template <- check_template(template)
  rlang::check_installed(c("future", "progressr"), "to measure many specimens.")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  if (!is.null(chunk)) chunk <- check_count(chunk, "chunk")
  settings <- check_fit_arguments(list(...))
  if (is.list(reading) && !is.null(reading[["unit"]])) {
    settings <- with_unit(settings, reading$unit)
    reading$unit <- NULL
  }
  jobs <- batch_jobs(x, landmarks, reading)
  if (!is.null(dir)) dir <- results_folder(dir)
  jobs <- with_finder(jobs, dir, template, doubtful, scheme, found)
  tasks <- batch_tasks(jobs, dir, scheme, settings)
  results <- if (is.null(dir)) vector("list", length(tasks)) else lapply(tasks, kept_result)
  open <- vapply(results, is.null, NA)
  if (!is.null(dir)) say_kept(tasks, open)
  refusal <- if (any(open) && !is.null(dir)) unwritable(dir)
  if (!is.null(refusal)) {
    results[open] <- list(failure_of(refusal))
    open[] <- FALSE
  }
  run <- function() measure_tasks(tasks[open], scheme, settings, chunk)
  if (any(open)) results[open] <- if (isTRUE(progress)) progressr::with_progress(run()) else run()
  batch_of(stats::setNames(results, names(jobs)), scheme)
}

#' Say how many results the folder has already, and how many of other settings are replaced
#' @noRd
say_kept <- function(tasks, open) {
  kept <- sum(!open)
  other <- vapply(tasks[open], function(task) !is.na(peek_kept(task$file)$key), NA)
  if (kept) {
    crestline_inform(sprintf("%d of %s are read from the folder; %d to measure.", kept,
                             amount(length(tasks), "result"), sum(open)))
  }
  if (any(other)) {
    crestline_inform(sprintf(paste(
      "Replaced in the folder: %s of other settings, landmarks or meshes (%s).",
      "Use another `dir` to keep both."
    ), amount(sum(other), "result"), shorten(vapply(tasks[open][other], `[[`, "", "name"))))
  }
}

#' Arguments for fit_shape() with the unit of what is read
#' @noRd
with_unit <- function(settings, unit, call = rlang::caller_env()) {
  if (!is.null(settings$unit) && !identical(settings$unit, unit)) {
    crestline_abort("`unit` and `reading$unit` differ.", "Give one of them.", stage = "arguments",
                    call = call)
  }
  settings$unit <- check_number(unit, "reading$unit", 0, open = TRUE, call = call)
  settings
}

#' Arguments for fit_shape(), none that it does not take
#' @noRd
check_fit_arguments <- function(settings, call = rlang::caller_env()) {
  given <- names(settings)
  if (is.null(given)) given <- rep("", length(settings))
  takes <- setdiff(names(formals(fit_shape)), c("specimen", "scheme"))
  strange <- setdiff(given, takes)
  if (!length(strange)) return(settings)
  for_reading <- intersect(strange, unlist(reading_arguments()))
  crestline_abort(
    sprintf("%s no argument of fit_shapes() or fit_shape().",
            if (all(nzchar(strange))) paste(shorten(strange), "is") else
      "what has no name is"),
    if (length(for_reading)) {
      sprintf("What reading takes goes into `reading`: reading = list(%s = ...).", for_reading[1])
    } else sprintf("Further arguments: %s.", shorten(takes, 20)),
    stage = "arguments", call = call
  )
}

#' All tasks: what is measured, where it is kept, and the key that tells whether it is kept already
#' @noRd
batch_tasks <- function(jobs, dir, scheme, settings) {
  tasks <- lapply(jobs, function(job) list(job = job, name = job$id))
  if (is.null(dir)) return(tasks)
  contents <- lapply(jobs, job_content, scheme, settings)
  keys <- vapply(contents, `[[`, "", "key")
  files <- result_files(dir, names(jobs), keys, vapply(contents, `[[`, "", "mesh"))
  Map(function(task, content, file) c(task, content, list(file = file)), tasks, contents, files)
}

#' The files of results: where a result of that key is; else one of the id's name, if what is there
#' is of the same mesh and of no use to another specimen of the batch; else one of the id's and the
#' mesh's
#' @noRd
result_files <- function(dir, ids, keys, meshes) {
  files <- file.path(dir, paste0(file_stems(ids), ".shape"))
  there <- list.files(dir, "[.]shape$", full.names = TRUE)
  inside <- lapply(there, peek_kept)
  kept <- vapply(inside, `[[`, "", "key")
  for (i in which(!is.na(keys))) {
    own <- match(files[i], there)
    if (is.na(own) && !keys[i] %in% kept || !is.na(own) && kept[own] %in% keys[i]) next
    if (keys[i] %in% kept) {
      files[i] <- there[match(keys[i], kept)]
    } else if (!inside[[own]]$own || !inside[[own]]$mesh %in% c(NA, meshes[i]) ||
               kept[own] %in% keys) {
      files[i] <- sub("[.]shape$", sprintf("-%s.shape", substr(meshes[i], 1, 8)), files[i])
    }
  }
  files
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
  about <- c(list(key = task$key, mesh = task$mesh, id = task$name, warnings = shape$warnings),
             told_of(shape))
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
