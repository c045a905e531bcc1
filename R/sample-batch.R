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
#' kept apart. A message gives the numbers of results that are read, replaced, or kept beside new
#' ones.
#'
#' Results of other settings, schemes or ways of reading are never overwritten. The new result gets
#' a file beside the old one, with a part of a hash in its name. A result of the same scan by other
#' landmarks is replaced. [read_batch()] opens a folder of results in another session. `saveRDS()`
#' of a batch with `dir` stores only the paths of its files.
#'
#' A result takes less than 0.1 MB: points, paths and checks. Scheme and settings lie once in the
#' folder (`common-*.value`). The scan stays in its own file. The result has its path and a hash of
#' its content, and reads it only when you ask for the mesh. If the scan is gone or has changed, an
#' error names it. Move scans and results together, or name the new folder of the scans:
#' `options(crestline.scans = "folder")`. Specimens that are not in files are stored with their
#' result. Co-ordinates of points keep every bit, those of paths 40 bits. Results of former versions
#' are read, and written anew in this way.
#'
#' An index (`index-*.tsv`) lists the results. [print()], [failures()] and [warnings_of()] read it
#' alone. [quality()] reads the measures of all parts beside it (`quality-*.tsv`, 3 to 7 kB a
#' specimen), and opens no result. Both are made anew where they are lost or out of date.
#'
#' For thousands of scans, run `fit_shapes(files, scheme, dir, part = c(i, n))` in n jobs, each with
#' its own `i`. Every job measures every n-th specimen. [read_batch()] opens the whole. If a job is
#' killed, run it again. See `vignette("many")`.
#'
#' The file of a result has a checksum, which is compared before the file is read. A damaged or
#' truncated result is measured again. Several runs may share a folder, at the same time too. A run
#' deletes only its own unfinished files. Unfinished files of a run that was killed (`part-*.tmp`)
#' remain. They are never read, and you may delete them.
#'
#' If a result cannot be written (a full disk) or a worker dies, its specimens are tried once more,
#' each alone. After a second error they are failures. One worker takes
#' `getOption("crestline.chunk")` specimens at a time; by default each worker gets two parts. With
#' small parts workers are started more often; with large ones they wait longer at the end.
#'
#' If no mesh has landmarks, they are found by `template`, see [find_landmarks()]. A landmark with
#' little confidence is left out, and with it the curves that end there. If most landmarks have
#' little confidence, the specimen is refused, see [check_placing()]. A picture of its landmarks is
#' then saved in `dir`, or in R's temporary folder. `print()` and `summary()` show which specimens
#' have found landmarks.
#'
#' @param x One of the following:
#'   * mesh files (paths, see [read_specimen()]). The id of a file is its name without the
#'     extension. If several files share that name, their folders are added: "visit 1/anna",
#'     "visit 2/anna";
#'   * a folder: the mesh files in it;
#'   * a list of [specimen()]s;
#'   * a `shape_batch` of this function: its failed specimens are measured again. Arguments that you
#'     give are changed for them, all others are those of the run that failed.
#' @param scheme A [curve_scheme()], such as [face_scheme()].
#' @param dir Folder for the results; it is created if it does not exist. `NULL`: results are kept
#'   in memory.
#' @param landmarks Landmarks of mesh files. `NULL`: those of a file in the same folder with the
#'   name of the mesh and an extension of [read_landmarks()], in upper or lower case, if there is
#'   one. Two such files that differ are a failure. Otherwise one of the following, matched by the
#'   ids of the specimens:
#'   * a landmark file for each specimen;
#'   * one file for all (.tps, .nts, .csv with a column of specimens);
#'   * a folder of landmark files. If it is an observer's folder of [digitise()], curves are
#'     measured as they were drawn;
#'   * a named list of k x 3 matrices;
#'   * a k x 3 x n array with names.
#' @param template A [landmark_template()] for meshes without landmarks. `NULL`: [face_template()]
#'   if the scheme's landmarks are those of the face, else none.
#' @param doubtful Greatest share of found landmarks with little confidence that are not left out.
#'   They are used and graded amber.
#' @param ... Further arguments of [fit_shape()], the same for all, and by name:
#'   * `part`: two whole numbers, `c(i, n)`: of all specimens, only the i-th and every n-th after it
#'     are measured. Give the same `x` in every part;
#'   * `embed`: TRUE: results in `dir` have their scans with them. FALSE (default): scans in files
#'     are stored by path and hash. Results that exist stay as they are.
#'
#'   The former argument `chunk` gives a message of class `crestline_deprecated`.
#' @param found TRUE: landmarks are found for every mesh that has none. FALSE: such a mesh is a
#'   failure. `NULL`: landmarks are found only if no mesh has any. A mesh without landmarks among
#'   others with landmarks is then a failure. So found and placed landmarks are not mixed by
#'   accident.
#' @param reading For mesh files: named list of further arguments of [read_specimen()], [specimen()]
#'   and [read_landmarks()], such as `list(frame = "RAS", names = c(prn = "pn"), tolerance = 0.02)`.
#'   It may also have `unit`, as in [fit_shape()]. `rescale` is one factor for all specimens, or has
#'   the names of the specimens that are in another unit: `list(rescale = c(anna = 1000))`.
#' @param progress Whether to show progress: a bar in a session with a user, see
#'   [progressr::with_progress()], otherwise a line a minute to the standard error.
#' @return Object of class `shape_batch`: a named list with a shape for each id, or `NULL` for a
#'   specimen that failed. With `dir`, a shape is read from its file when you use it.
#'   * `x[["id"]]`, `x$id`, `x[[i]]`: one shape; an unknown id is an error;
#'   * `x[i]`, `rev(x)`, `head(x)`: a batch of some specimens. `c(x, y)` joins two batches of one
#'     scheme. If one has a failure and the other a result of an id, the result is taken, with a
#'     message. Two results of one id are an error;
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
#'   missing, or has another result now. The value is then `NULL`. Of class `crestline_twin`: two
#'   ids have one mesh with the same landmarks. Of class `crestline_unit_warning`: `c()` joins
#'   specimens in different units.
#' @seealso [read_batch()] for the results in a folder; [failures()], [warnings_of()],
#'   [homologise()]
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
                       doubtful = 0, ..., found = NULL, reading = list(), progress = TRUE) {
  check_given()
  check_flags(progress)
  if (!is.null(template)) template <- check_template(template)
  rlang::check_installed(c("future", "progressr"), "to measure many specimens.")
  settings <- check_fit_arguments(list(...))
  chunk <- check_chunk(settings$chunk)
  part <- check_part(settings$part)
  embed <- if (is.null(settings$embed)) FALSE else check_flag(settings$embed, "embed")
  settings[c("chunk", "part", "embed")] <- NULL
  if (is.list(reading) && !is.null(reading[["unit"]])) {
    settings <- with_unit(settings, reading$unit)
    reading$unit <- NULL
  }
  if (!is.null(dir)) dir <- results_folder(dir)
  run <- list(settings = settings, dir = dir, template = template, doubtful = doubtful,
              found = found, part = part, embed = embed)
  if (inherits(x, "shape_batch")) {
    if (!missing(scheme)) refuse_other_scheme()
    given <- c("settings", names(match.call()))
    return(fit_again(x, run[intersect(names(run), given)], landmarks, reading, chunk, progress))
  }
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  jobs <- batch_jobs(x, landmarks, reading)
  batch <- fit_jobs(jobs, rlang::as_environment(c(run, list(scheme = scheme))), chunk, progress)
  tell_twins(batch, "batch")
  batch
}

