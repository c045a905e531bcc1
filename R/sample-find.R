# Specimens of a batch that come without landmarks.

#' Jobs without landmarks, with what finds them
#'
#' @return The jobs; those without landmarks with `finder`: list of `shared` (environment with `template`, which all jobs of a
#'   worker have in common), `doubtful`, `picture` (path) and `key`.
#' @noRd
with_finder <- function(jobs, files, template, doubtful, scheme) {
  doubtful <- check_number(doubtful, "doubtful", 0, 1)
  bare <- vapply(jobs, function(job) if (is.null(job$specimen)) !nzchar(job$landmarks) else !nrow(job$specimen$landmarks), NA)
  if (!any(bare)) return(jobs)
  template <- batch_template(template, scheme)
  if (is.null(template)) return(jobs)
  key <- rlang::hash(list(template$specimen$mesh[c("vb", "it")], template[c("landmarks", "predicted", "unit")], doubtful))
  shared <- rlang::env(template = template)
  jobs[bare] <- Map(function(job, file, name) {
    picture <- if (is.null(file)) tempfile(paste0("placing-", gsub("[^[:alnum:]_-]", "_", name), "-"), fileext = ".png") else
      sub("[.]shape$", "-placing.png", file)
    c(job, list(finder = list(shared = shared, doubtful = doubtful, picture = picture, key = key)))
  }, jobs[bare], files[bare], names(jobs)[bare])
  jobs
}

batch_template <- function(template, scheme) {
  if (!is.null(template)) return(check_template(template))
  face <- face_template()
  if (all(scheme$landmarks$landmark %in% c(rownames(face$landmarks), rownames(face$predicted)))) face
}

#' A specimen with found landmarks, or an error that names the picture of them
#' @noRd
found_specimen <- function(one, finder) {
  # A worker on another machine has not the folder of this session.
  if (!dir.exists(dirname(finder$picture))) finder$picture <- tempfile("placing-", fileext = ".png")
  found <- check_placing(find_landmarks(one, finder$shared$template), doubtful = finder$doubtful, picture = finder$picture)
  unlink(finder$picture)
  found
}
