# How the landmarks of a specimen were placed by machine, and how sure that is.

#' The table of how landmarks were placed; those that were moved since, by
#' `specimen$landmarks[...] <-`, are placed ones
#' @param tolerance As a share of the object's size.
#' @return NULL where the landmarks were given.
#' @noRd
current_placing <- function(specimen, tolerance = 1e-6) {
  placing <- specimen$placing
  if (is.null(placing)) return(NULL)
  now <- specimen$landmarks[match(placing$landmark, rownames(specimen$landmarks)), , drop = FALSE]
  off <- row_lengths(now - as.matrix(placing[c("x", "y", "z")]))
  for (i in which(off > tolerance *
                  specimen_size(specimen))) placing <- moved_placing(placing, placing$landmark[i],
                                                                     now[i, ])
  placing
}

#' The table of how landmarks were placed, with one placed by hand or taken away
#'
#' The place of one that is taken away stays: where it would be.
#' @noRd
moved_placing <- function(placing, name, at) {
  row <- match(name, placing$landmark, nrow(placing) + 1)
  placing[row, "landmark"] <- name
  measured <- intersect(c("confidence", "moved", "sd", "residual", "lost", "apart"), names(placing))
  placing[row, measured] <- NA_real_
  if (anyNA(at)) {
    placing[row, "state"] <- "absent"
  } else {
    placing[row, "state"] <- "placed"
    placing[row, c("x", "y", "z")] <- as.list(at)
  }
  placing
}

#' Which landmarks have little confidence; of placed ones those that have one at all
#'
#' @param placing Of a specimen.
#' @param low Least confidence of a landmark that is not doubted.
#' @return List: `names`, `confidence` (of the doubted ones), `of` (number of landmarks found or
#'   placed), `share` (1 where there is none).
#' @noRd
placing_doubt <- function(placing, low = find_settings()$low) {
  doubted <- which(placing$state %in% c("found", "placed") & placing$confidence < low)
  of <- sum(placing$state %in% c("found", "placed"))
  list(names = placing$landmark[doubted], confidence = placing$confidence[doubted], of = of,
       share = if (of) length(doubted) / of else 1)
}

#' What print() says of landmarks that were found
#' @param wrong As in [find_settings()].
#' @noRd
print_placing <- function(placing, wrong = find_settings()$wrong) {
  if (is.null(placing)) return(invisible())
  states <- table(factor(placing$state, unique(placing$state)))
  line <- function(...) cat(strwrap(paste0(...), width = 80, exdent = 4), sep = "\n")
  line("landmarks by machine: ", paste(states, names(states), collapse = ", "))
  apart <- placing$apart[!is.na(placing$apart)]
  if (length(apart)) {
    line(sprintf("- second opinion on %d: %.3g apart in the median, %.3g at most", length(apart),
                 stats::median(apart), max(apart)))
  }
  doubt <- placing_doubt(placing)
  if (!length(doubt$names) && doubt$of) return(invisible())
  if (doubt$share > wrong) {
    line(paste("- the template lies badly on it: nothing that follows",
               "from these landmarks is sure"))
  }
  line("- little confidence: ",
       shorten(paste0(doubt$names, " (", round(doubt$confidence, 2), ")"), 20))
}
