# What a batch is to measure: an id of its own for each mesh, its landmarks, and how both are read.

#' What is to be measured: files or specimens, by id
#'
#' @return Named list of jobs, each a list: `id`; `specimen`, or `mesh` (path), `landmarks` (path,
#'   matrix, or NULL where there are none) and `reading` (list: arguments for `landmarks`, for
#'   `specimen`); `wanting`, why there are no landmarks, as far as that is known; `refusal`, a
#'   condition, where the landmarks cannot be had.
#' @noRd
batch_jobs <- function(x, landmarks, reading) {
  if (inherits(x, "specimen")) x <- list(x)
  if (is.character(x) && length(x)) return(file_jobs(x, landmarks, reading))
  if (!is.list(x) || !length(x)) {
    crestline_abort(sprintf("`x` is %s.", describe_value(x)),
                    "Give paths of meshes, or a list of specimens.",
                    stage = "arguments")
  }
  for (one in x) check_class(one, "specimen", "x", "specimen() or read_specimen()")
  refuse_for_specimens(landmarks, reading)
  ids <- specimen_ids(x)
  stats::setNames(Map(function(one, id) {
    one$id <- id
    list(id = id, specimen = one)
  }, unname(x), ids), ids)
}

#' Specimens have their landmarks, and are read already
#' @noRd
refuse_for_specimens <- function(landmarks, reading) {
  if (is.null(landmarks) && !length(reading)) return(invisible())
  crestline_abort(sprintf("`%s` goes with mesh files, but `x` holds specimens.",
                          if (is.null(landmarks)) "reading" else "landmarks"),
                  "Give the specimens their landmarks first, or give the paths of the meshes.",
                  stage = "arguments")
}

#' Ids of specimens; of those that share one, the names of the list where these are each another,
#' else numbered
#' @noRd
specimen_ids <- function(x) {
  ids <- vapply(x, `[[`, "", "id", USE.NAMES = FALSE)
  given <- names(x)
  distinct <- !is.null(given) && all(nzchar(given)) && !anyDuplicated(given)
  if (anyDuplicated(ids) && distinct) return(given)
  make.unique(ifelse(nzchar(ids), ids, "unnamed"), sep = " ")
}

#' @noRd
file_jobs <- function(files, landmarks, reading, ids = NULL) {
  none <- !vapply(files, is_path, NA)
  if (any(none)) {
    crestline_abort(sprintf("`x` has no path at place %s.", shorten(which(none))),
                    "Give paths of meshes.",
                    stage = "arguments")
  }
  # Arguments of reading, each for the function that takes it
  takes <- reading_arguments()
  named <- names(reading)
  wrong <- !is.list(reading) || length(reading) && (is.null(named) || any(!nzchar(named)))
  strange <- if (!wrong) setdiff(names(reading), unlist(takes))
  if (wrong || length(strange)) {
    crestline_abort(if (wrong) {
                      sprintf("`reading` is %s, not a list with names.", describe_value(reading))
                    } else {
                      sprintf("`reading` has arguments that reading does not take: %s.",
                              shorten(strange))
                    },
                    sprintf("Give a list of %s.", shorten(unlist(takes), 20)), stage = "arguments")
  }
  reading <- lapply(takes, function(names) reading[names(reading) %in% names])
  files <- mesh_files(files)
  if (is.null(ids)) {
    refuse_twice(files, landmarks)
    ids <- file_ids(files)
  }
  readings <- reading_by_id(reading, ids)
  own <- if (is.null(landmarks)) landmarks_or_refusals(files) else
    given_landmarks(landmarks, ids, reading$landmarks)
  wanting <- c(attr(own, "problem"), rep(NA, length(ids)))[seq_along(ids)]
  stats::setNames(Map(function(mesh, id, at, reading, wanting) {
    failed <- inherits(at, "condition")
    list(id = id, mesh = mesh, landmarks = if (!failed) at, reading = reading,
         refusal = if (failed) at, beside = is.null(landmarks),
         wanting = if (!is.na(wanting)) wanting)
  }, files, ids, own, readings, wanting, USE.NAMES = FALSE), ids)
}

