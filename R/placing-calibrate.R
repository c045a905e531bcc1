# A template's landmarks moved to where the user puts them.

#' Calibrate a template by a few scans with landmarks
#'
#' Adapts the template to your own landmark definitions, from a few scans that you have marked. Most
#' of the error of [find_landmarks()] is a difference of definition. Three scans remove most of it.
#' Landmarks that the template does not have are added. A symmetric template stays symmetric.
#'
#' @param template A [landmark_template()], or a [specimen()] with landmarks.
#' @param specimens One [specimen()] or a list of them, with landmarks that were placed or corrected
#'   by hand. NA: missing landmarks.
#' @param rounds Number of rounds. In each round the landmarks are moved by the mean of their
#'   errors.
#' @inheritParams find_landmarks
#' @return The `landmark_template` with moved landmarks, and a field `calibration`: a data frame
#'   with a row for each landmark. Columns: `landmark`, `specimens` (number of specimens that have
#'   it), `moved` (distance on the template), `spread` (RMS of the remaining errors over the
#'   specimens); lengths in the template's unit.
#' @section Errors: of class `crestline_error`: there are no specimens, a specimen has no landmarks,
#'   or nothing in a scan resembles the template.
#' @template glossary
#' @templateVar where sections 1 and 7 (which take landmarks as given)
#' @template paper
#' @seealso [find_landmarks()]
#' @section Warnings: of class `crestline_unused_landmarks`, as in [fit_shape()].
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' mine <- calibrate_template(face_template(), list(face))
#' mine$calibration
#' }
#' @export
calibrate_template <- function(template, specimens, rounds = 4, settings = find_settings(),
                               threads = getOption("crestline.threads", 1L)) {
  check_given()
  threads <- check_threads(threads)
  template <- check_template(template)
  check_class(settings, "find_settings", "settings", "find_settings()")
  rounds <- check_count(rounds, "rounds")
  if (inherits(specimens, "specimen")) specimens <- list(specimens)
  if (!is.list(specimens) || !length(specimens)) {
    crestline_abort(sprintf("`specimens` is %s.", describe_value(specimens)),
                    "Give a list of specimens with landmarks.",
                    stage = "arguments")
  }
  for (one in specimens) check_class(one, "specimen", "specimens", "specimen() or read_specimen()")
  known <- data.frame(landmark = rownames(template$landmarks), name = NA)
  for (one in specimens) warn_unused_names(one, list(landmarks = known), "the template")
  prepared <- prepared_template(template, settings, threads)
  fits <- lapply(specimens, calibration_fit, prepared, template, settings, threads)
  before <- template
  template <- with_new_landmarks(template, prepared, fits)
  for (round in seq_len(rounds)) {
    off <- landmark_offsets(prepared, template, fits)
    template$landmarks <- moved_landmarks(template, off)
  }
  template$predicted <- calibrated_prediction(template, fits)
  seen <- unlist(lapply(fits, function(fit) rownames(fit$at)))
  template$ear <- template$ear[!names(template$ear) %in% seen]
  template$calibration <- calibration_table(
    before, template, landmark_offsets(prepared, template, fits)
  )
  template
}

#' The template with landmarks that only the specimens have: begun at its point that is carried
#' nearest to them
#' @noRd
with_new_landmarks <- function(template, prepared, fits) {
  known <- c(rownames(template$landmarks), rownames(template$predicted))
  for (fit in fits) {
    new <- setdiff(rownames(fit$at), known)
    for (name in new) {
      nearest <- which.min(row_lengths(fit$moved - rep(fit$at[name, ], each = nrow(fit$moved))))
      template$landmarks <- rbind(template$landmarks, matrix(
        prepared$xyz[, nearest], 1, dimnames = list(name, NULL)
      ))
    }
    known <- c(known, new)
  }
  template
}

