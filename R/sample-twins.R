# One scan twice: under two ids, or named twice in a list of files.

#' Tell of specimens that have one mesh
#'
#' With the same landmarks they are one specimen, which counts twice in all that follows: a warning.
#' With others they may be repeated placings: a message.
#'
#' @param shapes List of shapes by id, those that failed NULL.
#' @noRd
tell_twins <- function(shapes, stage) {
  told <- lapply(plain_list(shapes), told_of)
  surface <- vapply(told, `[[`, "", "surface")
  both <- ifelse(is.na(surface), NA, paste(surface, vapply(told, `[[`, "", "marks")))
  names(both) <- names(surface)
  same <- twins_among(both)
  if (length(same)) {
    crestline_warn(
      sprintf("one scan with the same landmarks has two ids: %s.", shorten(same, 5)),
      paste("It counts twice in every test. Leave one out,",
            sprintf("x[names(x) != \"%s\"], unless that is meant.", attr(same, "first"))),
      stage = stage, class = "crestline_twin"
    )
  }
  alike <- setdiff(twins_among(surface), same)
  if (length(alike)) {
    crestline_inform(c(
      sprintf("One scan has two ids, with other landmarks: %s.", shorten(alike, 5)),
      i = "That is right for repeated placings. Else leave one of the two out."
    ))
  }
}

#' Names of elements that are equal, a text for each group
#' @return Character "a and b"; `first`, the second name of the first group.
#' @noRd
twins_among <- function(x) {
  groups <- split(as.character(names(x)), factor(x, unique(x)))
  groups <- groups[lengths(groups) > 1]
  structure(vapply(groups, paste, "", collapse = " and ", USE.NAMES = FALSE),
            first = if (length(groups)) groups[[1]][2])
}

#' A mesh file that is named twice, with the same landmarks
#' @noRd
refuse_twice <- function(files, landmarks) {
  paths <- normalizePath(files, winslash = "/", mustWork = FALSE)
  if (!is.null(landmarks)) {
    if (!is.character(landmarks) || length(landmarks) != length(files)) return(invisible())
    paths <- paste(paths, normalizePath(landmarks, winslash = "/", mustWork = FALSE))
  }
  twice <- unique(files[duplicated(paths)])
  if (!length(twice)) return(invisible())
  crestline_abort(sprintf("`x` names a file twice: %s.", shorten(basename(twice))),
                  paste("Name each once, unique(x). A scan that was digitised twice needs a",
                        "landmark file for each time, see `landmarks`."),
                  stage = "arguments")
}
