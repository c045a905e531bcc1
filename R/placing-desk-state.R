# A desk: several specimens one after the other on one page, each with its review and its way back.

#' Begin a desk
#'
#' @param ids Names of the specimens.
#' @param open Function of a specimen's name: its review as of [begin_review()].
#' @param keep Function of a review, called after each step.
#' @param observer Name of the person.
#' @return List: `ids`, `open`, `keep`, `observer`; `at` (name of the specimen that is shown);
#'   `reviews` (list by name, of those that were shown).
#' @noRd
begin_desk <- function(ids, open, keep = function(review) NULL, observer = "") {
  desk <- list(ids = ids, open = open, keep = keep, observer = observer, at = ids[1],
               reviews = list())
  desk$reviews[[ids[1]]] <- open(ids[1])
  desk
}

#' A desk of one review
#' @noRd
desk_of <- function(review) begin_desk(review$specimen$id, function(id) review)

current_review <- function(desk) desk$reviews[[desk$at]]

#' The desk after a change of the review that is shown; it is kept, and where it cannot be written
#' the desk says so: the next step writes all
#' @noRd
on_current <- function(desk, change) {
  before <- current_review(desk)
  after <- as_value(change(before))
  if (failed(after)) after <- with_said(before, paste(after$problem, after$remedy))
  fault <- if (!identical(after[kept_parts], before[kept_parts])) {
    tryCatch({
      desk$keep(after)
      NULL
    }, error = conditionMessage)
  }
  if (!is.null(fault)) after <- with_said(after, paste("This step is not written:", fault))
  desk$reviews[[desk$at]] <- after
  desk
}

#' Go on to a specimen, which is opened where it was not shown before; one that cannot be read is
#' passed over, and the desk says why
#'
#' @param by 1 (the next) or -1.
#' @noRd
turn_to <- function(desk, by) {
  at <- match(desk$at, desk$ids) + by
  if (at < 1 || at > length(desk$ids)) {
    return(on_current(desk, function(review) with_said(review, "There is no other specimen.")))
  }
  lost <- character()
  for (id in desk$ids[if (by > 0) at:length(desk$ids) else at:1]) {
    review <- desk$reviews[[id]]
    if (is.null(review)) review <- as_value(desk$open(id))
    if (!failed(review)) break
    lost <- c(lost, sprintf("%s cannot be shown: %s", id, review$problem))
  }
  if (!failed(review)) {
    desk$reviews[[id]] <- review
    desk$at <- id
  }
  if (!length(lost)) return(desk)
  on_current(desk, function(now) with_said(now, paste(lost, collapse = " ")))
}

#' The desk with the reviews of all specimens that have a record, also of those that were not shown;
#' one that cannot be opened is told
#'
#' @param dir As in [digitise()].
#' @noRd
with_recorded_reviews <- function(desk, dir) {
  unseen <- setdiff(desk$ids, names(desk$reviews))
  if (is.null(dir) || !length(unseen)) return(desk)
  record <- vapply(unseen, function(id) desk_paths(dir, desk$observer, id)$record, "")
  for (id in unseen[file.exists(record)]) {
    review <- as_value(desk$open(id))
    if (failed(review)) {
      crestline_warn(paste("it has a record but is left out:", review$problem), review$remedy,
                     stage = "desk", id = id, class = "crestline_desk_warning")
    } else {
      desk$reviews[[id]] <- review
    }
  }
  desk
}

#' The specimen of a review, with the curves that were drawn on it
#' @noRd
reviewed_specimen <- function(review) {
  drawn <- drawn_points(review)
  specimen <- review$specimen
  # What is missing now, not when it was read
  report <- report_of_missing(specimen$report, specimen$landmarks)
  if (!identical(report, specimen$report)) specimen <- with_fields(specimen, report = report)
  if (length(drawn) || !is.null(specimen$drawn)) {
    return(with_fields(specimen, drawn = if (length(drawn)) drawn))
  }
  specimen
}

#' The curves that a specimen brings, as drawn lines to go on with
#' @noRd
with_drawn <- function(review) {
  for (name in intersect(names(review$specimen$drawn), review$fitting$scheme$curves$curve)) {
    at <- review$specimen$drawn[[name]]
    knots <- columns_of(surface_points(review$specimen$mesh, unclass(at)[, 1:3, drop = FALSE]))
    # The landmarks at its ends are no knots
    ends <- knot_ends(review, curve_row(review, name))
    inner <- setdiff(seq_len(nrow(knots)), c(if (!is.null(ends$from)) 1,
                                             if (!is.null(ends$to)) nrow(knots)))
    review$drawn[[name]] <- joined_line(review, name, knots[inner, , drop = FALSE])
  }
  review
}

#' What there is to say of a desk: how many landmarks and curves are done on each specimen
#' @noRd
desk_words <- function(desk) {
  number <- match(desk$at, desk$ids)
  paste0(if (length(desk$ids) > 1) sprintf("%d of %d: ", number, length(desk$ids)), desk$at,
         if (nzchar(desk$observer)) sprintf(" (observer %s)", desk$observer))
}
