# A folder of results: which file is whose, and the whole of it read as a batch.

#' Read the results in a folder
#'
#' Opens the results that [fit_shapes()] has written to a folder, as a batch. It needs neither the
#' meshes nor the arguments of the run. It works in another session, and after the folder was moved.
#' Shapes are read when they are used. Specimens that failed have no file, and are not in the batch.
#'
#' @param x Path of the folder (`dir` of [fit_shapes()]), or paths of `.shape` files.
#' @return A `shape_batch`, as of [fit_shapes()], in the order of the files' names.
#' @section Errors: of class `crestline_error`: there is no folder or file of that name, it has no
#'   results, or its results have several schemes.
#' @section Messages: if a specimen has several results, the newest is taken, and the message names
#'   the others. If the specimens were measured with different settings, the message counts them.
#'   Give the paths of the files that you want instead.
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
  files <- result_paths(x)
  opened <- lapply(files, function(file) {
    opened <- open_kept(file)
    c(opened[c("state", "about")], list(file = file, time = file.mtime(file)))
  })
  id <- vapply(opened, function(one) c(one$about$id, stem_id(one$file))[1], "")
  opened <- newest_results(stats::setNames(opened, id))
  whole <- Filter(function(one) one$state == "whole", opened)
  scheme <- common_scheme(whole)
  tell_settings(whole)
  results <- Map(function(one, id) {
    shape <- kept_shape(list(file = one$file, key = one$about$key, name = id), one$about)
    if (one$state == "whole") shape else kept_fault(shape, one)
  }, opened, names(opened))
  failed <- vapply(results, inherits, NA, "shape_failure")
  shapes <- replace(results, failed, list(NULL))
  batch <- validate_shape_batch(new_shape_batch(shapes, results[failed], scheme,
                                                names(shapes)[!failed]))
  tell_twins(batch, "batch")
  batch
}

#' Paths of results: those of a folder, or as given
#' @noRd
result_paths <- function(x, call = rlang::caller_env()) {
  if (!is.character(x) || !length(x) || anyNA(x)) {
    refuse_argument("x", x, "Give the path of a folder of results, or of .shape files.", call)
  }
  folder <- length(x) == 1 && dir.exists(x)
  files <- if (folder) list.files(x, "[.]shape$", full.names = TRUE) else x
  gone <- files[!file.exists(files)]
  if (length(files) && !length(gone)) return(normalizePath(files))
  crestline_abort(if (folder) sprintf("`x`: the folder %s has no results.", x) else
                    sprintf("`x`: there is no folder or file %s.", shorten(gone, 3)),
                  "Give the `dir` of fit_shapes(), or paths of its .shape files.",
                  stage = "batch", call = call)
}

#' The id that a file's name is of, as far as it says
#' @noRd
stem_id <- function(file) utils::URLdecode(sub("[.]shape$", "", basename(file)))

#' One result for each specimen, the newest, and a message that names the others
#' @noRd
newest_results <- function(opened) {
  time <- vapply(opened, function(one) as.numeric(one$time), 0)
  newest <- order(names(opened), -time, method = "radix")
  newest <- sort(newest[!duplicated(names(opened)[newest])])
  others <- opened[-newest]
  if (length(others)) {
    crestline_inform(c(
      sprintf("Of %s there are several results; the newest is taken.",
              shorten(unique(names(others)), 8)),
      i = sprintf("Not taken: %s. To have these, give the paths of files.",
                  shorten(basename(vapply(others, `[[`, "", "file")), 4))
    ))
  }
  opened[newest]
}

#' The scheme of all results; NULL where files of a former version do not name it
#' @noRd
common_scheme <- function(opened, call = rlang::caller_env()) {
  schemes <- lapply(opened, function(one) one$about$scheme)
  key <- vapply(schemes, function(scheme) c(scheme$key, NA_character_)[1], "")
  known <- unique(key[!is.na(key)])
  if (length(known) > 1) {
    count <- table(factor(key, known))
    named <- vapply(schemes[match(known, key)], `[[`, "", "name")
    crestline_abort(
      sprintf("the results are of different schemes: %s.",
              shorten(sprintf("%s (%s)", named, vapply(count, amount, "", "specimen")))),
      "Give the paths of the files of one scheme.", stage = "batch", call = call
    )
  }
  if (length(known) && !anyNA(key)) as.list(schemes[[1]])
}

#' Say with which settings specimens were measured, where these are not the same
#' @noRd
tell_settings <- function(opened) {
  words <- vapply(opened, function(one) c(one$about$words, NA_character_)[1], "")
  count <- table(words)
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
#' @param contents List of what [job_content()] gives, by id.
#' @return Paths; attributes `beside`, `replaced`: numbers of the tasks that it is told of, and
#'   `before`, the paths of results of other settings.
#' @noRd
result_files <- function(dir, ids, contents) {
  there <- list.files(dir, "[.]shape$", full.names = TRUE)
  inside <- lapply(there, peek_kept)
  kept <- vapply(inside, `[[`, "", "key")
  stems <- file.path(dir, file_stems(ids))
  keys <- vapply(contents, `[[`, "", "key")
  # The first name that is free for a task, or whose result is out of date
  place <- function(stem, content) {
    first <- match(paste0(stem, ".shape"), there)
    other_mesh <- !is.na(first) && !inside[[first]]$mesh %in% content$mesh
    setting <- paste0("-", substr(content$setting, 1, 8))
    mesh <- paste0("-", substr(content$mesh, 1, 8))
    ends <- if (other_mesh) c("", mesh, paste0(mesh, setting)) else c("", setting)
    for (file in paste0(stem, ends, ".shape")) {
      at <- match(file, there)
      if (is.na(at)) return(list(file = file))
      one <- inside[[at]]
      stale <- one$own && !one$key %in% keys &&
        (is.na(one$mesh) || one$mesh == content$mesh && one$setting %in% content$setting)
      if (stale) return(list(file = file, replaced = !is.na(one$mesh)))
    }
    list(file = file)
  }
  placed <- Map(function(stem, content) {
    if (is.na(content$key)) return(list(file = paste0(stem, ".shape")))
    own <- c(paste0(stem, ".shape"), there[kept %in% content$key])
    own <- own[match(own, there, nomatch = 0) > 0 & own %in% there[kept %in% content$key]]
    if (length(own)) list(file = own[1]) else place(stem, content)
  }, stems, contents)
  files <- vapply(placed, `[[`, "", "file", USE.NAMES = FALSE)
  first <- match(paste0(stems, ".shape"), there)
  same_mesh <- vapply(seq_along(files), function(i) {
    !is.na(first[i]) && inside[[first[i]]]$mesh %in% contents[[i]]$mesh
  }, NA)
  new <- !files %in% there
  structure(files, beside = which(new & same_mesh),
            replaced = which(vapply(placed, function(one) isTRUE(one$replaced), NA)),
            before = there[first[new & same_mesh]])
}

#' Say which results are replaced, and which stay beside new ones of other settings
#' @noRd
tell_places <- function(files, ids, contents) {
  replaced <- attr(files, "replaced")
  if (length(replaced)) {
    crestline_inform(sprintf(
      "%s in %s by other landmarks of the same scan, or by a former version: replaced, of %s.",
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
