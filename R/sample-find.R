# Specimens of a batch that come without landmarks: found where that was asked for, never mixed with
# placed ones in silence.

#' Jobs without landmarks, with what finds them, or refused
#'
#' @param dir Folder of the results, NULL for memory: pictures of refused specimens go there.
#' @param placed Number of further specimens of the batch that have landmarks.
#' @return The jobs; those without landmarks with `finder`: list of `shared` (environment with
#'   `template`, which all jobs of a worker have in common), `doubtful`, `picture` (path) and `key`;
#'   or with `refusal`.
#' @noRd
with_finder <- function(jobs, dir, template, doubtful, scheme, found, placed = 0) {
  doubtful <- check_number(doubtful, "doubtful", 0, 1)
  if (!is.null(found) && !(is.logical(found) && length(found) == 1 && !is.na(found))) {
    crestline_abort(sprintf("`found` is %s.", describe_value(found)), "Give TRUE, FALSE or NULL.",
                    stage = "arguments")
  }
  bare <- vapply(jobs, function(job) {
    # Whether a job has no landmarks, and none that only could not be read
    if (!is.null(job$specimen)) return(!nrow(job$specimen$landmarks))
    if (!is.null(job$refusal)) return(FALSE)
    if (is.character(job$landmarks)) !nzchar(job$landmarks) else !NROW(job$landmarks)
  }, NA)
  if (!any(bare)) return(jobs)
  placed <- placed + sum(!bare)
  if (isFALSE(found) || is.null(found) && placed > 0) {
    jobs[bare] <- lapply(jobs[bare], refused_bare, placed, isFALSE(found))
    return(jobs)
  }
  template <- if (!is.null(template)) check_template(template) else {
    face <- face_template()
    if (all(scheme$landmarks$landmark %in% c(rownames(face$landmarks), rownames(face$predicted)))) {
      face
    }
  }
  if (is.null(template)) return(jobs)
  key <- content_hash(list(
    template$specimen$mesh[c("vb", "it")], template[c("landmarks", "predicted", "unit")], doubtful
  ))
  shared <- rlang::env(template = template)
  folder <- if (is.null(dir)) tempdir() else dir
  pictures <- file.path(folder, paste0(file_stems(names(jobs)), "-placing.png"))
  jobs[bare] <- Map(function(job, picture) {
    c(job, list(finder = list(shared = shared, doubtful = doubtful, picture = picture, key = key)))
  }, jobs[bare], pictures[bare])
  jobs
}

#' A job that is refused for want of landmarks
#' @param others How many of the batch have landmarks.
#' @noRd
refused_bare <- function(job, others, never) {
  beside <- if (!is.null(job$mesh)) {
    sprintf("Put a landmark file %s.* beside it (see read_landmarks())",
            sub("[.][^.]*$", "", basename(job$mesh)))
  } else "Give it landmarks: place_landmarks(), find_landmarks()"
  problem <- if (never) "it has no landmarks, and `found` is FALSE." else
    sprintf(paste("it has no landmarks, but %s of the batch %s:",
                  "found landmarks are not mixed with placed ones unasked."),
            amount(others, "other"), if (others == 1) "has" else "have")
  if (!is.null(job$wanting)) problem <- job$wanting
  remedy <- paste0(beside, ", or have them found: found = TRUE.")
  job$refusal <- tryCatch(refuse_landmarks(problem, remedy, job$id), crestline_error = identity)
  job
}

#' A specimen with found landmarks
#' @noRd
found_specimen <- function(one, finder) {
  # A worker on another machine has not the folder of this session.
  if (!dir.exists(dirname(finder$picture))) finder$picture <- tempfile("placing-", fileext = ".png")
  without_doubted(find_landmarks(one, finder$shared$template), finder)
}

#' The same without the landmarks that are doubted; where most are, an error that names the picture
#' of them
#' @noRd
without_doubted <- function(found, finder) {
  most <- max(find_settings()$wrong, finder$doubtful)
  found <- tryCatch(check_placing(found, doubtful = most, picture = finder$picture),
                    error = function(e) {
    if (inherits(e, "crestline_placing_error")) rlang::cnd_signal(e)
    # The picture could not be written: the refusal matters more.
    check_placing(found, doubtful = most)
  })
  doubt <- placing_doubt(found$placing)
  if (doubt$share > finder$doubtful) found$landmarks[doubt$names, ] <- NA
  found
}
