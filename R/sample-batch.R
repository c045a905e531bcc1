# Many specimens by one scheme: in parallel as the user plans it, each result kept as it comes, a killed run gone on with.

#' Measure many specimens
#'
#' [fit_shape()] for every specimen, over the package future.apply: the plan is yours,
#' `future::plan("multisession", workers = 4)` on one machine, `"cluster"` on several, a queue through future.batchtools;
#' without one they are measured one after the other. What goes wrong with one specimen costs only that one, see
#' [failures()].
#'
#' With `dir` every result is written there as it comes, whole or not at all, and read only when asked for, so that
#' memory does not grow with the number of specimens. A run that was cut short goes on where it was: what is in `dir` is
#' not measured again as long as its input (the files' or specimen's content), the scheme, the settings and the package's
#' version are the same; only the rest is sent to the workers. Failures are tried again.
#'
#' Where a mesh comes without landmarks they are found by `template`, see [find_landmarks()], and the specimen is refused
#' where they are
#' doubtful, see [check_placing()], with a picture of them: in `dir`, or in R's temporary folder.
#'
#' @param x Mesh files (paths, see [read_specimen()]), or a list of [specimen()]s.
#' @param scheme A [curve_scheme()], such as [face_scheme()].
#' @param dir Folder for the results, made where it is not there; `NULL`: they are kept in memory.
#' @param landmarks With mesh files: their landmark files, one for each; `NULL`: the file beside each mesh with its name
#'   and an extension of [read_landmarks()], where there is one.
#' @param template A [landmark_template()] for meshes without landmarks; `NULL`: [face_template()] where the scheme's
#'   landmarks
#'   are those of the face, else none.
#' @param doubtful As in [check_placing()].
#' @param ... Further arguments of [fit_shape()], the same for all.
#' @param chunk Specimens a future: the number that one worker takes at a time; `NULL`: so many that each worker is
#'   given two lots. Small lots cost more starts, large ones more waiting at the end.
#' @param progress Whether to show a progress bar, see [progressr::with_progress()].
#' @return Object of class `shape_batch`: a list of shapes by name of specimen (its id, or the file's name), `NULL` where
#'   it failed.
#'   With `dir`, `x[[i]]` reads a shape from its file, and so does `as.list(x)` with all of them; `print(x)` counts.
#' @section Errors: of class `crestline_error`: for arguments that serve no specimen. Those of single specimens are kept, see
#'   [failures()].
#' @seealso [failures()], [homologise()]
#' @examplesIf requireNamespace("future.apply", quietly = TRUE) && requireNamespace("progressr", quietly = TRUE)
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
fit_shapes <- function(x, scheme = face_scheme(), dir = NULL, landmarks = NULL, template = NULL, doubtful = 0, ...,
                       chunk = NULL, progress = interactive()) {
  check_given()
  check_flags(progress)
  if (!is.null(template)) template <- check_template(template)
  rlang::check_installed(c("future", "future.apply", "progressr"), "to measure many specimens.")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  if (!is.null(chunk)) chunk <- check_count(chunk, "chunk")
  jobs <- batch_jobs(x, landmarks)
  files <- batch_files(names(jobs), dir)
  jobs <- with_finder(jobs, files, template, doubtful, scheme)
  settings <- list(...)
  tasks <- Map(function(job, file, name) batch_task(job, file, name, scheme, settings), jobs, files, names(jobs))
  open <- !vapply(tasks, is_kept, NA)
  run <- function() measure_tasks(tasks[open], scheme, settings, chunk)
  results <- stats::setNames(vector("list", length(jobs)), names(jobs))
  if (any(open)) results[open] <- if (progress) progressr::with_progress(run()) else run()
  structure(results, files = files, class = "shape_batch")
}

#' One specimen's task: what is measured, where it is kept, and the key that tells whether it is kept already
#' @noRd
batch_task <- function(job, file, name, scheme, settings) {
  key <- if (!is.null(file)) tryCatch(job_key(job, scheme, settings), error = function(e) NULL)
  list(job = job, file = file, name = name, key = key)
}

#' Whether a task's shape is in its file
#' @noRd
is_kept <- function(task) !is.null(task$key) && identical(read_kept(task$file, "key"), task$key)

#' All tasks, by the user's plan
#' @return List of what [measure_task()] returns.
#' @noRd
measure_tasks <- function(tasks, scheme, settings, chunk) {
  if (is.null(chunk)) chunk <- ceiling(length(tasks) / (2 * future::nbrOfWorkers()))
  run_tasks(tasks, function(task) measure_task(task, scheme, settings), chunk)
}