#' What calibration keeps of a specimen: the bent template and the specimen's landmarks in its frame
#' @noRd
calibration_fit <- function(specimen, prepared, template, settings, threads) {
  at <- specimen$landmarks[stats::complete.cases(specimen$landmarks), , drop = FALSE]
  if (!nrow(at)) {
    refuse_landmarks(
      "it has no landmarks.", "Give specimens whose landmarks you have placed.", specimen$id
    )
  }
  laid <- laid_template(prepared, template, specimen, settings, threads)
  local <- cloud_in_frame(laid$cloud, laid$pose)
  bent <- fit_warp(prepared, local, prepared$settings, prepared$settings$weight)
  list(coefficients = bent$coefficients, moved = bent$moved[seq_len(ncol(prepared$xyz)), ],
       at = structure(into_frame(at, laid), dimnames = list(rownames(at), NULL)))
}

#' What each carried landmark is off on each specimen, in the template's frame
#' @return Array landmarks x 3 x specimens, NA where a specimen has none.
#' @noRd
landmark_offsets <- function(prepared, template, fits) {
  own <- template$landmarks
  prepared <- with_landmarks(prepared, own)
  basis <- lapply(prepared$basis, function(b) b[-seq_len(ncol(prepared$xyz)), , drop = FALSE])
  carried <- function(fit) own + displaced(basis, fit$coefficients)
  each <- lapply(fits,
                 function(fit) fit$at[match(rownames(own), rownames(fit$at)), , drop = FALSE] -
                 carried(fit))
  array(unlist(each), c(nrow(own), 3, length(fits)), list(rownames(own), NULL, NULL))
}

#' Landmarks moved by their mean offsets, to the template's surface; partners alike
#' @noRd
moved_landmarks <- function(template, off) {
  step <- apply(off, 1:2, mean, na.rm = TRUE)
  step[is.nan(step)] <- 0
  at <- template$landmarks + step
  if (template$mirror) at <- mirrored_mean(at)
  at[] <- as.matrix(surface_points(template$specimen$mesh, at)[1:3])
  at
}

#' Landmarks and their mirror images in x = 0, partners by name, averaged
#' @noRd
mirrored_mean <- function(at) {
  pairs <- side_pairs(rownames(at))
  flipped <- at %*% diag(c(-1, 1, 1))
  dimnames(flipped) <- dimnames(at)
  single <- is_sided(rownames(at))
  partner <- rownames(at)
  partner[match(c(pairs$left, pairs$right), partner)] <- c(pairs$right, pairs$left)
  mean <- (at + flipped[partner, , drop = FALSE]) / 2
  alone <- single & partner == rownames(at)
  mean[alone, ] <- at[alone, ]
  rownames(mean) <- rownames(at)
  mean
}

#' Predicted landmarks at the mean of where the specimens have them, by similarities fitted to the
#' others
#' @noRd
calibrated_prediction <- function(template, fits) {
  own <- template$predicted
  for (name in rownames(own)) {
    seen <- Filter(function(fit) name %in% rownames(fit$at), fits)
    back <- lapply(seen, function(fit) {
      common <- intersect(rownames(fit$at), rownames(template$landmarks))
      if (length(common) < 4) return(NULL)
      apply_similarity(fit$at[name, , drop = FALSE],
                       similarity(fit$at[common, ], template$landmarks[common, ]))
    })
    back <- do.call(rbind, back)
    if (!is.null(back)) own[name, ] <- colMeans(back)
  }
  if (template$mirror && nrow(own)) mirrored_mean(own) else own
}

calibration_table <- function(before, after, off) {
  known <- match(rownames(after$landmarks), rownames(before$landmarks))
  data.frame(landmark = rownames(after$landmarks),
             specimens = apply(!is.na(off[, 1, , drop = FALSE]), 1, sum),
             moved = row_lengths(after$landmarks - before$landmarks[known, , drop = FALSE]),
             spread = sqrt(apply(off^2, 1, function(x) mean(colSums(matrix(x, 3)), na.rm = TRUE))),
             row.names = NULL)
}
