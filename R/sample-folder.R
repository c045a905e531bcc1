# A folder of results: which file is whose, and the whole of it read as a batch.

#' Read the results in a folder
#'
#' Opens the results that [fit_shapes()] has written to a folder, as a batch. It needs neither the
#' meshes nor the arguments of the run. It works in another session, and after the folder was moved.
#' Shapes are read when they are used. Specimens that failed are failures of the batch. So are
#' specimens of a cohort (`part` of [fit_shapes()]) that are not measured yet, with the stage
#' "waiting".
#'
#' A result stays when its scan is taken away from the folder of scans. A cohort (`part`) remembers
#' its specimens: a message names results of others. Leave them out, `x[ids]`, or delete their
#' files.
#'
#' @param x Path of the folder (`dir` of [fit_shapes()]), or paths of `.shape` files.
#' @return A `shape_batch`, as of [fit_shapes()], in the order of the files' names.
#' @section Errors: of class `crestline_error`: there is no folder or file of that name, it has no
#'   results, or its results have several schemes.
#' @section Messages: if a specimen has several results, the newest is taken, and the message names
#'   the others. If a later run failed on a specimen, the result before is taken, and the message
#'   names the specimen. If the specimens were measured with different settings, the message counts
#'   them. Give the paths of the files that you want instead.
#' @section Failures: a result that is damaged is a failure, see [failures()].
#' @template glossary
#' @seealso [fit_shapes()], [homologise()]
#' @examplesIf rlang::is_installed(c("future", "progressr"))
#' ball <- Rvcg::vcgSphere(4)
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2)) / sqrt(6)
#' curve <- data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 7)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b")), curve, name = "one line")
#' results <- tempfile("results-")
#' fit_shapes(specimen(ball, corners, id = "ball"), scheme, dir = results)
#' read_batch(results)
#' unlink(results, recursive = TRUE)
#' @export
read_batch <- function(x) {
  check_given()
  index <- results_index(x)
  index$id <- ifelse(nzchar(index$id), index$id, vapply(index$path, stem_id, ""))
  index <- newest_results(without_old_failures(index))
  whole <- index$state == "whole"
  failed <- index$state == "failed"
  scheme <- common_scheme(index[whole | failed, ])
  tell_settings(index[whole, ])
  results <- vector("list", nrow(index))
  results[whole] <- kept_in_index(index[whole, ])
  results[failed] <- failures_in_index(index[failed, ])
  results[!whole & !failed] <- lapply(which(!whole & !failed), function(i) {
    one <- list(file = index$path[i], key = index$key[i], name = index$id[i])
    kept_fault(kept_shape(one, NULL), list(state = index$state[i]))
  })
  batch <- batch_in_order(stats::setNames(results, index$id), scheme, waiting_in(x, index$id))
  tell_twins(batch, "batch")
  batch
}

#' A batch of what was read, those that wait behind
#' @noRd
batch_in_order <- function(results, scheme, waiting) {
  results <- c(results, waiting)
  failed <- vapply(results, inherits, NA, "shape_failure")
  shapes <- replace(results, failed, list(NULL))
  read <- names(shapes)[!failed]
  validate_shape_batch(new_shape_batch(shapes, results[failed], scheme, read))
}

#' The index of a folder, or of files by their paths
#' @noRd
results_index <- function(x) {
  if (length(x) == 1 && is.character(x) && !is.na(x) && dir.exists(x)) {
    index <- folder_index(normalizePath(x))
    if (nrow(index)) return(index)
  }
  files <- result_paths(x)
  do.call(rbind, lapply(files, function(file) cbind(index_row(file), path = file)))
}

#' Failures that a folder remembers
#' @noRd
failures_in_index <- function(index) {
  lapply(index$more, function(text) {
    known <- tryCatch(jsonlite::fromJSON(text), error = function(e) list())
    warned <- if (NROW(known$warnings)) as.data.frame(known$warnings) else no_warnings()
    new_failure(c(known$stage, "unforeseen")[1], c(known$message, "its failure is damaged.")[1],
                c(known$remedy, "Run fit_shapes() again.")[1], warned)
  })
}

#' Without failures of specimens that have a result; of one that failed later a message tells
#' @noRd
without_old_failures <- function(index) {
  failed <- index$state == "failed"
  again <- failed & index$id %in% index$id[!failed]
  time <- suppressWarnings(as.numeric(index$time))
  later <- vapply(which(again), function(i) {
    isTRUE(time[i] > max(time[!failed & index$id == index$id[i]]))
  }, NA)
  if (any(later)) {
    crestline_inform(c(
      sprintf("The last run failed on %s; the results before are taken.",
              shorten(index$id[which(again)[later]], 8)),
      i = "fit_shapes() with the same arguments tells why."
    ))
  }
  index[!again, ]
}