#' The meshes of a folder or of a pattern, or files as they are; files of landmarks are refused
#' @noRd
mesh_files <- function(files) {
  known <- sprintf("[.](%s)([.]gz)?$", paste(names(mesh_readers()), collapse = "|"))
  folder <- dir.exists(files)
  files <- unlist(Map(function(file, folder) {
    if (folder) return(list.files(file, known, full.names = TRUE, ignore.case = TRUE))
    if (file.exists(file) || !grepl("[*?]", file)) return(file)
    found <- Sys.glob(file)
    if (length(found)) found else file
  }, files, folder), use.names = FALSE)
  one <- "list.files(folder, \"[.]ply$\", full.names = TRUE)"
  if (!length(files)) {
    crestline_abort("the folder of `x` has no mesh files.",
                    sprintf("Give the folder of the meshes, or their paths: %s.", one),
                    stage = "arguments")
  }
  marks <- sprintf("[.](%s|json)$", paste(names(landmark_formats()), collapse = "|"))
  wrong <- files[grepl(marks, files, ignore.case = TRUE)]
  if (length(wrong)) {
    crestline_abort(sprintf("`x` has landmark files: %s.", shorten(basename(wrong))),
                    sprintf("Give the meshes only: %s.", one), stage = "arguments")
  }
  files
}

#' Arguments of reading for each specimen: `rescale` may name the specimens that it is for
#' @noRd
reading_by_id <- function(reading, ids) {
  factor <- reading$specimen$rescale
  if (is.null(names(factor))) {
    if (!is.null(factor)) check_number(factor, "reading$rescale", 0, open = TRUE)
    return(rep(list(reading), length(ids)))
  }
  strange <- setdiff(names(factor), ids)
  if (length(strange)) {
    crestline_abort(sprintf("`reading$rescale` names %s, which is no specimen.", shorten(strange)),
                    members_there(ids, strange[1]), stage = "arguments")
  }
  factor <- vapply(factor, check_number, 0, "reading$rescale", 0, open = TRUE)
  lapply(ids, function(id) {
    reading$specimen$rescale <- if (id %in% names(factor)) factor[[id]]
    reading
  })
}

#' Ids of files: their names without extension; where these are the same, with as many folders as
#' tell them apart, else with the extension
#' @noRd
file_ids <- function(files) {
  paths <- normalizePath(files, winslash = "/", mustWork = FALSE)
  if (anyDuplicated(paths)) {
    own <- file_ids(files[!duplicated(paths)])
    return(make.unique(own[match(paths, unique(paths))], sep = " "))
  }
  parts <- strsplit(paths, "/", fixed = TRUE)
  ids <- sub("(.)[.][^.]*$", "\\1", basename(files))
  for (depth in seq_len(max(lengths(parts)))) {
    twins <- ids %in% ids[duplicated(ids)]
    if (!any(twins)) break
    ids[twins] <- vapply(parts[twins], function(part) {
      above <- utils::tail(utils::head(part, -1), depth)
      paste(c(above, sub("(.)[.][^.]*$", "\\1", part[length(part)])), collapse = "/")
    }, "")
  }
  twins <- ids %in% ids[duplicated(ids)]
  ids[twins] <- basename(files[twins])
  make.unique(ids, sep = " ")
}

#' The landmark file beside each mesh, NULL where there is none, or the condition by which it is
#' refused
#' @noRd
landmarks_or_refusals <- function(files) {
  folders <- unique(dirname(files))
  listings <- lapply(folders, folder_listing)
  Map(function(file, listing) {
    tryCatch({
      beside <- landmarks_beside(file, listing)
      if (nzchar(beside)) beside
    }, crestline_error = identity)
  }, files, listings[match(dirname(files), folders)], USE.NAMES = FALSE)
}

#' Landmarks as [landmarks_for()] has them, none for meshes whose path is NA
#' @noRd
given_landmarks <- function(landmarks, ids, options) {
  paths <- is.character(landmarks) && length(landmarks) == length(ids)
  none <- if (paths) is.na(landmarks) | !nzchar(landmarks) else FALSE
  if (!any(none)) return(do.call(landmarks_for, c(list(landmarks, ids), options)))
  own <- stats::setNames(vector("list", length(ids)), ids)
  if (all(none)) return(own)
  some <- do.call(landmarks_for, c(list(landmarks[!none], ids[!none]), options))
  own[!none] <- some
  problem <- rep(NA_character_, length(ids))
  problem[!none] <- attr(some, "problem")
  structure(own, problem = problem)
}

