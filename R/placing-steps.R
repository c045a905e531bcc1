# Steps of what is edited on a page: each is recorded with its observer and time, and can be taken
# back and made again.

# What a step may change, and the way back restores.
step_parts <- c("specimen", "fitting", "state", "selected", "drawn", "pen", "log")

# What is written to the files of a desk.
kept_parts <- c("specimen", "state", "drawn", "log")

#' The next review, from which the way back leads to this one
#'
#' @param part,level,action What is done to which landmark or curve.
#' @noRd
review_step <- function(review, part, level, action) {
  after <- review
  after$history <- c(review$history, list(review[step_parts]))
  after$future <- list()
  after$log <- rbind(review$log, data.frame(part = part, level = level, action = action,
                                            by = review$observer, time = time_stamp()))
  with_said(after, "")
}

undo_review <- function(review) travel(review, "history", "future", "There is nothing to undo.")

redo_review <- function(review) travel(review, "future", "history", "There is nothing to redo.")

#' One step back or forth
#' @noRd
travel <- function(review, from, to, none) {
  last <- length(review[[from]])
  if (last == 0) return(with_said(review, none))
  review[[to]] <- c(review[[to]], list(review[step_parts]))
  # Fields that were NULL are kept as such
  review[step_parts] <- review[[from]][[last]][step_parts]
  review[[from]] <- review[[from]][-last]
  with_said(review, "")
}

with_said <- function(state, said) {
  state$said <- said
  state
}