#' Work at each of some tasks by the user's plan, with progress
#'
#' @param tasks List of lists, each with its `name`.
#' @param chunk Number of tasks a future.
#' @param poll Seconds between two looks at workers that are busy, where the user has set no other: future's own 0.01
#'   takes a tenth of a core, of which nothing is left when there are as many workers as cores.
#' @noRd
run_tasks <- function(tasks, work, chunk, poll = 0.05) {
  rlang::local_options(future.wait.interval = getOption("future.wait.interval", poll))
  tick <- progressr::progressor(steps = length(tasks))
  future.apply::future_lapply(tasks, function(task) {
    result <- work(task)
    tick(task$name)
    result
  }, future.chunk.size = chunk, future.packages = "crestline", future.seed = NULL)
}

#' What is to be measured: files or specimens, by name
#' @noRd
batch_jobs <- function(x, landmarks) {
  if (inherits(x, "specimen")) x <- list(x)
  if (is.character(x) && length(x)) {
    if (is.null(landmarks)) landmarks <- vapply(x, landmarks_beside, "", USE.NAMES = FALSE)
    if (length(landmarks) != length(x)) {
      crestline_abort(sprintf("`landmarks` names %d files, `x` %d.", length(landmarks), length(x)),
                      "Give one landmark file for each mesh.", stage = "arguments")
    }
    jobs <- Map(function(mesh, points) list(mesh = mesh, landmarks = points), x, landmarks, USE.NAMES = FALSE)
    return(stats::setNames(jobs, make.unique(sub("[.][^.]*$", "", basename(x)), sep = " ")))
  }
  if (!is.list(x) || !length(x)) {
    crestline_abort(sprintf("`x` is %s.", describe_value(x)), "Give paths of meshes, or a list of specimens.", stage = "arguments")
  }
  for (one in x) check_class(one, "specimen", "x", "specimen() or read_specimen()")
  stats::setNames(lapply(x, function(one) list(specimen = one)), make.unique(vapply(x, `[[`, "", "id"), sep = " "))
}

#' The landmark file beside a mesh, "" where there is none
#' @noRd
landmarks_beside <- function(file) {
  stem <- sub("[.][^.]*$", "", file)
  beside <- paste0(stem, ".", names(landmark_formats()))
  c(beside[file.exists(beside)], "")[1]
}

#' Where the results go, NULL for memory; parts that a killed run left are cleared away
#' @noRd
batch_files <- function(names, dir) {
  if (is.null(dir)) return(vector("list", length(names)))
  dir <- results_folder(dir)
  safe <- make.unique(gsub("[^[:alnum:]._ -]", "_", names), sep = " ")
  as.list(file.path(dir, paste0(safe, ".shape")))
}

#' The folder for results, made where it is not there
#' @noRd
results_folder <- function(dir) {
  if (!is.character(dir) || length(dir) != 1 || is.na(dir)) {
    crestline_abort(sprintf("`dir` is %s.", describe_value(dir)), "Give the path of one folder.", stage = "arguments")
  }
  dir.create(dir, recursive = TRUE, showWarnings = FALSE)
  if (!dir.exists(dir)) {
    crestline_abort(sprintf("the folder %s cannot be made.", dir), "Choose another, or check who may write there.", stage = "arguments")
  }
  unlink(list.files(dir, "^part-.*[.]tmp$", full.names = TRUE))
  normalizePath(dir)
}

#' One specimen measured
#'
#' @return Where it is kept in a file NULL; else the shape, or a failure (class `shape_failure`).
#' @noRd
measure_task <- function(task, scheme, settings) {
  result <- tryCatch(fit_job(task$job, scheme, settings), error = function(e) failure_of(e))
  if (is.null(task$file)) return(result)
  keep(result, if (inherits(result, "shape")) task$key, task$file)
  NULL
}

#' Write a result: the key first, so that it can be read alone; under another name until all of it is there
#'
#' @param compression Of gzip, 1 to 9: a scan is hardly smaller with 6 than with 1, and takes five times as long.
#' @noRd
keep <- function(result, key, file, compression = 1) {
  part <- tempfile("part-", dirname(file), ".tmp")
  to <- gzfile(part, "wb", compression = compression)
  serialize(key, to)
  serialize(result, to)
  close(to)
  file.rename(part, file)
}

#' @param what "key", of a shape, or the "result"; NULL where the file is not there or cannot be read.
#' @noRd
read_kept <- function(file, what) {
  if (!file.exists(file)) return(NULL)
  from <- gzfile(file, "rb")
  on.exit(close(from))
  tryCatch({
    key <- unserialize(from)
    if (what == "key") key else unserialize(from)
  }, error = function(e) NULL)
}