#' Remember the ids of a cohort that is measured in parts
#' @noRd
note_cohort <- function(ids, dir) {
  file <- file.path(dir, sprintf("cohort-%s.value", content_hash(ids)))
  if (!file.exists(file)) keep(ids, list(key = "cohort", mesh = "none"), file)
}

#' Failures for those of the newest cohort of a folder that have no result, and have not failed
#' @noRd
waiting_in <- function(x, there) {
  if (length(x) != 1 || !dir.exists(x)) return(list())
  files <- list.files(x, "^cohort-.*[.]value$", full.names = TRUE)
  if (!length(files)) return(list())
  opened <- open_kept(files[which.max(as.numeric(file.mtime(files)))])
  cohort <- if (opened$state == "whole") kept_value(opened)
  others <- if (length(cohort)) setdiff(there, cohort)
  if (length(others)) {
    crestline_inform(sprintf(
      "%s of scans that the last cohort did not have: %s. They are kept, see read_batch().",
      amount(length(others), "result"), shorten(others, 5)
    ))
  }
  ids <- setdiff(cohort, there)
  failure <- new_failure("waiting", paste("it is not measured yet: its part waits or runs, or the",
                                          "machine that had it has died."),
                         "When no job runs any more, run the same part again.")
  stats::setNames(rep(list(failure), length(ids)), ids)
}

#' Paths of results: those of a folder, or as given
#' @noRd
result_paths <- function(x) {
  if (!is.character(x) || !length(x) || anyNA(x)) {
    refuse_argument("x", x, "Give the path of a folder of results, or of .shape files.")
  }
  folder <- length(x) == 1 && dir.exists(x)
  files <- if (folder) list.files(x, "[.]shape$", full.names = TRUE) else x
  gone <- files[!file.exists(files)]
  if (length(files) && !length(gone)) return(normalizePath(files))
  crestline_abort(if (folder) sprintf("`x`: the folder %s has no results.", x) else
                    sprintf("`x`: there is no folder or file %s.", shorten(gone, 3)),
                  "Give the `dir` of fit_shapes(), or paths of its .shape files.",
                  stage = "batch")
}

#' The id that a file's name is of, as far as it says
#' @noRd
stem_id <- function(file) utils::URLdecode(sub("[.](shape|failure)$", "", basename(file)))

#' One result for each specimen, the newest, and a message that names the others
#' @noRd
newest_results <- function(index) {
  newest <- order(index$id, -suppressWarnings(as.numeric(index$time)), method = "radix")
  newest <- sort(newest[!duplicated(index$id[newest])])
  others <- index[-newest, ]
  if (nrow(others)) {
    crestline_inform(c(
      sprintf("Of %s there are several results; the newest is taken.",
              shorten(unique(others$id), 8)),
      i = sprintf("Not taken: %s. To have these, give the paths of files.",
                  shorten(basename(others$path), 4))
    ))
  }
  index[newest, ]
}

#' The scheme of all results; NULL where files of a former version do not name it
#' @noRd
common_scheme <- function(index) {
  known <- unique(index$scheme_key[nzchar(index$scheme_key)])
  if (length(known) > 1) {
    count <- table(factor(index$scheme_key, known))
    named <- index$scheme[match(known, index$scheme_key)]
    crestline_abort(
      sprintf("the results are of different schemes: %s.",
              shorten(sprintf("%s (%s)", named, vapply(count, amount, "", "specimen")))),
      "Give the paths of the files of one scheme.", stage = "batch"
    )
  }
  if (length(known) && all(nzchar(index$scheme_key))) {
    list(name = index$scheme[1], key = index$scheme_key[1])
  }
}

#' Say with which settings specimens were measured, where these are not the same
#' @noRd
tell_settings <- function(index) {
  count <- table(index$words[nzchar(index$words)])
  if (length(count) < 2) return(invisible())
  each <- sprintf("%s (%s)", names(count), vapply(count, amount, "", "specimen"))
  crestline_inform(sprintf("Specimens were measured in different ways: %s.",
                           paste(each, collapse = "; ")))
}