#' Which arguments reading takes, of landmark files and of the specimen
#' @noRd
reading_arguments <- function() {
  landmarks <- setdiff(names(formals(read_landmarks)), c("file", "..."))
  specimen <- unique(c(names(formals(read_specimen)), names(formals(specimen))))
  list(landmarks = landmarks,
       specimen = setdiff(specimen, c("file", "mesh", "landmarks", "id", "...", landmarks)))
}

#' The specimen of a job, read from its files or as it was given
#' @noRd
job_specimen <- function(job) {
  if (!is.null(job$refusal)) {
    # An unreadable mesh is the first error: landmarks would not help.
    if (!is.null(job$mesh)) read_mesh(job$mesh, job$id)
    rlang::cnd_signal(job$refusal)
  }
  if (!is.null(job$specimen)) return(job$specimen)
  at <- job$landmarks
  if (!is.character(at)) {
    return(do.call(read_specimen, c(list(job$mesh, at, job$id), job$reading$specimen)))
  }
  points <- do.call(read_landmarks, c(list(at), job$reading$landmarks))
  one <- do.call(read_specimen, c(list(job$mesh, points, job$id), job$reading$specimen))
  with_desk_curves(from_files(one, job$mesh, at), at, names(attr(points, "curves")))
}

#' What the answers of a job depend on: its content, not the names of its files
#'
#' @return List of strings: `mesh` and `key`, hashes; `setting`, a hash of all but mesh, landmarks
#'   and version; `words`, what differs from a plain run. NA, "" where a file cannot be read.
#' @noRd
job_content <- function(job, scheme, settings) {
  named <- sort(setdiff(as.character(names(settings)), c("threads", "progress")))
  words <- run_words(job, scheme, settings[named])
  settings <- list(named, lapply(unname(settings[named]), unclass))
  tryCatch({
    mesh <- if (is.null(job$specimen)) rlang::hash_file(job$mesh) else job$specimen$key
    input <- if (is.null(job$specimen)) {
      at <- job$landmarks
      c(list(if (is.character(at)) rlang::hash_file(at) else at, file_format(job), job$reading),
        desk_record_hash(at))
    } else {
      c(unclass(job$specimen)[c("landmarks", "placing", "match")], job$specimen$mesh["material"],
        if (length(job$specimen$drawn)) list(job$specimen$drawn))
    }
    about <- list(mesh, input, unclass(scheme), settings, job$finder$key, answers_version)
    way <- list(unclass(scheme), settings, job$finder$key, job$reading)
    list(mesh = mesh, key = content_hash(about), setting = content_hash(way), words = words)
  }, error = function(e) {
    list(mesh = NA_character_, key = NA_character_, setting = NA_character_, words = words)
  })
}

#' A hash of the record beside a table of a desk; NULL if there is none
#' @noRd
desk_record_hash <- function(landmarks) {
  path <- if (is.character(landmarks)) record_beside(landmarks) else ""
  if (nzchar(path)) rlang::hash_file(path)
}

#' How a job is measured, in words
#' @noRd
run_words <- function(job, scheme, settings) {
  given <- c(settings, unlist(unname(job$reading), recursive = FALSE))
  each <- vapply(names(given), function(name) {
    stage <- c(settings = "ridge", measuring = "fit")[name]
    if (!is.na(stage) && is.list(given[[name]])) {
      changed_words(given[[name]], default_settings(stage))
    } else {
      paste(name, "=", setting_word(given[[name]]))
    }
  }, "")
  each <- each[each != "as by default"]
  hash <- substr(scheme_hash(scheme), 1, 8)
  paste(c(sprintf("scheme %s (hash %s)", scheme$name, hash), each,
          if (!is.null(job$finder)) "landmarks found by a template"), collapse = ", ")
}

#' The formats of a job's files, which say how their bytes are read
#' @noRd
file_format <- function(job) {
  tolower(sub("^.*[.]", "", basename(c(job$mesh, if (is.character(job$landmarks)) job$landmarks))))
}