#' What a result depends on, as one string
#' @noRd
job_key <- function(job, scheme, settings) {
  input <- if (is.null(job$specimen)) {
    rlang::hash_file(c(job$mesh, if (nzchar(job$landmarks)) job$landmarks))
  } else {
    job$specimen[c("mesh", "landmarks", "id")]
  }
  rlang::hash(list(input, unclass(scheme), lapply(settings, unclass), job$finder$key, as.character(utils::packageVersion("crestline"))))
}

fit_job <- function(job, scheme, settings) {
  quiet <- function(code) suppressWarnings(code, classes = "crestline_warning")
  one <- job$specimen
  if (is.null(one)) one <- quiet(read_specimen(job$mesh, if (nzchar(job$landmarks)) job$landmarks))
  if (!is.null(job$finder)) one <- quiet(found_specimen(one, job$finder))
  quiet(do.call(fit_shape, c(list(one, scheme), utils::modifyList(list(progress = FALSE), settings))))
}

failure_of <- function(e) {
  own <- inherits(e, "crestline_error")
  structure(list(stage = if (own) e$stage else "unforeseen", message = if (own) e$problem else conditionMessage(e),
                 remedy = if (own) e$remedy else "Please report it, with the specimen if you may."), class = "shape_failure")
}

#' What went wrong with the specimens of a batch
#'
#' @param x A `shape_batch`, as [fit_shapes()] returns it.
#' @return Data frame, a row a specimen that failed: `id`, `stage` (where), `message` (what), `remedy` (what to do about it).
#' @section Errors: of class `crestline_error`, when `x` is no batch.
#' @examplesIf requireNamespace("future.apply", quietly = TRUE) && requireNamespace("progressr", quietly = TRUE)
#' bad <- tempfile(fileext = ".ply")
#' writeLines("no mesh", bad)
#' curve <- data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 7)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b")), curve, name = "one line")
#' failures(fit_shapes(bad, scheme))
#' @export
failures <- function(x) {
  check_given()
  check_class(x, "shape_batch", "x", "fit_shapes()")
  rows <- lapply(names(x), function(name) {
    result <- batch_result(x, name)
    if (inherits(result, "shape")) return(NULL)
    if (is.null(result)) result <- unreadable(attr(x, "files")[[match(name, names(x))]])
    data.frame(id = name, stage = result$stage, message = result$message, remedy = result$remedy)
  })
  empty <- data.frame(id = character(), stage = character(), message = character(), remedy = character())
  do.call(rbind, c(list(empty), rows))
}

unreadable <- function(file) {
  list(stage = "keeping", message = sprintf("its file %s is not there or cannot be read.", file),
       remedy = "Delete it if it is there, and run fit_shapes() again.")
}

#' Result of one specimen, from memory or its file
#' @noRd
batch_result <- function(x, i) {
  all <- unclass(x)
  i <- if (is.character(i)) match(i, names(all)) else i
  file <- attr(x, "files")[[i]]
  if (is.null(file)) all[[i]] else read_kept(file, "result")
}

#' @export
`[[.shape_batch` <- function(x, i, ...) {
  if (length(i) != 1 || is.na(if (is.character(i)) match(i, names(x)) else i)) return(NULL)
  result <- batch_result(x, i)
  if (inherits(result, "shape")) result
}

#' @export
`$.shape_batch` <- function(x, name) x[[name]]

#' @export
`[.shape_batch` <- function(x, i, ...) {
  all <- unclass(x)
  files <- stats::setNames(attr(x, "files"), names(all))
  attr(all, "files") <- NULL
  structure(all[i], files = unname(files[i]), class = "shape_batch")
}

#' @export
as.list.shape_batch <- function(x, ...) stats::setNames(lapply(seq_along(names(x)), function(i) x[[i]]), names(x))

#' @export
print.shape_batch <- function(x, most = 8, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  failed <- failures(x)
  files <- unlist(attr(x, "files"))
  cat("<shape_batch> ", amount(length(names(x)), "specimen"), ": ", length(names(x)) - nrow(failed), " measured, ", nrow(failed), " failed",
      if (length(files)) paste0(", in ", dirname(files[1])), "\n", sep = "")
  for (i in seq_len(min(most, nrow(failed)))) {
    cat(strwrap(sprintf("- %s, %s: %s %s", failed$id[i], failed$stage[i], failed$message[i], failed$remedy[i]), width = 80, exdent = 4), sep = "\n")
  }
  if (nrow(failed) > most) cat("- and", nrow(failed) - most, "more in failures()\n")
  invisible(x)
}
