# Names of landmarks that a scheme does not know, and those of the scheme that may be meant.

#' What a specimen's landmarks have that a scheme does not use
#'
#' @param landmarks k x 3 matrix with row names, or the names.
#' @param scheme A scheme.
#' @return One string such as "not used: prn, CHL; near: pn, chL", NULL where all are used. The
#'   attribute `near` (character, the scheme's missing landmarks that may be meant, named by what is
#'   not used) is empty where there are none.
#' @noRd
unused_names <- function(landmarks, scheme, most = 8, letters = 1) {
  name <- if (is.character(landmarks)) landmarks else rownames(landmarks)
  known <- scheme$landmarks$landmark
  unused <- setdiff(name, known)
  if (!length(unused)) return(NULL)
  # For each name the missing landmark that it may stand for: the same but for case, blanks and
  # signs, the landmark's long name, or a letter or two more or fewer; the two sides of a pair are
  # never near
  missing <- scheme$landmarks[!known %in% name, , drop = FALSE]
  own <- plain_landmark(unused)
  short <- plain_landmark(missing$landmark)
  long <- plain_landmark(missing$name)
  near <- lapply(own, function(name) {
    same <- which(name == short | name == long)
    if (length(same)) return(same)
    distance <- as.vector(utils::adist(name, short))
    added <- abs(nchar(name) - nchar(short)) == distance
    mirrored <- grepl("l$", name) & grepl("r$", short) | grepl("r$", name) & grepl("l$", short)
    long_enough <- pmin(nchar(name), nchar(short)) > 1
    which(distance <= letters & (added | nchar(short) >= 5) & !mirrored & long_enough)
  })
  one <- lengths(near) == 1
  near <- stats::setNames(missing$landmark[unlist(near[one])], unused[one])
  text <- paste("not used:", shorten(unused, most))
  if (length(near)) text <- paste0(text, "; near: ", shorten(near, most))
  structure(text, near = near)
}

#' A warning where a landmark of the scheme is missing and one of another name may be meant
#' @param scheme A scheme, or a list with its `landmarks`.
#' @param of What it is called.
#' @noRd
warn_unused_names <- function(specimen, scheme, of) {
  unused <- unused_names(specimen$landmarks, scheme)
  near <- attr(unused, "near")
  if (!length(near)) return(invisible())
  crestline_warn(paste0("landmarks of ", of, " are missing, and others have names like them: ",
                        unused, "."),
                 paste0("If they are meant, rename them: ",
                        shorten(paste(names(near), "to", near)), "."),
                 stage = "landmarks", id = specimen$id, class = "crestline_unused_landmarks")
}

#' Names of landmarks as they are compared: small letters, no blanks nor signs, the side as a letter
#' at the end
#' @noRd
plain_landmark <- function(name) {
  name <- sub("^(left|right)[^[:alnum:]]+(.*)$", "\\2 \\1", tolower(name))
  name <- gsub("[^[:alnum:]]", "", name)
  sub("left$", "l", sub("right$", "r", name))
}
