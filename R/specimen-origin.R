# How each landmark of a specimen came to its place, and its mesh from which file.

#' The time by the clock of the world
#' @noRd
time_stamp <- function(time = Sys.time()) format(time, "%Y-%m-%dT%H:%M:%SZ", tz = "UTC")

#' The record of a specimen's landmarks as they are now; what is not recorded was given
#' @noRd
origin_of <- function(specimen) {
  now <- new_origin(specimen$landmarks, "given")
  before <- specimen$origin
  row <- match(now$landmark, before$landmark)
  known <- which(!is.na(row) & !is.na(now$how))
  known <- known[!is.na(before$how[row[known]])]
  now[known, ] <- before[row[known], names(now)]
  now
}

#' A specimen with the record of some landmarks changed
#' @noRd
with_origin <- function(specimen, landmarks, how, file = NA_character_, time = NA_character_) {
  origin <- origin_of(specimen)
  at <- match(landmarks, origin$landmark)
  some <- specimen$landmarks[at, , drop = FALSE]
  origin[at, ] <- new_origin(some, how, file, time)
  with_fields(specimen, origin = origin)
}

#' The record after landmarks were set by the user: those at another place were moved or placed by
#' hand
#'
#' @param specimen As it was before.
#' @param landmarks What they are set to.
#' @noRd
origin_after <- function(specimen, landmarks) {
  given <- nrow(specimen$landmarks) == 0
  known <- origin_of(specimen)
  origin <- new_origin(landmarks, if (given) "given" else "placed",
                       time = if (given) NA_character_ else time_stamp())
  row <- match(origin$landmark, known$landmark)
  before <- specimen$landmarks[row, , drop = FALSE]
  there <- !is.na(before[, 1]) & !is.na(landmarks[, 1])
  same <- there & rowSums(before != landmarks) == 0
  origin$how[there & !same] <- "moved"
  origin[which(same), ] <- known[row[which(same)], ]
  origin
}

#' A specimen that was read from files
#'
#' @param file Path of its mesh.
#' @param landmarks Path of its landmarks, NA where these were given.
#' @noRd
from_files <- function(specimen, file, landmarks = NA_character_) {
  specimen <- with_fields(specimen, file = file)
  if (is.na(landmarks)) return(specimen)
  with_origin(specimen, rownames(specimen$landmarks), "file", landmarks)
}

#' The record of landmarks in words: how many came in which way, which of them by hand and when
#' @noRd
origin_words <- function(origin) {
  if (is.null(origin)) return("not recorded")
  origin <- origin[!is.na(origin$how), ]
  if (!nrow(origin)) return("none")
  words <- c(file = "from a file", given = "given", found = "found", predicted = "predicted",
             placed = "placed by hand",
             moved = "moved by hand", defined = "moved by definition")
  each <- lapply(intersect(names(words), origin$how), function(how) {
    own <- origin[origin$how == how, ]
    named <- how %in% c("placed", "moved", "defined")
    files <- unique(basename(own$file[!is.na(own$file)]))
    times <- sort(unique(own$time[!is.na(own$time)]))
    details <- c(if (length(files)) shorten(files, 3), if (named) shorten(own$landmark, 6),
                 if (length(times) > 1) paste(times[1], "to", times[length(times)]) else times)
    paste0(nrow(own), " ", words[[how]],
           if (length(details)) sprintf(" (%s)", paste(details, collapse = "; ")))
  })
  paste(unlist(each), collapse = ", ")
}