#' Specimens that one worker takes at a time; NULL: as many as give each worker two parts
#' @param former As given by the former argument.
#' @noRd
check_chunk <- function(former) {
  if (!is.null(former)) inform_former("chunk =", "options(crestline.chunk = )")
  chunk <- if (is.null(former)) getOption("crestline.chunk") else former
  if (!is.null(chunk)) check_count(chunk, "chunk")
}

refuse_other_scheme <- function() {
  crestline_abort("`scheme` goes with meshes or specimens, but `x` is a batch.",
                  "Its failed specimens are measured again by its own scheme: leave it out.",
                  stage = "arguments")
}

#' Arguments for fit_shape() with the unit of what is read
#' @noRd
with_unit <- function(settings, unit) {
  if (!is.null(settings$unit) && !identical(settings$unit, unit)) {
    crestline_abort("`unit` and `reading$unit` differ.", "Give one of them.", stage = "arguments")
  }
  settings$unit <- check_number(unit, "reading$unit", 0, open = TRUE)
  settings
}

#' Arguments for fit_shape() in the form of today
#' @noRd
with_former_fields <- function(settings) {
  former <- unlist(former_fit_fields())
  given <- settings[names(settings) %in% former]
  if (!length(given)) return(settings)
  objects <- list(settings = ridge_settings(), measuring = shape_settings())
  objects[intersect(names(objects), names(settings))] <-
    settings[intersect(names(objects), names(settings))]
  changed <- with_former(objects, former_fit_fields(), given)
  used <- vapply(former_fit_fields(), function(own) any(own %in% names(given)), NA)
  settings <- settings[setdiff(names(settings), former)]
  settings[names(used)[used]] <- changed[used]
  settings
}

#' Arguments for fit_shape(), none that it does not take
#' @noRd
check_fit_arguments <- function(settings) {
  given <- names(settings)
  if (is.null(given)) given <- rep("", length(settings))
  takes <- setdiff(names(formals(fit_shape)), c("specimen", "scheme", "..."))
  strange <- setdiff(given, c(takes, "chunk", "part", "embed", unlist(former_fit_fields())))
  if (!length(strange)) return(with_former_fields(settings))
  for_reading <- intersect(strange, unlist(reading_arguments()))
  crestline_abort(
    sprintf("%s no argument of fit_shapes() or fit_shape().",
            if (all(nzchar(strange))) paste(shorten(strange), "is") else
      "what has no name is"),
    if (length(for_reading)) {
      sprintf("What reading takes goes into `reading`: reading = list(%s = ...).", for_reading[1])
    } else sprintf("Further arguments: %s.", shorten(takes, 20)),
    stage = "arguments"
  )
}