#' Which file is for the result of each task
#'
#' A result of the task's key is found by the key, whatever its file is called. A result of the
#' same mesh and settings, but of other landmarks or of a former version, gives its place to the
#' new one. Any other file stays, and the new result stands beside it, with a part of a hash in its
#' name.
#'
#' @param jobs Jobs by id, each with its `stem`.
#' @param contents List of what [job_content()] gives, by id.
#' @param index Of the folder.
#' @return Paths; attributes `beside`, `replaced`: numbers of the tasks that get a message, and
#'   `before`, the paths of results of other settings.
#' @noRd
result_files <- function(dir, jobs, contents, index) {
  inside <- files_inside(index[grepl("[.]shape$", index$path), ])
  there <- inside$path
  stems <- file.path(dir, vapply(jobs, `[[`, "", "stem"))
  keys <- vapply(contents, `[[`, "", "key")
  first <- match(paste0(stems, ".shape"), there)
  by_key <- match(keys, inside$key, incomparables = NA)
  placed <- Map(function(stem, content, first, by_key) {
    if (is.na(content$key)) return(list(file = paste0(stem, ".shape")))
    if (!is.na(first) && inside$key[first] %in% content$key) return(list(file = there[first]))
    if (!is.na(by_key)) return(list(file = there[by_key]))
    place_beside(stem, content, inside, keys)
  }, stems, contents, first, by_key)
  files <- vapply(placed, `[[`, "", "file", USE.NAMES = FALSE)
  same_mesh <- (inside$mesh[first] == vapply(contents, `[[`, "", "mesh")) %in% TRUE
  new <- !files %in% there
  structure(files, beside = which(new & same_mesh),
            replaced = which(vapply(placed, function(one) isTRUE(one$replaced), NA)),
            before = there[first[new & same_mesh]])
}

#' What the results of a folder say of themselves: the index's word of whole ones, of others the
#' first line
#' @return Data frame `path`, `key`, `mesh`, `setting`, `own`.
#' @noRd
files_inside <- function(index) {
  known <- data.frame(path = index$path, key = index$key, mesh = text_or_na(index$mesh),
                      setting = text_or_na(index$setting), own = rep(TRUE, nrow(index)))
  for (i in which(index$state != "whole")) {
    known[i, c("key", "mesh", "setting", "own")] <- peek_kept(index$path[i])
  }
  known
}

#' The first name that is free for a result, or whose result is out of date
#' @param keys Of all results that are wanted.
#' @noRd
place_beside <- function(stem, content, inside, keys) {
  first <- match(paste0(stem, ".shape"), inside$path)
  other_mesh <- !is.na(first) && !inside$mesh[first] %in% content$mesh
  setting <- paste0("-", substr(content$setting, 1, 8))
  mesh <- paste0("-", substr(content$mesh, 1, 8))
  ends <- if (other_mesh) c("", mesh, paste0(mesh, setting)) else c("", setting)
  for (file in paste0(stem, ends, ".shape")) {
    at <- match(file, inside$path)
    if (is.na(at)) return(list(file = file))
    one <- inside[at, ]
    stale <- one$own && !one$key %in% keys &&
      (is.na(one$mesh) || one$mesh == content$mesh && one$setting %in% content$setting)
    if (stale) return(list(file = file, replaced = !is.na(one$mesh)))
  }
  list(file = file)
}

#' Say which results are replaced, and which stay beside new ones of other settings
#' @noRd
tell_places <- function(files, ids, contents) {
  replaced <- attr(files, "replaced")
  if (length(replaced)) {
    crestline_inform(sprintf(
      "%s in %s by other landmarks of the same scan, or a former version: to be replaced, of %s.",
      amount(length(replaced), "result"), dirname(files[1]), shorten(ids[replaced])
    ))
  }
  beside <- attr(files, "beside")
  if (!length(beside)) return(invisible())
  before <- known_words(attr(files, "before")[1])
  crestline_inform(c(
    sprintf("%s in %s measured in another way: kept, of %s.", amount(length(beside), "result"),
            dirname(files[1]), shorten(ids[beside])),
    i = sprintf("There: %s. Now: %s, in files such as %s.", before, contents[[beside[1]]]$words,
                basename(files[beside[1]]))
  ))
}

#' How a result was measured, in words, without proof that its file is whole
#' @noRd
known_words <- function(file, most = 1e5) {
  bytes <- read_raw(file, most)
  line <- as.raw(10L)
  text <- tryCatch({
    end <- which(bytes == line)[2:3]
    jsonlite::fromJSON(rawToChar(bytes[(end[1] + 1):(end[2] - 1)]))$words
  }, error = function(e) NULL)
  if (length(text) == 1) text else "not recorded"
}
