# Specimens of a container by name, number or logical value: what is asked for is there, once, or
# refused.

#' Numbers of the specimens that are asked for
#'
#' @param i Names (a factor's values), whole numbers, negative for all others, or logical values;
#'   these by their own names where they have any.
#' @param ids Names of what is there.
#' @param what What holds them, for errors: "the sample".
#' @noRd
chosen_members <- function(i, ids, what) {
  if (is.factor(i)) i <- as.character(i)
  at <- if (is.character(i)) {
    absent <- setdiff(i, ids)
    if (length(absent)) {
      refuse_member(sprintf("%s has no specimen %s.", what,
                            shorten(ifelse(is.na(absent), "NA", absent))),
                    members_there(ids, absent[1]))
    }
    match(i, ids)
  } else
    if (is.logical(i)) logical_members(i, ids, what) else numbered_members(i, ids, what)
  if (anyDuplicated(at)) {
    refuse_member(sprintf("%s is asked for twice.", ids[at[anyDuplicated(at)]]),
                  "Name each specimen once.")
  }
  at
}

logical_members <- function(i, ids, what) {
  if (length(i) == 1 && is.null(names(i))) i <- rep(i, length(ids))
  if (length(i) != length(ids) || anyNA(i)) {
    refuse_member(sprintf("%s, %d of them NA, for the %s of %s.",
                          amount(length(i), "logical value"), sum(is.na(i)),
                          amount(length(ids), "specimen"), what),
                  "Give TRUE or FALSE for each.")
  }
  if (!is.null(names(i))) {
    if (!setequal(names(i), ids)) {
      refuse_member(sprintf("the logical values are named %s, which are not the specimens of %s.",
                            shorten(names(i)), what),
                    paste(members_there(ids),
                          "Name them so, or take the names off: unname()."))
    }
    i <- i[ids]
  }
  which(unname(i))
}

numbered_members <- function(i, ids, what) {
  n <- length(ids)
  if (!is.numeric(i) || anyNA(i) || any(i != round(i)) || (any(i < 0) && any(i > 0))) {
    refuse_member(sprintf("specimens are chosen by %s.", describe_value(i)),
                  "Give names, whole numbers (negative: all but these), or a logical value each.")
  }
  beyond <- i[abs(i) > n]
  if (length(beyond)) {
    refuse_member(sprintf("%s has no specimen %s.", what, shorten(format(abs(beyond)))),
                  members_there(ids))
  }
  seq_len(n)[i]
}

#' Number of the one specimen that is asked for
#' @noRd
one_member <- function(i, ids, what) {
  if (length(i) != 1 || is.logical(i) || (is.numeric(i) && isTRUE(i < 1))) {
    refuse_member(sprintf("one specimen of %s is asked for by %s.", what, describe_value(i)),
                  paste("Give one name or number.", members_there(ids)))
  }
  chosen_members(i, ids, what)
}

refuse_member <- function(problem, remedy) {
  crestline_abort(problem, remedy, stage = "specimens", class = "crestline_member_error")
}

#' What is there, the most like one name first
#' @noRd
members_there <- function(ids, like = NA) {
  if (!length(ids)) return("There is none.")
  if (!is.na(like)) ids <- ids[order(utils::adist(like, ids, ignore.case = TRUE))]
  sprintf("There %s: %s.", if (length(ids) == 1) "is one" else paste("are", length(ids)),
          shorten(ids, 8))
}

#' The first argument after `x[` is the only one
#' @noRd
refuse_dimensions <- function(what, instead) {
  refuse_member(sprintf("%s has specimens, no rows and columns.", what), instead)
}

#' Names of specimens that are there, each once
#' @noRd
check_member_names <- function(value, n) {
  value <- as.character(value)
  if (length(value) != n || anyNA(value) || any(!nzchar(value)) || anyDuplicated(value)) {
    refuse_member(sprintf("the names are %s, for %s.", describe_value(value),
                          amount(n, "specimen")),
                  "Give each a name of its own.")
  }
  value
}
